// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialMasks.h"

#include "DistanceTransform.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
/// The source samples that a new sample along one axis sees.
struct Support
{
  int First = 0;
  int Nearest = 0;
  std::vector<double> Weights;
};

std::vector<Support> SupportsAlong(int axis, const GridFrame& from, const GridFrame& to)
{
  const Lattice source = from.Samples(), target = from.LatticeOf(to);
  const double ratio = target.Spacing[axis] / source.Spacing[axis];
  const double width = std::max(1.0, ratio); // of half the tent, in source samples
  std::vector<Support> supports(static_cast<std::size_t>(target.Dims[axis]));
  for (int i = 0; i < target.Dims[axis]; ++i)
  {
    const double center = (target.Origin[axis] - source.Origin[axis]) / source.Spacing[axis] + i * ratio;
    Support& support = supports[i];
    support.Nearest = std::clamp(int(std::lround(center)), 0, source.Dims[axis] - 1);
    support.First = std::max(0, int(std::floor(center - width)) + 1);
    const int last = std::min(source.Dims[axis] - 1, int(std::ceil(center + width)) - 1);
    for (int s = support.First; s <= last; ++s)
    {
      support.Weights.push_back(1 - std::abs(s - center) / width);
    }
  }
  return supports;
}

/// Sums of weights per id; few ids meet in a support.
class Votes
{
public:
  void Add(MaterialId id, double weight)
  {
    for (auto& [known, sum] : this->Sums)
    {
      if (known == id)
      {
        sum += weight;
        return;
      }
    }
    this->Sums.emplace_back(id, weight);
  }
  MaterialId Winner() const
  {
    constexpr double tie = 1e-9; // of a sum of weights: what rounding may do
    MaterialId best = NoMaterial;
    double most = -1;
    for (const auto& [id, sum] : this->Sums)
    {
      if (sum > most + tie || (sum > most - tie && id < best))
      {
        best = id;
        most = sum;
      }
    }
    return best;
  }
  void Clear() { this->Sums.clear(); }

private:
  std::vector<std::pair<MaterialId, double>> Sums;
};
}

GridFrame Resampled(const GridFrame& source, double factor)
{
  if (factor == 1.0)
  {
    return source;
  }
  const Lattice samples = source.Samples();
  std::array<int, 6> extent{ 0, 0, 0, 0, 0, 0 };
  Vec3 spacing, first;
  for (int a = 0; a < 3; ++a)
  {
    const double count = std::max(1.0, std::round(samples.Dims[a] * factor));
    if (!(count < std::numeric_limits<int>::max()))
    {
      throw std::invalid_argument(
        "A resampling factor of " + std::to_string(factor) + " gives more samples than an image can have.");
    }
    extent[2 * a + 1] = int(count) - 1;
    spacing[a] = samples.Spacing[a] * samples.Dims[a] / count;
    first[a] = samples.Origin[a] - 0.5 * samples.Spacing[a] + 0.5 * spacing[a];
  }
  return GridFrame(extent, source.LocalToWorld(first), spacing, source.Direction());
}

std::vector<MaterialId> ResampleLabels(const std::vector<MaterialId>& ids, const GridFrame& from, const GridFrame& to,
  const std::vector<std::uint8_t>* repeated)
{
  const Lattice source = from.Samples(), target = to.Samples();
  const std::vector<Support> x = SupportsAlong(0, from, to), y = SupportsAlong(1, from, to),
                             z = SupportsAlong(2, from, to);
  std::vector<MaterialId> resampled(static_cast<std::size_t>(target.Size()));
  ParallelFor(0, Index(target.Dims[1]) * target.Dims[2], 0,
    [&](Index firstRow, Index lastRow)
    {
      Votes votes;
      for (Index row = firstRow; row < lastRow; ++row)
      {
        const Support& sy = y[row % target.Dims[1]];
        const Support& sz = z[row / target.Dims[1]];
        for (int i = 0; i < target.Dims[0]; ++i)
        {
          const Support& sx = x[i];
          const Index nearest = source.At(sx.Nearest, sy.Nearest, sz.Nearest);
          if (repeated && (*repeated)[nearest])
          {
            resampled[row * target.Dims[0] + i] = ids[nearest];
            continue;
          }
          votes.Clear();
          for (std::size_t c = 0; c < sz.Weights.size(); ++c)
          {
            for (std::size_t b = 0; b < sy.Weights.size(); ++b)
            {
              const Index first = source.At(sx.First, sy.First + Index(b), sz.First + Index(c));
              for (std::size_t a = 0; a < sx.Weights.size(); ++a)
              {
                const double weight = repeated && (*repeated)[first + Index(a)] ? 0.0 : sx.Weights[a];
                votes.Add(ids[first + Index(a)], weight * sy.Weights[b] * sz.Weights[c]);
              }
            }
          }
          resampled[row * target.Dims[0] + i] = votes.Winner();
        }
      }
    });
  return resampled;
}

