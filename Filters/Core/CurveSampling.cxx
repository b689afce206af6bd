// SPDX-License-Identifier: BSD-3-Clause
#include "CurveSampling.h"

#include "Junction.h"
#include "NeighborGrid.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr double MergeDistance = 0.5; // target lengths
constexpr double ShortestLoop = 1.5;  // target lengths: a shorter closed curve becomes one particle

class CurveSampler
{
public:
  CurveSampler(const JunctionNetwork& network, const IndicatorSet& indicators, const Grid<float>& targetLength)
    : Network(network)
    , Indicators(indicators)
    , TargetLength(targetLength)
  {
  }

  CurveSamples Run()
  {
    this->PlaceZeroCells();
    std::vector<std::vector<double>> arcs;
    for (const OneCell& curve : this->Network.OneCells)
    {
      arcs.push_back(this->ScaledArc(curve));
    }
    std::vector<Index> order(arcs.size());
    std::iota(order.begin(), order.end(), Index(0));
    const auto borders = [this](Index c) { return CountBorders(this->Network.OneCells[c].Materials); };
    std::stable_sort(order.begin(), order.end(),
      [&](Index a, Index b)
      { return borders(a) != borders(b) ? borders(a) > borders(b) : arcs[a].back() > arcs[b].back(); });
    for (const Index c : order)
    {
      this->PlaceCurve(this->Network.OneCells[c], arcs[c]);
    }
    if (this->Indicators.Border())
    {
      // What was absorbed from a face of the volume's box takes the particle there.
      for (Particle& p : this->Result.Particles)
      {
        this->Indicators.Border()->Snap(p.Materials.begin(), p.Materials.Size(), p.Position);
      }
    }
    return std::move(this->Result);
  }

private:
  template <typename Materials>
  static Index CountBorders(const Materials& materials)
  {
    return std::count_if(materials.begin(), materials.end(), IsBorder);
  }

  double LengthAt(const Vec3& x) const { return this->TargetLength.Trilinear(x); }

  Index Place(const Vec3& x, const MaterialSet& materials, int dimension)
  {
    Particle particle;
    particle.Position = x;
    particle.Materials = materials;
    particle.CellDimension = std::uint8_t(dimension);
    particle.TargetLength = this->LengthAt(x);
    const MaterialId* m = materials.begin();
    particle.Residual =
      ProjectToJunction(this->Indicators, m, std::min(materials.Size(), 4), x, { 1, 0, 1e9 }).Residual;
    this->Result.Particles.push_back(particle);
    this->Placed.Insert(x, particle.TargetLength);
    this->Adjacent.emplace_back();
    return Index(this->Result.Particles.size()) - 1;
  }

  /// Unites the sets when the union fits; a particle has room for MaterialSet::Capacity materials.
  static bool Unite(MaterialSet& into, const MaterialSet& other)
  {
    MaterialSet both = into;
    for (const MaterialId m : other)
    {
      if (!both.Contains(m) && !both.Insert(m))
      {
        return false;
      }
    }
    into = both;
    return true;
  }

  /// Whether what is outside would touch itself if the two were one junction: where background beneath the border comes
  /// near it between materials, or reaches it as a gap between two. That would be no manifold.
  bool WouldPinchOutside(const MaterialSet& sampled, const MaterialSet& other) const
  {
    const auto has = [this](const MaterialSet& set, bool border)
    { return border ? CountBorders(set) > 0 : set.Contains(this->Indicators.Background()); };
    const bool isNew = std::any_of(other.begin(), other.end(), [&](MaterialId m) { return !sampled.Contains(m); });
    const bool bothReach = has(sampled, false) && has(sampled, true) && has(other, false) && has(other, true);
    const bool oneBeneath = has(sampled, false) != has(sampled, true) && has(other, false) == has(sampled, true) &&
      has(other, true) == has(sampled, false);
    return isNew && (bothReach || oneBeneath);
  }

