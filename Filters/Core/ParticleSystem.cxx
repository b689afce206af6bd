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
}

SampleResult SampleCells(const IndicatorSet& indicators, const Grid<float>& targetLength, const SampleOptions& options,
  const Monitor& monitor)
{
  SampleResult result;
  const JunctionNetwork network = TraceJunctions(indicators, monitor.Part(0.0, 0.1));
  CurveSamples curves = SampleCurves(network, indicators, targetLength);
  const Index fixed = Index(curves.Particles.size());
  result.OpenCurveEnds = network.OpenEnds;
  result.Particles = std::move(curves.Particles);
  result.Curves = std::move(curves.Curves);
  monitor.Step(0.12, "Placing particles on surfaces");

  const ProtectionBalls protection(result.Particles, result.Curves);
  const std::vector<Particle> candidates = InterfaceCandidates(indicators, targetLength, options.Seed);
  AddWhereFree(result.Particles, candidates, protection, PoissonDistance);

  for (int done = 0; done < options.Sweeps;)
  {
    monitor.Step(0.2 + 0.8 * done / options.Sweeps, "Relaxing particles");
    std::vector<Index> moving(result.Particles.size() - fixed);
    std::iota(moving.begin(), moving.end(), fixed);
    RelaxOptions relax;
    relax.Sweeps = std::min(SweepsPerPopulation, options.Sweeps - done);
    result.MeanMove = Relax(indicators, &targetLength, result.Particles, moving, relax);
    done += relax.Sweeps;
    DeleteCrowded(result.Particles, protection);
    if (done < options.Sweeps)
    {
      AddWhereFree(result.Particles, candidates, protection, GapDistance);
    }
  }
  result.CellCounts = { curves.ZeroCells, fixed - curves.ZeroCells, Index(result.Particles.size()) - fixed };
  monitor.Step(1.0);
  return result;
}
}
