// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "LocalRepair.h"
#include "ManifoldLabels.h"
#include "MeshInterfaces.h"
#include "Parallel.h"
#include "ParticleSystem.h"
#include "TetraLabeling.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <algorithm>
#include <map>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(48, 48, 48);
const Vec3 Centre(24.2, 23.9, 24.1);

/// Four Voronoi cells in a ball: six interfaces between them, four with the outside, one 0-cell inside and four
/// outside.
SampledFields FourCellsInABall()
{
  std::vector<Field> fields{ [](const Vec3& x) { return (x - Centre).norm() - 36.0; } };
  for (const Vec3& offset : { Vec3(9, 9, 9), Vec3(9, -9, -9), Vec3(-9, 9, -9), Vec3(-9, -9, 9) })
  {
    fields.push_back(Site(Centre + offset));
  }
  return SampledFields(Frame, fields);
}

std::map<MaterialId, double> Volumes(const InterfaceMesh& mesh)
{
  std::map<MaterialId, double> volumes;
  for (const InterfaceTriangle& t : mesh.Triangles)
  {
    const double signedVolume = mesh.Vertices[t.Vertices[0]].Position.dot(
                                  mesh.Vertices[t.Vertices[1]].Position.cross(mesh.Vertices[t.Vertices[2]].Position)) /
      6.0;
    volumes[t.Materials[0]] += signedVolume;
    volumes[t.Materials[1]] -= signedVolume;
  }
  return volumes;
}

MeshResult Mesh(const SampledFields& fields, float h, const MeshOptions& options = MeshOptions())
{
  const SampleResult samples = SampleCells(*fields, Grid<float>(Frame, h), SampleOptions(), Monitor());
  return MeshInterfaces(*fields, samples.Particles, options, Monitor());
}
}

TEST(Delaunay, OfARegularGridIsDelaunay)
{
  std::vector<Vec3> points;
  for (int n = 0; n < 125; ++n)
  {
    points.emplace_back(
      n % 5 + 0.01 * std::sin(12.9 * n), n / 5 % 5 + 0.01 * std::sin(78.2 * n), n / 25 + 0.01 * std::sin(3.7 * n));
  }
  const Tetrahedralization t = DelaunayTetrahedra(points);
  ASSERT_GT(t.Size(), 300);
  for (Index n = 0; n < t.Size(); ++n)
  {
    const auto& c = t.Corners[n];
    const Vec3 centre = Circumcentre(points[c[0]], points[c[1]], points[c[2]], points[c[3]]);
    const double radius = (points[c[0]] - centre).norm();
    for (const Vec3& p : points)
    {
      EXPECT_GT((p - centre).norm(), radius * (1 - 1e-9));
    }
    for (int j = 0; j < 4; ++j)
    {
      const auto neighbor = t.Neighbors[n][j];
      if (neighbor >= 0)
      {
        // All corners but j are the neighbour's too.
        for (int k = 0; k < 4; ++k)
        {
          const auto& other = t.Corners[neighbor];
          EXPECT_EQ(std::find(other.begin(), other.end(), c[k]) != other.end(), k != j);
        }
      }
    }
  }
}

TEST(Delaunay, OfTooFewOrFlatPointsIsEmpty)
{
  EXPECT_EQ(DelaunayTetrahedra({}).Size(), 0);
  EXPECT_EQ(DelaunayTetrahedra({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0) }).Size(), 0);
  EXPECT_EQ(
    DelaunayTetrahedra({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(3, 1, 0) }).Size(), 0);
  EXPECT_EQ(DelaunayTetrahedra({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 1) }).Size(), 1);
}

namespace
{
/// The corners of each tetrahedron as positions, in an order that does not depend on that of the points.
std::vector<std::array<std::array<double, 3>, 4>> Sorted(const std::vector<Vec3>& points, const Tetrahedralization& t)
{
  std::vector<std::array<std::array<double, 3>, 4>> tetrahedra(t.Corners.size());
  for (std::size_t n = 0; n < tetrahedra.size(); ++n)
  {
    for (int c = 0; c < 4; ++c)
    {
      const Vec3& x = points[t.Corners[n][c]];
      tetrahedra[n][c] = { x[0], x[1], x[2] };
    }
    std::sort(tetrahedra[n].begin(), tetrahedra[n].end());
  }
  std::sort(tetrahedra.begin(), tetrahedra.end());
  return tetrahedra;
}

std::vector<Vec3> LatticePoints(int side)
{
  std::vector<Vec3> points;
  for (int n = 0; n < side * side * side; ++n)
  {
    points.emplace_back(n % side, n / side % side, n / (side * side));
  }
  return points;
}
}

