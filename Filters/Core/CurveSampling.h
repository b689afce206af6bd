// SPDX-License-Identifier: BSD-3-Clause
// Particles on 0-cells and 1-cells.
#ifndef LabelMesh_Core_CurveSampling_h
#define LabelMesh_Core_CurveSampling_h

#include "CurveTracing.h"

namespace LabelMesh
{
struct CurveSamples
{
  std::vector<Particle> Particles; ///< those of 0-cells first
  std::vector<Curve> Curves;
  Index ZeroCells = 0; ///< particles of dimension 0
  Index Merged = 0;    ///< 0-cells and curve samples that were absorbed by others closer than half a target length
};

/// One particle per 0-cell, and along each 1-cell particles at equal integrals of ds / h. In one dimension that is the
/// minimum of the particles' energy: nothing needs to relax. What is closer than half a target length is merged, its
/// materials united: 0-cells first, then curves, the longest first.
CurveSamples SampleCurves(
  const JunctionNetwork& network, const IndicatorSet& indicators, const Grid<float>& targetLength);
}

#endif
