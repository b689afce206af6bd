// SPDX-License-Identifier: BSD-3-Clause
#include "DelicateParts.h"
#include "MaterialMasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace LabelMesh;

namespace
{
constexpr std::array<int, 3> Dims{ 20, 18, 16 };

std::vector<MaterialId> Volume(const std::function<int(int, int, int)>& label)
{
  std::vector<MaterialId> ids;
  for (int k = 0; k < Dims[2]; ++k)
  {
    for (int j = 0; j < Dims[1]; ++j)
    {
      for (int i = 0; i < Dims[0]; ++i)
      {
        ids.push_back(MaterialId(label(i, j, k)));
      }
    }
  }
  return ids;
}

bool InBlock(int i, int j, int k, int first, int last)
{
  return std::min({ i, j, k }) >= first && std::max({ i, j, k }) <= last;
}
}

TEST(DelicateParts, SheetsOfOneVoxelAskForTwoSamplesPerVoxel)
{
  for (const int axis : { 0, 1, 2 })
  {
    for (const int thickness : { 1, 2, 3 })
    {
      const auto ids = Volume(
        [&](int i, int j, int k)
        {
          const int x = std::array<int, 3>{ i, j, k }[axis];
          return x >= 5 && x < 5 + thickness ? 1 : 0;
        });
      const DelicateParts found = FindDelicateParts(Dims, ids, 0, 2, false, 4);
      EXPECT_EQ(found.Factor, thickness == 1 ? 2 : 1);
      ASSERT_EQ(found.Labels.size(), thickness == 1 ? 1u : 0u);
      const Index sheet = Index(ids.size()) / Dims[axis];
      EXPECT_EQ(std::count(found.Delicate.begin(), found.Delicate.end(), 1), thickness == 1 ? sheet : 0);
      if (thickness == 1)
      {
        EXPECT_EQ(found.Labels[0].ThinVoxels, sheet);
        EXPECT_EQ(found.Labels[0].Voxels, sheet);
        EXPECT_EQ(found.Labels[0].SmallVoxels, sheet < 300 ? sheet : 0);
      }
    }
  }
}

TEST(DelicateParts, SmallComponentsAskForEnoughSamples)
{
  const auto cube = [](int edge)
  { return Volume([edge](int i, int j, int k) { return InBlock(i, j, k, 4, 3 + edge) ? 1 : 0; }); };
  const std::array<std::array<int, 2>, 5> expected{ { { 1, 4 }, { 2, 4 }, { 3, 3 }, { 4, 2 }, { 7, 1 } } };
  for (const auto& [edge, factor] : expected)
  {
    EXPECT_EQ(FindDelicateParts(Dims, cube(edge), 0, 2, false, 4).Factor, factor) << edge;
    EXPECT_EQ(FindDelicateParts(Dims, cube(edge), 0, 2, false, 2).Factor, std::min(factor, 2)) << edge;
    EXPECT_EQ(FindDelicateParts(Dims, cube(edge), 0, 2, false, 1).Factor, 1) << edge;
  }
}

TEST(DelicateParts, SpecksOfALargeLabelDoNotDecide)
{
  const auto ids = Volume(
    [](int i, int j, int k) { return InBlock(i, j, k, 1, 10) || (i == 15 && j % 4 == 1 && k % 4 == 1) ? 1 : 0; });
  const DelicateParts found = FindDelicateParts(Dims, ids, 0, 2, false, 3);
  EXPECT_EQ(found.Factor, 1);
  EXPECT_TRUE(found.Labels.empty());
  EXPECT_TRUE(found.Delicate.empty());
}

TEST(DelicateParts, LabelsGoOnBeyondAFlatBorder)
{
  const auto ids = Volume([](int, int, int k) { return k == 0 ? 1 : 2; });
  EXPECT_EQ(FindDelicateParts(Dims, ids, 0, 3, false, 3).Factor, 2);
  EXPECT_EQ(FindDelicateParts(Dims, ids, 0, 3, true, 3).Factor, 1);
}

TEST(DelicateParts, AreRepeatedAsTheyAre)
{
  const GridFrame frame(
    { 0, Dims[0] - 1, 0, Dims[1] - 1, 0, Dims[2] - 1 }, Vec3::Zero(), Vec3::Ones(), Mat3::Identity());
  const auto ids =
    Volume([](int i, int j, int k) { return i == 17 && j == 6 && k == 7 ? 2
                                       : InBlock(i, j, k, 3, 13)        ? 1
                                                                        : 0; });
  const DelicateParts found = FindDelicateParts(Dims, ids, 0, 3, false, 3);
  ASSERT_EQ(found.Factor, 3);
  const GridFrame fine = Resampled(frame, 3);
  const auto interpolated = ResampleLabels(ids, frame, fine), kept = ResampleLabels(ids, frame, fine, &found.Delicate);
  EXPECT_EQ(std::count(interpolated.begin(), interpolated.end(), 2), 7) << "without its corners and edges";
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 2), 27);
  EXPECT_EQ(kept[fine.Samples().At(3 * 17, 3 * 6, 3 * 7)], 2);
  // The block's own corners are interpolated in both.
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), std::count(interpolated.begin(), interpolated.end(), 1));
  EXPECT_LT(std::count(kept.begin(), kept.end(), 1), 33 * 33 * 33);
}
