// SPDX-License-Identifier: BSD-3-Clause
// A regular lattice of samples in the local frame, and a dense field on one.
#ifndef LabelMesh_Core_Lattice_h
#define LabelMesh_Core_Lattice_h

#include "Types.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LabelMesh
{
/// Samples at Origin + Spacing * (i, j, k), 0 <= i < Dims[0] ..., x fastest.
///
/// Core works in the *local frame*: axis-aligned with the samples, lengths in world units, its zero at the
/// sample of index (0, 0, 0) of the source grid. GridFrame maps it to the world by an isometry, so that
/// distances, angles and volumes are the same in both.
struct Lattice
{
  std::array<int, 3> Dims{ 0, 0, 0 };
  Vec3 Origin = Vec3::Zero();
  Vec3 Spacing = Vec3::Ones();

  Index Size() const { return Index(Dims[0]) * Dims[1] * Dims[2]; }
  Index At(Index i, Index j, Index k) const { return i + Dims[0] * (j + Dims[1] * k); }
  Vec3 Position(double i, double j, double k) const { return Origin + Spacing.cwiseProduct(Vec3(i, j, k)); }
  std::array<int, 3> Coordinates(Index at) const
  {
    const Index row = at / Dims[0];
    return { int(at % Dims[0]), int(row % Dims[1]), int(row / Dims[1]) };
  }
  /// Continuous index of a local position.
  Vec3 ToIndex(const Vec3& local) const { return (local - Origin).cwiseQuotient(Spacing); }
  /// The voxel as a unit of length: the geometric mean of the three spacings.
  double VoxelSize() const { return std::cbrt(Spacing.prod()); }
  double VoxelVolume() const { return Spacing.prod(); }
};

/// A field that owns its samples.
template <typename T>
struct Grid
{
  Lattice Frame;
  std::vector<T> Values;

  Grid() = default;
  explicit Grid(const Lattice& frame, T value = T())
    : Frame(frame)
    , Values(static_cast<std::size_t>(frame.Size()), value)
  {
  }
  T& operator()(Index i, Index j, Index k) { return this->Values[this->Frame.At(i, j, k)]; }
  const T& operator()(Index i, Index j, Index k) const { return this->Values[this->Frame.At(i, j, k)]; }

  /// Trilinear value at a local position; positions outside take the nearest border value.
  double Trilinear(const Vec3& local) const
  {
    const Vec3 index = this->Frame.ToIndex(local);
    Index cell[3];
    double t[3];
    Index step[3] = { 1, this->Frame.Dims[0], Index(this->Frame.Dims[0]) * this->Frame.Dims[1] };
    for (int a = 0; a < 3; ++a)
    {
      const double last = this->Frame.Dims[a] - 1;
      const double u = std::clamp(index[a], 0.0, last);
      cell[a] = std::min<Index>(Index(u), std::max<Index>(Index(last) - 1, 0));
      t[a] = u - double(cell[a]);
      if (this->Frame.Dims[a] == 1)
      {
        step[a] = 0;
      }
    }
    const T* v = this->Values.data() + this->Frame.At(cell[0], cell[1], cell[2]);
    const auto alongX = [&](Index at) { return v[at] + t[0] * (double(v[at + step[0]]) - v[at]); };
    const double v00 = alongX(0), v10 = alongX(step[1]);
    const double v01 = alongX(step[2]), v11 = alongX(step[1] + step[2]);
    const double v0 = v00 + t[1] * (v10 - v00), v1 = v01 + t[1] * (v11 - v01);
    return v0 + t[2] * (v1 - v0);
  }
};
}

#endif
