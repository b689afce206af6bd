// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCuts.h"

#include "SelfIntersections.h"

#include <algorithm>

namespace LabelMesh
{
std::vector<Index> VerticesOfCuts(const SurfaceComplex& complex, const std::vector<Index>& near)
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
  std::vector<Index> vertices;
  for (const auto& pair : found.Pairs)
  {
    for (const Index t : pair)
    {
      vertices.insert(vertices.end(), corners[t].begin(), corners[t].end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

bool PutBack(const SurfaceComplex& before, const std::vector<Index>& cuts, double wantedRatio, SurfaceComplex& improved)
{
  std::vector<Index> core = cuts;
  for (const SurfaceComplex* complex : { &before, static_cast<const SurfaceComplex*>(&improved) })
  {
    for (const Index v : cuts)
    {
      const std::vector<Index> around = v < complex->NumberOfVertices() ? complex->Neighbors(v) : std::vector<Index>();
      core.insert(core.end(), around.begin(), around.end());
    }
  }
  std::sort(core.begin(), core.end());
  core.erase(std::unique(core.begin(), core.end()), core.end());
  std::vector<InterfaceTriangle> triangles;
  for (const std::int32_t t : before.TrianglesAt(core))
  {
    triangles.push_back(before.Triangle(t));
  }
  if (!improved.Fits(core, triangles))
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
  const std::vector<std::int32_t> replaced = improved.TrianglesAt(core);
  return std::all_of(
           replaced.begin(), replaced.end(), [&](std::int32_t t) { return improved.Ratio(t) >= wantedRatio; }) &&
    VerticesOfCuts(improved, core).empty();
}
}
