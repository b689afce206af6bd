// SPDX-License-Identifier: BSD-3-Clause
// Moving particles inside materials to low energy.
#ifndef LabelMesh_Core_VolumeRelaxation_h
#define LabelMesh_Core_VolumeRelaxation_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"

#include <vector>

namespace LabelMesh
{
/// Distances in target lengths of the smaller one: at which two particles no longer interact (between the second and
/// the third ring of a body-centred cubic lattice), and how high above the surface at a 2-cell particle those inside
/// stay.
inline constexpr double VolumeRange = 1.2;
inline constexpr double LeastHeight = 0.6;

struct VolumeRelaxOptions
{
  int Sweeps = 10;
  double StepFactor = 1.3;  ///< of the Gauss-Newton step
  double Momentum = 0.5;    ///< of the previous step
  double LargestStep = 0.2; ///< target lengths
};

/// Moves the 3-cell particles, those from `first` on; the others, on the boundary, stay and push.
///
/// The energy of a pair is ((1 - d) / d)^2 with d = |p_i - p_j| / (VolumeRange min(h_i, h_j)), zero beyond 1, and only
/// among particles of one material and those on its boundary. Each sweep moves all particles at once by a Gauss-Newton
/// step with momentum; one that would come too near to the surface is held off it, one that would leave its material
/// stays. Returns the mean move of the last sweep in target lengths.
double RelaxVolume(const IndicatorSet& indicators, const Grid<float>& lengths, Index first,
  std::vector<Particle>& particles, const VolumeRelaxOptions& options, const Monitor& monitor = Monitor());

/// Deletes 3-cell particles, those from `first` on, that are nearer than `distance` to an earlier particle or lower
/// than `height` above the surface at a particle on it, both in target lengths of the smaller one. Returns the new
/// numbers of all, -1 for those deleted.
std::vector<std::int32_t> DeleteCrowdedVolume(
  Index first, double distance, double height, std::vector<Particle>& particles);
}

#endif
