// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelObjects.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <random>
#include <set>

using namespace LabelMesh;

namespace
{
struct Volume
{
  std::array<int, 3> Dims;
  std::vector<MaterialId> Ids;

  Volume(int x, int y, int z, const std::function<int(int, int, int)>& id)
    : Dims{ x, y, z }
  {
    for (int k = 0; k < z; ++k)
    {
      for (int j = 0; j < y; ++j)
      {
        for (int i = 0; i < x; ++i)
        {
          this->Ids.push_back(MaterialId(id(i, j, k)));
        }
      }
    }
  }
  VoxelObjects Find(int numberOfIds) const { return FindVoxelObjects(this->Dims, this->Ids, 0, numberOfIds); }
};

void Expect(const VoxelObject& object, Index voxels, Index parts, Index genus, Index cavities, Index shells)
{
  EXPECT_EQ(object.Voxels, voxels);
  EXPECT_EQ(object.Parts, parts);
  EXPECT_EQ(object.Genus(), genus);
  EXPECT_EQ(object.Cavities, cavities);
  EXPECT_EQ(object.Shells, shells);
}

bool Between(int x, int low, int high)
{
  return low <= x && x <= high;
}
}

TEST(VoxelObjects, KnownShapes)
{
  // A block; a ring; a hollow block that holds a voxel of another label; a frame of a cube (genus 5).
  const Volume block(5, 4, 3, [](int i, int j, int k) { return Between(i, 1, 3) && j > 0 && k == 1; });
  Expect(block.Find(2).Objects[1], 9, 1, 0, 0, 1);
  Expect(block.Find(2).Objects[0], 60 - 9, 1, 0, 1, 1);

  const Volume ring(3, 3, 1, [](int i, int j, int) { return i != 1 || j != 1; });
  Expect(ring.Find(2).Objects[1], 8, 1, 1, 0, 1);
  Expect(ring.Find(2).Objects[0], 1, 1, 1, 1, 1);

  const Volume hollow(5, 5, 5,
    [](int i, int j, int k) {
      return Between(i, 1, 3) && Between(j, 1, 3) && Between(k, 1, 3) ? i + j + k == 6 && i == 2 && j == 2 ? 2 : 1 : 0;
    });
  const VoxelObjects found = hollow.Find(3);
  Expect(found.Objects[1], 26, 1, 0, 1, 2);
  Expect(found.Objects[2], 1, 1, 0, 0, 1);
  Expect(found.Objects[0], 125 - 27, 1, 0, 1, 1);
  ASSERT_EQ(found.Contacts.size(), 2u);
  EXPECT_EQ(found.Contacts[0].Ids, (std::array<MaterialId, 2>{ 0, 1 }));
  EXPECT_EQ(found.Contacts[0].Faces, 54);
  EXPECT_EQ(found.Contacts[1].Ids, (std::array<MaterialId, 2>{ 1, 2 }));
  EXPECT_EQ(found.Contacts[1].Faces, 6);

  const Volume frame(3, 3, 3, [](int i, int j, int k) { return (i == 1) + (j == 1) + (k == 1) < 2; });
  Expect(frame.Find(2).Objects[1], 20, 1, 5, 0, 1);
  EXPECT_EQ(frame.Find(2).Objects[1].Euler, 2 - 2 * 5);
}

TEST(VoxelObjects, VoxelsThatTouchBelongTogether)
{
  const Volume pair(2, 2, 1, [](int i, int j, int) { return i == j; });
  Expect(pair.Find(2).Objects[1], 2, 1, 0, 0, 1);
  const Volume corner(2, 2, 2, [](int i, int j, int k) { return i == j && j == k; });
  Expect(corner.Find(2).Objects[1], 2, 1, 0, 0, 1);
  const Volume apart(3, 1, 1, [](int i, int, int) { return i != 1; });
  Expect(apart.Find(2).Objects[1], 2, 2, 0, 0, 2);
  // Four voxels in a ring, each touching the next along an edge.
  const Volume ring(3, 3, 1, [](int i, int j, int) { return (i + j) % 2; });
  Expect(ring.Find(2).Objects[1], 4, 1, 1, 0, 1);
  // A hollow and a shaft that meet along an edge: the wall is closed there.
  const Volume wall(4, 4, 3, [](int i, int j, int k) { return (i != 1 || j != 1 || k != 1) && (i != 2 || j != 2); });
  EXPECT_EQ(wall.Find(2).Objects[1].Parts, 1);
  EXPECT_EQ(wall.Find(2).Objects[1].Cavities, 1);
}

TEST(VoxelObjects, FullAndPocketed)
{
  const Volume full(3, 4, 5, [](int, int, int) { return 1; });
  Expect(full.Find(2).Objects[1], 60, 1, 0, 0, 1);
  Expect(full.Find(2).Objects[0], 0, 1, 0, 1, 1);
  const Volume empty(3, 4, 5, [](int, int, int) { return 0; });
  Expect(empty.Find(2).Objects[1], 0, 0, 0, 0, 0);
  Expect(empty.Find(2).Objects[0], 60, 1, 0, 0, 0);
  const Volume pocket(5, 5, 5, [](int i, int j, int k) { return i != 2 || j != 2 || k != 2; });
  const VoxelObjects found = pocket.Find(2);
  Expect(found.Objects[1], 124, 1, 0, 1, 2);
  Expect(found.Objects[0], 1, 2, 0, 1, 2);
  ASSERT_EQ(found.Parts.size(), 3u);
  EXPECT_EQ(found.Parts[0].Voxels, 0) << "the outside holds no voxel here";
  EXPECT_EQ(found.Parts[2].First, 62);
}

