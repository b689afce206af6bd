// SPDX-License-Identifier: BSD-3-Clause
#include "IndicatorCollection.h"

#include "LabelMeshNames.h"
#include "ServerPieces.h"

#include <vtkDataArray.h>
#include <vtkDataAssembly.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>

#include <algorithm>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::invalid_argument(sentence);
}

// The keys register themselves with VTK, which deletes them at the end.
vtkInformationIntegerVectorKey* FrameExtentKey() // extent and padding
{
  static vtkInformationIntegerVectorKey* const key = new vtkInformationIntegerVectorKey("FRAME_EXTENT", "LabelMesh", 7);
  return key;
}
vtkInformationDoubleVectorKey* FrameGeometryKey() // origin, spacing, direction row by row
{
  static vtkInformationDoubleVectorKey* const key =
    new vtkInformationDoubleVectorKey("FRAME_GEOMETRY", "LabelMesh", 15);
  return key;
}

Mat3 DirectionFrom(const double* rows)
{
  Mat3 direction;
  for (int i = 0; i < 9; ++i)
  {
    direction(i / 3, i % 3) = rows[i];
  }
  return direction;
}

std::array<double, 9> RowsOf(const Mat3& direction)
{
  std::array<double, 9> rows;
  for (int i = 0; i < 9; ++i)
  {
    rows[i] = direction(i / 3, i % 3);
  }
  return rows;
}

void AddNumbers(
  vtkFieldData* fieldData, const char* name, vtkDataArray* array, int components, const double* values, int n)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(n / components);
  for (int i = 0; i < n; ++i)
  {
    array->SetComponent(i / components, i % components, values[i]);
  }
  fieldData->AddArray(array);
}

/// The first `n` numbers of a field array, across its tuples.
std::vector<double> Numbers(vtkFieldData* fieldData, const char* name, Index n)
{
  vtkDataArray* array = fieldData ? fieldData->GetArray(name) : nullptr;
  if (!array || array->GetNumberOfValues() < n)
  {
    Fail(std::string("The collection has no field data '") + name + "' with " + std::to_string(n) +
      " values. Connect the output of Label Split, Tighten or Indicator Reconstruct.");
  }
  std::vector<double> numbers;
  for (Index i = 0; i < n; ++i)
  {
    numbers.push_back(array->GetVariantValue(i).ToDouble());
  }
  return numbers;
}

GridFrame ReadFrame(vtkFieldData* fieldData)
{
  const std::vector<double> e = Numbers(fieldData, Names::SourceExtent, 6);
  const std::vector<double> o = Numbers(fieldData, Names::SourceOrigin, 3);
  const std::vector<double> s = Numbers(fieldData, Names::VoxelSize, 3);
  const std::vector<double> d = Numbers(fieldData, Names::SourceDirection, 9);
  return GridFrame({ int(e[0]), int(e[1]), int(e[2]), int(e[3]), int(e[4]), int(e[5]) }, Vec3(o[0], o[1], o[2]),
    Vec3(s[0], s[1], s[2]), DirectionFrom(d.data()));
}

/// The filter whose output has this array.
std::string MakerOf(const std::string& arrayName)
{
  return arrayName == Names::Mask       ? "Label Split"
    : arrayName == Names::TightDistance ? "Tighten"
    : arrayName == Names::Indicator     ? "Indicator Reconstruct"
                                        : "the filter that makes '" + arrayName + "'";
}

std::string BlockName(vtkPartitionedDataSetCollection* collection, unsigned int n)
{
  vtkInformation* info = collection->HasMetaData(n) ? collection->GetMetaData(n) : nullptr;
  const char* name = info ? info->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name ? name : "block " + std::to_string(n);
}

LabelMesh::Label BlockLabel(vtkPartitionedDataSetCollection* collection, unsigned int n)
{
  vtkDataArray* label = BlockImage(collection, n)->GetFieldData()->GetArray(Names::Label);
  if (!label || label->GetNumberOfValues() < 1)
  {
    Fail("Block '" + BlockName(collection, n) + "' has no field data '" + Names::Label +
      "'. Connect the output of Label Split, Tighten or Indicator Reconstruct.");
  }
  return label->GetVariantValue(0).ToTypeInt64();
}

