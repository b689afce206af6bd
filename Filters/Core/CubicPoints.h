// SPDX-License-Identifier: BSD-3-Clause
// Catmull-Rom interpolation, which the indicators use, at a regular lattice of points inside a cell or a voxel.
#ifndef LabelMesh_Core_CubicPoints_h
#define LabelMesh_Core_CubicPoints_h

#include <array>

namespace LabelMesh
{
/// 4^3 points in the middles of the parts that a cube of one sample's size is cut into, interpolated from Width^3
/// samples (x fastest): 4 for a cell, the cube between two samples, 5 for a voxel, the cube around one.
template <int Width>
class CubicPoints
{
public:
  static constexpr int Cuts = 4; ///< along each axis
  static constexpr int Count = Cuts * Cuts * Cuts;
  using Samples = std::array<float, Width * Width * Width>;
  using Points = std::array<float, Count>;

  CubicPoints()
  {
    static_assert(Width == 4 || Width == 5);
    for (int c = 0; c < Cuts; ++c)
    {
      // From the sample before the point, which is the second of the four that have a weight.
      const double x = (c + 0.5) / Cuts - (Width == 5 ? 0.5 : 0.0);
      const int first = Width == 5 && x >= 0 ? 1 : 0;
      const double t = x < 0 ? x + 1 : x;
      const double weights[4] = { 0.5 * t * (-1 + t * (2 - t)), 0.5 * (2 + t * t * (3 * t - 5)),
        0.5 * t * (1 + t * (4 - 3 * t)), 0.5 * t * t * (t - 1) };
      for (int n = 0; n < Width; ++n)
      {
        this->Weights[c][n] = n >= first && n < first + 4 ? float(weights[n - first]) : 0.0f;
      }
    }
  }

  void Interpolate(const Samples& samples, Points& points) const
  {
    std::array<float, Width * Width * Cuts> alongX; // of all rows, one point after another
    std::array<float, Width * Cuts * Cuts> alongY;
    for (int c = 0; c < Cuts; ++c)
    {
      for (int row = 0; row < Width * Width; ++row)
      {
        float sum = 0;
        for (int n = 0; n < Width; ++n)
        {
          sum += this->Weights[c][n] * samples[n + Width * row];
        }
        alongX[c + Cuts * row] = sum;
      }
    }
    for (int k = 0; k < Width; ++k)
    {
      this->Blend<Cuts>(alongX.data() + Cuts * Width * k, alongY.data() + Cuts * Cuts * k);
    }
    this->Blend<Cuts * Cuts>(alongY.data(), points.data());
  }

private:
  /// From Width rows of values to Cuts rows between them.
  template <int Row>
  void Blend(const float* from, float* to) const
  {
    for (int c = 0; c < Cuts; ++c)
    {
      for (int i = 0; i < Row; ++i)
      {
        float sum = 0;
        for (int n = 0; n < Width; ++n)
        {
          sum += this->Weights[c][n] * from[i + Row * n];
        }
        to[i + Row * c] = sum;
      }
    }
  }

  float Weights[Cuts][Width];
};
}

#endif
