// SPDX-License-Identifier: BSD-3-Clause
#include "ParticlePlacement.h"

#include "Junction.h"
#include "Relaxation.h"

namespace LabelMesh
{
bool PlaceOnJunction(
  const IndicatorSet& indicators, const MaterialSet& materials, const Vec3& x, double length, Particle& particle)
{
  particle = Particle();
  particle.TargetLength = length;
  particle.Materials = materials;
  if (!indicators.AnyInside(materials.begin(), materials.Size()))
  {
    return false;
  }
  if (materials.Size() == 2)
  {
    return PutOnInterface(indicators, materials[0], materials[1], x, length, particle);
  }
  const Projection p = ProjectToJunction(indicators, materials.begin(), 3, x);
  const RankedMaterial rival = indicators.LargestBut(p.Position, materials.begin(), 3);
  particle.Position = p.Position;
  particle.Residual = p.Residual;
  particle.CellDimension = 1;
  return p.Converged && (p.Position - x).norm() < length &&
    (rival.Material == NoMaterial || rival.Value <= indicators.Value(materials[0], p.Position));
}
}
