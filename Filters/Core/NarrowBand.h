// SPDX-License-Identifier: BSD-3-Clause
// A level-set function on the samples near its zero set, and the flows that work on it.
#ifndef LabelMesh_Core_NarrowBand_h
#define LabelMesh_Core_NarrowBand_h

#include "DistanceTransform.h"
#include "GaussianBlur.h"
#include "Lattice.h"
#include "Parallel.h"

#include <vector>

namespace LabelMesh
{
/// A function phi (> 0 inside) of which only the samples with |phi| < Band, the active ones, change. Others stay
/// +-Band.
///
/// Lengths are in *voxels*: the spacing is divided by Lattice::VoxelSize(). The lattice is grown by a margin on
/// every side, which copies the nearest sample of the lattice after every step: the flows see no edge.
/// Samples lie densely in memory; the active ones are runs along x, so that the inner loops are loops over arrays.
/// Every step reads one array and writes the other (Jacobi): the same bits for any number of threads.
class NarrowBand
{
public:
  /// The signed distance of a mask (see SignedDistance) as phi.
  NarrowBand(const Lattice& frame, const float* mask, double band);

  Index NumberOfInsideSamples() const { return this->Inside; } ///< of the mask

  /// phi_t = curvature |grad phi| for `time` (voxels squared). No sample changes its side: |phi| stays at least 0.05 of
  /// the smallest spacing. Clamping at 0 would make ties between materials.
  void SmoothKeepingSides(double time);
  /// The same flow, between two bounds that Pack() gave.
  void SmoothBetween(double time, const std::vector<float>& lower, const std::vector<float>& upper);
  /// The same flow, in which a sample that has left its side of `sides` (packed; the sign counts) is pushed back with a
  /// constant force, up to 0.05: a sample is given up only where keeping it takes more curvature (1 / voxel) than
  /// `force`.
  void SmoothTowards(double time, const std::vector<float>& sides, double force);
  /// Makes phi a distance again up to `reach` voxels from its zero set, which stays where it is: samples beside it get
  /// their distance to the plane through it (the subcell fix of Russo and Smereka), the others follow
  /// phi_t = sign(phi) (1 - |grad phi|), upwind.
  void Redistance(double reach);
  /// phi within `reach` voxels of the zero set becomes the distance to it, taken as one small disc for each sample
  /// beside it. More work than Redistance, which is first order and comes out up to a voxel too small at the medial
  /// axis.
  void MeasureDistance(double reach);

  /// The opening of {phi > 0} by a ball of `radius` voxels as a lower bound of phi, packed: the union of the balls that
  /// fit inside and are no smaller, O(x) = max of phi(y) - |x - y| over the y with phi(y) >= radius. Such y are
  /// samples, and points between two samples where the slopes of phi on both sides meet, so that plates two voxels
  /// thick keep theirs. Where O differs from phi by less than the samples' coarseness explains (0.1 for cubic voxels),
  /// it is phi. phi must be a distance, up to BallReach(radius) from the zero set.
  std::vector<float> Opening(double radius) const;
  static double BallReach(double radius) { return radius + 1.7; }
  /// The same of -phi, turned over: the closing as an upper bound.
  std::vector<float> Closing(double radius) const;

  /// The active samples, one after another, and back.
  std::vector<float> Pack() const;
  void Assign(const std::vector<float>& packed);
  /// phi along x at (0, j, k) of the lattice given at first.
  const float* Row(Index j, Index k) const { return this->Phi.data() + this->Frame.At(Margin, j + Margin, k + Margin); }
  /// Calls body(packed, i, j, k, count) in parallel for runs of active samples along x, which start at (i, j, k) of the
  /// lattice given at first and at number `packed` of the packed samples.
  template <typename Body>
  void ForActive(Body&& body) const
  {
    this->ForRuns(
      [&](const Run& run)
      {
        const std::array<int, 3> at = this->Frame.Coordinates(run.First);
        body(run.Packed, Index(at[0] - Margin), Index(at[1] - Margin), Index(at[2] - Margin), run.Count);
      });
  }

  /// From the first to the last active sample of every row of the lattice given at first.
  std::vector<RowRange> ActiveRows() const;

  /// Volume inside the zero set in voxels (of volume one).
  double Volume() const;
  /// phi * unit, clamped to +-limit, on the lattice given at first.
  std::vector<float> Distance(double unit, double limit) const;

private:
  static constexpr int Margin = 2; // samples: the widest stencil

  /// Active samples [First, First + Count) of phi; the first one is active sample number Packed.
  struct Run
  {
    Index First = 0;
    Index Packed = 0;
    Index Count = 0;
  };
  struct Ghost
  {
    Index To = 0;
    Index From = 0;
  };

  std::vector<float> UnionOfBalls(double radius, float sign) const;
  void FindRuns();
  void FindGhosts();
  void FindTargets();
  struct Disc;
  class DiscStamp;
  std::vector<std::vector<Disc>> FindDiscs() const;
  /// Calls body(run) for every run, in parallel.
  template <typename Body>
  void ForRuns(Body&& body) const
  {
    ParallelFor(0, Index(this->Chunks.size()) - 1, 0,
      [&](Index first, Index last)
      {
        for (Index r = this->Chunks[first]; r < this->Chunks[last]; ++r)
        {
          body(this->Runs[r]);
        }
      });
  }
  /// One step of the flow: body(run) writes Next; then it becomes Phi.
  template <typename Body>
  void Advance(Body&& body)
  {
    this->ForRuns(body);
    for (const Ghost& ghost : this->Ghosts)
    {
      this->Next[ghost.To] = this->Next[ghost.From];
    }
    this->Phi.swap(this->Next);
  }
  template <typename Clamp>
  void Smooth(double time, Clamp&& clamp);

  Lattice Frame; ///< grown, in voxels
  float End = 0; ///< the band's
  Index Active = 0;
  Index Inside = 0;
  Index Deep = 0; ///< samples inside the mask that are not active
  std::vector<float> Phi, Next;
  std::vector<Run> Runs;
  std::vector<Index> Chunks; ///< pieces of work: runs [Chunks[c], Chunks[c + 1])
  std::vector<Ghost> Ghosts;
  std::vector<float> Signs; ///< of the active samples while re-distancing; 0: holds its value
};
}

#endif
