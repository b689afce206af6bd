// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMesher.h"

#include "FilterSupport.h"
#include "InnerFilter.h"
#include "LabelMeshNames.h"
#include "WorkingImage.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

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

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkLabelMesher);

namespace
{
/// A data object handed into the inner pipeline: replaced, and so seen as new, only when what it holds has changed.
class Feed
{
public:
  Feed() { this->Producer->SetOutput(this->Image); }

  /// The image's structure and the array as its scalars.
  void Set(vtkImageData* image, vtkDataArray* array, bool cellData)
  {
    const std::array<vtkMTimeType, 3> state = { image->GetMTime(), array ? array->GetMTime() : 0, cellData ? 1u : 0u };
    if (state == this->State && array == this->Array)
    {
      return;
    }
    this->State = state;
    this->Array = array;
    this->Image->Initialize();
    this->Image->CopyStructure(image);
    if (array)
    {
      vtkDataSetAttributes* data = this->Image->GetPointData();
      if (cellData)
      {
        data = this->Image->GetCellData();
      }
      data->SetScalars(array);
    }
    this->Image->Modified();
  }
  vtkAlgorithmOutput* GetOutputPort() { return this->Producer->GetOutputPort(); }

private:
  vtkNew<vtkImageData> Image;
  vtkNew<vtkTrivialProducer> Producer;
  std::array<vtkMTimeType, 3> State{ 0, 0, 0 };
  vtkDataArray* Array = nullptr; // to compare, never followed
};
}

class vtkLabelMesher::Pipeline
{
public:
  struct Stage
  {
    vtkAlgorithm* Filter;
    const char* Name;
    double Weight; ///< of the whole time, for the progress
    double Seconds = 0.0;
    int Runs = 0;
  };

  Pipeline()
  {
    // The fields are by far the largest data: one copy of them is kept, the indicators, which take the memory of the
    // distances over.
    this->Split->ReleaseDataFlagOn();
    this->Tighten->ReleaseDataFlagOn();
    this->Split->SetInputConnection(this->Labels.GetOutputPort());
    this->Tighten->SetInputConnection(this->Split->GetOutputPort());
    this->Reconstruct->SetInputConnection(this->Tighten->GetOutputPort());
    this->Sizing->SetInputConnection(0, this->Reconstruct->GetOutputPort());
    this->Sample->SetInputConnection(0, this->Reconstruct->GetOutputPort());
    this->Sample->SetInputConnection(1, this->Sizing->GetOutputPort());
    this->Mesh->SetInputConnection(0, this->Sample->GetOutputPort());
    this->Mesh->SetInputConnection(1, this->Reconstruct->GetOutputPort());
    for (Stage& stage : this->All)
    {
      stage.Filter->AddObserver(vtkCommand::StartEvent, this, &Pipeline::OnStart);
      stage.Filter->AddObserver(vtkCommand::EndEvent, this, &Pipeline::OnEnd);
    }
  }

  void SetBound(vtkImageData* bound, vtkDataArray* array)
  {
    const bool connected = this->Sizing->GetNumberOfInputConnections(1) > 0;
    if (bound)
    {
      this->Bound.Set(bound, array, false);
    }
    if (bound && !connected)
    {
      this->Sizing->SetInputConnection(1, this->Bound.GetOutputPort());
    }
    else if (!bound && connected)
    {
      this->Sizing->RemoveAllInputConnections(1);
    }
  }

  /// Brings one stage after the other up to date.
  void Update(vtkAlgorithm* outer, const LabelMesh::Monitor& monitor)
  {
    // The first stages run for the one that keeps its output.
    double done = 0.0, next = 0.0;
    std::vector<LabelMesh::InnerStage> chain;
    for (const Stage& stage : this->All)
    {
      chain.push_back({ stage.Filter, stage.Name, stage.Weight });
      next += stage.Weight;
      if (!stage.Filter->GetReleaseDataFlag())
      {
        LabelMesh::UpdateInner(chain, outer, monitor.Part(done, next));
        done = next;
        chain.clear();
      }
    }
  }

  const Stage* Find(const char* name) const
  {
    const auto at = std::find_if(
      this->All.begin(), this->All.end(), [name](const Stage& s) { return name && std::strcmp(s.Name, name) == 0; });
    return at != this->All.end() ? &*at : nullptr;
  }