  void PlaceZeroCells()
  {
    // On edges and faces of the volume's box first: what is merged there stays there.
    std::vector<Index> order(this->Network.ZeroCells.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(order.begin(), order.end(),
      [this](Index a, Index b) {
        return CountBorders(this->Network.ZeroCells[a].Materials) > CountBorders(this->Network.ZeroCells[b].Materials);
      });
    this->ParticleOfZeroCell.assign(order.size(), -1);
    for (const Index n : order)
    {
      const ZeroCell& cell = this->Network.ZeroCells[n];
      Index nearest = -1;
      double best = 1e300;
      this->Placed.VisitScaled(cell.Position, this->LengthAt(cell.Position), MergeDistance,
        [&](Index particle, double squared)
        {
          if (squared < best && !this->WouldPinchOutside(this->Result.Particles[particle].Materials, cell.Materials))
          {
            best = squared;
            nearest = particle;
          }
        });
      if (nearest >= 0 && Unite(this->Result.Particles[nearest].Materials, cell.Materials))
      {
        this->ParticleOfZeroCell[n] = nearest;
        ++this->Result.Merged;
      }
      else
      {
        this->ParticleOfZeroCell[n] = this->Place(cell.Position, cell.Materials, 0);
      }
    }
    this->Result.ZeroCells = Index(this->Result.Particles.size());
  }

  /// The integral of ds / h at each point of the polyline; for a closed one with the closing segment at the end.
  std::vector<double> ScaledArc(const OneCell& curve) const
  {
    std::vector<double> arc{ 0.0 };
    const std::size_t count = curve.Points.size();
    for (std::size_t n = 1; n < count + (curve.Closed ? 1 : 0); ++n)
    {
      const Vec3 &from = curve.Points[n - 1], &to = curve.Points[n % count];
      arc.push_back(arc.back() + (to - from).norm() / this->LengthAt(0.5 * (from + to)));
    }
    return arc;
  }

  static Vec3 PointAt(const OneCell& curve, const std::vector<double>& arc, double s)
  {
    const std::size_t n = std::min<std::size_t>(
      std::max<Index>(std::upper_bound(arc.begin(), arc.end(), s) - arc.begin(), 1), arc.size() - 1);
    const double length = arc[n] - arc[n - 1];
    const double t = length > 0 ? (s - arc[n - 1]) / length : 0.0;
    return curve.Points[n - 1] + t * (curve.Points[n % curve.Points.size()] - curve.Points[n - 1]);
  }

  void PlaceCurve(const OneCell& curve, const std::vector<double>& arc)
  {
    const double total = arc.back();
    MaterialSet materials;
    for (const MaterialId m : curve.Materials)
    {
      materials.Insert(m);
    }
    const Index start = curve.Start >= 0 ? this->ParticleOfZeroCell[curve.Start] : -1;
    const Index end = curve.End >= 0 ? this->ParticleOfZeroCell[curve.End] : -1;
    const bool loop = curve.Closed || (start >= 0 && start == end);
    Index segments = std::max<Index>(1, std::lround(total));
    if (loop)
    {
      if (total < ShortestLoop)
      {
        if (curve.Closed)
        {
          this->PlaceOrAbsorb(curve.Points.front(), materials, -1);
        }
        return;
      }
      segments = std::max<Index>(3, segments);
    }
    Curve sampled;
    sampled.Materials = curve.Materials;
    const auto append = [&](Index particle)
    {
      if (sampled.Particles.empty() || sampled.Particles.back() != particle)
      {
        if (!sampled.Particles.empty())
        {
          this->Connect(sampled.Particles.back(), particle);
        }
        sampled.Particles.push_back(particle);
      }
    };
    if (start >= 0)
    {
      append(start);
    }
    const Index first = start >= 0 ? 1 : 0;
    const Index last = curve.Closed || end >= 0 ? segments - 1 : segments;
    for (Index n = first; n <= last; ++n)
    {
      const Vec3 x = this->OnJunction(curve, PointAt(curve, arc, total * double(n) / double(segments)));
      append(this->PlaceOrAbsorb(x, materials, sampled.Particles.empty() ? -1 : sampled.Particles.back()));
    }
    if (end >= 0)
    {
      append(end);
    }
    if (curve.Closed)
    {
      append(sampled.Particles.front());
    }
    if (sampled.Particles.size() > 1)
    {
      this->Result.Curves.push_back(std::move(sampled));
    }
  }

  /// The polyline cuts corners by its sagitta; the particle lies on the curve itself.
  Vec3 OnJunction(const OneCell& curve, const Vec3& x) const
  {
    const Projection p = ProjectToJunction(this->Indicators, curve.Materials.data(), 3, x);
    return p.Converged && (p.Position - x).norm() < 0.5 * this->Indicators.VoxelSize() ? p.Position : x;
  }

  void Connect(Index a, Index b)
  {
    this->Adjacent[a].push_back(b);
    this->Adjacent[b].push_back(a);
  }

  /// The particle at x on a curve that comes from `predecessor`: a new one, or one of a sampled curve that passes
  /// closer than the merge distance, which then gets the materials.
  Index PlaceOrAbsorb(const Vec3& x, const MaterialSet& materials, Index predecessor)
  {
    const double h = this->LengthAt(x);
    Index absorbing = -1;
    double best = MergeDistance * h;
    // A point within half a length of a segment of about one length is within 0.75 of one of its ends.
    this->Placed.VisitScaled(x, h, 1.5 * MergeDistance,
      [&](Index n, double squared)
      {
        if (n == predecessor || this->WouldPinchOutside(this->Result.Particles[n].Materials, materials))
        {
          return;
        }
        double distance = std::sqrt(squared);
        for (const Index other : this->Adjacent[n])
        {
          if (other != predecessor)
          {
            distance = std::min(distance,
              DistanceToSegment(x, this->Result.Particles[n].Position, this->Result.Particles[other].Position));
          }
        }
        if (distance < best || (distance == best && n < absorbing))
        {
          best = distance;
          absorbing = n;
        }
      });
    if (absorbing >= 0 && Unite(this->Result.Particles[absorbing].Materials, materials))
    {
      ++this->Result.Merged;
      return absorbing;
    }
    return this->Place(x, materials, 1);
  }

  const JunctionNetwork& Network;
  const IndicatorSet& Indicators;
  const Grid<float>& TargetLength;
  CurveSamples Result;
  NeighborGrid Placed;
  std::vector<std::vector<Index>> Adjacent; // along sampled curves
  std::vector<Index> ParticleOfZeroCell;
};
}

CurveSamples SampleCurves(
  const JunctionNetwork& network, const IndicatorSet& indicators, const Grid<float>& targetLength)
{
  return CurveSampler(network, indicators, targetLength).Run();
}
}
