// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"

#include "DisjointSets.h"
#include "Parallel.h"
#include "SelfIntersections.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace LabelMesh
{
namespace
{
constexpr double DegenerateRatio = 1e-10;

/// Sums ratios and areas in the order in which triangles are added.
struct QualitySum
{
  TriangleQuality Quality;
  double Ratios = 0.0;

  void Add(double ratio, double area, Index triangle)
  {
    ++this->Quality.Triangles;
    if (ratio < this->Quality.MinRadiusRatio || this->Quality.Worst < 0)
    {
      this->Quality.Worst = triangle;
    }
    this->Ratios += ratio;
    this->Quality.MinRadiusRatio = std::min(this->Quality.MinRadiusRatio, ratio);
    this->Quality.Area += area;
  }
  TriangleQuality Result() const
  {
    TriangleQuality result = this->Quality;
    result.MeanRadiusRatio = result.Triangles > 0 ? this->Ratios / double(result.Triangles) : 1.0;
    return result;
  }
};

/// One use of an edge by a triangle: vertices ascending, and which way the triangle walks along it.
struct EdgeUse
{
  Index Low, High;
  Index Triangle;  ///< of the surface
  int Low3, High3; ///< at which corners of the triangle Low and High are
  bool Forward;

  bool operator<(const EdgeUse& other) const
  {
    return std::tie(this->Low, this->High, this->Triangle, this->Low3) <
      std::tie(other.Low, other.High, other.Triangle, other.Low3);
  }
};

using Corners = TriangleCorners;

std::vector<EdgeUse> SortedEdges(const std::vector<Corners>& surface)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.size());
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      const int d = (c + 1) % 3;
      const Index from = surface[t][c], to = surface[t][d];
      uses.push_back(
        from < to ? EdgeUse{ from, to, Index(t), c, d, true } : EdgeUse{ to, from, Index(t), d, c, false });
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

/// Edge counts; returns the number of edges and unites, in `fans`, the corners of the two triangles of an edge.
Index CheckEdges(const std::vector<EdgeUse>& uses, MaterialCheck& check, DisjointSets& fans)
{
  Index edges = 0;
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last)
  {
    Index forward = 0;
    for (last = first; last < uses.size() && uses[last].Low == uses[first].Low && uses[last].High == uses[first].High;
         ++last)
    {
      forward += uses[last].Forward ? 1 : 0;
    }
    const Index count = Index(last - first);
    if (count == 2)
    {
      const EdgeUse &a = uses[first], &b = uses[first + 1];
      fans.Unite(3 * a.Triangle + a.Low3, 3 * b.Triangle + b.Low3);
      fans.Unite(3 * a.Triangle + a.High3, 3 * b.Triangle + b.High3);
    }
    ++edges;
    check.OpenEdges += count % 2;
    check.NonManifoldEdges += count % 2 == 0 && count > 2 ? 1 : 0;
    check.MisorientedEdges += count % 2 == 0 && 2 * forward != count ? 1 : 0;
  }
  return edges;
}

/// Vertices and fans; returns the pieces that the triangles make up.
DisjointSets CheckVertices(const std::vector<Corners>& surface, MaterialCheck& check, DisjointSets& fans)
{
  std::vector<std::pair<Index, Index>> corners; // (vertex, its fan)
  corners.reserve(3 * surface.size());
  for (Index t = 0; t < Index(surface.size()); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      corners.emplace_back(surface[t][c], fans.Find(3 * t + c));
    }
  }
  std::sort(corners.begin(), corners.end());
  DisjointSets pieces(Index(surface.size()));
  for (std::size_t first = 0, last = 0; first < corners.size(); first = last)
  {
    bool oneFan = true;
    for (last = first; last < corners.size() && corners[last].first == corners[first].first; ++last)
    {
      oneFan = oneFan && corners[last].second == corners[first].second;
      pieces.Unite(corners[first].second / 3, corners[last].second / 3);
    }
    ++check.Vertices;
    check.NonManifoldVertices += oneFan ? 0 : 1;
  }
  // A fan's root names a triangle of the fan, so its triangles must be united with it too.
  for (Index t = 0; t < Index(surface.size()); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      pieces.Unite(t, fans.Find(3 * t + c) / 3);
    }
  }
  return pieces;
}

