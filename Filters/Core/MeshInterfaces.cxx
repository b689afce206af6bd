// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInterfaces.h"

#include "ChordCorrection.h"
#include "FaultRefinement.h"
#include "LocalRepair.h"
#include "ManifoldLabels.h"
#include "MeshCuts.h"
#include "MeshImprovement.h"
#include "TetraLabeling.h"
#include "VolumeCorrection.h"

#include <algorithm>
#include <functional>
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

std::vector<Fault> AllFaults(const IndicatorSet& indicators, const SurfaceComplex& complex)
{
  return FindFaults(complex, indicators.Background());
}

/// The faults that make a mesh invalid: wrong faces and non-manifold edges.
std::vector<Fault> GraveFaults(const IndicatorSet& indicators, const SurfaceComplex& complex)
{
  std::vector<Fault> faults = AllFaults(indicators, complex);
  faults.erase(std::remove_if(faults.begin(), faults.end(),
                 [&](const Fault& fault)
                 {
                   const std::vector<Index>& v = fault.Vertices;
                   return IsPinch(fault) ||
                     (v.size() == 3 && !IsWrong(complex.AllVertices(), { { v[0], v[1], v[2] }, fault.Materials }));
                 }),
    faults.end());
  return faults;
}

using Faults = std::function<std::vector<Fault>(const IndicatorSet&, const SurfaceComplex&)>;

/// Mends what the particles got wrong, until nothing is left or nothing helps. Nearly all faults are mended in their
/// place; for those whose change reaches beyond their patch all particles are tetrahedralised once more. Adds the
/// rounds to the result's; returns what knows the particles that are left.
std::unique_ptr<LocalRepair> MendFaults(const IndicatorSet& indicators, const Faults& find, int rounds,
  double wantedRatio, SurfaceComplex& complex, MeshResult& result, const Monitor& monitor)
{
  using Placing = LocalRepair::Placing;
  std::vector<Fault> faults = find(indicators, complex);
  // It remembers which particles it has deleted, so it is made anew with the complex alone.
  auto repair = std::make_unique<LocalRepair>(indicators, complex, wantedRatio);
  const auto rebuild = [&]()
  {
    complex = Build(indicators, repair->RemainingParticles(), result, monitor.Part(1.0, 1.0));
    repair = std::make_unique<LocalRepair>(indicators, complex, wantedRatio);
    faults = find(indicators, complex);
  };
  int round = 0;
  const auto pass = [&](Placing placing)
  {
    Index mended = 0;
    for (std::size_t n = 0; n < faults.size(); ++n)
    {
      monitor.Step((round + double(n) / double(faults.size())) / rounds, "Repairing");
      mended += repair->Mend(faults[n], placing);
    }
    return mended;
  };
  bool replaced = false;
  for (; round < rounds && !faults.empty(); ++round, ++result.Rounds)
  {
    if (pass(Placing::Faces) > 0)
    {
      replaced = true;
      faults = find(indicators, complex);
      continue;
    }
    if (std::all_of(faults.begin(), faults.end(), IsPinch))
    {
      break;
    }
    if (replaced)
    {
      rebuild();
      replaced = false;
    }
    if (pass(Placing::Particles) == 0)
    {
      break;
    }
    rebuild();
  }
  return repair;
}

/// Mends what the particles got wrong; where grave faults stay there become twice as many particles along each axis
/// around them, and again. The mesh with the fewest grave faults is kept, the first of those.
void RepairFaults(const IndicatorSet& indicators, SurfaceComplex& complex, const MeshOptions& options,
  MeshResult& result, const Monitor& monitor)
{
  constexpr int refinements = 4, refinedRounds = 2;
  constexpr std::size_t mostFaults = 12;
  if (options.RepairRounds == 0 || AllFaults(indicators, complex).empty())
  {
    return;
  }
  const double wanted = std::min(options.RepairBelow, PoorRatio);
  const std::unique_ptr<LocalRepair> repair =
    MendFaults(indicators, AllFaults, options.RepairRounds, wanted, complex, result, monitor.Part(0.0, 0.5));
  std::vector<Fault> faults = GraveFaults(indicators, complex);
  if (faults.empty())
  {
    return;
  }
  std::vector<Particle> particles = repair->RemainingParticles();
  std::size_t least = faults.size();
  SurfaceComplex current = complex;
  for (int n = 0; n < refinements && least > 0; ++n)
  {
    const std::vector<Particle> added = ParticlesAround(indicators, current, faults);
    if (added.empty())
    {
      return;
    }
    particles.insert(particles.end(), added.begin(), added.end());
    MeshResult attempt = result;
    const double start = 0.5 + 0.5 * n / refinements, end = 0.5 + 0.5 * (n + 1) / refinements;
    current = Build(indicators, std::move(particles), attempt, monitor.Part(start, start));
    if (GraveFaults(indicators, current).size() > mostFaults)
    {
      return; // it makes things worse, and mending hundreds takes minutes
    }
    particles = MendFaults(indicators, GraveFaults, refinedRounds, wanted, current, attempt, monitor.Part(start, end))
                  ->RemainingParticles();
    faults = GraveFaults(indicators, current);
    result.Rounds = attempt.Rounds;
    if (faults.size() < least)
    {
      least = faults.size();
      result = attempt;
      complex = current;
    }
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
    if (!options.WantedVolumes.empty())
    {
      CorrectVolumes(indicators, options.WantedVolumes, options.RepairBelow, improved);
    }
    const std::vector<Cut> cuts = FindCuts(improved);
    std::vector<Index> frozen = VerticesOf(cuts);
    if (PutBack(complex, cuts, PoorRatio, improved))
    {
      result.KeptFromCutting = Index(frozen.size()) + complex.NumberOfFrozen();
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
  result.KeptFromCutting = complex.NumberOfVertices(); // nothing could be improved
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
  result.KeptFromCutting = std::min(result.KeptFromCutting, Index(result.Mesh.Vertices.size()));
  if (indicators.Border())
  {
    CallBackground(indicators.Background(), result.Mesh);
  }
  Judge(result.Mesh, options.RepairBelow, result);
  monitor.Step(1.0);
  return result;
}
}
