// SPDX-License-Identifier: BSD-3-Clause
// On which side points lie, without rounding: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates (1997). No state: TetGen's own versions keep their constants in variables that every run of
// TetGen computes anew, so that a run in another thread could make them wrong.
#ifndef LabelMesh_Core_ExactPredicates_h
#define LabelMesh_Core_ExactPredicates_h

#include "Types.h"

namespace LabelMesh
{
/// The sign of ((b - a) x (c - a)) . (d - a): 1 where d is on the side that the normal of a, b, c points to, -1 on the
/// other, 0 in their plane. Exact while products of three differences of coordinates neither overflow nor underflow:
/// for differences between 1e-90 and 1e100, or 0.
int Orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The same in a plane of coordinates: the sign of (b - a) x (c - a) of the components u and v.
int Orientation(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v);

/// True when the three points lie on a line.
bool Collinear(const Vec3& a, const Vec3& b, const Vec3& c);
}

#endif
