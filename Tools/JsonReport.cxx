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
#include <vtkTable.h>
#include <vtkVariant.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
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

std::string MaterialJson(vtkTable* table, vtkIdType row)
{
  const auto count = [&](const char* column) { return Count(table, row, column); };
  Json json;
  json.Integer("label", count("Label")).Text("name", table->GetValueByName(row, "Name").ToString());
  json.Integer("triangles", count("Triangles")).Integer("vertices", count("Vertices"));
  json.Real("min_radius_ratio", Cell(table, row, "MinRadiusRatio"));
  json.Real("mean_radius_ratio", Cell(table, row, "MeanRadiusRatio"));
  json.Bool("closed", count("Closed") != 0);
  json.Bool("manifold", count("EdgeManifold") != 0 && count("NonManifoldVertices") == 0);
  json.Bool("oriented", count("Oriented") != 0);
  json.Integer("open_edges", count("OpenEdges")).Integer("nonmanifold_edges", count("NonManifoldEdges"));
  json.Integer("nonmanifold_vertices", count("NonManifoldVertices"));
  json.Integer("components", count("Components")).Integer("euler", count("Euler"));
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

/// Which labels meet at some particle, alone and two by two.
struct Sampled
{
  std::set<long long> Labels;
  std::set<std::pair<long long, long long>> Pairs;
  std::array<long long, 3> CellCounts{ 0, 0, 0 };

  explicit Sampled(vtkPolyData* particles)
  {
    vtkPointData* data = particles->GetPointData();
    vtkDataArray* sets = data->GetArray("Materials");
    vtkDataArray* numbers = data->GetArray("NumberOfMaterials");
    vtkDataArray* dimensions = data->GetArray("CellDimension");
    for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
    {
      ++this->CellCounts.at(static_cast<std::size_t>(dimensions->GetComponent(i, 0)));
      const int number = static_cast<int>(numbers->GetComponent(i, 0));
      for (int a = 0; a < number; ++a)
      {
        const auto label = static_cast<long long>(sets->GetComponent(i, a));
        this->Labels.insert(label);
        for (int b = 0; b < a; ++b)
        {
          this->Pairs.emplace(static_cast<long long>(sets->GetComponent(i, b)), label);
        }
      }
    }
  }
};

/// The first stage after which the label is gone.
std::string StageOfLostLabel(vtkTable* table, vtkIdType row, const Sampled* sampled)
{
  if (!sampled)
  {
    return "GridLabelMesh";
  }
  if (table->GetColumnByName("MaskVolume") && !(Cell(table, row, "MaskVolume") > 0))
  {
    return "LabelSplit";
  }
  if (table->GetColumnByName("TightVolume") && !(Cell(table, row, "TightVolume") > 0))
  {
    return "Tighten";
  }
  return sampled->Labels.count(Count(table, row, "Label")) == 0 ? "ParticleSampleCells" : "DelaunayLabelMesh";
}

std::vector<std::string> LostLabels(vtkTable* table, const ReportInput& input, const Sampled* sampled)
{
  std::vector<std::string> lost;
  std::set<long long> listed;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const long long label = Count(table, row, "Label");
    listed.insert(label);
    if (Count(table, row, "Lost"))
    {
      Json json;
      json.Integer("label", label).Text("stage", StageOfLostLabel(table, row, sampled));
      json.Text(
        "what", "no triangle has this label; its voxels have a volume of " + Number(Cell(table, row, "VoxelVolume")));
      lost.push_back(json.Object());
    }
  }
  for (const long long label : input.Labels)
  {
    if (listed.count(label) == 0)
    {
      lost.push_back(
        Json().Integer("label", label).Text("stage", "LabelSplit").Text("what", "no mask was made").Object());
    }
  }
  return lost;
}

std::vector<std::string> LostPairs(vtkTable* table, const Sampled* sampled)
{
  std::vector<std::string> lost;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    if (!Count(table, row, "Lost"))
    {
      continue;
    }
    const long long a = Count(table, row, "LabelA"), b = Count(table, row, "LabelB");
    // Particles see every contact that smoothing has left.
    const bool seen = sampled && sampled->Pairs.count(std::minmax(a, b)) > 0;
    Json json;
    json.Add("labels", "[" + std::to_string(a) + ", " + std::to_string(b) + "]");
    json.Text("stage", !sampled ? "GridLabelMesh" : seen ? "DelaunayLabelMesh" : "Tighten");
    json.Text("what",
      "the two labels touch in " + std::to_string(Count(table, row, "VoxelFaces")) +
        " faces of voxels, but no triangle lies between them");
    lost.push_back(json.Object());
  }
  return lost;
}

std::string CellsJson(const Sampled& sampled)
{
  Json json;
  for (int d = 0; d < 3; ++d)
  {
    json.Integer(std::to_string(d), sampled.CellCounts[d]);
  }
  return json.Object();
}

double FieldValue(vtkTable* table, const char* name)
{
  return table->GetFieldData()->GetArray(name)->GetComponent(0, 0);
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
  json.Integer("points", static_cast<long long>(FieldValue(totals, "Points")));
  json.Integer("triangles", static_cast<long long>(FieldValue(totals, "Triangles")));
  json.Real("min_radius_ratio", FieldValue(totals, "MinRadiusRatio"));
  json.Real("p1_radius_ratio", FieldValue(totals, "FirstPercentileRadiusRatio"));
  json.Real("mean_radius_ratio", FieldValue(totals, "MeanRadiusRatio"));
  json.Integer("duplicate_triangles", static_cast<long long>(FieldValue(totals, "DuplicateTriangles")));
  json.Integer("wrong_faces", static_cast<long long>(FieldValue(totals, "WrongFaces")));
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
}

std::string JsonReport(const ReportInput& input)
{
  vtkNew<vtkLabelMeshReport> report;
  Messages messages(report);
  report->SetInputData(0, input.Mesh);
  report->SetInputData(1, input.Volume);
  report->SetInputArrayToProcess(0, 1, 0, input.LabelAssociation, input.LabelArray.c_str());
  report->SetInputData(2, input.Surfaces);
  report->Update();
  if (!messages.FirstError().empty())
  {
    throw std::runtime_error("the mesh cannot be checked: " + messages.FirstError());
  }
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
  std::optional<Sampled> sampled;
  if (input.Particles)
  {
    sampled.emplace(input.Particles);
    json.Add("cells", CellsJson(*sampled));
  }
  std::vector<std::string> lost = LostLabels(materials, input, sampled ? &*sampled : nullptr);
  const std::vector<std::string> pairs = LostPairs(report->GetOutput(1), sampled ? &*sampled : nullptr);
  lost.insert(lost.end(), pairs.begin(), pairs.end());
  json.Add("lost", Array(lost));
  AddTail(input, json);
  return json.Object() + "\n";
}
