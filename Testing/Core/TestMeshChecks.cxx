// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

using namespace LabelMesh;

namespace
{
struct Mesh
{
  std::vector<Vec3> Points;
  std::vector<InterfaceTriangle> Triangles;

  Index Point(const Vec3& x)
  {
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      if (this->Points[i] == x)
      {
        return Index(i);
      }
    }
    this->Points.push_back(x);
    return Index(this->Points.size()) - 1;
  }
  void Triangle(const Vec3& a, const Vec3& b, const Vec3& c, MaterialId inside, MaterialId outside)
  {
    this->Triangles.push_back({ { this->Point(a), this->Point(b), this->Point(c) }, { inside, outside } });
  }
  /// A face of a box, its normal along +-axis.
  void Face(const Vec3& low, const Vec3& high, int axis, bool upper, MaterialId inside, MaterialId outside)
  {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 corner[4] = { low, low, high, low };
    corner[1][u] = high[u];
    corner[3][v] = high[v];
    for (Vec3& c : corner)
    {
      c[axis] = upper ? high[axis] : low[axis];
    }
    this->Triangle(corner[0], upper ? corner[1] : corner[2], upper ? corner[2] : corner[1], inside, outside);
    this->Triangle(corner[0], upper ? corner[2] : corner[3], upper ? corner[3] : corner[2], inside, outside);
  }
  void Box(const Vec3& low, const Vec3& high, MaterialId inside)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Face(low, high, axis, false, inside, 0);
      this->Face(low, high, axis, true, inside, 0);
    }
  }
  void Tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, MaterialId inside)
  {
    this->Triangle(a, c, b, inside, 0);
    this->Triangle(a, b, d, inside, 0);
    this->Triangle(b, c, d, inside, 0);
    this->Triangle(c, a, d, inside, 0);
  }
  MeshCheck Check(int materials, const std::vector<MaterialSet>& sets = {}) const
  {
    return CheckMesh(this->Points, this->Triangles, materials, sets);
  }
};

Mesh UnitCube()
{
  Mesh mesh;
  mesh.Box(Vec3::Zero(), Vec3::Ones(), 1);
  return mesh;
}

/// An octahedron, each triangle split in four `levels` times, on the sphere.
Mesh Sphere(double radius, const Vec3& centre, int levels)
{
  Mesh mesh;
  const auto split = [&](const auto& self, const Vec3& a, const Vec3& b, const Vec3& c, int level) -> void
  {
    if (level == 0)
    {
      mesh.Triangle(centre + radius * a, centre + radius * b, centre + radius * c, 1, 0);
      return;
    }
    const Vec3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
    self(self, a, ab, ca, level - 1);
    self(self, ab, b, bc, level - 1);
    self(self, ca, bc, c, level - 1);
    self(self, ab, bc, ca, level - 1);
  };
  for (int octant = 0; octant < 8; ++octant)
  {
    const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
    const bool turn = x * y * z < 0;
    const Vec3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
    split(split, a, turn ? c : b, turn ? b : c, levels);
  }
  return mesh;
}
}

TEST(MeshChecks, Cube)
{
  const MeshCheck check = UnitCube().Check(2);
  const MaterialCheck& cube = check.Materials[1];
  EXPECT_TRUE(cube.Closed());
  EXPECT_TRUE(cube.EdgeManifold());
  EXPECT_TRUE(cube.Oriented());
  EXPECT_EQ(cube.NonManifoldVertices, 0);
  EXPECT_EQ(cube.Quality.Triangles, 12);
  EXPECT_EQ(cube.Vertices, 8);
  EXPECT_EQ(cube.Euler, 2);
  EXPECT_EQ(cube.Components, 1);
  EXPECT_DOUBLE_EQ(cube.Volume, 1.0);
  EXPECT_DOUBLE_EQ(cube.Quality.Area, 6.0);
  // A right isosceles triangle: r_in / r_circ = sqrt(2) - 1.
  EXPECT_NEAR(cube.Quality.MinRadiusRatio, 2 * (std::sqrt(2.0) - 1), 1e-14);
  EXPECT_NEAR(cube.Quality.MeanRadiusRatio, 2 * (std::sqrt(2.0) - 1), 1e-14);
  // The background is the same surface seen from outside.
  EXPECT_DOUBLE_EQ(check.Materials[0].Volume, -1.0);
  EXPECT_TRUE(check.Materials[0].Closed());
  ASSERT_EQ(check.Pairs.size(), 1u);
  EXPECT_EQ(check.Pairs[0].Materials[0], 0);
  EXPECT_EQ(check.Pairs[0].Materials[1], 1);
  EXPECT_EQ(check.Vertices, 8);
  EXPECT_EQ(check.DuplicateTriangles + check.DegenerateTriangles + check.SameMaterialTriangles + check.WrongFaces, 0);
}

