// SPDX-License-Identifier: BSD-3-Clause
// Particles on 2-cells: where they start, and how many there are.
#ifndef LabelMesh_Core_SurfaceSampling_h
#define LabelMesh_Core_SurfaceSampling_h

#include "IndicatorSet.h"
#include "NeighborGrid.h"
#include "Particles.h"

namespace LabelMesh
{
// Distances in target lengths.
inline constexpr double PoissonDistance = 0.67;  ///< between first particles
inline constexpr double CrowdedDistance = 0.62;  ///< one of a closer pair is deleted
inline constexpr double HardCore = 0.5;          ///< whatever the interfaces: else opposite thin sheets coincide
inline constexpr double GapDistance = 0.8;       ///< a candidate farther from all particles fills a gap
inline constexpr double ProtectionFactor = 1.05; ///< of the diametral ball of each 1-cell segment

/// One particle on the interface per label-changing edge of the working lattice, more where the target length is
/// shorter than a voxel, in an order that is random and depends on `seed` alone.
std::vector<Particle> InterfaceCandidates(
  const IndicatorSet& indicators, const Grid<float>& targetLength, std::uint32_t seed);

/// The diametral balls of the segments of 1-cells, which must hold no 2-cell particle for the segment to be an edge of
/// the Delaunay tetrahedralisation.
class ProtectionBalls
{
public:
  ProtectionBalls(const std::vector<Particle>& particles, const std::vector<Curve>& curves);
  bool Contains(const Vec3& x) const;

private:
  NeighborGrid Balls;
};

/// Places where a particle could be.
class CandidatePool
{
public:
  /// Drops those in protection balls.
  CandidatePool(std::vector<Particle> candidates, const ProtectionBalls& protection);

  /// Adds each candidate, in order, that is at least `distance` from all particles that it interacts with, and the hard
  /// core from all.
  void AddWhereFree(std::vector<Particle>& particles, double distance);
  /// To be told when particles get new numbers, by their old ones; -1: deleted.
  void Renumber(const std::vector<std::int32_t>& numbers);

private:
  std::vector<Particle> Candidates;
  std::vector<std::int32_t> Blockers; ///< a particle that was too near to each, tried first; -1: none
};

/// Deletes 2-cell particles that are crowded or in a protection ball. Those of other cells stay. Returns the new
/// numbers of all, -1 for those deleted.
std::vector<std::int32_t> DeleteCrowded(std::vector<Particle>& particles, const ProtectionBalls& protection);
}

#endif
