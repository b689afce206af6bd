// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that cut or touch each other where they should not, found without rounding.
#ifndef LabelMesh_Core_SelfIntersections_h
#define LabelMesh_Core_SelfIntersections_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// The three vertices of a triangle, as indices of points.
using TriangleCorners = std::array<Index, 3>;

struct SelfIntersections
{
  std::vector<std::array<Index, 2>> Pairs; ///< of triangles, each ascending, in ascending order
  Index WithoutArea = 0; ///< triangles (of the subset) that were left out: corners on a line, or not finite
};

/// True when two triangles have more in common than the vertices that they share: without a common vertex, any point
/// at all; with one, any other point; with two, an overlap in a plane; with three, always. Vertices are the same when
/// their index is, whatever their position. Exact within the limits of Orientation (ExactPredicates.h). Both triangles
/// must have an area.
bool TrianglesIntersect(const std::vector<Vec3>& points, const TriangleCorners& a, const TriangleCorners& b);

/// All pairs of triangles that intersect.
SelfIntersections FindSelfIntersections(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles);

/// Only pairs with a triangle of `subset` (indices of triangles), for a mesh that changed in a few places: the cost is
/// one pass over all triangles and a search among those near the subset.
SelfIntersections FindSelfIntersections(
  const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles, const std::vector<Index>& subset);
}

#endif
