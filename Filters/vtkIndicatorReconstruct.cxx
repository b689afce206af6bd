// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIndicatorReconstruct.h"

#include "Core/Parallel.h"
#include "Core/RebuiltLabels.h"
#include "Core/SmoothMaximum.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "ServerPieces.h"
#include "WorkingImage.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkIndicatorReconstruct);

namespace
{
using namespace LabelMesh;

constexpr std::size_t MostInspected = 4; // materials meet at a 0-cell

constexpr double GoldenRatio = 0.6180339887498949;

/// The n-th number of a sequence in [0, 1) whose members stay well apart, however many are taken.
double GoldenSequence(std::size_t n)
{
  const double turns = GoldenRatio * double(n + 1);
  return turns - std::floor(turns);
}

void PassFieldData(vtkFieldData* from, vtkFieldData* to)
{
  for (int n = 0; from && n < from->GetNumberOfArrays(); ++n)
  {
    if (!to->HasArray(from->GetAbstractArray(n)->GetName()))
    {
      to->AddArray(from->GetAbstractArray(n));
    }
  }
}

/// Port 0: the distances and each material's constant.
void Reconstruct(vtkPartitionedDataSetCollection* input, bool givenUp, const CollectionHeader& header,
  double perturbation, vtkPartitionedDataSetCollection* output, const Monitor& monitor)
{
  WriteHeader(output, header);
  PassFieldData(input->GetFieldData(), output->GetFieldData());
  vtkNew<vtkStringArray> kernel;
  kernel->SetName(Names::IndicatorKernel);
  kernel->InsertNextValue(Names::CatmullRom);
  output->GetFieldData()->AddArray(kernel);
  const double voxel = header.Materials.empty() ? 0.0 : header.Source.Samples().VoxelSize();
  const auto count = static_cast<unsigned int>(header.Materials.size());
  for (unsigned int n = 0; n < count; ++n)
  {
    monitor.Step(double(n) / count, "Reconstructing " + header.Materials[n].Name);
    vtkImageData* block = BlockImage(input, n);
    const float* distance = BlockValues(input, n, Names::TightDistance);
    const float constant = float(perturbation * voxel * GoldenSequence(n));
    // In the distances' own memory if nobody else wants them.
    vtkSmartPointer<vtkFloatArray> values =
      givenUp ? vtkFloatArray::FastDownCast(TakeArray(input, n, Names::TightDistance)) : nullptr;
    if (!values)
    {
      values = vtkSmartPointer<vtkFloatArray>::New();
      values->SetNumberOfValues(block->GetNumberOfPoints());
    }
    values->SetName(Names::Indicator);
    float* const indicator = values->GetPointer(0);
    ParallelFor(0, block->GetNumberOfPoints(), 0,
      [=](Index first, Index last)
      {
        std::transform(
          distance + first, distance + last, indicator + first, [constant](float value) { return value + constant; });
      });
    AppendBlock(output, header.Materials[n], FrameOf(block), values);
    PassFieldData(block->GetFieldData(), BlockImage(output, n)->GetFieldData());
  }
}

/// The grid of port 1: the source's, or one with `resolution` samples per voxel over the same voxels.
GridFrame ImageFrame(const GridFrame& source, double resolution)
{
  if (resolution == 1.0)
  {
    return source;
  }
  std::array<int, 6> extent{};
  Vec3 spacing, first;
  for (int a = 0; a < 3; ++a)
  {
    const int voxels = source.Extent()[2 * a + 1] - source.Extent()[2 * a] + 1;
    const int samples = std::max(1, int(std::lround(voxels * resolution)));
    const double step = double(voxels) / samples; // voxels
    extent[2 * a + 1] = samples - 1;
    spacing[a] = source.Spacing()[a] * step;
    first[a] = source.Extent()[2 * a] + 0.5 * (step - 1);
  }
  return GridFrame(extent, source.ToWorld(first[0], first[1], first[2]), spacing, source.Direction());
}

std::vector<IndicatorBlock> BlocksOf(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header)
{
  std::vector<IndicatorBlock> blocks(header.Materials.size());
  for (unsigned int n = 0; n < blocks.size(); ++n)
  {
    blocks[n].Label = header.Materials[n].Label;
    blocks[n].Frame = header.Source.LatticeOf(FrameOf(BlockImage(collection, n)));
    blocks[n].Values = BlockValues(collection, n, Names::Indicator);
  }
  return blocks;
}

/// The ids of the inspected labels.
std::vector<MaterialId> FindMaterials(const std::vector<vtkIdType>& labels, const CollectionHeader& header)
{
  if (labels.size() > MostInspected)
  {
    throw std::invalid_argument(
      "There are " + std::to_string(labels.size()) + " inspected labels; give at most 4, the materials of a 0-cell.");
  }
  std::vector<MaterialId> ids;
  for (const vtkIdType label : labels)
  {
    const auto found = std::find_if(header.Materials.begin(), header.Materials.end(),
      [label](const Material& material) { return material.Label == label; });
    if (found == header.Materials.end())
    {
      throw std::invalid_argument("The inspected label " + std::to_string(label) + " is not among the materials.");
    }
    ids.push_back(MaterialId(found - header.Materials.begin()));
  }
  return ids;
}

/// Equations 1 to 4 as fields.
void AttachFunctions(vtkImageData* image, const IndicatorSet& indicators, const Lattice& lattice,
  const std::vector<MaterialId>& inspected, double epsilon, const Monitor& monitor)
{
  std::vector<float> sum(lattice.Size(), 0.0f);
  for (std::size_t n = 0; n < inspected.size(); ++n)
  {
    const MaterialId material = inspected[n];
    const std::string name = Names::InsideOutside + std::to_string(indicators.LabelOf(material));
    monitor.Step(double(n) / double(inspected.size()), "Evaluating " + name);
    std::vector<float> values(lattice.Size());
    ParallelFor(0, Index(lattice.Dims[1]) * lattice.Dims[2], 16,
      [&](Index first, Index last)
      {
        for (Index at = first * lattice.Dims[0]; at < last * lattice.Dims[0]; ++at)
        {
          const auto c = lattice.Coordinates(at);
          const double value = InsideOutside(indicators, material, lattice.Position(c[0], c[1], c[2]), epsilon);
          values[at] = float(value);
          sum[at] += float(value * value);
        }
      });
    AddImageArray(image, name.c_str(), values);
  }
  if (inspected.size() > 1)
  {
    AddImageArray(image, Names::CellIndicator, sum);
  }
}

void AttachLabels(vtkImageData* image, const RebuiltLabels& rebuilt)
{
  vtkNew<vtkTypeInt64Array> labels;
  labels->SetName(Names::Label);
  labels->SetNumberOfValues(static_cast<vtkIdType>(rebuilt.Labels.size()));
  std::copy(rebuilt.Labels.begin(), rebuilt.Labels.end(), labels->GetPointer(0));
  image->GetPointData()->SetScalars(labels);
  AddImageArray(image, Names::Margin, rebuilt.Margin);
}
}

