// SPDX-License-Identifier: BSD-3-Clause
#include "InterfaceMesh.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
double RadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c)
{
  // r_in = A / s and r_circ = l0 l1 l2 / (4 A) with s half the perimeter.
  const double l0 = (b - a).norm(), l1 = (c - b).norm(), l2 = (a - c).norm();
  const double product = l0 * l1 * l2;
  if (!(product > 0.0))
  {
    return 0.0;
  }
  const double area = 0.5 * (b - a).cross(c - a).norm();
  return 16.0 * area * area / ((l0 + l1 + l2) * product);
}
}
