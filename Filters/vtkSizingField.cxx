// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSizingField.h"

#include "Core/Parallel.h"
#include "Core/SizingField.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "MaterialArrays.h"
#include "ServerPieces.h"
#include "WorkingImage.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkSizingField);

namespace
{
using namespace LabelMesh;

constexpr double TargetWarning = 0.05; // relative: a predicted number this far from the target is worth a word

constexpr float NoBound = 1e30f; // finite, so that an interpolation weight of zero makes it vanish

/// The user's lengths, in index coordinates of their image.
Grid<float> ReadBound(vtkDataArray* array, const GridFrame& frame)
{
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(std::string("The image on port 1 has no point array of lengths") +
      (array ? std::string(": '") + (array->GetName() ? array->GetName() : "") + "' has several components" : "") +
      ". Choose a point array with one component, the longest edge at each sample.");
  }
  Lattice lattice = frame.Samples();
  lattice.Origin = Vec3(frame.Extent()[0], frame.Extent()[2], frame.Extent()[4]);
  lattice.Spacing.setOnes();
  Grid<float> bound(lattice);
  if (array->GetNumberOfTuples() != lattice.Size())
  {
    throw std::invalid_argument("The array of lengths on port 1 is not a point array of its image.");
  }
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    const double length = array->GetComponent(at, 0);
    bound.Values[at] = length > 0 && length < NoBound ? float(length) : NoBound;
  }
  return bound;
}

/// The user's lengths at the samples of the working grid: the two may differ in everything.
Grid<float> SampleBound(vtkDataArray* array, const GridFrame& frame, const GridFrame& working)
{
  const Grid<float> bound = ReadBound(array, frame);
  Grid<float> sampled(working.Samples(), NoBound);
  const auto& low = working.Extent();
  const auto& extent = frame.Extent();
  ParallelFor(0, sampled.Frame.Dims[2], 1,
    [&](Index first, Index last)
    {
      for (Index at = sampled.Frame.At(0, 0, first); at < sampled.Frame.At(0, 0, last); ++at)
      {
        const auto c = sampled.Frame.Coordinates(at);
        const Vec3 index = frame.ToIndex(working.ToWorld(c[0] + low[0], c[1] + low[2], c[2] + low[4]));
        bool inside = true;
        for (int a = 0; a < 3; ++a)
        {
          inside = inside && index[a] >= extent[2 * a] - 0.5 && index[a] <= extent[2 * a + 1] + 0.5;
        }
        if (inside)
        {
          sampled.Values[at] = float(bound.Trilinear(index));
        }
      }
    });
  return sampled;
}

std::array<vtkIdType, 2> Ascending(vtkIdType labelA, vtkIdType labelB)
{
  return { std::min(labelA, labelB), std::max(labelA, labelB) };
}

SizingOptions OptionsOf(vtkSizingField* filter, const CollectionHeader& header)
{
  SizingOptions options;
  options.Epsilon = filter->GetEpsilon();
  options.FeatureSizeFloor = filter->GetFeatureSizeFloor();
  options.MaximumDeviation = filter->GetMaximumDeviation();
  options.Gradation = filter->GetGradation();
  options.MinimumLength = filter->GetMinimumLength();
  options.MaximumLength = filter->GetMaximumLength();
  options.TargetTriangles = double(filter->GetTargetTriangles());
  for (const Material& material : header.Materials)
  {
    options.MaterialMaximumLength.push_back(filter->GetMaterialMaximumLength(material.Label));
  }
  return options;
}

void Attach(vtkImageData* output, const SizingResult& result)
{
  AddImageArray(output, Names::TargetLength, result.TargetLength.Values);
  AddImageArray(output, Names::FeatureSize, result.FeatureSize.Values);
  output->GetPointData()->SetActiveScalars(Names::TargetLength);
}
}

vtkSizingField::vtkSizingField()
{
  this->SetNumberOfInputPorts(2);
  this->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

void vtkSizingField::SetMaterialMaximumLength(vtkIdType label, double length)
{
  if (this->GetMaterialMaximumLength(label) == length)
  {
    return;
  }
  if (length == 0)
  {
    this->MaterialMaximumLengths.erase(label);
  }
  else
  {
    this->MaterialMaximumLengths[label] = length;
  }
  this->Modified();
}

double vtkSizingField::GetMaterialMaximumLength(vtkIdType label) const
{
  const auto found = this->MaterialMaximumLengths.find(label);
  return found == this->MaterialMaximumLengths.end() ? 0.0 : found->second;
}

void vtkSizingField::ClearMaterialMaximumLengths()
{
  if (!this->MaterialMaximumLengths.empty())
  {
    this->MaterialMaximumLengths.clear();
    this->Modified();
  }
}

void vtkSizingField::SetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB, double length)
{
  if (this->GetInterfaceMaximumLength(labelA, labelB) == length)
  {
    return;
  }
  if (length == 0)
  {
    this->InterfaceMaximumLengths.erase(Ascending(labelA, labelB));
  }
  else
  {
    this->InterfaceMaximumLengths[Ascending(labelA, labelB)] = length;
  }
  this->Modified();
}

