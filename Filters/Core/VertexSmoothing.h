// SPDX-License-Identifier: BSD-3-Clause
// Moving the vertices of a finished interface mesh, within their own cells, to where their triangles are best.
#ifndef LabelMesh_Core_VertexSmoothing_h
#define LabelMesh_Core_VertexSmoothing_h

#include "IndicatorSet.h"
#include "SurfaceComplex.h"

namespace LabelMesh
{
/// What a triangle of radius ratio q costs: what it lacks, and far more where it lacks much. Edits of the mesh are
/// kept where the sum of the costs around them falls.
inline double TriangleCost(double q)
{
  constexpr double good = 0.75, weight = 6.0;
  const double lack = q < good ? good - q : 0.0;
  return 1.0 - q + weight * lack * lack;
}

/// A vertex may lean its triangles so far away from where they faced, as a cosine.
inline constexpr double LeastTurnOfFace = 0.8;

/// Moves a 2-cell vertex on its interface, or a 1-cell vertex along its curve, by a damped Newton step on the squared
/// inverse mean ratios of its triangles, and keeps the move if the sum of their costs falls and none turns over.
/// 0-cells and merged junctions stay. Returns the length of the move over the vertex's target length; 0: it stayed.
/// Vertices that share no triangle may be smoothed by several threads at once.
double SmoothVertex(const IndicatorSet& indicators, SurfaceComplex& complex, Index v);

/// Sets of vertices of which no two share a triangle: the vertices of each in ascending order.
std::vector<std::vector<Index>> IndependentSets(const SurfaceComplex& complex);

/// Smooths the vertices marked in `active`, one independent set after another: the same bits for any number of threads.
/// Leaves marked those that moved and their neighbours. Returns the number of moves.
Index SmoothVertices(const IndicatorSet& indicators, SurfaceComplex& complex,
  const std::vector<std::vector<Index>>& sets, std::vector<char>& active);
}

#endif
