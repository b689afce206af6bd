// SPDX-License-Identifier: BSD-3-Clause
// More particles where nothing else mends an interface mesh.
#ifndef LabelMesh_Core_FaultRefinement_h
#define LabelMesh_Core_FaultRefinement_h

#include "IndicatorSet.h"
#include "LocalRepair.h"
#include "SurfaceComplex.h"

namespace LabelMesh
{
/// Particles to add around faults: on the junctions of what the two ends of each edge share, in the middle of the edges
/// of the faces around (two rings of them), and on the curves that a wrong face reaches across. None nearer to another
/// particle than a quarter of the edge. Their target lengths are half of what is there. In the order of the faults.
std::vector<Particle> ParticlesAround(
  const IndicatorSet& indicators, const SurfaceComplex& complex, const std::vector<Fault>& faults);
}

#endif