/// Appends a block with a material's name, label and colour.
void AppendImage(vtkPartitionedDataSetCollection* collection, const Material& material, vtkImageData* image)
{
  vtkNew<vtkTypeInt64Array> label;
  label->SetName(Names::Label);
  label->InsertNextValue(material.Label);
  image->GetFieldData()->AddArray(label);
  AddNumbers(image->GetFieldData(), Names::Color, vtkNew<vtkDoubleArray>(), 3, material.Color.data(), 3);

  const unsigned int n = collection->GetNumberOfPartitionedDataSets();
  collection->SetNumberOfPartitionedDataSets(n + 1);
  collection->SetPartition(n, 0, image);
  collection->GetMetaData(n)->Set(vtkCompositeDataSet::NAME(), material.Name.c_str());
  vtkDataAssembly* assembly = collection->GetDataAssembly();
  if (!assembly)
  {
    vtkNew<vtkDataAssembly> created;
    created->SetRootNodeName(Names::IndicatorsRoot);
    collection->SetDataAssembly(created);
    assembly = created;
  }
  const int node = assembly->AddNode(vtkDataAssembly::MakeValidNodeName(material.Name.c_str()).c_str());
  assembly->AddDataSetIndex(node, n);
}
}

VolumeBox CollectionHeader::SourceBox() const
{
  const Lattice samples = this->Source.Samples();
  const auto& n = samples.Dims;
  return { samples.Position(-0.5, -0.5, -0.5), samples.Position(n[0] - 0.5, n[1] - 0.5, n[2] - 0.5) };
}

GridFrame FrameOf(vtkImageData* image)
{
  const int* extent = image->GetExtent();
  const double* origin = image->GetOrigin();
  const double* spacing = image->GetSpacing();
  return GridFrame({ extent[0], extent[1], extent[2], extent[3], extent[4], extent[5] },
    Vec3(origin[0], origin[1], origin[2]), Vec3(spacing[0], spacing[1], spacing[2]),
    DirectionFrom(image->GetDirectionMatrix()->GetData()));
}

void SetFrame(vtkImageData* image, const GridFrame& frame)
{
  const auto& extent = frame.Extent();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetOrigin(frame.Origin()[0], frame.Origin()[1], frame.Origin()[2]);
  image->SetSpacing(frame.Spacing()[0], frame.Spacing()[1], frame.Spacing()[2]);
  const Mat3& d = frame.Direction();
  image->SetDirectionMatrix(d(0, 0), d(0, 1), d(0, 2), d(1, 0), d(1, 1), d(1, 2), d(2, 0), d(2, 1), d(2, 2));
}

Material DefaultMaterial(LabelMesh::Label label)
{
  // Twelve hues that differ also for colour-blind eyes (after Paul Tol), then the same ones darker and lighter.
  static constexpr double hues[12][3] = { { .27, .47, .67 }, { .93, .40, .47 }, { .13, .53, .20 }, { .80, .73, .27 },
    { .40, .80, .93 }, { .67, .20, .47 }, { .93, .47, .20 }, { .27, .67, .60 }, { .53, .13, .33 }, { .60, .60, .20 },
    { .53, .80, .67 }, { .55, .45, .75 } };
  Material material;
  material.Label = label;
  material.Name = "Label_" + std::to_string(label);
  material.Color = Vec3::Constant(0.8);
  if (label != 0)
  {
    const std::uint64_t n = label > 0 ? std::uint64_t(label) - 1 : std::uint64_t(-(label + 1));
    const double* hue = hues[n % 12];
    const double shade = n / 12 % 3 == 0 ? 0.0 : n / 12 % 3 == 1 ? -0.3 : 0.4;
    for (int c = 0; c < 3; ++c)
    {
      material.Color[c] = shade > 0 ? hue[c] + shade * (1 - hue[c]) : hue[c] * (1 + shade);
    }
  }
  return material;
}

