// SPDX-License-Identifier: BSD-3-Clause
// Other tetrahedra on the same vertices, or without one of them, where their worst is better.
#ifndef LabelMesh_Core_TetraFlips_h
#define LabelMesh_Core_TetraFlips_h

#include "TetraComplex.h"

namespace LabelMesh
{
/// Each of these is kept only where the worst quality of the new tetrahedra is above that of those they replace by
/// LeastRise. The interface's triangles stay. False: nothing was changed.
inline constexpr double LeastRise = 1e-3;

/// Takes out the edge between corners i and j of t: the tetrahedra around it become two for each triangle of the best
/// triangulation of the polygon around it, found by dynamic programming (Klincsek 1980; Shewchuk 2002). With three
/// tetrahedra a 3-2 flip, with four a 4-4 flip.
bool RemoveEdge(TetraComplex& complex, Index t, int i, int j);

/// Takes out the face opposite corner j of t, and faces around it between the same two vertices where that is better
/// (multi-face removal, Shewchuk 2002): the two vertices are joined by an edge. With one face a 2-3 flip.
bool RemoveFaces(TetraComplex& complex, Index t, int j);

/// Joins vertex v, inside a material, to u.
bool Contract(TetraComplex& complex, Index v, Index u);
}

#endif
