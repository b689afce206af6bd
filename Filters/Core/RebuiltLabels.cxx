// SPDX-License-Identifier: BSD-3-Clause
#include "RebuiltLabels.h"

#include "Parallel.h"

#include <limits>

namespace LabelMesh
{
namespace
{
constexpr double LatticeTolerance = 1e-4; // samples: two positions this close are the same

/// The index in `image` of the first sample of `block`.
Vec3 FirstIndex(const IndicatorBlock& block, const Lattice& image)
{
  return image.ToIndex(block.Frame.Origin);
}

/// Lets one block compete for the samples of slice k: the largest so far in labels and first, the next in second.
struct Contest
{
  const Lattice& Image;
  std::vector<LabelMesh::Label>& Labels;
  std::vector<float>& First;
  std::vector<float>& Second;

  void Enter(const IndicatorBlock& block, Index k) const
  {
    const Vec3 start = FirstIndex(block, this->Image);
    const Index offset[3] = { std::lround(start[0]), std::lround(start[1]), std::lround(start[2]) };
    const Index slice = k - offset[2];
    if (slice < 0 || slice >= block.Frame.Dims[2])
    {
      return;
    }
    const Index firstX = std::max<Index>(0, offset[0]);
    const Index lastX = std::min<Index>(this->Image.Dims[0], offset[0] + block.Frame.Dims[0]);
    const Index firstY = std::max<Index>(0, offset[1]);
    const Index lastY = std::min<Index>(this->Image.Dims[1], offset[1] + block.Frame.Dims[1]);
    for (Index j = firstY; j < lastY; ++j)
    {
      const float* values = block.Values + block.Frame.At(0, j - offset[1], slice) - offset[0];
      const Index row = this->Image.At(0, j, k);
      for (Index i = firstX; i < lastX; ++i)
      {
        const float value = values[i];
        const Index at = row + i;
        if (value > this->First[at])
        {
          this->Second[at] = this->First[at];
          this->First[at] = value;
          this->Labels[at] = block.Label;
        }
        else if (value > this->Second[at])
        {
          this->Second[at] = value;
        }
      }
    }
  }
};
}

bool CanRebuildFromSamples(const std::vector<IndicatorBlock>& blocks, const Lattice& image)
{
  for (const IndicatorBlock& block : blocks)
  {
    const Vec3 start = FirstIndex(block, image);
    for (int a = 0; a < 3; ++a)
    {
      const double stretch = std::abs(block.Frame.Spacing[a] / image.Spacing[a] - 1) * block.Frame.Dims[a];
      if (stretch > LatticeTolerance || std::abs(start[a] - std::round(start[a])) > LatticeTolerance)
      {
        return false;
      }
    }
  }
  return true;
}

RebuiltLabels RebuildFromSamples(
  const std::vector<IndicatorBlock>& blocks, const Lattice& image, const Monitor& monitor)
{
  monitor.Step(0.0, "Rebuilding labels");
  constexpr float none = -std::numeric_limits<float>::infinity();
  RebuiltLabels result;
  result.Labels.assign(image.Size(), blocks.empty() ? 0 : blocks.front().Label);
  result.Margin.assign(image.Size(), none);
  std::vector<float> second(image.Size(), none);
  const Contest contest{ image, result.Labels, result.Margin, second };
  const auto rebuildSlice = [&](Index k)
  {
    for (const IndicatorBlock& block : blocks)
    {
      contest.Enter(block, k);
    }
    for (Index at = image.At(0, 0, k); at < image.At(0, 0, k + 1); ++at)
    {
      const float first = result.Margin[at];
      result.Margin[at] = second[at] > none ? first - second[at] : first > none ? 2 * first : 0.0f;
    }
  };
  ParallelFor(0, image.Dims[2], 1,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        rebuildSlice(k);
      }
    });
  monitor.Step(1.0);
  return result;
}

RebuiltLabels RebuildLabels(const IndicatorSet& indicators, const Lattice& image, const Monitor& monitor)
{
  monitor.Step(0.0, "Rebuilding labels");
  RebuiltLabels result;
  result.Labels.resize(image.Size());
  result.Margin.resize(image.Size());
  ParallelFor(0, Index(image.Dims[1]) * image.Dims[2], 16,
    [&](Index first, Index last)
    {
      for (Index at = first * image.Dims[0]; at < last * image.Dims[0]; ++at)
      {
        const auto c = image.Coordinates(at);
        RankedMaterial ranked[2];
        const int count = indicators.Largest(image.Position(c[0], c[1], c[2]), 2, ranked);
        result.Labels[at] = indicators.LabelOf(ranked[0].Material);
        result.Margin[at] = float(count > 1 ? ranked[0].Value - ranked[1].Value : 2 * ranked[0].Value);
      }
    });
  monitor.Step(1.0);
  return result;
}
}
