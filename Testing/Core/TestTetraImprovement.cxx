// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay.h"
#include "Parallel.h"
#include "TetraComplex.h"
#include "TetraFlips.h"
#include "TetraImprovement.h"
#include "TetraInsertion.h"
#include "TetraQuality.h"
#include "TetraSmoothing.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace LabelMesh;

namespace
{
using Face = std::array<std::int32_t, 3>;

double Volume(const TetraMesh& mesh, std::size_t t)
{
  const auto& c = mesh.Corners[t];
  return SignedVolume(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]);
}

double Worst(const TetraMesh& mesh)
{
  double worst = 1.0;
  for (const auto& c : mesh.Corners)
  {
    worst = std::min(worst, TetraQuality(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]));
  }
  return worst;
}

double MeanRatio(const TetraMesh& mesh)
{
  double sum = 0.0;
  for (const auto& c : mesh.Corners)
  {
    sum += TetraRadiusRatio(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]);
  }
  return sum / double(mesh.Corners.size());
}

std::map<MaterialId, double> Volumes(const TetraMesh& mesh)
{
  std::map<MaterialId, double> volumes;
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    volumes[mesh.Materials[t]] += Volume(mesh, t);
  }
  return volumes;
}

/// The faces with one tetrahedron, or two of different materials, with those.
std::map<Face, std::vector<MaterialId>> Interfaces(const TetraMesh& mesh)
{
  std::map<Face, std::vector<MaterialId>> faces;
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    for (int j = 0; j < 4; ++j)
    {
      Face face = FaceOpposite(mesh.Corners[t], j);
      std::sort(face.begin(), face.end());
      faces[face].push_back(mesh.Materials[t]);
    }
  }
  for (auto at = faces.begin(); at != faces.end();)
  {
    std::sort(at->second.begin(), at->second.end());
    EXPECT_LE(at->second.size(), 2u) << "a face with more than two tetrahedra";
    const bool inside = at->second.size() == 2 && at->second[0] == at->second[1];
    at = inside ? faces.erase(at) : std::next(at);
  }
  return faces;
}

/// All that improvement may not change.
void ExpectSameBody(const TetraMesh& before, const TetraMesh& after)
{
  ASSERT_EQ(before.SurfacePoints, after.SurfacePoints);
  ASSERT_GE(Index(after.Points.size()), after.SurfacePoints);
  EXPECT_TRUE(std::equal(before.Points.begin(), before.Points.begin() + before.SurfacePoints, after.Points.begin()));
  EXPECT_EQ(Interfaces(before), Interfaces(after));
  const auto was = Volumes(before), is = Volumes(after);
  ASSERT_EQ(was.size(), is.size());
  for (const auto& [material, volume] : was)
  {
    EXPECT_NEAR(is.at(material), volume, 1e-12 * volume);
  }
  for (std::size_t t = 0; t < after.Corners.size(); ++t)
  {
    EXPECT_GT(Volume(after, t), 0.0);
  }
  std::vector<char> used(after.Points.size(), 0);
  for (const auto& c : after.Corners)
  {
    for (const std::int32_t v : c)
    {
      used[v] = 1;
    }
  }
  EXPECT_EQ(std::count(used.begin() + after.SurfacePoints, used.end(), 0), 0) << "interior points nobody uses";
}

/// A mesh of one material: corners are turned to be positively oriented.
TetraMesh MeshOf(std::vector<Vec3> points, std::vector<TetraCorners> corners, Index surfacePoints)
{
  TetraMesh mesh{ std::move(points), surfacePoints, std::move(corners), {} };
  mesh.Materials.assign(mesh.Corners.size(), 0);
  for (std::size_t t = 0; t < mesh.Corners.size(); ++t)
  {
    if (Volume(mesh, t) < 0.0)
    {
      std::swap(mesh.Corners[t][0], mesh.Corners[t][1]);
    }
  }
  return mesh;
}

