// SPDX-License-Identifier: BSD-3-Clause
#include "FaultRefinement.h"

#include "ManifoldLabels.h"
#include "ParticlePlacement.h"

#include <algorithm>
#include <set>

namespace LabelMesh
{
namespace
{
constexpr double LeastDistance = 0.25; // of an edge's length, between a new particle and any other

class Refinement
{
public:
  Refinement(const IndicatorSet& indicators, const SurfaceComplex& complex)
    : Indicators(indicators)
    , Complex(complex)
  {
  }

  void Around(const Fault& fault)
  {
    std::vector<Index> near = fault.Vertices;
    for (int ring = 0; ring < 2; ++ring)
    {
      std::set<Index> grown;
      for (const std::int32_t t : this->Complex.TrianglesAt(near))
      {
        const auto& v = this->Complex.Triangle(t).Vertices;
        grown.insert(v.begin(), v.end());
      }
      near.assign(grown.begin(), grown.end());
    }
    for (const Index v : near)
    {
      for (const Index other : this->Complex.Neighbors(v))
      {
        if (v < other && std::binary_search(near.begin(), near.end(), other) && this->Split.insert({ v, other }).second)
        {
          this->AddMiddle(v, other, near);
        }
      }
    }
    if (fault.Vertices.size() == 3)
    {
      this->AddCurves(fault, near);
    }
  }

  std::vector<Particle> Added;

private:
  void AddMiddle(Index a, Index b, const std::vector<Index>& near)
  {
    const Particle &p = this->Complex.Vertex(a), &q = this->Complex.Vertex(b);
    MaterialSet common;
    for (const MaterialId m : p.Materials)
    {
      if (q.Materials.Contains(m))
      {
        common.Insert(m);
      }
    }
    if (common.Size() == 2 || common.Size() == 3)
    {
      this->Add(common, 0.5 * (p.Position + q.Position), 0.5 * std::min(p.TargetLength, q.TargetLength),
        LeastDistance * (p.Position - q.Position).norm(), near);
    }
  }

  /// A wrong face lacks a curve of its two materials and another of a vertex.
  void AddCurves(const Fault& fault, const std::vector<Index>& near)
  {
    Vec3 centre = Vec3::Zero();
    for (const Index v : fault.Vertices)
    {
      centre += this->Complex.Vertex(v).Position / 3.0;
    }
    for (const Index v : fault.Vertices)
    {
      const Particle& p = this->Complex.Vertex(v);
      for (const MaterialId m : p.Materials)
      {
        MaterialSet curve;
        for (const MaterialId member : { m, fault.Materials[0], fault.Materials[1] })
        {
          curve.Insert(member);
        }
        if (curve.Size() == 3)
        {
          this->Add(curve, centre, 0.5 * p.TargetLength, LeastDistance * (p.Position - centre).norm(), near);
        }
      }
    }
  }

  void Add(const MaterialSet& materials, const Vec3& x, double length, double apart, const std::vector<Index>& near)
  {
    Particle added;
    if (!PlaceOnJunction(this->Indicators, materials, x, length, added))
    {
      return;
    }
    const auto tooNear = [&](const Particle& other)
    { return (other.Position - added.Position).squaredNorm() < apart * apart; };
    if (std::none_of(near.begin(), near.end(), [&](Index v) { return tooNear(this->Complex.Vertex(v)); }) &&
      std::none_of(this->Added.begin(), this->Added.end(), tooNear))
    {
      this->Added.push_back(added);
    }
  }

  const IndicatorSet& Indicators;
  const SurfaceComplex& Complex;
  std::set<Edge> Split;
};
}

std::vector<Particle> ParticlesAround(
  const IndicatorSet& indicators, const SurfaceComplex& complex, const std::vector<Fault>& faults)
{
  Refinement refinement(indicators, complex);
  for (const Fault& fault : faults)
  {
    refinement.Around(fault);
  }
  return refinement.Added;
}
}