TEST(Delaunay, OfALatticeDependsOnThePointsAloneAndHasNoFlatTetrahedra)
{
  // Eight points on each of 125 spheres, and 36 in each plane.
  std::vector<Vec3> points = LatticePoints(6);
  const Tetrahedralization t = DelaunayTetrahedra(points);
  double volume = 0.0;
  for (const auto& c : t.Corners)
  {
    const Vec3& x = points[c[0]];
    const double six = std::abs((points[c[1]] - x).cross(points[c[2]] - x).dot(points[c[3]] - x));
    EXPECT_GE(six, 1.0);
    volume += six / 6.0;
  }
  EXPECT_NEAR(volume, 125.0, 1e-9);
  const auto expected = Sorted(points, t);
  std::reverse(points.begin(), points.end());
  std::swap(points[10], points[100]);
  EXPECT_EQ(Sorted(points, DelaunayTetrahedra(points)), expected);
}

TEST(Delaunay, UsesOneOfPointsThatCoincide)
{
  std::vector<Vec3> points = LatticePoints(3);
  const auto expected = Sorted(points, DelaunayTetrahedra(points));
  points.insert(points.end(), { points[0], points[13], points[13] });
  EXPECT_EQ(Sorted(points, DelaunayTetrahedra(points)), expected);
}

TEST(Delaunay, StopsWhenItsMonitorSaysSo)
{
  const std::vector<Vec3> points = LatticePoints(24);
  int calls = 0;
  EXPECT_THROW(DelaunayTetrahedra(points, Monitor([&](double, const std::string&) { return ++calls == 3; })), Aborted);
  EXPECT_EQ(calls, 3);
}

TEST(Delaunay, MayBeAskedForByManyThreads)
{
  const std::vector<Vec3> points = LatticePoints(8);
  const Tetrahedralization expected = DelaunayTetrahedra(points);
  std::vector<Tetrahedralization> found(16);
  vtkSMPTools::LocalScope(vtkSMPTools::Config(4, "STDThread", false),
    [&]
    {
      ParallelFor(0, Index(found.size()), 1,
        [&](Index first, Index last)
        {
          for (Index n = first; n < last; ++n)
          {
            found[n] = DelaunayTetrahedra(points);
          }
        });
    });
  for (const Tetrahedralization& t : found)
  {
    EXPECT_EQ(t.Corners, expected.Corners);
    EXPECT_EQ(t.Neighbors, expected.Neighbors);
  }
}

TEST(TetraLabeling, CircumcentreIsEquidistant)
{
  const Vec3 a(0.1, 0.2, 0.3), b(2, 0, 1), c(0, 3, 0.5), d(1, 1, 4);
  const Vec3 x = Circumcentre(a, b, c, d);
  for (const Vec3& p : { b, c, d })
  {
    EXPECT_NEAR((p - x).norm(), (a - x).norm(), 1e-12);
  }
}

TEST(TetraLabeling, AFacePairMustBeInAllVertexSets)
{
  std::vector<Particle> particles(3);
  for (Particle& p : particles)
  {
    p.Materials.Insert(1);
    p.Materials.Insert(2);
  }
  InterfaceTriangle face;
  face.Vertices = { 0, 1, 2 };
  face.Materials = { 2, 1 };
  EXPECT_FALSE(IsWrong(particles, face));
  face.Materials = { 2, 3 };
  EXPECT_TRUE(IsWrong(particles, face));
}

TEST(ManifoldLabels, FindsTheEdgeThatTwoSheetsShare)
{
  // Two tetrahedron surfaces of material 1 that share one edge: four faces of material 1 meet there.
  const auto face = [](Index a, Index b, Index c)
  {
    InterfaceTriangle t;
    t.Vertices = { a, b, c };
    t.Materials = { 1, 0 };
    return t;
  };
  std::vector<InterfaceTriangle> faces{ face(0, 1, 2), face(0, 2, 3), face(0, 3, 1), face(1, 3, 2) };
  EXPECT_TRUE(NonManifoldEdges(faces).empty());
  for (const auto& t : { face(0, 1, 4), face(0, 4, 5), face(0, 5, 1), face(1, 5, 4) })
  {
    faces.push_back(t);
  }
  EXPECT_EQ(NonManifoldEdges(faces), (std::vector<Edge>{ { 0, 1 } }));
  EXPECT_TRUE(NonManifoldVertices(faces).empty()) << "at both ends the sheets are joined by the edge";
}

