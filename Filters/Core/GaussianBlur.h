// SPDX-License-Identifier: BSD-3-Clause
// Separable Gaussian of a field that is wanted, and not zero, in a narrow band alone.
#ifndef LabelMesh_Core_GaussianBlur_h
#define LabelMesh_Core_GaussianBlur_h

#include "Lattice.h"

#include <vector>

namespace LabelMesh
{
/// Part [First, Last) of a row along x.
struct RowRange
{
  Index First = 0;
  Index Last = 0;
  bool Empty() const { return this->First >= this->Last; }
};

/// Convolution with a Gaussian of standard deviation `sigma` (same unit as the spacing), cut at three of them,
/// restricted to one range of each row: what lies beyond the ranges is taken as zero and is not computed.
class GaussianBlur
{
public:
  /// `rows` holds a range for each row, row (j, k) at j + Dims[1] * k.
  GaussianBlur(const Lattice& frame, double sigma, std::vector<RowRange> rows);

  /// Makes `field` as large as the lattice and zero in the ranges.
  void Clear(std::vector<float>& field) const;
  /// Convolves in place. Values beyond the ranges are neither read nor kept.
  void Apply(std::vector<float>& field) const;

private:
  void AlongX(std::vector<float>& field) const;
  void Across(Index sets, Index setRows, Index count, Index rowStep, const std::vector<float>& kernel,
    const std::vector<RowRange>& from, const std::vector<RowRange>& to, std::vector<float>& field) const;

  std::array<int, 3> Dims;
  std::array<std::vector<float>, 3> Kernels;
  std::vector<RowRange> Rows;           ///< of the result
  std::vector<RowRange> AfterX, AfterY; ///< where the passes leave values
};
}

#endif
