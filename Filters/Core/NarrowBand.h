// SPDX-License-Identifier: BSD-3-Clause
// A level-set function on the samples near its zero set, and the flows that work on it.
#ifndef LabelMesh_Core_NarrowBand_h
#define LabelMesh_Core_NarrowBand_h

#include "BandLayout.h"

#include <memory>
#include <vector>

namespace LabelMesh
{
/// Memory that bands use one after another: taking it anew each time costs more than some of the steps. As large as the
/// largest box so far.
class BandMemory
{
public:
  /// An array whose values are not set.
  class Array
  {
  public:
    float* Sized(Index size)
    {
      if (size > this->Size)
      {
        this->Values.reset(); // before the larger one is taken
        this->Values.reset(new float[static_cast<std::size_t>(size)]);
        this->Size = size;
      }
      return this->Values.get();
    }
    float* Data() const { return this->Values.get(); }
    void Swap(Array& other)
    {
      this->Values.swap(other.Values);
      std::swap(this->Size, other.Size);
    }

  private:
    std::unique_ptr<float[]> Values;
    Index Size = 0;
  };

  Array Phi, Next, Third; ///< a value for every sample of the box
  Array Signs;            ///< packed
  Sides Inside;           ///< of every sample of the box
};

/// A function phi (> 0 inside) of which only the samples with |phi| < band, the active ones, change. Others stay
/// +-band.
///
/// Lengths are in *voxels*: the spacing is divided by Lattice::VoxelSize(). Samples lie densely in memory while a band
/// is worked on; the active ones are runs along x, so that the inner loops are loops over arrays. Between two visits a
/// band can be kept as its layout and its packed values. Every step reads one array and writes the other (Jacobi): the
/// same bits for any number of threads.
class NarrowBand
{
public:
  /// The signed distance of a mask (see SignedDistance) as phi.
  NarrowBand(const Lattice& frame, const std::uint8_t* mask, double band,
    std::shared_ptr<BandMemory> memory = std::make_shared<BandMemory>());
  /// A band that was kept. Only its flows and Redistance can be used: samples far from the active ones have no value.
  NarrowBand(std::shared_ptr<const BandLayout> layout, double band, const std::vector<float>& packed,
    std::shared_ptr<BandMemory> memory);

  const std::shared_ptr<const BandLayout>& Layout() const { return this->Where; }
  Index NumberOfInsideSamples() const { return this->Where->NumberOfInside(); } ///< of the mask

  /// Makes all samples active that are so near that a band of `band` voxels has them, on the sides of the mask that the
  /// band was made of; they begin at +-band.
  void Widen(const std::uint8_t* mask, double band);

  /// phi_t = curvature |grad phi| for `time` (voxels squared). No sample changes its side: |phi| stays at least 0.05 of
  /// the smallest spacing. Clamping at 0 would make ties between materials.
  void SmoothKeepingSides(double time);
  /// The same flow, between two bounds that Opening() and Closing() gave. Samples whose bounds are equal stay.
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
  /// it is phi. phi must be a distance, up to BallReach(radius) from the zero set. More than a
  /// voxel beyond `radius` from the zero set the bound is phi itself: what happens there does not reach the zero set.
  std::vector<float> Opening(double radius) const;
  static double BallReach(double radius) { return radius + 1.7; }
  /// The same of -phi, turned over: the closing as an upper bound.
  std::vector<float> Closing(double radius) const;

  /// The active samples, one after another, and back.
  std::vector<float> Pack() const;
  void Pack(std::vector<float>& packed) const;
  void Assign(const std::vector<float>& packed);

  /// Volume inside the zero set in voxels (of volume one).
  double Volume() const;
  /// phi * unit, clamped to +-limit, on the lattice given at first.
  void Distance(double unit, double limit, float* distance) const;

private:
  struct Disc;
  class DiscStamp;

  std::vector<float> UnionOfBalls(double radius, float sign) const;
  std::vector<std::vector<Disc>> FindDiscs() const;
  void FindTargets();
  /// Both arrays get +-band around the active samples.
  void FillRims();
  /// All of both arrays.
  void FillSides(const std::uint8_t* mask);
  /// One step of the flow: body(runs, count, packed) writes Next; then it becomes Phi.
  template <typename Body>
  void Advance(Body&& body)
  {
    this->Where->ForPieces(body);
    this->Finish();
  }
  void Finish();

  std::shared_ptr<const BandLayout> Where;
  std::shared_ptr<BandMemory> Memory;
  float End = 0; ///< the band's
  float* Phi = nullptr;
  float* Next = nullptr;
};
}

#endif
