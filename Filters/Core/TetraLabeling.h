// SPDX-License-Identifier: BSD-3-Clause
// Labels of Delaunay tetrahedra, and the interface faces between different labels (paper, sections 4.3 and 5.3).
#ifndef LabelMesh_Core_TetraLabeling_h
#define LabelMesh_Core_TetraLabeling_h

#include "Delaunay.h"
#include "IndicatorSet.h"
#include "InterfaceMesh.h"
#include "Monitor.h"

namespace LabelMesh
{
struct TetraLabels
{
  std::vector<MaterialId> Labels;
  /// How much larger the label's indicator is than that of the next material that all four corners share; the largest
  /// double where there is no other.
  std::vector<double> Certainty;
  Index EmptySets = 0; ///< tetrahedra whose corners share no material: undersampling at a 1-cell
};

/// The label of a tetrahedron is the material with the largest indicator at its circumcentre among those that are in
/// the sets of all four corners, so that no face crosses an interface. The paper asks the circumcentre alone.
TetraLabels LabelTetrahedra(
  const IndicatorSet& indicators, const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra);

/// The materials that all four corners of a tetrahedron share: those that it may be labelled with. The space beyond the
/// faces of the volume's box is none: every tetrahedron lies within.
MaterialSet SharedMaterials(const std::vector<Particle>& particles, const std::array<std::int32_t, 4>& corners);

/// The faces between tetrahedra of different labels; beyond the hull is `outside`, or the space beyond the face of the
/// volume's box that the vertices lie on. Vertices are the particles' indices.
std::vector<InterfaceTriangle> InterfaceFaces(const std::vector<Particle>& particles,
  const Tetrahedralization& tetrahedra, const TetraLabels& labels, MaterialId outside);

/// The interface of a set of particles: all of the above. `core` as in MakeManifold. The monitor hears of each step.
struct InterfaceComplex
{
  Tetrahedralization Tetrahedra;
  TetraLabels Labels;
  std::vector<InterfaceTriangle> Faces;
};
InterfaceComplex BuildInterface(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const std::vector<char>& core = std::vector<char>(), const Monitor& monitor = Monitor());

/// A face is right if and only if both its materials are in the sets of all its vertices.
bool IsWrong(const std::vector<Particle>& particles, const InterfaceTriangle& face);

Vec3 Circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
}

#endif
