// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"
#include "ExactPredicates.h"
#include "Parallel.h"
#include "SelfIntersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace LabelMesh;

namespace
{
using Int = __int128;
using IntVector = std::array<Int, 3>;
using Pairs = std::vector<std::array<Index, 2>>;

IntVector operator-(const IntVector& a, const IntVector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
IntVector Cross(const IntVector& a, const IntVector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
Int Dot(const IntVector& a, const IntVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
int SignOf(Int value)
{
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}
/// Scaled by 2^bits, where the coordinates must be integers.
IntVector Integer(const Vec3& x, int bits = 0)
{
  IntVector result{};
  for (int i = 0; i < 3; ++i)
  {
    result[i] = Int(std::ldexp(x[i], bits));
  }
  return result;
}
int IntOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int bits = 0)
{
  const IntVector p = Integer(a, bits);
  return SignOf(Dot(Cross(Integer(b, bits) - p, Integer(c, bits) - p), Integer(d, bits) - p));
}

/// A point with a common denominator: Numerator / Denominator, Denominator > 0.
struct Rational
{
  IntVector Numerator;
  Int Denominator = 1;
};

bool Same(const Rational& a, const IntVector& b)
{
  return a.Numerator[0] == b[0] * a.Denominator && a.Numerator[1] == b[1] * a.Denominator &&
    a.Numerator[2] == b[2] * a.Denominator;
}

/// Independent of the code under test: whether a point in the plane of a triangle lies in it.
bool Inside(const std::array<IntVector, 3>& t, const Rational& x)
{
  const IntVector normal = Cross(t[1] - t[0], t[2] - t[0]);
  for (int i = 0; i < 3; ++i)
  {
    const IntVector edge = t[(i + 1) % 3] - t[i];
    const IntVector toX{ x.Numerator[0] - t[i][0] * x.Denominator, x.Numerator[1] - t[i][1] * x.Denominator,
      x.Numerator[2] - t[i][2] * x.Denominator };
    if (Dot(Cross(edge, toX), normal) < 0)
    {
      return false;
    }
  }
  return true;
}

/// All points that matter of what two triangles share: corners in the other triangle, edges through the other's plane,
/// and crossings of edges of triangles in one plane. Any intersection beyond common vertices contains one of these
/// that is no common vertex.
std::vector<Rational> SharedPoints(const std::array<IntVector, 3>& a, const std::array<IntVector, 3>& b)
{
  std::vector<Rational> points;
  for (const auto& order : { std::make_pair(a, b), std::make_pair(b, a) })
  {
    const auto &s = order.first, &t = order.second;
    const IntVector normal = Cross(t[1] - t[0], t[2] - t[0]);
    for (int i = 0; i < 3; ++i)
    {
      const IntVector &p = s[i], &q = s[(i + 1) % 3];
      const Int atP = Dot(normal, p - t[0]), atQ = Dot(normal, q - t[0]);
      if (atP == 0 && Inside(t, { p, 1 }))
      {
        points.push_back({ p, 1 });
      }
      if (SignOf(atP) * SignOf(atQ) < 0)
      {
        // p + (q - p) atP / (atP - atQ)
        Rational x{ {}, atP - atQ };
        for (int k = 0; k < 3; ++k)
        {
          x.Numerator[k] = p[k] * (atP - atQ) + (q[k] - p[k]) * atP;
        }
        if (x.Denominator < 0)
        {
          x = { { -x.Numerator[0], -x.Numerator[1], -x.Numerator[2] }, -x.Denominator };
        }
        if (Inside(t, x))
        {
          points.push_back(x);
        }
      }
      for (int j = 0; j < 3 && atP == 0 && atQ == 0; ++j)
      {
        const IntVector &u = t[j], &v = t[(j + 1) % 3];
        const IntVector cross = Cross(q - p, v - u);
        const Int square = Dot(cross, cross);
        if (square != 0)
        {
          // p + (q - p) s and u + (v - u) r
          const Int sTimes = Dot(Cross(u - p, v - u), cross), rTimes = Dot(Cross(u - p, q - p), cross);
          if (sTimes >= 0 && sTimes <= square && rTimes >= 0 && rTimes <= square)
          {
            Rational x{ {}, square };
            for (int k = 0; k < 3; ++k)
            {
              x.Numerator[k] = p[k] * square + (q[k] - p[k]) * sTimes;
            }
            points.push_back(x);
          }
        }
      }
    }
  }
  return points;
}

bool BruteForceIntersect(const std::vector<Vec3>& points, const TriangleCorners& a, const TriangleCorners& b)
{
  std::array<IntVector, 3> s, t;
  std::vector<Index> common;
  for (int i = 0; i < 3; ++i)
  {
    s[i] = Integer(points[a[i]]);
    t[i] = Integer(points[b[i]]);
    if (std::find(b.begin(), b.end(), a[i]) != b.end())
    {
      common.push_back(a[i]);
    }
  }
  const auto shared = SharedPoints(s, t);
  if (common.size() < 2)
  {
    return std::any_of(shared.begin(), shared.end(),
      [&](const Rational& x) { return common.empty() || !Same(x, Integer(points[common[0]])); });
  }
  // With a common edge, points of the edge are no intersection: one off its line is.
  const IntVector p = Integer(points[common[0]]), q = Integer(points[common[1]]);
  return common.size() == 3 ||
    std::any_of(shared.begin(), shared.end(),
      [&](const Rational& x)
      {
        const IntVector toX{ x.Numerator[0] - p[0] * x.Denominator, x.Numerator[1] - p[1] * x.Denominator,
          x.Numerator[2] - p[2] * x.Denominator };
        const IntVector off = Cross(q - p, toX);
        return Dot(off, off) != 0;
      });
}

Pairs BruteForce(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles)
{
  Pairs pairs;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t j = i + 1; j < triangles.size(); ++j)
    {
      if (BruteForceIntersect(points, triangles[i], triangles[j]))
      {
        pairs.push_back({ Index(i), Index(j) });
      }
    }
  }
  return pairs;
}

/// Points with integer coordinates from 0 to `size`, and triangles with an area on them.
void RandomSoup(unsigned seed, int size, Index numberOfPoints, std::size_t numberOfTriangles, std::vector<Vec3>& points,
  std::vector<TriangleCorners>& triangles)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(0, size);
  std::uniform_int_distribution<Index> vertex(0, numberOfPoints - 1);
  points.clear();
  triangles.clear();
  for (Index n = 0; n < numberOfPoints; ++n)
  {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    points.emplace_back(x, y, z);
  }
  while (triangles.size() < numberOfTriangles)
  {
    const Index a = vertex(random), b = vertex(random), c = vertex(random);
    if (!Collinear(points[a], points[b], points[c]))
    {
      triangles.push_back({ a, b, c });
    }
  }
}

