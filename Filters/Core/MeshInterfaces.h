// SPDX-License-Identifier: BSD-3-Clause
// From particles to the interface mesh, with local repair of what the particles got wrong.
#ifndef LabelMesh_Core_MeshInterfaces_h
#define LabelMesh_Core_MeshInterfaces_h

#include "IndicatorSet.h"
#include "InterfaceMesh.h"
#include "Monitor.h"

namespace LabelMesh
{
struct MeshOptions
{
  int RepairRounds = 8;      ///< at most; it ends sooner when no fault is left
  int ImprovePasses = 3;     ///< of flipping edges and smoothing vertices
  double RepairBelow = 0.75; ///< radius ratio under which a triangle is mended
  bool CorrectChords = true; ///< whether faces, not vertices, lie on the interfaces
  /// What each material should enclose (length cubed), by material; not positive where that is open, empty: of all.
  std::vector<double> WantedVolumes;
};

struct MeshResult
{
  InterfaceMesh Mesh;
  Index Tetrahedra = 0;
  Index EmptySets = 0;           ///< tetrahedra whose corners share no material
  Index WrongFaces = 0;          ///< faces whose two materials are not in all their vertices' sets
  Index NonManifoldEdges = 0;    ///< edges that some material's surface uses other than twice
  Index NonManifoldVertices = 0; ///< where the triangles of some material form more than one fan
  Index BadTriangles = 0;        ///< below RepairBelow
  double WorstRatio = 1.0;
  int Rounds = 0;            ///< of repair
  Index KeptFromCutting = 0; ///< vertices left as they were, since improved triangles there cut others
};

/// Delaunay tetrahedra of the particles, their labels, and the faces between different labels (paper, section 5.3);
/// then local repair where the particles did not give the mesh that they should (LocalRepair: wrong faces, non-manifold
/// edges and vertices, slivers), better triangles on the cells that there are (MeshImprovement), and vertices moved off
/// their interfaces until the faces lie on them (ChordCorrection). What was free of self-intersections stays so. Throws
/// std::runtime_error when the tetrahedralisation fails.
MeshResult MeshInterfaces(
  const IndicatorSet& indicators, std::vector<Particle> particles, const MeshOptions& options, const Monitor& monitor);
}

#endif