/// Components, and the volume that outward triangles enclose, together and by component. The volumes are about a point
/// near the surface: far from the origin digits would cancel.
void CheckVolumes(
  const std::vector<Corners>& surface, const std::vector<Vec3>& points, DisjointSets& pieces, MaterialCheck& check)
{
  double sixfold = 0.0;
  std::vector<double> sixfoldOfPieces(surface.size(), 0.0);
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    const Vec3& origin = points[surface[0][0]];
    const Corners& corners = surface[t];
    const double part =
      (points[corners[0]] - origin).dot((points[corners[1]] - origin).cross(points[corners[2]] - origin));
    sixfold += part;
    sixfoldOfPieces[pieces.Find(Index(t))] += part;
  }
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    if (pieces.Find(Index(t)) == Index(t))
    {
      ++check.Components;
      ++(sixfoldOfPieces[t] < 0.0 ? check.InnerShells : check.OuterShells);
    }
  }
  check.Volume = sixfold / 6.0;
}

void CheckSurface(const std::vector<Corners>& surface, const std::vector<Vec3>& points, MaterialCheck& check)
{
  DisjointSets fans(3 * Index(surface.size()));
  const Index edges = CheckEdges(SortedEdges(surface), check, fans);
  DisjointSets pieces = CheckVertices(surface, check, fans);
  CheckVolumes(surface, points, pieces, check);
  check.Euler = check.Vertices - edges + Index(surface.size());
}

void RequireIndices(const std::vector<InterfaceTriangle>& triangles, Index points, int materials)
{
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (const Index v : triangles[t].Vertices)
    {
      if (v < 0 || v >= points)
      {
        throw std::invalid_argument(
          "triangle " + std::to_string(t) + " has the point " + std::to_string(v) + " of " + std::to_string(points));
      }
    }
    for (const MaterialId m : triangles[t].Materials)
    {
      if (m >= materials)
      {
        throw std::invalid_argument("triangle " + std::to_string(t) + " has the material " + std::to_string(m) +
          " of " + std::to_string(materials));
      }
    }
  }
}

Index CountDuplicates(const std::vector<InterfaceTriangle>& triangles)
{
  std::vector<Corners> sorted;
  sorted.reserve(triangles.size());
  for (const InterfaceTriangle& t : triangles)
  {
    sorted.push_back(t.Vertices);
    std::sort(sorted.back().begin(), sorted.back().end());
  }
  std::sort(sorted.begin(), sorted.end());
  return Index(sorted.end() - std::unique(sorted.begin(), sorted.end()));
}

Index CountVertices(const std::vector<InterfaceTriangle>& triangles, std::size_t points)
{
  std::vector<bool> used(points, false);
  for (const InterfaceTriangle& t : triangles)
  {
    for (const Index v : t.Vertices)
    {
      used[v] = true;
    }
  }
  return Index(std::count(used.begin(), used.end(), true));
}

bool IsWrong(const InterfaceTriangle& triangle, const std::vector<MaterialSet>& sets)
{
  return std::any_of(triangle.Vertices.begin(), triangle.Vertices.end(),
    [&](Index v) { return !sets[v].Contains(triangle.Materials[0]) || !sets[v].Contains(triangle.Materials[1]); });
}

void CheckIntersections(
  const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles, MeshCheck& check)
{
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const InterfaceTriangle& t : triangles)
  {
    corners.push_back(t.Vertices);
  }
  const SelfIntersections found = FindSelfIntersections(points, corners);
  check.SelfIntersectingPairs = Index(found.Pairs.size());
  std::vector<bool> intersects(triangles.size(), false);
  for (const std::array<Index, 2>& pair : found.Pairs)
  {
    intersects[pair[0]] = intersects[pair[1]] = true;
    const std::array<MaterialId, 2>&a = triangles[pair[0]].Materials, &b = triangles[pair[1]].Materials;
    for (const MaterialId m : a)
    {
      check.Materials[m].SelfIntersections += m == b[0] || m == b[1] ? 1 : 0;
    }
  }
  check.SelfIntersectingTriangles = Index(std::count(intersects.begin(), intersects.end(), true));
  check.FirstIntersecting = found.Pairs.empty() ? -1 : found.Pairs[0][0];
}