/// Two vertices above and below a regular polygon around their edge.
std::vector<Vec3> Spindle(int sides, double halfHeight)
{
  std::vector<Vec3> points = { Vec3(0, 0, -halfHeight), Vec3(0, 0, halfHeight) };
  for (int n = 0; n < sides; ++n)
  {
    const double angle = 2.0 * M_PI * n / sides;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return points;
}
TetraMesh AroundEdge(int sides, double halfHeight)
{
  std::vector<TetraCorners> corners;
  for (std::int32_t n = 0; n < sides; ++n)
  {
    corners.push_back({ 0, 1, 2 + n, 2 + (n + 1) % sides });
  }
  return MeshOf(Spindle(sides, halfHeight), corners, sides + 2);
}

/// Jittered points in a box that a plane cuts into two materials, with the Delaunay tetrahedra of all.
TetraMesh TwoMaterials(int n, double jitter)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> chance(-jitter, jitter);
  std::vector<Vec3> surface, inside;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        // Vertices of the planes stay in them, and no four of them on a circle.
        Vec3 x(i, j, k);
        const std::array<bool, 3> flat = { i == 0 || i == n, j == 0 || j == n, k == 0 || k == n || k == n / 2 };
        const bool on = flat[0] || flat[1] || flat[2];
        for (int axis = 0; axis < 3; ++axis)
        {
          x[axis] += flat[axis] ? 0.0 : (on ? 0.3 : 1.0) * chance(random);
        }
        (on ? surface : inside).push_back(x);
      }
    }
  }
  std::vector<Vec3> points = surface;
  points.insert(points.end(), inside.begin(), inside.end());
  std::vector<TetraCorners> corners;
  std::vector<MaterialId> materials;
  for (const TetraCorners& c : DelaunayTetrahedra(points).Corners)
  {
    const double volume = SignedVolume(points[c[0]], points[c[1]], points[c[2]], points[c[3]]);
    double sum = 0.0, least = n, most = 0.0;
    for (const std::int32_t v : c)
    {
      sum += points[v][2] / 4.0;
      least = std::min(least, points[v][2]);
      most = std::max(most, points[v][2]);
    }
    if (std::abs(volume) > 1e-9)
    {
      EXPECT_FALSE(least < n / 2 && most > n / 2) << "a tetrahedron across the interface";
      corners.push_back(volume > 0 ? c : TetraCorners{ c[1], c[0], c[2], c[3] });
      materials.push_back(sum < n / 2 ? 0 : 1);
    }
  }
  return { points, Index(surface.size()), corners, materials };
}

/// A ball with vertices on its sphere only.
TetraMesh HollowBall(int count)
{
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n)
  {
    const double z = 1.0 - (2.0 * n + 1.0) / count, angle = 2.399963229728653 * n, r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return MeshOf(points, DelaunayTetrahedra(points).Corners, count);
}

bool SameBits(const TetraMesh& a, const TetraMesh& b)
{
  return a.Points == b.Points && a.Corners == b.Corners && a.Materials == b.Materials;
}
}

TEST(TetraComplex, FindsNeighborsRingsAndStars)
{
  const TetraMesh mesh = AroundEdge(5, 1.0);
  const TetraComplex complex(mesh);
  TetraComplex::Ring ring;
  complex.EdgeRing(2, complex.CornerOf(2, 0), complex.CornerOf(2, 1), ring);
  ASSERT_TRUE(ring.Closed);
  ASSERT_EQ(ring.Vertices.size(), 5u);
  for (std::size_t n = 0; n < 5; ++n)
  {
    const TetraCorners expected = { 0, 1, ring.Vertices[n], ring.Vertices[(n + 1) % 5] };
    EXPECT_GT(complex.QualityOf(expected), 0.0);
    for (const std::int32_t v : expected)
    {
      EXPECT_GE(complex.CornerOf(ring.Tetrahedra[n], v), 0);
    }
  }
  complex.EdgeRing(2, complex.CornerOf(2, 0), complex.CornerOf(2, ring.Vertices[0]), ring);
  EXPECT_FALSE(ring.Closed) << "an edge on the border";

  TetraMesh crowded = mesh;
  crowded.Corners.push_back(crowded.Corners[0]);
  crowded.Materials.push_back(0);
  crowded.Corners.push_back(crowded.Corners[0]);
  crowded.Materials.push_back(0);
  EXPECT_THROW(TetraComplex{ crowded }, std::runtime_error);
}

TEST(TetraComplex, ReplacesOnlyWhatHasTheSameBorder)
{
  const TetraMesh mesh = AroundEdge(3, 0.3);
  TetraComplex complex(mesh);
  EXPECT_FALSE(complex.Replace({ 0, 1, 2 }, { { 2, 3, 4, 1 } }));
  EXPECT_FALSE(complex.Replace({ 0, 1 }, { { 2, 3, 4, 1 }, { 2, 4, 3, 0 } }));
  EXPECT_TRUE(SameBits(complex.Compacted(), mesh));
  EXPECT_TRUE(complex.Replace({ 0, 1, 2 }, { { 2, 3, 4, 1 }, { 2, 4, 3, 0 } }));
  ExpectSameBody(mesh, complex.Compacted());
}

TEST(TetraFlips, TakeOutAnEdge)
{
  for (const int sides : { 3, 4, 5, 6, 7 })
  {
    // A long edge between vertices that the polygon's triangulation serves better, and a short one that is better kept.
    const TetraMesh mesh = AroundEdge(sides, sides < 5 ? 2.0 : 1.0);
    TetraComplex complex(mesh);
    const bool taken = RemoveEdge(complex, 0, complex.CornerOf(0, 0), complex.CornerOf(0, 1));
    const TetraMesh after = complex.Compacted();
    ExpectSameBody(mesh, after);
    EXPECT_EQ(after.Corners.size(), taken ? std::size_t(2 * (sides - 2)) : std::size_t(sides));
    EXPECT_EQ(taken, Worst(after) > Worst(mesh));
    EXPECT_TRUE(taken || sides > 4) << sides;
    EXPECT_FALSE(RemoveEdge(complex, complex.Size() - 1, 0, 1)) << "an edge of the border, or one that is good";
  }
}

