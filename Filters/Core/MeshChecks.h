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
  Index Worst = -1;  ///< the first triangle with the least ratio; -1 when there are none
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
  Index OuterShells = 0;         ///< components that enclose a positive volume: one per part of the material...
  Index InnerShells = 0;         ///< ... and those that enclose a negative one: around its cavities
  Index SelfIntersections = 0;   ///< pairs of the surface's triangles that intersect
  double Volume = 0.0;           ///< by the divergence theorem; means something where Closed and Oriented

  /// Handles, of all components together; means something where Closed and Manifold.
  Index Genus() const { return this->Components - this->Euler / 2; }
  bool Closed() const { return this->OpenEdges == 0; }
  bool EdgeManifold() const { return this->OpenEdges == 0 && this->NonManifoldEdges == 0; }
  bool VertexManifold() const { return this->NonManifoldVertices == 0; }
  bool Manifold() const { return this->EdgeManifold() && this->VertexManifold(); }
  bool Oriented() const { return this->MisorientedEdges == 0; }
  /// Closed, manifold, oriented and without self-intersection.
  bool Sound() const { return this->Manifold() && this->Oriented() && this->SelfIntersections == 0; }
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
  Index SelfIntersectingPairs = 0;      ///< of triangles; see FindSelfIntersections
  Index SelfIntersectingTriangles = 0;  ///< that are in such a pair
  Index FirstIntersecting = -1;         ///< the first of them
  Index WrongFaces = 0; ///< whose two materials are not in the sets of all their vertices; 0 without sets
};

/// Counts whatever it finds; a broken mesh is no error. `sets` are the material sets of the points, or empty.
/// Throws std::invalid_argument when a triangle names a point or a material that does not exist.
MeshCheck CheckMesh(const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles,
  int numberOfMaterials, const std::vector<MaterialSet>& sets = {});
}

#endif
