// SPDX-License-Identifier: BSD-3-Clause
// Which voxels a mesh gives to which material, and how far its vertices are from the voxels' own interfaces.
#ifndef LabelMesh_Core_MeshLabels_h
#define LabelMesh_Core_MeshLabels_h

#include "InterfaceMesh.h"

#include <vector>

namespace LabelMesh
{
/// Positions are continuous indices of the volume: voxel (i, j, k) has its centre at (i, j, k).
///
/// The material of each voxel's centre, by the parity of the interfaces between it and the space below the volume,
/// along z: with every triangle that is crossed, its two materials change between "inside" and "outside", beginning
/// with the background inside. That needs no orientation and no order among crossings that fall together. Rays meet no
/// edge: they run beside the centres by an infinitely small step, decided exactly. Voxels where no material is inside,
/// or several are, get NoMaterial; in a closed mesh without self-intersections there are none.
std::vector<MaterialId> LabelsByMesh(const std::array<int, 3>& dims, const std::vector<Vec3>& points,
  const std::vector<InterfaceTriangle>& triangles, MaterialId background);

/// The voxels of a volume, x fastest; space outside is background.
struct LabelVoxels
{
  std::array<int, 3> Dims{ 0, 0, 0 };
  Vec3 Spacing = Vec3::Ones();
  MaterialId Background = 0;
  const std::vector<MaterialId>& Ids;
};

/// How far DistancesToVoxels looks, in voxels (geometric mean of the spacings).
inline constexpr double VoxelSearchRadius = 16.0;

/// For each point that triangles use, the distance (in the units of Spacing) to the nearest face of voxels between two
/// materials that are both among those of the triangles around the point. NaN where no triangle is, or no such face
/// within VoxelSearchRadius.
std::vector<double> DistancesToVoxels(
  const LabelVoxels& voxels, const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles);
}

#endif