bool Meet(const std::vector<Vec3>& points, const TriangleCorners& a, const TriangleCorners& b)
{
  const bool meet = TrianglesIntersect(points, a, b);
  EXPECT_EQ(TrianglesIntersect(points, b, a), meet);
  EXPECT_EQ(TrianglesIntersect(points, { a[2], a[1], a[0] }, { b[1], b[2], b[0] }), meet);
  return meet;
}
}

TEST(ExactPredicates, SidesOfAPlane)
{
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  EXPECT_EQ(Orientation(o, x, y, Vec3(0.3, 0.3, 1e-300)), 1);
  EXPECT_EQ(Orientation(o, x, y, Vec3(0.3, 0.3, -1e-300)), -1);
  EXPECT_EQ(Orientation(o, x, y, Vec3(7.1, -0.3, 0)), 0);
  EXPECT_EQ(Orientation(o, x, y, 0, 1), 1);
  EXPECT_EQ(Orientation(o, y, x, 0, 1), -1);
  EXPECT_EQ(Orientation(o, x, Vec3(0.5, 0, 9), 0, 1), 0);
  EXPECT_TRUE(Collinear(Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(4, 8, 12)));
  EXPECT_FALSE(Collinear(Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(4, 8, 12.000000000001)));
}

TEST(ExactPredicates, AsIntegersWhereRoundingCannotTell)
{
  // Integers of 38 bits in one plane, or beside it by a unit: the rounded determinant is noise.
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> large(0, (std::int64_t(1) << 38) - 1), small(-2, 2);
  const auto draw = [&] { return Vec3(double(large(random)), double(large(random)), double(large(random))); };
  int zeros = 0;
  for (int n = 0; n < 20000; ++n)
  {
    const Vec3 a = draw(), u = Vec3(double(small(random)), double(small(random)), double(small(random)));
    const Vec3 v(double(small(random)), double(small(random)), double(small(random)));
    const Vec3 b = a + std::ldexp(1.0, 30) * u, c = a + std::ldexp(1.0, 29) * v;
    const Vec3 d = a + std::ldexp(1.0, 28) * (u + v) + Vec3(double(small(random)), 0.0, 0.0);
    const int expected = IntOrientation(a, b, c, d);
    ASSERT_EQ(Orientation(a, b, c, d), expected);
    zeros += expected == 0 ? 1 : 0;
    // The same in fractions of a unit, far from the origin, where differences are rounded too.
    const Vec3 e = draw() / 3.0 * std::ldexp(1.0, -46), f = draw(), g = draw(), h = e + (f - e) * 0.25 + (g - e) * 0.5;
    ASSERT_EQ(Orientation(e, f, g, h), -Orientation(f, e, g, h));
    ASSERT_EQ(Orientation(e, f, g, h), Orientation(f, g, e, h));
    ASSERT_EQ(Orientation(e, f, g, h), -Orientation(e, f, h, g));
  }
  EXPECT_GT(zeros, 1000);
}

