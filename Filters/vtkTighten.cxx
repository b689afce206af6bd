// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTighten.h"

#include "Core/JointSmoothing.h"
#include "Core/Parallel.h"
#include "Core/PartitionVolumes.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "ServerPieces.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <numeric>

vtkStandardNewMacro(vtkTighten);

namespace
{
using namespace LabelMesh;

constexpr Index LargeBlock = 1 << 20;  // samples: enough work for threads inside one material
constexpr double LargeLoss = 0.5;      // share of the volume that a material may lose without a word
constexpr std::size_t LongestList = 5; // materials that one warning names

TightenOptions OptionsOf(const vtkTighten* filter, LabelMesh::Label label)
{
  TightenOptions options;
  options.Radius = filter->GetMaterialRadius(label);
  options.AntialiasIterations = const_cast<vtkTighten*>(filter)->GetAntialiasIterations();
  options.TightenIterations = const_cast<vtkTighten*>(filter)->GetTightenIterations();
  return options;
}

std::string UnknownLabels(const std::map<vtkIdType, double>& radii, const CollectionHeader& header)
{
  std::string unknown;
  for (const auto& entry : radii)
  {
    const bool known = std::any_of(header.Materials.begin(), header.Materials.end(),
      [&](const Material& material) { return material.Label == entry.first; });
    unknown += known || header.Materials.empty() ? "" : " " + std::to_string(entry.first);
  }
  return unknown;
}

/// One material of the collection.
struct Job
{
  Lattice Frame;
  const std::uint8_t* Mask = nullptr;
  TightenOptions Options;
  vtkSmartPointer<vtkFloatArray> Distance;
  TightenVolumes Volumes;
  std::exception_ptr Problem;
  std::function<void()> Release = []() {}; ///< gives the mask's memory back, if nobody else wants it

  /// Memory for the result.
  float* Place()
  {
    this->Distance = vtkSmartPointer<vtkFloatArray>::New();
    this->Distance->SetName(Names::TightDistance);
    this->Distance->SetNumberOfValues(this->Frame.Size());
    return this->Distance->GetPointer(0);
  }
};

/// Tightens many small materials at once. Each runs in one thread; exceptions wait until all are done.
void TightenTogether(std::vector<Job>& jobs, const std::vector<std::size_t>& chosen)
{
  ParallelFor(0, Index(chosen.size()), 1,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        Job& job = jobs[chosen[n]];
        try
        {
          job.Volumes = Tighten(job.Frame, job.Mask, job.Options, Monitor(), job.Place());
          job.Release();
        }
        catch (...)
        {
          job.Problem = std::current_exception();
        }
      }
    });
  for (const std::size_t n : chosen)
  {
    if (jobs[n].Problem)
    {
      std::rethrow_exception(jobs[n].Problem);
    }
  }
}

/// Large blocks one after another with threads inside, small ones side by side: hundreds of forks and joins for a small
/// block cost more than its work.
void TightenAll(std::vector<Job>& jobs, const std::vector<Material>& materials, const Monitor& monitor)
{
  double total = 1, done = 0; // samples
  for (const Job& job : jobs)
  {
    total += double(job.Frame.Size());
  }
  std::vector<std::size_t> batch;
  Index inBatch = 0;
  const auto finishBatch = [&]()
  {
    if (!batch.empty())
    {
      monitor.Step(done / total,
        "Tightening " + materials[batch.front()].Name +
          (batch.size() > 1 ? " and " + std::to_string(batch.size() - 1) + " more" : ""));
      TightenTogether(jobs, batch);
    }
    done += double(inBatch);
    inBatch = 0;
    batch.clear();
  };
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    Job& job = jobs[n];
    const Index size = job.Frame.Size();
    if (size >= LargeBlock)
    {
      const Monitor part = monitor.Part(done / total, (done + double(size)) / total);
      const std::string& name = materials[n].Name;
      part.Step(0.0, "Tightening " + name);
      const Monitor named(
        [&part, &name](double fraction, const std::string& text)
        {
          part.Step(fraction, text + " of " + name); // throws to stop
          return false;
        });
      job.Volumes = Tighten(job.Frame, job.Mask, job.Options, named, job.Place());
      job.Release();
      done += double(size);
    }
    else
    {
      batch.push_back(n);
      inBatch += size;
      if (inBatch >= 16 * LargeBlock) // to hear of an abort in time
      {
        finishBatch();
      }
    }
  }
  finishBatch();
}

