// SPDX-License-Identifier: BSD-3-Clause
// How much space each material holds.
#ifndef LabelMesh_Core_PartitionVolumes_h
#define LabelMesh_Core_PartitionVolumes_h

#include "IndicatorSet.h"

namespace LabelMesh
{
/// The volume (world length cubed) where each block's field is the largest, by block; of the space between the samples
/// of the working lattice. That is what a mesh of the interfaces encloses: the field of one material alone says less,
/// since its neighbours fill what it leaves. Cells of the lattice whose corners differ are cut
/// into 4^3 parts, by the interpolants (Catmull-Rom, as of the indicators: trilinear ones cut off what is round) of the
/// corners' materials. Fields are read at the samples of the working lattice, between those of a block with a grid of
/// its own by trilinear interpolation.
std::vector<double> PartitionVolumes(const std::vector<IndicatorBlock>& blocks, const Lattice& working);
}

#endif
