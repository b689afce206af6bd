// SPDX-License-Identifier: BSD-3-Clause
// From a binary mask to a smooth signed distance: exact distance, antialiasing, tightening (paper, section 5.1).
#ifndef LabelMesh_Core_LevelSet_h
#define LabelMesh_Core_LevelSet_h

#include "DistanceTransform.h"
#include "Lattice.h"
#include "Monitor.h"

namespace LabelMesh
{
struct TightenOptions
{
  double Radius = 1.0;          ///< voxels (Lattice::VoxelSize): the least radius of curvature; 0: antialias only
  int AntialiasIterations = 10; ///< steps of curvature flow that may not change any voxel's side
  int TightenIterations = 20;   ///< steps of curvature flow between the opening and the closing
  bool KeepThin = false;        ///< leave alone what the opening or the closing would take away as a whole
  double Band = 4.0;            ///< voxels: half width of the narrow band; beyond it the distance is +-Band
};

/// World length cubed.
struct TightenVolumes
{
  double Mask = 0.0;
  double Tight = 0.0; ///< inside the zero level; 0: nothing is left
};

class NarrowBand;

/// Throws std::invalid_argument for options out of range.
void CheckTightenOptions(const TightenOptions& options);

/// Half width in voxels of the narrow band that tightening works in.
double BandReach(const TightenOptions& options);

/// Steps 3 and 4 of Tighten, on a band of BandReach(options) whose function is a distance.
TightenVolumes TightenBand(
  NarrowBand& band, const Lattice& frame, const TightenOptions& options, const Monitor& monitor, float* distance);

/// Signed distance of a mask (1 inside, 0 outside) whose border samples are outside, or inside for a background mask.
/// `distance` gets a value for each sample: world length, > 0 inside, clamped to +-Band.
///
/// 1. Exact signed distance in a narrow band (SignedDistance).
/// 2. Antialiasing (Whitaker 2000): curvature flow that keeps every sample on its side; re-distancing.
///    An iteration is 0.2 voxels squared of time. More than 10 are worse: the clamp makes kinks.
/// 3. Tightening (Williams and Rossignac 2005): the opening and the closing by a ball of Radius are bounds between
/// which
///    curvature flow runs: only the mortar, which is between them, changes, and |mean curvature| <= 1 / Radius.
///    The bounds are unions of balls (NarrowBand::Opening); corners lose up to a quarter of a voxel more than the ball
///    asks.
/// 4. Re-distancing.
/// Spacing enters every step; with unequal spacings an iteration is cut into as many stable steps as it needs.
///
/// What is thinner than 2 Radius vanishes, small materials with it: compare the volumes. With KeepThin it stays, and
/// so do gaps: where the surface is farther from a bound than rounding explains, the bound is brought back to it, if it
/// is not far from both, as in noise.
/// An empty or full mask gives -Band or +Band everywhere.
/// Throws std::invalid_argument for options out of range, Aborted when the monitor asks to stop.
TightenVolumes Tighten(const Lattice& frame, const std::uint8_t* mask, const TightenOptions& options,
  const Monitor& monitor, float* distance);
}

#endif
