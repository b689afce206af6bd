// SPDX-License-Identifier: BSD-3-Clause
// Junctions of materials: projection onto them, and their tangent spaces.
#ifndef LabelMesh_Core_Junction_h
#define LabelMesh_Core_Junction_h

#include "IndicatorSet.h"

namespace LabelMesh
{
struct ProjectOptions
{
  int MaxIterations = 8;
  double Tolerance = 1e-4; ///< of a voxel: the step below which the projection has converged
  double MaxStep = 0.4;    ///< of a voxel
};

struct Projection
{
  Vec3 Position = Vec3::Zero();
  double Residual = 0.0; ///< world length: the last Gauss-Newton step, which bounds the distance to first order
  bool Converged = false;
};

/// Gauss-Newton projection of x onto the junction of `count` materials (2: surface, 3: curve, 4: point): the point near
/// x where all their indicators are equal, found by solving the differences g = (f_0 - f_1, ..., f_0 - f_{count-1})
/// with x -= J^T (J J^T)^-1 g. Exact for the junction of the true maximum, where the smooth maximum of equations
/// 10 to 13 is biased for three and more materials. It does not ask whether another material is larger there.
/// Where the space beyond faces of the volume's box takes part (never as the first), the result lies on them exactly.
Projection ProjectToJunction(const IndicatorSet& indicators, const MaterialId* materials, int count, const Vec3& x,
  const ProjectOptions& options = {});

/// Unit normal of the interface of a and b at x (equation 6): from a into b. Zero where the gradients agree.
Vec3 InterfaceNormal(const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x);

/// Unit tangent of the curve where a, b and c meet (equation 8, with gradients of the differences, which span the
/// same plane on the junction). Zero where they are degenerate. The first is none beyond a face of the volume's box.
Vec3 CurveTangent(const IndicatorSet& indicators, const MaterialId materials[3], const Vec3& x);

/// Equation 7: the part of v in the plane with unit normal n.
inline Vec3 ToTangentPlane(const Vec3& v, const Vec3& n)
{
  return v - v.dot(n) * n;
}
/// Equation 9: the part of v along the unit tangent t.
inline Vec3 ToTangentLine(const Vec3& v, const Vec3& t)
{
  return v.dot(t) * t;
}
}

#endif