int BlockReach(const Lattice& lattice, int axis, int padding)
{
  constexpr int bandVoxels = 5;
  const int band = int(std::ceil(std::min(padding, bandVoxels) * lattice.VoxelSize() / lattice.Spacing[axis]));
  return std::max(padding, band);
}

std::vector<Box> BoxesOf(const std::vector<MaterialId>& ids, const Lattice& lattice, int count)
{
  const int limit = std::numeric_limits<int>::max();
  std::vector<Box> boxes(static_cast<std::size_t>(count), Box{ limit, -1, limit, -1, limit, -1 });
  Index at = 0;
  for (int k = 0; k < lattice.Dims[2]; ++k)
  {
    for (int j = 0; j < lattice.Dims[1]; ++j)
    {
      for (int i = 0; i < lattice.Dims[0];)
      {
        const MaterialId id = ids[at];
        const int first = i;
        while (i < lattice.Dims[0] && ids[at] == id)
        {
          ++i;
          ++at;
        }
        Box& box = boxes[id];
        box = { std::min(box[0], first), std::max(box[1], i - 1), std::min(box[2], j), std::max(box[3], j),
          std::min(box[4], k), std::max(box[5], k) };
      }
    }
  }
  return boxes;
}

namespace
{
/// Calls set(sample of the box, whether it has the id) for all samples of the box.
template <typename Set>
void ForBox(const std::vector<MaterialId>& ids, const Lattice& lattice, MaterialId id, MaterialId background,
  const Box& box, Index layers, Set&& set)
{
  const auto within = [&](int axis, Index c) { return c >= -layers && c < lattice.Dims[axis] + layers; };
  const auto nearest = [&](int axis, Index c) { return std::clamp<Index>(c, 0, lattice.Dims[axis] - 1); };
  const Index nx = box[1] - box[0] + 1, ny = box[3] - box[2] + 1, nz = box[5] - box[4] + 1;
  const bool beyond = id == background;
  ParallelFor(0, ny * nz, 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const Index j = box[2] + row % ny, k = box[4] + row / ny;
        const MaterialId* from =
          within(1, j) && within(2, k) ? ids.data() + lattice.At(0, nearest(1, j), nearest(2, k)) : nullptr;
        for (Index i = box[0]; i <= box[1]; ++i)
        {
          set(row * nx + i - box[0], from && within(0, i) ? from[nearest(0, i)] == id : beyond);
        }
      }
    });
}
}

void MaskOf(const std::vector<MaterialId>& ids, const Lattice& lattice, MaterialId id, MaterialId background,
  const Box& box, const MaskOptions& options, std::uint8_t* mask)
{
  Lattice block = lattice;
  block.Dims = { box[1] - box[0] + 1, box[3] - box[2] + 1, box[5] - box[4] + 1 };
  if (!(options.OpeningRadius > 0) && !(options.ClosingRadius > 0))
  {
    ForBox(
      ids, lattice, id, background, box, options.ContinuedLayers, [mask](Index at, bool inside) { mask[at] = inside; });
    return;
  }
  // Balls around samples of the box reach beyond it.
  Box wide = box;
  Lattice grown = block;
  std::array<int, 3> margin;
  for (int a = 0; a < 3; ++a)
  {
    margin[a] = int(std::ceil(std::max(options.OpeningRadius, options.ClosingRadius) / lattice.Spacing[a])) + 1;
    wide[2 * a] -= margin[a];
    wide[2 * a + 1] += margin[a];
    grown.Dims[a] += 2 * margin[a];
  }
  Sides sides(static_cast<std::size_t>(grown.Size()));
  ForBox(
    ids, lattice, id, background, wide, options.ContinuedLayers, [&](Index at, bool inside) { sides[at] = inside; });
  if (options.OpeningRadius > 0)
  {
    sides = Opened(grown, sides, options.OpeningRadius);
  }
  if (options.ClosingRadius > 0)
  {
    sides = Closed(grown, sides, options.ClosingRadius);
  }
  for (Index at = 0; at < block.Size(); ++at)
  {
    const auto c = block.Coordinates(at);
    mask[at] = sides[grown.At(c[0] + margin[0], c[1] + margin[1], c[2] + margin[2])];
  }
}
}