  Feed Labels, Bound;
  vtkNew<vtkLabelSplit> Split;
  vtkNew<vtkTighten> Tighten;
  vtkNew<vtkIndicatorReconstruct> Reconstruct;
  vtkNew<vtkSizingField> Sizing;
  vtkNew<vtkParticleSampleCells> Sample;
  vtkNew<vtkDelaunayLabelMesh> Mesh;
  std::array<Stage, 6> All = { { { this->Split, "LabelSplit", 0.05 }, { this->Tighten, "Tighten", 0.3 },
    { this->Reconstruct, "IndicatorReconstruct", 0.05 }, { this->Sizing, "SizingField", 0.1 },
    { this->Sample, "ParticleSampleCells", 0.3 }, { this->Mesh, "DelaunayLabelMesh", 0.2 } } };

private:
  using Clock = std::chrono::steady_clock;

  void OnStart(vtkObject*, unsigned long, void*) { this->Started = Clock::now(); }
  void OnEnd(vtkObject* caller, unsigned long, void*)
  {
    for (Stage& stage : this->All)
    {
      if (stage.Filter == caller)
      {
        stage.Seconds = std::chrono::duration<double>(Clock::now() - this->Started).count();
        ++stage.Runs;
      }
    }
  }
  Clock::time_point Started;
};

vtkLabelMesher::vtkLabelMesher()
  : Stages(new Pipeline)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkLabelMesher::~vtkLabelMesher() = default;

vtkMTimeType vtkLabelMesher::GetMTime()
{
  // Properties live in the stages.
  vtkMTimeType time = this->Superclass::GetMTime();
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

int vtkLabelMesher::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkLabelMesher::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkPartitionedDataSetCollection" : "vtkPolyData");
  return 1;
}

int vtkLabelMesher::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < 2; ++port)
  {
    if (inputVector[port]->GetNumberOfInformationObjects() > 0)
    {
      LabelMesh::RequestWholeExtent(inputVector[port]->GetInformationObject(0));
    }
  }
  return 1;
}

int vtkLabelMesher::RequestData(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace LabelMesh;
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  vtkImageData* bound = vtkImageData::GetData(inputVector[1], 0);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      vtkDataArray* labels = this->GetInputArrayToProcess(0, inputVector, association);
      Pipeline& stages = *this->Stages;
      stages.Labels.Set(input, labels, association == vtkDataObject::FIELD_ASSOCIATION_CELLS);
      stages.SetBound(bound, bound ? this->GetInputArrayToProcess(1, inputVector) : nullptr);
      stages.Update(this, monitor);
      vtkDataObject::GetData(outputVector, 0)->ShallowCopy(stages.Mesh->GetOutputDataObject(0));
      vtkDataObject* surfaces = vtkDataObject::GetData(outputVector, 1);
      surfaces->ShallowCopy(stages.Mesh->GetOutputDataObject(1));
      vtkDataObject::GetData(outputVector, 2)->ShallowCopy(stages.Sample->GetOutputDataObject(0));
      vtkDataObject::GetData(outputVector, 3)->ShallowCopy(stages.Sample->GetOutputDataObject(1));
      vtkFieldData* volumes = stages.Reconstruct->GetOutputDataObject(0)->GetFieldData();
      for (const char* name : { Names::MaskVolumes, Names::TightVolumes, Names::KeptVolumes })
      {
        if (vtkAbstractArray* array = volumes->GetAbstractArray(name))
        {
          surfaces->GetFieldData()->AddArray(array);
        }
      }
    });
}

void vtkLabelMesher::AddLabel(vtkIdType label)
{
  this->Stages->Split->AddLabel(label);
}

void vtkLabelMesher::ClearLabels()
{
  this->Stages->Split->ClearLabels();
}

vtkIdType vtkLabelMesher::GetNumberOfLabels() const
{
  return this->Stages->Split->GetNumberOfLabels();
}

vtkIdType vtkLabelMesher::GetLabel(vtkIdType index) const
{
  return this->Stages->Split->GetLabel(index);
}

void vtkLabelMesher::SetMaterialName(vtkIdType label, const char* name)
{
  this->Stages->Split->SetMaterialName(label, name);
}

void vtkLabelMesher::ClearMaterialNames()
{
  this->Stages->Split->ClearMaterialNames();
}

std::string vtkLabelMesher::GetMaterialName(vtkIdType label) const
{
  return this->Stages->Split->GetMaterialName(label);
}

void vtkLabelMesher::SetMaterialColor(vtkIdType label, double red, double green, double blue)
{
  this->Stages->Split->SetMaterialColor(label, red, green, blue);
}

void vtkLabelMesher::ClearMaterialColors()
{
  this->Stages->Split->ClearMaterialColors();
}

void vtkLabelMesher::GetMaterialColor(vtkIdType label, double color[3]) const
{
  this->Stages->Split->GetMaterialColor(label, color);
}

