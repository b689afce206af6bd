// SPDX-License-Identifier: BSD-3-Clause
#include "ReportTables.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace LabelMesh
{
namespace
{
template <typename Array, typename Container, typename Get>
void AddColumn(vtkTable* table, const char* name, const Container& rows, const Get& get)
{
  vtkNew<Array> column;
  column->SetName(name);
  for (const auto& row : rows)
  {
    column->InsertNextValue(get(row));
  }
  table->AddColumn(column);
}

/// A column of positions, NaN where there is none.
template <typename Container, typename Get>
void AddPositions(vtkTable* table, const char* name, const Container& rows, const Get& get)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->SetNumberOfComponents(3);
  for (const auto& row : rows)
  {
    column->InsertNextTuple(get(row).data());
  }
  table->AddColumn(column);
}

const Vec3 Nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

Vec3 CenterOf(const InterfaceData& mesh, Index triangle)
{
  if (triangle < 0)
  {
    return Nowhere;
  }
  const std::array<Index, 3>& v = mesh.Triangles[triangle].Vertices;
  return (mesh.Points[v[0]] + mesh.Points[v[1]] + mesh.Points[v[2]]) / 3.0;
}

Vec3 PositionOfSample(const GridFrame& frame, Index sample)
{
  if (sample < 0)
  {
    return Nowhere;
  }
  const std::array<int, 3> at = frame.Samples().Coordinates(sample);
  const std::array<int, 6>& extent = frame.Extent();
  return frame.ToWorld(extent[0] + at[0], extent[2] + at[1], extent[4] + at[2]);
}

std::string InWords(const Vec3& position)
{
  char text[100];
  std::snprintf(text, sizeof(text), "(%.6g, %.6g, %.6g)", position[0], position[1], position[2]);
  return text;
}

std::string Counted(Index count, const std::string& one, const std::string& many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

bool IsBackground(const ReportFacts& facts, MaterialId m)
{
  return m == facts.Background;
}

/// Parts of a material in the mesh: the background has one more, around everything.
Index PartsOf(const ReportFacts& facts, MaterialId m)
{
  return facts.Check.Materials[m].OuterShells + (IsBackground(facts, m) ? 1 : 0);
}

/// Genus means something for closed manifolds only; -1 elsewhere.
Index GenusOf(const MaterialCheck& check)
{
  return check.Manifold() ? check.Genus() : -1;
}

std::vector<MaterialId> MaterialRows(const ReportFacts& facts)
{
  std::vector<MaterialId> rows;
  for (std::size_t m = 0; m < facts.Mesh.Materials.size(); ++m)
  {
    if (facts.ShowBackground || !IsBackground(facts, MaterialId(m)))
    {
      rows.push_back(MaterialId(m));
    }
  }
  return rows;
}

void AddCheckColumns(vtkTable* table, const std::vector<MaterialId>& rows, const ReportFacts& facts)
{
  const std::vector<MaterialCheck>& checks = facts.Check.Materials;
  const auto integers = [&](const char* name, Index MaterialCheck::*member)
  { AddColumn<vtkTypeInt64Array>(table, name, rows, [&checks, member](MaterialId m) { return checks[m].*member; }); };
  const auto flags = [&](const char* name, bool (MaterialCheck::*flag)() const) {
    AddColumn<vtkUnsignedCharArray>(table, name, rows, [&checks, flag](MaterialId m) { return (checks[m].*flag)(); });
  };
  const auto reals = [&](const char* name, double TriangleQuality::*member)
  {
    AddColumn<vtkDoubleArray>(table, name, rows, [&checks, member](MaterialId m) { return checks[m].Quality.*member; });
  };

  AddColumn<vtkTypeInt64Array>(table, "Triangles", rows, [&](MaterialId m) { return checks[m].Quality.Triangles; });
  integers("Vertices", &MaterialCheck::Vertices);
  reals("MinRadiusRatio", &TriangleQuality::MinRadiusRatio);
  reals("MeanRadiusRatio", &TriangleQuality::MeanRadiusRatio);
  flags("Certified", &MaterialCheck::Sound);
  flags("Closed", &MaterialCheck::Closed);
  flags("EdgeManifold", &MaterialCheck::EdgeManifold);
  flags("VertexManifold", &MaterialCheck::VertexManifold);
  flags("Oriented", &MaterialCheck::Oriented);
  integers("OpenEdges", &MaterialCheck::OpenEdges);
  integers("NonManifoldEdges", &MaterialCheck::NonManifoldEdges);
  integers("NonManifoldVertices", &MaterialCheck::NonManifoldVertices);
  integers("MisorientedEdges", &MaterialCheck::MisorientedEdges);
  integers("SelfIntersections", &MaterialCheck::SelfIntersections);
  integers("Components", &MaterialCheck::Components);
  integers("Euler", &MaterialCheck::Euler);
  AddColumn<vtkTypeInt64Array>(table, "Genus", rows, [&](MaterialId m) { return GenusOf(checks[m]); });
  AddColumn<vtkTypeInt64Array>(table, "Parts", rows, [&](MaterialId m) { return PartsOf(facts, m); });
  integers("Cavities", &MaterialCheck::InnerShells);
  reals("Area", &TriangleQuality::Area);
  AddColumn<vtkDoubleArray>(table, "Volume", rows, [&](MaterialId m) { return checks[m].Volume; });
  AddColumn<vtkTypeInt64Array>(table, "WorstTriangle", rows, [&](MaterialId m) { return checks[m].Quality.Worst; });
  AddPositions(
    table, "WorstPosition", rows, [&](MaterialId m) { return CenterOf(facts.Mesh, checks[m].Quality.Worst); });
}

void AddVoxelColumns(vtkTable* table, const std::vector<MaterialId>& rows, const ReportFacts& facts)
{
  const VolumeFacts& volume = facts.Volume;
  const std::vector<VoxelObject>& objects = volume.Voxels.Objects;
  const double voxelVolume = volume.Frame.Spacing().prod();
  const auto integers = [&](const char* name, Index VoxelObject::*member)
  { AddColumn<vtkTypeInt64Array>(table, name, rows, [&objects, member](MaterialId m) { return objects[m].*member; }); };
  AddColumn<vtkDoubleArray>(
    table, "VoxelVolume", rows, [&](MaterialId m) { return double(objects[m].Voxels) * voxelVolume; });
  integers("Voxels", &VoxelObject::Voxels);
  integers("VoxelComponents", &VoxelObject::Shells);
  integers("VoxelEuler", &VoxelObject::Euler);
  AddColumn<vtkTypeInt64Array>(table, "VoxelGenus", rows, [&](MaterialId m) { return objects[m].Genus(); });
  integers("VoxelParts", &VoxelObject::Parts);
  integers("VoxelCavities", &VoxelObject::Cavities);
  AddColumn<vtkTypeInt64Array>(table, "LostParts", rows, [&](MaterialId m) { return volume.LostParts[m]; });
  AddColumn<vtkTypeInt64Array>(
    table, "MisclassifiedVoxels", rows, [&](MaterialId m) { return volume.Misclassified[m]; });
}

struct InterfaceRow
{
  std::array<Label, 2> Labels{ 0, 0 };
  TriangleQuality Quality;
  Index Faces = 0;
};

std::vector<InterfaceRow> InterfaceRows(const ReportFacts& facts)
{
  std::map<std::array<Label, 2>, InterfaceRow> rows;
  const auto rowOf = [&](const std::array<MaterialId, 2>& ids) -> InterfaceRow&
  {
    std::array<Label, 2> pair{ facts.Mesh.Materials[ids[0]].Label, facts.Mesh.Materials[ids[1]].Label };
    OrderPair(pair, facts.Mesh.Background);
    InterfaceRow& row = rows[pair];
    row.Labels = pair;
    return row;
  };
  for (const VoxelContact& contact : facts.Volume.Voxels.Contacts)
  {
    rowOf(contact.Ids).Faces = contact.Faces;
  }
  for (const PairCheck& pair : facts.Check.Pairs)
  {
    rowOf(pair.Materials).Quality = pair.Quality;
  }
  std::vector<InterfaceRow> result;
  for (const auto& row : rows)
  {
    result.push_back(row.second);
  }
  return result;
}

const char* NameOf(LossStage stage)
{
  switch (stage)
  {
    case LossStage::Split:
      return "LabelSplit";
    case LossStage::AfterSplit:
      return "Tighten or later";
    case LossStage::Tighten:
      return "Tighten";
    case LossStage::AfterTighten:
      return "ParticleSampleCells or later";
    case LossStage::Sample:
      return "ParticleSampleCells";
    case LossStage::Mesh:
      return "DelaunayLabelMesh";
    default:
      return "";
  }
}

std::string LabelOf(const ReportFacts& facts, MaterialId m)
{
  return std::to_string(facts.Mesh.Materials[m].Label);
}

std::string WhatWasLost(const Loss& loss, const ReportFacts& facts)
{
  const std::string label = LabelOf(facts, loss.Materials[0]);
  if (loss.Kind == Loss::TouchingPair)
  {
    return "the labels " + label + " and " + LabelOf(facts, loss.Materials[1]) + " touch in " +
      Counted(loss.Voxels, "face", "faces") + " of voxels, but no triangle lies between them";
  }
  const std::string place = InWords(PositionOfSample(facts.Volume.Frame, loss.Sample));
  const std::string where =
    loss.Parts == 1 ? "at " + place : "the largest part has " + std::to_string(loss.Largest) + ", at " + place;
  if (loss.Kind == Loss::Dropped)
  {
    return "a component of label " + label + " with " + Counted(loss.Voxels, "voxel", "voxels") + ", at " + place +
      ", was dropped on request and given to label " + LabelOf(facts, loss.Materials[1]);
  }
  if (loss.Kind == Loss::WholeLabel)
  {
    return "no triangle has label " + label + "; it has " + Counted(loss.Voxels, "voxel", "voxels") + " in " +
      Counted(loss.Parts, "part", "parts") + ", " + where;
  }
  return Counted(loss.Parts, "part", "parts") + " of the " +
    std::to_string(facts.Volume.Voxels.Objects[loss.Materials[0]].Parts) + " of label " + label +
    (loss.Parts == 1 ? " is" : " are") + " not in the mesh: " + Counted(loss.Voxels, "voxel", "voxels") + ", " + where;
}

/// In the order of what helps most: parts of one or two voxels are beyond any smoothing, until voxels are finer.
std::string AdviceOn(const Loss& loss, const ReportFacts& facts)
{
  const std::string label = LabelOf(facts, loss.Materials[0]);
  if (loss.Kind == Loss::Dropped)
  {
    return "drop only what is smaller (MinimumComponentSize of Label Split, or --min-component)";
  }
  const std::string finer = "mesh a volume of finer voxels (each repeated three times along every axis, or "
                            "ResamplingFactor of Label Split)";
  const std::string smoother = "smooth less (Radius of Tighten, --radius, or --material " + label + ":radius=R)";
  const std::string shorter =
    "shorten the edges there (Epsilon of Sizing Field, --epsilon, or --material " + label + ":max-length=L)";
  switch (loss.Stage)
  {
    case LossStage::Split:
      return "open less (OpeningRadius of Label Split, or --material " + label + ":opening=R)";
    case LossStage::Tighten:
      return finer + ", or " + smoother;
    case LossStage::AfterTighten:
    case LossStage::Sample:
    case LossStage::Mesh:
      return shorter + ", or " + finer;
    default:
      return finer + ", smooth less, or make more triangles";
  }
}

/// Counts one kind of fault over the materials, and names those that have it.
std::string FaultOf(
  const ReportFacts& facts, Index MaterialCheck::*member, const std::string& one, const std::string& many)
{
  constexpr int most = 5; // labels that are named
  Index count = 0;
  int named = 0;
  std::string labels;
  for (std::size_t m = 0; m < facts.Check.Materials.size(); ++m)
  {
    const Index own = facts.Check.Materials[m].*member;
    count += own;
    if (own > 0 && ++named <= most)
    {
      labels += (labels.empty() ? "" : ", ") + LabelOf(facts, MaterialId(m));
    }
  }
  if (count == 0)
  {
    return "";
  }
  return Counted(count, one, many) + (named == 1 ? " of the surface of label " : " of the surfaces of labels ") +
    labels + (named > most ? ", ..." : "");
}

std::vector<std::string> FaultsOf(const ReportFacts& facts)
{
  const MeshCheck& check = facts.Check;
  std::vector<std::string> faults{ FaultOf(facts, &MaterialCheck::OpenEdges, "open edge", "open edges"),
    FaultOf(facts, &MaterialCheck::NonManifoldEdges, "non-manifold edge", "non-manifold edges"),
    FaultOf(facts, &MaterialCheck::NonManifoldVertices, "non-manifold vertex", "non-manifold vertices"),
    FaultOf(facts, &MaterialCheck::MisorientedEdges, "misoriented edge", "misoriented edges") };
  if (check.SelfIntersectingPairs > 0)
  {
    faults.push_back(
      Counted(check.SelfIntersectingPairs, "pair of triangles intersects", "pairs of triangles intersect") +
      ", the first at " + InWords(CenterOf(facts.Mesh, check.FirstIntersecting)));
  }
  const auto add = [&faults](Index count, const std::string& one, const std::string& many)
  { faults.push_back(count > 0 ? Counted(count, one, many) : ""); };
  add(check.DuplicateTriangles, "duplicate triangle", "duplicate triangles");
  add(check.DegenerateTriangles, "degenerate triangle", "degenerate triangles");
  add(check.SameMaterialTriangles, "triangle with one label on both sides", "triangles with one label on both sides");
  add(check.WrongFaces, "triangle whose labels do not meet at its vertices",
    "triangles whose labels do not meet at their vertices");
  faults.erase(std::remove(faults.begin(), faults.end(), ""), faults.end());
  return faults;
}

template <typename Array, typename Value>
void AddValue(vtkFieldData* fieldData, const char* name, const Value& value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fieldData->AddArray(array);
}
}

void FillMaterials(vtkTable* table, const ReportFacts& facts)
{
  const std::vector<MaterialId> rows = MaterialRows(facts);
  AddColumn<vtkTypeInt64Array>(table, "Label", rows, [&](MaterialId m) { return facts.Mesh.Materials[m].Label; });
  AddColumn<vtkStringArray>(table, "Name", rows, [&](MaterialId m) { return facts.Mesh.Materials[m].Name; });
  AddCheckColumns(table, rows, facts);
  if (facts.HasVolume)
  {
    AddVoxelColumns(table, rows, facts);
  }
  const std::pair<const char*, const std::vector<double>&> stages[] = { { "MaskVolume", facts.MaskVolumes },
    { "TightVolume", facts.TightVolumes } };
  for (const auto& stage : stages)
  {
    if (!stage.second.empty())
    {
      AddColumn<vtkDoubleArray>(table, stage.first, rows, [&stage](MaterialId m) { return stage.second[m]; });
    }
  }
  AddColumn<vtkUnsignedCharArray>(
    table, "Lost", rows, [&](MaterialId m) { return facts.Check.Materials[m].Quality.Triangles == 0; });
}

void FillInterfaces(vtkTable* table, const ReportFacts& facts)
{
  using Row = InterfaceRow;
  const std::vector<Row> rows = InterfaceRows(facts);
  AddColumn<vtkTypeInt64Array>(table, "LabelA", rows, [](const Row& r) { return r.Labels[0]; });
  AddColumn<vtkTypeInt64Array>(table, "LabelB", rows, [](const Row& r) { return r.Labels[1]; });
  AddColumn<vtkTypeInt64Array>(table, "Triangles", rows, [](const Row& r) { return r.Quality.Triangles; });
  AddColumn<vtkDoubleArray>(table, "Area", rows, [](const Row& r) { return r.Quality.Area; });
  AddColumn<vtkDoubleArray>(table, "MinRadiusRatio", rows, [](const Row& r) { return r.Quality.MinRadiusRatio; });
  AddColumn<vtkDoubleArray>(table, "MeanRadiusRatio", rows, [](const Row& r) { return r.Quality.MeanRadiusRatio; });
  AddColumn<vtkTypeInt64Array>(table, "WorstTriangle", rows, [](const Row& r) { return r.Quality.Worst; });
  AddPositions(table, "WorstPosition", rows, [&](const Row& r) { return CenterOf(facts.Mesh, r.Quality.Worst); });
  if (facts.HasVolume)
  {
    AddColumn<vtkTypeInt64Array>(table, "VoxelFaces", rows, [](const Row& r) { return r.Faces; });
  }
  AddColumn<vtkUnsignedCharArray>(table, "Lost", rows, [](const Row& r) { return r.Quality.Triangles == 0; });
}

void FillLosses(vtkTable* table, const ReportFacts& facts)
{
  static const char* const kinds[] = { "label", "parts", "dropped", "pair" };
  const std::vector<Loss>& rows = facts.Volume.Losses;
  const auto pairOf = [&](const Loss& loss)
  {
    const bool pair = loss.Kind == Loss::TouchingPair || loss.Kind == Loss::Dropped;
    std::array<Label, 2> labels{ facts.Mesh.Materials[loss.Materials[0]].Label,
      facts.Mesh.Materials[loss.Materials[pair ? 1 : 0]].Label };
    if (loss.Kind == Loss::TouchingPair)
    {
      OrderPair(labels, facts.Mesh.Background);
    }
    return labels;
  };
  AddColumn<vtkStringArray>(table, "Kind", rows, [](const Loss& loss) { return kinds[loss.Kind]; });
  AddColumn<vtkTypeInt64Array>(table, "LabelA", rows, [&](const Loss& loss) { return pairOf(loss)[0]; });
  AddColumn<vtkTypeInt64Array>(table, "LabelB", rows, [&](const Loss& loss) { return pairOf(loss)[1]; });
  AddColumn<vtkStringArray>(table, "Stage", rows, [](const Loss& loss) { return NameOf(loss.Stage); });
  AddColumn<vtkTypeInt64Array>(table, "Parts", rows, [](const Loss& loss) { return loss.Parts; });
  AddColumn<vtkTypeInt64Array>(table, "Voxels", rows, [](const Loss& loss) { return loss.Voxels; });
  AddPositions(
    table, "Position", rows, [&](const Loss& loss) { return PositionOfSample(facts.Volume.Frame, loss.Sample); });
  AddColumn<vtkStringArray>(table, "What", rows, [&](const Loss& loss) { return WhatWasLost(loss, facts); });
  AddColumn<vtkStringArray>(table, "Advice", rows, [&](const Loss& loss) { return AdviceOn(loss, facts); });
}

void AddTotals(vtkFieldData* fieldData, const ReportFacts& facts)
{
  const MeshCheck& check = facts.Check;
  std::vector<std::pair<const char*, Index>> counts{ { "Points", check.Vertices },
    { "Triangles", check.Quality.Triangles }, { "DuplicateTriangles", check.DuplicateTriangles },
    { "DegenerateTriangles", check.DegenerateTriangles }, { "SameLabelTriangles", check.SameMaterialTriangles },
    { "WrongFaces", check.WrongFaces }, { "SelfIntersectingPairs", check.SelfIntersectingPairs },
    { "SelfIntersectingTriangles", check.SelfIntersectingTriangles }, { "WorstTriangle", check.Quality.Worst },
    { "Certified", facts.Certified() ? 1 : 0 } };
  if (facts.HasVolume)
  {
    const std::vector<Index>& wrong = facts.Volume.Misclassified;
    Index misclassified = 0;
    std::for_each(wrong.begin(), wrong.end(), [&](Index count) { misclassified += count; });
    counts.emplace_back("MisclassifiedVoxels", misclassified);
    counts.emplace_back("UndecidedVoxels", facts.Volume.Undecided);
  }
  for (const auto& count : counts)
  {
    AddValue<vtkTypeInt64Array>(fieldData, count.first, count.second);
  }
  AddValue<vtkDoubleArray>(fieldData, "MinRadiusRatio", check.Quality.MinRadiusRatio);
  AddValue<vtkDoubleArray>(fieldData, "FirstPercentileRadiusRatio", check.FirstPercentileRatio);
  AddValue<vtkDoubleArray>(fieldData, "MeanRadiusRatio", check.Quality.MeanRadiusRatio);
  vtkNew<vtkDoubleArray> position;
  position->SetName("WorstPosition");
  position->SetNumberOfComponents(3);
  position->InsertNextTuple(CenterOf(facts.Mesh, check.Quality.Worst).data());
  fieldData->AddArray(position);
  AddValue<vtkStringArray>(fieldData, "Certificate", CertificateOf(facts));
}

void AddDistances(vtkFieldData* fieldData, const std::vector<double>& distances)
{
  double sum = 0.0, largest = 0.0;
  Index far = 0;
  for (const double distance : distances)
  {
    if (std::isnan(distance))
    {
      ++far;
      continue;
    }
    sum += distance;
    largest = std::max(largest, distance);
  }
  const Index near = Index(distances.size()) - far;
  AddValue<vtkDoubleArray>(fieldData, "MeanDistanceToVoxels", near > 0 ? sum / double(near) : 0.0);
  AddValue<vtkDoubleArray>(fieldData, "MaxDistanceToVoxels", largest);
  AddValue<vtkTypeInt64Array>(fieldData, "FarPoints", far);
}

std::string CertificateOf(const ReportFacts& facts)
{
  const TriangleQuality& quality = facts.Check.Quality;
  if (quality.Triangles == 0)
  {
    return "not certified: there is no triangle";
  }
  char ratio[40];
  std::snprintf(ratio, sizeof(ratio), "%.3f", quality.MinRadiusRatio);
  const std::string worst = std::string("worst radius ratio ") + ratio + " at " +
    InWords(CenterOf(facts.Mesh, quality.Worst)) + ", triangle " + std::to_string(quality.Worst);
  if (facts.Certified())
  {
    return "certified: " + Counted(quality.Triangles, "triangle", "triangles") +
      ", closed, manifold, oriented and without self-intersections around every label; " + worst;
  }
  std::string text = "not certified: ";
  for (const std::string& fault : FaultsOf(facts))
  {
    text += fault + "; ";
  }
  return text + worst;
}
}
