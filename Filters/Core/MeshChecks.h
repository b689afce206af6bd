// SPDX-License-Identifier: BSD-3-Clause
// Facts about an interface mesh: quality, closedness, manifoldness and volume of every material's surface.
#ifndef LabelMesh_Core_MeshChecks_h
#define LabelMesh_Core_MeshChecks_h

#include "InterfaceMesh.h"

#include <vector>

namespace LabelMesh
{
/// Radius ratios (2 r_in / r_circ) and areas of some triangles; the ratios are 1 when there are none.
struct TriangleQuality
{
  Index Triangles = 0;
  double MinRadiusRatio = 1.0;
  double MeanRadiusRatio = 1.0;
  double Area = 0.0; ///< world length squared
};

/// The surface of one material: all triangles with the material on one side, seen from it.
struct MaterialCheck
{
  TriangleQuality Quality;
  Index Vertices = 0;
  Index OpenEdges = 0;           ///< used by an odd number of the surface's triangles
  Index NonManifoldEdges = 0;    ///< used by an even number of four or more
  Index MisorientedEdges = 0;    ///< used by an even number, but not equally often in both directions
  Index NonManifoldVertices = 0; ///< whose triangles form more than one fan across edges of two
  Index Components = 0;          ///< pieces of triangles that share vertices
  Index Euler = 0;               ///< vertices - edges + triangles
  double Volume = 0.0;           ///< by the divergence theorem; means something where Closed and Oriented

  bool Closed() const { return this->OpenEdges == 0; }
  bool EdgeManifold() const { return this->OpenEdges == 0 && this->NonManifoldEdges == 0; }
  bool Oriented() const { return this->MisorientedEdges == 0; }
};

/// The triangles between two materials.
struct PairCheck
{
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial }; ///< ascending
  TriangleQuality Quality;
};

struct MeshCheck
{
  TriangleQuality Quality;              ///< every triangle once
  double FirstPercentileRatio = 1.0;    ///< the radius ratio that one triangle in a hundred falls below
  std::vector<MaterialCheck> Materials; ///< by material id
  std::vector<PairCheck> Pairs;         ///< ascending; only those with triangles
  Index Vertices = 0;                   ///< that triangles use
  Index DuplicateTriangles = 0;         ///< more triangles on the same three vertices than one
  Index DegenerateTriangles = 0;        ///< a vertex twice, or a ratio below 1e-10
  Index SameMaterialTriangles = 0;      ///< with one material on both sides; left out of everything else
  Index WrongFaces = 0; ///< whose two materials are not in the sets of all their vertices; 0 without sets
};

/// Counts whatever it finds; a broken mesh is no error. `sets` are the material sets of the points, or empty.
/// Throws std::invalid_argument when a triangle names a point or a material that does not exist.
MeshCheck CheckMesh(const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles,
  int numberOfMaterials, const std::vector<MaterialSet>& sets = {});
}

#endif
