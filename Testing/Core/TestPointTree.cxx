// SPDX-License-Identifier: BSD-3-Clause
#include "PointTree.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;

namespace
{
struct Points
{
  std::vector<Vec3> X;
  std::vector<double> H;

  explicit Points(int count)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-20, 20), octave(-3, 3);
    for (int n = 0; n < count; ++n)
    {
      this->X.emplace_back(uniform(random), uniform(random), uniform(random));
      this->H.push_back(std::exp2(octave(random)));
    }
  }
  const Vec3& Position(Index n) const { return this->X[n]; }
  PointTree Tree() const
  {
    return PointTree(
      Index(this->X.size()), [this](Index n) { return this->X[n]; }, [this](Index n) { return this->H[n]; });
  }
};
}

TEST(PointTree, FindsWhatATestOfAllPairsFinds)
{
  // Whether the number of points fills the last leaf and the last node or not, and in an order that has nothing to do
  // with space.
  for (const int count : { 1, 8, 9, 64, 65, 3000 })
  {
    const Points points(count);
    const PointTree tree = points.Tree();
    EXPECT_EQ(tree.Size(), count);
    PointTree::Scaled near(tree, 1.9);
    for (Index first = 0; first < count; first += 3)
    {
      const Index last = std::min<Index>(count, first + 3);
      near.Gather(
        first, last, [&](Index n) { return points.X[n]; }, [&](Index n) { return points.H[n]; });
      for (Index i = first; i < last; ++i)
      {
        std::vector<Index> found, expected;
        near.ForEach(points.X[i], points.H[i],
          [&](Index n, double squared)
          {
            found.push_back(n);
            EXPECT_NEAR(squared, (points.X[n] - points.X[i]).squaredNorm(), 1e-3);
          });
        for (Index n = 0; n < count; ++n)
        {
          if ((points.X[n] - points.X[i]).norm() < 1.9 * std::min(points.H[i], points.H[n]))
          {
            expected.push_back(n);
          }
        }
        EXPECT_EQ(found, expected); // ascending
      }
    }
  }
}

TEST(PointTree, StopsAtTheFirstThatIsWanted)
{
  const Points points(500);
  const PointTree tree = points.Tree();
  PointTree::Scaled near(tree, 100.0);
  near.Gather(
    0, 1, [&](Index n) { return points.X[n]; }, [&](Index n) { return points.H[n]; });
  int asked = 0;
  EXPECT_TRUE(near.Any(points.X[0], points.H[0], [&](Index, double) { return ++asked == 7; }));
  EXPECT_EQ(asked, 7);
  EXPECT_FALSE(near.Any(points.X[0], points.H[0], [](Index, double) { return false; }));
}

TEST(PointTree, AnEmptyOneFindsNothing)
{
  const PointTree tree;
  PointTree::Scaled near(tree, 10.0);
  near.Gather(
    0, 1, [](Index) { return Vec3(0, 0, 0); }, [](Index) { return 1.0; });
  EXPECT_FALSE(near.Any(Vec3::Zero(), 1.0, [](Index, double) { return true; }));
}
