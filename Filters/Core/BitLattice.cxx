// SPDX-License-Identifier: BSD-3-Clause
#include "BitLattice.h"

#include "Parallel.h"

namespace LabelMesh
{
namespace
{
using Word = BitLattice::Word;

/// Number of trailing zeros of a word that is not zero.
int LowestBit(Word word)
{
  int bit = 0;
  for (int half = BitLattice::WordSize / 2; half > 0; half /= 2)
  {
    if ((word & ((Word(1) << half) - 1)) == 0)
    {
      bit += half;
      word >>= half;
    }
  }
  return bit;
}

/// The first position from `at` on whose bit is `value`; `end` when there is none.
int FindBit(const Word* row, int at, int end, bool value)
{
  while (at < end)
  {
    const Word word =
      (value ? row[at / BitLattice::WordSize] : ~row[at / BitLattice::WordSize]) >> (at % BitLattice::WordSize);
    if (word)
    {
      return std::min(end, at + LowestBit(word));
    }
    at = (at / BitLattice::WordSize + 1) * BitLattice::WordSize;
  }
  return end;
}

/// to |= from, and its neighbours up to `reach` along the row.
void AddDilatedRow(const Word* from, int reach, int words, std::vector<Word>& grown, Word* to)
{
  std::copy_n(from, words, grown.begin());
  for (int step = 0; step < reach; ++step)
  {
    Word before = 0; // the word to the left, as it was
    for (int w = 0; w < words; ++w)
    {
      const Word here = grown[w], after = w + 1 < words ? grown[w + 1] : 0;
      grown[w] = here | here << 1 | here >> 1 | before >> 63 | after << 63;
      before = here;
    }
  }
  for (int w = 0; w < words; ++w)
  {
    to[w] |= grown[w];
  }
}
}

void BitLattice::Add(const Span& span, Index j, Index k)
{
  Word* const row = this->Row(j, k);
  for (int i = span.First; i < span.Last;)
  {
    const int bit = i % WordSize, count = std::min(WordSize - bit, span.Last - i);
    const Word ones = count == WordSize ? ~Word(0) : (Word(1) << count) - 1;
    row[i / WordSize] |= ones << bit;
    i += count;
  }
}

void FindSpans(const Word* row, int words, std::vector<Span>& spans)
{
  const int end = words * BitLattice::WordSize;
  for (int i = FindBit(row, 0, end, true); i < end;)
  {
    const int last = FindBit(row, i, end, false);
    spans.push_back({ i, last });
    i = FindBit(row, last, end, true);
  }
}

std::vector<RowOffset> BallOffsets(const Lattice& frame, double radius)
{
  const Vec3 h = frame.Spacing;
  const double inclusive = radius * (1 + 1e-9);
  const int ny = int(inclusive / h[1]), nz = int(inclusive / h[2]);
  std::vector<RowOffset> offsets;
  for (int k = -nz; k <= nz; ++k)
  {
    for (int j = -ny; j <= ny; ++j)
    {
      const double left = inclusive * inclusive - h[1] * j * h[1] * j - h[2] * k * h[2] * k;
      if (left >= 0)
      {
        offsets.push_back({ j, k, int(std::sqrt(left) / h[0]) });
      }
    }
  }
  return offsets;
}

std::vector<RowOffset> BoxOffsets(const std::array<int, 3>& reach)
{
  std::vector<RowOffset> offsets;
  for (int k = -reach[2]; k <= reach[2]; ++k)
  {
    for (int j = -reach[1]; j <= reach[1]; ++j)
    {
      offsets.push_back({ j, k, reach[0] });
    }
  }
  return offsets;
}

BitLattice Dilated(const BitLattice& set, const std::vector<RowOffset>& offsets)
{
  const std::array<int, 3>& dims = set.Dimensions();
  const int words = set.WordsPerRow(), ny = dims[1], nz = dims[2];
  std::vector<std::uint8_t> any(static_cast<std::size_t>(ny) * nz);
  ParallelFor(0, Index(ny) * nz, 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const Word* const bits = set.Row(row, 0);
        any[row] = std::any_of(bits, bits + words, [](Word word) { return word != 0; });
      }
    });
  const int beyond = words * BitLattice::WordSize - dims[0];
  BitLattice result(dims);
  ParallelFor(0, Index(ny) * nz, 0,
    [&](Index first, Index last)
    {
      std::vector<Word> grown(words);
      for (Index row = first; row < last; ++row)
      {
        const int j = int(row % ny), k = int(row / ny);
        Word* const to = result.Row(j, k);
        for (const RowOffset& offset : offsets)
        {
          const int y = j + offset.J, z = k + offset.K;
          if (y >= 0 && y < ny && z >= 0 && z < nz && any[y + Index(ny) * z])
          {
            AddDilatedRow(set.Row(y, z), offset.Reach, words, grown, to);
          }
        }
        to[words - 1] &= ~Word(0) >> beyond;
      }
    });
  return result;
}
}
