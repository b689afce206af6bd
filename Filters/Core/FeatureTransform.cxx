// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureTransform.h"

#include "Parallel.h"

#include <limits>

namespace LabelMesh
{
namespace
{
/// Rows of this many samples are taken together, so that columns along y and z are read in whole cache lines.
constexpr int TileWidth = 16;

struct SeedCoordinates
{
  std::vector<std::array<std::int32_t, 3>> At;

  SeedCoordinates(const Lattice& lattice, const std::vector<Index>& seeds)
    : At(seeds.size())
  {
    for (std::size_t s = 0; s < seeds.size(); ++s)
    {
      const auto c = lattice.Coordinates(seeds[s]);
      this->At[s] = { c[0], c[1], c[2] };
    }
  }
};

/// First pass: the nearest seed within each row along x.
void NearestInRow(std::int32_t* row, int length, const SeedCoordinates& seeds)
{
  std::int32_t last = -1;
  for (int i = 0; i < length; ++i)
  {
    last = row[i] >= 0 ? row[i] : last;
    row[i] = last;
  }
  last = -1;
  for (int i = length - 1; i >= 0; --i)
  {
    const std::int32_t left = row[i];
    if (left >= 0 && seeds.At[left][0] == i)
    {
      last = left;
    }
    else if (last >= 0 && (left < 0 || seeds.At[last][0] - i < i - seeds.At[left][0]))
    {
      row[i] = last;
    }
  }
}

/// The lower envelope of the parabolas (s (t - t_k))^2 + g_k over one column, and its evaluation.
class Envelope
{
public:
  explicit Envelope(int length)
    : Vertex(length)
    , Lifted(length)
    , From(length)
    , Seed(length)
  {
  }

  void Clear() { this->Count = 0; }

  void Add(int vertex, double height, std::int32_t seed, double squaredSpacing)
  {
    const double lifted = height + squaredSpacing * vertex * vertex;
    double rise = 0.0, run = 1.0; // the new one is the lowest from rise / run on
    while (this->Count > 0)
    {
      const int k = this->Count - 1;
      rise = lifted - this->Lifted[k];
      run = 2 * squaredSpacing * (vertex - this->Vertex[k]);
      if (rise > this->From[k] * run)
      {
        break;
      }
      --this->Count;
    }
    this->Vertex[this->Count] = vertex;
    this->Lifted[this->Count] = lifted;
    this->From[this->Count] = this->Count > 0 ? rise / run : -std::numeric_limits<double>::infinity();
    this->Seed[this->Count] = seed;
    ++this->Count;
  }

  void Write(std::int32_t* column, int length, int stride) const
  {
    if (this->Count == 0)
    {
      return;
    }
    int k = 0;
    for (int t = 0; t < length; ++t)
    {
      while (k + 1 < this->Count && this->From[k + 1] <= t)
      {
        ++k;
      }
      column[t * stride] = this->Seed[k];
    }
  }

private:
  std::vector<int> Vertex;
  std::vector<double> Lifted; ///< g_k + (s t_k)^2
  std::vector<double> From;   ///< where each parabola begins to be the lowest
  std::vector<std::int32_t> Seed;
  int Count = 0;
};

/// Second and third pass: columns along `axis` of a tile of neighbours along x. `known` axes before it were done.
class ColumnPass
{
public:
  ColumnPass(const Lattice& lattice, int axis, const SeedCoordinates& seeds, std::vector<std::int32_t>& nearest)
    : Frame(lattice)
    , Axis(axis)
    , Seeds(seeds)
    , Nearest(nearest)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Squared[a] = lattice.Spacing[a] * lattice.Spacing[a];
    }
  }

  /// All columns with the coordinate `other` along the third axis.
  void Run(int other) const
  {
    const int length = this->Frame.Dims[this->Axis];
    const Index stride = this->Axis == 1 ? this->Frame.Dims[0] : Index(this->Frame.Dims[0]) * this->Frame.Dims[1];
    const Index start = this->Axis == 1 ? this->Frame.At(0, 0, other) : this->Frame.At(0, other, 0);
    std::vector<std::int32_t> tile(static_cast<std::size_t>(length) * TileWidth);
    Envelope envelope(length);
    for (int x = 0; x < this->Frame.Dims[0]; x += TileWidth)
    {
      const int width = std::min(TileWidth, this->Frame.Dims[0] - x);
      std::int32_t* first = this->Nearest.data() + start + x;
      for (int t = 0; t < length; ++t)
      {
        std::copy_n(first + t * stride, width, tile.data() + t * TileWidth);
      }
      for (int c = 0; c < width; ++c)
      {
        this->Column(tile.data() + c, length, x + c, other, envelope);
      }
      for (int t = 0; t < length; ++t)
      {
        std::copy_n(tile.data() + t * TileWidth, width, first + t * stride);
      }
    }
  }

private:
  void Column(std::int32_t* column, int length, int x, int other, Envelope& envelope) const
  {
    envelope.Clear();
    for (int t = 0; t < length; ++t)
    {
      const std::int32_t seed = column[t * TileWidth];
      if (seed < 0)
      {
        continue;
      }
      const auto& at = this->Seeds.At[seed];
      const double dx = at[0] - x;
      double height = this->Squared[0] * dx * dx;
      if (this->Axis == 2)
      {
        const double dy = at[1] - other;
        height += this->Squared[1] * dy * dy;
      }
      envelope.Add(t, height, seed, this->Squared[this->Axis]);
    }
    envelope.Write(column, length, TileWidth);
  }

  const Lattice& Frame;
  int Axis;
  const SeedCoordinates& Seeds;
  std::vector<std::int32_t>& Nearest;
  double Squared[3];
};
}

std::vector<std::int32_t> NearestSeeds(const Lattice& lattice, const std::vector<Index>& seeds)
{
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(lattice.Size()), -1);
  if (seeds.empty())
  {
    return nearest;
  }
  for (std::size_t s = 0; s < seeds.size(); ++s)
  {
    nearest[seeds[s]] = std::int32_t(s);
  }
  const SeedCoordinates coordinates(lattice, seeds);
  const int nx = lattice.Dims[0], ny = lattice.Dims[1], nz = lattice.Dims[2];
  ParallelFor(0, Index(ny) * nz, 256,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        NearestInRow(nearest.data() + row * nx, nx, coordinates);
      }
    });
  const auto columns = [&](int axis, int others)
  {
    const ColumnPass pass(lattice, axis, coordinates, nearest);
    ParallelFor(0, others, 1,
      [&pass](Index first, Index last)
      {
        for (Index other = first; other < last; ++other)
        {
          pass.Run(int(other));
        }
      });
  };
  columns(1, nz);
  columns(2, ny);
  return nearest;
}
}
