// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleSystem.h"

#include "CurveSampling.h"
#include "Relaxation.h"
#include "SpaceOrder.h"
#include "SurfaceSampling.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr int SweepsPerPopulation = 10; // the number of particles is corrected that often
}

SampleResult SampleCells(
  const IndicatorSet& indicators, const Grid<float>& targetLength, const SampleOptions& options, const Monitor& whole)
{
  SampleResult result;
  const Monitor monitor = whole.Part(0.0, options.Volume ? 0.6 : 1.0);
  const JunctionNetwork network = TraceJunctions(indicators, monitor.Part(0.0, 0.1));
  CurveSamples curves = SampleCurves(network, indicators, targetLength);
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
    candidates.Renumber(SortInSpace(indicators.Working(), result.Particles, fixed));
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
  const Index surface = Index(result.Particles.size());
  if (options.Volume)
  {
    PackVolume(indicators, targetLength, options.Packing, result.Particles, whole.Part(0.6, 1.0));
  }
  result.CellCounts = { curves.ZeroCells, fixed - curves.ZeroCells, surface - fixed,
    Index(result.Particles.size()) - surface };
  whole.Step(1.0);
  return result;
}
}
