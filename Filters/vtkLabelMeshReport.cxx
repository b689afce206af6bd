// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMeshReport.h"

#include "Core/MeshChecks.h"
#include "FilterSupport.h"
#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

vtkStandardNewMacro(vtkLabelMeshReport);

namespace
{
using namespace LabelMesh;
using Pair = std::array<Label, 2>;

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

/// What the label image says.
struct ImageFacts
{
  bool Known = false;
  std::map<Label, double> Volumes;
  std::map<Pair, Index> Faces; ///< pairs in the order of the contract
};

ImageFacts FactsOf(vtkImageData* image, vtkDataArray* labels, bool cellData, const InterfaceData& mesh, bool listed)
{
  ImageFacts facts;
  if (!image)
  {
    return facts;
  }
  facts.Known = true;
  LabelImage volume = ReadLabelImage(image, labels, cellData);
  if (listed)
  {
    std::vector<Label> kept;
    std::transform(mesh.Materials.begin(), mesh.Materials.end(), std::back_inserter(kept),
      [](const Material& m) { return m.Label; });
    MergeIntoBackground(volume, kept, mesh.Background);
  }
  const LabelCounts counts = CountLabels(volume, mesh.Background);
  const double voxelVolume = volume.Frame.Spacing().prod();
  for (std::size_t i = 0; i < volume.Labels.size(); ++i)
  {
    facts.Volumes[volume.Labels[i]] = double(counts.Voxels[i]) * voxelVolume;
  }
  for (const LabelCounts::Contact& contact : counts.Contacts)
  {
    Pair pair = contact.Labels;
    OrderPair(pair, mesh.Background);
    facts.Faces[pair] = contact.Faces;
  }
  return facts;
}

/// Volumes by label from the field data of a collection; empty when it has none.
std::map<Label, double> FieldVolumes(vtkDataObject* object, const char* name)
{
  std::map<Label, double> volumes;
  vtkFieldData* fieldData = object ? object->GetFieldData() : nullptr;
  vtkDataArray* array = fieldData ? fieldData->GetArray(name) : nullptr;
  if (array)
  {
    const std::vector<Material> materials = ReadMaterials(fieldData);
    const std::size_t count = std::min(materials.size(), std::size_t(array->GetNumberOfValues()));
    for (std::size_t i = 0; i < count; ++i)
    {
      volumes[materials[i].Label] = array->GetVariantValue(vtkIdType(i)).ToDouble();
    }
  }
  return volumes;
}

struct MaterialRow
{
  LabelMesh::Material Material;
  MaterialCheck Check;
};

std::vector<MaterialRow> MaterialRows(const InterfaceData& mesh, const MeshCheck& check, const ImageFacts& facts)
{
  std::map<Label, MaterialRow> rows;
  for (const auto& volume : facts.Volumes)
  {
    rows[volume.first] = { DefaultMaterial(volume.first), {} };
  }
  for (std::size_t m = 0; m < mesh.Materials.size(); ++m)
  {
    rows[mesh.Materials[m].Label] = { mesh.Materials[m], check.Materials[m] };
  }
  std::vector<MaterialRow> result;
  for (const auto& row : rows)
  {
    result.push_back(row.second);
  }
  return result;
}

void AddCheckColumns(vtkTable* table, const std::vector<MaterialRow>& rows)
{
  const auto integers = [&](const char* name, Index MaterialCheck::*member)
  { AddColumn<vtkTypeInt64Array>(table, name, rows, [member](const MaterialRow& r) { return r.Check.*member; }); };
  const auto flags = [&](const char* name, bool (MaterialCheck::*flag)() const)
  { AddColumn<vtkUnsignedCharArray>(table, name, rows, [flag](const MaterialRow& r) { return (r.Check.*flag)(); }); };
  const auto qualities = [&](const char* name, double TriangleQuality::*member)
  { AddColumn<vtkDoubleArray>(table, name, rows, [member](const MaterialRow& r) { return r.Check.Quality.*member; }); };

  AddColumn<vtkTypeInt64Array>(
    table, "Triangles", rows, [](const MaterialRow& r) { return r.Check.Quality.Triangles; });
  integers("Vertices", &MaterialCheck::Vertices);
  qualities("MinRadiusRatio", &TriangleQuality::MinRadiusRatio);
  qualities("MeanRadiusRatio", &TriangleQuality::MeanRadiusRatio);
  flags("Closed", &MaterialCheck::Closed);
  flags("EdgeManifold", &MaterialCheck::EdgeManifold);
  flags("Oriented", &MaterialCheck::Oriented);
  integers("OpenEdges", &MaterialCheck::OpenEdges);
  integers("NonManifoldEdges", &MaterialCheck::NonManifoldEdges);
  integers("NonManifoldVertices", &MaterialCheck::NonManifoldVertices);
  integers("Components", &MaterialCheck::Components);
  integers("Euler", &MaterialCheck::Euler);
  qualities("Area", &TriangleQuality::Area);
  AddColumn<vtkDoubleArray>(table, "Volume", rows, [](const MaterialRow& r) { return r.Check.Volume; });
}

void AddVolumeColumn(vtkTable* table, const char* name, const std::vector<MaterialRow>& rows,
  const std::map<Label, double>& volumes, double otherwise)
{
  AddColumn<vtkDoubleArray>(table, name, rows,
    [&](const MaterialRow& r)
    {
      const auto at = volumes.find(r.Material.Label);
      return at != volumes.end() ? at->second : otherwise;
    });
}

void FillMaterials(
  vtkTable* table, const std::vector<MaterialRow>& rows, const ImageFacts& facts, vtkDataObject* stages)
{
  AddColumn<vtkTypeInt64Array>(table, "Label", rows, [](const MaterialRow& r) { return r.Material.Label; });
  AddColumn<vtkStringArray>(table, "Name", rows, [](const MaterialRow& r) { return r.Material.Name; });
  AddCheckColumns(table, rows);
  if (facts.Known)
  {
    AddVolumeColumn(table, "VoxelVolume", rows, facts.Volumes, 0.0);
  }
  const char* const fields[2][2] = { { Names::MaskVolumes, "MaskVolume" }, { Names::TightVolumes, "TightVolume" } };
  for (const auto& field : fields)
  {
    const std::map<Label, double> volumes = FieldVolumes(stages, field[0]);
    if (!volumes.empty())
    {
      AddVolumeColumn(table, field[1], rows, volumes, std::numeric_limits<double>::quiet_NaN());
    }
  }
  AddColumn<vtkUnsignedCharArray>(
    table, "Lost", rows, [](const MaterialRow& r) { return r.Check.Quality.Triangles == 0; });
}

void FillPairs(vtkTable* table, const InterfaceData& mesh, const MeshCheck& check, const ImageFacts& facts)
{
  struct Row
  {
    Pair Labels;
    TriangleQuality Quality;
    Index Faces;
  };
  std::map<Pair, Row> byPair;
  for (const auto& faces : facts.Faces)
  {
    byPair[faces.first] = { faces.first, {}, faces.second };
  }
  for (const PairCheck& pairCheck : check.Pairs)
  {
    Pair pair = { mesh.Materials[pairCheck.Materials[0]].Label, mesh.Materials[pairCheck.Materials[1]].Label };
    OrderPair(pair, mesh.Background);
    const auto faces = facts.Faces.find(pair);
    byPair[pair] = { pair, pairCheck.Quality, faces != facts.Faces.end() ? faces->second : 0 };
  }
  std::vector<Row> rows;
  for (const auto& row : byPair)
  {
    rows.push_back(row.second);
  }
  AddColumn<vtkTypeInt64Array>(table, "LabelA", rows, [](const Row& r) { return r.Labels[0]; });
  AddColumn<vtkTypeInt64Array>(table, "LabelB", rows, [](const Row& r) { return r.Labels[1]; });
  AddColumn<vtkTypeInt64Array>(table, "Triangles", rows, [](const Row& r) { return r.Quality.Triangles; });
  AddColumn<vtkDoubleArray>(table, "Area", rows, [](const Row& r) { return r.Quality.Area; });
  AddColumn<vtkDoubleArray>(table, "MinRadiusRatio", rows, [](const Row& r) { return r.Quality.MinRadiusRatio; });
  AddColumn<vtkDoubleArray>(table, "MeanRadiusRatio", rows, [](const Row& r) { return r.Quality.MeanRadiusRatio; });
  if (facts.Known)
  {
    AddColumn<vtkTypeInt64Array>(table, "VoxelFaces", rows, [](const Row& r) { return r.Faces; });
  }
  AddColumn<vtkUnsignedCharArray>(table, "Lost", rows, [](const Row& r) { return r.Quality.Triangles == 0; });
}

void AddTotals(vtkFieldData* fieldData, const MeshCheck& check)
{
  const std::pair<const char*, Index> counts[] = { { "Points", check.Vertices },
    { "Triangles", check.Quality.Triangles }, { "DuplicateTriangles", check.DuplicateTriangles },
    { "DegenerateTriangles", check.DegenerateTriangles }, { "SameLabelTriangles", check.SameMaterialTriangles },
    { "WrongFaces", check.WrongFaces } };
  for (const auto& count : counts)
  {
    vtkNew<vtkTypeInt64Array> array;
    array->SetName(count.first);
    array->InsertNextValue(count.second);
    fieldData->AddArray(array);
  }
  const std::pair<const char*, double> ratios[] = { { "MinRadiusRatio", check.Quality.MinRadiusRatio },
    { "FirstPercentileRadiusRatio", check.FirstPercentileRatio },
    { "MeanRadiusRatio", check.Quality.MeanRadiusRatio } };
  for (const auto& ratio : ratios)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(ratio.first);
    array->InsertNextValue(ratio.second);
    fieldData->AddArray(array);
  }
}
}

