// SPDX-License-Identifier: BSD-3-Clause
// Mending single bad triangles of a finished interface mesh by edits of the mesh itself.
#ifndef LabelMesh_Core_TriangleMending_h
#define LabelMesh_Core_TriangleMending_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "SurfaceComplex.h"

#include <algorithm>

namespace LabelMesh
{
/// What a triangle of radius ratio q below the wanted one costs: 1 and up to 111, rather several that lack a little
/// than one that lacks much; and as much again for what it lacks of a poor ratio. 0 from the wanted ratio on.
inline double TriangleFault(double q, double wanted)
{
  constexpr double poor = 0.5;
  const auto cost = [q](double ratio)
  {
    const double lack = q < ratio ? 1.0 - q / ratio : 0.0;
    return lack > 0.0 ? 1.0 + 10.0 * lack + 100.0 * lack * lack : 0.0;
  };
  return cost(wanted) + 5.0 * cost(std::min(poor, wanted));
}

struct MendResult
{
  Index Mended = 0; ///< triangles at which an edit made the mesh better
  Index Left = 0;   ///< triangles below the wanted ratio
};

/// At each triangle below the wanted ratio every edge is collapsed, flipped and split in turn and the vertices around
/// smoothed; the edit that leaves the least faults around is kept if that is less than before. Repeats while it helps.
MendResult MendTriangles(
  const IndicatorSet& indicators, SurfaceComplex& complex, double wantedRatio, const Monitor& monitor = {});
}

#endif