void WriteMaterials(vtkFieldData* fieldData, const std::vector<Material>& materials, LabelMesh::Label background)
{
  const auto count = static_cast<vtkIdType>(materials.size());
  vtkNew<vtkTypeInt64Array> labels;
  labels->SetName(Names::Labels);
  labels->SetNumberOfValues(count);
  vtkNew<vtkStringArray> names;
  names->SetName(Names::MaterialNames);
  names->SetNumberOfValues(count);
  vtkNew<vtkDoubleArray> colors;
  colors->SetName(Names::MaterialColors);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    labels->SetValue(i, materials[i].Label);
    names->SetValue(i, materials[i].Name);
    colors->SetTuple(i, materials[i].Color.data());
  }
  vtkNew<vtkTypeInt64Array> backgroundLabel;
  backgroundLabel->SetName(Names::BackgroundLabel);
  backgroundLabel->InsertNextValue(background);
  fieldData->AddArray(labels);
  fieldData->AddArray(names);
  fieldData->AddArray(colors);
  fieldData->AddArray(backgroundLabel);
}

std::vector<Material> ReadMaterials(vtkFieldData* fieldData)
{
  std::vector<Material> materials;
  vtkDataArray* labels = fieldData ? fieldData->GetArray(Names::Labels) : nullptr;
  if (!labels)
  {
    return materials;
  }
  vtkAbstractArray* names = fieldData->GetAbstractArray(Names::MaterialNames);
  vtkDataArray* colors = fieldData->GetArray(Names::MaterialColors);
  const Index count = labels->GetNumberOfValues();
  for (Index i = 0; i < count; ++i)
  {
    Material material = DefaultMaterial(labels->GetVariantValue(i).ToTypeInt64());
    if (names && i < names->GetNumberOfValues())
    {
      material.Name = names->GetVariantValue(i).ToString();
    }
    if (colors && colors->GetNumberOfComponents() == 3 && i < colors->GetNumberOfTuples())
    {
      colors->GetTuple(i, material.Color.data());
    }
    if (i > 0 && material.Label <= materials.back().Label)
    {
      Fail(std::string("The field data '") + Names::Labels + "' is not ascending: " +
        std::to_string(materials.back().Label) + " is followed by " + std::to_string(material.Label) + ".");
    }
    materials.push_back(material);
  }
  return materials;
}

void WriteHeader(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header)
{
  vtkFieldData* fieldData = collection->GetFieldData();
  if (!fieldData)
  {
    vtkNew<vtkFieldData> created;
    collection->SetFieldData(created);
    fieldData = created;
  }
  WriteMaterials(fieldData, header.Materials, header.Background);
  const auto& extent = header.Source.Extent();
  vtkNew<vtkIntArray> sourceExtent;
  sourceExtent->SetName(Names::SourceExtent);
  sourceExtent->SetNumberOfComponents(6);
  sourceExtent->InsertNextTypedTuple(extent.data());
  fieldData->AddArray(sourceExtent);
  vtkNew<vtkIntArray> padding;
  padding->SetName(Names::Padding);
  padding->InsertNextValue(header.Padding);
  fieldData->AddArray(padding);
  fieldData->RemoveArray(Names::Border);
  if (header.FlatBorder)
  {
    vtkNew<vtkIntArray> border;
    border->SetName(Names::Border);
    border->InsertNextValue(1);
    fieldData->AddArray(border);
  }
  AddNumbers(fieldData, Names::SourceOrigin, vtkNew<vtkDoubleArray>(), 3, header.Source.Origin().data(), 3);
  AddNumbers(fieldData, Names::VoxelSize, vtkNew<vtkDoubleArray>(), 3, header.Source.Spacing().data(), 3);
  const std::array<double, 9> rows = RowsOf(header.Source.Direction());
  AddNumbers(fieldData, Names::SourceDirection, vtkNew<vtkDoubleArray>(), 9, rows.data(), 9);
  if (!collection->GetDataAssembly())
  {
    vtkNew<vtkDataAssembly> assembly;
    assembly->SetRootNodeName(Names::IndicatorsRoot);
    collection->SetDataAssembly(assembly);
  }
}