vtkIndicatorReconstruct::vtkIndicatorReconstruct()
{
  this->SetNumberOfOutputPorts(2);
}

void vtkIndicatorReconstruct::AddInspectedLabel(vtkIdType label)
{
  if (std::find(this->InspectedLabels.begin(), this->InspectedLabels.end(), label) == this->InspectedLabels.end())
  {
    this->InspectedLabels.push_back(label);
    this->Modified();
  }
}

void vtkIndicatorReconstruct::ClearInspectedLabels()
{
  if (!this->InspectedLabels.empty())
  {
    this->InspectedLabels.clear();
    this->Modified();
  }
}

vtkImageData* vtkIndicatorReconstruct::GetLabelImage()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkIndicatorReconstruct::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkIndicatorReconstruct::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkImageData");
  return 1;
}

int vtkIndicatorReconstruct::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  CopyPublishedFrame(inInfo, outputVector->GetInformationObject(0));
  vtkInformation* imageInfo = outputVector->GetInformationObject(1);
  GridFrame source;
  int padding = 0;
  const bool known = FindFrame(this, inInfo, source, padding);
  const GridFrame image = known ? ImageFrame(source, this->ImageResolution) : source;
  PublishImage(imageInfo, known ? &image : nullptr);
  vtkDataObject::SetPointDataActiveScalarInfo(imageInfo, VTK_TYPE_INT64, 1);
  return 1;
}

int vtkIndicatorReconstruct::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkIndicatorReconstruct::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputVector, 0);
  vtkImageData* image = vtkImageData::GetData(outputVector, 1);
  const bool first = RequestedPiece(request, outputVector).IsFirst();
  const bool givenUp = first && IsGivenUp(inputVector[0]->GetInformationObject(0));
  const int done = RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(input);
      if (!first)
      {
        AppendEmptyBlocks(output, header);
        AttachLabels(image, RebuiltLabels());
        return;
      }
      const std::vector<MaterialId> inspected =
        header.Materials.empty() ? std::vector<MaterialId>() : FindMaterials(this->InspectedLabels, header);
      Reconstruct(input, givenUp, header, this->Perturbation, output, monitor.Part(0.0, 0.4));
      if (header.Materials.empty())
      {
        AttachLabels(image, RebuiltLabels());
        return;
      }
      const GridFrame frame = ImageFrame(header.Source, this->ImageResolution);
      const Lattice lattice = header.Source.LatticeOf(frame);
      SetFrame(image, frame);
      const std::vector<IndicatorBlock> blocks = BlocksOf(output, header);
      const bool fromSamples = CanRebuildFromSamples(blocks, lattice);
      if (fromSamples)
      {
        AttachLabels(image, RebuildFromSamples(blocks, lattice, monitor.Part(0.4, 0.6)));
      }
      if (!fromSamples || !inspected.empty())
      {
        CollectionHeader materials = header;
        materials.FlatBorder = false; // the image lies within the box
        const IndicatorSet indicators = MakeIndicatorSet(output, materials);
        if (!fromSamples)
        {
          AttachLabels(image, RebuildLabels(indicators, lattice, monitor.Part(0.4, 0.6)));
        }
        AttachFunctions(image, indicators, lattice, inspected, this->SmoothMaximumEpsilon, monitor.Part(0.6, 1.0));
      }
    });
  if (!done && givenUp)
  {
    input->ReleaseData(); // it may not be whole any more
  }
  return done;
}

void vtkIndicatorReconstruct::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Perturbation: " << this->Perturbation << "\n";
  os << indent << "ImageResolution: " << this->ImageResolution << "\n";
  os << indent << "InspectedLabels:";
  for (const vtkIdType label : this->InspectedLabels)
  {
    os << " " << label;
  }
  os << "\n" << indent << "SmoothMaximumEpsilon: " << this->SmoothMaximumEpsilon << "\n";
}
