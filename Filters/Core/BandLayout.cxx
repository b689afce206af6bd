// SPDX-License-Identifier: BSD-3-Clause
#include "BandLayout.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr Index PieceSize = 8192; // active samples in a piece of work: a few dozen microseconds
}

Lattice BandLayout::Grown(const Lattice& frame)
{
  Lattice grown = frame;
  for (int& n : grown.Dims)
  {
    n += 2 * Margin;
  }
  grown.Spacing /= frame.VoxelSize();
  return grown;
}

BandLayout::BandLayout(const Lattice& grown, const std::uint8_t* mask, const BitLattice& active)
  : GrownFrame(grown)
{
  this->FindRuns(active);
  this->FindRims(mask, active);
  this->FindGhosts(active);
  this->CountSides(mask);
}

void BandLayout::FindRuns(const BitLattice& active)
{
  const Lattice& frame = this->GrownFrame;
  std::vector<std::vector<Run>> slices(static_cast<std::size_t>(frame.Dims[2]));
  ParallelFor(0, frame.Dims[2], 0,
    [&](Index first, Index last)
    {
      std::vector<Span> spans;
      for (Index at = first * frame.Dims[1]; at < last * frame.Dims[1]; ++at)
      {
        spans.clear();
        FindSpans(active.Row(at, 0), active.WordsPerRow(), spans);
        for (const Span& span : spans)
        {
          slices[at / frame.Dims[1]].push_back({ at * frame.Dims[0] + span.First, span.Last - span.First, 0 });
        }
      }
    });
  std::size_t count = 0;
  for (const auto& slice : slices)
  {
    count += slice.size();
  }
  this->AllRuns.reserve(count);
  Place place;
  Index end = 0; // of the piece at work
  for (const auto& slice : slices)
  {
    this->Slices.push_back(place);
    for (Run run : slice)
    {
      run.Packed = std::uint32_t(place.Packed - this->Slices.back().Packed);
      if (place.Packed >= end)
      {
        this->Pieces.push_back(place);
        end = place.Packed + PieceSize;
      }
      this->AllRuns.push_back(run);
      place.Packed += run.Count;
      ++place.Run;
    }
  }
  this->Slices.push_back(place);
  this->Pieces.push_back(place);
}

bool BandLayout::IsInside(const std::uint8_t* mask, int i, int j, int k) const
{
  const auto& n = this->GrownFrame.Dims;
  const Index x = std::clamp(i - Margin, 0, n[0] - 1 - 2 * Margin),
              y = std::clamp(j - Margin, 0, n[1] - 1 - 2 * Margin),
              z = std::clamp(k - Margin, 0, n[2] - 1 - 2 * Margin);
  return mask[x + Index(n[0] - 2 * Margin) * (y + Index(n[1] - 2 * Margin) * z)] != 0;
}

void BandLayout::FindRims(const std::uint8_t* mask, const BitLattice& active)
{
  const Lattice& frame = this->GrownFrame;
  const BitLattice wide = Dilated(active, BoxOffsets({ 1, 1, 1 }));
  this->AllRims = ParallelCollect<Rim>(frame.Dims[2],
    [&](Index k, std::vector<Rim>& rims)
    {
      const int words = active.WordsPerRow();
      std::vector<BitLattice::Word> row(static_cast<std::size_t>(words));
      std::vector<Span> spans;
      for (int j = 0; j < frame.Dims[1]; ++j)
      {
        const BitLattice::Word *all = wide.Row(j, k), *own = active.Row(j, k);
        for (int w = 0; w < words; ++w)
        {
          row[w] = all[w] & ~own[w];
        }
        spans.clear();
        FindSpans(row.data(), words, spans);
        for (const Span& span : spans)
        {
          for (int i = span.First; i < span.Last;)
          {
            // Both sides may meet in a rim where a band is narrower than a sample.
            const int first = i;
            const bool inside = this->IsInside(mask, i, j, int(k));
            while (i < span.Last && this->IsInside(mask, i, j, int(k)) == inside)
            {
              ++i;
            }
            rims.push_back({ frame.At(first, j, k), i - first, inside });
          }
        }
      }
    });
}

void BandLayout::FindGhosts(const BitLattice& active)
{
  const auto& n = this->GrownFrame.Dims;
  const auto add = [&](int i, int j, int k)
  {
    const int x = std::clamp(i, Margin, n[0] - 1 - Margin), y = std::clamp(j, Margin, n[1] - 1 - Margin),
              z = std::clamp(k, Margin, n[2] - 1 - Margin);
    if (active.Has(x, y, z))
    {
      this->AllGhosts.push_back({ this->GrownFrame.At(i, j, k), this->GrownFrame.At(x, y, z) });
    }
  };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      const bool wholeRow = k < Margin || k >= n[2] - Margin || j < Margin || j >= n[1] - Margin;
      for (int i = 0; i < n[0]; ++i)
      {
        if (!wholeRow && i == Margin)
        {
          i = n[0] - Margin;
        }
        add(i, j, k);
      }
    }
  }
}

void BandLayout::CountSides(const std::uint8_t* mask)
{
  const auto& n = this->GrownFrame.Dims;
  const Index slice = Index(n[0] - 2 * Margin) * (n[1] - 2 * Margin);
  std::vector<Index> inside(static_cast<std::size_t>(n[2] - 2 * Margin), 0);
  ParallelFor(0, Index(inside.size()), 0,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        inside[k] =
          std::count_if(mask + k * slice, mask + (k + 1) * slice, [](std::uint8_t value) { return value != 0; });
      }
    });
  this->Inside = std::accumulate(inside.begin(), inside.end(), Index(0));
  const std::vector<std::uint8_t> sides = this->PackSides(mask);
  this->Deep = this->Inside - std::accumulate(sides.begin(), sides.end(), Index(0));
}

BitLattice BandLayout::ActiveBits() const
{
  BitLattice bits(this->GrownFrame.Dims);
  const Index nx = this->GrownFrame.Dims[0];
  for (const Run& run : this->AllRuns)
  {
    const int i = int(run.First % nx);
    bits.Add({ i, i + run.Count }, run.First / nx, 0);
  }
  return bits;
}

std::vector<std::uint8_t> BandLayout::PackSides(const std::uint8_t* mask) const
{
  std::vector<std::uint8_t> sides(static_cast<std::size_t>(this->NumberOfActive()));
  const auto& n = this->GrownFrame.Dims;
  this->ForRuns(
    [&](Index first, Index count, Index packed)
    {
      const std::array<int, 3> at = this->GrownFrame.Coordinates(first);
      const std::uint8_t* const from = mask + (at[0] - Margin) +
        Index(n[0] - 2 * Margin) * ((at[1] - Margin) + Index(n[1] - 2 * Margin) * (at[2] - Margin));
      for (Index i = 0; i < count; ++i)
      {
        sides[packed + i] = from[i] != 0;
      }
    });
  return sides;
}
}
