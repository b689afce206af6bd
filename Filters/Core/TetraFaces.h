// SPDX-License-Identifier: BSD-3-Clause
// Where a tetrahedral mesh of several materials has interfaces and where it ends.
#ifndef LabelMesh_Core_TetraFaces_h
#define LabelMesh_Core_TetraFaces_h

#include "TetraMesh.h"

namespace LabelMesh
{
/// The corners of the face opposite to corner n of a positively oriented tetrahedron, counterclockwise from outside.
inline constexpr int FaceCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

/// Turns tetrahedra of negative volume over (their last two corners change places). Returns how many have none.
Index OrientTetrahedra(TetraMesh& mesh);

struct TetraFace
{
  std::int32_t Tetra = 0;
  std::uint8_t Opposite = 0; ///< the corner of the tetrahedron that the face does not have
};

/// The sides of a box: -x, +x, -y, +y, -z, +z.
inline constexpr int NoSide = -1;

/// All faces between two materials, or with one side of the mesh's box besides.
struct FacePatch
{
  /// The background second, else ascending. Faces are of tetrahedra of the first, so that their normals point from the
  /// first to the second.
  std::array<MaterialId, 2> Materials = { NoMaterial, NoMaterial };
  int Side = NoSide; ///< side of the mesh's box that these outer faces lie in
  std::vector<TetraFace> Faces;
};

/// The faces between tetrahedra of different materials, and the outer faces, beyond which is the background; ascending
/// by materials, then side, then tetrahedron. The columns of `axes` are those of the mesh's box. Where each is an axis
/// of the coordinates faces lie in a side exactly; else to 1e-9 of the box's size, since a turned face has lost digits.
/// Throws std::invalid_argument with a sentence when a face belongs to three tetrahedra.
std::vector<FacePatch> FindPatches(const TetraMesh& mesh, MaterialId background, const Mat3& axes = Mat3::Identity());
}

#endif
