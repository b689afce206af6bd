// SPDX-License-Identifier: BSD-3-Clause
#include "PartitionVolumes.h"

#include "CubicPoints.h"
#include "Parallel.h"

#include <limits>

namespace LabelMesh
{
namespace
{
using Cubic = CubicPoints<4>; // of a cell

constexpr Index LayersAtOnce = 8; // of cells: one task reads one slice of samples more

/// A block's field at the samples of the working lattice.
class WorkingField
{
public:
  WorkingField(const IndicatorBlock& block, const Lattice& working)
    : Block(block)
    , Working(working)
  {
    const Vec3 first = working.ToIndex(block.Frame.Origin);
    const Vec3 end = block.Frame.Position(block.Frame.Dims[0] - 1, block.Frame.Dims[1] - 1, block.Frame.Dims[2] - 1);
    const Vec3 last = working.ToIndex(end);
    constexpr double close = 1e-3; // samples
    for (int a = 0; a < 3; ++a)
    {
      this->First[a] = std::max<Index>(0, Index(std::ceil(first[a] - close)));
      this->Last[a] = std::min<Index>(working.Dims[a] - 1, Index(std::floor(last[a] + close)));
      this->Offset[a] = std::lround(first[a]);
      this->Shared = this->Shared && std::abs(first[a] - double(this->Offset[a])) < close &&
        std::abs(last[a] - double(this->Offset[a] + block.Frame.Dims[a] - 1)) < close;
    }
  }

  bool Covers(Index i, Index j, Index k) const
  {
    return i >= this->First[0] && i <= this->Last[0] && j >= this->First[1] && j <= this->Last[1] &&
      k >= this->First[2] && k <= this->Last[2];
  }
  float Value(Index i, Index j, Index k) const
  {
    return this->Covers(i, j, k) ? this->Inner(i, j, k) : float(this->Block.Outside);
  }
  /// The 4^3 samples from this one on.
  void Stencil(Index i, Index j, Index k, Cubic::Samples& samples) const
  {
    const bool inside = this->Shared && this->Covers(i, j, k) && this->Covers(i + 3, j + 3, k + 3);
    float* to = samples.data();
    for (Index z = k; z < k + 4; ++z)
    {
      for (Index y = j; y < j + 4; ++y, to += 4)
      {
        for (Index x = 0; x < 4; ++x)
        {
          to[x] = inside ? this->Sample(i, y, z)[x] : this->Value(i + x, y, z);
        }
      }
    }
  }
  /// Takes part in slice k, whose largest values and their materials are these; as the first it takes its place in any
  /// case.
  void Compete(int own, Index k, bool first, float* largest, std::int32_t* winners) const
  {
    if (k < this->First[2] || k > this->Last[2])
    {
      return;
    }
    std::vector<float> between;
    const Index count = this->Last[0] - this->First[0] + 1;
    for (Index j = this->First[1]; j <= this->Last[1] && count > 0; ++j)
    {
      const float* values = nullptr;
      if (this->Shared)
      {
        values = this->Sample(this->First[0], j, k);
      }
      else
      {
        between.clear();
        for (Index i = this->First[0]; i <= this->Last[0]; ++i)
        {
          between.push_back(this->Inner(i, j, k));
        }
        values = between.data();
      }
      float* const best = largest + this->First[0] + this->Working.Dims[0] * j;
      std::int32_t* const winner = winners + this->First[0] + this->Working.Dims[0] * j;
      if (first)
      {
        std::copy_n(values, count, best);
        std::fill_n(winner, count, own);
      }
#pragma omp simd
      for (Index i = 0; i < count; ++i)
      {
        winner[i] = values[i] > best[i] ? own : winner[i];
        best[i] = values[i] > best[i] ? values[i] : best[i];
      }
    }
  }

private:
  const float* Sample(Index i, Index j, Index k) const
  {
    return this->Block.Values + this->Block.Frame.At(i - this->Offset[0], j - this->Offset[1], k - this->Offset[2]);
  }
  float Inner(Index i, Index j, Index k) const
  {
    return this->Shared ? *this->Sample(i, j, k) : this->Trilinear(this->Working.Position(i, j, k));
  }
  float Trilinear(const Vec3& x) const
  {
    const Lattice& frame = this->Block.Frame;
    const Vec3 index = frame.ToIndex(x);
    Index low[3], high[3];
    double t[3];
    for (int a = 0; a < 3; ++a)
    {
      const double u = std::clamp(index[a], 0.0, double(frame.Dims[a] - 1));
      low[a] = Index(u);
      high[a] = std::min<Index>(low[a] + 1, frame.Dims[a] - 1);
      t[a] = u - double(low[a]);
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c)
    {
      const bool right = c & 1, back = c & 2, up = c & 4;
      sum += (right ? t[0] : 1 - t[0]) * (back ? t[1] : 1 - t[1]) * (up ? t[2] : 1 - t[2]) *
        double(this->Block.Values[frame.At(right ? high[0] : low[0], back ? high[1] : low[1], up ? high[2] : low[2])]);
    }
    return float(sum);
  }

