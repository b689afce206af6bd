// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInterfaces.h"

#include "TetraLabeling.h"

namespace LabelMesh
{
namespace
{
struct Attempt
{
  std::vector<InterfaceTriangle> Faces;
  Index Tetrahedra = 0, EmptySets = 0, NonManifoldEdges = 0;
};

Attempt Triangulate(const IndicatorSet& indicators, const std::vector<Particle>& particles)
{
  std::vector<Vec3> points;
  points.reserve(particles.size());
  for (const Particle& p : particles)
  {
    points.push_back(p.Position);
  }
  const Tetrahedralization tetrahedra = DelaunayTetrahedra(points);
  const MaterialId outside = indicators.Background() != NoMaterial ? indicators.Background() : MaterialId(0);
  TetraLabels labels = LabelTetrahedra(indicators, particles, tetrahedra);
  Attempt attempt;
  attempt.Tetrahedra = tetrahedra.Size();
  attempt.EmptySets = labels.EmptySets;
  attempt.NonManifoldEdges = UntieEdges(particles, tetrahedra, outside, labels);
  attempt.Faces = InterfaceFaces(particles, tetrahedra, labels, outside);
  return attempt;
}

bool Wrong(const std::vector<Particle>& particles, const InterfaceTriangle& face)
{
  for (const Index v : face.Vertices)
  {
    if (!particles[v].Materials.Contains(face.Materials[0]) || !particles[v].Materials.Contains(face.Materials[1]))
    {
      return true;
    }
  }
  return false;
}

/// Keeps the vertices that triangles use, in their order.
InterfaceMesh Compact(const std::vector<Particle>& particles, std::vector<InterfaceTriangle> faces)
{
  std::vector<Index> number(particles.size(), -1);
  for (const InterfaceTriangle& face : faces)
  {
    for (const Index v : face.Vertices)
    {
      number[v] = 0;
    }
  }
  InterfaceMesh mesh;
  for (std::size_t v = 0; v < particles.size(); ++v)
  {
    if (number[v] == 0)
    {
      number[v] = Index(mesh.Vertices.size());
      mesh.Vertices.push_back(particles[v]);
    }
  }
  for (InterfaceTriangle& face : faces)
  {
    for (Index& v : face.Vertices)
    {
      v = number[v];
    }
  }
  mesh.Triangles = std::move(faces);
  return mesh;
}
}

MeshResult MeshInterfaces(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const MeshOptions& options, const Monitor& monitor)
{
  MeshResult result;
  monitor.Step(0.0, "Tetrahedralising");
  Attempt attempt = Triangulate(indicators, particles);
  result.Tetrahedra = attempt.Tetrahedra;
  result.EmptySets = attempt.EmptySets;
  result.NonManifoldEdges = attempt.NonManifoldEdges;
  for (const InterfaceTriangle& face : attempt.Faces)
  {
    const double ratio = RadiusRatio(
      particles[face.Vertices[0]].Position, particles[face.Vertices[1]].Position, particles[face.Vertices[2]].Position);
    result.WorstRatio = std::min(result.WorstRatio, ratio);
    result.BadTriangles += ratio < options.RepairBelow;
    result.WrongFaces += Wrong(particles, face);
  }
  result.Mesh = Compact(particles, std::move(attempt.Faces));
  monitor.Step(1.0);
  return result;
}
}
