// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleSystem.h"

#include "CurveSampling.h"
#include "Relaxation.h"
#include "SurfaceSampling.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr int SweepsPerPopulation = 10; // the number of particles is corrected that often

/// Interleaves the lower 21 bits of three numbers: near positions get near codes.
std::uint64_t MortonCode(const Lattice& frame, const Vec3& x)
{
  const Vec3 index = frame.ToIndex(x);
  std::uint64_t code = 0;
  for (int a = 0; a < 3; ++a)
  {
    std::uint64_t bits = std::uint64_t(std::max(index[a], 0.0)) & 0x1FFFFF;
    bits = (bits | bits << 32) & 0x1F00000000FFFF;
    bits = (bits | bits << 16) & 0x1F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    code |= bits << a;
  }
  return code;
}

/// Orders the particles in [first, last) along a space-filling curve, so that neighbours are near in memory too, and
/// the boxes of a PointTree small. Returns the new numbers of all.
std::vector<std::int32_t> SortInSpace(const Lattice& frame, std::vector<Particle>& particles, Index first, Index last)
{
  std::vector<std::pair<std::uint64_t, Index>> order;
  order.reserve(last - first);
  for (Index n = first; n < last; ++n)
  {
    order.emplace_back(MortonCode(frame, particles[n].Position), n);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> numbers(particles.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<Particle> sorted;
  sorted.reserve(order.size());
  for (const auto& [code, n] : order)
  {
    numbers[n] = std::int32_t(first + Index(sorted.size()));
    sorted.push_back(particles[n]);
  }
  std::copy(sorted.begin(), sorted.end(), particles.begin() + first);
  return numbers;
}

/// The same for those of curves. They come one curve after another, the longest first, each somewhere else: in that
/// order the boxes of a PointTree over thousands of curves all overlap, and a look-up opens most of them.
void SortInSpace(const Lattice& frame, CurveSamples& samples)
{
  const std::vector<std::int32_t> zeroCells = SortInSpace(frame, samples.Particles, 0, samples.ZeroCells);
  const std::vector<std::int32_t> oneCells =
    SortInSpace(frame, samples.Particles, samples.ZeroCells, Index(samples.Particles.size()));
  for (Curve& curve : samples.Curves)
  {
    for (Index& n : curve.Particles)
    {
      n = oneCells[zeroCells[n]];
    }
  }
}
}

SampleResult SampleCells(
  const IndicatorSet& indicators, const Grid<float>& targetLength, const SampleOptions& options, const Monitor& monitor)
{
  SampleResult result;
  const JunctionNetwork network = TraceJunctions(indicators, monitor.Part(0.0, 0.1));
  CurveSamples curves = SampleCurves(network, indicators, targetLength);
  SortInSpace(indicators.Working(), curves);
  const Index fixed = Index(curves.Particles.size());
  result.OpenCurveEnds = network.OpenEnds;
  result.Particles = std::move(curves.Particles);
  result.Curves = std::move(curves.Curves);
  monitor.Step(0.12, "Placing particles on surfaces");

  const ProtectionBalls protection(result.Particles, result.Curves);
  CandidatePool candidates(InterfaceCandidates(indicators, targetLength, options.Seed), protection);
  candidates.AddWhereFree(result.Particles, PoissonDistance);

  for (int done = 0; done < options.Sweeps;)
  {
    monitor.Step(0.2 + 0.8 * done / options.Sweeps, "Relaxing particles");
    candidates.Renumber(SortInSpace(indicators.Working(), result.Particles, fixed, Index(result.Particles.size())));
    std::vector<Index> moving(result.Particles.size() - fixed);
    std::iota(moving.begin(), moving.end(), fixed);
    RelaxOptions relax;
    relax.Sweeps = std::min(SweepsPerPopulation, options.Sweeps - done);
    const Monitor part =
      monitor.Part(0.2 + 0.8 * done / options.Sweeps, 0.2 + 0.8 * (done + relax.Sweeps) / options.Sweeps);
    result.MeanMove = Relax(indicators, &targetLength, result.Particles, moving, relax, part);
    done += relax.Sweeps;
    candidates.Renumber(DeleteCrowded(result.Particles, protection));
    if (done < options.Sweeps)
    {
      candidates.AddWhereFree(result.Particles, GapDistance);
    }
  }
  result.CellCounts = { curves.ZeroCells, fixed - curves.ZeroCells, Index(result.Particles.size()) - fixed };
  monitor.Step(1.0);
  return result;
}
}
