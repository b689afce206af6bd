// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInterfaces.h"

#include "ChordCorrection.h"
#include "LocalRepair.h"
#include "ManifoldLabels.h"
#include "MeshImprovement.h"
#include "SelfIntersections.h"
#include "TetraLabeling.h"

#include <memory>

namespace LabelMesh
{
namespace
{
constexpr double PoorRatio = 0.5; // what repair by particles asks of triangles; the rest is for edits of the mesh

/// Counts what is wrong with a mesh.
void Judge(const InterfaceMesh& mesh, double wantedRatio, MeshResult& result)
{
  result.NonManifoldEdges = Index(NonManifoldEdges(mesh.Triangles).size());
  result.NonManifoldVertices = Index(NonManifoldVertices(mesh.Triangles).size());
  for (const InterfaceTriangle& face : mesh.Triangles)
  {
    const auto& v = face.Vertices;
    const double ratio =
      RadiusRatio(mesh.Vertices[v[0]].Position, mesh.Vertices[v[1]].Position, mesh.Vertices[v[2]].Position);
    result.WorstRatio = std::min(result.WorstRatio, ratio);
    result.BadTriangles += ratio < wantedRatio;
    result.WrongFaces += IsWrong(mesh.Vertices, face);
  }
}

/// The interface of the particles as a complex.
SurfaceComplex Build(
  const IndicatorSet& indicators, std::vector<Particle> particles, MeshResult& result, const Monitor& monitor)
{
  InterfaceComplex interface = BuildInterface(indicators, particles, {}, monitor);
  result.Tetrahedra = interface.Tetrahedra.Size();
  result.EmptySets = interface.Labels.EmptySets;
  return SurfaceComplex({ std::move(particles), std::move(interface.Faces) });
}

/// A vertex where surfaces touch themselves is not worth another tetrahedralisation: each material's own surface is
/// taken apart there.
bool IsPinch(const Fault& fault)
{
  return fault.Vertices.size() == 1;
}

/// Mends what the particles got wrong, until nothing is left or nothing helps. Nearly all faults are mended in their
/// place; for those whose change reaches beyond their patch all particles are tetrahedralised once more.
void RepairFaults(const IndicatorSet& indicators, SurfaceComplex& complex, const MeshOptions& options,
  MeshResult& result, const Monitor& monitor)
{
  using Placing = LocalRepair::Placing;
  std::vector<Fault> faults = FindFaults(complex, indicators.Background());
  if (faults.empty())
  {
    return;
  }
  // It remembers which particles it has deleted, so it is made anew with the complex alone.
  const double wanted = std::min(options.RepairBelow, PoorRatio);
  auto repair = std::make_unique<LocalRepair>(indicators, complex, wanted);
  const auto rebuild = [&]()
  {
    complex = Build(indicators, repair->RemainingParticles(), result, monitor.Part(1.0, 1.0));
    repair = std::make_unique<LocalRepair>(indicators, complex, wanted);
    faults = FindFaults(complex, indicators.Background());
  };
  const auto pass = [&](Placing placing)
  {
    Index mended = 0;
    for (std::size_t n = 0; n < faults.size(); ++n)
    {
      monitor.Step((result.Rounds + double(n) / double(faults.size())) / options.RepairRounds, "Repairing");
      mended += repair->Mend(faults[n], placing);
    }
    return mended;
  };
  bool replaced = false;
  for (; result.Rounds < options.RepairRounds && !faults.empty(); ++result.Rounds)
  {
    if (pass(Placing::Faces) > 0)
    {
      replaced = true;
      faults = FindFaults(complex, indicators.Background());
      continue;
    }
    if (std::all_of(faults.begin(), faults.end(), IsPinch))
    {
      return;
    }
    if (replaced)
    {
      rebuild();
      replaced = false;
    }
    if (pass(Placing::Particles) == 0)
    {
      return;
    }
    rebuild();
  }
}

/// Puts the particles of the volume's faces there exactly: on the way through world coordinates they may have lost
/// bits.
void SnapToBorder(const VolumeBox& border, std::vector<Particle>& particles)
{
  for (Particle& p : particles)
  {
    border.Snap(p.Materials.begin(), p.Materials.Size(), p.Position);
  }
}

/// The space beyond the faces of the volume's box becomes background.
void CallBackground(MaterialId background, InterfaceMesh& mesh)
{
  for (Particle& p : mesh.Vertices)
  {
    MaterialSet materials;
    for (const MaterialId m : p.Materials)
    {
      materials.Insert(IsBorder(m) ? background : m);
    }
    p.Materials = materials;
  }
  for (InterfaceTriangle& triangle : mesh.Triangles)
  {
    for (MaterialId& m : triangle.Materials)
    {
      m = IsBorder(m) ? background : m;
    }
  }
}

/// The vertices of triangles that cut each other, ascending; where `near` is not empty (ascending), only of cuts with
/// triangles at those vertices.
std::vector<Index> VerticesOfCuts(const SurfaceComplex& complex, const std::vector<Index>& near = {})
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

/// Puts what is around cuts back to what it was before it was improved, triangles and positions. False, and the
/// improved mesh is of no use, where that does not fit what is around it now, or leaves a poor triangle or a cut.
bool PutBack(const SurfaceComplex& before, const std::vector<Index>& cuts, SurfaceComplex& improved)
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
           replaced.begin(), replaced.end(), [&](std::int32_t t) { return improved.Ratio(t) >= PoorRatio; }) &&
    VerticesOfCuts(improved, core).empty();
}

