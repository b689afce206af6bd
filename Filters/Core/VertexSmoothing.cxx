// SPDX-License-Identifier: BSD-3-Clause
#include "VertexSmoothing.h"

#include "Junction.h"
#include "Parallel.h"
#include "ParticlePlacement.h"

#include <Eigen/Dense>

namespace LabelMesh
{
namespace
{
constexpr double LongestStep = 0.3;     // target lengths
constexpr double ShortestStep = 0.01;   // target lengths: a shorter one is not worth a projection
constexpr int Halvings = 2;             // of a step that does not help
constexpr double LeastGain = 1e-4;      // of the cost, which is about 0.05 for each triangle
constexpr double Regularization = 0.01; // of the largest eigenvalue of the Hessian

/// Value, gradient and Hessian of the energy sum of eta^2 over the triangles at x, where eta, the inverse mean ratio,
/// is the sum of squared lengths over 4 sqrt(3) areas: 1 for equilateral triangles, infinite for degenerate ones.
struct Energy
{
  Vec3 Gradient = Vec3::Zero();
  Mat3 Hessian = Mat3::Zero();

  /// Adds the triangle of x and the edge from b to c.
  void Add(const Vec3& x, const Vec3& b, const Vec3& c)
  {
    const Vec3 edge = c - b, toX = x - b;
    const Vec3 cross = edge.cross(toX);
    const double area2 = cross.norm(); // twice the area
    if (!(area2 > 1e-12 * edge.squaredNorm()))
    {
      return;
    }
    constexpr double k = 2.0 * 1.7320508075688772; // eta = squares / (k area2)
    const double squares = toX.squaredNorm() + (x - c).squaredNorm() + edge.squaredNorm();
    const double eta = squares / (k * area2);
    const Vec3 growth = cross.cross(edge) / area2; // of area2
    const Vec3 slope = (2.0 * (toX + (x - c)) - eta * k * growth) / (k * area2);
    const Mat3 areaHessian =
      (edge.squaredNorm() * Mat3::Identity() - edge * edge.transpose() - growth * growth.transpose()) / area2;
    const Mat3 hessian =
      (4.0 * Mat3::Identity() - k * (growth * slope.transpose() + slope * growth.transpose()) - eta * k * areaHessian) /
      (k * area2);
    this->Gradient += 2.0 * eta * slope;
    this->Hessian += 2.0 * (slope * slope.transpose() + eta * hessian);
  }
};

/// The Newton step in the plane of the columns of `span`. Where the energy is not convex the eigenvalues of the Hessian
/// are taken by their size, so that the step leads down.
Vec3 StepWithin(const Energy& energy, const Eigen::Matrix<double, 3, 2>& span)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(span.transpose() * energy.Hessian * span);
  const double least = Regularization * eigen.eigenvalues().cwiseAbs().maxCoeff();
  if (!(least > 0.0))
  {
    return Vec3::Zero();
  }
  const Eigen::Vector2d inverse = eigen.eigenvalues().cwiseAbs().cwiseMax(least).cwiseInverse();
  const Eigen::Vector2d gradient = eigen.eigenvectors().transpose() * (span.transpose() * energy.Gradient);
  return -(span * (eigen.eigenvectors() * inverse.cwiseProduct(gradient)));
}

Vec3 NewtonStep(const IndicatorSet& indicators, const Particle& p, const Energy& energy)
{
  if (p.CellDimension == 1)
  {
    const Eigen::Matrix<double, 3, 1> tangent = CurveTangent(indicators, p.Materials.begin(), p.Position);
    const double curvature = std::abs(tangent.dot(energy.Hessian * tangent));
    const double slope = tangent.dot(energy.Gradient);
    return curvature > 0.0 ? Vec3(-slope / curvature * tangent) : Vec3(Vec3::Zero());
  }
  Eigen::Matrix<double, 3, 2> span;
  span.col(0) = p.Normal.unitOrthogonal();
  span.col(1) = p.Normal.cross(span.col(0));
  return StepWithin(energy, span);
}

bool MayMove(const SurfaceComplex& complex, Index v)
{
  const Particle& p = complex.Vertex(v);
  if (complex.IsFrozen(v) || complex.Star(v).empty())
  {
    return false;
  }
  return (p.CellDimension == 2 && p.Materials.Size() == 2) || (p.CellDimension == 1 && p.Materials.Size() == 3);
}

/// The edge opposite v in a triangle, in the triangle's sense.
std::array<Index, 2> OppositeEdge(const InterfaceTriangle& triangle, Index v)
{
  const auto& c = triangle.Vertices;
  return c[0] == v ? std::array<Index, 2>{ c[1], c[2] }
    : c[1] == v    ? std::array<Index, 2>{ c[2], c[0] }
                   : std::array<Index, 2>{ c[0], c[1] };
}
}

