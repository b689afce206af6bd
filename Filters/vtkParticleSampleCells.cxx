// SPDX-License-Identifier: BSD-3-Clause
#include "vtkParticleSampleCells.h"

#include "Core/ParticleSystem.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "ServerPieces.h"
#include "WorkingImage.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkParticleSampleCells);

namespace
{
using namespace LabelMesh;

/// The target lengths on the lattice of their image, in the local frame of the source.
Grid<float> ReadLengths(vtkImageData* image, const GridFrame& source)
{
  vtkDataArray* array = image ? image->GetPointData()->GetArray(Names::TargetLength) : nullptr;
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(std::string("The image on port 1 has no point array '") + Names::TargetLength +
      "' with one component. Connect the output of Sizing Field.");
  }
  Grid<float> lengths(source.LatticeOf(FrameOf(image)));
  vtkFloatArray* floats = vtkFloatArray::FastDownCast(array);
  for (Index at = 0; at < lengths.Frame.Size(); ++at)
  {
    const double length = floats ? double(floats->GetValue(at)) : array->GetComponent(at, 0);
    if (!(length > 0))
    {
      throw std::invalid_argument(std::string("The array '") + Names::TargetLength + "' holds " +
        std::to_string(length) + " at sample " + std::to_string(at) + ", expected positive lengths.");
    }
    lengths.Values[at] = float(length);
  }
  return lengths;
}
}

vtkParticleSampleCells::vtkParticleSampleCells()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkIdType vtkParticleSampleCells::GetNumberOfCellParticles(int dimension) const
{
  return dimension >= 0 && dimension < 4 ? this->CellParticles[dimension] : 0;
}

void vtkParticleSampleCells::SetMaterialVolumeMaximumLength(vtkIdType label, double length)
{
  if (this->GetMaterialVolumeMaximumLength(label) != length)
  {
    this->MaterialVolumeMaximumLengths[label] = length;
    this->Modified();
  }
}

double vtkParticleSampleCells::GetMaterialVolumeMaximumLength(vtkIdType label) const
{
  const auto found = this->MaterialVolumeMaximumLengths.find(label);
  return found == this->MaterialVolumeMaximumLengths.end() ? 0.0 : found->second;
}

void vtkParticleSampleCells::ClearMaterialVolumeMaximumLengths()
{
  if (!this->MaterialVolumeMaximumLengths.empty())
  {
    this->MaterialVolumeMaximumLengths.clear();
    this->Modified();
  }
}

int vtkParticleSampleCells::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkImageData");
  return 1;
}

int vtkParticleSampleCells::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkParticleSampleCells::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkParticleSampleCells::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputVector[0], 0);
  vtkImageData* sizing = vtkImageData::GetData(inputVector[1], 0);
  vtkPolyData* particles = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* curves = vtkPolyData::GetData(outputVector, 1);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(input);
      SampleResult result;
      if (!header.Materials.empty() && RequestedPiece(request, outputVector).IsFirst())
      {
        monitor.Step(0.0, "Reading the indicators");
        const IndicatorSet indicators = MakeIndicatorSet(input, header);
        SampleOptions options;
        options.Sweeps = this->Sweeps;
        options.Seed = static_cast<std::uint32_t>(this->Seed);
        options.Volume = this->SampleVolume;
        options.Packing.Gradation = this->VolumeGradation;
        options.Packing.MaximumLength = this->VolumeMaximumLength;
        for (const Material& material : header.Materials)
        {
          options.Packing.MaterialMaximumLength.push_back(this->GetMaterialVolumeMaximumLength(material.Label));
        }
        result = SampleCells(indicators, ReadLengths(sizing, header.Source), options, monitor.Part(0.02, 0.98));
      }
      if (header.Materials.size() > 1 && result.Particles.empty())
      {
        vtkWarningMacro(
          "There is no interface to sample: smoothing left no sample to any material but one. Use a smaller "
          "radius, volume-keeping smoothing, or a finer grid (MaximumUpsampling of Label Split).");
      }
      std::copy(result.CellCounts.begin(), result.CellCounts.end(), this->CellParticles);
      this->OpenCurveEnds = result.OpenCurveEnds;
      this->MeanMove = result.MeanMove;
      ParticlesToPolyData(result.Particles, header, particles);
      CurvesToPolyData(result.Curves, result.Particles, header, curves);
      monitor.Step(1.0);
    });
}

void vtkParticleSampleCells::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Sweeps: " << this->Sweeps << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "SampleVolume: " << (this->SampleVolume ? "on" : "off") << "\n";
  os << indent << "VolumeGradation: " << this->VolumeGradation << "\n";
  os << indent << "VolumeMaximumLength: " << this->VolumeMaximumLength << "\n";
  os << indent << "MaterialVolumeMaximumLengths:";
  for (const auto& [label, length] : this->MaterialVolumeMaximumLengths)
  {
    os << " " << label << ": " << length;
  }
  os << "\n"
     << indent << "CellParticles: " << this->CellParticles[0] << " " << this->CellParticles[1] << " "
     << this->CellParticles[2] << " " << this->CellParticles[3] << "\n";
  os << indent << "OpenCurveEnds: " << this->OpenCurveEnds << "\n";
  os << indent << "MeanMove: " << this->MeanMove << "\n";
}
