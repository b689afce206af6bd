// SPDX-License-Identifier: BSD-3-Clause
// How an IndicatorSet is prepared: labels of the working samples, and which materials can win where.
#include "IndicatorSet.h"

#include "Parallel.h"

namespace LabelMesh
{
namespace
{
constexpr int TileSize = IndicatorSet::TileSize;
constexpr double LatticeTolerance = 1e-4; // samples: two positions this close are the same

/// Where a row of m's values is larger than what was the largest (or m is the first), it becomes the largest.
void Compete(MaterialId m, bool isFirst, const float* __restrict values, Index count, float* __restrict largest,
  MaterialId* __restrict labels)
{
  for (Index i = 0; i < count; ++i)
  {
    const bool wins = isFirst || values[i] > largest[i];
    largest[i] = wins ? values[i] : largest[i];
    labels[i] = wins ? m : labels[i];
  }
}

/// Marks the samples of a row where a value is at most `slack` below the largest.
void MarkWinners(const float* __restrict values, const float* __restrict largest, Index count, float slack,
  std::int32_t* __restrict marks)
{
  for (Index i = 0; i < count; ++i)
  {
    marks[i] |= std::int32_t(values[i] >= largest[i] - slack);
  }
}
}

IndicatorSet::SampleBox IndicatorSet::WorkingSamples(const Lattice& block) const
{
  SampleBox box;
  const Vec3 low = this->Working_.ToIndex(block.Origin);
  const Vec3 high = this->Working_.ToIndex(block.Position(block.Dims[0] - 1, block.Dims[1] - 1, block.Dims[2] - 1));
  box.Aligned = true;
  for (int a = 0; a < 3; ++a)
  {
    box.First[a] = std::max<Index>(0, Index(std::ceil(low[a] - LatticeTolerance)));
    box.Last[a] = std::min<Index>(this->Working_.Dims[a] - 1, Index(std::floor(high[a] + LatticeTolerance)));
    box.Offset[a] = std::lround(low[a]);
    box.Aligned = box.Aligned && std::abs(low[a] - double(box.Offset[a])) < LatticeTolerance &&
      std::abs(high[a] - double(box.Offset[a] + block.Dims[a] - 1)) < LatticeTolerance;
  }
  return box;
}

std::vector<float> IndicatorSet::FindLabels()
{
  const Lattice& working = this->Working_;
  // Where no block reaches, the material with the largest value beyond its block wins: the background.
  MaterialId beyond = 0;
  for (std::size_t m = 0; m < this->Blocks.size(); ++m)
  {
    this->Boxes.push_back(this->WorkingSamples(this->Blocks[m].Frame));
    if (this->Blocks[m].Outside > this->Blocks[beyond].Outside)
    {
      beyond = MaterialId(m);
    }
  }
  this->Labels_.assign(working.Size(), beyond);
  std::vector<float> largest(working.Size(), float(this->Blocks[beyond].Outside));
  const auto compete = [&](MaterialId m, Index k)
  {
    const IndicatorBlock& block = this->Blocks[m];
    const SampleBox& box = this->Boxes[m];
    const Index count = box.Last[0] - box.First[0] + 1;
    std::vector<float> row(std::max<Index>(count, 0));
    for (Index j = box.First[1]; j <= box.Last[1]; ++j)
    {
      const float* values = row.data();
      if (box.Aligned)
      {
        values = block.Values + block.Frame.At(box.First[0] - box.Offset[0], j - box.Offset[1], k - box.Offset[2]);
      }
      else
      {
        for (Index i = 0; i < count; ++i)
        {
          row[i] = float(this->Value(m, working.Position(double(box.First[0] + i), double(j), double(k))));
        }
      }
      const Index at = working.At(box.First[0], j, k);
      Compete(m, m == beyond, values, count, largest.data() + at, this->Labels_.data() + at);
    }
  };
  ParallelFor(0, working.Dims[2], 1,
    [&](Index firstSlice, Index lastSlice)
    {
      for (Index k = firstSlice; k < lastSlice; ++k)
      {
        // First the one that was assumed everywhere, then its rivals.
        const auto reaches = [&](MaterialId m) { return k >= this->Boxes[m].First[2] && k <= this->Boxes[m].Last[2]; };
        if (reaches(beyond))
        {
          compete(beyond, k);
        }
        for (std::size_t m = 0; m < this->Blocks.size(); ++m)
        {
          if (m != beyond && reaches(MaterialId(m)))
          {
            compete(MaterialId(m), k);
          }
        }
      }
    });
  return largest;
}

void IndicatorSet::FindCandidates(const std::vector<float>& largest)
{
  const Lattice& working = this->Working_;
  for (int a = 0; a < 3; ++a)
  {
    this->TileDims[a] = std::max(1, (working.Dims[a] - 1 + TileSize - 1) / TileSize);
  }
  const Index perLayer = Index(this->TileDims[0]) * this->TileDims[1];
  std::vector<std::vector<MaterialId>> layers(this->TileDims[2]);
  this->TileStarts.assign(perLayer * this->TileDims[2] + 1, 0);
  ParallelFor(0, this->TileDims[2], 1,
    [&](Index first, Index last)
    {
      std::vector<std::vector<MaterialId>> tiles(perLayer);
      for (Index k = first; k < last; ++k)
      {
        for (std::size_t m = 0; m < this->Blocks.size(); ++m)
        {
          this->FindTilesOf(MaterialId(m), k, largest, tiles);
        }
        for (Index t = 0; t < perLayer; ++t)
        {
          if (tiles[t].empty())
          {
            tiles[t].push_back(
              this->Labels_[working.At(std::min<Index>(t % this->TileDims[0] * TileSize, working.Dims[0] - 1),
                std::min<Index>(t / this->TileDims[0] * TileSize, working.Dims[1] - 1),
                std::min<Index>(k * TileSize, working.Dims[2] - 1))]);
          }
          layers[k].insert(layers[k].end(), tiles[t].begin(), tiles[t].end());
          this->TileStarts[k * perLayer + t + 1] = Index(tiles[t].size());
          tiles[t].clear();
        }
      }
    });
  for (std::size_t t = 1; t < this->TileStarts.size(); ++t)
  {
    this->TileStarts[t] += this->TileStarts[t - 1];
  }
  this->CandidateIds.reserve(this->TileStarts.back());
  for (const auto& ids : layers)
  {
    this->CandidateIds.insert(this->CandidateIds.end(), ids.begin(), ids.end());
  }
}

void IndicatorSet::FindTilesOf(
  MaterialId m, Index tileLayer, const std::vector<float>& largest, std::vector<std::vector<MaterialId>>& tiles) const
{
  const Lattice& working = this->Working_;
  const IndicatorBlock& block = this->Blocks[m];
  const SampleBox& box = this->Boxes[m];
  if (box.Aligned)
  {
    this->FindAlignedTilesOf(m, tileLayer, largest, tiles);
    return;
  }
  // A block on a lattice of its own is compared with the nearest working sample: its diagonal comes on top.
  const float slack = float(this->Slack() + block.Frame.Spacing.norm() + working.Spacing.norm());
  // The block's samples in the tile's cells, or one more on either side where the lattices differ.
  const auto samples = [&](int axis, Index tile, Index& first, Index& last)
  {
    const double low = working.Origin[axis] + double(tile * TileSize) * working.Spacing[axis];
    const double high = low + TileSize * working.Spacing[axis];
    const auto& frame = block.Frame;
    first = Index(std::floor((low - frame.Origin[axis]) / frame.Spacing[axis] + LatticeTolerance));
    last = Index(std::ceil((high - frame.Origin[axis]) / frame.Spacing[axis] - LatticeTolerance));
    first = std::max<Index>(first, 0);
    last = std::min<Index>(last, frame.Dims[axis] - 1);
    return first <= last;
  };
  const auto nearest = [&](int axis, Index sample)
  {
    const double local = block.Frame.Origin[axis] + double(sample) * block.Frame.Spacing[axis];
    return std::clamp<Index>(
      std::lround((local - working.Origin[axis]) / working.Spacing[axis]), 0, working.Dims[axis] - 1);
  };
  const auto canWin = [&](const Index first[3], const Index last[3])
  {
    for (Index k = first[2]; k <= last[2]; ++k)
    {
      const Index wk = nearest(2, k);
      for (Index j = first[1]; j <= last[1]; ++j)
      {
        const Index wj = nearest(1, j);
        for (Index i = first[0]; i <= last[0]; ++i)
        {
          if (block.Values[block.Frame.At(i, j, k)] >= largest[working.At(nearest(0, i), wj, wk)] - slack)
          {
            return true;
          }
        }
      }
    }
    return false;
  };
  Index first[3], last[3];
  if (!samples(2, tileLayer, first[2], last[2]))
  {
    return;
  }
  const Vec3 low = working.ToIndex(block.Frame.Origin) / TileSize;
  for (Index tj = std::max<Index>(0, Index(low[1]) - 1); tj < this->TileDims[1]; ++tj)
  {
    if (!samples(1, tj, first[1], last[1]))
    {
      if (first[1] >= block.Frame.Dims[1])
      {
        break;
      }
      continue;
    }
    for (Index ti = std::max<Index>(0, Index(low[0]) - 1); ti < this->TileDims[0]; ++ti)
    {
      if (samples(0, ti, first[0], last[0]))
      {
        if (canWin(first, last))
        {
          tiles[ti + this->TileDims[0] * tj].push_back(m);
        }
      }
      else if (first[0] >= block.Frame.Dims[0])
      {
        break;
      }
    }
  }
}

void IndicatorSet::FindAlignedTilesOf(
  MaterialId m, Index tileLayer, const std::vector<float>& largest, std::vector<std::vector<MaterialId>>& tiles) const
{
  const Lattice& working = this->Working_;
  const IndicatorBlock& block = this->Blocks[m];
  const SampleBox& box = this->Boxes[m];
  const Index count = box.Last[0] - box.First[0] + 1;
  const float slack = float(this->Slack());
  // A tile's samples are those of its cells' corners: its last ones are the next tile's first.
  const auto first = [&](int axis, Index tile) { return std::max<Index>(box.First[axis], tile * TileSize); };
  const auto last = [&](int axis, Index tile) { return std::min<Index>(box.Last[axis], (tile + 1) * TileSize); };
  std::vector<std::int32_t> marks(std::max<Index>(count, 0));
  for (Index tj = std::max<Index>(0, box.First[1] / TileSize - 1); tj < this->TileDims[1] && count > 0; ++tj)
  {
    std::fill(marks.begin(), marks.end(), 0);
    for (Index k = first(2, tileLayer); k <= last(2, tileLayer); ++k)
    {
      for (Index j = first(1, tj); j <= last(1, tj); ++j)
      {
        MarkWinners(block.Values + block.Frame.At(box.First[0] - box.Offset[0], j - box.Offset[1], k - box.Offset[2]),
          largest.data() + working.At(box.First[0], j, k), count, slack, marks.data());
      }
    }
    for (Index ti = 0; ti < this->TileDims[0]; ++ti)
    {
      std::int32_t any = 0;
      for (Index i = first(0, ti); i <= last(0, ti); ++i)
      {
        any |= marks[i - box.First[0]];
      }
      if (any != 0)
      {
        tiles[ti + this->TileDims[0] * tj].push_back(m);
      }
    }
  }
}
}
