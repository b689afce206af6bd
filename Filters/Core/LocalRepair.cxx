// SPDX-License-Identifier: BSD-3-Clause
#include "LocalRepair.h"

#include "Junction.h"
#include "ManifoldLabels.h"
#include "ParticlePlacement.h"
#include "Relaxation.h"
#include "TetraLabeling.h"
#include "TriangleMending.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
// In target lengths of the site.
constexpr double PatchRadius = 5.0; // particles that are tetrahedralised
constexpr double LargestPatch = 30.0;
constexpr double PatchGrowth = 1.4;
constexpr double CoreRadius = 2.5;                     // faces with a vertex within are judged
constexpr double MoveRadius = 2.2;                     // particles within may move
constexpr double InnerPart = CoreRadius / PatchRadius; // of the radius of a patch: what is not at its rim

// Where lengths are shortest they grow fast all around: fewer particles would be the site without its surroundings, and
// the tetrahedra at the rim of the patch would be taken for its faces.
constexpr std::size_t SmallestPatch = 150;
constexpr std::size_t MostOfAPatch = 1000; // particles; a patch with as many grows no more

constexpr int RepairSweeps = 12;

constexpr double SliverRatio = 0.3; // triangles below are where particles are missing or too many

// What a fault costs, beside TriangleFault.
constexpr double WrongFaceCost = 200.0;
constexpr double NonManifoldCost = 120.0;
constexpr double LostPairCost = 80.0;
constexpr double PinchedCost = 60.0;

using Pair = std::array<MaterialId, 2>;

Pair PairOf(const InterfaceTriangle& face)
{
  return { std::min(face.Materials[0], face.Materials[1]), std::max(face.Materials[0], face.Materials[1]) };
}

double RatioOf(const std::vector<Particle>& particles, const InterfaceTriangle& face)
{
  return RadiusRatio(
    particles[face.Vertices[0]].Position, particles[face.Vertices[1]].Position, particles[face.Vertices[2]].Position);
}
}

std::vector<Fault> FindFaults(const SurfaceComplex& complex, MaterialId outside)
{
  const std::vector<InterfaceTriangle> faces = complex.AliveTriangles();
  std::vector<Fault> faults;
  for (const Edge& edge : NonManifoldEdges(faces, outside))
  {
    faults.push_back({ { edge.first, edge.second }, {} });
  }
  for (const Index vertex : NonManifoldVertices(faces, outside))
  {
    faults.push_back({ { vertex }, {} });
  }
  for (const InterfaceTriangle& face : faces)
  {
    if (IsWrong(complex.AllVertices(), face) || RatioOf(complex.AllVertices(), face) < SliverRatio)
    {
      faults.push_back({ { face.Vertices.begin(), face.Vertices.end() }, face.Materials });
    }
  }
  return faults;
}

LocalRepair::LocalRepair(const IndicatorSet& indicators, SurfaceComplex& complex, double wantedRatio)
  : Indicators(indicators)
  , Complex(complex)
  , WantedRatio(wantedRatio)
  , Grid(std::size_t(complex.NumberOfVertices()))
  , Deleted(std::size_t(complex.NumberOfVertices()), 0)
  , ChangedAt(std::size_t(complex.NumberOfVertices()), 0)
{
  for (const Particle& p : complex.AllVertices())
  {
    this->Grid.Insert(p.Position, p.TargetLength);
  }
}

bool LocalRepair::Mend(const Fault& fault, Placing placing)
{
  for (const Index v : fault.Vertices)
  {
    if (this->Deleted[v])
    {
      return false;
    }
  }
  if (this->WasInVain(fault, placing))
  {
    return false;
  }
  Patch patch = this->PatchAround(fault, PatchRadius);
  Judgement before = this->Judge(patch, {});
  bool same = this->AreThoseOfTheWhole(patch, before.Faces);
  // Where particles are missing, the empty balls of the faces are large.
  for (double radius = PatchGrowth * patch.Radius;
       !same && radius < LargestPatch && patch.Ids.size() < MostOfAPatch && this->IsWorthMore(fault);
       radius *= PatchGrowth)
  {
    patch = this->PatchAround(fault, radius);
    before = this->Judge(patch, {});
    same = this->AreThoseOfTheWhole(patch, before.Faces);
  }
  if (before.Badness == 0.0 || !same)
  {
    this->Remember(fault, placing, patch);
    return false;
  }
  std::vector<Index> local;
  for (std::size_t n = 0; n < patch.Ids.size(); ++n)
  {
    if (std::find(fault.Vertices.begin(), fault.Vertices.end(), patch.Ids[n]) != fault.Vertices.end())
    {
      local.push_back(Index(n));
    }
  }
  double best = before.Badness;
  Patch mended;
  Replacement chosen;
  const auto judge = [&](Patch& variant)
  {
    const Judgement judgement = this->Judge(variant, before.Pairs);
    if (judgement.Badness < best)
    {
      Replacement replacement = this->ReplacementBy(patch, variant, judgement.Faces);
      if (placing == Placing::Particles || this->Complex.Fits(replacement.Core, replacement.Faces))
      {
        best = judgement.Badness;
        mended = std::move(variant);
        chosen = std::move(replacement);
      }
    }
    return best == 0.0;
  };
  for (Patch& variant : this->Variants(patch, local, fault))
  {
    this->RelaxCore(variant);
    if (judge(variant))
    {
      break;
    }
  }
  if (best > 0.0)
  {
    // Relaxing evens out distances, which is not always what is wanted: single moves are taken as they are.
    for (Patch& variant : this->Moves(patch, local))
    {
      if (judge(variant))
      {
        break;
      }
    }
  }
  if (best < before.Badness)
  {
    this->Commit(patch, mended, chosen, placing);
    return true;
  }
  this->Remember(fault, placing, patch);
  return false;
}