TEST(ExactPredicates, DifferencesThatDoNotFitInADouble)
{
  // Multiples of 2^-30 beside multiples of 4: as integers of 2^-30 determinants fit in 128 bits.
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> tiny(-7, 7), huge(-7, 7);
  for (int n = 0; n < 20000; ++n)
  {
    const auto draw = [&]
    {
      Vec3 x;
      for (int i = 0; i < 3; ++i)
      {
        x[i] = random() % 2 ? std::ldexp(double(tiny(random)), -30) : double(huge(random)) * 4.0;
      }
      return x;
    };
    const Vec3 a = draw(), b = draw(), c = draw(), d = draw();
    ASSERT_EQ(Orientation(a, b, c, d), IntOrientation(a, b, c, d, 30));
    const IntVector p = Integer(a, 30), q = Integer(b, 30), r = Integer(c, 30);
    ASSERT_EQ(Orientation(a, b, c, 0, 1), SignOf((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])));
  }
}

TEST(SelfIntersections, WithoutACommonVertex)
{
  // A triangle in z = 0, and others.
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, // 0 to 2
    { 1, 1, -1 }, { 1, 1, 1 }, { 5, 5, 1 },                              // 3: through it
    { 1, 1, 0 }, { 1, 1, 1 }, { 2, 1, 1 },                               // 6: touches its inside
    { 2, 2, 0 }, { 3, 3, 1 }, { 3, 3, -1 },                              // 9: touches its edge
    { 4, 0, 0 }, { 5, 0, 1 }, { 5, 0, -1 },                              // 12: touches its corner
    { 2, 2.0000000000000004, 0 }, { 3, 3, 1 }, { 3, 3, -1 },             // 15: misses by a bit
    { 1, 1, 0 }, { 2, 1, 0 }, { 1, 2, 0 },                               // 18: in its plane, inside it
    { 1, 1, 1e-300 }, { 2, 1, 1e-300 }, { 1, 2, 1e-300 },                // 21: over it
    { 3, 3, 0 }, { 3, 2, 0 }, { 2, 3, 0 },                               // 24: in its plane, beside it
    { -1, 1, 0 }, { 5, 1, 0 }, { 2, 1, 3 } };                            // 27: an edge along its plane
  const TriangleCorners t{ 0, 1, 2 };
  const auto at = [](Index first) { return TriangleCorners{ first, first + 1, first + 2 }; };
  EXPECT_TRUE(Meet(points, t, at(3)));
  EXPECT_TRUE(Meet(points, t, at(6)));
  EXPECT_TRUE(Meet(points, t, at(9)));
  EXPECT_TRUE(Meet(points, t, at(12)));
  EXPECT_FALSE(Meet(points, t, at(15)));
  EXPECT_TRUE(Meet(points, t, at(18)));
  EXPECT_FALSE(Meet(points, t, at(21)));
  EXPECT_FALSE(Meet(points, t, at(24)));
  EXPECT_TRUE(Meet(points, t, at(27)));
}

TEST(SelfIntersections, WithACommonVertex)
{
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, 1 }, { 3, 3, -1 }, { -1, -1, 0 },
    { -1, 0, 3 }, { 1, 1, 0 }, { 2, 3, 0 }, { 2, 0, 0 }, { 3, -1, 0 }, { 1, 1, -2 } };
  const TriangleCorners t{ 0, 1, 2 };
  EXPECT_TRUE(Meet(points, t, { 0, 3, 4 }));   // through it
  EXPECT_FALSE(Meet(points, t, { 0, 5, 6 }));  // away from it
  EXPECT_FALSE(Meet(points, t, { 0, 3, 6 }));  // over it
  EXPECT_TRUE(Meet(points, t, { 0, 7, 3 }));   // an edge of the other in it
  EXPECT_TRUE(Meet(points, t, { 0, 7, 8 }));   // in its plane, inside the angle
  EXPECT_TRUE(Meet(points, t, { 0, 9, 10 }));  // in its plane, along an edge
  EXPECT_FALSE(Meet(points, t, { 0, 10, 5 })); // in its plane, outside the angle
  EXPECT_TRUE(Meet(points, t, { 0, 9, 3 }));   // a fold along half an edge
  EXPECT_TRUE(Meet(points, t, { 1, 11, 3 }));  // the edge opposite to the vertex cuts the other
}