TEST(MeshChecks, PartsCavitiesAndHandles)
{
  // A hollow box, with a block inside the hollow, and a box apart.
  Mesh mesh;
  mesh.Box(Vec3::Zero(), Vec3::Constant(5), 1);
  Mesh hollow;
  hollow.Box(Vec3::Constant(1), Vec3::Constant(4), 1);
  for (const InterfaceTriangle& t : hollow.Triangles)
  {
    mesh.Triangle(hollow.Points[t.Vertices[0]], hollow.Points[t.Vertices[2]], hollow.Points[t.Vertices[1]], 1, 0);
  }
  mesh.Box(Vec3::Constant(2), Vec3::Constant(3), 1);
  mesh.Box(Vec3(7, 0, 0), Vec3(8, 1, 1), 1);
  const MeshCheck check = mesh.Check(2);
  EXPECT_EQ(check.Materials[1].Components, 4);
  EXPECT_EQ(check.Materials[1].OuterShells, 3);
  EXPECT_EQ(check.Materials[1].InnerShells, 1);
  EXPECT_EQ(check.Materials[0].OuterShells, 1) << "the pocket of background";
  EXPECT_EQ(check.Materials[0].InnerShells, 3);
  EXPECT_EQ(check.Materials[1].Genus(), 0);
  EXPECT_TRUE(check.Materials[1].Sound());
  EXPECT_DOUBLE_EQ(check.Materials[1].Volume, 125 - 27 + 1 + 1);

  // A frame of four bars: one handle. Its quads are the sides of the bars that show.
  Mesh frame;
  const auto filled = [](int i, int j) { return i >= 0 && i < 3 && j >= 0 && j < 3 && (i != 1 || j != 1); };
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const Vec3 low(i, j, 0), high(i + 1, j + 1, 1);
      for (int side = 0; filled(i, j) && side < 6; ++side)
      {
        const int step = side % 2 ? 1 : -1;
        if (side >= 4 || !filled(i + (side < 2 ? step : 0), j + (side < 2 ? 0 : step)))
        {
          frame.Face(low, high, side / 2, side % 2 == 1, 1, 0);
        }
      }
    }
  }
  const MaterialCheck ring = frame.Check(2).Materials[1];
  EXPECT_TRUE(ring.Sound());
  EXPECT_EQ(ring.Euler, 0);
  EXPECT_EQ(ring.Genus(), 1);
}

TEST(MeshChecks, SelfIntersectionsAndTheWorstTriangle)
{
  Mesh mesh = UnitCube();
  mesh.Triangles.insert(mesh.Triangles.begin(), InterfaceTriangle{ { 0, 1, 2 }, { 1, 1 } }); // left out of everything
  const MeshCheck clean = mesh.Check(3);
  EXPECT_EQ(clean.SelfIntersectingPairs, 0);
  EXPECT_EQ(clean.FirstIntersecting, -1);
  EXPECT_EQ(clean.Quality.Worst, 1);
  EXPECT_TRUE(clean.Materials[1].Sound());
  EXPECT_EQ(clean.Materials[2].Quality.Worst, -1);

  mesh.Tetrahedron(Vec3(0.5, 0.6, 0.5), Vec3(3, 0, 0), Vec3(3, 1, 0), Vec3(3, 0, 0.01), 2);
  const MeshCheck check = mesh.Check(3);
  EXPECT_GT(check.SelfIntersectingPairs, 0);
  EXPECT_EQ(check.Materials[1].SelfIntersections, 0) << "each of the two materials is whole by itself";
  EXPECT_EQ(check.Materials[2].SelfIntersections, 0);
  EXPECT_EQ(check.Materials[0].SelfIntersections, check.SelfIntersectingPairs) << "but not what is around them";
  EXPECT_FALSE(check.Materials[0].Sound());
  EXPECT_GT(check.FirstIntersecting, 0);
  EXPECT_EQ(check.Quality.Worst, check.Materials[2].Quality.Worst);
  EXPECT_GE(check.Quality.Worst, 13);
}

