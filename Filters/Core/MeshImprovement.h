// SPDX-License-Identifier: BSD-3-Clause
// The last stage of meshing: better triangles on the same cells.
#ifndef LabelMesh_Core_MeshImprovement_h
#define LabelMesh_Core_MeshImprovement_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "SurfaceComplex.h"

namespace LabelMesh
{
struct ImproveOptions
{
  int Passes = 4;            ///< of flipping edges and smoothing vertices
  double WantedRatio = 0.75; ///< triangles below are mended by collapses and splits
};

struct ImproveResult
{
  Index Moves = 0, Flips = 0, Mended = 0;
};

/// Improves the triangles of an interface mesh and leaves alone what it is: which materials meet where, the curves and
/// points of its junctions, how its pieces hang together. Edges inside 2-cells are flipped and vertices moved within
/// their cells where that lowers the cost of the triangles around (see TriangleCost). Then, at each triangle below the
/// wanted ratio, edges are collapsed, split and flipped, their surroundings smoothed, and what has become better stays.
/// Throws Aborted when the monitor asks to stop.
ImproveResult ImproveMesh(
  const IndicatorSet& indicators, SurfaceComplex& complex, const ImproveOptions& options, const Monitor& monitor);
}

#endif
