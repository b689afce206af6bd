// SPDX-License-Identifier: BSD-3-Clause
// Putting a particle on the junction that it belongs to.
#ifndef LabelMesh_Core_ParticlePlacement_h
#define LabelMesh_Core_ParticlePlacement_h

#include "IndicatorSet.h"
#include "Particles.h"

namespace LabelMesh
{
/// A particle on the junction of exactly these two or three materials (a surface or a curve) near x, with `length` as
/// its target length; false where there is none within `length` of x, another material is larger there, or all of them
/// are outside (IndicatorSet::IsOutside).
bool PlaceOnJunction(
  const IndicatorSet& indicators, const MaterialSet& materials, const Vec3& x, double length, Particle& particle);
}

#endif
