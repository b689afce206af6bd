// SPDX-License-Identifier: BSD-3-Clause
// Moving the vertices inside materials to where their tetrahedra are best.
#ifndef LabelMesh_Core_TetraSmoothing_h
#define LabelMesh_Core_TetraSmoothing_h

#include "TetraComplex.h"

namespace LabelMesh
{
/// Three corners that make, with a fourth, x, a tetrahedron (a, b, c, x).
using OpenTetra = std::array<Vec3, 3>;

/// The lowest TetraQuality of the tetrahedra of x and faces around it.
double WorstQuality(const std::vector<OpenTetra>& faces, const Vec3& x);

/// Where a point may be moved: a ball, within which some coordinates stay as they are.
struct MoveRegion
{
  Vec3 Centre = Vec3::Zero();
  double Radius = 0.0;
  std::array<bool, 3> Fixed{};

  /// The nearest point of it.
  Vec3 Nearest(const Vec3& x) const;
};

/// Moves x to where the worst tetrahedron of x and the faces around it is better, until that gives little more: steps
/// along the shortest vector within the gradients of the terms of quality that are lowest (Freitag and Ollivier-Gooch
/// 1997). Returns the worst quality there; x stays where nothing is better. With a region it does not leave that.
double RaiseWorst(const std::vector<OpenTetra>& faces, Vec3& x, const MoveRegion* region = nullptr);

/// The faces opposite v of the tetrahedra around it.
void FacesAround(
  const TetraComplex& complex, const std::vector<std::int32_t>& star, Index v, std::vector<OpenTetra>& faces);

/// Moves a vertex inside a material to where its worst tetrahedron is better. False: it stayed.
bool RaiseWorstAt(TetraComplex& complex, Index v);

/// Moves every vertex inside a material by a damped Newton step on the sum of squared inverse mean ratios of its
/// tetrahedra, and keeps the move where that sum falls and no tetrahedron becomes worse than `floor` and than the worst
/// before. One independent set after another: the same bits for any number of threads. Returns the number of moves.
Index SmoothAll(TetraComplex& complex, double floor);
}

#endif
