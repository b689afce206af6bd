// SPDX-License-Identifier: BSD-3-Clause
#include "LabelPreparation.h"

#include "Core/MaterialMasks.h"
#include "Core/SmallComponents.h"
#include "LabelMeshNames.h"
#include "MemoryEstimate.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
/// The labels that ask for a finer grid, and how much of them does.
std::string WordsOf(const LabelImage& image, const DelicateParts& parts)
{
  constexpr std::size_t shown = 5;
  std::string words;
  for (std::size_t n = 0; n < std::min(shown, parts.Labels.size()); ++n)
  {
    const DelicateLabel& label = parts.Labels[n];
    std::array<char, 160> figures{};
    std::snprintf(figures.data(), figures.size(),
      "%s%lld (%lld voxels, %.0f %% under two voxels thick, %.0f %% in components of fewer than 300)", n ? ", " : "",
      static_cast<long long>(image.Labels[label.Id]), static_cast<long long>(label.Voxels),
      100.0 * double(label.ThinVoxels) / double(label.Voxels),
      100.0 * double(label.SmallVoxels) / double(label.Voxels));
    words += figures.data();
  }
  return words + (parts.Labels.size() > shown ? " and " + std::to_string(parts.Labels.size() - shown) + " more" : "");
}

void ResampleTo(LabelImage& image, double factor, const std::vector<std::uint8_t>* repeated)
{
  const GridFrame resampled = Resampled(image.Frame, factor);
  image.Ids = ResampleLabels(image.Ids, image.Frame, resampled, repeated);
  image.Frame = resampled;
}
}

void DropSmall(LabelImage& image, Label background, Index least, vtkFieldData* fieldData)
{
  const Lattice samples = image.Frame.Samples();
  const std::vector<DroppedComponent> dropped =
    DropSmallComponents(samples.Dims, image.Ids, IdOf(image, background), int(image.Labels.size()), least);
  vtkNew<vtkTypeInt64Array> labels, into, voxels;
  vtkNew<vtkDoubleArray> positions;
  labels->SetName(Names::DroppedLabels);
  into->SetName(Names::DroppedInto);
  voxels->SetName(Names::DroppedVoxels);
  positions->SetName(Names::DroppedPositions);
  positions->SetNumberOfComponents(3);
  const std::array<int, 6>& extent = image.Frame.Extent();
  for (const DroppedComponent& component : dropped)
  {
    labels->InsertNextValue(image.Labels[component.From]);
    into->InsertNextValue(image.Labels[component.To]);
    voxels->InsertNextValue(component.Voxels);
    const std::array<int, 3> at = samples.Coordinates(component.First);
    positions->InsertNextTuple(image.Frame.ToWorld(extent[0] + at[0], extent[2] + at[1], extent[4] + at[2]).data());
  }
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(labels.Get()), static_cast<vtkDataArray*>(into.Get()),
         static_cast<vtkDataArray*>(voxels.Get()), static_cast<vtkDataArray*>(positions.Get()) })
  {
    fieldData->AddArray(array);
  }
  std::vector<bool> occurs(image.Labels.size(), false);
  for (const MaterialId id : image.Ids)
  {
    occurs[id] = true;
  }
  std::vector<Label> left;
  std::copy_if(image.Labels.begin(), image.Labels.end(), std::back_inserter(left),
    [&](Label label) { return occurs[IdOf(image, label)]; });
  MergeIntoBackground(image, left, background);
}

Upsampling ChooseUpsampling(const LabelImage& image, const UpsamplingOptions& options)
{
  constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
  Upsampling chosen;
  if (options.Limit < 2)
  {
    return chosen;
  }
  chosen.Parts = FindDelicateParts(image.Frame.Samples().Dims, image.Ids, IdOf(image, options.Background),
    int(image.Labels.size()), options.FlatBorder, options.Limit);
  const auto memory = [&](int factor)
  { return EstimateMemory(image, options.Background, options.Padding, factor) / gibibyte; };
  chosen.Factor = chosen.Parts.Factor;
  while (chosen.Factor > 1 && options.MemoryLimit > 0 && memory(chosen.Factor) > options.MemoryLimit)
  {
    --chosen.Factor;
    chosen.HeldByMemory = true;
  }
  if (chosen.Parts.Factor == 1)
  {
    chosen.Reason = "One sample per voxel along each axis: no label asks for more.";
    return chosen;
  }
  std::array<char, 200> figures{};
  std::snprintf(figures.data(), figures.size(),
    "%d sample%s per voxel along each axis%s, about %.2f GiB (%.2f with one), for %zu label%s: ", chosen.Factor,
    chosen.Factor > 1 ? "s" : "",
    chosen.HeldByMemory
      ? (" instead of " + std::to_string(chosen.Parts.Factor) + ", since the memory limit allows no more").c_str()
      : "",
    memory(chosen.Factor), memory(1), chosen.Parts.Labels.size(), chosen.Parts.Labels.size() > 1 ? "s" : "");
  chosen.Reason = figures.data() + WordsOf(image, chosen.Parts) + ".";
  return chosen;
}

void WriteUpsampling(vtkFieldData* fieldData, const Upsampling& upsampling)
{
  if (upsampling.Reason.empty())
  {
    return;
  }
  vtkNew<vtkIntArray> factor;
  factor->SetName(Names::Upsampling);
  factor->InsertNextValue(upsampling.Factor);
  fieldData->AddArray(factor);
  vtkNew<vtkStringArray> reason;
  reason->SetName(Names::UpsamplingReason);
  reason->InsertNextValue(upsampling.Reason);
  fieldData->AddArray(reason);
}

void Resample(LabelImage& image, double factor)
{
  if (!(factor > 0))
  {
    throw std::invalid_argument(
      "The resampling factor is " + std::to_string(factor) + "; expected more than 0 samples per voxel.");
  }
  if (factor != 1.0)
  {
    ResampleTo(image, factor, nullptr);
  }
}

void Resample(LabelImage& image, const Upsampling& upsampling)
{
  if (upsampling.Factor > 1)
  {
    ResampleTo(image, upsampling.Factor, &upsampling.Parts.Delicate);
  }
}
}