CollectionHeader ReadHeader(vtkPartitionedDataSetCollection* collection)
{
  CollectionHeader header;
  vtkFieldData* fieldData = collection->GetFieldData();
  header.Materials = ReadMaterials(fieldData);
  const unsigned int blocks = collection->GetNumberOfPartitionedDataSets();
  if (blocks == 0 && header.Materials.empty())
  {
    return header; // an empty volume
  }
  if (blocks != header.Materials.size())
  {
    Fail("The collection has " + std::to_string(blocks) + " blocks but its field data '" + Names::Labels + "' has " +
      std::to_string(header.Materials.size()) +
      ". Connect the whole output of Label Split, Tighten or Indicator "
      "Reconstruct; choose materials with the labels of Label Split.");
  }
  for (unsigned int n = 0; n < blocks; ++n)
  {
    if (BlockLabel(collection, n) != header.Materials[n].Label)
    {
      Fail("Block '" + BlockName(collection, n) + "' has label " + std::to_string(BlockLabel(collection, n)) +
        " where the field data '" + Names::Labels + "' has " + std::to_string(header.Materials[n].Label) + ".");
    }
  }
  header.Source = ReadFrame(fieldData);
  header.Padding = int(Numbers(fieldData, Names::Padding, 1)[0]);
  header.FlatBorder = fieldData->GetArray(Names::Border) && Numbers(fieldData, Names::Border, 1)[0] != 0;
  if (vtkDataArray* background = fieldData->GetArray(Names::BackgroundLabel))
  {
    header.Background = background->GetNumberOfValues() > 0 ? background->GetVariantValue(0).ToTypeInt64() : 0;
  }
  return header;
}

void AppendBlock(
  vtkPartitionedDataSetCollection* collection, const Material& material, const GridFrame& frame, vtkDataArray* values)
{
  vtkNew<vtkImageData> image;
  SetFrame(image, frame);
  image->GetPointData()->SetScalars(values);
  AppendImage(collection, material, image);
}

void AppendEmptyBlocks(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header)
{
  for (const Material& material : header.Materials)
  {
    AppendImage(collection, material, vtkNew<vtkImageData>());
  }
  WriteHeader(collection, header);
}

vtkImageData* BlockImage(vtkPartitionedDataSetCollection* collection, unsigned int n)
{
  vtkImageData* image = nullptr;
  if (n < collection->GetNumberOfPartitionedDataSets() && collection->GetNumberOfPartitions(n) == 1)
  {
    image = vtkImageData::SafeDownCast(collection->GetPartitionAsDataObject(n, 0));
  }
  if (!image)
  {
    Fail("Block '" + BlockName(collection, n) +
      "' of the collection is not one image. Connect the output of Label "
      "Split, Tighten or Indicator Reconstruct.");
  }
  return image;
}

namespace
{
/// The block's point array of that name, of a type that is called `typeName` to the user.
template <typename Array>
Array* BlockArray(
  vtkPartitionedDataSetCollection* collection, unsigned int n, const char* arrayName, const char* typeName)
{
  vtkImageData* image = BlockImage(collection, n);
  Array* array = Array::FastDownCast(image->GetPointData()->GetArray(arrayName));
  if (!array || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    const char* found =
      image->GetPointData()->GetNumberOfArrays() > 0 ? image->GetPointData()->GetArrayName(0) : nullptr;
    Fail("Block '" + BlockName(collection, n) + "' has no " + typeName + " point array '" + arrayName + "'" +
      (found ? std::string(" (it has '") + found + "')" : std::string()) + ". Connect the output of " +
      MakerOf(arrayName) + ".");
  }
  return array;
}
}

const float* BlockValues(vtkPartitionedDataSetCollection* collection, unsigned int n, const char* arrayName)
{
  return BlockArray<vtkFloatArray>(collection, n, arrayName, "float32")->GetPointer(0);
}

const std::uint8_t* BlockMask(vtkPartitionedDataSetCollection* collection, unsigned int n)
{
  return BlockArray<vtkUnsignedCharArray>(collection, n, Names::Mask, "uint8")->GetPointer(0);
}

bool IsGivenUp(vtkInformation* inInfo)
{
  return inInfo->Get(vtkDemandDrivenPipeline::RELEASE_DATA()) != 0;
}

