// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest sample of the other side has a 6-neighbour on this side (a step towards us is shorter still). So only
// those boundary samples matter, and each one stamps its distances, a ball of rows, onto the other side. The work is
// that of the surface, not of the volume. Inside distances are kept as positive values that shrink and outside ones as
// negative values that grow: a stamp then cannot touch the side it does not belong to, without looking at sides at all.
#include "DistanceTransform.h"

#include "Parallel.h"

#include <cstring>

namespace LabelMesh
{
namespace
{
constexpr int SlabThickness = 8; // slices that one task stamps on

/// Part of a ball of offsets: those with the same dj and dk, di from -Reach to Reach.
struct StampRow
{
  int J = 0;
  int K = 0;
  int Reach = 0;
  std::vector<float> Distances; ///< 2 Reach + 1
};

/// Distance to a sample of the other side at offset v, where the interface lies half a sample before it.
double InterfaceDistance(const Vec3& v, const Vec3& spacing)
{
  const double length = v.norm();
  return length > 0 ? length - 0.5 * v.cwiseProduct(spacing).norm() / length : 0.0;
}

/// All offsets whose `distance(v)` is below `bound`. Distances grow along every axis.
template <typename Distance>
std::vector<StampRow> Ball(const Lattice& frame, Distance&& distance, double bound)
{
  const Vec3& h = frame.Spacing;
  const auto within = [&](int i, int j, int k) { return distance(h.cwiseProduct(Vec3(i, j, k))) < bound; };
  int reach[3] = { 0, 0, 0 };
  for (int a = 0; a < 3; ++a)
  {
    while (reach[a] < frame.Dims[a] &&
      within(a == 0 ? reach[a] + 1 : 0, a == 1 ? reach[a] + 1 : 0, a == 2 ? reach[a] + 1 : 0))
    {
      ++reach[a];
    }
  }
  std::vector<StampRow> rows;
  for (int k = -reach[2]; k <= reach[2]; ++k)
  {
    for (int j = -reach[1]; j <= reach[1]; ++j)
    {
      StampRow row{ j, k, -1, {} };
      while (row.Reach < reach[0] && within(row.Reach + 1, j, k))
      {
        ++row.Reach;
      }
      for (int i = -row.Reach; i <= row.Reach; ++i)
      {
        row.Distances.push_back(float(distance(h.cwiseProduct(Vec3(i, j, k)))));
      }
      if (row.Reach >= 0)
      {
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

/// Indices of the samples of slice k that have a 6-neighbour on the other side.
void FindBoundary(const Lattice& frame, const Sides& sides, int k, std::vector<Index>& found)
{
  const Index nx = frame.Dims[0], ny = frame.Dims[1], nz = frame.Dims[2];
  for (Index j = 0; j < ny; ++j)
  {
    const Index start = frame.At(0, j, k);
    const std::uint8_t* row = sides.data() + start;
    // Beyond the lattice a row is compared with itself.
    const std::uint8_t* neighbours[4] = { j > 0 ? row - nx : row, j + 1 < ny ? row + nx : row,
      k > 0 ? row - nx * ny : row, k + 1 < nz ? row + nx * ny : row };
    const std::size_t bytes = static_cast<std::size_t>(nx);
    if (!std::memchr(row, !row[0], bytes) &&
      std::all_of(
        neighbours, neighbours + 4, [&](const std::uint8_t* other) { return std::memcmp(row, other, bytes) == 0; }))
    {
      continue; // most rows
    }
    for (Index i = 0; i < nx; ++i)
    {
      const std::uint8_t side = row[i];
      const int different = (neighbours[0][i] ^ side) | (neighbours[1][i] ^ side) | (neighbours[2][i] ^ side) |
        (neighbours[3][i] ^ side) | (row[i > 0 ? i - 1 : i] ^ side) | (row[i + 1 < nx ? i + 1 : i] ^ side);
      if (different)
      {
        found.push_back(start + i);
      }
    }
  }
}

std::vector<std::vector<Index>> FindBoundaries(const Lattice& frame, const Sides& sides)
{
  std::vector<std::vector<Index>> slices(frame.Dims[2]);
  ParallelFor(0, frame.Dims[2], 0,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        FindBoundary(frame, sides, int(k), slices[k]);
      }
    });
  return slices;
}

/// Calls stamp(boundary sample, row, first target, first offset, length) for every row of every ball around the
/// boundary samples, clipped to the lattice, and prepare(first, last) on each range of samples before. Tasks own slabs
/// of targets.
template <typename Prepare, typename Stamp>
void StampBalls(const Lattice& frame, const std::vector<std::vector<Index>>& boundary,
  const std::vector<StampRow>& ball, Prepare&& prepare, Stamp&& stamp)
{
  const int nx = frame.Dims[0], ny = frame.Dims[1], nz = frame.Dims[2];
  const int reach = ball.empty() ? 0 : ball.back().K;
  ParallelFor(0, (nz + SlabThickness - 1) / SlabThickness, 1,
    [&](Index firstSlab, Index lastSlab)
    {
      const int k0 = int(firstSlab) * SlabThickness, k1 = std::min(int(lastSlab) * SlabThickness, nz);
      prepare(frame.At(0, 0, k0), frame.At(0, 0, k1));
      for (int k = std::max(k0 - reach, 0); k < std::min(k1 + reach, nz); ++k)
      {
        for (const Index at : boundary[k])
        {
          const auto [i, j, unused] = frame.Coordinates(at);
          static_cast<void>(unused);
          for (const StampRow& row : ball)
          {
            const int jj = j + row.J, kk = k + row.K;
            if (kk >= k0 && kk < k1 && jj >= 0 && jj < ny)
            {
              const int first = std::max(-row.Reach, -i), last = std::min(row.Reach, nx - 1 - i);
              stamp(at, row, frame.At(i + first, jj, kk), first + row.Reach, last - first + 1);
            }
          }
        }
      }
    });
}
}

void SignedDistance(const Lattice& frame, const Sides& sides, double band, float* distance)
{
  const auto ball = Ball(
    frame, [&](const Vec3& v) { return InterfaceDistance(v, frame.Spacing); }, band);
  const float end = float(band);
  const auto prepare = [&](Index first, Index last)
  {
    for (Index at = first; at < last; ++at)
    {
      distance[at] = sides[at] ? end : -end;
    }
  };
  const auto stamp = [&](Index from, const StampRow& row, Index to, int offset, int length)
  {
    float* __restrict target = distance + to;
    const float* __restrict values = row.Distances.data() + offset;
    if (sides[from])
    {
      for (int n = 0; n < length; ++n)
      {
        const float outside = -values[n];
        target[n] = target[n] < outside ? outside : target[n];
      }
    }
    else
    {
      for (int n = 0; n < length; ++n)
      {
        target[n] = target[n] > values[n] ? values[n] : target[n];
      }
    }
  };
  StampBalls(frame, FindBoundaries(frame, sides), ball, prepare, stamp);
}

Sides Grown(const Lattice& frame, const Sides& sides, std::uint8_t value, double radius)
{
  Sides grown(sides.size());
  const double inclusive = radius * (1 + 1e-9);
  const auto ball = Ball(
    frame, [](const Vec3& v) { return v.norm(); }, inclusive);
  const auto prepare = [&](Index first, Index last)
  { std::copy(sides.begin() + first, sides.begin() + last, grown.begin() + first); };
  const auto stamp = [&](Index from, const StampRow&, Index to, int, int length)
  {
    if (sides[from] == value)
    {
      std::memset(grown.data() + to, value, static_cast<std::size_t>(length));
    }
  };
  StampBalls(frame, FindBoundaries(frame, sides), ball, prepare, stamp);
  return grown;
}

Sides Opened(const Lattice& frame, const Sides& sides, double radius)
{
  return Grown(frame, Grown(frame, sides, 0, radius), 1, radius);
}

Sides Closed(const Lattice& frame, const Sides& sides, double radius)
{
  return Grown(frame, Grown(frame, sides, 1, radius), 0, radius);
}
}
