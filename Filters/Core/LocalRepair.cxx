// SPDX-License-Identifier: BSD-3-Clause
#include "LocalRepair.h"

#include "Junction.h"
#include "ManifoldLabels.h"
#include "Relaxation.h"
#include "TetraLabeling.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
// In target lengths of the site.
constexpr double PatchRadius = 5.0; // particles that are tetrahedralised
constexpr double LargestPatch = 30.0;
constexpr double CoreRadius = 2.5; // faces with a vertex within are judged
constexpr double MoveRadius = 2.2; // particles within may move

constexpr double SameJunction = 0.5;   // as in the sampling of curves
constexpr double MergedJunction = 0.8; // two particles of curves this near may become one to mend a triangle

// Where lengths are shortest they grow fast all around: fewer particles would be the site without its surroundings, and
// the tetrahedra at the rim of the patch would be taken for its faces.
constexpr std::size_t SmallestPatch = 150;

constexpr int RepairSweeps = 12;

// What a fault costs. A triangle below the wanted ratio costs 1 and up to 111: rather several that lack a little than
// one that lacks much.
constexpr double WorstCost = 100.0;
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

/// The materials that two sets share, or all of both.
MaterialSet Common(const MaterialSet& a, const MaterialSet& b)
{
  MaterialSet common;
  for (const MaterialId m : a)
  {
    if (b.Contains(m))
    {
      common.Insert(m);
    }
  }
  return common;
}
MaterialSet United(const MaterialSet& a, const MaterialSet& b)
{
  MaterialSet united = a;
  for (const MaterialId m : b)
  {
    united.Insert(m);
  }
  return united;
}

/// A particle on the junction of exactly these two or three materials near x; false where there is none.
bool PlaceOnJunction(
  const IndicatorSet& indicators, const MaterialSet& materials, const Vec3& x, double length, Particle& particle)
{
  particle = Particle();
  particle.TargetLength = length;
  particle.Materials = materials;
  if (materials.Size() == 2)
  {
    return PutOnInterface(indicators, materials[0], materials[1], x, length, particle);
  }
  const Projection p = ProjectToJunction(indicators, materials.begin(), 3, x);
  const RankedMaterial rival = indicators.LargestBut(p.Position, materials.begin(), 3);
  particle.Position = p.Position;
  particle.Residual = p.Residual;
  particle.CellDimension = 1;
  return p.Converged && (p.Position - x).norm() < length &&
    (rival.Material == NoMaterial || rival.Value <= indicators.Value(materials[0], p.Position));
}
}

std::vector<BadSite> FindBadSites(
  const std::vector<Particle>& particles, const std::vector<InterfaceTriangle>& faces, double wantedRatio)
{
  std::vector<BadSite> sites;
  for (const Edge& edge : NonManifoldEdges(faces))
  {
    sites.push_back({ { edge.first, edge.second }, {} });
  }
  for (const Index vertex : NonManifoldVertices(faces))
  {
    sites.push_back({ { vertex }, {} });
  }
  for (const InterfaceTriangle& face : faces)
  {
    if (IsWrong(particles, face) || RatioOf(particles, face) < wantedRatio)
    {
      sites.push_back({ { face.Vertices.begin(), face.Vertices.end() }, face.Materials });
    }
  }
  return sites;
}

LocalRepair::LocalRepair(const IndicatorSet& indicators, std::vector<Particle>& particles, double wantedRatio)
  : Indicators(indicators)
  , Particles(particles)
  , WantedRatio(wantedRatio)
  , Grid(particles.size())
  , Touched(particles.size(), 0)
  , Deleted(particles.size(), 0)
{
  for (const Particle& p : particles)
  {
    this->Grid.Insert(p.Position, p.TargetLength);
  }
}

