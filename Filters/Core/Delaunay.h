// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay tetrahedralisation behind one narrow function.
#ifndef LabelMesh_Core_Delaunay_h
#define LabelMesh_Core_Delaunay_h

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

/// The Delaunay tetrahedra of the points, by TetGen. Points may be fewer than four or all in a plane: no tetrahedra
/// then. One at a time per process: TetGen is not thread-safe. Throws std::runtime_error with TetGen's reason.
Tetrahedralization DelaunayTetrahedra(const std::vector<Vec3>& points);
}

#endif