void vtkLabelMesher::SetBackgroundLabel(vtkIdType label)
{
  this->Stages->Split->SetBackgroundLabel(label);
}

vtkIdType vtkLabelMesher::GetBackgroundLabel() const
{
  return this->Stages->Split->GetBackgroundLabel();
}

void vtkLabelMesher::SetPadding(int samples)
{
  this->Stages->Split->SetPadding(samples);
}

int vtkLabelMesher::GetPadding() const
{
  return this->Stages->Split->GetPadding();
}

void vtkLabelMesher::SetBorder(int border)
{
  this->Stages->Split->SetBorder(border);
}

int vtkLabelMesher::GetBorder() const
{
  return this->Stages->Split->GetBorder();
}

void vtkLabelMesher::SetBorderToClosed()
{
  this->Stages->Split->SetBorderToClosed();
}

void vtkLabelMesher::SetBorderToFlat()
{
  this->Stages->Split->SetBorderToFlat();
}

void vtkLabelMesher::SetResamplingFactor(double factor)
{
  this->Stages->Split->SetResamplingFactor(factor);
}

double vtkLabelMesher::GetResamplingFactor() const
{
  return this->Stages->Split->GetResamplingFactor();
}

void vtkLabelMesher::SetMemoryLimit(double gibibytes)
{
  this->Stages->Split->SetMemoryLimit(gibibytes);
}

double vtkLabelMesher::GetMemoryLimit() const
{
  return this->Stages->Split->GetMemoryLimit();
}

void vtkLabelMesher::SetOpeningRadius(double radius)
{
  this->Stages->Split->SetOpeningRadius(radius);
}

double vtkLabelMesher::GetOpeningRadius() const
{
  return this->Stages->Split->GetOpeningRadius();
}

void vtkLabelMesher::SetClosingRadius(double radius)
{
  this->Stages->Split->SetClosingRadius(radius);
}

double vtkLabelMesher::GetClosingRadius() const
{
  return this->Stages->Split->GetClosingRadius();
}

void vtkLabelMesher::SetSmoothing(int smoothing)
{
  this->Stages->Tighten->SetSmoothing(smoothing);
}

int vtkLabelMesher::GetSmoothing() const
{
  return this->Stages->Tighten->GetSmoothing();
}

void vtkLabelMesher::SetSmoothingToVolumeKeeping()
{
  this->Stages->Tighten->SetSmoothingToVolumeKeeping();
}

void vtkLabelMesher::SetSmoothingToTightening()
{
  this->Stages->Tighten->SetSmoothingToTightening();
}

void vtkLabelMesher::SetFidelity(double fidelity)
{
  this->Stages->Tighten->SetFidelity(fidelity);
}

double vtkLabelMesher::GetFidelity() const
{
  return this->Stages->Tighten->GetFidelity();
}

void vtkLabelMesher::SetRounds(int rounds)
{
  this->Stages->Tighten->SetRounds(rounds);
}

int vtkLabelMesher::GetRounds() const
{
  return this->Stages->Tighten->GetRounds();
}

void vtkLabelMesher::SetRadius(double radius)
{
  this->Stages->Tighten->SetRadius(radius);
}

double vtkLabelMesher::GetRadius() const
{
  return this->Stages->Tighten->GetRadius();
}

void vtkLabelMesher::SetAntialiasIterations(int iterations)
{
  this->Stages->Tighten->SetAntialiasIterations(iterations);
}

int vtkLabelMesher::GetAntialiasIterations() const
{
  return this->Stages->Tighten->GetAntialiasIterations();
}

void vtkLabelMesher::SetTightenIterations(int iterations)
{
  this->Stages->Tighten->SetTightenIterations(iterations);
}

int vtkLabelMesher::GetTightenIterations() const
{
  return this->Stages->Tighten->GetTightenIterations();
}

void vtkLabelMesher::SetPerturbation(double voxels)
{
  this->Stages->Reconstruct->SetPerturbation(voxels);
}

double vtkLabelMesher::GetPerturbation() const
{
  return this->Stages->Reconstruct->GetPerturbation();
}

void vtkLabelMesher::SetEpsilon(double epsilon)
{
  this->Stages->Sizing->SetEpsilon(epsilon);
}

double vtkLabelMesher::GetEpsilon() const
{
  return this->Stages->Sizing->GetEpsilon();
}

void vtkLabelMesher::SetFeatureSizeFloor(double voxels)
{
  this->Stages->Sizing->SetFeatureSizeFloor(voxels);
}

