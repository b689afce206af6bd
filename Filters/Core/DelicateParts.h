// SPDX-License-Identifier: BSD-3-Clause
// Which labels are too thin or too small for the grid of their voxels, and how much finer a grid would hold them.
#ifndef LabelMesh_Core_DelicateParts_h
#define LabelMesh_Core_DelicateParts_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// A label that asks for a finer grid.
struct DelicateLabel
{
  MaterialId Id = NoMaterial;
  Index Voxels = 0;
  Index ThinVoxels = 0;  ///< in parts under two voxels thick
  Index SmallVoxels = 0; ///< in connected components of fewer than 300 voxels
  int Factor = 1;        ///< samples per voxel along each axis that it asks for
};

struct DelicateParts
{
  int Factor = 1;                     ///< the largest that a label asks for
  std::vector<DelicateLabel> Labels;  ///< those that ask for more than one, ascending
  std::vector<std::uint8_t> Delicate; ///< per voxel: 1 where it is thin or in a small component; none with Factor 1
};

/// Looks for what `limit` samples per voxel along each axis, or fewer, would hold better.
///  - A voxel is thin that is in no cube of 2 x 2 x 2 voxels of its label: it asks for 2.
///  - A voxel in a component of V voxels (26-connected) asks for the least n with n^3 V >= 300, at most `limit`: below
///    that the edges of a mesh that go around a part are too few for its volume.
/// A label asks for n where more than a twentieth of its voxels ask for n or more: specks of a large label do not make
/// the whole volume fine. The background asks for nothing. `continued`: labels go on beyond the border (a flat one);
/// else space outside is no part of any label.
DelicateParts FindDelicateParts(const std::array<int, 3>& dims, const std::vector<MaterialId>& ids,
  MaterialId background, int numberOfIds, bool continued, int limit);
}

#endif
