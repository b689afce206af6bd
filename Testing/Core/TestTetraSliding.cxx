// SPDX-License-Identifier: BSD-3-Clause
#include "InterfaceMesh.h"
#include "SelfIntersections.h"
#include "TetraImprovement.h"
#include "TetraQuality.h"
#include "TetraSmoothing.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace LabelMesh;

namespace
{
double QualityOf(const TetraMesh& mesh, std::size_t t)
{
  const auto& c = mesh.Corners[t];
  return TetraQuality(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]);
}

double Worst(const TetraMesh& mesh)
{
  double worst = 1.0;
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    worst = std::min(worst, QualityOf(mesh, t));
  }
  return worst;
}

/// All vertices are on the interface; tetrahedra are turned to be positively oriented.
TetraMesh MeshOf(std::vector<Vec3> points, std::vector<TetraCorners> corners, std::vector<MaterialId> materials)
{
  TetraMesh mesh{ std::move(points), 0, std::move(corners), std::move(materials) };
  mesh.SurfacePoints = Index(mesh.Points.size());
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    if (QualityOf(mesh, t) < 0.0)
    {
      std::swap(mesh.Corners[t][0], mesh.Corners[t][1]);
    }
  }
  return mesh;
}

/// Two edges that cross at a right angle, one a little above the other.
std::vector<Vec3> FlatTetrahedron(double height)
{
  return { Vec3(1, 0, height), Vec3(-1, 0, height), Vec3(0, 1, 0), Vec3(0, -1, 0) };
}

double MeanEdge(const TetraMesh& mesh, const TetraCorners& c, std::int32_t v)
{
  double sum = 0.0;
  for (const std::int32_t other : c)
  {
    sum += (mesh.Points[other] - mesh.Points[v]).norm();
  }
  return sum / 3.0;
}

double WorstTriangle(const TetraMesh& mesh)
{
  double worst = 1.0;
  for (const TetraCorners& c : mesh.Corners)
  {
    for (int j = 0; j < 4; ++j)
    {
      const FaceCorners f = FaceOpposite(c, j);
      worst = std::min(worst, RadiusRatio(mesh.Points[f[0]], mesh.Points[f[1]], mesh.Points[f[2]]));
    }
  }
  return worst;
}

/// The pairs of outer faces that cut each other.
std::size_t Cuts(const TetraMesh& mesh)
{
  std::vector<TriangleCorners> faces;
  for (const TetraCorners& c : mesh.Corners)
  {
    for (int j = 0; j < 4; ++j)
    {
      const FaceCorners f = FaceOpposite(c, j);
      faces.push_back({ f[0], f[1], f[2] });
    }
  }
  return FindSelfIntersections(mesh.Points, faces).Pairs.size();
}
}

TEST(TetraSliding, MovesAreBoundedByABallAndFixedCoordinates)
{
  const MoveRegion region{ Vec3(1, 2, 3), 0.5, { false, true, false } };
  EXPECT_EQ(region.Nearest(Vec3(1.1, 2, 3)), Vec3(1.1, 2, 3));
  EXPECT_EQ(region.Nearest(Vec3(1.1, 7, 3)), Vec3(1.1, 2, 3)) << "y is fixed";
  EXPECT_LT((region.Nearest(Vec3(4, 2, 7)) - Vec3(1.3, 2, 3.4)).norm(), 1e-12);
}

TEST(TetraSliding, OpensASliverOfTheInterface)
{
  const TetraMesh mesh = MeshOf(FlatTetrahedron(0.02), { { 0, 1, 2, 3 } }, { 0 });
  ASSERT_LT(Worst(mesh), 0.02);
  TetraImproveOptions options;
  options.Slide.Rounds = 0;
  TetraMesh same = mesh;
  ImproveTetrahedra(same, options, Monitor());
  EXPECT_EQ(same.Points, mesh.Points) << "nothing may move";

  TetraMesh opened = mesh;
  const TetraImproveResult result = ImproveTetrahedra(opened, {}, Monitor());
  EXPECT_GT(result.Slides, 0);
  EXPECT_EQ(opened.Corners, mesh.Corners);
  EXPECT_GT(Worst(opened), 0.1);
  EXPECT_GE(WorstTriangle(opened), std::min(0.75, WorstTriangle(mesh)) - 1e-12);
  for (std::int32_t v = 0; v < 4; ++v)
  {
    const double reach = options.Slide.Reach * MeanEdge(mesh, mesh.Corners[0], v);
    // The mean edge is that before its first move, when others had moved.
    EXPECT_LE((opened.Points[v] - mesh.Points[v]).norm(), 1.05 * reach);
  }
}

