// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeCorrection.h"

#include "VertexMoves.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LabelMesh
{
namespace
{
constexpr int VolumeRounds = 5;
constexpr double WantedError = 5e-4;    // relative; what is closer needs no further step
constexpr double LeastShare = 0.5;      // of the wanted volume: with less, parts are missing
constexpr double LongestStep = 0.25;    // of a vertex's shortest edge
constexpr double Regularization = 1e-9; // of the mean diagonal: where the volumes of all materials have a given sum

/// How a material's volume grows as a vertex moves.
struct Gradient
{
  MaterialId Material = NoMaterial;
  Vec3 Value = Vec3::Zero();
};

/// What the moves of one vertex do.
struct VertexGradients
{
  double Area = 0.0;               // a third of its triangles'
  std::vector<Gradient> Gradients; // of the materials whose volume is asked for
  double ShortestEdge = std::numeric_limits<double>::infinity();
};

/// Within the faces of the volume's box that the vertex lies on.
Vec3 WithinBorder(const MaterialSet& materials, Vec3 x)
{
  for (const MaterialId m : materials)
  {
    if (IsBorder(m))
    {
      x[BorderAxis(m)] = 0.0;
    }
  }
  return x;
}

/// The wanted volumes that moves can bring about: not those of materials of which whole parts are missing.
std::vector<double> Reachable(std::vector<double> wanted, const std::vector<double>& volumes)
{
  for (std::size_t m = 0; m < wanted.size(); ++m)
  {
    wanted[m] = volumes[m] > LeastShare * wanted[m] ? wanted[m] : 0.0;
  }
  return wanted;
}

bool IsWanted(const std::vector<double>& wanted, MaterialId m)
{
  return m < wanted.size() && wanted[m] > 0.0;
}

VertexGradients GradientsAt(const SurfaceComplex& complex, const std::vector<double>& wanted, Index v)
{
  VertexGradients at;
  const auto add = [&](MaterialId m, const Vec3& area)
  {
    if (!IsWanted(wanted, m))
    {
      return;
    }
    auto entry = std::find_if(
      at.Gradients.begin(), at.Gradients.end(), [m](const Gradient& gradient) { return gradient.Material == m; });
    if (entry == at.Gradients.end())
    {
      entry = at.Gradients.insert(entry, { m, Vec3::Zero() });
    }
    entry->Value += area / 3;
  };
  for (const std::int32_t t : complex.Star(v))
  {
    const InterfaceTriangle& triangle = complex.Triangle(t);
    const auto p = [&](int i) -> const Vec3& { return complex.Vertex(triangle.Vertices[i % 3]).Position; };
    const Vec3 area = 0.5 * (p(1) - p(0)).cross(p(2) - p(0));
    at.Area += area.norm() / 3;
    add(triangle.Materials[0], area);
    add(triangle.Materials[1], -area);
    for (int i = 0; i < 3; ++i)
    {
      at.ShortestEdge = std::min(at.ShortestEdge, (p(i + 1) - p(i)).norm());
    }
  }
  for (Gradient& gradient : at.Gradients)
  {
    gradient.Value = WithinBorder(complex.Vertex(v).Materials, gradient.Value);
  }
  return at;
}

std::vector<VertexGradients> AllGradients(const SurfaceComplex& complex, const std::vector<double>& wanted)
{
  std::vector<VertexGradients> all(std::size_t(complex.NumberOfVertices()));
  ForEachVertex(complex,
    [&](Index v)
    {
      if (!complex.IsFrozen(v) && !complex.Star(v).empty())
      {
        all[v] = GradientsAt(complex, wanted, v);
      }
    });
  return all;
}

/// The lambda, by material; zero for those that are free.
Eigen::VectorXd Multipliers(const std::vector<VertexGradients>& vertices, const Eigen::VectorXd& missing)
{
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::Index n = missing.size();
  double trace = 0.0;
  for (const VertexGradients& at : vertices)
  {
    for (const Gradient& a : at.Gradients)
    {
      for (const Gradient& b : at.Gradients)
      {
        entries.emplace_back(a.Material, b.Material, a.Value.dot(b.Value) / at.Area);
        trace += a.Material == b.Material ? entries.back().value() : 0.0;
      }
    }
  }
  for (Eigen::Index m = 0; m < n; ++m)
  {
    entries.emplace_back(m, m, Regularization * trace / double(n));
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  return solver.info() == Eigen::Success ? Eigen::VectorXd(solver.solve(missing)) : Eigen::VectorXd::Zero(n);
}

Vec3 MoveOf(const VertexGradients& at, const Eigen::VectorXd& multipliers)
{
  Vec3 move = Vec3::Zero();
  for (const Gradient& gradient : at.Gradients)
  {
    move += multipliers[gradient.Material] / at.Area * gradient.Value;
  }
  const double longest = LongestStep * at.ShortestEdge, length = move.norm();
  return length > longest ? Vec3(longest / length * move) : move;
}
}

std::vector<double> EnclosedVolumes(const SurfaceComplex& complex, int materials)
{
  std::vector<double> volumes(std::size_t(materials), 0.0);
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    if (!complex.IsAlive(t))
    {
      continue;
    }
    const InterfaceTriangle& triangle = complex.Triangle(t);
    const auto p = [&](int i) -> const Vec3& { return complex.Vertex(triangle.Vertices[i]).Position; };
    const double cone = p(0).dot(p(1).cross(p(2))) / 6.0;
    for (const int side : { 0, 1 })
    {
      const MaterialId m = triangle.Materials[side];
      if (m < materials)
      {
        volumes[m] += side == 0 ? cone : -cone;
      }
    }
  }
  return volumes;
}

double CorrectVolumes(
  const IndicatorSet& indicators, const std::vector<double>& volumesWanted, double leastRatio, SurfaceComplex& complex)
{
  const int materials = int(volumesWanted.size());
  const std::vector<double> wanted = Reachable(volumesWanted, EnclosedVolumes(complex, materials));
  for (int round = 0;; ++round)
  {
    const std::vector<double> volumes = EnclosedVolumes(complex, materials);
    Eigen::VectorXd missing = Eigen::VectorXd::Zero(materials);
    double error = 0.0;
    for (int m = 0; m < materials; ++m)
    {
      if (IsWanted(wanted, MaterialId(m)))
      {
        missing[m] = wanted[m] - volumes[m];
        error = std::max(error, std::abs(missing[m]) / wanted[m]);
      }
    }
    if (error < WantedError || round == VolumeRounds)
    {
      return error;
    }
    const std::vector<VertexGradients> vertices = AllGradients(complex, wanted);
    const Eigen::VectorXd multipliers = Multipliers(vertices, missing);
    std::vector<Vec3> moves(vertices.size());
    ForEachVertex(complex, [&](Index v) { moves[v] = MoveOf(vertices[v], multipliers); });
    MoveVertices(indicators, leastRatio, moves, complex);
  }
}
}
