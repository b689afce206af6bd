// SPDX-License-Identifier: BSD-3-Clause
// How well a tetrahedron is shaped: for reports, and as what improvement raises.
#ifndef LabelMesh_Core_TetraQuality_h
#define LabelMesh_Core_TetraQuality_h

#include "Types.h"

namespace LabelMesh
{
/// ((b - a) x (c - a)) . (d - a) / 6: positive where a, b, c turn to the left seen from d.
double SignedVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// 3 r_in / r_circ: 1 for a regular tetrahedron, 0 for a flat one; its sign is that of the volume.
double TetraRadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The radius ratio below which a tetrahedron is a sliver, as the paper has it.
inline constexpr double SliverRatio = 0.1;

/// The pairs of corners that are edges, in the order of DihedralAngles().
inline constexpr std::array<std::array<int, 2>, 6> TetraEdges = { { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
  { 2, 3 } } };

/// The angles between faces inside the tetrahedron, in degrees, at each edge of TetraEdges. Where a face has no area
/// its angles are 0.
std::array<double, 6> DihedralAngles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// What improvement raises: the least of the sines of the dihedral angles, those of obtuse angles times ObtuseWeight,
/// and of the radius ratio times RadiusRatioWeight. Negative for a tetrahedron that is turned over, -1 where a face has
/// no area.
/// From 0.21 on all angles are between 12 and 155 degrees, and the radius ratio is 0.25 at least.
double TetraQuality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
inline constexpr double ObtuseWeight = 0.5;
inline constexpr double RadiusRatioWeight = 0.84;

/// One of the terms of which TetraQuality is the least, and how it changes with the tetrahedron's last corner.
struct QualityTerm
{
  double Value;
  Vec3 Gradient; // 1 / length
};
/// All of them, of a tetrahedron that is positively oriented.
std::array<QualityTerm, 7> QualityTerms(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
}

#endif