TEST(MeshChecks, VolumeAndAreaOfASphereConverge)
{
  double lastError = 1.0;
  for (int levels = 2; levels <= 4; ++levels)
  {
    // Far from the origin: the volume must not lose its digits.
    const MaterialCheck sphere = Sphere(2.0, Vec3(1e5, -2e5, 3e5), levels).Check(2).Materials[1];
    EXPECT_TRUE(sphere.Closed());
    EXPECT_EQ(sphere.Euler, 2);
    const double error = 1 - sphere.Volume / (4.0 / 3.0 * M_PI * 8.0);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.3 * lastError);
    lastError = error;
  }
  EXPECT_LT(lastError, 0.01);
}

TEST(MeshChecks, TwoBoxesThatShareAFace)
{
  Mesh mesh;
  const Vec3 step(1, 0, 0);
  mesh.Box(Vec3::Zero(), Vec3::Ones(), 1);
  mesh.Box(step, step + Vec3::Ones(), 2);
  // Drop both outer faces where the boxes touch, and put one face between them.
  const auto inside = [&](const InterfaceTriangle& t)
  {
    return mesh.Points[t.Vertices[0]].x() == 1 && mesh.Points[t.Vertices[1]].x() == 1 &&
      mesh.Points[t.Vertices[2]].x() == 1;
  };
  mesh.Triangles.erase(std::remove_if(mesh.Triangles.begin(), mesh.Triangles.end(), inside), mesh.Triangles.end());
  mesh.Face(Vec3::Zero(), Vec3::Ones(), 0, true, 1, 2);
  const MeshCheck check = mesh.Check(3);
  EXPECT_EQ(check.Quality.Triangles, 22);
  EXPECT_EQ(check.Vertices, 12);
  for (int m = 1; m <= 2; ++m)
  {
    EXPECT_TRUE(check.Materials[m].EdgeManifold());
    EXPECT_TRUE(check.Materials[m].Oriented());
    EXPECT_DOUBLE_EQ(check.Materials[m].Volume, 1.0);
    EXPECT_EQ(check.Materials[m].Quality.Triangles, 12);
    EXPECT_EQ(check.Materials[m].Euler, 2);
  }
  EXPECT_DOUBLE_EQ(check.Materials[0].Volume, -2.0);
  EXPECT_TRUE(check.Materials[0].EdgeManifold());
  ASSERT_EQ(check.Pairs.size(), 3u);
  EXPECT_EQ(check.Pairs[2].Quality.Triangles, 2);
  EXPECT_DOUBLE_EQ(check.Pairs[2].Quality.Area, 1.0);
}

TEST(MeshChecks, PinchedVertex)
{
  Mesh mesh;
  mesh.Tetrahedron(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 1);
  mesh.Tetrahedron(Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1), 1);
  const MaterialCheck check = mesh.Check(2).Materials[1];
  EXPECT_TRUE(check.Closed());
  EXPECT_TRUE(check.EdgeManifold());
  EXPECT_EQ(check.NonManifoldVertices, 1);
  EXPECT_EQ(check.Components, 1);
  EXPECT_EQ(check.Euler, 3);
}

TEST(MeshChecks, SharedEdgeIsNotManifold)
{
  Mesh mesh;
  mesh.Tetrahedron(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 1, 0), 1);
  mesh.Tetrahedron(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(-1, -1, 0), 1);
  const MaterialCheck check = mesh.Check(2).Materials[1];
  EXPECT_TRUE(check.Closed());
  EXPECT_FALSE(check.EdgeManifold());
  EXPECT_EQ(check.NonManifoldEdges, 1);
  EXPECT_EQ(check.NonManifoldVertices, 2);
  EXPECT_EQ(check.OpenEdges, 0);
  EXPECT_TRUE(check.Oriented());
}

TEST(MeshChecks, OpenSurfaceAndSeparatePieces)
{
  Mesh mesh = UnitCube();
  mesh.Box(Vec3::Constant(3), Vec3::Constant(4), 1);
  mesh.Triangles.erase(mesh.Triangles.begin());
  const MaterialCheck check = mesh.Check(2).Materials[1];
  EXPECT_FALSE(check.Closed());
  EXPECT_FALSE(check.EdgeManifold());
  EXPECT_EQ(check.OpenEdges, 3);
  EXPECT_EQ(check.Components, 2);
}