JointSmoothingOptions JointOptionsOf(vtkTighten* filter)
{
  JointSmoothingOptions options;
  options.Rounds = filter->GetRounds();
  options.Fidelity = filter->GetFidelity();
  options.TightenIterations = filter->GetTightenIterations();
  return options;
}

/// All materials of the collection together, in the order of its blocks.
void SmoothTogether(
  std::vector<Job>& jobs, const CollectionHeader& header, const JointSmoothingOptions& options, const Monitor& monitor)
{
  std::vector<MaterialMask> masks;
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    masks.push_back({ header.Materials[n].Name, jobs[n].Frame, jobs[n].Mask, jobs[n].Options.Radius,
      [&job = jobs[n]]()
      {
        job.Release();
        return job.Place();
      } });
  }
  const std::vector<TightenVolumes> volumes =
    SmoothJointly(header.Source.LatticeOf(header.WorkingFrame()), masks, options, monitor);
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    jobs[n].Volumes = volumes[n];
  }
}

/// Share of its volume that a material keeps; 1 where there was none.
double KeptShare(const TightenVolumes& volumes)
{
  return volumes.Mask > 0 ? volumes.Tight / volumes.Mask : 1.0;
}

/// Takes as each material's volume what it holds among all of them; alone, one that its neighbours fill up would look
/// smaller than its mesh will be. The outermost half voxels of the working grid, which no cell covers, are background.
/// With a flat border only what lies in the box of the source's voxels counts.
void MeasurePartition(std::vector<Job>& jobs, const CollectionHeader& header)
{
  if (jobs.empty())
  {
    return;
  }
  Lattice working = header.WorkingFrame().Samples();
  if (header.FlatBorder)
  {
    working = header.Source.Samples(); // its voxels as cells
    working.Origin = header.SourceBox().Low;
    working.Dims = { working.Dims[0] + 1, working.Dims[1] + 1, working.Dims[2] + 1 };
  }
  std::vector<IndicatorBlock> blocks;
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    const double end = jobs[n].Options.Band * jobs[n].Frame.VoxelSize();
    const LabelMesh::Label label = header.Materials[n].Label;
    blocks.push_back(
      { label, jobs[n].Frame, jobs[n].Distance->GetPointer(0), label == header.Background ? end : -end });
  }
  const std::vector<double> volumes = PartitionVolumes(blocks, working);
  const double rest = header.FlatBorder
    ? 0.0
    : double(working.Size()) * working.VoxelVolume() - std::accumulate(volumes.begin(), volumes.end(), 0.0);
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    jobs[n].Volumes.Tight = volumes[n] + (blocks[n].Label == header.Background ? rest : 0.0);
  }
}

/// The volume of a mask within the source grid.
double VolumeInSource(const Job& job, const Lattice& source)
{
  std::array<Index, 3> first, last; // of the block's samples
  for (int a = 0; a < 3; ++a)
  {
    const Index offset = std::lround((source.Origin[a] - job.Frame.Origin[a]) / source.Spacing[a]);
    first[a] = std::max<Index>(offset, 0);
    last[a] = std::min<Index>(offset + source.Dims[a], job.Frame.Dims[a]);
  }
  Index samples = 0;
  for (Index k = first[2]; k < last[2]; ++k)
  {
    for (Index j = first[1]; j < last[1]; ++j)
    {
      const std::uint8_t* const row = job.Mask + job.Frame.At(0, j, k);
      samples += std::count(row + std::min(first[0], last[0]), row + last[0], std::uint8_t(1));
    }
  }
  return double(samples) * source.VoxelVolume();
}

void AddVolumes(vtkFieldData* fieldData, const std::vector<Job>& jobs)
{
  vtkNew<vtkDoubleArray> before, after, kept;
  before->SetName(Names::MaskVolumes);
  after->SetName(Names::TightVolumes);
  kept->SetName(Names::KeptVolumes);
  for (const Job& job : jobs)
  {
    before->InsertNextValue(job.Volumes.Mask);
    after->InsertNextValue(job.Volumes.Tight);
    kept->InsertNextValue(KeptShare(job.Volumes));
  }
  for (vtkDoubleArray* array : { before.Get(), after.Get(), kept.Get() })
  {
    fieldData->AddArray(array);
  }
}

