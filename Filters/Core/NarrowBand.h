// SPDX-License-Identifier: BSD-3-Clause
// A level-set function on the samples near its zero set, and the flows that work on it.
#ifndef LabelMesh_Core_NarrowBand_h
#define LabelMesh_Core_NarrowBand_h

#include "DistanceTransform.h"
#include "Lattice.h"

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

  Index NumberOfActiveSamples() const { return this->Active; }
  Index NumberOfInsideSamples() const { return this->Inside; } ///< of the mask

  /// phi_t = curvature |grad phi| for `time` (voxels squared). No sample changes its side: |phi| stays at least 0.05 of
  /// the smallest spacing. Clamping at 0 would make ties between materials.
  void SmoothKeepingSides(double time);
  /// The same flow, between two bounds that Pack() gave.
  void SmoothBetween(double time, const std::vector<float>& lower, const std::vector<float>& upper);
  /// Makes phi a distance again up to `reach` voxels from its zero set, which stays where it is: samples beside it get
  /// their distance to the plane through it (the subcell fix of Russo and Smereka), the others follow
  /// phi_t = sign(phi) (1 - |grad phi|), upwind.
  /// `ridges`: phi is a distance shifted by a constant, and a sheet of the zero set that is too thin to hold a sample
  /// is still there when the slopes of phi on both sides of it say so. Without it an erosion loses plates two voxels
  /// thick.
  void Redistance(double reach, bool ridges = false);
  /// phi += offset, on active samples.
  void Shift(double offset);

  /// The active samples, one after another, and back.
  std::vector<float> Pack() const;
  void Unpack(const std::vector<float>& packed);

  /// Volume inside the zero set in voxels (of volume one): samples beside it count by the part of them that lies
  /// inside.
  double Volume() const;
  /// phi * unit, clamped to +-limit, on the lattice given at first.
  std::vector<float> Distance(double unit, double limit) const;

private:
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

  void FindRuns();
  void FindGhosts();
  void FindTargets(bool ridges);
  /// Calls body(run) for every run, in parallel.
  template <typename Body>
  void ForRuns(Body&& body) const;
  /// One step of the flow: body(run) writes Next; then it becomes Phi.
  template <typename Body>
  void Advance(Body&& body);
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
