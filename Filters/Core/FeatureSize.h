// SPDX-License-Identifier: BSD-3-Clause
// The local feature size of the material interfaces (paper, section 5.2).
#ifndef LabelMesh_Core_FeatureSize_h
#define LabelMesh_Core_FeatureSize_h

#include "IndicatorSet.h"
#include "Monitor.h"

#include <vector>

namespace LabelMesh
{
/// A point on an interface, one per near-interface voxel.
struct InterfaceSample
{
  Eigen::Vector3f Position = Eigen::Vector3f::Zero();
  Eigen::Vector3f Normal =
    Eigen::Vector3f::Zero(); ///< unit, from the first material into the second; zero if degenerate
  float FeatureSize = 0.0f;  ///< distance to the medial axis, world length
  float Curvature = 0.0f;    ///< the larger principal curvature, absolute, 1 / world length
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial };
};

struct FeatureSizes
{
  std::vector<InterfaceSample> Samples;
  /// Per sample of the working lattice the number of the nearest interface sample; -1 everywhere when there is none.
  std::vector<std::int32_t> Nearest;
  /// What stands for the feature size where there is no medial axis: the diagonal of the lattice, world length.
  double Largest = 0.0;
};

/// Local feature size of all interfaces: at each interface sample the distance to the medial axis.
///
/// The medial axis is that of the union of all interfaces. It is made of the inner medial axes of all materials, so
/// both sides of every interface count, and it needs one feature transform where one per material would cost
/// materials x voxels. The outer medial axis of a material adds nothing: a ball that leaves a point of its interface
/// on the outer side lies in the neighbour first, and meets the neighbour's interface before it meets the material's
/// own.
///
/// A grid edge within one material is medial if its ends' nearest interface points p, q have |p - q| >= 0.9 d and the
/// angle between the two directions exceeds min(149 deg, 60 deg + 2 atan(0.6 / d)), d the smaller distance in voxels:
/// the samples stand about 0.6 voxel beside the true nearest points, and the directions err by that angle. Wedges of
/// 120 degrees and more, as junctions of tightened materials have, thus carry no medial axis, and those of 90 degrees
/// begin 3 voxels away. The normals at p and q must differ by 60 degrees as well; where they differ by 149 degrees
/// and face away from each other the edge is medial whatever the directions. Materials one voxel thick have no edge
/// of their own; they are found by their two opposite interfaces.
///
/// Limits: parts thinner than one voxel that no lattice sample hits are not seen.
FeatureSizes FindFeatureSizes(const IndicatorSet& indicators, const Monitor& monitor);
}

#endif