/// What the user should know of materials that are gone or mostly gone; empty when there are none.
std::string LossesOf(const std::vector<Job>& jobs, const CollectionHeader& header)
{
  std::string text;
  std::size_t count = 0;
  for (std::size_t n = 0; n < jobs.size(); ++n)
  {
    const double kept = KeptShare(jobs[n].Volumes);
    if (kept < 1 - LargeLoss && header.Materials[n].Label != header.Background && ++count <= LongestList)
    {
      char figures[128];
      std::snprintf(figures, sizeof(figures),
        kept > 0 ? "loses %.0f %% of its volume (radius %g)" : "vanishes (%.0f %%, radius %g)", 100 * (1 - kept),
        jobs[n].Options.Radius);
      text += (count > 1 ? "; " : "") + header.Materials[n].Name + " " + figures;
    }
  }
  if (count > LongestList)
  {
    text += "; and so do " + std::to_string(count - LongestList) + " more";
  }
  return text;
}
}

void vtkTighten::SetMaterialRadius(vtkIdType label, double radius)
{
  const auto found = this->MaterialRadii.find(label);
  if (found == this->MaterialRadii.end() || found->second != radius)
  {
    this->MaterialRadii[label] = radius;
    this->Modified();
  }
}

void vtkTighten::ClearMaterialRadii()
{
  if (!this->MaterialRadii.empty())
  {
    this->MaterialRadii.clear();
    this->Modified();
  }
}

double vtkTighten::GetMaterialRadius(vtkIdType label) const
{
  const auto found = this->MaterialRadii.find(label);
  return found == this->MaterialRadii.end() ? this->Radius : found->second;
}

int vtkTighten::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkTighten::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkTighten::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  CopyPublishedFrame(inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
  return 1;
}

int vtkTighten::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkTighten::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputVector, 0);
  const bool first = RequestedPiece(request, outputVector).IsFirst();
  const bool givenUp = first && IsGivenUp(inputVector[0]->GetInformationObject(0));
  const int done = RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(input);
      if (!first)
      {
        AppendEmptyBlocks(output, header);
        return;
      }
      std::vector<Job> jobs(header.Materials.size());
      std::vector<double> inSource(jobs.size()); // masks with a flat border go on beyond it
      for (unsigned int n = 0; n < jobs.size(); ++n)
      {
        jobs[n].Frame = header.Source.LatticeOf(FrameOf(BlockImage(input, n)));
        jobs[n].Mask = BlockMask(input, n);
        jobs[n].Options = OptionsOf(this, header.Materials[n].Label);
        inSource[n] = header.FlatBorder ? VolumeInSource(jobs[n], header.Source.Samples()) : 0.0;
        if (givenUp)
        {
          jobs[n].Release = [input, n]() { TakeArray(input, n, Names::Mask); };
        }
      }
      const std::string unknown = UnknownLabels(this->MaterialRadii, header);
      if (!unknown.empty())
      {
        vtkWarningMacro("SetMaterialRadius names labels that are not among the materials:" << unknown << ".");
      }
      const bool together = this->Smoothing == VolumeKeeping && !jobs.empty();
      if (together)
      {
        SmoothTogether(jobs, header, JointOptionsOf(this), monitor);
      }
      else
      {
        TightenAll(jobs, header.Materials, monitor);
      }
      MeasurePartition(jobs, header);
      for (std::size_t n = 0; n < jobs.size(); ++n)
      {
        jobs[n].Volumes.Mask = header.FlatBorder ? inSource[n] : jobs[n].Volumes.Mask;
      }
      const std::string losses = LossesOf(jobs, header);
      if (!losses.empty())
      {
        vtkWarningMacro("" << losses << ". Give what is thin a smaller radius with SetMaterialRadius, "
                           << (together ? "" : "volume-keeping smoothing, ")
                           << "or a finer grid with the resampling factor of Label Split.");
      }
      if (input->GetFieldData())
      {
        output->GetFieldData()->ShallowCopy(input->GetFieldData());
      }
      for (unsigned int n = 0; n < jobs.size(); ++n)
      {
        AppendBlock(output, header.Materials[n], FrameOf(BlockImage(input, n)), jobs[n].Distance);
      }
      WriteHeader(output, header);
      AddVolumes(output->GetFieldData(), jobs);
    });
  if (!done && givenUp)
  {
    input->ReleaseData(); // it may not be whole any more
  }
  return done;
}

void vtkTighten::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Smoothing: " << (this->Smoothing == Tightening ? "Tightening" : "VolumeKeeping") << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "MaterialRadii:";
  for (const auto& [label, radius] : this->MaterialRadii)
  {
    os << " " << label << ": " << radius;
  }
  os << "\n" << indent << "AntialiasIterations: " << this->AntialiasIterations << "\n";
  os << indent << "TightenIterations: " << this->TightenIterations << "\n";
  os << indent << "Fidelity: " << this->Fidelity << "\n";
  os << indent << "Rounds: " << this->Rounds << "\n";
}
