// SPDX-License-Identifier: BSD-3-Clause
// Moving particles on 2-cells to low energy.
#ifndef LabelMesh_Core_Relaxation_h
#define LabelMesh_Core_Relaxation_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"

namespace LabelMesh
{
/// Distance in target lengths of the smaller one at which two particles no longer interact: 1 / (sqrt(3) / 3), so that
/// the second ring of a hexagonal arrangement lies just outside.
inline constexpr double InteractionRange = 1.7320508075688772;

/// True when particles on these cells see each other: `other` lies on the interface of a 2-cell particle's pair, and is
/// no 2-cell particle of an opposite sheet; or it lies in a 3-cell particle's material or on its boundary.
inline bool Interact(const Particle& particle, const Particle& other)
{
  if (particle.CellDimension == 3)
  {
    return other.Materials.Contains(particle.Materials[0]);
  }
  return other.Materials.Contains(particle.Materials[0]) && other.Materials.Contains(particle.Materials[1]) &&
    (other.CellDimension < 2 || particle.Normal.dot(other.Normal) > 0.0);
}

struct RelaxOptions
{
  int Sweeps = 10;
  double StepFactor = 1.6;  ///< of the Gauss-Newton step; with 1.6, 30 sweeps do what 42 do with 0.9
  double Momentum = 0.7;    ///< of the previous step
  double LargestStep = 0.3; ///< target lengths
};

/// Moves the 2-cell particles `moving` (ascending indices) of `particles`; the others stay.
///
/// The energy of a pair is ((1 - d) / d)^2 with d = |p_i - p_j| / (sqrt(3) min(h_i, h_j)), zero beyond 1. Each sweep
/// moves all particles at once (Jacobi) by a Gauss-Newton step in their tangent planes with momentum and projects them
/// back onto their interface; a particle that would leave its interface, where a third material is larger, stays.
/// `targetLength` null: each keeps its target length.
/// The monitor hears of each sweep. Returns the mean move of the last one in target lengths.
double Relax(const IndicatorSet& indicators, const Grid<float>* targetLength, std::vector<Particle>& particles,
  const std::vector<Index>& moving, const RelaxOptions& options, const Monitor& monitor = Monitor());

/// Puts x on the interface of the pair and sets position, normal and residual of the particle; false where it does not
/// converge within `reach` (world length) of x or another material is larger there.
bool PutOnInterface(
  const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x, double reach, Particle& particle);
}

#endif
