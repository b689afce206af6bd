// SPDX-License-Identifier: BSD-3-Clause
// New vertices inside materials, where no others of the same vertices are good tetrahedra.
#ifndef LabelMesh_Core_TetraInsertion_h
#define LabelMesh_Core_TetraInsertion_h

#include "TetraComplex.h"

namespace LabelMesh
{
/// Puts a new vertex in the place of t and of tetrahedra around it (Klingner and Shewchuk 2008): begins in the middle
/// of an edge, with the tetrahedra around that, adds those beyond faces that make bad tetrahedra with the vertex, and
/// moves the vertex to where the worst is best. Kept where that is above the worst before; else nothing is changed, and
/// the result is false.
bool InsertVertex(TetraComplex& complex, Index t);
}

#endif
