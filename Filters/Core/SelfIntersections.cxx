// SPDX-License-Identifier: BSD-3-Clause
#include "SelfIntersections.h"

#include "BoxTree.h"
#include "ExactPredicates.h"
#include "Parallel.h"

#include <algorithm>
#include <utility>

namespace LabelMesh
{
namespace
{
constexpr Index ChunkSize = 512; // queries that a thread does at a time

using Corners = std::array<const Vec3*, 3>;

/// Two triangles, their common vertices first, in the same order.
struct TrianglePair
{
  Corners A, B;
  int Shared = 0;

  TrianglePair(const std::vector<Vec3>& points, const TriangleCorners& a, const TriangleCorners& b)
  {
    TriangleCorners first = a, second = b;
    for (int i = 0; i < 3; ++i)
    {
      const auto begin = second.begin() + this->Shared;
      const auto same = std::find(begin, second.end(), first[i]);
      if (same != second.end())
      {
        std::swap(*begin, *same);
        std::swap(first[this->Shared], first[i]);
        ++this->Shared;
      }
    }
    for (int i = 0; i < 3; ++i)
    {
      this->A[i] = &points[first[i]];
      this->B[i] = &points[second[i]];
    }
  }
};

int Side(const Corners& triangle, const Vec3& x)
{
  return Orientation(*triangle[0], *triangle[1], *triangle[2], x);
}

/// Whether a segment meets a triangle, when its ends are not both in the triangle's plane nor both on one side of it.
bool SegmentMeets(const Corners& triangle, const Vec3& p, const Vec3& q)
{
  bool left = false, right = false;
  for (int i = 0; i < 3; ++i)
  {
    const int turn = Orientation(p, q, *triangle[i], *triangle[(i + 1) % 3]);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  return !(left && right);
}

/// Whether an edge (i, i + 1) of one triangle meets another; `sides`: of its corners, of the other's plane. Edges in
/// the plane need no look: where they meet the other triangle, another edge of one of the two does.
bool EdgeMeets(const Corners& triangle, const Corners& other, const std::array<int, 3>& sides, int i)
{
  const int j = (i + 1) % 3;
  return sides[i] * sides[j] <= 0 && (sides[i] != 0 || sides[j] != 0) &&
    SegmentMeets(other, *triangle[i], *triangle[j]);
}

/// Two axes of coordinates onto which a triangle projects with an area, and the sense in which it turns there.
struct Projection
{
  int U = 0, V = 1, Turn = 0;

  explicit Projection(const Corners& t)
  {
    for (int axis = 0; axis < 3 && this->Turn == 0; ++axis)
    {
      this->U = axis;
      this->V = (axis + 1) % 3;
      this->Turn = Orientation(*t[0], *t[1], *t[2], this->U, this->V);
    }
  }
  int Of(const Vec3& a, const Vec3& b, const Vec3& c) const { return Orientation(a, b, c, this->U, this->V); }
};

/// Whether the line of some edge of one has all of the other strictly on its outer side; in a plane, two triangles
/// that do not meet have such an edge on one of the two.
bool EdgeSeparates(const Projection& plane, const Corners& triangle, const Corners& other)
{
  const int turn = plane.Of(*triangle[0], *triangle[1], *triangle[2]);
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 &from = *triangle[i], &to = *triangle[(i + 1) % 3];
    if (std::all_of(other.begin(), other.end(), [&](const Vec3* x) { return plane.Of(from, to, *x) * turn < 0; }))
    {
      return true;
    }
  }
  return false;
}

/// Whether the ray from the first corner through x lies between the two edges there.
bool InWedge(const Projection& plane, const Corners& triangle, const Vec3& x)
{
  const int turn = plane.Of(*triangle[0], *triangle[1], *triangle[2]);
  return plane.Of(*triangle[0], *triangle[1], x) * turn >= 0 && plane.Of(*triangle[0], x, *triangle[2]) * turn >= 0;
}

bool MeetInPlane(const TrianglePair& pair)
{
  const Projection plane(pair.A);
  const Corners &a = pair.A, &b = pair.B;
  switch (pair.Shared)
  {
    case 0:
      return !EdgeSeparates(plane, a, b) && !EdgeSeparates(plane, b, a);
    case 1:
      return InWedge(plane, a, *b[1]) || InWedge(plane, a, *b[2]) || InWedge(plane, b, *a[1]) ||
        InWedge(plane, b, *a[2]);
    default:
      return plane.Of(*b[0], *b[1], *b[2]) == plane.Turn;
  }
}

/// The sides of the corners that are not shared; 0 for those that are.
std::array<int, 3> Sides(const Corners& plane, const Corners& triangle, int shared)
{
  std::array<int, 3> sides{};
  for (int i = shared; i < 3; ++i)
  {
    sides[i] = Side(plane, *triangle[i]);
  }
  return sides;
}

bool OnOneSide(const std::array<int, 3>& sides, int shared)
{
  return sides[2] != 0 && std::all_of(sides.begin() + shared, sides.end(), [&](int s) { return s == sides[2]; });
}

/// Without a common vertex, or with one and only the edges opposite to it in question: in the line where two planes
/// meet, both triangles then begin at that vertex, and where what they share ends, one of the two edges is.
bool MeetAcross(const TrianglePair& pair, const std::array<int, 3>& sidesOfA)
{
  const std::array<int, 3> sidesOfB = Sides(pair.A, pair.B, pair.Shared);
  if (OnOneSide(sidesOfB, pair.Shared))
  {
    return false;
  }
  if (pair.Shared == 1)
  {
    return EdgeMeets(pair.A, pair.B, sidesOfA, 1) || EdgeMeets(pair.B, pair.A, sidesOfB, 1);
  }
  for (int i = 0; i < 3; ++i)
  {
    if (EdgeMeets(pair.A, pair.B, sidesOfA, i) || EdgeMeets(pair.B, pair.A, sidesOfB, i))
    {
      return true;
    }
  }
  return false;
}

bool Intersect(const TrianglePair& pair)
{
  if (pair.Shared == 3)
  {
    return true;
  }
  const std::array<int, 3> sides = Sides(pair.B, pair.A, pair.Shared);
  if (sides == std::array<int, 3>{})
  {
    return MeetInPlane(pair);
  }
  return pair.Shared < 2 && !OnOneSide(sides, pair.Shared) && MeetAcross(pair, sides);
}

bool HasArea(const std::vector<Vec3>& points, const TriangleCorners& t)
{
  const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  return a.allFinite() && b.allFinite() && c.allFinite() && !Collinear(a, b, c);
}

/// The boxes of triangles; empty, so that they overlap nothing, for those without an area.
std::vector<Box> BoxesOf(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles)
{
  std::vector<Box> boxes(triangles.size());
  ParallelFor(0, Index(triangles.size()), 0,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        if (HasArea(points, triangles[t]))
        {
          for (const Index v : triangles[t])
          {
            boxes[t].Add(points[v]);
          }
        }
      }
    });
  return boxes;
}

