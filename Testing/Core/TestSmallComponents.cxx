// SPDX-License-Identifier: BSD-3-Clause
#include "SmallComponents.h"

#include <gtest/gtest.h>

using namespace LabelMesh;

namespace
{
constexpr std::array<int, 3> Dims{ 12, 10, 8 };

Index At(int i, int j, int k)
{
  return i + Dims[0] * (j + Index(Dims[1]) * k);
}

/// The lower half is 1, the upper one background.
std::vector<MaterialId> Halves()
{
  std::vector<MaterialId> ids(At(0, 0, Dims[2]), 0);
  std::fill(ids.begin(), ids.begin() + At(0, 0, 4), MaterialId(1));
  return ids;
}
}

TEST(SmallComponents, GoToWhatTheyShareMostFacesWith)
{
  std::vector<MaterialId> ids = Halves();
  ids[At(5, 5, 2)] = 2;                    // within 1
  ids[At(8, 5, 4)] = ids[At(8, 5, 5)] = 2; // on top of 1: one face of ten
  ids[At(2, 2, 3)] = 3;                    // in the surface of 1
  ids[At(2, 6, 6)] = ids[At(3, 7, 7)] = 3; // two that share a corner
  ids[At(11, 0, 7)] = 2;                   // in a corner of the volume
  std::vector<MaterialId> expected = Halves();
  const auto dropped = DropSmallComponents(Dims, ids, 0, 4, 3);
  EXPECT_EQ(ids, expected);
  ASSERT_EQ(dropped.size(), 5u);
  const std::array<MaterialId, 5> from{ 2, 3, 2, 3, 2 }, to{ 1, 1, 0, 0, 0 };
  const std::array<Index, 5> voxels{ 1, 1, 2, 2, 1 };
  const std::array<Index, 5> first{ At(5, 5, 2), At(2, 2, 3), At(8, 5, 4), At(2, 6, 6), At(11, 0, 7) };
  for (int n = 0; n < 5; ++n)
  {
    EXPECT_EQ(dropped[n].From, from[n]);
    EXPECT_EQ(dropped[n].To, to[n]);
    EXPECT_EQ(dropped[n].Voxels, voxels[n]);
    EXPECT_EQ(dropped[n].First, first[n]);
  }
}

TEST(SmallComponents, LeaveWhatIsLargeEnoughAndTheBackground)
{
  std::vector<MaterialId> ids = Halves();
  ids[At(5, 5, 1)] = 0;                    // a hollow
  ids[At(5, 5, 6)] = ids[At(6, 6, 7)] = 2; // two voxels
  const std::vector<MaterialId> before = ids;
  EXPECT_TRUE(DropSmallComponents(Dims, ids, 0, 3, 2).empty());
  EXPECT_EQ(ids, before);
  EXPECT_EQ(DropSmallComponents(Dims, ids, 0, 3, 3).size(), 1u);
}

TEST(SmallComponents, OneInsideAnotherFollowsIt)
{
  // A voxel of 3 in a shell of 2: the shell goes to the background, and then what it held.
  std::vector<MaterialId> ids(At(0, 0, Dims[2]), 0);
  for (int n = 0; n < 27; ++n)
  {
    ids[At(4 + n % 3, 4 + n / 3 % 3, 3 + n / 9)] = n == 13 ? 3 : 2;
  }
  EXPECT_EQ(DropSmallComponents(Dims, ids, 0, 4, 27).size(), 2u);
  EXPECT_EQ(ids, std::vector<MaterialId>(ids.size(), 0));
}
