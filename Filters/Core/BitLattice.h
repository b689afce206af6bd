// SPDX-License-Identifier: BSD-3-Clause
// Sets of samples, one bit each.
#ifndef LabelMesh_Core_BitLattice_h
#define LabelMesh_Core_BitLattice_h

#include "Lattice.h"

#include <vector>

namespace LabelMesh
{
/// Part [First, Last) of a row along x.
struct Span
{
  int First = 0;
  int Last = 0;
};

/// A set of samples of a lattice.
class BitLattice
{
public:
  using Word = std::uint64_t;
  static constexpr int WordSize = 64;

  explicit BitLattice(const std::array<int, 3>& dims)
    : Dims(dims)
    , Words((dims[0] + WordSize - 1) / WordSize)
    , Bits(static_cast<std::size_t>(this->Words * dims[1] * dims[2]), 0)
  {
  }

  const std::array<int, 3>& Dimensions() const { return this->Dims; }
  int WordsPerRow() const { return int(this->Words); }
  Word* Row(Index j, Index k) { return this->Bits.data() + this->Words * (j + this->Dims[1] * k); }
  const Word* Row(Index j, Index k) const { return this->Bits.data() + this->Words * (j + this->Dims[1] * k); }
  bool Has(Index i, Index j, Index k) const { return this->Row(j, k)[i / WordSize] >> (i % WordSize) & 1; }
  /// Adds the samples of a span.
  void Add(const Span& span, Index j, Index k);

private:
  std::array<int, 3> Dims;
  Index Words;
  std::vector<Word> Bits;
};

/// Appends the spans of a row of `words` words.
void FindSpans(const BitLattice::Word* row, int words, std::vector<Span>& spans);

/// Samples at (i, J, K), |i| <= Reach, around a sample.
struct RowOffset
{
  int J = 0;
  int K = 0;
  int Reach = 0;
};

/// The samples within `radius` (a length) as offsets; symmetric.
std::vector<RowOffset> BallOffsets(const Lattice& frame, double radius);
/// The samples within `reach` steps along each axis.
std::vector<RowOffset> BoxOffsets(const std::array<int, 3>& reach);

/// All samples that have one of the set among `offsets` around them.
BitLattice Dilated(const BitLattice& set, const std::vector<RowOffset>& offsets);
}

#endif
