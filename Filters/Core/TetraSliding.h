// SPDX-License-Identifier: BSD-3-Clause
// Moving vertices of the interface a little, where slivers between them have no other cure.
#ifndef LabelMesh_Core_TetraSliding_h
#define LabelMesh_Core_TetraSliding_h

#include "TetraSmoothing.h"
#include "VolumeBorder.h"

#include <optional>
#include <unordered_map>

namespace LabelMesh
{
struct SlideOptions
{
  int Rounds = 10;              ///< at most; 0: the interface stays as it is
  double Below = 0.21;          ///< TetraQuality under which the corners of a tetrahedron are moved
  double Reach = 0.1;           ///< how far a vertex may go, of the mean edge of the interface at it
  double LeastRatio = 0.75;     ///< radius ratio that triangles of the interface may fall to
  std::optional<VolumeBox> Box; ///< vertices in its faces stay in them, exactly
};

/// Slivers with their corners on the interface, where two sheets of it all but touch, have no cure inside their
/// material. Here their corners move, each to where the worst of the tetrahedra at it, in all its materials, is best. A
/// move is kept where that rises, no triangle of the interface turns away or becomes worse than LeastRatio and the
/// worst at the vertex before, and none cuts another on the side of the background, where no tetrahedra prevent it.
class TetraSliding
{
public:
  TetraSliding(TetraComplex& complex, const SlideOptions& options)
    : Complex(complex)
    , Options(options)
  {
  }

  /// Moves each corner of the tetrahedra below the quality once, those of the worst first. Returns how many moved.
  Index Round();

private:
  /// A vertex, and all tetrahedra at it, of all materials.
  struct Site
  {
    std::int32_t Vertex;
    std::vector<std::int32_t> Star;
  };
  class OuterTriangles;

  std::vector<Site> FindSites() const;
  void FindStars(std::vector<Site>& sites) const;
  bool Slide(const Site& site, OuterTriangles& outer);

  TetraComplex& Complex;
  const SlideOptions& Options;
  std::unordered_map<std::int32_t, MoveRegion> Regions; // of all vertices that were to move
};
}

#endif