vtkSmartPointer<vtkDataArray> TakeArray(
  vtkPartitionedDataSetCollection* collection, unsigned int n, const char* arrayName)
{
  vtkImageData* block = BlockImage(collection, n);
  vtkSmartPointer<vtkDataArray> array = block->GetPointData()->GetArray(arrayName);
  const bool alone = array && array->GetReferenceCount() == 2 && block->GetReferenceCount() == 1 &&
    collection->GetPartitionedDataSet(n)->GetReferenceCount() == 1;
  if (!alone)
  {
    return nullptr;
  }
  block->GetPointData()->RemoveArray(arrayName);
  return array;
}

IndicatorSet MakeIndicatorSet(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header)
{
  std::vector<IndicatorBlock> blocks;
  for (unsigned int n = 0; n < header.Materials.size(); ++n)
  {
    IndicatorBlock block;
    block.Label = header.Materials[n].Label;
    block.Frame = header.Source.LatticeOf(FrameOf(BlockImage(collection, n)));
    block.Values = BlockValues(collection, n, Names::Indicator);
    // Blocks reach beyond the narrow band, so that their corners hold the band's end: the indicator is continuous
    // there.
    const double voxel = block.Frame.VoxelSize();
    const float first = block.Values[0];
    const float last = block.Values[block.Frame.Size() - 1];
    block.Outside = block.Label == header.Background ? std::max<double>({ first, last, voxel })
                                                     : std::min<double>({ first, last, -voxel });
    blocks.push_back(block);
  }
  const std::optional<VolumeBox> border =
    header.FlatBorder ? std::optional<VolumeBox>(header.SourceBox()) : std::nullopt;
  return IndicatorSet(std::move(blocks), header.Background, header.WorkingFrame().Samples(), border);
}

void PublishFrame(vtkInformation* outInfo, const GridFrame& source, int padding)
{
  const auto& e = source.Extent();
  const int extent[7] = { e[0], e[1], e[2], e[3], e[4], e[5], padding };
  double geometry[15];
  const std::array<double, 9> rows = RowsOf(source.Direction());
  std::copy_n(source.Origin().data(), 3, geometry);
  std::copy_n(source.Spacing().data(), 3, geometry + 3);
  std::copy_n(rows.data(), 9, geometry + 6);
  outInfo->Set(FrameExtentKey(), extent, 7);
  outInfo->Set(FrameGeometryKey(), geometry, 15);
}

void UnpublishFrame(vtkInformation* outInfo)
{
  outInfo->Remove(FrameExtentKey());
  outInfo->Remove(FrameGeometryKey());
}

void CopyPublishedFrame(vtkInformation* inInfo, vtkInformation* outInfo)
{
  GridFrame source;
  int padding = 0;
  if (PublishedFrame(inInfo, source, padding))
  {
    PublishFrame(outInfo, source, padding);
  }
  else
  {
    UnpublishFrame(outInfo);
  }
}

bool PublishedFrame(vtkInformation* inInfo, GridFrame& source, int& padding)
{
  try
  {
    inInfo = BehindPostFilters(inInfo);
    if (inInfo->Has(FrameExtentKey()) && inInfo->Has(FrameGeometryKey()))
    {
      const int* e = inInfo->Get(FrameExtentKey());
      const double* g = inInfo->Get(FrameGeometryKey());
      source = GridFrame(
        { e[0], e[1], e[2], e[3], e[4], e[5] }, Vec3(g[0], g[1], g[2]), Vec3(g[3], g[4], g[5]), DirectionFrom(g + 6));
      padding = e[6];
      return true;
    }
    vtkDataObject* data = inInfo->Get(vtkDataObject::DATA_OBJECT());
    if (data && data->GetFieldData() && data->GetFieldData()->GetArray(Names::SourceExtent))
    {
      source = ReadFrame(data->GetFieldData());
      padding = int(Numbers(data->GetFieldData(), Names::Padding, 1)[0]);
      return true;
    }
  }
  catch (const std::invalid_argument&)
  {
    // A grid that is no grid is unknown here; RequestData says what is wrong with it.
  }
  return false;
}
}
