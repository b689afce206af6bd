// SPDX-License-Identifier: BSD-3-Clause
// Separable Gaussian of a field that is wanted, and not zero, in a narrow band alone.
#ifndef LabelMesh_Core_GaussianBlur_h
#define LabelMesh_Core_GaussianBlur_h

#include "BandLayout.h"

#include <vector>

namespace LabelMesh
{
/// Convolution with a Gaussian cut at three standard deviations, of values at the active samples of a band: what lies
/// beyond them is taken as zero and is not computed.
class GaussianBlur
{
public:
  /// `sigma` in voxels.
  GaussianBlur(const BandLayout& layout, double sigma);

  /// Convolves packed values in place. `box` has room for the layout's lattice, to work in.
  void Apply(const BandLayout& layout, float* values, float* box) const;

private:
  /// Spans of every row: those of row r are Spans[Starts[r]] up to Spans[Starts[r + 1]].
  struct RowSpans
  {
    explicit RowSpans(const BitLattice& bits);
    std::vector<std::uint32_t> Starts;
    std::vector<Span> Spans;
  };

  void AlongX(const BandLayout& layout, const float* values, Index k, std::vector<float>& padded, float* slice) const;
  void AlongY(const BandLayout& layout, const float* slice, Index k, float* box) const;
  void AlongZ(const BandLayout& layout, const float* box, float* values) const;

  std::array<std::vector<float>, 3> Kernels;
  RowSpans AfterX, AfterY; ///< what the following pass reads
};
}

#endif
