// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "ManifoldLabels.h"
#include "MeshCuts.h"
#include "MeshImprovement.h"
#include "Parallel.h"
#include "ParticleSystem.h"
#include "SelfIntersections.h"
#include "TetraLabeling.h"
#include "TriangleMending.h"
#include "VertexSmoothing.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <set>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(40, 40, 40);
const Vec3 Centre(19.7, 20.1, 19.9);
constexpr double Radius = 13.0;

SurfaceComplex Sampled(const SampledFields& fields, float h, int sweeps = 10)
{
  SampleOptions options;
  options.Sweeps = sweeps;
  const std::vector<Particle> particles = SampleCells(*fields, Grid<float>(Frame, h), options, Monitor()).Particles;
  return SurfaceComplex({ particles, BuildInterface(*fields, particles).Faces });
}

struct Quality
{
  double Worst = 1.0, Mean = 0.0;
};
Quality QualityOf(const SurfaceComplex& complex)
{
  Quality quality;
  Index count = 0;
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    if (complex.IsAlive(t))
    {
      quality.Worst = std::min(quality.Worst, complex.Ratio(t));
      quality.Mean += complex.Ratio(t);
      ++count;
    }
  }
  quality.Mean /= double(count);
  return quality;
}

Index EulerNumber(const SurfaceComplex& complex)
{
  std::set<std::pair<Index, Index>> edges;
  std::set<Index> vertices;
  const auto triangles = complex.AliveTriangles();
  for (const InterfaceTriangle& t : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      vertices.insert(t.Vertices[i]);
      edges.insert(std::minmax(t.Vertices[i], t.Vertices[(i + 1) % 3]));
    }
  }
  return Index(vertices.size()) - Index(edges.size()) + Index(triangles.size());
}

void ExpectSound(const SurfaceComplex& complex)
{
  const auto triangles = complex.AliveTriangles();
  EXPECT_TRUE(NonManifoldEdges(triangles).empty());
  EXPECT_TRUE(NonManifoldVertices(triangles).empty());
  for (const InterfaceTriangle& t : triangles)
  {
    EXPECT_FALSE(IsWrong(complex.AllVertices(), t));
  }
}

/// A flat hexagon of six triangles around vertex 0, between the materials 0 and 1, and an apex above and below that
/// closes it.
SurfaceComplex Hexagon()
{
  InterfaceMesh mesh;
  const auto add = [&](const Vec3& x)
  {
    Particle p;
    p.Position = x;
    p.Normal = Vec3(0, 0, 1);
    p.TargetLength = 1.0;
    p.Materials.Insert(0);
    p.Materials.Insert(1);
    mesh.Vertices.push_back(p);
  };
  add(Vec3(0.2, 0.1, 0));
  for (int n = 0; n < 6; ++n)
  {
    add(Vec3(std::cos(n * M_PI / 3), std::sin(n * M_PI / 3), 0));
  }
  add(Vec3(0, 0, -2));
  for (Index n = 0; n < 6; ++n)
  {
    const Index a = 1 + n, b = 1 + (n + 1) % 6;
    mesh.Triangles.push_back({ { 0, a, b }, { 1, 0 } });
    mesh.Triangles.push_back({ { 7, b, a }, { 1, 0 } });
  }
  return SurfaceComplex(std::move(mesh));
}

std::vector<std::array<Index, 3>> Corners(const SurfaceComplex& complex)
{
  std::vector<std::array<Index, 3>> corners;
  for (const InterfaceTriangle& t : complex.AliveTriangles())
  {
    corners.push_back(t.Vertices);
  }
  return corners;
}
}

TEST(SurfaceComplex, FlipsAnEdgeOnceAndBack)
{
  SurfaceComplex complex = Hexagon();
  const Index euler = EulerNumber(complex);
  ASSERT_TRUE(complex.AreJoined(0, 2));
  EXPECT_TRUE(complex.Flip(0, 2));
  EXPECT_FALSE(complex.AreJoined(0, 2));
  EXPECT_TRUE(complex.AreJoined(1, 3));
  EXPECT_EQ(EulerNumber(complex), euler);
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    const double up = complex.UnitNormal(t)[2];
    const auto& v = complex.Triangle(t).Vertices;
    EXPECT_EQ(up > 0, std::find(v.begin(), v.end(), 7) == v.end()) << "triangles face where they did";
  }
  EXPECT_TRUE(complex.Flip(1, 3));
  EXPECT_TRUE(complex.AreJoined(0, 2));
}

