// SPDX-License-Identifier: BSD-3-Clause
#include "VolumePacking.h"

#include "Parallel.h"
#include "SizingField.h"
#include "SpaceOrder.h"
#include "SurfaceSampling.h"
#include "VolumeRelaxation.h"

#include <cmath>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
constexpr float Unbounded = 1e30f;
constexpr double LatticeStep = 1.25;      // ratio of the lattices of neighbouring levels
constexpr double LatticeConstant = 1.1;   // target lengths: the mean edge of its tetrahedra is then one
constexpr double FirstDistance = 0.75;    // target lengths, between first particles
constexpr double VolumeGap = 0.8;         // a candidate farther from all particles fills a gap
constexpr double CrowdedVolume = 0.6;     // of a closer pair one is deleted
constexpr double LeastFinalHeight = 0.45; // above the surface
constexpr int SweepsPerPopulation = 10;   // the number of particles is corrected that often

void Check(const PackOptions& options)
{
  if (!(options.Gradation > 0))
  {
    throw std::invalid_argument(
      "VolumeGradation is " + std::to_string(options.Gradation) + "; expected a positive slope");
  }
  if (!(options.MaximumLength >= 0))
  {
    throw std::invalid_argument("VolumeMaximumLength must not be negative; 0 turns it off");
  }
}

/// Whether a sample has a neighbour, along an edge, face or diagonal, across an interface.
bool IsNearInterface(const IndicatorSet& indicators, Index at)
{
  const Lattice& frame = indicators.Working();
  const std::vector<MaterialId>& labels = indicators.Labels();
  const auto c = frame.Coordinates(at);
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> to = { c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1 };
    if (to[0] >= 0 && to[0] < frame.Dims[0] && to[1] >= 0 && to[1] < frame.Dims[1] && to[2] >= 0 &&
      to[2] < frame.Dims[2] && indicators.HaveInterface(labels[at], labels[frame.At(to[0], to[1], to[2])]))
    {
      return true;
    }
  }
  return false;
}

/// The target length of the interface next to a sample, grown over the distance from it: half the difference of the two
/// largest indicators.
double LengthNearInterface(const IndicatorSet& indicators, const Grid<float>& targetLength, Index at, double gradation)
{
  const auto c = indicators.Working().Coordinates(at);
  const Vec3 x = indicators.Working().Position(c[0], c[1], c[2]);
  std::array<RankedMaterial, 2> ranked;
  const bool two = indicators.Largest(x, 2, ranked.data()) == 2;
  const double farthest = indicators.Working().Spacing.norm();
  const double distance = two ? std::min(0.5 * (ranked[0].Value - ranked[1].Value), farthest) : farthest;
  return targetLength.Trilinear(x) + gradation * distance;
}

/// Candidates inside the cells of one layer of the working lattice. A cell is the box of space around a sample.
class VolumeCandidates
{
public:
  VolumeCandidates(const IndicatorSet& indicators, const Grid<float>& lengths)
    : Indicators(indicators)
    , Lengths(lengths)
  {
  }

  /// Those of the lattices first, then those half way between them.
  std::vector<Particle> Run() const
  {
    std::vector<Particle> found = ParallelCollect<Particle>(this->Indicators.Working().Dims[2],
      [this](Index k, std::vector<Particle>& layer) { this->FindInLayer(k, layer); });
    std::stable_partition(found.begin(), found.end(), [](const Particle& p) { return p.Residual == 0.0; });
    for (Particle& p : found)
    {
      p.Residual = 0.0;
    }
    return found;
  }

private:
  void FindInLayer(Index k, std::vector<Particle>& found) const
  {
    const Lattice& frame = this->Indicators.Working();
    const std::vector<MaterialId>& labels = this->Indicators.Labels();
    for (Index at = frame.At(0, 0, k); at < frame.At(0, 0, k + 1); ++at)
    {
      if (!this->Indicators.IsOutside(labels[at]))
      {
        this->FindInCell(at, found);
      }
    }
  }

  static int LevelOf(double h) { return int(std::floor(std::log(h) / std::log(LatticeStep))); }