bool LocalRepair::WasInVain(const Fault& fault, Placing placing) const
{
  const auto attempt = this->InVain.find({ fault.Vertices, fault.Materials, placing });
  return attempt != this->InVain.end() &&
    std::all_of(attempt->second.Patch.begin(), attempt->second.Patch.end(),
      [&](Index v) { return this->ChangedAt[v] <= attempt->second.Time; });
}

void LocalRepair::Remember(const Fault& fault, Placing placing, const Patch& patch)
{
  this->InVain[{ fault.Vertices, fault.Materials, placing }] = { this->Time, patch.Ids };
}

bool LocalRepair::IsWorthMore(const Fault& fault) const
{
  if (fault.Vertices.size() < 3)
  {
    return fault.Vertices.size() == 2;
  }
  const std::vector<Index>& v = fault.Vertices;
  return IsWrong(this->Complex.AllVertices(), { { v[0], v[1], v[2] }, fault.Materials });
}

LocalRepair::Patch LocalRepair::PatchAround(const Fault& fault, double leastRadius) const
{
  Patch patch;
  patch.Centre.setZero();
  for (const Index v : fault.Vertices)
  {
    patch.Centre += this->Complex.Vertex(v).Position / double(fault.Vertices.size());
    patch.Length += this->Complex.Vertex(v).TargetLength / double(fault.Vertices.size());
  }
  for (double radius = leastRadius; radius < LargestPatch && patch.Ids.size() < SmallestPatch; radius *= PatchGrowth)
  {
    patch.Radius = radius;
    patch.Ids.clear();
    this->Grid.VisitWithin(patch.Centre, radius * patch.Length, 0.0,
      [&](Index n, double)
      {
        if (!this->Deleted[n])
        {
          patch.Ids.push_back(n);
        }
      });
  }
  std::sort(patch.Ids.begin(), patch.Ids.end());
  const double reach = CoreRadius * patch.Length, inner = InnerPart * patch.Radius * patch.Length;
  for (const Index n : patch.Ids)
  {
    patch.Particles.push_back(this->Complex.Vertex(n));
    const double squared = (this->Complex.Vertex(n).Position - patch.Centre).squaredNorm();
    patch.Core.push_back(squared < reach * reach);
    patch.Inner.push_back(squared < inner * inner);
  }
  return patch;
}

LocalRepair::Judgement LocalRepair::Judge(const Patch& patch, const std::vector<Pair>& wantedPairs) const
{
  const InterfaceComplex complex = BuildInterface(this->Indicators, patch.Particles, patch.Inner);
  Judgement result;
  for (const InterfaceTriangle& face : complex.Faces)
  {
    if (patch.Core[face.Vertices[0]] || patch.Core[face.Vertices[1]] || patch.Core[face.Vertices[2]])
    {
      result.Badness += TriangleFault(RatioOf(patch.Particles, face), this->WantedRatio);
      result.Badness += IsWrong(patch.Particles, face) ? WrongFaceCost : 0.0;
      result.Pairs.push_back(PairOf(face));
      result.Faces.push_back(face);
    }
  }
  for (const Edge& edge : NonManifoldEdges(complex.Faces, this->Indicators.Background()))
  {
    result.Badness += patch.Core[edge.first] || patch.Core[edge.second] ? NonManifoldCost : 0.0;
  }
  for (const Index vertex : NonManifoldVertices(complex.Faces, this->Indicators.Background()))
  {
    result.Badness += patch.Core[vertex] ? PinchedCost : 0.0;
  }
  std::sort(result.Pairs.begin(), result.Pairs.end());
  result.Pairs.erase(std::unique(result.Pairs.begin(), result.Pairs.end()), result.Pairs.end());
  for (const Pair& pair : wantedPairs)
  {
    result.Badness += std::binary_search(result.Pairs.begin(), result.Pairs.end(), pair) ? 0.0 : LostPairCost;
  }
  return result;
}