TEST(VoxelObjects, RunsCoverTheVolumeAndPartsAreByFloodFill)
{
  std::mt19937 random(4);
  const Volume noise(9, 8, 7, [&](int, int, int) { return int(random() % 8 < 6 ? 0 : random() % 2 + 1); });
  const VoxelObjects found = noise.Find(3);
  std::vector<Index> part(noise.Ids.size(), -1);
  for (const VoxelRun& run : found.Runs)
  {
    for (Index v = run.First; v < run.Last; ++v)
    {
      ASSERT_EQ(part[v], -1);
      part[v] = run.Part;
      EXPECT_EQ(found.Parts[run.Part].Id, noise.Ids[v]);
    }
  }
  const VoxelObjects alone = FindVoxelParts({ 9, 8, 7 }, noise.Ids, 0, 3);
  ASSERT_EQ(alone.Parts.size(), found.Parts.size());
  ASSERT_EQ(alone.Runs.size(), found.Runs.size());
  for (std::size_t p = 0; p < found.Parts.size(); ++p)
  {
    EXPECT_EQ(alone.Parts[p].Voxels, found.Parts[p].Voxels);
  }
  Index components = 0;
  std::vector<bool> seen(part.size(), false);
  for (std::size_t start = 0; start < part.size(); ++start)
  {
    if (seen[start] || part[start] == 0)
    {
      continue;
    }
    ++components;
    std::vector<Index> front{ Index(start) };
    seen[start] = true;
    Index count = 0;
    while (!front.empty())
    {
      const Index v = front.back();
      front.pop_back();
      ++count;
      EXPECT_EQ(part[v], part[start]);
      for (int n = 0; n < 27; ++n)
      {
        const int x = int(v % 9) + n % 3 - 1, y = int(v / 9 % 8) + n / 3 % 3 - 1, z = int(v / 72) + n / 9 - 1;
        const Index w = x + 9 * (y + 8 * z);
        if (Between(x, 0, 8) && Between(y, 0, 7) && Between(z, 0, 6) && !seen[w] && noise.Ids[w] == noise.Ids[v])
        {
          seen[w] = true;
          front.push_back(w);
        }
      }
    }
    EXPECT_EQ(found.Parts[part[start]].Voxels, count);
    EXPECT_EQ(found.Parts[part[start]].First, Index(start));
  }
  EXPECT_EQ(components + 1, Index(found.Parts.size()));
  Index faces = 0;
  for (const VoxelContact& contact : found.Contacts)
  {
    faces += contact.Faces;
  }
  Index expected = 0;
  const auto at = [&](int i, int j, int k)
  {
    const bool inside = Between(i, 0, 8) && Between(j, 0, 7) && Between(k, 0, 6);
    return inside ? int(noise.Ids[i + 9 * (j + 8 * k)]) : 0;
  };
  for (int k = 0; k <= 7; ++k)
  {
    for (int j = 0; j <= 8; ++j)
    {
      for (int i = 0; i <= 9; ++i)
      {
        expected +=
          (at(i, j, k) != at(i - 1, j, k)) + (at(i, j, k) != at(i, j - 1, k)) + (at(i, j, k) != at(i, j, k - 1));
      }
    }
  }
  EXPECT_EQ(faces, expected);
  // What each label's numbers say of one another, and of the label and all the rest.
  for (int id = 1; id < 3; ++id)
  {
    const VoxelObject& object = found.Objects[id];
    EXPECT_EQ(object.Euler, 2 * (object.Parts - object.Genus() + object.Cavities));
    EXPECT_GE(object.Genus(), 0);
    EXPECT_GE(object.Cavities, 0);
  }
}

TEST(VoxelObjects, CavitiesAreHollowsWithoutAWayOutAcrossFaces)
{
  // Against the definition: pieces of everything else that touch across faces, the outside excepted.
  std::mt19937 random(6);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Volume noise(7, 7, 7, [&](int, int, int) { return random() % 100 < 55 ? 1 : 0; });
    const auto solid = [&](int i, int j, int k)
    { return Between(i, 0, 6) && Between(j, 0, 6) && Between(k, 0, 6) && noise.Ids[i + 7 * (j + 7 * k)] == 1; };
    std::set<std::array<int, 3>> seen;
    Index pieces = 0;
    for (int n = 0; n < 729; ++n)
    {
      const std::array<int, 3> start{ n % 9 - 1, n / 9 % 9 - 1, n / 81 - 1 };
      if (solid(start[0], start[1], start[2]) || !seen.insert(start).second)
      {
        continue;
      }
      ++pieces;
      std::vector<std::array<int, 3>> front{ start };
      while (!front.empty())
      {
        const auto v = front.back();
        front.pop_back();
        for (int m = 0; m < 6; ++m)
        {
          std::array<int, 3> w = v;
          w[m / 2] += m % 2 ? 1 : -1;
          if (Between(w[0], -1, 7) && Between(w[1], -1, 7) && Between(w[2], -1, 7) && !solid(w[0], w[1], w[2]) &&
            seen.insert(w).second)
          {
            front.push_back(w);
          }
        }
      }
    }
    EXPECT_EQ(noise.Find(2).Objects[1].Cavities, pieces - 1);
  }
}