TEST(SelfIntersections, WithACommonEdge)
{
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 0, -4, 0 }, { 1, 1, 0 }, { 1, 1, 1e-300 } };
  EXPECT_FALSE(Meet(points, { 0, 1, 2 }, { 0, 1, 3 }));
  EXPECT_TRUE(Meet(points, { 0, 1, 2 }, { 1, 0, 4 })); // folded back onto it
  EXPECT_FALSE(Meet(points, { 0, 1, 2 }, { 0, 1, 5 }));
  EXPECT_TRUE(Meet(points, { 0, 1, 2 }, { 2, 1, 0 })); // the same triangle
}

TEST(SelfIntersections, RandomSoupsAsByExactBruteForce)
{
  std::vector<Vec3> points;
  std::vector<TriangleCorners> triangles;
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 24; ++seed)
  {
    // Small grids: touching, coplanar and overlapping triangles are frequent. Few points: shared vertices are.
    const int size = 2 + int(seed % 4) * 3;
    RandomSoup(seed, size, seed % 2 ? 12 : 90, 90, points, triangles);
    const Pairs expected = BruteForce(points, triangles);
    EXPECT_EQ(FindSelfIntersections(points, triangles).Pairs, expected) << "seed " << seed;
    found += expected.size();
  }
  EXPECT_GT(found, 5000u);
}

TEST(SelfIntersections, SparseSoup)
{
  std::vector<Vec3> points;
  std::vector<TriangleCorners> triangles;
  RandomSoup(3, 400, 4000, 800, points, triangles);
  // Shrunk towards their first corner, so that most of them are free.
  std::vector<Vec3> own;
  for (TriangleCorners& t : triangles)
  {
    const Index first = Index(own.size());
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 x = points[t[0]] + 0.125 * (points[t[i]] - points[t[0]]);
      own.push_back(Vec3(std::round(x[0]), std::round(x[1]), std::round(x[2])));
    }
    t = { first, first + 1, first + 2 };
  }
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                    [&](const TriangleCorners& t) { return Collinear(own[t[0]], own[t[1]], own[t[2]]); }),
    triangles.end());
  const Pairs expected = BruteForce(own, triangles);
  EXPECT_GT(expected.size(), 20u);
  EXPECT_LT(expected.size(), triangles.size());
  EXPECT_EQ(FindSelfIntersections(own, triangles).Pairs, expected);
}

TEST(SelfIntersections, OfASubset)
{
  std::vector<Vec3> points;
  std::vector<TriangleCorners> triangles;
  RandomSoup(5, 20, 300, 400, points, triangles);
  const Pairs all = FindSelfIntersections(points, triangles).Pairs;
  const std::vector<Index> subset{ 17, 3, 250, 17, 399 };
  Pairs expected;
  std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
    [&](const std::array<Index, 2>& pair)
    { return std::find_first_of(pair.begin(), pair.end(), subset.begin(), subset.end()) != pair.end(); });
  EXPECT_GT(expected.size(), 4u);
  EXPECT_EQ(FindSelfIntersections(points, triangles, subset).Pairs, expected);
  EXPECT_TRUE(FindSelfIntersections(points, triangles, {}).Pairs.empty());
}

TEST(SelfIntersections, TrianglesWithoutAreaAreCounted)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 0, 0 }, { nan, 0, 0 } };
  const SelfIntersections result =
    FindSelfIntersections(points, { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 0, 2 }, { 0, 1, 4 } });
  EXPECT_EQ(result.WithoutArea, 3);
  EXPECT_TRUE(result.Pairs.empty());
  EXPECT_TRUE(FindSelfIntersections({}, {}).Pairs.empty());
}

TEST(SelfIntersections, AnyNumberOfThreads)
{
  std::vector<Vec3> points;
  std::vector<TriangleCorners> triangles;
  RandomSoup(9, 60, 3000, 3000, points, triangles);
  const Pairs sequential = FindSelfIntersections(points, triangles).Pairs;
  Pairs threaded;
  WithThreads([&] { threaded = FindSelfIntersections(points, triangles).Pairs; });
  EXPECT_EQ(sequential, threaded);
}

TEST(BoxTree, FindsWhatOverlaps)
{
  std::mt19937 random(2);
  std::uniform_int_distribution<int> coordinate(0, 30), length(0, 3);
  for (const int count : { 0, 1, 4, 5, 9, 200 })
  {
    std::vector<Box> boxes;
    for (int n = 0; n < count; ++n)
    {
      const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
      boxes.push_back({ Vec3(x, y, z), Vec3(x + length(random), y + length(random), z + length(random)) });
    }
    const BoxTree tree(boxes);
    ASSERT_EQ(tree.Size(), count);
    for (Index position = 0; position < count; ++position)
    {
      std::vector<Index> found, expected;
      tree.VisitOverlaps(tree.At(position), 0, [&](Index other) { found.push_back(tree.Number(other)); });
      for (Index n = 0; n < count; ++n)
      {
        if (boxes[n].Overlaps(tree.At(position)))
        {
          expected.push_back(n);
        }
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}