TEST(SurfaceComplex, DoesNotFlipWhereTheNewEdgeIsThere)
{
  // A tetrahedron: all vertices are joined.
  InterfaceMesh mesh;
  mesh.Vertices.resize(4);
  for (const auto& corners : { std::array<Index, 3>{ 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } })
  {
    mesh.Triangles.push_back({ corners, { 1, 0 } });
  }
  SurfaceComplex complex(std::move(mesh));
  EXPECT_FALSE(complex.Flip(0, 1));
  EXPECT_FALSE(complex.Collapse(0, 1)) << "two triangles would lie on each other";
}

TEST(SurfaceComplex, CollapsesAndSplitsKeepTheEulerNumber)
{
  SurfaceComplex complex = Hexagon();
  const Index euler = EulerNumber(complex);
  ASSERT_TRUE(complex.Split(0, 3, complex.Vertex(0)));
  EXPECT_EQ(EulerNumber(complex), euler);
  EXPECT_EQ(complex.AliveTriangles().size(), 14u);
  EXPECT_TRUE(complex.Collapse(8, 0));
  EXPECT_EQ(EulerNumber(complex), euler);
  EXPECT_EQ(complex.AliveTriangles().size(), 12u);
  EXPECT_TRUE(complex.Collapse(0, 1));
  EXPECT_EQ(EulerNumber(complex), euler);
  EXPECT_EQ(complex.AliveTriangles().size(), 10u);
  EXPECT_TRUE(complex.Star(0).empty());
  ExpectSound(complex);
}

TEST(SurfaceComplex, TakesBackWhatWasRecorded)
{
  SurfaceComplex complex = Hexagon();
  const auto before = Corners(complex);
  complex.Begin();
  Particle moved = complex.Vertex(0);
  moved.Position = Vec3(0.5, 0, 0);
  complex.SetVertex(0, moved);
  ASSERT_TRUE(complex.Split(0, 3, moved));
  ASSERT_TRUE(complex.Flip(0, 2));
  ASSERT_TRUE(complex.Collapse(0, 1));
  complex.Rollback();
  EXPECT_EQ(Corners(complex), before);
  EXPECT_EQ(complex.NumberOfVertices(), 8);
  EXPECT_EQ(complex.Vertex(0).Position, Vec3(0.2, 0.1, 0));
  for (Index v = 0; v < 8; ++v)
  {
    for (const std::int32_t t : complex.Star(v))
    {
      const auto& corners = complex.Triangle(t).Vertices;
      EXPECT_NE(std::find(corners.begin(), corners.end(), v), corners.end());
    }
    EXPECT_EQ(complex.Star(v).size(), v == 0 || v == 7 ? 6u : 4u);
  }
}

TEST(SurfaceComplex, FrozenVerticesTakePartInNoEdit)
{
  SurfaceComplex complex = Hexagon();
  complex.Freeze(2);
  EXPECT_FALSE(complex.Flip(0, 2));
  EXPECT_FALSE(complex.Flip(0, 3)) << "vertex 2 is opposite";
  EXPECT_FALSE(complex.Collapse(2, 1));
  EXPECT_FALSE(complex.Split(2, 3, complex.Vertex(2)));
  EXPECT_TRUE(complex.Flip(0, 5));
}

TEST(SurfaceComplex, CurvesCollapseAlongThemselvesAlone)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  const SurfaceComplex sampled = Sampled(fields, 3.0f);
  const Index euler = EulerNumber(sampled);
  Index alongCurve = 0, acrossSurface = 0;
  for (Index v = 0; v < sampled.NumberOfVertices(); ++v)
  {
    if (sampled.Vertex(v).CellDimension != 1)
    {
      continue;
    }
    for (const Index other : sampled.Neighbors(v))
    {
      SurfaceComplex complex = sampled;
      const bool onCurve = sampled.EdgeStar(v, other).size() == 3;
      const bool joined = complex.Collapse(v, other);
      EXPECT_TRUE(!joined || onCurve) << "a vertex does not leave its curve";
      alongCurve += joined;
      acrossSurface += !onCurve;
      if (joined)
      {
        EXPECT_EQ(EulerNumber(complex), euler);
        ExpectSound(complex);
      }
    }
  }
  EXPECT_GT(alongCurve, 20);
  EXPECT_GT(acrossSurface, 20);
}

TEST(VertexSmoothing, IndependentSetsShareNoTriangle)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  const SurfaceComplex complex = Sampled(fields, 2.0f);
  std::vector<int> set(std::size_t(complex.NumberOfVertices()), -1);
  const auto sets = IndependentSets(complex);
  for (std::size_t n = 0; n < sets.size(); ++n)
  {
    EXPECT_TRUE(std::is_sorted(sets[n].begin(), sets[n].end()));
    for (const Index v : sets[n])
    {
      EXPECT_EQ(set[v], -1) << "each vertex once";
      set[v] = int(n);
    }
  }
  for (const InterfaceTriangle& t : complex.AliveTriangles())
  {
    for (int i = 0; i < 3; ++i)
    {
      const int a = set[t.Vertices[i]], b = set[t.Vertices[(i + 1) % 3]];
      EXPECT_GE(a, 0);
      EXPECT_NE(a, b);
    }
  }
}

