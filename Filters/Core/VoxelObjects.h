// SPDX-License-Identifier: BSD-3-Clause
// What the voxels of each label are made of: parts, cavities, tunnels, and which labels touch.
#ifndef LabelMesh_Core_VoxelObjects_h
#define LabelMesh_Core_VoxelObjects_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// The voxels of one label, as the union of closed cubes: voxels belong together that share a face, an edge or a corner
/// (26-connectivity), and what surrounds them is joined by faces. That is what becomes of most of them in a mesh:
/// smoothing joins what touches. With 6-connectivity every voxel of a rough surface that hangs on by an edge would be a
/// part of its own. All numbers follow from this one rule, with space outside the volume as background.
struct VoxelObject
{
  Index Voxels = 0;
  Index Parts = 0;    ///< connected pieces; the background's reach outside, so that it has one at least
  Index Cavities = 0; ///< hollows that are closed by the label alone
  Index Shells = 0;   ///< pieces of its surface
  Index Euler = 0;    ///< Euler number of its surface: 2 (parts - tunnels + cavities); 2 less for the background
  /// Tunnels (handles): the sum of the genera of the shells.
  Index Genus() const { return this->Shells - this->Euler / 2; }
};

/// One connected piece of a label.
struct VoxelPart
{
  MaterialId Id = NoMaterial;
  Index Voxels = 0; ///< within the volume
  Index First = -1; ///< its first voxel in the order of the samples; -1 for the space outside
};

/// Voxels of one part along x: samples First to Last - 1.
struct VoxelRun
{
  Index First = 0, Last = 0;
  Index Part = 0;
};

struct VoxelContact
{
  std::array<MaterialId, 2> Ids{ NoMaterial, NoMaterial }; ///< ascending
  Index Faces = 0;                                         ///< faces of voxels between the two
};

struct VoxelObjects
{
  std::vector<VoxelObject> Objects;   ///< by id
  std::vector<VoxelPart> Parts;       ///< the first is the background outside and what of it reaches the border
  std::vector<VoxelRun> Runs;         ///< in the order of the samples
  std::vector<VoxelContact> Contacts; ///< ascending
};

/// `ids` of a volume of `dims` samples, x fastest; each is below `numberOfIds`, as is the background's.
VoxelObjects FindVoxelObjects(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background, int numberOfIds);
/// The parts and runs alone, and of each object the numbers of voxels and parts: in a fraction of the time.
VoxelObjects FindVoxelParts(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background, int numberOfIds);
}

#endif
