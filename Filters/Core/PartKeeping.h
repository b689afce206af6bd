// SPDX-License-Identifier: BSD-3-Clause
// Small and thin parts get back what smoothing took from them.
#ifndef LabelMesh_Core_PartKeeping_h
#define LabelMesh_Core_PartKeeping_h

#include "VoxelObjects.h"

#include "Lattice.h"
#include "Monitor.h"

#include <vector>

namespace LabelMesh
{
/// A smoothed material: its distance (voxels * Unit, > 0 inside) on samples of the working lattice.
struct PartField
{
  Lattice Frame;
  std::array<Index, 3> Offset{ 0, 0, 0 }; ///< of its first sample in the working lattice
  float* Distance = nullptr;
  float Outside = 0.0f; ///< the value beyond its samples
};

struct PartKeepingOptions
{
  double Tolerance = 0.02; ///< of a part's volume
  int Rounds = 8;
};

struct PartKeepingResult
{
  Index Delicate = 0; ///< parts without a core, or small
  Index Restored = 0; ///< that were gone, or mostly
  Index Adjusted = 0; ///< whose volume was beyond the tolerance
};

/// Parts that smoothing at the resolution of the voxels cannot hold: those in which less than a tenth of the voxels
/// lie deep, and small ones. One that holds less than half of its volume gets the distance of its voxels back,
/// and its neighbours make room. Then constants are added to the distances around such parts, until each holds the
/// volume of its voxels, as the weights of a power diagram give each of its cells the volume that it should have.
/// Volumes are those of the partition by the largest field, interpolated as the indicators are (Catmull-Rom).
/// `parts`: their runs are of samples of the working lattice, their ids positions in `fields`; others are passed over.
/// The same bits for any number of threads. Throws Aborted when the monitor asks to stop.
PartKeepingResult KeepParts(const Lattice& working, const std::vector<PartField>& fields, const VoxelObjects& parts,
  const PartKeepingOptions& options, const Monitor& monitor);
}

#endif
