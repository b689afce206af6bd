// SPDX-License-Identifier: BSD-3-Clause
// The changes that LocalRepair tries.
#include "LocalRepair.h"

#include "Junction.h"
#include "ParticlePlacement.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
// In target lengths of the site.
constexpr double SameJunction = 0.5;   // as in the sampling of curves
constexpr double MergedJunction = 0.8; // two particles of curves this near may become one to mend a triangle

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
}

std::vector<LocalRepair::Patch> LocalRepair::Variants(
  const Patch& patch, const std::vector<Index>& site, const Fault& fault) const
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
  variant.Core.erase(variant.Core.begin() + v);
  variant.Inner.erase(variant.Inner.begin() + v);
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
    variants.back().Core.push_back(1);
    variants.back().Inner.push_back(1);
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
        this->SnapToBorder(variant.Particles[kept]);
        variants.push_back(Without(variant, gone));
      }
    }
  }
}

void LocalRepair::AppendJunctions(
  const Patch& patch, const std::vector<Index>& site, const Fault& fault, std::vector<Patch>& variants) const
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
        this->SnapToBorder(variants.back().Particles[v]);
      }
    }
  }
}
}
