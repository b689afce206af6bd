// SPDX-License-Identifier: BSD-3-Clause
// Near neighbours among points whose spacing varies: one hash grid per octave of length.
#ifndef LabelMesh_Core_NeighborGrid_h
#define LabelMesh_Core_NeighborGrid_h

#include "Types.h"

#include <cmath>
#include <vector>

namespace LabelMesh
{
/// Points, each with a length h. A point lies in the level floor(log2 h), whose cells are twice 2^(level + 1) wide, so
/// that a look-up of a few h visits a few cells on each level whatever the range of h. Points are visited in an order
/// that depends on their insertion alone.
class NeighborGrid
{
public:
  explicit NeighborGrid(std::size_t expected = 0) { this->Reserve(expected); }

  void Reserve(std::size_t points)
  {
    std::size_t slots = 64;
    while (slots < 2 * points)
    {
      slots *= 2;
    }
    if (slots > this->Keys.size())
    {
      this->Rehash(slots);
    }
    this->Next.reserve(points);
    this->Positions.reserve(points);
    this->Lengths.reserve(points);
  }

  Index Size() const { return Index(this->Next.size()); }

  /// Adds a point; its number is Size() before.
  void Insert(const Vec3& x, double h)
  {
    if (2 * (this->Used + 1) > this->Keys.size())
    {
      this->Rehash(2 * this->Keys.size());
    }
    const int level = LevelOf(h);
    if (this->Next.empty() || level < this->LowestLevel)
    {
      this->LowestLevel = this->Next.empty() ? level : std::min(level, this->LowestLevel);
    }
    this->HighestLevel = this->Next.empty() ? level : std::max(level, this->HighestLevel);
    const std::size_t slot = this->FindSlot(KeyOf(level, x));
    if (this->Heads[slot] < 0)
    {
      this->Keys[slot] = KeyOf(level, x);
      ++this->Used;
    }
    this->Next.push_back(this->Heads[slot]);
    this->Heads[slot] = std::int32_t(this->Next.size() - 1);
    this->Positions.push_back(x);
    this->Lengths.push_back(h);
  }

  /// Calls visit(number, squared distance) for every point with |x - p| < factor * min(h, h_p).
  template <typename Visit>
  void VisitScaled(const Vec3& x, double h, double factor, Visit&& visit) const
  {
    this->VisitLevels(
      x, this->LowestLevel, [=](double upper) { return factor * std::min(h, upper); },
      [=](double hp) { return factor * std::min(h, hp); }, visit);
  }
  /// Calls visit(number, squared distance) for every point with |x - p| < radius, among those with h_p >= smallest.
  template <typename Visit>
  void VisitWithin(const Vec3& x, double radius, double smallest, Visit&& visit) const
  {
    this->VisitLevels(
      x, std::max(this->LowestLevel, LevelOf(smallest)), [=](double) { return radius; }, [=](double) { return radius; },
      visit);
  }
  /// Calls visit(number, squared distance) for every point with |x - p| < factor * h_p.
  template <typename Visit>
  void VisitReaching(const Vec3& x, double factor, Visit&& visit) const
  {
    this->VisitLevels(
      x, this->LowestLevel, [=](double upper) { return factor * upper; }, [=](double hp) { return factor * hp; },
      visit);
  }

private:
  static int LevelOf(double h) { return std::ilogb(h); }
  static double CellSize(int level) { return std::ldexp(4.0, level); }
  static std::uint64_t KeyOf(int level, Index i, Index j, Index k)
  {
    constexpr std::uint64_t mask = (1u << 19) - 1;
    return 1 +
      ((std::uint64_t(i) & mask) | ((std::uint64_t(j) & mask) << 19) | ((std::uint64_t(k) & mask) << 38) |
        ((std::uint64_t(level + 32) & 63) << 57));
  }
  static std::uint64_t KeyOf(int level, const Vec3& x)
  {
    const double inverse = 1.0 / CellSize(level);
    return KeyOf(
      level, Index(std::floor(x[0] * inverse)), Index(std::floor(x[1] * inverse)), Index(std::floor(x[2] * inverse)));
  }

  std::size_t FindSlot(std::uint64_t key) const
  {
    std::uint64_t h = key * 0x9E3779B97F4A7C15ull;
    h ^= h >> 29;
    const std::size_t mask = this->Keys.size() - 1;
    std::size_t slot = std::size_t(h) & mask;
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
  void VisitLevels(const Vec3& x, int lowest, LevelRadius&& levelRadius, PointRadius&& pointRadius, Visit&& visit) const
  {
    if (this->Next.empty())
    {
      return;
    }
    for (int level = lowest; level <= this->HighestLevel; ++level)
    {
      const double radius = levelRadius(std::ldexp(2.0, level));
      const double inverse = 1.0 / CellSize(level);
      Index low[3], high[3];
      for (int a = 0; a < 3; ++a)
      {
        low[a] = Index(std::floor((x[a] - radius) * inverse));
        high[a] = Index(std::floor((x[a] + radius) * inverse));
      }
      for (Index k = low[2]; k <= high[2]; ++k)
      {
        for (Index j = low[1]; j <= high[1]; ++j)
        {
          for (Index i = low[0]; i <= high[0]; ++i)
          {
            for (std::int32_t n = this->Heads[this->FindSlot(KeyOf(level, i, j, k))]; n >= 0; n = this->Next[n])
            {
              const double reach = pointRadius(this->Lengths[n]);
              const double squared = (this->Positions[n] - x).squaredNorm();
              if (squared < reach * reach)
              {
                visit(Index(n), squared);
              }
            }
          }
        }
      }
    }
  }

  std::vector<std::uint64_t> Keys; // of occupied slots
  std::vector<std::int32_t> Heads; // first point of a cell, -1: free slot
  std::vector<std::int32_t> Next;  // next point of the same cell
  std::vector<Vec3> Positions;
  std::vector<double> Lengths;
  std::size_t Used = 0;
  int LowestLevel = 0, HighestLevel = -1;
};
}

#endif
