// SPDX-License-Identifier: BSD-3-Clause
#include "MeshImprovement.h"

#include "ManifoldLabels.h"
#include "Parallel.h"
#include "TriangleMending.h"
#include "VertexSmoothing.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
constexpr double LeastFlipGain = 1e-3; // of the cost of two triangles
constexpr double FlatEnough = 0.85;    // cosine between triangles, and to what was there
constexpr double LeastRatioToLeave = 0.85;

/// What a flip of the edge (a, b) would gain; 0 where it must not be, since triangles would turn away from where they
/// face.
double FlipGain(const SurfaceComplex& complex, Index a, Index b)
{
  const auto p = [&](Index v) -> const Vec3& { return complex.Vertex(v).Position; };
  const SurfaceComplex::Flippable edge = complex.FlippableEdge(a, b);
  if (edge.First < 0)
  {
    return 0.0;
  }
  const Vec3 &c = p(edge.C), &d = p(edge.D);
  const double before = TriangleCost(complex.Ratio(edge.First)) + TriangleCost(complex.Ratio(edge.Second));
  const double after = TriangleCost(RadiusRatio(c, p(a), d)) + TriangleCost(RadiusRatio(c, d, p(b)));
  if (before - after < LeastFlipGain)
  {
    return 0.0;
  }
  const Vec3 n0 = complex.UnitNormal(edge.First), n1 = complex.UnitNormal(edge.Second);
  const Vec3 mean = (n0 + n1).stableNormalized();
  const Vec3 m0 = (p(a) - c).cross(d - c).stableNormalized(), m1 = (d - c).cross(p(b) - c).stableNormalized();
  const bool flat =
    m0.dot(mean) > FlatEnough && m1.dot(mean) > FlatEnough && m0.dot(m1) >= std::min(FlatEnough, n0.dot(n1));
  return flat ? before - after : 0.0;
}

struct FlipCandidate
{
  double Gain;
  Index A, B;
};

/// Flips, the best first, all edges at active vertices that gain, and makes their vertices active.
Index FlipEdges(SurfaceComplex& complex, std::vector<char>& active)
{
  constexpr Index chunk = 2048;
  const Index count = complex.NumberOfTriangles();
  std::vector<FlipCandidate> candidates = ParallelCollect<FlipCandidate>((count + chunk - 1) / chunk,
    [&](Index n, std::vector<FlipCandidate>& found)
    {
      for (Index t = n * chunk; t < std::min(count, (n + 1) * chunk); ++t)
      {
        // No flip helps two triangles that are better than this.
        if (!complex.IsAlive(t) || complex.Ratio(t) > LeastRatioToLeave)
        {
          continue;
        }
        for (int i = 0; i < 3; ++i)
        {
          const Index a = complex.Triangle(t).Vertices[i], b = complex.Triangle(t).Vertices[(i + 1) % 3];
          const double gain = active[a] || active[b] ? FlipGain(complex, a, b) : 0.0;
          if (gain > 0.0)
          {
            found.push_back({ gain, a, b });
          }
        }
      }
    });
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const FlipCandidate& a, const FlipCandidate& b) { return a.Gain > b.Gain; });
  Index flips = 0;
  for (const FlipCandidate& candidate : candidates)
  {
    if (FlipGain(complex, candidate.A, candidate.B) > 0.0)
    {
      const SurfaceComplex::Flippable edge = complex.FlippableEdge(candidate.A, candidate.B);
      flips += complex.Flip(candidate.A, candidate.B);
      for (const Index v : { candidate.A, candidate.B, edge.C, edge.D })
      {
        active[v] = 1;
      }
    }
  }
  return flips;
}
}

ImproveResult ImproveMesh(
  const IndicatorSet& indicators, SurfaceComplex& complex, const ImproveOptions& options, const Monitor& monitor)
{
  constexpr double smoothing = 0.5; // share of the work; the rest is mending
  ImproveResult result;
  std::vector<char> active(std::size_t(complex.NumberOfVertices()), 1);
  std::vector<std::vector<Index>> sets;
  for (int pass = 0; pass < options.Passes; ++pass)
  {
    monitor.Step(smoothing * double(pass) / options.Passes, "Improving triangles");
    const Index flips = FlipEdges(complex, active);
    if (pass == 0 || flips > 0)
    {
      sets = IndependentSets(complex);
    }
    result.Flips += flips;
    result.Moves += SmoothVertices(indicators, complex, sets, active);
  }
  const MendResult mended = MendTriangles(indicators, complex, options.WantedRatio, monitor.Part(smoothing, 1.0));
  result.Mended = mended.Mended;
  monitor.Step(1.0);
  return result;
}
}
