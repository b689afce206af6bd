// SPDX-License-Identifier: BSD-3-Clause
// Moving the vertices of a finished interface mesh so that each material encloses the volume that it should.
#ifndef LabelMesh_Core_VolumeCorrection_h
#define LabelMesh_Core_VolumeCorrection_h

#include "IndicatorSet.h"
#include "SurfaceComplex.h"

#include <vector>

namespace LabelMesh
{
/// The volume (length cubed) that the triangles of each material enclose, by material. Sums in the order of the
/// triangles.
std::vector<double> EnclosedVolumes(const SurfaceComplex& complex, int materials);

/// Faces that are few for what they enclose miss some of its volume, whatever lies on the interfaces: a grain of two
/// voxels' radius has a few dozen. The least moves that make up for it, in the mean square over the surface, are
///
///   d_v = (1 / A_v) sum_m lambda_m dV_m / dx_v,
///
/// with A_v the vertex's share of the area: an interface between materials a and b moves along its normal by
/// lambda_a - lambda_b everywhere. The lambda solve one sparse equation per material (Newton's method for
/// V_m = wanted_m with the method of Lagrange multipliers), in a few steps.
///
/// `wanted` has one entry per material. Free is a material where it is not positive (the background), and one that
/// encloses less than half of it, since whole parts of it are missing.
/// A vertex stays where triangles would suffer (VertexMoves), on the faces of the volume's box it stays in them, and it
/// moves by at most a quarter of its shortest edge at a time. Returns the largest relative error of a volume that is
/// left. The same bits for any number of threads.
double CorrectVolumes(
  const IndicatorSet& indicators, const std::vector<double>& wanted, double leastRatio, SurfaceComplex& complex);
}

#endif
