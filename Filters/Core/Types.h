// SPDX-License-Identifier: BSD-3-Clause
// Small types that every part of Core shares.
#ifndef LabelMesh_Core_Types_h
#define LabelMesh_Core_Types_h

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace LabelMesh
{
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Counts and positions in arrays; 64 bits before anything is multiplied.
using Index = std::int64_t;

/// A label as the user knows it.
using Label = std::int64_t;

/// The position of a material in an IndicatorSet: compact, ordered as the labels are.
using MaterialId = std::uint16_t;
inline constexpr MaterialId NoMaterial = 0xFFFF;
}

#endif
