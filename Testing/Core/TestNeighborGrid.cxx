// SPDX-License-Identifier: BSD-3-Clause
#include "NeighborGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace LabelMesh;

namespace
{
struct Points
{
  std::vector<Vec3> X;
  std::vector<double> H;
  NeighborGrid Grid;

  explicit Points(int count)
  {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-20, 20), octave(-3, 3);
    for (int n = 0; n < count; ++n)
    {
      this->X.emplace_back(uniform(random), uniform(random), uniform(random));
      this->H.push_back(std::exp2(octave(random)));
      this->Grid.Insert(this->X.back(), this->H.back());
    }
  }
  template <typename Accept>
  std::vector<Index> BruteForce(Accept&& accept) const
  {
    std::vector<Index> found;
    for (std::size_t n = 0; n < this->X.size(); ++n)
    {
      if (accept(n))
      {
        found.push_back(Index(n));
      }
    }
    return found;
  }
};

std::vector<Index> Sorted(std::vector<Index> found)
{
  std::sort(found.begin(), found.end());
  return found;
}
}

TEST(NeighborGrid, FindsWhatATestOfAllPairsFinds)
{
  const Points points(3000);
  for (std::size_t i = 0; i < points.X.size(); i += 37)
  {
    const Vec3& x = points.X[i];
    const double h = points.H[i];
    std::vector<Index> scaled, within;
    points.Grid.VisitScaled(x, h, 1.9, [&](Index n, double) { scaled.push_back(n); });
    points.Grid.VisitWithin(x, 3.0, 0.0, [&](Index n, double) { within.push_back(n); });
    const auto distance = [&](std::size_t n) { return (points.X[n] - x).norm(); };
    EXPECT_EQ(
      Sorted(scaled), points.BruteForce([&](std::size_t n) { return distance(n) < 1.9 * std::min(h, points.H[n]); }));
    EXPECT_EQ(Sorted(within), points.BruteForce([&](std::size_t n) { return distance(n) < 3.0; }));
    EXPECT_EQ(points.Grid.AnyReaches(x + Vec3(9, 9, 9)),
      !points.BruteForce([&](std::size_t n) { return (points.X[n] - x - Vec3(9, 9, 9)).norm() < points.H[n]; })
         .empty());
  }
}

TEST(NeighborGrid, AnEmptyOneFindsNothing)
{
  const NeighborGrid grid;
  grid.VisitWithin(Vec3::Zero(), 1e3, 0.0, [](Index, double) { FAIL(); });
}
