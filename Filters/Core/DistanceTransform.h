// SPDX-License-Identifier: BSD-3-Clause
// Exact distances of binary masks up to a bound, and the openings and closings that follow from them.
#ifndef LabelMesh_Core_DistanceTransform_h
#define LabelMesh_Core_DistanceTransform_h

#include "Lattice.h"

#include <cstdint>
#include <vector>

namespace LabelMesh
{
/// The side of every sample: 1 inside, 0 outside.
using Sides = std::vector<std::uint8_t>;

/// Signed distance of a mask (1 inside, 0 outside), > 0 inside, clamped to +-band; lengths as Lattice::Spacing.
///
/// Let v be the vector to the nearest sample of the other side. The interface is taken to cross v half a sample away
/// from that sample: distance = |v| - |S v| / (2 |v|) with S = diag(spacing), which is |v| - spacing / 2 for cubic
/// voxels and half the spacing between two neighbours in any case. Exact: every sample of the other side within the
/// band is looked at. A mask continues beyond the lattice as its border samples do, so no interface lies there. The
/// same bits for any number of threads.
void SignedDistance(const Lattice& frame, const Sides& sides, double band, float* distance);

/// All samples within `radius` (a length, inclusive) of a sample with side `value` get that side.
/// value = 1 is dilation, value = 0 erosion, by a ball.
Sides Grown(const Lattice& frame, const Sides& sides, std::uint8_t value, double radius);

/// Opening (erosion, then dilation) and closing (dilation, then erosion) by a ball of `radius`. The lattice needs a
/// margin of `radius` around the mask, or the closing is cut off at its border.
Sides Opened(const Lattice& frame, const Sides& sides, double radius);
Sides Closed(const Lattice& frame, const Sides& sides, double radius);
}

#endif
