// SPDX-License-Identifier: BSD-3-Clause
// How near points are to a triangle mesh.
#ifndef LabelMesh_Core_TriangleDistance_h
#define LabelMesh_Core_TriangleDistance_h

#include "BoxTree.h"
#include "SelfIntersections.h"

#include <vector>

namespace LabelMesh
{
/// The squared distance of x from a triangle.
double SquaredDistance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Triangles in a tree of boxes; the points and triangles are not owned. Const and safe to ask from many threads.
class TriangleDistance
{
public:
  TriangleDistance(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles);

  /// True when some triangle is nearer to x than `distance`.
  bool IsNearer(const Vec3& x, double distance) const;

private:
  const std::vector<Vec3>& Points;
  const std::vector<TriangleCorners>& Triangles;
  BoxTree Tree;
};
}

#endif
