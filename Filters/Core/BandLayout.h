// SPDX-License-Identifier: BSD-3-Clause
// Where the active samples of a narrow band are.
#ifndef LabelMesh_Core_BandLayout_h
#define LabelMesh_Core_BandLayout_h

#include "BitLattice.h"
#include "DistanceTransform.h"
#include "Parallel.h"

#include <memory>
#include <vector>

namespace LabelMesh
{
/// The active samples of a material as runs along x, and the samples around them that a stencil of one step reads.
///
/// The lattice is that of the mask, grown by a margin on every side, whose samples copy the nearest sample of the
/// mask's lattice: flows see no edge. Active samples are numbered run by run, which is the order of packed arrays.
/// Its size is that of the runs: 16 bytes each.
class BandLayout
{
public:
  static constexpr int Margin = 2; ///< samples: the widest stencil

  /// Active samples [First, First + Count) of the grown lattice, of which the first is number Packed of its slice.
  struct Run
  {
    Index First = 0;
    int Count = 0;
    std::uint32_t Packed = 0;
  };
  /// Runs from number Run on, whose first active sample is number Packed.
  struct Place
  {
    Index Run = 0;
    Index Packed = 0;
  };
  /// Samples around the active ones, all on one side.
  struct Rim
  {
    Index First = 0;
    int Count = 0;
    bool Inside = false;
  };
  /// A sample of the margin and the active one that it copies.
  struct Ghost
  {
    Index To = 0;
    Index From = 0;
  };

  static Lattice Grown(const Lattice& frame);

  /// `grown` as Grown() gives it; the mask (1 inside, 0 outside) is on the lattice without margin; only samples
  /// without margin may be active.
  BandLayout(const Lattice& grown, const std::uint8_t* mask, const BitLattice& active);

  const Lattice& Frame() const { return this->GrownFrame; }
  Index NumberOfActive() const { return this->Slices.back().Packed; }
  Index NumberOfInside() const { return this->Inside; } ///< samples of the mask
  Index NumberOfDeep() const { return this->Deep; }     ///< samples inside the mask that are not active

  BitLattice ActiveBits() const;
  /// The side of each active sample in the mask.
  std::vector<std::uint8_t> PackSides(const std::uint8_t* mask) const;

  const std::vector<Run>& Runs() const { return this->AllRuns; }
  const std::vector<Rim>& Rims() const { return this->AllRims; }
  const std::vector<Ghost>& Ghosts() const { return this->AllGhosts; }
  /// The runs of slice k of the grown lattice start at Slice(k) and end at Slice(k + 1).
  const Place& Slice(Index k) const { return this->Slices[k]; }
  /// The first run of slice k that starts in row j or later.
  const Run* RowBegin(Index j, Index k) const
  {
    const Index start = this->GrownFrame.At(0, j, k);
    return std::lower_bound(this->AllRuns.data() + this->Slices[k].Run, this->AllRuns.data() + this->Slices[k + 1].Run,
      start, [](const Run& run, Index at) { return run.First < at; });
  }

  /// Calls body(first run, runs, first active sample), in parallel, for pieces of about the same work.
  template <typename Body>
  void ForPieces(Body&& body) const
  {
    ParallelFor(0, this->NumberOfPieces(), 0,
      [&](Index first, Index last)
      {
        for (Index piece = first; piece < last; ++piece)
        {
          this->VisitPiece(piece, body);
        }
      });
  }
  /// The same for one piece.
  template <typename Body>
  void VisitPiece(Index piece, Body&& body) const
  {
    const Place &from = this->Pieces[piece], &to = this->Pieces[piece + 1];
    body(this->AllRuns.data() + from.Run, to.Run - from.Run, from.Packed);
  }
  Index NumberOfPieces() const { return Index(this->Pieces.size()) - 1; }
  /// Calls body(first, count, packed) for every run, in parallel.
  template <typename Body>
  void ForRuns(Body&& body) const
  {
    this->ForPieces(
      [&](const Run* runs, Index count, Index packed)
      {
        for (Index r = 0; r < count; ++r)
        {
          body(runs[r].First, Index(runs[r].Count), packed);
          packed += runs[r].Count;
        }
      });
  }

private:
  bool IsInside(const std::uint8_t* mask, int i, int j, int k) const;
  void FindRuns(const BitLattice& active);
  void FindRims(const std::uint8_t* mask, const BitLattice& active);
  void FindGhosts(const BitLattice& active);
  void CountSides(const std::uint8_t* mask);

  Lattice GrownFrame; ///< in voxels
  Index Inside = 0;
  Index Deep = 0;
  std::vector<Run> AllRuns;
  std::vector<Place> Slices, Pieces;
  std::vector<Rim> AllRims;
  std::vector<Ghost> AllGhosts;
};
}

#endif