TEST(VertexSmoothing, LowersTheCostAndKeepsVerticesOnTheirCells)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  SurfaceComplex complex = Sampled(fields, 2.0f);
  Index moves = 0;
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    const auto cost = [&]()
    {
      double sum = 0;
      for (const std::int32_t t : complex.Star(v))
      {
        sum += TriangleCost(complex.Ratio(t));
      }
      return sum;
    };
    const double before = cost();
    const Particle was = complex.Vertex(v);
    const bool moved = SmoothVertex(*fields, complex, v) > 0.0;
    EXPECT_EQ(moved, cost() < before);
    EXPECT_EQ(moved, was.Position != complex.Vertex(v).Position);
    moves += moved;
    const Particle& p = complex.Vertex(v);
    for (int m = 1; m < p.Materials.Size(); ++m)
    {
      const double gap = fields->Value(p.Materials[0], p.Position) - fields->Value(p.Materials[m], p.Position);
      EXPECT_NEAR(gap, 0.0, 0.01) << "on the junction of its materials";
    }
  }
  EXPECT_GT(moves, 300);
}

TEST(MeshImprovement, BetterTrianglesOfTheSameShape)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  SurfaceComplex complex = Sampled(fields, 2.0f);
  const Quality before = QualityOf(complex);
  const Index euler = EulerNumber(complex);
  const ImproveResult result = ImproveMesh(*fields, complex, ImproveOptions(), Monitor());
  const Quality after = QualityOf(complex);
  EXPECT_GT(result.Moves, 0);
  EXPECT_GT(after.Mean, before.Mean + 0.01);
  EXPECT_GT(after.Mean, 0.96);
  EXPECT_GE(after.Worst, 0.5);
  EXPECT_EQ(EulerNumber(complex), euler);
  ExpectSound(complex);
  std::vector<Vec3> points;
  for (const Particle& p : complex.AllVertices())
  {
    points.push_back(p.Position);
  }
  EXPECT_TRUE(FindSelfIntersections(points, Corners(complex)).Pairs.empty());
}

TEST(MeshImprovement, LeavesFrozenVerticesWhereTheyAre)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  SurfaceComplex complex = Sampled(fields, 2.0f);
  const std::vector<Particle> before = complex.AllVertices();
  for (Index v = 0; v < complex.NumberOfVertices(); v += 3)
  {
    complex.Freeze(v);
  }
  ImproveMesh(*fields, complex, ImproveOptions(), Monitor());
  for (Index v = 0; v < Index(before.size()); v += 3)
  {
    EXPECT_EQ(complex.Vertex(v).Position, before[v].Position);
    EXPECT_FALSE(complex.Star(v).empty());
  }
}

TEST(TriangleMending, JoinsTwoVerticesThatAreTooClose)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  std::vector<Particle> particles = Sampled(fields, 2.0f, 20).AllVertices();
  Particle extra = particles.back();
  const Vec3 aside = extra.Normal.unitOrthogonal();
  extra.Position = Centre + Radius * (extra.Position + 0.1 * aside - Centre).normalized();
  ASSERT_EQ(extra.Materials[0], 0) << "on the ball";
  particles.push_back(extra);
  SurfaceComplex complex({ particles, BuildInterface(*fields, particles).Faces });
  ASSERT_LT(QualityOf(complex).Worst, 0.2);
  const Index euler = EulerNumber(complex);
  EXPECT_THROW(MendTriangles(*fields, complex, 0.5, Monitor([](double, const std::string&) { return true; })), Aborted);
  EXPECT_EQ(EulerNumber(complex), euler);
  const MendResult result = MendTriangles(*fields, complex, 0.5);
  EXPECT_GT(result.Mended, 0);
  EXPECT_EQ(result.Left, 0);
  EXPECT_GE(QualityOf(complex).Worst, 0.5);
  EXPECT_EQ(EulerNumber(complex), euler);
  ExpectSound(complex);
}

