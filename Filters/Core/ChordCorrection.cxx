// SPDX-License-Identifier: BSD-3-Clause
#include "ChordCorrection.h"

#include "Junction.h"
#include "Parallel.h"
#include "VertexSmoothing.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
constexpr double LongestGap = 0.25;    // of an edge's length: what is more is no chord of this interface
constexpr double LeastThickness = 5.0; // of what a vertex moves into, in lengths of its move
constexpr double MeanOfArc = 2. / 3;   // of a parabola over its chord, in terms of its height

/// Of a triangle: its mean gap to the interface along its unit normal.
struct FaceGap
{
  Vec3 Normal = Vec3::Zero();
  double Area = 0.0, Gap = 0.0;
};

/// From the middle of an edge (a, b) of an interface to the interface, to first order.
Vec3 GapOfSurface(const IndicatorSet& indicators, const std::array<MaterialId, 2>& sides, const Vec3& a, const Vec3& b)
{
  if (IsBorder(sides[0]) || IsBorder(sides[1]))
  {
    return Vec3::Zero(); // the volume's box is flat
  }
  Vec3 gradient;
  const double difference = indicators.Difference(sides[0], sides[1], 0.5 * (a + b), gradient);
  const double squared = gradient.squaredNorm();
  const double most = LongestGap * (b - a).norm();
  return squared * most > std::abs(difference) * std::sqrt(squared) ? Vec3(-difference / squared * gradient)
                                                                    : Vec3(Vec3::Zero());
}

/// From the middle of an edge (a, b) of a curve to the curve.
Vec3 GapOfCurve(const IndicatorSet& indicators, const MaterialSet& materials, const Vec3& a, const Vec3& b)
{
  const Vec3 middle = 0.5 * (a + b);
  const Projection projection = ProjectToJunction(indicators, materials.begin(), materials.Size(), middle);
  const Vec3 gap = projection.Position - middle;
  return projection.Converged && gap.norm() < LongestGap * (b - a).norm() ? gap : Vec3(Vec3::Zero());
}

std::vector<FaceGap> GapsOfFaces(const IndicatorSet& indicators, const SurfaceComplex& complex)
{
  std::vector<FaceGap> gaps(std::size_t(complex.NumberOfTriangles()));
  ParallelFor(0, complex.NumberOfTriangles(), 1024,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        if (!complex.IsAlive(t))
        {
          continue;
        }
        const InterfaceTriangle& triangle = complex.Triangle(t);
        const auto p = [&](int i) -> const Vec3& { return complex.Vertex(triangle.Vertices[i % 3]).Position; };
        const Vec3 cross = (p(1) - p(0)).cross(p(2) - p(0));
        gaps[t].Area = 0.5 * cross.norm();
        gaps[t].Normal = cross.stableNormalized();
        for (int i = 0; i < 3; ++i)
        {
          gaps[t].Gap += GapOfSurface(indicators, triangle.Materials, p(i), p(i + 1)).dot(gaps[t].Normal) / 3;
        }
      }
    });
  return gaps;
}

bool IsOnCell(const Particle& p)
{
  return (p.CellDimension == 2 && p.Materials.Size() == 2) || (p.CellDimension == 1 && p.Materials.Size() == 3);
}

/// How far a vertex of a curve leaves it; zero for all others.
Vec3 MoveOffCurve(const IndicatorSet& indicators, const SurfaceComplex& complex, Index v)
{
  const Particle& p = complex.Vertex(v);
  if (p.CellDimension != 1 || !IsOnCell(p))
  {
    return Vec3::Zero();
  }
  Vec3 sum = Vec3::Zero();
  double length = 0.0;
  int edges = 0;
  for (const Index w : complex.Neighbors(v))
  {
    if (complex.IsOnCurve(complex.EdgeStar(v, w)))
    {
      const Vec3& q = complex.Vertex(w).Position;
      sum += (q - p.Position).norm() * GapOfCurve(indicators, p.Materials, p.Position, q);
      length += (q - p.Position).norm();
      ++edges;
    }
  }
  const Vec3 tangent = CurveTangent(indicators, p.Materials.begin(), p.Position);
  return edges == 2 ? ToTangentPlane(MeanOfArc / length * sum, tangent) : Vec3(Vec3::Zero());
}