TEST(TetraSliding, AsksTheMaterialsOnAllSides)
{
  // A flat tetrahedron of one material between two thick ones of another, which touch it at a face each: what one gains
  // the others may not lose.
  std::vector<Vec3> points = FlatTetrahedron(0.02);
  points.emplace_back(0.0, 0.0, 1.2);
  points.emplace_back(0.0, 0.0, -1.2);
  const TetraMesh mesh = MeshOf(
    points, { { 0, 1, 2, 3 }, { 0, 1, 2, 4 }, { 0, 1, 3, 4 }, { 2, 3, 0, 5 }, { 2, 3, 1, 5 } }, { 0, 1, 1, 1, 1 });
  TetraMesh opened = mesh;
  EXPECT_GT(ImproveTetrahedra(opened, {}, Monitor()).Slides, 0);
  EXPECT_EQ(opened.Corners.size(), mesh.Corners.size());
  EXPECT_GT(Worst(opened), 0.1);
  double before = 0.0, after = 0.0;
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    const auto volume = [t](const TetraMesh& of)
    {
      const auto& c = of.Corners[t];
      return SignedVolume(of.Points[c[0]], of.Points[c[1]], of.Points[c[2]], of.Points[c[3]]);
    };
    EXPECT_GT(volume(opened), 0.0);
    before += volume(mesh);
    after += volume(opened);
  }
  EXPECT_NEAR(after, before, 0.1 * before);
}

TEST(TetraSliding, VerticesStayInTheFacesOfTheBox)
{
  // The lower edge lies in the face z = 0 of the box, one end of the upper one in its face x = 1.
  const TetraMesh mesh = MeshOf(FlatTetrahedron(0.02), { { 0, 1, 2, 3 } }, { 0 });
  TetraImproveOptions options;
  options.Slide.Box = VolumeBox{ Vec3(-3, -3, 0), Vec3(1, 3, 3) };
  TetraMesh opened = mesh;
  EXPECT_GT(ImproveTetrahedra(opened, options, Monitor()).Slides, 0);
  EXPECT_GT(Worst(opened), Worst(mesh) + 0.05);
  EXPECT_EQ(opened.Points[2][2], 0.0);
  EXPECT_EQ(opened.Points[3][2], 0.0);
  EXPECT_EQ(opened.Points[0][0], 1.0);
}

TEST(TetraSliding, CutsNothingBeyondTheBackground)
{
  // Just above the upper edge's ends and below the lower one's are the tips of four other tetrahedra.
  const double gap = 0.01, height = 0.02;
  std::vector<Vec3> points = FlatTetrahedron(height);
  std::vector<TetraCorners> corners = { { 0, 1, 2, 3 } };
  for (int v = 0; v < 4; ++v)
  {
    const double up = v < 2 ? 1.0 : -1.0;
    const Vec3 tip = points[v] + Vec3(0, 0, up * gap);
    const auto n = std::int32_t(points.size());
    for (const Vec3& offset : { Vec3(0, 0, 0), Vec3(0.8, 0, up), Vec3(-0.4, 0.7, up), Vec3(-0.4, -0.7, up) })
    {
      points.push_back(tip + offset);
    }
    corners.push_back({ n, n + 1, n + 2, n + 3 });
  }
  const TetraMesh mesh = MeshOf(points, corners, std::vector<MaterialId>(5, 0));
  ASSERT_EQ(Cuts(mesh), 0u);
  TetraMesh opened = mesh;
  ImproveTetrahedra(opened, {}, Monitor());
  EXPECT_EQ(Cuts(opened), 0u);
  EXPECT_GE(Worst(opened), Worst(mesh));
  // The same without the tips ends higher than they are.
  TetraMesh alone = MeshOf(FlatTetrahedron(height), { { 0, 1, 2, 3 } }, { 0 });
  ImproveTetrahedra(alone, {}, Monitor());
  EXPECT_GT(std::max(alone.Points[0][2], alone.Points[1][2]), height + gap);
}

TEST(TetraSliding, LeavesGoodTetrahedraAlone)
{
  const TetraMesh mesh = MeshOf(FlatTetrahedron(0.9), { { 0, 1, 2, 3 } }, { 0 });
  TetraMesh same = mesh;
  EXPECT_EQ(ImproveTetrahedra(same, {}, Monitor()).Slides, 0);
  EXPECT_EQ(same.Points, mesh.Points);
}
