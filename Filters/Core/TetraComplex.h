// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra with what is next to each, of which groups can be replaced by others.
#ifndef LabelMesh_Core_TetraComplex_h
#define LabelMesh_Core_TetraComplex_h

#include "TetraMesh.h"

#include <vector>

namespace LabelMesh
{
using TetraCorners = std::array<std::int32_t, 4>;
using FaceCorners = std::array<std::int32_t, 3>;

/// The face opposite corner j of a tetrahedron, turned so that FaceOpposite(corners, j) and corner j are the
/// tetrahedron again, with the same orientation.
inline FaceCorners FaceOpposite(const TetraCorners& c, int j)
{
  constexpr int others[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  return { c[others[j][0]], c[others[j][1]], c[others[j][2]] };
}

/// Numbers of tetrahedra are never used again: a number stands for the same four vertices as long as it is alive.
class TetraComplex
{
public:
  /// Throws std::runtime_error where a face has more than two tetrahedra.
  explicit TetraComplex(TetraMesh mesh);
  /// What is alive, in ascending order, without the interior points that nothing uses any more.
  TetraMesh Compacted() const;

  Index Size() const { return Index(this->Mesh.Corners.size()); } ///< with those that are not alive
  Index NumberOfPoints() const { return Index(this->Mesh.Points.size()); }
  bool IsAlive(Index t) const { return this->Mesh.Corners[t][0] >= 0; }
  const TetraCorners& Corners(Index t) const { return this->Mesh.Corners[t]; }
  MaterialId Material(Index t) const { return this->Mesh.Materials[t]; }
  double Quality(Index t) const { return this->Qualities[t]; } ///< TetraQuality
  const Vec3& Point(Index v) const { return this->Mesh.Points[v]; }
  const std::vector<Vec3>& Points() const { return this->Mesh.Points; }
  /// Vertices of the interface, and numbers of points that nothing uses any more.
  bool IsFixed(Index v) const { return v < this->Mesh.SurfacePoints || this->Incident[v] < 0; }
  double QualityOf(const TetraCorners& c) const;

  /// The tetrahedron beyond the face opposite corner j, -1 where there is none.
  std::int32_t Neighbor(Index t, int j) const
  {
    const std::int32_t link = this->Links[t][j];
    return link < 0 ? -1 : link / 4;
  }
  /// The same, -1 also where it is of another material: the face belongs to the interface.
  std::int32_t Inside(Index t, int j) const
  {
    const std::int32_t neighbor = this->Neighbor(t, j);
    return neighbor >= 0 && this->Material(neighbor) == this->Material(t) ? neighbor : -1;
  }
  /// Which corner of t the vertex is; -1: none.
  int CornerOf(Index t, Index v) const;

  /// The tetrahedra at a vertex inside a material.
  void Star(Index v, std::vector<std::int32_t>& star) const;

  /// The tetrahedra around the edge of corners i and j of t, and the vertices around it: Tetrahedra[n] is, with its
  /// orientation, (first, second, Vertices[n], Vertices[n + 1]). Closed is false where the edge is on the interface.
  struct Ring
  {
    std::vector<std::int32_t> Tetrahedra, Vertices;
    bool Closed = false;
  };
  void EdgeRing(Index t, int i, int j, Ring& ring) const;

  /// New vertex that no tetrahedron uses yet.
  std::int32_t AddPoint(const Vec3& x);
  void DropLastPoint();
  /// Moves a vertex inside a material, with its star. Vertices without a common tetrahedron may be moved by several
  /// threads at once.
  void MovePoint(Index v, const Vec3& x, const std::vector<std::int32_t>& star);

  /// Puts tetrahedra in the place of others of one material. False, with nothing changed, where the outer faces of the
  /// two groups are not the same.
  bool Replace(const std::vector<std::int32_t>& removed, const std::vector<TetraCorners>& added);

private:
  /// A face on the border of what Replace works on. Link says which tetrahedron has it, counted as in Links.
  struct OpenFace
  {
    FaceCorners Corners; // ascending
    std::int32_t Link;
    bool operator<(const OpenFace& other) const
    {
      return this->Corners != other.Corners ? this->Corners < other.Corners : this->Link < other.Link;
    }
  };
  void LinkFaces();
  void Link(std::int32_t a, std::int32_t b);
  bool MatchFaces(const std::vector<std::int32_t>& removed, const std::vector<TetraCorners>& added);

  TetraMesh Mesh;                                 // corners of tetrahedra that are not alive: -1
  std::vector<std::array<std::int32_t, 4>> Links; // 4 x tetrahedron + corner opposite the same face; -1: none
  std::vector<double> Qualities;
  std::vector<std::int32_t> Incident; // for each vertex one tetrahedron at it; -1: none
  std::vector<OpenFace> OpenFaces;    // of Replace, memory kept
};
}

#endif
