// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCuts.h"

#include "DisjointSets.h"
#include "SelfIntersections.h"

#include <algorithm>
#include <map>

namespace LabelMesh
{
namespace
{
constexpr int MostRings = 6;

void MakeUnique(std::vector<Index>& numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The vertices with those around them in either mesh.
std::vector<Index> Grown(
  const SurfaceComplex& before, const SurfaceComplex& improved, const std::vector<Index>& vertices)
{
  std::vector<Index> grown = vertices;
  for (const SurfaceComplex* complex : { &before, &improved })
  {
    for (const Index v : vertices)
    {
      const std::vector<Index> around = v < complex->NumberOfVertices() ? complex->Neighbors(v) : std::vector<Index>();
      grown.insert(grown.end(), around.begin(), around.end());
    }
  }
  MakeUnique(grown);
  return grown;
}

/// Puts the vertices of the core, and all triangles at them, back. False, with nothing changed, where that does not fit
/// or makes a triangle that is too poor.
bool PutCoreBack(
  const SurfaceComplex& before, const std::vector<Index>& core, double wantedRatio, SurfaceComplex& improved)
{
  std::vector<InterfaceTriangle> triangles;
  for (const std::int32_t t : before.TrianglesAt(core))
  {
    triangles.push_back(before.Triangle(t));
    wantedRatio = std::min(wantedRatio, before.Ratio(t));
  }
  const auto position = [&](Index v) -> const Vec3&
  { return (std::binary_search(core.begin(), core.end(), v) ? before : improved).Vertex(v).Position; };
  const auto isGood = [&](const InterfaceTriangle& triangle)
  {
    const auto& v = triangle.Vertices;
    return RadiusRatio(position(v[0]), position(v[1]), position(v[2])) >= wantedRatio;
  };
  if (!improved.Fits(core, triangles) || !std::all_of(triangles.begin(), triangles.end(), isGood))
  {
    return false;
  }
  improved.ReplaceStars(core, triangles);
  for (const Index v : core)
  {
    if (v < before.NumberOfVertices())
    {
      improved.SetVertex(v, before.Vertex(v));
    }
  }
  return true;
}
}

std::vector<Cut> FindCuts(const SurfaceComplex& complex, const std::vector<Index>& near)
{
  std::vector<Vec3> points;
  for (const Particle& p : complex.AllVertices())
  {
    points.push_back(p.Position);
  }
  std::vector<TriangleCorners> corners;
  std::vector<Index> subset;
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    if (!complex.IsAlive(t))
    {
      continue;
    }
    const InterfaceTriangle& triangle = complex.Triangle(t);
    if (std::any_of(triangle.Vertices.begin(), triangle.Vertices.end(),
          [&near](Index v) { return std::binary_search(near.begin(), near.end(), v); }))
    {
      subset.push_back(Index(corners.size()));
    }
    corners.push_back(triangle.Vertices);
  }
  const SelfIntersections found =
    near.empty() ? FindSelfIntersections(points, corners) : FindSelfIntersections(points, corners, subset);
  DisjointSets sets(complex.NumberOfVertices());
  std::vector<Index> vertices;
  for (const auto& pair : found.Pairs)
  {
    for (const Index t : pair)
    {
      for (const Index v : corners[t])
      {
        vertices.push_back(v);
        sets.Unite(v, corners[pair[0]][0]);
      }
    }
  }
  MakeUnique(vertices);
  std::map<Index, Cut> cuts; // by the representative of the set
  for (const Index v : vertices)
  {
    cuts[sets.Find(v)].push_back(v);
  }
  std::vector<Cut> result;
  for (auto& [representative, cut] : cuts)
  {
    result.push_back(std::move(cut));
  }
  return result;
}

std::vector<Index> VerticesOf(const std::vector<Cut>& cuts)
{
  std::vector<Index> vertices;
  for (const Cut& cut : cuts)
  {
    vertices.insert(vertices.end(), cut.begin(), cut.end());
  }
  MakeUnique(vertices);
  return vertices;
}

bool PutBack(const SurfaceComplex& before, std::vector<Cut> cuts, double wantedRatio, SurfaceComplex& improved)
{
  for (int leastRings = 1; leastRings <= MostRings && !cuts.empty(); ++leastRings)
  {
    for (Cut& core : cuts)
    {
      bool done = false;
      for (int rings = 1; rings <= MostRings && !done; ++rings)
      {
        core = Grown(before, improved, core);
        done = rings >= leastRings && PutCoreBack(before, core, wantedRatio, improved);
      }
      if (!done)
      {
        return false;
      }
    }
    cuts = FindCuts(improved, VerticesOf(cuts));
  }
  return cuts.empty();
}
}
