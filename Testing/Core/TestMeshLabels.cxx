// SPDX-License-Identifier: BSD-3-Clause
#include "MeshLabels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace LabelMesh;

namespace
{
struct Mesh
{
  std::vector<Vec3> Points;
  std::vector<InterfaceTriangle> Triangles;

  /// The faces of a box, each of two triangles.
  void Box(const Vec3& low, const Vec3& high, MaterialId inside, MaterialId outside)
  {
    const Index first = Index(this->Points.size());
    for (int n = 0; n < 8; ++n)
    {
      this->Points.emplace_back(n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2]);
    }
    for (const auto& q : { std::array<int, 4>{ 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
           { 0, 4, 6, 2 }, { 1, 3, 7, 5 } })
    {
      this->Triangles.push_back({ { first + q[0], first + q[1], first + q[2] }, { inside, outside } });
      this->Triangles.push_back({ { first + q[0], first + q[2], first + q[3] }, { inside, outside } });
    }
  }
};
}

TEST(MeshLabels, BoxesWithCornersEdgesAndDiagonalsOnTheRays)
{
  // Vertices, edges and diagonals over voxel centres: exactly one of two neighbours must claim each ray.
  const std::array<int, 3> dims{ 9, 8, 7 };
  Mesh mesh;
  mesh.Box(Vec3(1, 1, 0.5), Vec3(7, 7, 5.5), 1, 0);
  mesh.Box(Vec3(3, 3, 1.5), Vec3(5, 5, 3.5), 2, 1);
  const auto ids = LabelsByMesh(dims, mesh.Points, mesh.Triangles, 0);
  for (int k = 0; k < dims[2]; ++k)
  {
    for (int j = 0; j < dims[1]; ++j)
    {
      for (int i = 0; i < dims[0]; ++i)
      {
        // Moved a little up in x and y: the lower border belongs to the box, the upper one does not.
        const auto within = [](int x, int low, int high) { return x >= low && x < high; };
        const bool outer = within(i, 1, 7) && within(j, 1, 7) && k >= 1 && k <= 5;
        const bool inner = within(i, 3, 5) && within(j, 3, 5) && k >= 2 && k <= 3;
        ASSERT_EQ(ids[i + 9 * (j + 8 * k)], inner ? 2 : outer ? 1 : 0) << i << " " << j << " " << k;
      }
    }
  }
  // The same whichever way the triangles face.
  Mesh turned = mesh;
  for (InterfaceTriangle& t : turned.Triangles)
  {
    std::swap(t.Vertices[0], t.Vertices[1]);
  }
  EXPECT_EQ(LabelsByMesh(dims, turned.Points, turned.Triangles, 0), ids);
}

TEST(MeshLabels, MeshesThatReachBeyondTheVolume)
{
  Mesh mesh;
  mesh.Box(Vec3(-3, -2, -9), Vec3(9, 9, 9), 1, 0);
  const auto ids = LabelsByMesh({ 4, 4, 4 }, mesh.Points, mesh.Triangles, 0);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), MaterialId(1)), 64);
  EXPECT_EQ(LabelsByMesh({ 2, 2, 2 }, {}, {}, 3), std::vector<MaterialId>(8, 3));
}

TEST(MeshLabels, OverlapsBelongToNobody)
{
  Mesh mesh;
  mesh.Box(Vec3(-0.5, -0.5, 0.5), Vec3(4.5, 4.5, 3.5), 1, 0);
  mesh.Box(Vec3(-0.5, -0.5, 2.5), Vec3(4.5, 4.5, 4.5), 2, 0);
  const auto ids = LabelsByMesh({ 4, 4, 6 }, mesh.Points, mesh.Triangles, 0);
  const MaterialId expected[] = { 0, 1, 1, NoMaterial, 2, 0 };
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_EQ(ids[16 * k], expected[k]) << k;
  }
}

TEST(MeshLabels, DistancesToFacesOfTheSameTwoLabels)
{
  // Three slabs along x, 0 | 1 | 2, faces at x = 9.5 and 19.5; spacing 2 along x, 1 along y, 0.5 along z.
  const std::array<int, 3> dims{ 30, 4, 5 };
  std::vector<MaterialId> ids;
  for (int n = 0; n < 30 * 4 * 5; ++n)
  {
    ids.push_back(MaterialId(n % 30 < 10 ? 0 : n % 30 < 20 ? 1 : 2));
  }
  const LabelVoxels voxels{ dims, Vec3(2, 1, 0.5), 0, ids };
  const std::vector<Vec3> points{ { 9.75, 1, 2 }, { 14, 1, 2.3 }, { 6, 2, 2 }, { 18.5, 1, 1 }, { 9.5, 1.2, 2 },
    { 15, 3, 2 }, { 12, -7, 2 } };
  // Points 0, 1, 2 between 0 and 1; 3, 4, 5 between 1 and 2; point 6 is used by nothing.
  const auto distances = DistancesToVoxels(voxels, points, { { { 0, 1, 2 }, { 1, 0 } }, { { 3, 4, 5 }, { 2, 1 } } });
  EXPECT_NEAR(distances[0], 0.5, 1e-12);
  EXPECT_NEAR(distances[1], 1.1, 1e-12) << "space outside is background: up along z";
  EXPECT_NEAR(distances[2], 7.0, 1e-12);
  EXPECT_NEAR(distances[3], 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(distances[4])) << "ten voxels of 2 along x are farther than the search reaches";
  EXPECT_NEAR(distances[5], 9.0, 1e-12);
  EXPECT_TRUE(std::isnan(distances[6]));
}
