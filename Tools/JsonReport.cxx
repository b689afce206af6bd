// SPDX-License-Identifier: BSD-3-Clause
#include "JsonReport.h"

#include "Messages.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLabelMeshReport.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVariant.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>

namespace
{
std::string Quoted(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      quoted += '\\';
      quoted += c;
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char escape[8];
      std::snprintf(escape, sizeof(escape), "\\u%04x", static_cast<unsigned>(c));
      quoted += escape;
    }
    else
    {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string Number(double value)
{
  if (!std::isfinite(value))
  {
    return "null"; // JSON has no other word for it
  }
  char text[40];
  std::snprintf(text, sizeof(text), "%.10g", value);
  return text;
}

/// Joins what is already JSON.
class Json
{
public:
  Json& Add(const std::string& key, const std::string& json)
  {
    this->Body += (this->Body.empty() ? "" : ", ") + Quoted(key) + ": " + json;
    return *this;
  }
  Json& Text(const std::string& key, const std::string& text) { return this->Add(key, Quoted(text)); }
  Json& Real(const std::string& key, double value) { return this->Add(key, Number(value)); }
  Json& Integer(const std::string& key, long long value) { return this->Add(key, std::to_string(value)); }
  Json& Bool(const std::string& key, bool value) { return this->Add(key, value ? "true" : "false"); }
  std::string Object() const { return "{" + this->Body + "}"; }

private:
  std::string Body;
};

std::string Array(const std::vector<std::string>& items, const char* between = ", ")
{
  std::string body;
  for (const std::string& item : items)
  {
    body += (body.empty() ? "" : between) + item;
  }
  return "[" + body + "]";
}

double Cell(vtkTable* table, vtkIdType row, const char* column)
{
  return table->GetValueByName(row, column).ToDouble();
}

long long Count(vtkTable* table, vtkIdType row, const char* column)
{
  return table->GetValueByName(row, column).ToLongLong();
}

std::string Text(vtkTable* table, vtkIdType row, const char* column)
{
  return table->GetValueByName(row, column).ToString();
}

std::string Position(vtkDataArray* positions, vtkIdType row)
{
  std::vector<std::string> numbers;
  for (int a = 0; a < 3; ++a)
  {
    numbers.push_back(Number(positions->GetComponent(row, a)));
  }
  return Array(numbers);
}

std::string Position(vtkTable* table, vtkIdType row, const char* column)
{
  return Position(vtkDataArray::SafeDownCast(table->GetColumnByName(column)), row);
}

std::string Worst(long long triangle, const std::string& position)
{
  return triangle < 0 ? "null" : Json().Integer("triangle", triangle).Add("position", position).Object();
}

std::string MaterialJson(vtkTable* table, vtkIdType row)
{
  const auto count = [&](const char* column) { return Count(table, row, column); };
  Json json;
  json.Integer("label", count("Label")).Text("name", Text(table, row, "Name"));
  json.Integer("triangles", count("Triangles")).Integer("vertices", count("Vertices"));
  json.Real("min_radius_ratio", Cell(table, row, "MinRadiusRatio"));
  json.Real("mean_radius_ratio", Cell(table, row, "MeanRadiusRatio"));
  json.Add("worst_triangle", Worst(count("WorstTriangle"), Position(table, row, "WorstPosition")));
  json.Bool("certified", count("Certified") != 0).Bool("closed", count("Closed") != 0);
  json.Bool("manifold", count("EdgeManifold") != 0 && count("VertexManifold") != 0);
  json.Bool("edge_manifold", count("EdgeManifold") != 0).Bool("vertex_manifold", count("VertexManifold") != 0);
  json.Bool("oriented", count("Oriented") != 0);
  const std::pair<const char*, const char*> counts[] = { { "open_edges", "OpenEdges" },
    { "nonmanifold_edges", "NonManifoldEdges" }, { "nonmanifold_vertices", "NonManifoldVertices" },
    { "misoriented_edges", "MisorientedEdges" }, { "self_intersections", "SelfIntersections" },
    { "components", "Components" }, { "euler", "Euler" }, { "genus", "Genus" }, { "parts", "Parts" },
    { "cavities", "Cavities" }, { "voxels", "Voxels" }, { "voxel_components", "VoxelComponents" },
    { "voxel_euler", "VoxelEuler" }, { "voxel_genus", "VoxelGenus" }, { "voxel_parts", "VoxelParts" },
    { "voxel_cavities", "VoxelCavities" }, { "lost_parts", "LostParts" },
    { "misclassified_voxels", "MisclassifiedVoxels" } };
  for (const auto& [key, column] : counts)
  {
    const long long value = count(column);
    json.Add(key, value < 0 && std::string(column) == "Genus" ? "null" : std::to_string(value));
  }
  json.Real("area", Cell(table, row, "Area")).Real("volume", Cell(table, row, "Volume"));
  json.Real("voxel_volume", Cell(table, row, "VoxelVolume"));
  const std::pair<const char*, const char*> stages[] = { { "mask_volume", "MaskVolume" },
    { "tight_volume", "TightVolume" } };
  for (const auto& stage : stages)
  {
    if (table->GetColumnByName(stage.second))
    {
      json.Real(stage.first, Cell(table, row, stage.second));
    }
  }
  return json.Object();
}

std::string PairOf(vtkTable* table, vtkIdType row)
{
  return Array({ std::to_string(Count(table, row, "LabelA")), std::to_string(Count(table, row, "LabelB")) });
}

std::string InterfacesJson(vtkTable* table)
{
  std::vector<std::string> rows;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    Json json;
    json.Add("labels", PairOf(table, row)).Integer("triangles", Count(table, row, "Triangles"));
    json.Real("area", Cell(table, row, "Area")).Real("min_radius_ratio", Cell(table, row, "MinRadiusRatio"));
    json.Real("mean_radius_ratio", Cell(table, row, "MeanRadiusRatio"));
    json.Integer("voxel_faces", Count(table, row, "VoxelFaces"));
    rows.push_back("\n  " + json.Object());
  }
  return Array(rows, ",");
}

/// Something that was lost, as the report's table has it.
struct LossEntry
{
  std::string Kind; ///< label, parts or pair
  std::string Labels;
  std::string Stage, What, Advice;
  long long Parts = 0, Voxels = 0;
  std::string Position;
};

std::vector<LossEntry> LossesOf(const ReportInput& input, vtkLabelMeshReport* report)
{
  std::vector<LossEntry> losses;
  // Labels without a mask are none of the mesh's: the report takes their voxels for background.
  std::set<long long> listed;
  for (vtkIdType row = 0; row < report->GetOutput(0)->GetNumberOfRows(); ++row)
  {
    listed.insert(Count(report->GetOutput(0), row, "Label"));
  }
  for (const long long label : input.Labels)
  {
    if (listed.count(label) == 0)
    {
      const std::string name = std::to_string(label);
      losses.push_back({ "label", name, "LabelSplit", "label " + name + " has no mask",
        "open less (--material " + name + ":opening=R)", 0, 0, "" });
    }
  }
  vtkTable* table = report->GetOutput(2);
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    LossEntry entry;
    entry.Kind = Text(table, row, "Kind");
    entry.Labels = entry.Kind == "pair" ? PairOf(table, row) : std::to_string(Count(table, row, "LabelA"));
    entry.Stage = input.Particles ? Text(table, row, "Stage") : "GridLabelMesh";
    entry.What = Text(table, row, "What");
    entry.Advice = Text(table, row, "Advice");
    entry.Parts = Count(table, row, "Parts");
    entry.Voxels = Count(table, row, "Voxels");
    entry.Position = Position(table, row, "Position");
    losses.push_back(entry);
  }
  return losses;
}