/// The move of a surface's vertex along the mean normal of its triangles: what the vertices of curves, which move
/// first, leave of their mean gap.
Vec3 MoveOffSurface(
  const SurfaceComplex& complex, const std::vector<FaceGap>& gaps, const std::vector<Vec3>& movesOffCurves, Index v)
{
  const Particle& p = complex.Vertex(v);
  if (p.CellDimension != 2 || !IsOnCell(p))
  {
    return Vec3::Zero();
  }
  Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
  double area = 0.0;
  for (const std::int32_t t : complex.Star(v))
  {
    const auto& c = complex.Triangle(t).Vertices;
    const Vec3 moved = (movesOffCurves[c[0]] + movesOffCurves[c[1]] + movesOffCurves[c[2]]) / 3;
    area += gaps[t].Area;
    normal += gaps[t].Area * gaps[t].Normal;
    sum += gaps[t].Area * (gaps[t].Gap - gaps[t].Normal.dot(moved)) * gaps[t].Normal;
  }
  normal.stableNormalize();
  return area > 0.0 ? Vec3(sum.dot(normal) / area * normal) : Vec3(Vec3::Zero());
}

template <typename Functor>
void ForEachVertex(const SurfaceComplex& complex, Functor functor)
{
  ParallelFor(0, complex.NumberOfVertices(), 1024,
    [&](Index first, Index last)
    {
      for (Index v = first; v < last; ++v)
      {
        functor(v);
      }
    });
}

std::vector<Vec3> Moves(const IndicatorSet& indicators, const SurfaceComplex& complex)
{
  const std::vector<FaceGap> gaps = GapsOfFaces(indicators, complex);
  std::vector<Vec3> offCurves(std::size_t(complex.NumberOfVertices())), moves(offCurves.size());
  ForEachVertex(complex, [&](Index v) { offCurves[v] = MoveOffCurve(indicators, complex, v); });
  ForEachVertex(complex, [&](Index v) { moves[v] = offCurves[v] + MoveOffSurface(complex, gaps, offCurves, v); });
  return moves;
}

/// Whether what lies in the way of a move from x is thin, so that the sheet on its other side is near.
bool IsThin(const IndicatorSet& indicators, const Vec3& x, const Vec3& move)
{
  return indicators.LargestMaterial(x + move) != indicators.LargestMaterial(x + LeastThickness * move);
}

/// Whether a triangle keeps its shape and its sense when its corners move.
bool StaysGood(const SurfaceComplex& complex, Index t, const std::vector<Vec3>& moves, double leastRatio)
{
  const auto& v = complex.Triangle(t).Vertices;
  std::array<Vec3, 3> p;
  for (int i = 0; i < 3; ++i)
  {
    p[i] = complex.Vertex(v[i]).Position + moves[v[i]];
  }
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).stableNormalized();
  return normal.dot(complex.UnitNormal(t)) > LeastTurnOfFace &&
    RadiusRatio(p[0], p[1], p[2]) >= std::min(leastRatio, complex.Ratio(t));
}

/// Takes back moves of the corners of triangles that would suffer, until none does.
void Restrain(const SurfaceComplex& complex, double leastRatio, std::vector<Vec3>& moves)
{
  std::vector<std::int32_t> suspects;
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    if (complex.IsAlive(t))
    {
      suspects.push_back(std::int32_t(t));
    }
  }
  while (!suspects.empty())
  {
    std::vector<Index> taken;
    for (const std::int32_t t : suspects)
    {
      if (!StaysGood(complex, t, moves, leastRatio))
      {
        const auto& v = complex.Triangle(t).Vertices;
        taken.insert(taken.end(), v.begin(), v.end());
      }
    }
    std::sort(taken.begin(), taken.end());
    taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
    for (const Index v : taken)
    {
      moves[v].setZero();
    }
    suspects = complex.TrianglesAt(taken);
    // Triangles with all corners at rest are as they were.
    suspects.erase(std::remove_if(suspects.begin(), suspects.end(),
                     [&](std::int32_t t)
                     {
                       const auto& v = complex.Triangle(t).Vertices;
                       return std::all_of(v.begin(), v.end(), [&moves](Index n) { return moves[n].isZero(0.0); });
                     }),
      suspects.end());
  }
}
}

Index CorrectChords(const IndicatorSet& indicators, SurfaceComplex& complex, double leastRatio)
{
  std::vector<Vec3> moves = Moves(indicators, complex);
  ForEachVertex(complex,
    [&](Index v)
    {
      if (complex.IsFrozen(v) || complex.Star(v).empty() || IsThin(indicators, complex.Vertex(v).Position, moves[v]))
      {
        moves[v].setZero();
      }
    });
  Restrain(complex, leastRatio, moves);
  Index moved = 0;
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    if (!moves[v].isZero(0.0))
    {
      Particle p = complex.Vertex(v);
      p.Position += moves[v];
      if (indicators.Border())
      {
        indicators.Border()->Snap(p.Materials.begin(), p.Materials.Size(), p.Position);
      }
      p.Residual = moves[v].norm();
      complex.SetVertex(v, p);
      ++moved;
    }
  }
  return moved;
}
}
