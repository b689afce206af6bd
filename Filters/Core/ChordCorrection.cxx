// SPDX-License-Identifier: BSD-3-Clause
#include "ChordCorrection.h"

#include "Junction.h"
#include "Parallel.h"
#include "VertexMoves.h"
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
  return MoveVertices(indicators, leastRatio, moves, complex);
}
}
