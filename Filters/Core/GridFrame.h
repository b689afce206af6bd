// SPDX-License-Identifier: BSD-3-Clause
// Index <-> world for oriented images: the only place that maps.
#ifndef LabelMesh_Core_GridFrame_h
#define LabelMesh_Core_GridFrame_h

#include "Lattice.h"

#include <Eigen/LU>

namespace LabelMesh
{
/// The frame of an oriented image: world = Origin + Direction * (Spacing * index).
///
/// Direction is orthonormal; a determinant of -1 (a mirrored image) is legal. The local frame of Core has its zero
/// at index (0, 0, 0) and the axes of the image: world = Origin + Direction * local.
class GridFrame
{
public:
  GridFrame() = default;
  /// Throws std::invalid_argument when the extent is not three-dimensional, a spacing is not positive or the
  /// direction matrix is not orthonormal (to 1e-4).
  GridFrame(const std::array<int, 6>& extent, const Vec3& origin, const Vec3& spacing, const Mat3& direction);

  const std::array<int, 6>& Extent() const { return this->Extent_; }
  const Vec3& Origin() const { return this->Origin_; }
  const Vec3& Spacing() const { return this->Spacing_; }
  const Mat3& Direction() const { return this->Direction_; }

  Vec3 ToWorld(double i, double j, double k) const
  {
    return this->LocalToWorld(this->Spacing_.cwiseProduct(Vec3(i, j, k)));
  }
  Vec3 ToIndex(const Vec3& world) const { return this->WorldToLocal(world).cwiseQuotient(this->Spacing_); }
  Vec3 LocalToWorld(const Vec3& local) const { return this->Origin_ + this->Direction_ * local; }
  Vec3 WorldToLocal(const Vec3& world) const { return this->Direction_.transpose() * (world - this->Origin_); }
  /// A direction (normal, gradient), not a position.
  Vec3 VectorToWorld(const Vec3& local) const { return this->Direction_ * local; }

  /// True when the local frame is left-handed in the world: triangles must be turned over at the door.
  bool Mirrored() const { return this->Direction_.determinant() < 0; }

  /// The samples of the extent as a lattice of the local frame.
  Lattice Samples() const;
  /// The same with `margin` more samples on every side.
  GridFrame Grown(int margin) const;
  /// The lattice, in *this* local frame, of another image that shares the direction matrix.
  /// Throws std::invalid_argument when the direction differs.
  Lattice LatticeOf(const GridFrame& other) const;

private:
  std::array<int, 6> Extent_{ 0, -1, 0, -1, 0, -1 };
  Vec3 Origin_ = Vec3::Zero();
  Vec3 Spacing_ = Vec3::Ones();
  Mat3 Direction_ = Mat3::Identity();
};
}

#endif
