// SPDX-License-Identifier: BSD-3-Clause
// How much space each material holds.
#ifndef LabelMesh_Core_PartitionVolumes_h
#define LabelMesh_Core_PartitionVolumes_h

#include "IndicatorSet.h"

namespace LabelMesh
{
/// The volume (world length cubed) where each material's indicator is the largest, by material; the background's within
/// the working lattice. That is what a mesh of the interfaces encloses: the indicator of one material alone says less,
/// since its neighbours fill what it leaves. Cells of the lattice whose corners differ are cut into 4^3 parts, by the
/// trilinear interpolants of the corners' materials.
std::vector<double> PartitionVolumes(const IndicatorSet& indicators);
}

#endif