bool LocalRepair::AreThoseOfTheWhole(const Patch& patch, const std::vector<InterfaceTriangle>& faces) const
{
  std::vector<std::array<Index, 5>> local, whole;
  const auto append = [](std::array<Index, 3> v, const InterfaceTriangle& face, std::vector<std::array<Index, 5>>& to)
  {
    std::sort(v.begin(), v.end());
    const Pair pair = PairOf(face);
    to.push_back({ v[0], v[1], v[2], pair[0], pair[1] });
  };
  for (const InterfaceTriangle& face : faces)
  {
    append({ patch.Ids[face.Vertices[0]], patch.Ids[face.Vertices[1]], patch.Ids[face.Vertices[2]] }, face, local);
  }
  for (std::size_t n = 0; n < patch.Ids.size(); ++n)
  {
    for (const std::int32_t t : patch.Core[n] ? this->Complex.Star(patch.Ids[n]) : std::vector<std::int32_t>())
    {
      append(this->Complex.Triangle(t).Vertices, this->Complex.Triangle(t), whole);
    }
  }
  std::sort(local.begin(), local.end());
  std::sort(whole.begin(), whole.end());
  whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
  return local == whole;
}

void LocalRepair::SnapToBorder(Particle& particle) const
{
  if (this->Indicators.Border())
  {
    this->Indicators.Border()->Snap(particle.Materials.begin(), particle.Materials.Size(), particle.Position);
  }
}

void LocalRepair::RelaxCore(Patch& patch) const
{
  const double reach = MoveRadius * patch.Length;
  std::vector<Index> moving;
  for (std::size_t n = 0; n < patch.Particles.size(); ++n)
  {
    const Particle& p = patch.Particles[n];
    if (p.CellDimension == 2 && (p.Position - patch.Centre).squaredNorm() < reach * reach)
    {
      moving.push_back(Index(n));
    }
  }
  RelaxOptions options;
  options.Sweeps = RepairSweeps;
  Relax(this->Indicators, nullptr, patch.Particles, moving, options);
}

LocalRepair::Replacement LocalRepair::ReplacementBy(
  const Patch& before, const Patch& after, const std::vector<InterfaceTriangle>& faces) const
{
  Replacement replacement;
  Index next = this->Complex.NumberOfVertices();
  for (std::size_t n = 0; n < after.Ids.size(); ++n)
  {
    replacement.Numbers.push_back(after.Ids[n] < 0 ? next++ : after.Ids[n]);
    if (after.Core[n])
    {
      replacement.Core.push_back(replacement.Numbers.back());
    }
  }
  for (std::size_t n = 0; n < before.Ids.size(); ++n)
  {
    if (before.Core[n])
    {
      replacement.Core.push_back(before.Ids[n]); // the deleted ones too
    }
  }
  std::sort(replacement.Core.begin(), replacement.Core.end());
  replacement.Core.erase(std::unique(replacement.Core.begin(), replacement.Core.end()), replacement.Core.end());
  replacement.Faces = faces;
  for (InterfaceTriangle& face : replacement.Faces)
  {
    for (Index& v : face.Vertices)
    {
      v = replacement.Numbers[v];
    }
  }
  return replacement;
}

void LocalRepair::Commit(const Patch& before, const Patch& after, const Replacement& replacement, Placing placing)
{
  for (std::size_t n = 0; n < after.Ids.size(); ++n)
  {
    if (after.Ids[n] < 0)
    {
      this->Complex.AddVertex(after.Particles[n]);
      this->Grid.Insert(after.Particles[n].Position, after.Particles[n].TargetLength);
      this->Deleted.push_back(0);
      this->ChangedAt.push_back(0);
    }
    else
    {
      this->Complex.SetVertex(after.Ids[n], after.Particles[n]);
    }
  }
  if (placing == Placing::Faces)
  {
    this->Complex.ReplaceStars(replacement.Core, replacement.Faces);
  }
  ++this->Time;
  for (const Index v : replacement.Core)
  {
    this->ChangedAt[v] = this->Time;
  }
  std::vector<Index> kept = replacement.Numbers;
  std::sort(kept.begin(), kept.end());
  for (const Index n : before.Ids)
  {
    this->Deleted[n] = !std::binary_search(kept.begin(), kept.end(), n);
  }
}

std::vector<Particle> LocalRepair::RemainingParticles() const
{
  std::vector<Particle> remaining;
  for (Index v = 0; v < this->Complex.NumberOfVertices(); ++v)
  {
    if (!this->Deleted[v])
    {
      remaining.push_back(this->Complex.Vertex(v));
    }
  }
  return remaining;
}
}