/// The boxes of the triangles `numbers`, one for each, in a tree, and the search for partners.
class Search
{
public:
  Search(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles, std::vector<Box> boxes,
    std::vector<Index> numbers)
    : Points(points)
    , Triangles(triangles)
    , Numbers(std::move(numbers))
    , Tree(std::move(boxes))
  {
  }

  /// All pairs among the triangles of the tree.
  std::vector<std::array<Index, 2>> All() const
  {
    return this->Collect(this->Tree.Size(),
      [&](Index position, std::vector<std::array<Index, 2>>& pairs)
      { this->Partners(this->Numbers[this->Tree.Number(position)], this->Tree.At(position), position + 1, pairs); });
  }

  /// All pairs of one of `subset` and one of the tree.
  std::vector<std::array<Index, 2>> Of(const std::vector<Index>& subset, const std::vector<Box>& boxes) const
  {
    return this->Collect(Index(subset.size()),
      [&](Index n, std::vector<std::array<Index, 2>>& pairs)
      { this->Partners(subset[n], boxes[subset[n]], 0, pairs); });
  }

private:
  void Partners(Index triangle, const Box& box, Index first, std::vector<std::array<Index, 2>>& pairs) const
  {
    this->Tree.VisitOverlaps(box, first,
      [&](Index position)
      {
        const Index other = this->Numbers[this->Tree.Number(position)];
        if (other != triangle && TrianglesIntersect(this->Points, this->Triangles[triangle], this->Triangles[other]))
        {
          pairs.push_back({ std::min(triangle, other), std::max(triangle, other) });
        }
      });
  }

  template <typename Query>
  std::vector<std::array<Index, 2>> Collect(Index queries, const Query& query) const
  {
    using Pair = std::array<Index, 2>;
    std::vector<Pair> pairs = ParallelCollect<Pair>((queries + ChunkSize - 1) / ChunkSize,
      [&](Index chunk, std::vector<Pair>& found)
      {
        for (Index n = chunk * ChunkSize; n < std::min(queries, (chunk + 1) * ChunkSize); ++n)
        {
          query(n, found);
        }
      });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  const std::vector<Vec3>& Points;
  const std::vector<TriangleCorners>& Triangles;
  std::vector<Index> Numbers;
  BoxTree Tree;
};
}

bool TrianglesIntersect(const std::vector<Vec3>& points, const TriangleCorners& a, const TriangleCorners& b)
{
  return Intersect(TrianglePair(points, a, b));
}

SelfIntersections FindSelfIntersections(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles)
{
  std::vector<Box> boxes = BoxesOf(points, triangles);
  std::vector<Index> numbers;
  numbers.reserve(boxes.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    if (!boxes[t].Empty())
    {
      boxes[numbers.size()] = boxes[t];
      numbers.push_back(Index(t));
    }
  }
  SelfIntersections result;
  result.WithoutArea = Index(boxes.size() - numbers.size());
  boxes.resize(numbers.size());
  result.Pairs = Search(points, triangles, std::move(boxes), std::move(numbers)).All();
  return result;
}

SelfIntersections FindSelfIntersections(
  const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles, const std::vector<Index>& subset)
{
  const std::vector<Box> boxes = BoxesOf(points, triangles);
  SelfIntersections result;
  Box hull;
  for (const Index t : subset)
  {
    hull.Add(boxes[t]);
    result.WithoutArea += boxes[t].Empty() ? 1 : 0;
  }
  std::vector<Index> near;
  std::vector<Box> nearBoxes;
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    if (boxes[t].Overlaps(hull))
    {
      near.push_back(Index(t));
      nearBoxes.push_back(boxes[t]);
    }
  }
  result.Pairs = Search(points, triangles, std::move(nearBoxes), std::move(near)).Of(subset, boxes);
  return result;
}
}