  void FindInCell(Index at, std::vector<Particle>& found) const
  {
    // The length changes by less than a voxel's diagonal times the slope within the cell: few levels.
    const Lattice& frame = this->Indicators.Working();
    const auto c = frame.Coordinates(at);
    const Vec3 middle = frame.Position(c[0], c[1], c[2]);
    const Vec3 low = middle - 0.5 * frame.Spacing, high = middle + 0.5 * frame.Spacing;
    double least = Unbounded, most = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vec3 x(corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]);
      const double h = this->Lengths.Trilinear(x);
      least = std::min(least, h);
      most = std::max(most, h);
    }
    const double own = this->Lengths.Values[at];
    const int last = LevelOf(std::max(most, own));
    for (int level = LevelOf(std::min(least, own)); level <= last; ++level)
    {
      this->FindOfLevel(level, low, high, found);
    }
  }

  /// The points of a level's half-spaced lattice within a box where the length is of that level.
  void FindOfLevel(int level, const Vec3& low, const Vec3& high, std::vector<Particle>& found) const
  {
    // Half the constant of a body-centred lattice of half the constant: points with all coordinates even or all odd.
    const double step = 0.25 * LatticeConstant * std::pow(LatticeStep, level + 0.5);
    std::array<Index, 3> first, end;
    for (int a = 0; a < 3; ++a)
    {
      first[a] = Index(std::ceil(low[a] / step));
      end[a] = Index(std::ceil(high[a] / step));
    }
    for (Index k = first[2]; k < end[2]; ++k)
    {
      for (Index j = first[1]; j < end[1]; ++j)
      {
        for (Index i = first[0]; i < end[0]; ++i)
        {
          if ((i & 1) == (j & 1) && (j & 1) == (k & 1))
          {
            this->Add(level, Vec3(double(i), double(j), double(k)) * step, IsCoarse(i, j, k), found);
          }
        }
      }
    }
  }

  /// On the body-centred lattice of the full constant: all even, and all halves even or all odd.
  static bool IsCoarse(Index i, Index j, Index k) { return (i & 1) == 0 && (i & 2) == (j & 2) && (j & 2) == (k & 2); }

  void Add(int level, const Vec3& x, bool coarse, std::vector<Particle>& found) const
  {
    Particle p;
    p.TargetLength = this->Lengths.Trilinear(x);
    if (LevelOf(p.TargetLength) != level)
    {
      return;
    }
    const MaterialId material = this->Indicators.LargestMaterial(x);
    if (!this->Indicators.IsOutside(material))
    {
      p.Position = x;
      p.CellDimension = 3;
      p.Materials.Insert(material);
      p.Residual = coarse ? 0.0 : 1.0; // for Run to tell them apart
      found.push_back(p);
    }
  }

  const IndicatorSet& Indicators;
  const Grid<float>& Lengths;
};
}

Grid<float> VolumeLengths(const IndicatorSet& indicators, const Grid<float>& targetLength, const PackOptions& options)
{
  Check(options);
  const Lattice& frame = indicators.Working();
  const std::vector<MaterialId>& labels = indicators.Labels();
  const auto maximumOf = [&](MaterialId m)
  {
    const double own = m < options.MaterialMaximumLength.size() ? options.MaterialMaximumLength[m] : 0.0;
    const double most = own > 0 ? own : options.MaximumLength;
    return most > 0 && !indicators.IsOutside(m) ? float(most) : Unbounded;
  };
  Grid<float> lengths(frame, Unbounded);
  ParallelFor(0, frame.Dims[2], 1,
    [&](Index first, Index last)
    {
      for (Index at = frame.At(0, 0, first); at < frame.At(0, 0, last); ++at)
      {
        const float most = maximumOf(labels[at]);
        lengths.Values[at] = IsNearInterface(indicators, at)
          ? std::min(most, float(LengthNearInterface(indicators, targetLength, at, options.Gradation)))
          : most;
      }
    });
  LimitGradient(frame, options.Gradation, lengths.Values);
  return lengths;
}

void PackVolume(const IndicatorSet& indicators, const Grid<float>& targetLength, const PackOptions& options,
  std::vector<Particle>& particles, const Monitor& monitor)
{
  monitor.Step(0.0, "Packing the insides");
  const Index first = Index(particles.size());
  const Grid<float> lengths = VolumeLengths(indicators, targetLength, options);
  monitor.Step(0.1);
  CandidatePool candidates(VolumeCandidates(indicators, lengths).Run(), ProtectionBalls({}, {}));
  monitor.Step(0.25);
  candidates.AddWhereFree(particles, FirstDistance);
  for (int done = 0; done < options.Sweeps;)
  {
    const double share = double(done) / options.Sweeps;
    monitor.Step(0.4 + 0.6 * share, "Relaxing particles inside");
    candidates.Renumber(SortInSpace(indicators.Working(), particles, first));
    VolumeRelaxOptions relax;
    relax.Sweeps = std::min(SweepsPerPopulation, options.Sweeps - done);
    RelaxVolume(indicators, lengths, first, particles, relax,
      monitor.Part(0.4 + 0.6 * share, 0.4 + 0.6 * (done + relax.Sweeps) / options.Sweeps));
    done += relax.Sweeps;
    candidates.Renumber(DeleteCrowdedVolume(first, CrowdedVolume, LeastFinalHeight, particles));
    if (done < options.Sweeps)
    {
      candidates.AddWhereFree(particles, VolumeGap);
    }
  }
  monitor.Step(1.0);
}
}
