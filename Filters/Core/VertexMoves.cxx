// SPDX-License-Identifier: BSD-3-Clause
#include "VertexMoves.h"

#include "VertexSmoothing.h"

#include <algorithm>

namespace LabelMesh
{
namespace
{
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
    constexpr Index chunk = 1024;
    const Index count = Index(suspects.size());
    std::vector<Index> taken = ParallelCollect<Index>((count + chunk - 1) / chunk,
      [&](Index c, std::vector<Index>& found)
      {
        for (Index n = c * chunk; n < std::min(count, (c + 1) * chunk); ++n)
        {
          if (!StaysGood(complex, suspects[n], moves, leastRatio))
          {
            const auto& v = complex.Triangle(suspects[n]).Vertices;
            found.insert(found.end(), v.begin(), v.end());
          }
        }
      });
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

Index MoveVertices(const IndicatorSet& indicators, double leastRatio, std::vector<Vec3>& moves, SurfaceComplex& complex)
{
  Restrain(complex, leastRatio, moves);
  Index moved = 0;
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    if (moves[v].isZero(0.0))
    {
      continue;
    }
    Particle p = complex.Vertex(v);
    p.Position += moves[v];
    if (indicators.Border())
    {
      indicators.Border()->Snap(p.Materials.begin(), p.Materials.Size(), p.Position);
    }
    p.Residual += moves[v].norm();
    complex.SetVertex(v, p);
    ++moved;
  }
  return moved;
}
}