double vtkLabelMesher::GetFeatureSizeFloor() const
{
  return this->Stages->Sizing->GetFeatureSizeFloor();
}

void vtkLabelMesher::SetMaximumDeviation(double voxels)
{
  this->Stages->Sizing->SetMaximumDeviation(voxels);
}

double vtkLabelMesher::GetMaximumDeviation() const
{
  return this->Stages->Sizing->GetMaximumDeviation();
}

void vtkLabelMesher::SetGradation(double gradation)
{
  this->Stages->Sizing->SetGradation(gradation);
}

double vtkLabelMesher::GetGradation() const
{
  return this->Stages->Sizing->GetGradation();
}

void vtkLabelMesher::SetMinimumLength(double length)
{
  this->Stages->Sizing->SetMinimumLength(length);
}

double vtkLabelMesher::GetMinimumLength() const
{
  return this->Stages->Sizing->GetMinimumLength();
}

void vtkLabelMesher::SetMaximumLength(double length)
{
  this->Stages->Sizing->SetMaximumLength(length);
}

double vtkLabelMesher::GetMaximumLength() const
{
  return this->Stages->Sizing->GetMaximumLength();
}

void vtkLabelMesher::SetTargetTriangles(vtkIdType triangles)
{
  this->Stages->Sizing->SetTargetTriangles(triangles);
}

vtkIdType vtkLabelMesher::GetTargetTriangles() const
{
  return this->Stages->Sizing->GetTargetTriangles();
}

void vtkLabelMesher::SetSweeps(int sweeps)
{
  this->Stages->Sample->SetSweeps(sweeps);
}

int vtkLabelMesher::GetSweeps() const
{
  return this->Stages->Sample->GetSweeps();
}

void vtkLabelMesher::SetSeed(int seed)
{
  this->Stages->Sample->SetSeed(seed);
}

int vtkLabelMesher::GetSeed() const
{
  return this->Stages->Sample->GetSeed();
}

void vtkLabelMesher::SetRepairRounds(int rounds)
{
  this->Stages->Mesh->SetRepairRounds(rounds);
}

int vtkLabelMesher::GetRepairRounds() const
{
  return this->Stages->Mesh->GetRepairRounds();
}

void vtkLabelMesher::SetImprovePasses(int passes)
{
  this->Stages->Mesh->SetImprovePasses(passes);
}

int vtkLabelMesher::GetImprovePasses() const
{
  return this->Stages->Mesh->GetImprovePasses();
}

void vtkLabelMesher::SetRepairBelow(double ratio)
{
  this->Stages->Mesh->SetRepairBelow(ratio);
}

double vtkLabelMesher::GetRepairBelow() const
{
  return this->Stages->Mesh->GetRepairBelow();
}

void vtkLabelMesher::SetMaterialOpeningRadius(vtkIdType label, double radius)
{
  this->Stages->Split->SetMaterialOpeningRadius(label, radius);
}

double vtkLabelMesher::GetMaterialOpeningRadius(vtkIdType label) const
{
  return this->Stages->Split->GetMaterialOpeningRadius(label);
}

void vtkLabelMesher::ClearMaterialOpeningRadii()
{
  this->Stages->Split->ClearMaterialOpeningRadii();
}

void vtkLabelMesher::SetMaterialClosingRadius(vtkIdType label, double radius)
{
  this->Stages->Split->SetMaterialClosingRadius(label, radius);
}

double vtkLabelMesher::GetMaterialClosingRadius(vtkIdType label) const
{
  return this->Stages->Split->GetMaterialClosingRadius(label);
}

void vtkLabelMesher::ClearMaterialClosingRadii()
{
  this->Stages->Split->ClearMaterialClosingRadii();
}

void vtkLabelMesher::SetMaterialRadius(vtkIdType label, double radius)
{
  this->Stages->Tighten->SetMaterialRadius(label, radius);
}

double vtkLabelMesher::GetMaterialRadius(vtkIdType label) const
{
  return this->Stages->Tighten->GetMaterialRadius(label);
}

void vtkLabelMesher::ClearMaterialRadii()
{
  this->Stages->Tighten->ClearMaterialRadii();
}

void vtkLabelMesher::SetMaterialMaximumLength(vtkIdType label, double length)
{
  this->Stages->Sizing->SetMaterialMaximumLength(label, length);
}

double vtkLabelMesher::GetMaterialMaximumLength(vtkIdType label) const
{
  return this->Stages->Sizing->GetMaterialMaximumLength(label);
}

void vtkLabelMesher::ClearMaterialMaximumLengths()
{
  this->Stages->Sizing->ClearMaterialMaximumLengths();
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
