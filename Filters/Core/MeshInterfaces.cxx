// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInterfaces.h"

#include "LocalRepair.h"
#include "ManifoldLabels.h"
#include "TetraLabeling.h"

namespace LabelMesh
{
namespace
{
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

/// Counts what is wrong with a mesh.
void Judge(
  const std::vector<Particle>& particles, const InterfaceComplex& complex, double wantedRatio, MeshResult& result)
{
  result.Tetrahedra = complex.Tetrahedra.Size();
  result.EmptySets = complex.Labels.EmptySets;
  result.NonManifoldEdges = Index(NonManifoldEdges(complex.Faces).size());
  result.NonManifoldVertices = Index(NonManifoldVertices(complex.Faces).size());
  result.WrongFaces = result.BadTriangles = 0;
  result.WorstRatio = 1.0;
  for (const InterfaceTriangle& face : complex.Faces)
  {
    const double ratio = RadiusRatio(
      particles[face.Vertices[0]].Position, particles[face.Vertices[1]].Position, particles[face.Vertices[2]].Position);
    result.WorstRatio = std::min(result.WorstRatio, ratio);
    result.BadTriangles += ratio < wantedRatio;
    result.WrongFaces += IsWrong(particles, face);
  }
}
}

MeshResult MeshInterfaces(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const MeshOptions& options, const Monitor& monitor)
{
  MeshResult result;
  std::vector<Particle> current = particles;
  monitor.Step(0.0, "Tetrahedralising");
  InterfaceComplex complex = BuildInterface(indicators, current);
  for (; result.Rounds < options.RepairRounds; ++result.Rounds)
  {
    const std::vector<BadSite> sites = FindBadSites(current, complex.Faces, options.RepairBelow);
    if (sites.empty())
    {
      break;
    }
    const Monitor round = monitor.Part(
      double(result.Rounds + 1) / (options.RepairRounds + 1), double(result.Rounds + 2) / (options.RepairRounds + 1));
    LocalRepair repair(indicators, current, options.RepairBelow);
    Index mended = 0;
    for (std::size_t n = 0; n < sites.size(); ++n)
    {
      round.Step(double(n) / double(sites.size()), "Repairing");
      mended += repair.Mend(sites[n]);
    }
    repair.Finish();
    if (mended == 0)
    {
      break;
    }
    complex = BuildInterface(indicators, current);
  }
  Judge(current, complex, options.RepairBelow, result);
  result.Mesh = Compact(current, std::move(complex.Faces));
  monitor.Step(1.0);
  return result;
}
}