double SmoothVertex(const IndicatorSet& indicators, SurfaceComplex& complex, Index v)
{
  if (!MayMove(complex, v))
  {
    return 0.0;
  }
  const Particle& p = complex.Vertex(v);
  thread_local std::vector<std::array<Vec3, 2>> edges; // opposite v: memory kept from vertex to vertex
  edges.clear();
  Energy energy;
  double cost = 0.0;
  for (const std::int32_t t : complex.Star(v))
  {
    const auto [b, c] = OppositeEdge(complex.Triangle(t), v);
    edges.push_back({ complex.Vertex(b).Position, complex.Vertex(c).Position });
    energy.Add(p.Position, edges.back()[0], edges.back()[1]);
    cost += TriangleCost(RadiusRatio(p.Position, edges.back()[0], edges.back()[1]));
  }
  Vec3 step = NewtonStep(indicators, p, energy);
  const double length = step.norm(), most = LongestStep * p.TargetLength;
  if (length > most)
  {
    step *= most / length;
  }
  // Whether the star at x costs less, and faces where it did.
  const auto helps = [&p, cost](const Vec3& x)
  {
    double after = 0.0;
    for (const auto& [b, c] : edges)
    {
      const Vec3 before = (b - p.Position).cross(c - p.Position), now = (b - x).cross(c - x);
      if (now.dot(before) < LeastTurnOfFace * std::sqrt(now.squaredNorm() * before.squaredNorm()))
      {
        return false;
      }
      after += TriangleCost(RadiusRatio(x, b, c));
    }
    return after < cost - LeastGain;
  };
  for (int attempt = 0; attempt <= Halvings && step.norm() > ShortestStep * p.TargetLength; ++attempt, step *= 0.5)
  {
    Particle moved;
    if (PlaceOnJunction(indicators, p.Materials, p.Position + step, p.TargetLength, moved) && helps(moved.Position))
    {
      const double move = (moved.Position - p.Position).norm() / p.TargetLength;
      complex.SetVertex(v, moved);
      return move;
    }
  }
  return 0.0;
}

std::vector<std::vector<Index>> IndependentSets(const SurfaceComplex& complex)
{
  // Each vertex in turn gets the first colour that none around it has.
  constexpr int none = -1;
  std::vector<int> colors(std::size_t(complex.NumberOfVertices()), none);
  std::vector<std::vector<Index>> sets;
  std::vector<char> taken;
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    if (!MayMove(complex, v))
    {
      continue;
    }
    taken.assign(sets.size() + 1, 0);
    for (const std::int32_t t : complex.Star(v))
    {
      for (const Index other : complex.Triangle(t).Vertices)
      {
        if (colors[other] != none)
        {
          taken[colors[other]] = 1;
        }
      }
    }
    colors[v] = int(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (std::size_t(colors[v]) == sets.size())
    {
      sets.emplace_back();
    }
    sets[colors[v]].push_back(v);
  }
  return sets;
}

Index SmoothVertices(const IndicatorSet& indicators, SurfaceComplex& complex,
  const std::vector<std::vector<Index>>& sets, std::vector<char>& active)
{
  std::vector<char> moved(active.size(), 0);
  for (const std::vector<Index>& set : sets)
  {
    ParallelFor(0, Index(set.size()), 256,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          moved[set[n]] = active[set[n]] && SmoothVertex(indicators, complex, set[n]) > 0.0;
        }
      });
  }
  std::fill(active.begin(), active.end(), char(0));
  Index moves = 0;
  for (Index v = 0; v < Index(moved.size()); ++v)
  {
    if (moved[v])
    {
      ++moves;
      for (const std::int32_t t : complex.Star(v))
      {
        for (const Index other : complex.Triangle(t).Vertices)
        {
          active[other] = 1;
        }
      }
    }
  }
  return moves;
}
}
