// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra that conform to the interface mesh.
#ifndef LabelMesh_Core_ConstrainedDelaunay_h
#define LabelMesh_Core_ConstrainedDelaunay_h

#include "InterfaceMesh.h"
#include "Monitor.h"
#include "TetraMesh.h"
#include "TetraQuality.h"

#include <vector>

namespace LabelMesh
{
/// A point inside a material and how far apart points are there.
struct InnerPoint
{
  Vec3 Position = Vec3::Zero();
  double TargetLength = 0.0; ///< world length
};

struct TetraOptions
{
  double LeastDistance = 0.4;   ///< target lengths: points nearer to the interface are left out
  int RefinementRounds = 0;     ///< of inserting the circumcentres of slivers (the paper's SP-1R, SP-2R)
  bool Refine = false;          ///< TetGen inserts points of its own inside (the paper's TG)
  double RadiusEdgeRatio = 1.4; ///< of that: circumradius over shortest edge, at most
  double MinimumDihedral = 0.0; ///< of that: degrees; 0: none
};

struct TetraResult
{
  TetraMesh Mesh;
  Index LeftOut = 0;  ///< points too near to the interface
  Index Added = 0;    ///< points that TetGen had to add, or did on request
  Index Inserted = 0; ///< circumcentres of slivers
};

/// Constrained tetrahedralisation, by TetGen, of an interface mesh and points inside its materials. Materials other
/// than `background` are filled; the triangles of the mesh are faces of tetrahedra just as they are, each between the
/// two materials that it says, and no other face is between two materials: this is checked, for the result to be of
/// use. Points of the mesh that no triangle has are left out, the others keep their order and bits. Throws
/// std::runtime_error where TetGen fails, as it does when triangles cut each other, and where the check does.
TetraResult FillWithTetrahedra(const InterfaceMesh& surface, MaterialId background,
  const std::vector<InnerPoint>& inside, const TetraOptions& options, const Monitor& monitor = Monitor());

/// Puts the vertices of an interface mesh where those of its tetrahedra are, which may have moved (TetraSliding).
void TakePositions(const TetraMesh& tetrahedra, InterfaceMesh& surface);
}

#endif
