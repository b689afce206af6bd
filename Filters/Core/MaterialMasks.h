// SPDX-License-Identifier: BSD-3-Clause
// From a volume of material ids to one mask per material, each in its own box.
#ifndef LabelMesh_Core_MaterialMasks_h
#define LabelMesh_Core_MaterialMasks_h

#include "GridFrame.h"

#include <vector>

namespace LabelMesh
{
/// Index range of samples, inclusive, as an extent: first and last along each axis. Empty when last < first.
using Box = std::array<int, 6>;

/// The grid with `factor` samples per voxel along each axis, over the same box of voxels (which reaches half a voxel
/// beyond the outermost samples). The number of samples is rounded, and the spacing follows from it. factor = 1: the
/// same grid. Throws std::invalid_argument when an axis would get more than 2^31 - 1 samples.
GridFrame Resampled(const GridFrame& source, double factor);

/// The ids on a finer or coarser grid: each id's 0/1 function is interpolated linearly (averaged with a tent as wide as
/// the new voxel on a coarser grid), and the largest wins; ties go to the smaller id. `repeated` (per voxel; for finer
/// grids): voxels whose new samples all have their id, and that count for no other sample.
std::vector<MaterialId> ResampleLabels(const std::vector<MaterialId>& ids, const GridFrame& from, const GridFrame& to,
  const std::vector<std::uint8_t>* repeated = nullptr);

/// The box of every id below `count`, relative to the first sample of the lattice. One pass over the volume.
std::vector<Box> BoxesOf(const std::vector<MaterialId>& ids, const Lattice& lattice, int count);

/// Samples along an axis that a material's block should reach beyond it: `padding`, and where the spacing is small as
/// many as hold the band of its distances (4 voxels) and one more voxel, unless the padding is fewer voxels than that.
/// Fields that end within the band end in a jump, which passes for a surface where nothing of the materials around is
/// left.
int BlockReach(const Lattice& lattice, int axis, int padding);

struct MaskOptions
{
  double OpeningRadius = 0.0; ///< length; before the closing
  double ClosingRadius = 0.0; ///< length
  int ContinuedLayers = 0;    ///< samples beyond the lattice that repeat the nearest one's id
};

/// 1 where a sample has the id, else 0, in a box that may reach beyond the lattice, where all samples have the id
/// `background` but for the continued layers. Opened and closed by balls as asked for. `mask` has room for the box, x
/// fastest.
void MaskOf(const std::vector<MaterialId>& ids, const Lattice& lattice, MaterialId id, MaterialId background,
  const Box& box, const MaskOptions& options, std::uint8_t* mask);
}

#endif