  const IndicatorBlock& Block;
  const Lattice& Working;
  std::array<Index, 3> First, Last, Offset;
  bool Shared = true; ///< its samples are some of the working lattice's
};

/// A number of parts of cells that belong to a material.
struct Share
{
  int Material;
  Index Parts;
};

void CutCell(const std::vector<WorkingField>& fields, const std::array<int, 8>& materials, Index i, Index j, Index k,
  std::vector<Share>& shares)
{
  static const Cubic cubic;
  std::array<int, 8> distinct = materials;
  std::sort(distinct.begin(), distinct.end());
  const auto end = std::unique(distinct.begin(), distinct.end());
  Cubic::Points largest, values;
  std::array<std::int32_t, Cubic::Count> winners;
  largest.fill(std::numeric_limits<float>::lowest());
  winners.fill(distinct[0]);
  for (auto material = distinct.begin(); material != end; ++material)
  {
    Cubic::Samples samples;
    fields[*material].Stencil(i - 1, j - 1, k - 1, samples);
    cubic.Interpolate(samples, values);
#pragma omp simd
    for (int part = 0; part < Cubic::Count; ++part)
    {
      winners[part] = values[part] > largest[part] ? *material : winners[part];
      largest[part] = values[part] > largest[part] ? values[part] : largest[part];
    }
  }
  for (auto material = distinct.begin(); material != end; ++material)
  {
    shares.push_back({ *material, Index(std::count(winners.begin(), winners.end(), *material)) });
  }
}

/// Counts the cells between two slices of winners.
void CountLayer(const std::vector<WorkingField>& fields, const Lattice& frame, const std::int32_t* lower,
  const std::int32_t* upper, Index k, std::vector<Index>& parts, std::vector<Share>& cut)
{
  const Index nx = frame.Dims[0];
  cut.clear();
  for (Index j = 0; j + 1 < frame.Dims[1]; ++j)
  {
    const std::int32_t* const rows[4] = { lower + nx * j, lower + nx * (j + 1), upper + nx * j, upper + nx * (j + 1) };
    for (Index i = 0; i + 1 < nx; ++i)
    {
      const std::int32_t first = rows[0][i];
      std::int32_t differ = 0;
      for (const std::int32_t* row : rows)
      {
        differ |= (row[i] ^ first) | (row[i + 1] ^ first);
      }
      if (!differ)
      {
        parts[first] += Cubic::Count;
        continue;
      }
      std::array<int, 8> materials;
      for (int c = 0; c < 8; ++c)
      {
        materials[c] = rows[c >> 1][i + (c & 1)];
      }
      CutCell(fields, materials, i, j, k, cut);
    }
  }
  for (const Share& share : cut)
  {
    parts[share.Material] += share.Parts;
  }
}
}

std::vector<double> PartitionVolumes(const std::vector<IndicatorBlock>& blocks, const Lattice& working)
{
  if (blocks.empty())
  {
    return {};
  }
  std::vector<WorkingField> fields;
  for (const IndicatorBlock& block : blocks)
  {
    fields.emplace_back(block, working);
  }
  const Index layers = std::max(working.Dims[2] - 1, 0), slice = Index(working.Dims[0]) * working.Dims[1];
  const Index tasks = (layers + LayersAtOnce - 1) / LayersAtOnce;
  // Where no block reaches, the one with the largest value beyond its samples wins.
  int beyond = 0;
  for (std::size_t m = 0; m < blocks.size(); ++m)
  {
    beyond = blocks[m].Outside > blocks[beyond].Outside ? int(m) : beyond;
  }
  // Whole numbers: their sum is the same in any order.
  const std::vector<Share> shares = ParallelCollect<Share>(tasks,
    [&](Index task, std::vector<Share>& found)
    {
      std::vector<float> largest(static_cast<std::size_t>(slice));
      std::vector<std::int32_t> lower(largest.size()), upper(largest.size());
      std::vector<Index> parts(blocks.size(), 0);
      std::vector<Share> cut;
      for (Index k = task * LayersAtOnce; k <= std::min(layers, (task + 1) * LayersAtOnce); ++k)
      {
        std::fill(largest.begin(), largest.end(), float(blocks[beyond].Outside));
        std::fill(upper.begin(), upper.end(), beyond);
        fields[beyond].Compete(beyond, k, true, largest.data(), upper.data());
        for (std::size_t m = 0; m < fields.size(); ++m)
        {
          fields[m].Compete(int(m), k, false, largest.data(), upper.data());
        }
        if (k > task * LayersAtOnce)
        {
          CountLayer(fields, working, lower.data(), upper.data(), k - 1, parts, cut);
        }
        lower.swap(upper);
      }
      for (std::size_t m = 0; m < blocks.size(); ++m)
      {
        if (parts[m] > 0)
        {
          found.push_back({ int(m), parts[m] });
        }
      }
    });
  std::vector<double> volumes(blocks.size(), 0.0);
  for (const Share& share : shares)
  {
    volumes[share.Material] += double(share.Parts) / Cubic::Count * working.VoxelVolume();
  }
  return volumes;
}
}