/// Improves the mesh and corrects its chords. The faces of Delaunay tetrahedra do not cut each other: where improved
/// ones do, the mesh is put back to what it was; where that cannot be done it stays there as it was while the rest is
/// improved again.
void ImproveWithoutCuts(const IndicatorSet& indicators, SurfaceComplex& complex, const MeshOptions& options,
  MeshResult& result, const Monitor& monitor)
{
  constexpr int attempts = 5;
  ImproveOptions improve;
  improve.Passes = options.ImprovePasses;
  improve.WantedRatio = options.RepairBelow;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    SurfaceComplex improved = complex;
    ImproveMesh(
      indicators, improved, improve, monitor.Part(double(attempt) / attempts, double(attempt + 1) / attempts));
    if (options.CorrectChords)
    {
      CorrectChords(indicators, improved, options.RepairBelow);
    }
    std::vector<Index> frozen = VerticesOfCuts(improved);
    result.KeptFromCutting += Index(frozen.size());
    if (frozen.empty() || PutBack(complex, frozen, improved))
    {
      complex = std::move(improved);
      return;
    }
    frozen.erase(std::lower_bound(frozen.begin(), frozen.end(), complex.NumberOfVertices()), frozen.end());
    for (int ring = 0; ring <= attempt; ++ring)
    {
      std::vector<Index> around;
      for (const Index v : frozen)
      {
        complex.Freeze(v);
        const std::vector<Index> neighbors = complex.Neighbors(v);
        around.insert(around.end(), neighbors.begin(), neighbors.end());
      }
      frozen.swap(around);
    }
  }
}
}

MeshResult MeshInterfaces(
  const IndicatorSet& indicators, std::vector<Particle> particles, const MeshOptions& options, const Monitor& monitor)
{
  MeshResult result;
  if (indicators.Border())
  {
    SnapToBorder(*indicators.Border(), particles);
  }
  SurfaceComplex complex = Build(indicators, std::move(particles), result, monitor.Part(0.0, 0.5));
  monitor.Step(0.5, "Repairing");
  RepairFaults(indicators, complex, options, result, monitor.Part(0.5, 0.6));
  ImproveWithoutCuts(indicators, complex, options, result, monitor.Part(0.6, 0.9));
  result.Mesh = std::move(complex).Compacted();
  if (indicators.Border())
  {
    CallBackground(indicators.Background(), result.Mesh);
  }
  Judge(result.Mesh, options.RepairBelow, result);
  monitor.Step(1.0);
  return result;
}
}