bool LocalRepair::Mend(const BadSite& site)
{
  for (const Index v : site.Vertices)
  {
    if (this->Touched[v])
    {
      return false;
    }
  }
  const Patch patch = this->PatchAround(site);
  std::vector<Pair> pairs;
  const double before = this->Badness(patch, nullptr, &pairs);
  std::vector<Index> local;
  for (std::size_t n = 0; n < patch.Ids.size(); ++n)
  {
    if (std::find(site.Vertices.begin(), site.Vertices.end(), patch.Ids[n]) != site.Vertices.end())
    {
      local.push_back(Index(n));
    }
  }
  double best = before;
  Patch mended;
  const auto judge = [&](Patch& variant)
  {
    const double badness = this->Badness(variant, &pairs, nullptr);
    if (badness < best)
    {
      best = badness;
      mended = std::move(variant);
    }
    return best == 0.0;
  };
  for (Patch& variant : this->Variants(patch, local, site))
  {
    this->RelaxCore(variant);
    if (judge(variant))
    {
      break;
    }
  }
  if (best > 0.0)
  {
    // Relaxing evens out distances, which is not always what the worst triangle wants: single moves are taken as they
    // are.
    for (Patch& variant : this->Moves(patch, local))
    {
      if (judge(variant))
      {
        break;
      }
    }
  }
  if (best < before)
  {
    this->Commit(patch, mended);
  }
  return best < before;
}

