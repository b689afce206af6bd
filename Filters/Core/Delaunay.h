// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay tetrahedralisation behind one narrow function.
#ifndef LabelMesh_Core_Delaunay_h
#define LabelMesh_Core_Delaunay_h

#include "Monitor.h"
#include "Types.h"

#include <vector>

namespace LabelMesh
{
struct Tetrahedralization
{
  std::vector<std::array<std::int32_t, 4>> Corners;
  /// Neighbors[t][j] shares the face of t opposite its corner j; -1 on the convex hull.
  std::vector<std::array<std::int32_t, 4>> Neighbors;

  Index Size() const { return Index(this->Corners.size()); }
};

/// The Delaunay tetrahedra of the points, by CGAL. Points may be fewer than four or all in a plane: no tetrahedra then;
/// of points that coincide one is used. Five and more points on a sphere have more than one Delaunay
/// tetrahedralisation: which one this is depends on the points alone (CGAL's symbolic perturbation), and no tetrahedron
/// is flat. Positions must be finite. Safe to call from many threads. Throws Aborted when the monitor says so, within a
/// fraction of a second, and std::runtime_error when there are too many points.
Tetrahedralization DelaunayTetrahedra(const std::vector<Vec3>& points, const Monitor& monitor = {});
}

#endif