std::string LostJson(const std::vector<LossEntry>& losses)
{
  std::vector<std::string> rows;
  for (const LossEntry& loss : losses)
  {
    Json json;
    json.Add(loss.Kind == "pair" ? "labels" : "label", loss.Labels).Text("stage", loss.Stage);
    if (loss.Kind == "dropped")
    {
      json.Bool("on_request", true);
    }
    json.Text("what", loss.What).Text("advice", loss.Advice);
    if (loss.Parts > 0)
    {
      json.Integer("parts", loss.Parts).Integer("voxels", loss.Voxels).Add("position", loss.Position);
    }
    rows.push_back("\n  " + json.Object());
  }
  return Array(rows, ",");
}

/// How many labels, parts and pairs were lost, and the first labels by name.
std::string Summary(const std::vector<LossEntry>& losses)
{
  constexpr int most = 5; // labels that are named
  long long labels = 0, parts = 0, dropped = 0, pairs = 0;
  std::string names;
  for (const LossEntry& loss : losses)
  {
    if (loss.Kind == "label")
    {
      ++labels;
      names += labels > most ? "" : (names.empty() ? "" : ", ") + loss.Labels;
    }
    dropped += loss.Kind == "dropped" ? 1 : 0;
    parts += loss.Kind == "parts" ? loss.Parts : 0;
    pairs += loss.Kind == "pair" ? 1 : 0;
  }
  std::vector<std::string> words;
  const auto add = [&words](long long count, const std::string& one, const std::string& more)
  {
    if (count > 0)
    {
      words.push_back(std::to_string(count) + " " + (count == 1 ? one : more));
    }
  };
  add(labels, "label (" + names + ")", "labels (" + names + (labels > most ? ", ..." : "") + ")");
  add(parts, "part of a label", "parts of labels");
  add(dropped, "component that was dropped on request", "components that were dropped on request");
  add(pairs, "pair of labels that touched", "pairs of labels that touched");
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n)
  {
    text += (n == 0 ? "" : n + 1 == words.size() ? " and " : ", ") + words[n];
  }
  return text;
}