LocalRepair::Patch LocalRepair::PatchAround(const BadSite& site) const
{
  Patch patch;
  patch.Centre.setZero();
  for (const Index v : site.Vertices)
  {
    patch.Centre += this->Particles[v].Position / double(site.Vertices.size());
    patch.Length += this->Particles[v].TargetLength / double(site.Vertices.size());
  }
  for (double radius = PatchRadius; radius < LargestPatch && patch.Ids.size() < SmallestPatch; radius *= 1.4)
  {
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
  for (const Index n : patch.Ids)
  {
    patch.Particles.push_back(this->Particles[n]);
  }
  return patch;
}

double LocalRepair::Badness(const Patch& patch, const std::vector<Pair>* wantedPairs, std::vector<Pair>* pairs) const
{
  const InterfaceComplex complex = BuildInterface(this->Indicators, patch.Particles);
  const double reach = CoreRadius * patch.Length;
  const auto inCore = [&](Index v)
  { return (patch.Particles[v].Position - patch.Centre).squaredNorm() < reach * reach; };
  double badness = 0.0;
  std::vector<Pair> present;
  for (const InterfaceTriangle& face : complex.Faces)
  {
    if (!inCore(face.Vertices[0]) && !inCore(face.Vertices[1]) && !inCore(face.Vertices[2]))
    {
      continue;
    }
    const double ratio = RatioOf(patch.Particles, face);
    const double lack = std::max(0.0, 1.0 - ratio / this->WantedRatio);
    badness += lack > 0.0 ? 1.0 + 10.0 * lack + WorstCost * lack * lack : 0.0;
    badness += IsWrong(patch.Particles, face) ? WrongFaceCost : 0.0;
    present.push_back(PairOf(face));
  }
  for (const Edge& edge : NonManifoldEdges(complex.Faces))
  {
    badness += inCore(edge.first) || inCore(edge.second) ? NonManifoldCost : 0.0;
  }
  for (const Index vertex : NonManifoldVertices(complex.Faces))
  {
    badness += inCore(vertex) ? PinchedCost : 0.0;
  }
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  if (wantedPairs)
  {
    for (const Pair& pair : *wantedPairs)
    {
      badness += std::binary_search(present.begin(), present.end(), pair) ? 0.0 : LostPairCost;
    }
  }
  if (pairs)
  {
    *pairs = present;
  }
  return badness;
}

std::vector<LocalRepair::Patch> LocalRepair::Variants(
  const Patch& patch, const std::vector<Index>& site, const BadSite& fault) const
{
  std::vector<Patch> variants{ patch }; // relaxing alone
  this->AppendDeletions(patch, site, variants);
  this->AppendInsertions(patch, site, variants);
  this->AppendSlides(patch, site, variants);
  this->AppendJunctions(patch, site, fault, variants);
  this->AppendCollapses(patch, site, variants);
  return variants;
}

LocalRepair::Patch LocalRepair::Without(const Patch& patch, Index v)
{
  Patch variant = patch;
  variant.Particles.erase(variant.Particles.begin() + v);
  variant.Ids.erase(variant.Ids.begin() + v);
  return variant;
}

void LocalRepair::AppendWith(
  const Patch& base, const MaterialSet& materials, const Vec3& x, double length, std::vector<Patch>& variants) const
{
  Particle added;
  if (PlaceOnJunction(this->Indicators, materials, x, length, added))
  {
    variants.push_back(base);
    variants.back().Particles.push_back(added);
    variants.back().Ids.push_back(-1);
  }
}

void LocalRepair::AppendDeletions(
  const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const
{
  // The vertices of the highest cells first: surfaces have particles to spare, curves less.
  std::vector<Index> order = site;
  std::stable_sort(order.begin(), order.end(),
    [&](Index a, Index b) { return patch.Particles[a].CellDimension > patch.Particles[b].CellDimension; });
  for (const Index v : order)
  {
    if (patch.Particles[v].CellDimension > 0)
    {
      variants.push_back(Without(patch, v));
    }
  }
}

void LocalRepair::AppendInsertions(
  const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const
{
  for (std::size_t a = 0; a < site.size(); ++a)
  {
    for (std::size_t b = a + 1; b < site.size(); ++b)
    {
      const Particle &p = patch.Particles[site[a]], &q = patch.Particles[site[b]];
      const Vec3 middle = 0.5 * (p.Position + q.Position);
      const double length = std::min(p.TargetLength, q.TargetLength);
      const MaterialSet common = Common(p.Materials, q.Materials), united = United(p.Materials, q.Materials);
      if (common.Size() == 2 || common.Size() == 3)
      {
        this->AppendWith(patch, common, middle, length, variants);
      }
      if (common.Size() == 2 && p.CellDimension == 2 && q.CellDimension == 2)
      {
        this->AppendWith(Without(patch, std::max(site[a], site[b])), common, middle, length, variants);
      }
      if (united.Size() == 3)
      {
        // Where a face crosses a curve, the curve wants a particle there; its neighbour on the surface may be in the
        // way.
        this->AppendWith(patch, united, middle, length, variants);
        this->AppendWith(Without(patch, p.CellDimension == 2 ? site[a] : site[b]), united, middle, length, variants);
      }
    }
  }
}

void LocalRepair::AppendSlides(const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const
{
  for (const Index v : site)
  {
    const Particle& p = patch.Particles[v];
    if (p.CellDimension != 1 || p.Materials.Size() != 3)
    {
      continue;
    }
    const Vec3 tangent = CurveTangent(this->Indicators, p.Materials.begin(), p.Position);
    for (const double slide : { 0.2, -0.2, 0.4, -0.4 })
    {
      Particle moved;
      if (PlaceOnJunction(
            this->Indicators, p.Materials, p.Position + slide * p.TargetLength * tangent, p.TargetLength, moved))
      {
        variants.push_back(patch);
        variants.back().Particles[v] = moved;
      }
    }
  }
}

std::vector<LocalRepair::Patch> LocalRepair::Moves(const Patch& patch, const std::vector<Index>& site) const
{
  constexpr int directions = 8;
  std::vector<Patch> variants;
  for (const Index v : site)
  {
    const Particle& p = patch.Particles[v];
    for (int n = 0; p.CellDimension == 2 && n < 2 * directions; ++n)
    {
      const double angle = 2.0 * M_PI * (n % directions) / directions, length = n < directions ? 0.15 : 0.3;
      const Vec3 u = p.Normal.unitOrthogonal(), w = p.Normal.cross(u);
      const Vec3 target = p.Position + length * p.TargetLength * (std::cos(angle) * u + std::sin(angle) * w);
      Particle moved;
      if (PlaceOnJunction(this->Indicators, p.Materials, target, p.TargetLength, moved))
      {
        variants.push_back(patch);
        variants.back().Particles[v] = moved;
      }
    }
  }
  return variants;
}

void LocalRepair::AppendCollapses(
  const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const
{
  for (const Index kept : site)
  {
    for (const Index gone : site)
    {
      const Particle &p = patch.Particles[kept], &q = patch.Particles[gone];
      if (kept == gone || p.CellDimension == 2 || q.CellDimension == 2 || p.Materials.Size() < q.Materials.Size())
      {
        continue;
      }
      const MaterialSet united = United(p.Materials, q.Materials);
      const bool fits =
        std::all_of(q.Materials.begin(), q.Materials.end(), [&](MaterialId m) { return united.Contains(m); });
      const double most = MergedJunction * std::min(p.TargetLength, q.TargetLength);
      if (fits && (p.Position - q.Position).norm() < most)
      {
        Patch variant = patch;
        variant.Particles[kept].Materials = united;
        variant.Particles[kept].CellDimension = std::min(p.CellDimension, q.CellDimension);
        variants.push_back(Without(variant, gone));
      }
    }
  }
}

void LocalRepair::AppendJunctions(
  const Patch& patch, const std::vector<Index>& site, const BadSite& fault, std::vector<Patch>& variants) const
{
  Vec3 centroid = Vec3::Zero();
  for (const Index v : site)
  {
    centroid += patch.Particles[v].Position / double(site.size());
  }
  for (const Index v : site)
  {
    const Particle& p = patch.Particles[v];
    for (const MaterialId lacking : fault.Materials)
    {
      if (lacking == NoMaterial || p.Materials.Contains(lacking))
      {
        continue;
      }
      // The face reaches beyond a curve of `lacking`, its other material and one of the vertex.
      for (const MaterialId m : p.Materials)
      {
        MaterialSet curve;
        curve.Insert(m);
        curve.Insert(fault.Materials[0]);
        curve.Insert(fault.Materials[1]);
        if (curve.Size() == 3)
        {
          this->AppendWith(patch, curve, centroid, p.TargetLength, variants);
        }
      }
      // Or the vertex is closer to `lacking` than junctions are told apart.
      Vec3 own, other;
      const double gap = this->Indicators.ValueAndGradient(p.Materials[0], p.Position, own) -
        this->Indicators.ValueAndGradient(lacking, p.Position, other);
      if (gap < SameJunction * p.TargetLength * (own - other).norm())
      {
        variants.push_back(patch);
        variants.back().Particles[v].Materials.Insert(lacking);
        variants.back().Particles[v].CellDimension = p.CellDimension == 2 ? 1 : 0;
      }
    }
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

void LocalRepair::Commit(const Patch& before, const Patch& after)
{
  for (const Index n : before.Ids)
  {
    const double distance = (this->Particles[n].Position - before.Centre).norm();
    this->Touched[n] = this->Touched[n] || distance < (CoreRadius + MoveRadius) * before.Length;
  }
  std::vector<char> kept(before.Ids.size(), 0);
  for (std::size_t n = 0; n < after.Ids.size(); ++n)
  {
    if (after.Ids[n] < 0)
    {
      this->Particles.push_back(after.Particles[n]);
      this->Touched.push_back(1);
      this->Deleted.push_back(0);
      this->Grid.Insert(after.Particles[n].Position, after.Particles[n].TargetLength);
      continue;
    }
    this->Particles[after.Ids[n]] = after.Particles[n];
    kept[std::lower_bound(before.Ids.begin(), before.Ids.end(), after.Ids[n]) - before.Ids.begin()] = 1;
  }
  for (std::size_t n = 0; n < kept.size(); ++n)
  {
    this->Deleted[before.Ids[n]] = !kept[n];
  }
}

void LocalRepair::Finish()
{
  std::size_t kept = 0;
  for (std::size_t n = 0; n < this->Particles.size(); ++n)
  {
    if (!this->Deleted[n])
    {
      this->Particles[kept++] = this->Particles[n];
    }
  }
  this->Particles.resize(kept);
}
}
