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
  int RepairRounds = 8;     ///< at most; it ends sooner when nothing is left to repair
  double RepairBelow = 0.5; ///< radius ratio under which a triangle is repaired
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
  int Rounds = 0;
};

/// Delaunay tetrahedra of the particles, their labels, and the faces between different labels (paper, section 5.3);
/// then rounds of local repair: at each triangle below RepairBelow, wrong face and non-manifold edge, particles are
/// deleted or added and their neighbours relaxed; a site's change stays only while the site has become better. Throws
/// std::runtime_error when the tetrahedralisation fails.
MeshResult MeshInterfaces(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const MeshOptions& options, const Monitor& monitor);
}

#endif