std::string CellsJson(vtkPolyData* particles)
{
  std::array<long long, 4> counts{ 0, 0, 0, 0 };
  vtkDataArray* dimensions = particles->GetPointData()->GetArray("CellDimension");
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    ++counts.at(static_cast<std::size_t>(dimensions->GetComponent(i, 0)));
  }
  Json json;
  for (int d = 0; d < (counts[3] > 0 ? 4 : 3); ++d)
  {
    json.Integer(std::to_string(d), counts[d]);
  }
  return json.Object();
}

/// Figures of tetrahedra, by the name of the column or of the field data that holds them.
template <typename Get>
void AddTetrahedra(Json& json, vtkTable* dihedrals, const std::string& angles, const Get& get)
{
  const auto count = [&get](const char* name) { return static_cast<long long>(get(name)); };
  json.Integer("count", count("Tetrahedra")).Integer("turned_over", count("TurnedOver"));
  json.Integer("slivers", count("Slivers")).Real("min_radius_ratio", get("MinRadiusRatio"));
  json.Real("p1_radius_ratio", get("FirstPercentileRadiusRatio")).Real("mean_radius_ratio", get("MeanRadiusRatio"));
  json.Real("min_dihedral_degrees", get("MinDihedral")).Real("max_dihedral_degrees", get("MaxDihedral"));
  json.Real("volume", get("Volume")).Integer("worst_tetrahedron", count("WorstTetrahedron"));
  std::vector<std::string> histogram;
  for (vtkIdType bin = 0; bin < dihedrals->GetNumberOfRows(); ++bin)
  {
    histogram.push_back(std::to_string(Count(dihedrals, bin, angles.c_str())));
  }
  json.Add("histogram", Array(histogram));
}

std::string TetrahedraJson(vtkLabelMeshReport* report)
{
  vtkTable* table = report->GetTetrahedraOutput();
  vtkTable* dihedrals = report->GetDihedralsOutput();
  Json json;
  AddTetrahedra(json, dihedrals, "Angles",
    [table](const char* name) { return table->GetFieldData()->GetArray(name)->GetComponent(0, 0); });
  std::vector<std::string> rows;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const long long label = Count(table, row, "Label");
    Json material;
    material.Integer("label", label).Text("name", Text(table, row, "Name"));
    AddTetrahedra(material, dihedrals, "Angles_" + std::to_string(label),
      [table, row](const char* name) { return Cell(table, row, name); });
    rows.push_back("\n  " + material.Object());
  }
  return json.Add("materials", Array(rows, ",")).Object();
}

double FieldValue(vtkTable* table, const char* name)
{
  return table->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

std::string CertificateOf(vtkTable* table)
{
  return vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray("Certificate"))->GetValue(0);
}

void AddHead(const ReportInput& input, vtkTable* totals, Json& json)
{
  int dims[3];
  input.Volume->GetDimensions(dims);
  const double* spacing = input.Volume->GetSpacing();
  json.Text("input", input.Input);
  json.Add("dimensions", Array({ std::to_string(dims[0]), std::to_string(dims[1]), std::to_string(dims[2]) }));
  json.Add("spacing", Array({ Number(spacing[0]), Number(spacing[1]), Number(spacing[2]) }));
  json.Text("method", input.Method);
  const auto count = [&](const char* name) { return static_cast<long long>(FieldValue(totals, name)); };
  json.Bool("certified", count("Certified") != 0).Text("certificate", CertificateOf(totals));
  json.Integer("points", count("Points")).Integer("triangles", count("Triangles"));
  json.Real("min_radius_ratio", FieldValue(totals, "MinRadiusRatio"));
  json.Real("p1_radius_ratio", FieldValue(totals, "FirstPercentileRadiusRatio"));
  json.Real("mean_radius_ratio", FieldValue(totals, "MeanRadiusRatio"));
  json.Add(
    "worst_triangle", Worst(count("WorstTriangle"), Position(totals->GetFieldData()->GetArray("WorstPosition"), 0)));
  json.Integer("duplicate_triangles", count("DuplicateTriangles"));
  json.Integer("degenerate_triangles", count("DegenerateTriangles")).Integer("wrong_faces", count("WrongFaces"));
  if (vtkDataArray* kept = input.Mesh->GetFieldData()->GetArray("KeptFromCutting"))
  {
    json.Integer("kept_from_cutting", static_cast<long long>(kept->GetComponent(0, 0)));
  }
  json.Integer("self_intersecting_pairs", count("SelfIntersectingPairs"));
  json.Integer("self_intersecting_triangles", count("SelfIntersectingTriangles"));
  json.Integer("misclassified_voxels", count("MisclassifiedVoxels"));
  if (input.ErrorMap)
  {
    Json distances;
    distances.Real("mean", FieldValue(totals, "MeanDistanceToVoxels"));
    distances.Real("max", FieldValue(totals, "MaxDistanceToVoxels")).Integer("far_points", count("FarPoints"));
    json.Add("distance_to_voxels", distances.Object());
  }
}