TEST(ManifoldLabels, FindsTheVertexWhereTwoSheetsTouch)
{
  std::vector<InterfaceTriangle> faces;
  const auto tetrahedron = [&](Index a, Index b, Index c, Index d)
  {
    for (const auto& v : { std::array<Index, 3>{ a, b, c }, { a, c, d }, { a, d, b }, { b, d, c } })
    {
      faces.push_back({ v, { 1, 0 } });
    }
  };
  tetrahedron(0, 1, 2, 3);
  EXPECT_TRUE(NonManifoldVertices(faces).empty());
  tetrahedron(0, 4, 5, 6);
  EXPECT_TRUE(NonManifoldEdges(faces).empty());
  EXPECT_EQ(NonManifoldVertices(faces), (std::vector<Index>{ 0 }));
}

TEST(MeshInterfaces, ABallIsAClosedSphereOfItsVolume)
{
  const SampledFields fields(Frame, { Not(Ball(Centre, 15)), Ball(Centre, 15) });
  for (const float h : { 3.0f, 1.5f })
  {
    const MeshResult result = Mesh(fields, h);
    EXPECT_EQ(result.WrongFaces + result.NonManifoldEdges + result.BadTriangles, 0);
    EXPECT_EQ(Index(result.Mesh.Triangles.size()), 2 * Index(result.Mesh.Vertices.size()) - 4); // genus 0
    const double volume = 4.0 / 3.0 * M_PI * 15 * 15 * 15;
    // A triangle of edge h cuts h^2 / (8 R) or so off: second order.
    EXPECT_NEAR(Volumes(result.Mesh)[1], volume, volume * 0.3 * h * h / (15 * 15) + 0.002 * volume);
    for (const InterfaceTriangle& t : result.Mesh.Triangles)
    {
      const auto& v = result.Mesh.Vertices;
      const Vec3 &a = v[t.Vertices[0]].Position, &b = v[t.Vertices[1]].Position, &c = v[t.Vertices[2]].Position;
      const double outwards = (b - a).cross(c - a).dot(a - Centre);
      EXPECT_EQ(outwards > 0, t.Materials[0] == 1) << "the normal points from the first material to the second";
    }
  }
}

TEST(MeshInterfaces, JunctionsOfFourMaterialsConform)
{
  const SampledFields fields = FourCellsInABall();
  const MeshResult result = Mesh(fields, 2.0f);
  EXPECT_EQ(result.WrongFaces, 0);
  EXPECT_EQ(result.NonManifoldEdges, 0);
  EXPECT_EQ(result.EmptySets, 0);
  EXPECT_GT(result.WorstRatio, 0.45);
  Index zeroCells = 0;
  for (const Particle& p : result.Mesh.Vertices)
  {
    zeroCells += p.CellDimension == 0;
  }
  EXPECT_EQ(zeroCells, 5);
  // The four are alike, and all volumes add up to none.
  auto volumes = Volumes(result.Mesh);
  double sum = 0;
  for (const auto& [m, volume] : volumes)
  {
    sum += volume;
    if (m > 0)
    {
      EXPECT_NEAR(volume, -volumes[0] / 4, -volumes[0] * 0.01);
    }
  }
  EXPECT_NEAR(sum, 0.0, 1e-6);
}

namespace
{
/// A ball of radius 15 whose particle 100 has another close by, the last one: their triangles are slivers.
struct BallWithASliver
{
  SampledFields Fields{ Frame, { Not(Ball(Centre, 15)), Ball(Centre, 15) } };
  std::vector<Particle> Particles =
    SampleCells(*Fields, Grid<float>(Frame, 2.0f), SampleOptions(), Monitor()).Particles;

