// SPDX-License-Identifier: BSD-3-Clause
// The stages of vtkLabelMesher, connected.
#ifndef LabelMesherPipeline_h
#define LabelMesherPipeline_h

#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "InnerFilter.h"
#include "ServerPieces.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelMesher.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTrivialProducer.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

namespace LabelMesh
{
/// A data object handed into the inner pipeline: replaced, and so seen as new, only when what it holds has changed.
class Feed
{
public:
  Feed() { this->Producer->SetOutput(this->Image); }

  /// The image's structure and the array as its scalars.
  void Set(vtkImageData* image, vtkDataArray* array, bool cellData)
  {
    // Not the image's own time: ParaView gives a filter a new image around the same array each time it runs.
    const vtkMTimeType time = array ? array->GetMTime() : 0;
    if (array == this->Array && time == this->Time && cellData == this->CellData && this->HasStructureOf(image))
    {
      return;
    }
    this->Array = array;
    this->Time = time;
    this->CellData = cellData;
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
  bool HasStructureOf(vtkImageData* image) const
  {
    const auto same = [](const auto* a, const auto* b, int count) { return std::equal(a, a + count, b); };
    return same(image->GetExtent(), this->Image->GetExtent(), 6) &&
      same(image->GetOrigin(), this->Image->GetOrigin(), 3) &&
      same(image->GetSpacing(), this->Image->GetSpacing(), 3) &&
      same(image->GetDirectionMatrix()->GetData(), this->Image->GetDirectionMatrix()->GetData(), 9);
  }

  vtkNew<vtkImageData> Image;
  vtkNew<vtkTrivialProducer> Producer;
  vtkDataArray* Array = nullptr; // to compare, never followed
  vtkMTimeType Time = 0;
  bool CellData = false;
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

  /// Brings one stage after the other up to date. Pieces but the first are empty, stage by stage; the first one is the
  /// same of any number, and the stages need not run again for another.
  void Update(vtkAlgorithm* outer, const LabelMesh::Piece& piece, const LabelMesh::Monitor& monitor)
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
        LabelMesh::UpdateInner(chain, outer, piece.IsFirst() ? LabelMesh::Piece() : piece, monitor.Part(done, next));
        done = next;
        chain.clear();
      }
    }
  }

  /// The name and the colour of a label, as the user wants them.
  LabelMesh::Material StyleOf(LabelMesh::Label label) const
  {
    LabelMesh::Material material;
    material.Label = label;
    material.Name = this->Style->GetMaterialName(label);
    this->Style->GetMaterialColor(label, material.Color.data());
    return material;
  }

  const Stage* Find(const char* name) const
  {
    const auto at = std::find_if(
      this->All.begin(), this->All.end(), [name](const Stage& s) { return name && std::strcmp(s.Name, name) == 0; });
    return at != this->All.end() ? &*at : nullptr;
  }

  LabelMesh::Feed Labels, Bound;
  /// Holds names and colours, and never runs: they are given to the outputs in the end, so that a change of them runs
  /// no stage.
  vtkNew<vtkLabelSplit> Style;
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

#endif