vtkLabelMeshReport::vtkLabelMeshReport()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

int vtkLabelMeshReport::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkPolyData", "vtkImageData", "vtkDataObject" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkLabelMeshReport::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Counting needs the whole image, whatever part of a table is asked for.
  if (vtkInformation* info = inputVector[1]->GetInformationObject(0))
  {
    if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

int vtkLabelMeshReport::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkImageData* image = vtkImageData::GetData(inputVector[1], 0);
  vtkDataObject* stages = vtkDataObject::GetData(inputVector[2], 0);
  vtkTable* materialTable = vtkTable::GetData(outputVector, 0);
  vtkTable* pairTable = vtkTable::GetData(outputVector, 1);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      const InterfaceData mesh = ReadInterface(input);
      const bool listed = input->GetFieldData()->GetAbstractArray(Names::Labels) != nullptr;
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      vtkDataArray* labels = image ? this->GetInputArrayToProcess(0, inputVector, association) : nullptr;
      const ImageFacts facts =
        FactsOf(image, labels, association == vtkDataObject::FIELD_ASSOCIATION_CELLS, mesh, listed);
      monitor.Step(0.3, "Checking the mesh");
      const MeshCheck check = CheckMesh(mesh.Points, mesh.Triangles, int(mesh.Materials.size()), mesh.Sets);
      monitor.Step(0.9);
      FillMaterials(materialTable, MaterialRows(mesh, check, facts), facts, stages);
      FillPairs(pairTable, mesh, check, facts);
      AddTotals(materialTable->GetFieldData(), check);
      AddTotals(pairTable->GetFieldData(), check);
      monitor.Step(1.0);
    });
}

void vtkLabelMeshReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
