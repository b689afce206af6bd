// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra that fill the materials, conforming to the interface mesh.
#ifndef LabelMesh_Core_TetraMesh_h
#define LabelMesh_Core_TetraMesh_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
struct TetraMesh
{
  /// The first SurfacePoints are the interface mesh's vertices, in its order; the others lie inside materials.
  std::vector<Vec3> Points;
  Index SurfacePoints = 0;
  /// Positively oriented: (c1 - c0) x (c2 - c0) . (c3 - c0) > 0.
  std::vector<std::array<std::int32_t, 4>> Corners;
  std::vector<MaterialId> Materials; ///< one for each tetrahedron
};
}

#endif