namespace
{
/// A ball's mesh, and the same with a vertex pulled through the far side and another, at a right angle to it, moved a
/// little.
struct CutBall
{
  SampledFields Fields{ Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) } };
  SurfaceComplex Before = Sampled(Fields, 2.5f);
  SurfaceComplex Improved = Before;
  Index Pulled = 0, Moved = 0;

  CutBall()
  {
    const Vec3 radius = this->Before.Vertex(this->Pulled).Position - Centre;
    this->Moved = this->Nearest(radius.unitOrthogonal());
    this->Move(this->Moved, this->Before.Vertex(this->Moved).Position + Vec3(0.01, 0, 0));
    this->Move(this->Pulled, Centre - 1.3 * radius);
  }

  void Move(Index v, const Vec3& x)
  {
    Particle moved = this->Improved.Vertex(v);
    moved.Position = x;
    this->Improved.SetVertex(v, moved);
  }
  Index Nearest(const Vec3& direction) const
  {
    Index nearest = 0;
    const Vec3 x = Centre + Radius * direction;
    for (Index v = 0; v < this->Before.NumberOfVertices(); ++v)
    {
      nearest =
        (this->Before.Vertex(v).Position - x).norm() < (this->Before.Vertex(nearest).Position - x).norm() ? v : nearest;
    }
    return nearest;
  }
};

std::set<std::array<Index, 3>> SortedTriangles(const SurfaceComplex& complex)
{
  std::set<std::array<Index, 3>> triangles;
  for (InterfaceTriangle t : complex.AliveTriangles())
  {
    std::sort(t.Vertices.begin(), t.Vertices.end());
    triangles.insert(t.Vertices);
  }
  return triangles;
}
}

TEST(MeshCuts, FindsTheVerticesOfTrianglesThatCut)
{
  const CutBall ball;
  EXPECT_TRUE(FindCuts(ball.Before).empty());
  const std::vector<Cut> cuts = FindCuts(ball.Improved);
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_EQ(cuts[0], VerticesOf(cuts));
  EXPECT_TRUE(std::binary_search(cuts[0].begin(), cuts[0].end(), ball.Pulled));
  EXPECT_FALSE(std::binary_search(cuts[0].begin(), cuts[0].end(), ball.Moved));
  EXPECT_EQ(FindCuts(ball.Improved, { ball.Pulled }), cuts);
  EXPECT_TRUE(FindCuts(ball.Improved, { ball.Moved }).empty());
}

TEST(MeshCuts, PutsBackWhatIsAroundThemAndNothingElse)
{
  CutBall ball;
  // The edit that is put back may have changed triangles, too.
  const Index neighbor = ball.Improved.Neighbors(ball.Pulled).front();
  ASSERT_TRUE(ball.Improved.Flip(ball.Pulled, neighbor));
  ASSERT_TRUE(PutBack(ball.Before, FindCuts(ball.Improved), 0.5, ball.Improved));
  EXPECT_TRUE(FindCuts(ball.Improved).empty());
  EXPECT_EQ(ball.Improved.Vertex(ball.Pulled).Position, ball.Before.Vertex(ball.Pulled).Position);
  EXPECT_NE(ball.Improved.Vertex(ball.Moved).Position, ball.Before.Vertex(ball.Moved).Position);
  EXPECT_EQ(SortedTriangles(ball.Improved), SortedTriangles(ball.Before));
  EXPECT_EQ(EulerNumber(ball.Improved), 2);
}

TEST(MeshCuts, GoesFartherWhereWhatWasThereDoesNotFit)
{
  // An edge of the rim flipped: the old triangles have no edge to end at.
  CutBall flipped;
  const std::vector<Cut> cuts = FindCuts(flipped.Improved);
  const std::vector<Index> vertices = VerticesOf(cuts);
  std::set<Index> core(vertices.begin(), vertices.end());
  for (const Index v : vertices)
  {
    const std::vector<Index> around = flipped.Before.Neighbors(v);
    core.insert(around.begin(), around.end());
  }
  const auto isOutside = [&core](Index v) { return core.count(v) == 0; };
  bool done = false;
  for (const std::int32_t t : flipped.Improved.TrianglesAt({ core.begin(), core.end() }))
  {
    const auto v = flipped.Improved.Triangle(t).Vertices;
    for (int c = 0; c < 3 && !done; ++c)
    {
      done = isOutside(v[c]) && isOutside(v[(c + 1) % 3]) && flipped.Improved.Flip(v[c], v[(c + 1) % 3]);
    }
  }
  ASSERT_TRUE(done);
  EXPECT_TRUE(PutBack(flipped.Before, cuts, 0.5, flipped.Improved));
  EXPECT_TRUE(FindCuts(flipped.Improved).empty());
  EXPECT_EQ(SortedTriangles(flipped.Improved), SortedTriangles(flipped.Before));
  EXPECT_NE(flipped.Improved.Vertex(flipped.Moved).Position, flipped.Before.Vertex(flipped.Moved).Position);
}

TEST(MeshCuts, SaysWhereItCannotBeDone)
{
  // What was there before cuts itself.
  const CutBall before;
  CutBall ball;
  EXPECT_FALSE(PutBack(before.Improved, FindCuts(ball.Improved), 0.5, ball.Improved));
}
