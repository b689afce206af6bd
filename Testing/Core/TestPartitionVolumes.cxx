// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "PartitionVolumes.h"

#include <gtest/gtest.h>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

TEST(PartitionVolumes, OfABallAreItsOwn)
{
  const Lattice frame = MakeLattice(40, 30, 50, Vec3(1, 1.3, 0.8));
  const Vec3 centre(19.7, 19.1, 19.9);
  const double radius = 12;
  const SampledFields fields(frame, { Not(Ball(centre, radius)), Ball(centre, radius) });
  const auto volumes = PartitionVolumes(*fields);
  const double ball = 4.0 / 3.0 * M_PI * radius * radius * radius, box = 39 * 29 * 49 * frame.VoxelVolume();
  EXPECT_NEAR(volumes[1], ball, 0.005 * ball);
  EXPECT_NEAR(volumes[0] + volumes[1], box, 1e-3 * box);
}

TEST(PartitionVolumes, NeighboursFillWhatAMaterialLeaves)
{
  // Both say that they end half a voxel before they meet: each holds its half all the same.
  const Lattice frame = MakeLattice(21, 21, 21);
  const SampledFields fields(
    frame, { [](const Vec3& x) { return x[0] - 10.5; }, [](const Vec3& x) { return 9.5 - x[0]; } });
  const auto volumes = PartitionVolumes(*fields);
  EXPECT_NEAR(volumes[0], 10 * 400, 1e-6);
  EXPECT_NEAR(volumes[1], 10 * 400, 1e-6);
}
