// SPDX-License-Identifier: BSD-3-Clause
// Sampling of 0-, 1- and 2-cells with particles (paper, sections 4.2 and 5.2).
#ifndef LabelMesh_Core_ParticleSystem_h
#define LabelMesh_Core_ParticleSystem_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"

namespace LabelMesh
{
struct SampleOptions
{
  int Sweeps = 20;        ///< relaxation sweeps over the 2-cell particles
  std::uint32_t Seed = 1; ///< of the random order of the first particles
};

struct SampleResult
{
  std::vector<Particle> Particles; ///< 0-cells, then 1-cells, then 2-cells
  std::vector<Curve> Curves;
  std::array<Index, 3> CellCounts{ 0, 0, 0 };
  Index OpenCurveEnds = 0; ///< (0-cell, triple) pairs that have no curve end, or more than one: 0 on clean fields
  double MeanMove = 0.0;   ///< of the last sweep, in target lengths
};

SampleResult SampleCells(const IndicatorSet& indicators, const Grid<float>& targetLength, const SampleOptions& options,
  const Monitor& monitor);
}

#endif
