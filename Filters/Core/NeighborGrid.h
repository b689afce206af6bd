// SPDX-License-Identifier: BSD-3-Clause
// Near neighbours among points whose spacing varies: one hash grid per octave of length.
#ifndef LabelMesh_Core_NeighborGrid_h
#define LabelMesh_Core_NeighborGrid_h

#include "Types.h"

#include <cmath>
#include <vector>

namespace LabelMesh
{
/// The cells that points of different lengths h are sorted into: those of level floor(log2 h) are twice 2^(level + 1)
/// wide, so that a look-up of a few h visits a few cells on each level whatever the range of h.
struct NeighborCells
{
  static int LevelOf(double h) { return std::ilogb(h); }
  /// Upper bound of the lengths in a level.
  static double UpperLength(int level) { return std::ldexp(2.0, level); }

  static std::uint64_t KeyOf(int level, Index i, Index j, Index k)
  {
    constexpr std::uint64_t mask = (1u << 19) - 1;
    return 1 +
      ((std::uint64_t(i) & mask) | ((std::uint64_t(j) & mask) << 19) | ((std::uint64_t(k) & mask) << 38) |
        ((std::uint64_t(level + 32) & 63) << 57));
  }
  static std::uint64_t KeyOf(int level, const Vec3& x)
  {
    const auto c = CoordinatesOf(level, x);
    return KeyOf(level, c[0], c[1], c[2]);
  }
  /// Of the cell that x is in.
  static std::array<Index, 3> CoordinatesOf(int level, const Vec3& x)
  {
    const double inverse = InverseWidth(level);
    return { Floor(x[0] * inverse), Floor(x[1] * inverse), Floor(x[2] * inverse) };
  }
  static std::uint64_t Hash(std::uint64_t key)
  {
    const std::uint64_t h = key * 0x9E3779B97F4A7C15ull;
    return h ^ (h >> 29);
  }
  /// How many slots a table of so many cells needs: a power of two, at most half full.
  static std::size_t SlotsFor(std::size_t cells)
  {
    std::size_t slots = 64;
    while (slots < 2 * cells)
    {
      slots *= 2;
    }
    return slots;
  }

