// SPDX-License-Identifier: BSD-3-Clause
#include "GridFrame.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace LabelMesh;

namespace
{
Mat3 Rotation()
{
  return (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())).toRotationMatrix();
}
Mat3 Mirror()
{
  return Rotation() * Vec3(1, -1, 1).asDiagonal();
}
const std::array<int, 6> Extent{ -3, 10, 5, 20, 2, 7 };
const Vec3 Origin(10, -20, 30), Spacing(0.5, 1.25, 3.0);
}

TEST(GridFrame, MapsIndicesOfARotatedAndOfAMirroredImageForthAndBack)
{
  for (const Mat3& direction : { Mat3(Mat3::Identity()), Rotation(), Mirror() })
  {
    const GridFrame frame(Extent, Origin, Spacing, direction);
    EXPECT_LT((frame.ToWorld(0, 0, 0) - Origin).norm(), 1e-12);
    const Vec3 expected =
      Origin + 4 * 0.5 * direction.col(0) + 6 * 1.25 * direction.col(1) - 2 * 3.0 * direction.col(2);
    EXPECT_LT((frame.ToWorld(4, 6, -2) - expected).norm(), 1e-12);
    EXPECT_LT((frame.ToIndex(expected) - Vec3(4, 6, -2)).norm(), 1e-12);
  }
  EXPECT_FALSE(GridFrame(Extent, Origin, Spacing, Rotation()).Mirrored());
  EXPECT_TRUE(GridFrame(Extent, Origin, Spacing, Mirror()).Mirrored());
}

TEST(GridFrame, TheLocalFrameKeepsLengths)
{
  const GridFrame frame(Extent, Origin, Spacing, Mirror());
  const Vec3 a(1, 2, 3), b(-4, 0, 9);
  EXPECT_NEAR((frame.LocalToWorld(a) - frame.LocalToWorld(b)).norm(), (a - b).norm(), 1e-12);
  EXPECT_LT((frame.WorldToLocal(frame.LocalToWorld(a)) - a).norm(), 1e-12);
}

TEST(GridFrame, SamplesStartAtTheExtent)
{
  const GridFrame frame(Extent, Origin, Spacing, Rotation());
  const Lattice samples = frame.Samples();
  EXPECT_EQ(samples.Dims, (std::array<int, 3>{ 14, 16, 6 }));
  EXPECT_LT((frame.LocalToWorld(samples.Position(2, 3, 1)) - frame.ToWorld(-1, 8, 3)).norm(), 1e-12);
  EXPECT_EQ(frame.Grown(2).Samples().Dims, (std::array<int, 3>{ 18, 20, 10 }));
}

TEST(GridFrame, FindsAnotherImageInItsOwnFrame)
{
  const GridFrame frame(Extent, Origin, Spacing, Mirror());
  const GridFrame other({ 4, 9, 0, 3, 1, 5 }, Vec3(1, 2, 3), Vec3(1, 1, 2), Mirror());
  const Lattice lattice = frame.LatticeOf(other);
  EXPECT_LT((frame.LocalToWorld(lattice.Position(1, 2, 3)) - other.ToWorld(5, 2, 4)).norm(), 1e-12);
  EXPECT_THROW(frame.LatticeOf(GridFrame(Extent, Origin, Spacing, Rotation())), std::invalid_argument);
}

TEST(GridFrame, RefusesWhatIsNoImage)
{
  EXPECT_THROW(GridFrame({ 0, -1, 0, 5, 0, 5 }, Origin, Spacing, Rotation()), std::invalid_argument);
  EXPECT_THROW(GridFrame(Extent, Origin, Vec3(1, 0, 1), Rotation()), std::invalid_argument);
  EXPECT_THROW(GridFrame(Extent, Origin, Spacing, Mat3(2 * Mat3::Identity())), std::invalid_argument);
}