  BallWithASliver()
  {
    Particle extra = this->Particles[100];
    extra.Position = Centre + 15.0 * (extra.Position + Vec3(0.06, 0.04, -0.02) - Centre).normalized();
    this->Particles.push_back(extra);
  }
};
}

TEST(LocalRepair, MendsASliverAndNothingElse)
{
  const BallWithASliver ball;
  const std::vector<Particle>& particles = ball.Particles;
  SurfaceComplex complex({ particles, BuildInterface(*ball.Fields, particles).Faces });
  const std::vector<Fault> faults = FindFaults(complex);
  ASSERT_FALSE(faults.empty());
  LocalRepair repair(*ball.Fields, complex, 0.5);
  EXPECT_TRUE(repair.Mend(faults.front()));
  EXPECT_TRUE(FindFaults(complex).empty());
  const InterfaceMesh mended = SurfaceComplex(complex).Compacted();
  EXPECT_EQ(Index(mended.Triangles.size()), 2 * Index(mended.Vertices.size()) - 4) << "still a sphere";
  Index moved = 0;
  for (const Particle& p : mended.Vertices)
  {
    moved +=
      std::none_of(particles.begin(), particles.end(), [&p](const Particle& q) { return p.Position == q.Position; });
  }
  EXPECT_LT(moved, 40);
}

TEST(LocalRepair, RefusesAPatchWhoseFacesAreNotThoseOfTheMesh)
{
  const BallWithASliver ball;
  const std::vector<Particle>& particles = ball.Particles;
  SurfaceComplex complex({ particles, BuildInterface(*ball.Fields, particles).Faces });
  const std::vector<Fault> faults = FindFaults(complex);
  ASSERT_FALSE(faults.empty());
  // A flip beside the sliver: what the tetrahedra around say is no longer what the mesh has.
  bool flipped = false;
  for (const Index v : complex.Neighbors(100))
  {
    flipped = flipped || (v != Index(particles.size()) - 1 && complex.Flip(100, v));
  }
  ASSERT_TRUE(flipped);
  const std::vector<InterfaceTriangle> before = complex.AliveTriangles();
  LocalRepair repair(*ball.Fields, complex, 0.5);
  EXPECT_FALSE(repair.Mend(faults.front()));
  const std::vector<InterfaceTriangle> after = complex.AliveTriangles();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t t = 0; t < before.size(); ++t)
  {
    EXPECT_EQ(before[t].Vertices, after[t].Vertices);
  }
}

TEST(LocalRepair, SeesTheSurroundingsOfASiteWhereLengthsGrowFast)
{
  // A thin tip's sizing: shortest at one point of the ball, growing by 0.4 per length from there.
  const SampledFields fields(Frame, { Not(Ball(Centre, 15)), Ball(Centre, 15) });
  const Vec3 tip = Centre + Vec3(0, 0, 15);
  Grid<float> targetLength(Frame);
  for (Index at = 0; at < Frame.Size(); ++at)
  {
    const auto c = Frame.Coordinates(at);
    targetLength.Values[at] = float(0.25 + 0.4 * (Frame.Position(c[0], c[1], c[2]) - tip).norm());
  }
  SampleResult samples = SampleCells(*fields, targetLength, SampleOptions(), Monitor());
  std::size_t finest = 0;
  for (std::size_t n = 0; n < samples.Particles.size(); ++n)
  {
    finest = samples.Particles[n].TargetLength < samples.Particles[finest].TargetLength ? n : finest;
  }
  Particle extra = samples.Particles[finest];
  extra.Position = Centre + 15.0 * (extra.Position + Vec3(0.03, 0.02, 0) - Centre).normalized();
  samples.Particles.push_back(extra);
  const MeshResult mended = MeshInterfaces(*fields, samples.Particles, MeshOptions(), Monitor());
  EXPECT_EQ(mended.BadTriangles, 0);
  EXPECT_EQ(mended.WrongFaces + mended.NonManifoldEdges, 0);
}

TEST(MeshInterfaces, NoParticlesGiveNoMesh)
{
  const SampledFields fields(Frame, { [](const Vec3&) { return 1.0; }, [](const Vec3&) { return -1.0; } });
  const MeshResult result = MeshInterfaces(*fields, {}, MeshOptions(), Monitor());
  EXPECT_TRUE(result.Mesh.Triangles.empty());
  EXPECT_TRUE(result.Mesh.Vertices.empty());
}