  /// Calls visit(key) for each cell of the level that the ball around x touches, until it returns true; returns whether
  /// it did.
  template <typename Visit>
  static bool AnyInBall(int level, const Vec3& x, double radius, Visit&& visit)
  {
    const auto low = CoordinatesOf(level, x - Vec3::Constant(radius));
    const auto high = CoordinatesOf(level, x + Vec3::Constant(radius));
    for (Index k = low[2]; k <= high[2]; ++k)
    {
      for (Index j = low[1]; j <= high[1]; ++j)
      {
        for (Index i = low[0]; i <= high[0]; ++i)
        {
          if (visit(KeyOf(level, i, j, k)))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

private:
  static double InverseWidth(int level) { return std::ldexp(0.25, -level); }
  static Index Floor(double x)
  {
    const Index truncated = Index(x);
    return truncated - Index(x < double(truncated));
  }
};

/// Points, each with a length h, sorted into NeighborCells as they come. Points are visited in an order that depends on
/// their insertion alone.
class NeighborGrid
{
public:
  explicit NeighborGrid(std::size_t expected = 0) { this->Reserve(expected); }

  void Reserve(std::size_t points)
  {
    const std::size_t slots = NeighborCells::SlotsFor(points);
    if (slots > this->Keys.size())
    {
      this->Rehash(slots);
    }
    this->Points.reserve(points);
  }

  Index Size() const { return Index(this->Points.size()); }

  /// Adds a point; its number is Size() before.
  void Insert(const Vec3& x, double h)
  {
    if (2 * (this->Used + 1) > this->Keys.size())
    {
      this->Rehash(2 * this->Keys.size());
    }
    const int level = NeighborCells::LevelOf(h);
    this->LowestLevel = this->Points.empty() ? level : std::min(level, this->LowestLevel);
    this->HighestLevel = this->Points.empty() ? level : std::max(level, this->HighestLevel);
    const std::uint64_t key = NeighborCells::KeyOf(level, x);
    const std::size_t slot = this->FindSlot(key);
    if (this->Heads[slot] < 0)
    {
      this->Keys[slot] = key;
      ++this->Used;
    }
    this->Points.push_back({ x, h, this->Heads[slot] });
    this->Heads[slot] = std::int32_t(this->Points.size() - 1);
  }

  /// Calls visit(number, squared distance) for every point with |x - p| < factor * min(h, h_p).
  template <typename Visit>
  void VisitScaled(const Vec3& x, double h, double factor, Visit&& visit) const
  {
    this->AnyScaled(x, h, factor,
      [&](Index n, double squared)
      {
        visit(n, squared);
        return false;
      });
  }
  /// As VisitScaled, until visit returns true; returns whether it did.
  template <typename Visit>
  bool AnyScaled(const Vec3& x, double h, double factor, Visit&& visit) const
  {
    return this->AnyInLevels(
      x, this->LowestLevel, [=](double upper) { return factor * std::min(h, upper); },
      [=](double hp) { return factor * std::min(h, hp); }, visit);
  }
  /// True when |x - p| < h_p for one of the points.
  bool AnyReaches(const Vec3& x) const
  {
    return this->AnyInLevels(
      x, this->LowestLevel, [](double upper) { return upper; }, [](double hp) { return hp; },
      [](Index, double) { return true; });
  }
  /// Calls visit(number, squared distance) for every point with |x - p| < radius, among those with h_p >= smallest.
  template <typename Visit>
  void VisitWithin(const Vec3& x, double radius, double smallest, Visit&& visit) const
  {
    this->AnyInLevels(
      x, std::max(this->LowestLevel, NeighborCells::LevelOf(smallest)), [=](double) { return radius; },
      [=](double) { return radius; },
      [&](Index n, double squared)
      {
        visit(n, squared);
        return false;
      });
  }

private:
  struct Point
  {
    Vec3 Position;
    double Length;
    std::int32_t Next; ///< point of the same cell, -1: none
  };

  std::size_t FindSlot(std::uint64_t key) const
  {
    const std::size_t mask = this->Keys.size() - 1;
    std::size_t slot = std::size_t(NeighborCells::Hash(key)) & mask;
    while (this->Heads[slot] >= 0 && this->Keys[slot] != key)
    {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  void Rehash(std::size_t slots)
  {
    std::vector<std::uint64_t> keys(slots, 0);
    std::vector<std::int32_t> heads(slots, -1);
    keys.swap(this->Keys);
    heads.swap(this->Heads);
    for (std::size_t n = 0; n < heads.size(); ++n)
    {
      if (heads[n] >= 0)
      {
        const std::size_t slot = this->FindSlot(keys[n]);
        this->Keys[slot] = keys[n];
        this->Heads[slot] = heads[n];
      }
    }
  }

  template <typename LevelRadius, typename PointRadius, typename Visit>
  bool AnyInLevels(const Vec3& x, int lowest, LevelRadius&& levelRadius, PointRadius&& pointRadius, Visit&& visit) const
  {
    const auto inCell = [&](std::uint64_t key)
    {
      for (std::int32_t n = this->Heads[this->FindSlot(key)]; n >= 0; n = this->Points[n].Next)
      {
        const Point& point = this->Points[n];
        const double reach = pointRadius(point.Length);
        const double squared = (point.Position - x).squaredNorm();
        if (squared < reach * reach && visit(Index(n), squared))
        {
          return true;
        }
      }
      return false;
    };
    for (int level = lowest; level <= this->HighestLevel; ++level)
    {
      if (NeighborCells::AnyInBall(level, x, levelRadius(NeighborCells::UpperLength(level)), inCell))
      {
        return true;
      }
    }
    return false;
  }

  std::vector<std::uint64_t> Keys; // of occupied slots
  std::vector<std::int32_t> Heads; // last point of a cell, -1: free slot
  std::vector<Point> Points;
  std::size_t Used = 0;
  int LowestLevel = 0, HighestLevel = -1;
};
}

#endif
