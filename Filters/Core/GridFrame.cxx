// SPDX-License-Identifier: BSD-3-Clause
#include "GridFrame.h"

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
GridFrame::GridFrame(const std::array<int, 6>& extent, const Vec3& origin, const Vec3& spacing, const Mat3& direction)
  : Extent_(extent)
  , Origin_(origin)
  , Spacing_(spacing)
  , Direction_(direction)
{
  for (int a = 0; a < 3; ++a)
  {
    if (extent[2 * a + 1] < extent[2 * a])
    {
      throw std::invalid_argument("the image is empty along axis " + std::to_string(a));
    }
    if (!(spacing[a] > 0) || !std::isfinite(spacing[a]))
    {
      throw std::invalid_argument("the spacing along axis " + std::to_string(a) + " is " + std::to_string(spacing[a]) +
        ", expected a positive length");
    }
  }
  const double orthonormality = (direction.transpose() * direction - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(orthonormality < 1e-4) || !origin.allFinite())
  {
    throw std::invalid_argument("the direction matrix is not orthonormal, or the origin is not finite");
  }
}

Lattice GridFrame::Samples() const
{
  Lattice samples;
  samples.Spacing = this->Spacing_;
  for (int a = 0; a < 3; ++a)
  {
    samples.Dims[a] = this->Extent_[2 * a + 1] - this->Extent_[2 * a] + 1;
    samples.Origin[a] = this->Spacing_[a] * this->Extent_[2 * a];
  }
  return samples;
}

GridFrame GridFrame::Grown(int margin) const
{
  GridFrame grown = *this;
  for (int a = 0; a < 3; ++a)
  {
    grown.Extent_[2 * a] -= margin;
    grown.Extent_[2 * a + 1] += margin;
  }
  return grown;
}

Lattice GridFrame::LatticeOf(const GridFrame& other) const
{
  if ((other.Direction_ - this->Direction_).cwiseAbs().maxCoeff() > 1e-4)
  {
    throw std::invalid_argument("the images have different direction matrices; resample them to one orientation first");
  }
  Lattice lattice = other.Samples();
  const auto& e = other.Extent_;
  lattice.Origin = this->WorldToLocal(other.ToWorld(e[0], e[2], e[4]));
  constexpr double close = 1e-6; // samples
  for (int a = 0; a < 3; ++a)
  {
    // Most are samples of this frame: without what the way through the world has rounded, the work on them has the same
    // bits wherever the image stands.
    const double sample = std::round(lattice.Origin[a] / this->Spacing_[a]);
    if (std::abs(lattice.Origin[a] / this->Spacing_[a] - sample) < close)
    {
      lattice.Origin[a] = this->Spacing_[a] * sample;
    }
  }
  return lattice;
}
}
