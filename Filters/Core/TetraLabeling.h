// SPDX-License-Identifier: BSD-3-Clause
// From particles to the interface mesh: Delaunay tetrahedra, their labels, the faces between different labels, repair
// (paper, sections 4.3 and 5.3).
#ifndef LabelMesh_Core_TetraLabeling_h
#define LabelMesh_Core_TetraLabeling_h

#include "IndicatorSet.h"
#include "InterfaceMesh.h"
#include "Monitor.h"

namespace LabelMesh
{
struct MeshOptions
{
  int RepairRounds = 6;
  double RepairBelow = 0.35; ///< radius ratio under which a triangle is repaired
};

struct MeshResult
{
  InterfaceMesh Mesh;
  Index Tetrahedra = 0;
  Index WrongFaces = 0;       ///< faces whose two materials are not in all their vertices' sets
  Index NonManifoldEdges = 0; ///< edges that some material's surface uses other than twice
  Index NonManifoldVertices = 0;
  int Rounds = 0;
  double WorstRatio = 1.0;
};

/// Throws std::runtime_error when the tetrahedralisation fails.
MeshResult MeshInterfaces(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const MeshOptions& options, const Monitor& monitor);
}

#endif
