// SPDX-License-Identifier: BSD-3-Clause
// Smoothing of all materials together, so that each keeps its volume and its thin parts.
#ifndef LabelMesh_Core_JointSmoothing_h
#define LabelMesh_Core_JointSmoothing_h

#include "LevelSet.h"

#include <functional>
#include <string>
#include <vector>

namespace LabelMesh
{
/// A material before smoothing. Its samples are samples of the working lattice.
struct MaterialMask
{
  std::string Name; ///< for progress texts
  Lattice Frame;
  const std::uint8_t* Mask = nullptr; ///< 1 inside, 0 outside
  double Radius = 0.7;                ///< voxels, of the final tightening
  /// Asked once, by any thread, after the last use of the mask: memory for the result, which is as Tighten gives it.
  std::function<float*()> Place;
};

struct JointSmoothingOptions
{
  int Rounds = 8;         ///< of flow and correction
  double Fidelity = 0.6; ///< curvature (1 / voxel) that it takes to turn a voxel over
  int TightenIterations = 20;
  double Band = 4.0; ///< voxels: half width of the narrow bands
};

/// Curvature flow of every material with two corrections that keep what is there.
///
/// Each round moves every material by two steps of curvature flow in which a sample that the flow has turned over is
/// pushed back with a constant force: as in total variation with an L1 fidelity term, a voxel is given up only where
/// keeping it needs more curvature than that force. Then, jointly, each field becomes half the difference to the
/// largest of the others (one partition, whose zero sets coincide) plus the Gaussian mean of what the partition lacks
/// of the labels, per area of its surface: staircases average out, lost thickness does not. The corrections are
/// integrated, so that the flow's steady shrinkage is cancelled. Then each material is tightened (see Tighten, with
/// KeepThin) with a small radius. At last small and thin parts get their volume back (see KeepParts).
///
/// Returns the volumes in the order of the materials. Throws std::invalid_argument when a frame's samples are not those
/// of the working lattice and for options out of range, Aborted when the monitor asks to stop.
std::vector<TightenVolumes> SmoothJointly(const Lattice& working, const std::vector<MaterialMask>& materials,
  const JointSmoothingOptions& options, const Monitor& monitor);
}

#endif
