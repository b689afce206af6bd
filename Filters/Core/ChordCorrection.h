// SPDX-License-Identifier: BSD-3-Clause
// Moving the vertices of a finished interface mesh so that its faces, not its corners, lie on the interfaces.
#ifndef LabelMesh_Core_ChordCorrection_h
#define LabelMesh_Core_ChordCorrection_h

#include "IndicatorSet.h"
#include "SurfaceComplex.h"

namespace LabelMesh
{
/// A mesh whose vertices lie on curved interfaces cuts off a cap behind each face: convex parts lose volume, in the
/// second order of the edges' length. Here each vertex leaves its interface, along the normal, by the mean gap between
/// the triangles around it and the interface: what faces cut off and what they add nearly cancels, and the mean
/// distance falls.
///
/// The signed gap between a triangle and its interface is to second order a quadratic function that is zero at the
/// corners, so its mean is that of its values at the middles of the three edges. A vertex on a curve leaves it within
/// the plane normal to the curve, by two thirds of the mean gap of the curve at the middles of its two edges there;
/// points of four or more materials stay, and so does what is flat. A vertex stays, too, where what it would move
/// into is thin, so that opposite sheets do not come near each other, and where a triangle would turn or fall below the
/// radius ratio `leastRatio`, or lower if it is below.
///
/// One step: a second one would bring the volumes closer still, but roughens the surface where voxels left steps in it.
/// Returns the number of vertices moved; their Residual is the distance to the interface. The same bits for any number
/// of threads.
Index CorrectChords(const IndicatorSet& indicators, SurfaceComplex& complex, double leastRatio);
}

#endif
