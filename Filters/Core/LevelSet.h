// SPDX-License-Identifier: BSD-3-Clause
// From a binary mask to a smooth signed distance: exact distance, antialiasing, tightening (paper, section 5.1).
#ifndef LabelMesh_Core_LevelSet_h
#define LabelMesh_Core_LevelSet_h

#include "Lattice.h"
#include "Monitor.h"

namespace LabelMesh
{
struct TightenOptions
{
  double Radius = 1.0;          ///< voxels (Lattice::VoxelSize): the least radius of curvature; 0: antialias only
  int AntialiasIterations = 10; ///< steps of curvature flow that may not change any voxel's side
  int TightenIterations = 20;   ///< steps of curvature flow between the opening and the closing
  double Band = 4.0;            ///< voxels: half width of the narrow band; beyond it the distance is +-Band
};

struct TightenResult
{
  std::vector<float> Distance; ///< signed, world length, > 0 inside, clamped to +-Band
  double MaskVolume = 0.0;     ///< world length cubed
  double TightVolume = 0.0;    ///< the volume inside the zero level, world length cubed
};

/// Signed distance of a mask (1 inside, 0 outside) whose border samples are outside, or inside for a background mask.
TightenResult Tighten(
  const Lattice& frame, const float* mask, const TightenOptions& options, const Monitor& monitor);
}

#endif
