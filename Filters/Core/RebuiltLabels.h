// SPDX-License-Identifier: BSD-3-Clause
// Label images rebuilt from the indicators.
#ifndef LabelMesh_Core_RebuiltLabels_h
#define LabelMesh_Core_RebuiltLabels_h

#include "IndicatorSet.h"
#include "Monitor.h"

#include <vector>

namespace LabelMesh
{
struct RebuiltLabels
{
  std::vector<LabelMesh::Label> Labels; ///< of the material with the largest indicator
  std::vector<float> Margin;            ///< the largest indicator minus the second, world length
};

/// At the samples of `image` straight from the samples of the blocks, where all have the same spacing and their samples
/// coincide with those of the image (CanRebuildFromSamples). Ties go to the smaller label.
/// Where no second material reaches, the margin is twice the indicator, as if that of a second were its negative.
bool CanRebuildFromSamples(const std::vector<IndicatorBlock>& blocks, const Lattice& image);
RebuiltLabels RebuildFromSamples(
  const std::vector<IndicatorBlock>& blocks, const Lattice& image, const Monitor& monitor);

/// The same on any lattice, by interpolation. The second material is sought among the candidates only: beyond about two
/// voxels from an interface the margin is twice the indicator.
RebuiltLabels RebuildLabels(const IndicatorSet& indicators, const Lattice& image, const Monitor& monitor);
}

#endif
