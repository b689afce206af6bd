// SPDX-License-Identifier: BSD-3-Clause
// The mesh of all material interfaces: each triangle once, with the materials on its two sides.
#ifndef LabelMesh_Core_InterfaceMesh_h
#define LabelMesh_Core_InterfaceMesh_h

#include "Particles.h"

#include <Eigen/Geometry>

#include <vector>

namespace LabelMesh
{
struct InterfaceTriangle
{
  std::array<Index, 3> Vertices{ -1, -1, -1 };
  /// The materials on the two sides; the normal (right-hand rule, local frame) points from the first to the second.
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial };
};

struct InterfaceMesh
{
  std::vector<Particle> Vertices;
  std::vector<InterfaceTriangle> Triangles;
};

/// Radius ratio 2 r_in / r_circ of a triangle: 1 equilateral, 0 degenerate.
inline double RadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c)
{
  // r_in = A / s and r_circ = l0 l1 l2 / (4 A) with s half the perimeter.
  const double l0 = (b - a).norm(), l1 = (c - b).norm(), l2 = (a - c).norm();
  const double product = l0 * l1 * l2;
  return product > 0.0 ? 4.0 * (b - a).cross(c - a).squaredNorm() / ((l0 + l1 + l2) * product) : 0.0;
}
}

#endif