TEST(MeshChecks, TurnedTriangle)
{
  Mesh mesh = UnitCube();
  std::swap(mesh.Triangles[0].Vertices[0], mesh.Triangles[0].Vertices[1]);
  const MaterialCheck check = mesh.Check(2).Materials[1];
  EXPECT_TRUE(check.Closed());
  EXPECT_FALSE(check.Oriented());
  EXPECT_EQ(check.MisorientedEdges, 3);
}

TEST(MeshChecks, DuplicateDegenerateAndSameMaterial)
{
  Mesh mesh = UnitCube();
  InterfaceTriangle turned = mesh.Triangles[0];
  std::swap(turned.Vertices[0], turned.Vertices[1]);
  mesh.Triangles.push_back(turned);
  mesh.Triangles.push_back({ { 0, 1, 1 }, { 1, 0 } });
  mesh.Triangles.push_back({ { 0, 1, 2 }, { 1, 1 } });
  const MeshCheck check = mesh.Check(2);
  EXPECT_EQ(check.DuplicateTriangles, 1);
  EXPECT_EQ(check.DegenerateTriangles, 1);
  EXPECT_EQ(check.SameMaterialTriangles, 1);
  EXPECT_EQ(check.Quality.Triangles, 14);
  EXPECT_EQ(check.Quality.MinRadiusRatio, 0.0);
  EXPECT_EQ(check.FirstPercentileRatio, 0.0);
}

TEST(MeshChecks, FirstPercentile)
{
  // 204 good triangles: two bad ones are below the first percentile, a third one is on it.
  const Mesh cube = UnitCube();
  Mesh mesh;
  for (int copy = 0; copy < 17; ++copy)
  {
    const Index first = Index(mesh.Points.size());
    mesh.Points.insert(mesh.Points.end(), cube.Points.begin(), cube.Points.end());
    for (InterfaceTriangle triangle : cube.Triangles)
    {
      for (Index& vertex : triangle.Vertices)
      {
        vertex += first;
      }
      mesh.Triangles.push_back(triangle);
    }
  }
  mesh.Triangles.push_back({ { 0, 1, 1 }, { 1, 0 } });
  EXPECT_GT(mesh.Check(2).FirstPercentileRatio, 0.8);
  mesh.Triangles.push_back({ { 1, 2, 2 }, { 1, 0 } });
  EXPECT_GT(mesh.Check(2).FirstPercentileRatio, 0.8);
  mesh.Triangles.push_back({ { 2, 3, 3 }, { 1, 0 } });
  EXPECT_EQ(mesh.Check(2).FirstPercentileRatio, 0.0);
}

TEST(MeshChecks, WrongFaces)
{
  const Mesh mesh = UnitCube();
  std::vector<MaterialSet> sets(mesh.Points.size());
  for (MaterialSet& set : sets)
  {
    set.Insert(0);
    set.Insert(1);
  }
  EXPECT_EQ(mesh.Check(3, sets).WrongFaces, 0);
  sets[0] = MaterialSet();
  sets[0].Insert(0);
  sets[0].Insert(2);
  const Index around = std::count_if(mesh.Triangles.begin(), mesh.Triangles.end(),
    [](const InterfaceTriangle& t) { return t.Vertices[0] == 0 || t.Vertices[1] == 0 || t.Vertices[2] == 0; });
  EXPECT_EQ(mesh.Check(3, sets).WrongFaces, around);
}

TEST(MeshChecks, EmptyAndInvalid)
{
  const MeshCheck check = Mesh().Check(3);
  EXPECT_EQ(check.Materials.size(), 3u);
  EXPECT_EQ(check.Quality.Triangles, 0);
  EXPECT_EQ(check.Quality.MinRadiusRatio, 1.0);
  EXPECT_EQ(check.FirstPercentileRatio, 1.0);
  EXPECT_TRUE(check.Materials[1].Closed());
  EXPECT_EQ(check.Materials[1].Components, 0);
  Mesh bad = UnitCube();
  EXPECT_THROW(bad.Check(1), std::invalid_argument);
  bad.Triangles[0].Vertices[0] = 99;
  EXPECT_THROW(bad.Check(2), std::invalid_argument);
}
