// SPDX-License-Identifier: BSD-3-Clause
// Mending an interface mesh by changing particles around a bad site.
#ifndef LabelMesh_Core_LocalRepair_h
#define LabelMesh_Core_LocalRepair_h

#include "IndicatorSet.h"
#include "NeighborGrid.h"
#include "SurfaceComplex.h"

#include <map>
#include <tuple>

namespace LabelMesh
{
/// Where the particles did not give the mesh that they should: a wrong face, a non-manifold edge or vertex, a sliver.
struct Fault
{
  std::vector<Index> Vertices;                                   ///< one to three
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial }; ///< of the face, if it is one
};

/// The faults of an interface, in the order of its faces.
std::vector<Fault> FindFaults(const SurfaceComplex& complex, MaterialId outside = NoMaterial);

/// Mends faults one after another, each as a transaction: the particles within a few target lengths are
/// tetrahedralised by themselves (the empty balls of interface faces are small, so that the faces around the fault are
/// those of the whole: checked; where they are not since particles are missing, more are taken), changes are tried
/// (relaxing, deleting a vertex, joining two, sliding one along its curve, merging two of curves, adding one on a
/// surface or a curve, uniting a junction with one closer than half a target length), and the best one is kept if the
/// faces around have become better and fit the rest of the mesh.
class LocalRepair
{
public:
  /// The complex must be the interface of the Delaunay tetrahedra of its vertices.
  LocalRepair(const IndicatorSet& indicators, SurfaceComplex& complex, double wantedRatio);

  /// How a mended patch gets into the mesh.
  enum class Placing
  {
    Faces,    ///< its faces take the place of the old ones; only patches whose rim stays what it is are mended
    Particles ///< its particles alone: the complex must be made anew from RemainingParticles() at the end of the pass
  };

  /// True when the fault was mended or made less.
  bool Mend(const Fault& fault, Placing placing = Placing::Faces);
  std::vector<Particle> RemainingParticles() const;

private:
  struct Patch
  {
    std::vector<Particle> Particles;
    std::vector<Index> Ids;  ///< of the whole; -1: new
    std::vector<char> Core;  ///< whether the faces at it are judged and replaced
    std::vector<char> Inner; ///< whether it is far from the rim, so that the tetrahedra at it may be relabelled
    Vec3 Centre;
    double Radius = 0.0; ///< in Lengths
    double Length = 0.0; ///< target length of the site
  };
  /// The faces at the core of a patch, in the patch's numbers, and how bad they are.
  struct Judgement
  {
    double Badness = 0.0;
    std::vector<InterfaceTriangle> Faces;
    std::vector<std::array<MaterialId, 2>> Pairs; ///< of materials, ascending
  };

  /// What a changed patch puts into the mesh.
  struct Replacement
  {
    std::vector<Index> Numbers; ///< of the whole, for the particles of the patch; new ones follow those that are there
    std::vector<Index> Core;    ///< whose stars are replaced, ascending
    std::vector<InterfaceTriangle> Faces;
  };

  /// Whether the fault was tried before, in the same way, and nothing around it has changed since.
  bool WasInVain(const Fault& fault, Placing placing) const;
  void Remember(const Fault& fault, Placing placing, const Patch& patch);
  /// Whether a fault is worth a larger patch where the usual one has not the faces of the whole: wrong faces and
  /// non-manifold edges are.
  bool IsWorthMore(const Fault& fault) const;
  /// The radius is in target lengths of the site. It is larger where particles are few.
  Patch PatchAround(const Fault& fault, double leastRadius) const;
  /// `wantedPairs`: pairs of materials that are missed where they are not there.
  Judgement Judge(const Patch& patch, const std::vector<std::array<MaterialId, 2>>& wantedPairs) const;
  /// Whether the faces are those that the whole mesh has there.
  bool AreThoseOfTheWhole(const Patch& patch, const std::vector<InterfaceTriangle>& faces) const;
  /// Changes that may mend the site, whose vertices are `site` of the patch.
  std::vector<Patch> Variants(const Patch& patch, const std::vector<Index>& site, const Fault& fault) const;
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
    const Patch& patch, const std::vector<Index>& site, const Fault& fault, std::vector<Patch>& variants) const;
  /// Puts a particle whose set has grown on the faces of the volume's box that are in it.
  void SnapToBorder(Particle& particle) const;
  void RelaxCore(Patch& patch) const;
  Replacement ReplacementBy(const Patch& before, const Patch& after, const std::vector<InterfaceTriangle>& faces) const;
  void Commit(const Patch& before, const Patch& after, const Replacement& replacement, Placing placing);

  const IndicatorSet& Indicators;
  SurfaceComplex& Complex;
  double WantedRatio;
  NeighborGrid Grid; ///< of the vertices, where they were at first; numbered alike
  std::vector<char> Deleted;
  struct Attempt
  {
    Index Time = 0;
    std::vector<Index> Patch; ///< its particles
  };
  using Site = std::tuple<std::vector<Index>, std::array<MaterialId, 2>, Placing>;
  std::map<Site, Attempt> InVain;
  Index Time = 0;               ///< changes so far
  std::vector<Index> ChangedAt; ///< the last change of each vertex or of the faces at it
};
}

#endif