double vtkSizingField::GetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB) const
{
  const auto found = this->InterfaceMaximumLengths.find(Ascending(labelA, labelB));
  return found == this->InterfaceMaximumLengths.end() ? 0.0 : found->second;
}

void vtkSizingField::ClearInterfaceMaximumLengths()
{
  if (!this->InterfaceMaximumLengths.empty())
  {
    this->InterfaceMaximumLengths.clear();
    this->Modified();
  }
}

int vtkSizingField::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkSizingField::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkSizingField::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  GridFrame source;
  int padding = 0;
  const bool known = FindFrame(this, inInfo, source, padding);
  const GridFrame working = source.Grown(padding);
  PublishImage(outInfo, known ? &working : nullptr);
  vtkDataObject::SetPointDataActiveScalarInfo(outInfo, VTK_FLOAT, 1);
  CopyPublishedFrame(inInfo, outInfo);
  return 1;
}

int vtkSizingField::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkSizingField::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputVector[0], 0);
  vtkImageData* userImage = vtkImageData::GetData(inputVector[1], 0);
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(input);
      this->PredictedParticles = 0;
      if (header.Materials.empty() || !RequestedPiece(request, outputVector).IsFirst())
      {
        Attach(output, SizingResult());
        return;
      }
      SizingOptions options = OptionsOf(this, header);
      for (const auto& [labels, length] : this->InterfaceMaximumLengths)
      {
        // Materials ascend by label, and so do their ids.
        const std::array<MaterialId, 2> ids = { FindMaterial(header.Materials, labels[0]),
          FindMaterial(header.Materials, labels[1]) };
        if (ids[0] == ids[1] || ids[0] == NoMaterial || ids[1] == NoMaterial)
        {
          vtkWarningMacro("SetInterfaceMaximumLength: there is no interface between the labels " << labels[0] << " and "
                                                                                                 << labels[1] << ".");
          continue;
        }
        options.InterfaceMaximumLength[ids] = length;
      }
      const std::size_t unknown = this->MaterialMaximumLengths.size() -
        std::count_if(options.MaterialMaximumLength.begin(), options.MaterialMaximumLength.end(),
          [](double length) { return length != 0; });
      if (unknown > 0)
      {
        vtkWarningMacro("SetMaterialMaximumLength names " << unknown << " labels that are not among the materials.");
      }
      monitor.Step(0.0, "Reading the indicators");
      const IndicatorSet indicators = MakeIndicatorSet(input, header);
      Grid<float> user;
      if (userImage && userImage->GetNumberOfPoints() > 0)
      {
        user = SampleBound(this->GetInputArrayToProcess(0, inputVector), FrameOf(userImage), header.WorkingFrame());
      }
      const SizingResult result =
        ComputeSizing(indicators, options, user.Values.empty() ? nullptr : &user, monitor.Part(0.1, 1.0));
      this->PredictedParticles = static_cast<vtkIdType>(std::llround(result.PredictedParticles));
      if (this->TargetTriangles > 0 && result.PredictedParticles > 0 &&
        std::abs(2 * result.PredictedParticles / double(this->TargetTriangles) - 1) > TargetWarning)
      {
        vtkWarningMacro("The target of " << this->TargetTriangles << " triangles cannot be reached: about "
                                         << 2 *
            this->PredictedParticles << " are predicted. Loosen MinimumLength, the maxima, the image on port 1 or the "
                                         << "Gradation.");
      }
      SetFrame(output, header.WorkingFrame());
      Attach(output, result);
    });
}

void vtkSizingField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Epsilon: " << this->Epsilon << "\n";
  os << indent << "FeatureSizeFloor: " << this->FeatureSizeFloor << "\n";
  os << indent << "MaximumDeviation: " << this->MaximumDeviation << "\n";
  os << indent << "Gradation: " << this->Gradation << "\n";
  os << indent << "MinimumLength: " << this->MinimumLength << "\n";
  os << indent << "MaximumLength: " << this->MaximumLength << "\n";
  os << indent << "MaterialMaximumLengths:";
  for (const auto& [label, length] : this->MaterialMaximumLengths)
  {
    os << " " << label << ": " << length;
  }
  os << "\n" << indent << "InterfaceMaximumLengths:";
  for (const auto& [labels, length] : this->InterfaceMaximumLengths)
  {
    os << " " << labels[0] << ", " << labels[1] << ": " << length;
  }
  os << "\n" << indent << "TargetTriangles: " << this->TargetTriangles << "\n";
  os << indent << "PredictedParticles: " << this->PredictedParticles << "\n";
}
