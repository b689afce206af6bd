// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "CurveTracing.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
double Length(const OneCell& curve)
{
  double length = curve.Closed ? (curve.Points.back() - curve.Points.front()).norm() : 0.0;
  for (std::size_t n = 1; n < curve.Points.size(); ++n)
  {
    length += (curve.Points[n] - curve.Points[n - 1]).norm();
  }
  return length;
}
}

TEST(CurveTracing, FindsTheCircleWhereTwoSpheresAndTheOutsideMeet)
{
  const Vec3 a(32, 32, 40), b(32, 32, 24);
  // All three smooth; they are equal (to 0) on the circle where the spheres cut each other.
  const SampledFields fields(MakeLattice(64, 64, 64), { [](const Vec3&) { return 0.0; }, Ball(a, 17), Ball(b, 15) });
  const JunctionNetwork network = TraceJunctions(*fields, Monitor());
  ASSERT_EQ(network.OneCells.size(), 1u);
  EXPECT_TRUE(network.OneCells[0].Closed);
  EXPECT_EQ(network.ZeroCells.size(), 0u);
  EXPECT_EQ(network.OpenEnds, 0);
  // |x - a| = 17, |x - b| = 15: height h below a with h^2 + rho^2 = 289, (16 - h)^2 + rho^2 = 225.
  const double h = (289.0 - 225.0 + 256.0) / 32.0, rho = std::sqrt(289.0 - h * h);
  EXPECT_NEAR(Length(network.OneCells[0]), 2 * M_PI * rho, 0.01 * 2 * M_PI * rho);
  for (const Vec3& x : network.OneCells[0].Points)
  {
    EXPECT_NEAR(x[2], a[2] - h, 0.01);
    EXPECT_NEAR((x - Vec3(32, 32, x[2])).norm(), rho, 0.01);
  }
}

TEST(CurveTracing, EveryZeroCellOfAVoronoiDiagramHasOneCurveEndPerTriple)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(8, 40);
  const Vec3 centre(24, 24, 24);
  // Voronoi cells in a background that encloses them, so that curves end nowhere but at 0-cells.
  std::vector<Field> sites{ [=](const Vec3& x) { return (x - centre).norm() - 24.0; } };
  while (sites.size() < 15)
  {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    if ((x - centre).norm() < 15)
    {
      sites.push_back(Site(x));
    }
  }
  const SampledFields fields(MakeLattice(49, 49, 49), sites);
  const JunctionNetwork network = TraceJunctions(*fields, Monitor());
  EXPECT_GT(network.ZeroCells.size(), 20u);
  EXPECT_EQ(network.OpenEnds, 0);
  for (const OneCell& curve : network.OneCells)
  {
    for (const Vec3& x : curve.Points)
    {
      RankedMaterial top[3];
      ASSERT_EQ(fields->Largest(x, 3, top), 3);
      EXPECT_LT(top[0].Value - top[2].Value, 0.02);
    }
  }
}

TEST(CurveTracing, DoesNotStepOverToTheOtherSideOfASliver)
{
  // The third material is largest within an ellipse of half axes 9 and 0.5 voxels: its border runs along itself at a
  // distance of no more than a voxel, turns sharply, and comes back.
  const Vec3 centre(20.05, 19.8, 20.005); // so that samples lie inside
  const auto height = [=](const Vec3& x) { return x[2] - centre[2]; };
  const SampledFields fields(MakeLattice(40, 40, 40),
    { [=](const Vec3& x) { return height(x); }, [=](const Vec3& x) { return -height(x); },
      [=](const Vec3& x)
      { return 0.01 * (1 - std::pow((x[0] - centre[0]) / 0.5, 2) - std::pow((x[1] - centre[1]) / 9, 2)); } });
  const JunctionNetwork network = TraceJunctions(*fields, Monitor());
  ASSERT_EQ(network.OneCells.size(), 1u);
  EXPECT_TRUE(network.OneCells[0].Closed);
  EXPECT_NEAR(Length(network.OneCells[0]), 36.1, 0.3);
}
