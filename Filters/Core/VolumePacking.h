// SPDX-License-Identifier: BSD-3-Clause
// Spheres packed inside the materials: the particles of 3-cells (paper, section 6).
#ifndef LabelMesh_Core_VolumePacking_h
#define LabelMesh_Core_VolumePacking_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"

#include <vector>

namespace LabelMesh
{
struct PackOptions
{
  double Gradation = 0.4;   ///< the largest |grad h| inside materials
  double MaximumLength = 0; ///< world length; 0: none
  /// World length per material, 0: none; empty: none at all.
  std::vector<double> MaterialMaximumLength;
  int Sweeps = 20; ///< of relaxation
};

/// How far apart the particles inside materials should be: the target length at the interfaces, grown inwards, on the
/// same lattice: h(x) = min over y of h0(y) + Gradation |x - y| (LimitGradient), with h0 the target length near
/// interfaces and the material's maximum elsewhere. Throws std::invalid_argument when an option has no meaning.
Grid<float> VolumeLengths(const IndicatorSet& indicators, const Grid<float>& targetLength, const PackOptions& options);

/// Appends the particles of 3-cells to those of lower cells, which stay as they are: in every material but the
/// background, Materials holding that one alone, ordered in space. They start on body-centred cubic lattices, whose
/// Delaunay tetrahedra are the best that fill space, one lattice for each step of the length; then they relax against
/// each other and the particles on the boundary, at least half a length from it (RelaxVolume), and gaps are filled.
void PackVolume(const IndicatorSet& indicators, const Grid<float>& targetLength, const PackOptions& options,
  std::vector<Particle>& particles, const Monitor& monitor);
}

#endif