/// Ratios and areas of all, of each material and of each pair.
void MeasureQuality(const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles, MeshCheck& check)
{
  QualitySum all;
  std::vector<QualitySum> materials(check.Materials.size());
  std::vector<std::pair<std::array<MaterialId, 2>, std::size_t>> order;
  std::vector<std::array<double, 2>> measures; // ratio, area
  order.reserve(triangles.size());
  measures.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Vec3 &a = points[triangles[t].Vertices[0]], &b = points[triangles[t].Vertices[1]],
               &c = points[triangles[t].Vertices[2]];
    measures.push_back({ RadiusRatio(a, b, c), 0.5 * (b - a).cross(c - a).norm() });
    all.Add(measures[t][0], measures[t][1], Index(t));
    check.DegenerateTriangles += measures[t][0] < DegenerateRatio ? 1 : 0;
    std::array<MaterialId, 2> pair = triangles[t].Materials;
    std::sort(pair.begin(), pair.end());
    materials[pair[0]].Add(measures[t][0], measures[t][1], Index(t));
    materials[pair[1]].Add(measures[t][0], measures[t][1], Index(t));
    order.emplace_back(pair, t);
  }
  check.Quality = all.Result();
  for (std::size_t m = 0; m < materials.size(); ++m)
  {
    check.Materials[m].Quality = materials[m].Result();
  }
  std::sort(order.begin(), order.end());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last)
  {
    QualitySum sum;
    for (last = first; last < order.size() && order[last].first == order[first].first; ++last)
    {
      sum.Add(measures[order[last].second][0], measures[order[last].second][1], Index(order[last].second));
    }
    check.Pairs.push_back({ order[first].first, sum.Result() });
  }
  if (!measures.empty())
  {
    const auto at = measures.begin() + std::ptrdiff_t(measures.size() / 100);
    std::nth_element(measures.begin(), at, measures.end());
    check.FirstPercentileRatio = (*at)[0];
  }
}

/// Names triangles by their numbers among all instead of among the proper ones.
void Renumber(const std::vector<Index>& numbers, MeshCheck& check)
{
  const auto renumber = [&numbers](Index& triangle) { triangle = triangle < 0 ? triangle : numbers[triangle]; };
  renumber(check.Quality.Worst);
  renumber(check.FirstIntersecting);
  for (MaterialCheck& material : check.Materials)
  {
    renumber(material.Quality.Worst);
  }
  for (PairCheck& pair : check.Pairs)
  {
    renumber(pair.Quality.Worst);
  }
}
}

MeshCheck CheckMesh(const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles,
  int numberOfMaterials, const std::vector<MaterialSet>& sets)
{
  RequireIndices(triangles, Index(points.size()), numberOfMaterials);
  MeshCheck check;
  check.Materials.resize(static_cast<std::size_t>(numberOfMaterials));
  std::vector<InterfaceTriangle> proper;
  std::vector<Index> numbers; // of the proper ones
  proper.reserve(triangles.size());
  numbers.reserve(triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    const InterfaceTriangle& t = triangles[n];
    if (t.Materials[0] == t.Materials[1])
    {
      ++check.SameMaterialTriangles;
      continue;
    }
    proper.push_back(t);
    numbers.push_back(Index(n));
    check.WrongFaces += !sets.empty() && IsWrong(t, sets) ? 1 : 0;
  }
  check.DuplicateTriangles = CountDuplicates(proper);
  check.Vertices = CountVertices(proper, points.size());
  MeasureQuality(points, proper, check);
  CheckIntersections(points, proper, check);

  std::vector<std::vector<Corners>> surfaces(check.Materials.size());
  for (const InterfaceTriangle& t : proper)
  {
    // The normal points out of the first material and into the second.
    surfaces[t.Materials[0]].push_back(t.Vertices);
    surfaces[t.Materials[1]].push_back({ t.Vertices[0], t.Vertices[2], t.Vertices[1] });
  }
  ParallelFor(0, Index(surfaces.size()), 1,
    [&](Index first, Index last)
    {
      for (Index m = first; m < last; ++m)
      {
        CheckSurface(surfaces[m], points, check.Materials[m]);
      }
    });
  Renumber(numbers, check);
  return check;
}
}
