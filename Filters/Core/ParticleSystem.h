// SPDX-License-Identifier: BSD-3-Clause
// Sampling of 0-, 1-, 2- and 3-cells with particles (paper, sections 4.2 and 5.2).
#ifndef LabelMesh_Core_ParticleSystem_h
#define LabelMesh_Core_ParticleSystem_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"
#include "VolumePacking.h"

namespace LabelMesh
{
struct SampleOptions
{
  int Sweeps = 20;        ///< relaxation sweeps over the 2-cell particles
  std::uint32_t Seed = 1; ///< of the random order of the first particles
  bool Volume = false;    ///< 3-cells too
  PackOptions Packing;    ///< of those
};

struct SampleResult
{
  std::vector<Particle> Particles; ///< 0-cells, then 1-cells, then 2-cells, then 3-cells
  std::vector<Curve> Curves;
  std::array<Index, 4> CellCounts{ 0, 0, 0, 0 };
  Index OpenCurveEnds = 0; ///< (0-cell, triple) pairs that have no curve end, or more than one: 0 on clean fields
  double MeanMove = 0.0;   ///< of the last sweep, in target lengths
};

SampleResult SampleCells(const IndicatorSet& indicators, const Grid<float>& targetLength, const SampleOptions& options,
  const Monitor& monitor);
}

#endif