TEST(TetraFlips, TakeOutFaces)
{
  // All triangles of a polygon that is a fan from its first corner, between two vertices that are near each other.
  for (const int sides : { 3, 4, 5, 6 })
  {
    const double halfHeight = 0.35;
    std::vector<TetraCorners> corners;
    for (std::int32_t n = 1; n + 1 < sides; ++n)
    {
      corners.push_back({ 2, 2 + n, 3 + n, 0 });
      corners.push_back({ 2, 2 + n, 3 + n, 1 });
    }
    const TetraMesh mesh = MeshOf(Spindle(sides, halfHeight), corners, sides + 2);
    TetraComplex complex(mesh);
    // From the triangle that the edge will go through, or its neighbour.
    ASSERT_TRUE(RemoveFaces(complex, sides < 5 ? 0 : 2, complex.CornerOf(sides < 5 ? 0 : 2, 0))) << sides;
    const TetraMesh after = complex.Compacted();
    ExpectSameBody(mesh, after);
    EXPECT_EQ(after.Corners.size(), std::size_t(sides));
    EXPECT_GT(Worst(after), Worst(mesh));
  }
}

TEST(TetraFlips, ContractAndInsertAreInverse)
{
  // The centre of an octahedron, moved to near a corner, is taken out or moved back; put in it is the centre again.
  std::vector<Vec3> points = { Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1),
    Vec3(0, 0, -1), Vec3(0.05, 0.04, 0.9) };
  std::vector<TetraCorners> corners;
  for (const int x : { 0, 1 })
  {
    for (const int y : { 2, 3 })
    {
      for (const int z : { 4, 5 })
      {
        corners.push_back({ x, y, z, 6 });
      }
    }
  }
  const TetraMesh mesh = MeshOf(points, corners, 6);
  TetraComplex contracted(mesh);
  ASSERT_TRUE(Contract(contracted, 6, 4));
  EXPECT_FALSE(Contract(contracted, 0, 1)) << "vertices of the interface stay";
  const TetraMesh four = contracted.Compacted();
  ExpectSameBody(mesh, four);
  EXPECT_EQ(four.Corners.size(), 4u);
  EXPECT_EQ(four.Points.size(), 6u);

  TetraComplex moved(mesh);
  ASSERT_TRUE(RaiseWorstAt(moved, 6));
  ExpectSameBody(mesh, moved.Compacted());
  EXPECT_LT(moved.Point(6).norm(), 0.1);
  ASSERT_TRUE(InsertVertex(contracted, contracted.Size() - 1)) << "eighths of an octahedron are better than quarters";
  const TetraMesh eight = contracted.Compacted();
  ExpectSameBody(mesh, eight);
  EXPECT_EQ(eight.Corners.size(), 8u);
  EXPECT_LT(eight.Points.back().norm(), 0.1);
}

TEST(TetraImprovement, MakesWorstAndMeanBetterAndLeavesTheBody)
{
  const TetraMesh mesh = TwoMaterials(8, 0.45);
  TetraMesh improved = mesh;
  const TetraImproveResult result = ImproveTetrahedra(improved, {}, Monitor());
  ExpectSameBody(mesh, improved);
  EXPECT_LT(Worst(mesh), 0.05);
  EXPECT_GT(Worst(improved), 0.21);
  EXPECT_GT(MeanRatio(improved), MeanRatio(mesh) + 0.05);
  EXPECT_GT(result.Moves, 0);
  EXPECT_GT(result.Edges, 0);
}

TEST(TetraImprovement, PutsVerticesBetweenThoseOfTheInterface)
{
  const TetraMesh mesh = HollowBall(60);
  TetraMesh improved = mesh;
  const TetraImproveResult result = ImproveTetrahedra(improved, {}, Monitor());
  ExpectSameBody(mesh, improved);
  EXPECT_LT(Worst(mesh), 0.05);
  EXPECT_GT(Worst(improved), 0.21);
  EXPECT_GT(result.Insertions, 0);
}

TEST(TetraImprovement, HasTheSameBitsForAnyNumberOfThreads)
{
  TetraMesh one = TwoMaterials(14, 0.3), two = one;
  vtkSMPTools::Initialize(1);
  WithThreads([&] { ImproveTetrahedra(one, {}, Monitor()); });
  vtkSMPTools::Initialize(2);
  WithThreads([&] { ImproveTetrahedra(two, {}, Monitor()); });
  vtkSMPTools::Initialize();
  EXPECT_TRUE(SameBits(one, two));
}

TEST(TetraImprovement, LeavesWhatIsGoodAndWhatIsEmpty)
{
  TetraMesh empty;
  ImproveTetrahedra(empty, {}, Monitor());
  EXPECT_TRUE(empty.Corners.empty());
  const TetraMesh mesh = AroundEdge(5, 1.0);
  TetraMesh improved = mesh;
  ImproveTetrahedra(improved, {}, Monitor());
  EXPECT_TRUE(SameBits(mesh, improved));
}

TEST(TetraImprovement, StopsOnRequest)
{
  TetraMesh mesh = TwoMaterials(8, 0.45);
  EXPECT_THROW(
    ImproveTetrahedra(mesh, {}, Monitor([](double fraction, const std::string&) { return fraction > 0.3; })), Aborted);
}
