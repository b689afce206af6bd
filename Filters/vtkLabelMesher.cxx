// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMesher.h"

#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "InnerFilter.h"
#include "LabelMeshNames.h"
#include "LabelMesherPipeline.h"
#include "MaterialStyle.h"
#include "RebuiltVoxels.h"
#include "ServerPieces.h"
#include "WorkingImage.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkLabelMesher);

vtkLabelMesher::vtkLabelMesher()
  : Stages(new Pipeline)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(5);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkLabelMesher::~vtkLabelMesher() = default;

vtkMTimeType vtkLabelMesher::GetMTime()
{
  // Properties live in the stages.
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Stages->Style->GetMTime());
  for (const Pipeline::Stage& stage : this->Stages->All)
  {
    time = std::max(time, stage.Filter->GetMTime());
  }
  return time;
}

int vtkLabelMesher::GetNumberOfStages() const
{
  return int(this->Stages->All.size());
}

const char* vtkLabelMesher::GetStageName(int stage) const
{
  return stage >= 0 && stage < this->GetNumberOfStages() ? this->Stages->All[stage].Name : nullptr;
}

double vtkLabelMesher::GetStageSeconds(const char* name) const
{
  const Pipeline::Stage* stage = this->Stages->Find(name);
  return stage ? stage->Seconds : 0.0;
}

int vtkLabelMesher::GetStageRuns(const char* name) const
{
  const Pipeline::Stage* stage = this->Stages->Find(name);
  return stage ? stage->Runs : 0;
}

double* vtkLabelMesher::GetAllStageSeconds()
{
  std::transform(this->Stages->All.begin(), this->Stages->All.end(), this->AllStageSeconds,
    [](const Pipeline::Stage& stage) { return stage.Seconds; });
  return this->AllStageSeconds;
}

int* vtkLabelMesher::GetAllStageRuns()
{
  std::transform(this->Stages->All.begin(), this->Stages->All.end(), this->AllStageRuns,
    [](const Pipeline::Stage& stage) { return stage.Runs; });
  return this->AllStageRuns;
}

vtkIdType vtkLabelMesher::GetPredictedParticles() const
{
  return this->Stages->Sizing->GetPredictedParticles();
}

vtkIdType vtkLabelMesher::GetNumberOfParticles()
{
  return this->GetParticles()->GetNumberOfPoints();
}

vtkIdType vtkLabelMesher::GetNumberOfTriangles()
{
  return this->GetOutput()->GetNumberOfPolys();
}

vtkIdType vtkLabelMesher::GetNumberOfTetrahedra()
{
  return this->GetTetrahedraOutput()->GetNumberOfCells();
}

vtkPartitionedDataSetCollection* vtkLabelMesher::GetSurfaces()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPolyData* vtkLabelMesher::GetParticles()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

vtkImageData* vtkLabelMesher::GetLabelImage()
{
  return this->Stages->Reconstruct->GetLabelImage();
}

vtkPolyData* vtkLabelMesher::GetCurves()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(3));
}

vtkUnstructuredGrid* vtkLabelMesher::GetTetrahedraOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(4));
}

int vtkLabelMesher::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkLabelMesher::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPolyData",
    "vtkUnstructuredGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  LabelMesh::PromiseFirstPiece(info);
  return 1;
}

int vtkLabelMesher::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < 2; ++port)
  {
    if (inputVector[port]->GetNumberOfInformationObjects() > 0)
    {
      LabelMesh::RequestAll(inputVector[port]->GetInformationObject(0));
    }
  }
  return 1;
}

int vtkLabelMesher::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace LabelMesh;
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  vtkImageData* bound = vtkImageData::GetData(inputVector[1], 0);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      RequireWhole(inputVector[0]->GetInformationObject(0), input);
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      vtkDataArray* labels = this->GetInputArrayToProcess(0, inputVector, association);
      Pipeline& stages = *this->Stages;
      stages.Labels.Set(input, labels, association == vtkDataObject::FIELD_ASSOCIATION_CELLS);
      stages.SetBound(bound, bound ? this->GetInputArrayToProcess(1, inputVector) : nullptr);
      stages.Update(this, RequestedPiece(request, outputVector), monitor);
      vtkDataObject::GetData(outputVector, 0)->ShallowCopy(stages.Mesh->GetOutputDataObject(0));
      vtkDataObject* surfaces = vtkDataObject::GetData(outputVector, 1);
      surfaces->ShallowCopy(stages.Mesh->GetOutputDataObject(1));
      vtkDataObject::GetData(outputVector, 2)->ShallowCopy(stages.Sample->GetOutputDataObject(0));
      vtkDataObject::GetData(outputVector, 3)->ShallowCopy(stages.Sample->GetOutputDataObject(1));
      vtkDataObject::GetData(outputVector, 4)->ShallowCopy(stages.Mesh->GetOutputDataObject(2));
      vtkFieldData* volumes = stages.Reconstruct->GetOutputDataObject(0)->GetFieldData();
      for (const char* name :
        { Names::MaskVolumes, Names::TightVolumes, Names::KeptVolumes, Names::DroppedLabels, Names::DroppedInto,
          Names::DroppedVoxels, Names::DroppedPositions, Names::Upsampling, Names::UpsamplingReason })
      {
        if (vtkAbstractArray* array = volumes->GetAbstractArray(name))
        {
          surfaces->GetFieldData()->AddArray(array);
        }
      }
      if (stages.Reconstruct->GetLabelImage()->GetNumberOfPoints() > 0)
      {
        LabelImage volume = ReadLabelImage(input, labels, association == vtkDataObject::FIELD_ASSOCIATION_CELLS);
        std::vector<Label> meshed;
        for (const Material& material : ReadMaterials(volumes))
        {
          meshed.push_back(material.Label);
        }
        MergeIntoBackground(volume, meshed, this->GetBackgroundLabel());
        WriteRebuiltVoxels(
          surfaces->GetFieldData(), volume, stages.Reconstruct->GetLabelImage(), this->GetBackgroundLabel());
      }
      for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
      {
        StyleMaterials(
          vtkDataObject::GetData(outputVector, port), [&stages](Label label) { return stages.StyleOf(label); });
      }
    });
}

void vtkLabelMesher::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Pipeline::Stage& stage : this->Stages->All)
  {
    os << indent << stage.Name << ": " << stage.Runs << " runs, the last one " << stage.Seconds << " s\n";
    stage.Filter->PrintSelf(os, indent.GetNextIndent());
  }
}
