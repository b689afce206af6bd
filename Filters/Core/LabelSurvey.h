// SPDX-License-Identifier: BSD-3-Clause
// How many voxels each label has, and which labels touch: all that a table of materials needs before anything is
// meshed.
#ifndef LabelMesh_Core_LabelSurvey_h
#define LabelMesh_Core_LabelSurvey_h

#include "Monitor.h"
#include "VoxelObjects.h"

namespace LabelMesh
{
struct LabelSurvey
{
  std::vector<Index> Voxels;          ///< by id
  std::vector<VoxelContact> Contacts; ///< ascending; the same as FindVoxelObjects finds
};

/// `ids` of a volume of `dims` samples, x fastest; each is below `numberOfIds`, as is the background's, to which space
/// outside the volume belongs. One pass, in parallel.
LabelSurvey SurveyLabels(const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background,
  int numberOfIds, const Monitor& monitor);
}

#endif
