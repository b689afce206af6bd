// SPDX-License-Identifier: BSD-3-Clause
// The interface mesh as a complex that can be edited, and edits that can be taken back.
#ifndef LabelMesh_Core_SurfaceComplex_h
#define LabelMesh_Core_SurfaceComplex_h

#include "InterfaceMesh.h"

#include <vector>

namespace LabelMesh
{
/// Triangles with the triangles around every vertex. An edge has two triangles inside a 2-cell and three or more on a
/// 1-cell, two of different interfaces where nothing but outside is behind one of its three. Deleted triangles have no
/// vertices (-1), deleted vertices an empty star; Compacted() leaves both out.
class SurfaceComplex
{
public:
  explicit SurfaceComplex(InterfaceMesh mesh);

  Index NumberOfVertices() const { return Index(this->Vertices.size()); }
  Index NumberOfTriangles() const { return Index(this->Triangles.size()); }
  const Particle& Vertex(Index v) const { return this->Vertices[v]; }
  const std::vector<Particle>& AllVertices() const { return this->Vertices; } ///< with those that no triangle uses
  const InterfaceTriangle& Triangle(Index t) const { return this->Triangles[t]; }
  bool IsAlive(Index t) const { return this->Triangles[t].Vertices[0] >= 0; }
  const std::vector<std::int32_t>& Star(Index v) const { return this->Stars[v]; }

  /// The triangles at an edge.
  std::vector<std::int32_t> EdgeStar(Index a, Index b) const;
  /// Whether an edge with these triangles lies on a 1-cell: three or more, or two of different interfaces (where a
  /// material's surface bends round an edge of the volume's box).
  bool IsOnCurve(const std::vector<std::int32_t>& edge) const;
  /// The two triangles (a, b, c) and (b, a, d) of an edge inside a 2-cell that may be flipped, with c and d; First is
  /// -1 where it may not: another number of triangles, of more than one interface, or c and d are joined already.
  struct Flippable
  {
    Index First = -1, Second = -1, C = -1, D = -1;
  };
  Flippable FlippableEdge(Index a, Index b) const;
  bool AreJoined(Index a, Index b) const;
  /// The triangles at some vertices (numbers beyond the last have none), ascending.
  std::vector<std::int32_t> TrianglesAt(const std::vector<Index>& vertices) const;
  /// The vertices around v, ascending.
  std::vector<Index> Neighbors(Index v) const;

  double Ratio(Index t) const;
  Vec3 UnitNormal(Index t) const;

  /// From now on the vertex and its triangles take part in no edit: Flip, Collapse and Split return false there.
  void Freeze(Index v) { this->Frozen[v] = 1; }
  bool IsFrozen(Index v) const { return this->Frozen[v]; }
  Index NumberOfFrozen() const;

  /// Moves a vertex. Vertices that share no triangle may be moved by several threads while nothing is recorded.
  void SetVertex(Index v, const Particle& particle);

  /// The two triangles of a flippable edge (a, b) become (c, a, d) and (c, d, b). False, with nothing changed, where it
  /// is none.
  bool Flip(Index a, Index b);
  /// Joins vertex `gone` to `kept`, which stays where it is. False, with nothing changed, where the complex would not
  /// stay what it is: a vertex may move within its own cell and into that cell's border alone, and the two may have no
  /// common neighbours but those of their common triangles (the link condition).
  bool Collapse(Index gone, Index kept);
  /// Puts a new vertex on the edge (a, b), into all its triangles.
  bool Split(Index a, Index b, const Particle& particle);

  Index AddVertex(const Particle& particle);
  /// Whether `inserted` may stand in the place of all triangles at the vertices `core` (ascending): the two must meet
  /// the triangles around them alike, along every edge between vertices outside the core with the same materials from
  /// the same sides.
  bool Fits(const std::vector<Index>& core, const std::vector<InterfaceTriangle>& inserted) const;
  /// Puts them there.
  void ReplaceStars(const std::vector<Index>& core, const std::vector<InterfaceTriangle>& inserted);

  std::vector<InterfaceTriangle> AliveTriangles() const;

  /// From Begin() on, edits are recorded until Commit() keeps them or Rollback() takes them back.
  void Begin();
  void Commit();
  void Rollback();

  InterfaceMesh Compacted() &&;

private:
  struct SavedVertex
  {
    Index Number;
    Particle Value;
    std::vector<std::int32_t> Star;
  };
  struct SavedTriangle
  {
    Index Number;
    InterfaceTriangle Value;
  };

  void Save(Index v);
  void SaveTriangle(Index t);
  void Replace(Index t, Index before, Index after);
  void Leave(Index v, Index t);

  std::vector<Particle> Vertices;
  std::vector<InterfaceTriangle> Triangles;
  std::vector<std::vector<std::int32_t>> Stars;
  std::vector<char> Frozen;
  bool Recording = false;
  std::vector<SavedVertex> SavedVertices;
  std::vector<SavedTriangle> SavedTriangles;
  std::size_t VerticesBefore = 0, TrianglesBefore = 0;
};
}

#endif
