// SPDX-License-Identifier: BSD-3-Clause
// Mending an interface mesh by changing particles around a bad site.
#ifndef LabelMesh_Core_LocalRepair_h
#define LabelMesh_Core_LocalRepair_h

#include "InterfaceMesh.h"
#include "IndicatorSet.h"
#include "NeighborGrid.h"

namespace LabelMesh
{
/// What is bad somewhere: a triangle below the wanted ratio, a wrong face, a non-manifold edge or vertex.
struct BadSite
{
  std::vector<Index> Vertices;                                   ///< one to three particles
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial }; ///< of the face, if it is one
};

/// The bad sites of an interface, in the order of its faces.
std::vector<BadSite> FindBadSites(
  const std::vector<Particle>& particles, const std::vector<InterfaceTriangle>& faces, double wantedRatio);

/// Repairs sites one after another, each as a transaction: the particles within a few target lengths are
/// tetrahedralised by themselves (the empty balls of interface faces are small, so that the faces around the site are
/// those of the whole), changes are tried (relaxing, deleting a vertex, joining two, sliding one along its curve,
/// merging two of curves, adding one on a surface or a curve, uniting a junction with one closer than half a target
/// length), and the best one is kept if the faces around the site have become better. A site that has been touched
/// waits for the next pass.
class LocalRepair
{
public:
  LocalRepair(const IndicatorSet& indicators, std::vector<Particle>& particles, double wantedRatio);

  /// True when the site was made better.
  bool Mend(const BadSite& site);
  /// Removes the particles that were deleted; call it once, at the end of a pass.
  void Finish();

private:
  struct Patch
  {
    std::vector<Particle> Particles;
    std::vector<Index> Ids; ///< of the whole; -1: new
    Vec3 Centre;
    double Length = 0.0;
  };

  Patch PatchAround(const BadSite& site) const;
  double Badness(const Patch& patch, const std::vector<std::array<MaterialId, 2>>* wantedPairs,
    std::vector<std::array<MaterialId, 2>>* pairs) const;
  /// Changes that may mend the site, whose vertices are `site` of the patch.
  std::vector<Patch> Variants(const Patch& patch, const std::vector<Index>& site, const BadSite& fault) const;
  /// The patch with one 2-cell vertex of the site moved a little, in several directions.
  std::vector<Patch> Moves(const Patch& patch, const std::vector<Index>& site) const;
  static Patch Without(const Patch& patch, Index v);
  /// Appends the base with one more particle on the junction of `materials` near x, if there is such a point.
  void AppendWith(
    const Patch& base, const MaterialSet& materials, const Vec3& x, double length, std::vector<Patch>& variants) const;
  void AppendDeletions(const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const;
  void AppendInsertions(const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const;
  void AppendCollapses(const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const;
  void AppendSlides(const Patch& patch, const std::vector<Index>& site, std::vector<Patch>& variants) const;
  void AppendJunctions(
    const Patch& patch, const std::vector<Index>& site, const BadSite& fault, std::vector<Patch>& variants) const;
  void RelaxCore(Patch& patch) const;
  void Commit(const Patch& before, const Patch& after);

  const IndicatorSet& Indicators;
  std::vector<Particle>& Particles;
  double WantedRatio;
  NeighborGrid Grid;
  std::vector<char> Touched, Deleted;
};
}

#endif
