// SPDX-License-Identifier: BSD-3-Clause
// Specks of a label volume, given to what surrounds them.
#ifndef LabelMesh_Core_SmallComponents_h
#define LabelMesh_Core_SmallComponents_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// A connected component that was given to another label.
struct DroppedComponent
{
  MaterialId From = NoMaterial, To = NoMaterial;
  Index Voxels = 0;
  Index First = -1; ///< its first voxel in the order of the samples
};

/// Gives each 26-connected component (see VoxelObjects.h) with fewer than `least` voxels to the label that it shares
/// most faces of voxels with, the smaller id among equals; the background's components stay, and space outside
/// counts as background. Components that have only other small ones around them wait until those have been given away.
/// What grows by that is not judged anew. Returns them in the order of their first voxels.
std::vector<DroppedComponent> DropSmallComponents(
  const std::array<int, 3>& dims, std::vector<MaterialId>& ids, MaterialId background, int numberOfIds, Index least);
}

#endif
