// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "CubicPoints.h"
#include "PartitionVolumes.h"

#include <gtest/gtest.h>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
std::vector<IndicatorBlock> BlocksOf(const IndicatorSet& indicators)
{
  std::vector<IndicatorBlock> blocks;
  for (int m = 0; m < indicators.NumberOfMaterials(); ++m)
  {
    blocks.push_back(indicators.Block(MaterialId(m)));
  }
  return blocks;
}
}

TEST(PartitionVolumes, OfABallAreItsOwn)
{
  const Lattice frame = MakeLattice(40, 30, 50, Vec3(1, 1.3, 0.8));
  const Vec3 centre(19.7, 19.1, 19.9);
  const double radius = 12;
  const SampledFields fields(frame, { Not(Ball(centre, radius)), Ball(centre, radius) });
  const auto volumes = PartitionVolumes(BlocksOf(*fields), frame);
  const double ball = 4.0 / 3.0 * M_PI * radius * radius * radius, box = 39 * 29 * 49 * frame.VoxelVolume();
  EXPECT_NEAR(volumes[1], ball, 0.005 * ball);
  EXPECT_NEAR(volumes[0] + volumes[1], box, 1e-3 * box);
}

TEST(PartitionVolumes, OfASmallBallAreThoseOfItsSpline)
{
  // 74 voxels. The trilinear interpolant, which lies below the spline wherever that is convex, holds 9 % less.
  const Lattice frame = MakeLattice(16, 16, 16);
  const Vec3 centre(7.3, 7.6, 7.45);
  const SampledFields fields(frame, { Not(Ball(centre, 2.6)), Ball(centre, 2.6) });
  constexpr int fine = 150;
  Index inside = 0;
  for (Index n = 0; n < fine * fine * fine; ++n)
  {
    const Vec3 x(double(n % fine) + 0.5, double(n / fine % fine) + 0.5, double(n / (fine * fine)) + 0.5);
    inside += fields->LargestMaterial(x / 10.0) == 1;
  }
  EXPECT_NEAR(PartitionVolumes(BlocksOf(*fields), frame)[1], double(inside) / 1000.0, 0.5);
}

TEST(PartitionVolumes, NeighboursFillWhatAMaterialLeaves)
{
  // Both say that they end half a voxel before they meet: each holds its half all the same.
  const Lattice frame = MakeLattice(21, 21, 21);
  const SampledFields fields(
    frame, { [](const Vec3& x) { return x[0] - 10.5; }, [](const Vec3& x) { return 9.5 - x[0]; } });
  const auto volumes = PartitionVolumes(BlocksOf(*fields), frame);
  EXPECT_NEAR(volumes[0], 10 * 400, 1e-6);
  EXPECT_NEAR(volumes[1], 10 * 400, 1e-6);
}

TEST(PartitionVolumes, OfABlockOnAGridOfItsOwnAndOneThatEndsEarly)
{
  // The ball has samples of its own, in a box of its own; the background has none where the ball's box has none.
  const Lattice frame = MakeLattice(40, 40, 40);
  const Vec3 centre(19.7, 19.1, 19.9);
  const double radius = 9;
  const Lattice fine = MakeLattice(50, 50, 50, Vec3(0.5, 0.5, 0.5), Vec3(7.25, 7.25, 7.75)),
                inner = MakeLattice(26, 26, 26, Vec3::Ones(), Vec3(7, 7, 7));
  const SampledFields ball(fine, { Ball(centre, radius) }), rest(inner, { Not(Ball(centre, radius)) });
  std::vector<IndicatorBlock> blocks = { rest->Block(0), ball->Block(0) };
  blocks[0].Outside = 4;
  blocks[1].Outside = -4;
  const auto volumes = PartitionVolumes(blocks, frame);
  const double volume = 4.0 / 3.0 * M_PI * radius * radius * radius, box = 39 * 39 * 39;
  EXPECT_NEAR(volumes[1], volume, 0.01 * volume);
  EXPECT_NEAR(volumes[0] + volumes[1], box, 1e-6 * box);
  EXPECT_TRUE(PartitionVolumes({}, frame).empty());
}

namespace
{
/// Interpolates x^2 + x y - 2 z from samples around `middle` (in samples) and compares.
template <int Width>
void ExpectQuadratic(double middle)
{
  const auto f = [](double x, double y, double z) { return x * x + x * y - 2 * z; };
  typename CubicPoints<Width>::Samples samples;
  typename CubicPoints<Width>::Points points;
  for (int n = 0; n < int(samples.size()); ++n)
  {
    samples[n] = float(f(n % Width, n / Width % Width, n / (Width * Width)));
  }
  CubicPoints<Width>().Interpolate(samples, points);
  for (int n = 0; n < int(points.size()); ++n)
  {
    const auto at = [&](int i) { return middle + (i + 0.5) / 4 - 0.5; };
    EXPECT_NEAR(points[n], f(at(n % 4), at(n / 4 % 4), at(n / 16)), 1e-5);
  }
}
}

TEST(CubicPoints, ReproduceQuadraticsInACellAndInAVoxel)
{
  ExpectQuadratic<4>(1.5);
  ExpectQuadratic<5>(2.0);
}