void AddTail(const ReportInput& input, Json& json)
{
  Json seconds;
  for (const auto& stage : input.Seconds)
  {
    seconds.Real(stage.first, stage.second);
  }
  json.Add("seconds", seconds.Object());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  json.Integer("peak_memory_bytes", static_cast<long long>(usage.ru_maxrss) * 1024); // Linux counts in KiB
  json.Integer("threads", input.Threads).Text("version", LABELMESH_VERSION);
}

/// What was chosen where finer grids are allowed, and why; empty where none are.
std::string UpsamplingReason(const ReportInput& input)
{
  vtkFieldData* fieldData = input.Surfaces ? input.Surfaces->GetFieldData() : nullptr;
  auto* reason = fieldData ? vtkStringArray::SafeDownCast(fieldData->GetAbstractArray("UpsamplingReason")) : nullptr;
  return reason ? reason->GetValue(0) : "";
}
}

vtkSmartPointer<vtkLabelMeshReport> CheckMesh(const ReportInput& input)
{
  auto report = vtkSmartPointer<vtkLabelMeshReport>::New();
  Messages messages(report);
  report->SetInputData(0, input.Mesh);
  report->SetInputData(1, input.Volume);
  report->SetInputArrayToProcess(0, 1, 0, input.LabelAssociation, input.LabelArray.c_str());
  report->SetInputData(2, input.Surfaces);
  if (input.Particles)
  {
    report->SetInputData(3, input.Tightened);
    report->SetInputData(4, input.Particles);
  }
  if (input.Tetrahedra)
  {
    report->SetInputData(5, input.Tetrahedra);
  }
  report->SetErrorMap(input.ErrorMap ? 1 : 0);
  report->Update();
  if (!messages.FirstError().empty())
  {
    throw std::runtime_error("the mesh cannot be checked: " + messages.FirstError());
  }
  return report;
}

std::vector<std::string> Verdict(const ReportInput& input, vtkLabelMeshReport* report)
{
  std::vector<std::string> sentences{ CertificateOf(report->GetOutput(0)) };
  if (!UpsamplingReason(input).empty())
  {
    sentences.push_back("upsampling: " + UpsamplingReason(input));
  }
  std::map<std::string, std::vector<LossEntry>> byStage;
  for (const LossEntry& loss : LossesOf(input, report))
  {
    byStage[loss.Stage].push_back(loss);
  }
  for (const auto& [stage, losses] : byStage)
  {
    sentences.push_back("lost by " + stage + ": " + (losses.size() == 1 ? losses[0].What : Summary(losses)) +
      "; to keep more, " + losses[0].Advice);
  }
  return sentences;
}

std::string JsonReport(const ReportInput& input, vtkLabelMeshReport* report)
{
  vtkTable* materials = report->GetOutput(0);
  const long long background =
    static_cast<long long>(input.Mesh->GetFieldData()->GetArray("BackgroundLabel")->GetComponent(0, 0));
  std::vector<std::string> rows;
  Json json;
  AddHead(input, materials, json);
  for (vtkIdType row = 0; row < materials->GetNumberOfRows(); ++row)
  {
    if (Count(materials, row, "Label") == background)
    {
      json.Add("background", MaterialJson(materials, row));
    }
    else
    {
      rows.push_back("\n  " + MaterialJson(materials, row));
    }
  }
  json.Add("materials", Array(rows, ","));
  json.Add("interfaces", InterfacesJson(report->GetOutput(1)));
  if (!UpsamplingReason(input).empty())
  {
    Json upsampling;
    vtkDataArray* factor = input.Surfaces->GetFieldData()->GetArray("Upsampling");
    upsampling.Integer("factor", static_cast<long long>(factor->GetComponent(0, 0)));
    json.Add("upsampling", upsampling.Text("reason", UpsamplingReason(input)).Object());
  }
  if (input.Particles)
  {
    json.Add("cells", CellsJson(input.Particles));
  }
  if (input.Tetrahedra)
  {
    json.Add("tetrahedra", TetrahedraJson(report));
  }
  json.Add("lost", LostJson(LossesOf(input, report)));
  AddTail(input, json);
  return json.Object() + "\n";
}
