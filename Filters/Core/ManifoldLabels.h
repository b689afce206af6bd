// SPDX-License-Identifier: BSD-3-Clause
// Labels of tetrahedra that make every material's surface a manifold.
#ifndef LabelMesh_Core_ManifoldLabels_h
#define LabelMesh_Core_ManifoldLabels_h

#include "TetraLabeling.h"

namespace LabelMesh
{
using Edge = std::pair<Index, Index>; ///< vertices, ascending

/// Edges that the surface of some material uses other than twice, ascending. The space beyond the faces of the volume's
/// box is one with `outside`.
std::vector<Edge> NonManifoldEdges(const std::vector<InterfaceTriangle>& faces, MaterialId outside = NoMaterial);

/// Vertices where the triangles of some material form more than one fan, ascending.
std::vector<Index> NonManifoldVertices(const std::vector<InterfaceTriangle>& faces, MaterialId outside = NoMaterial);

/// Relabels tetrahedra at edges and vertices where a material's surface would not be manifold: necks and sheets thinner
/// than the particles' distance, where the labels of single tetrahedra are left to chance. At each, a group of equally
/// labelled tetrahedra around it gets the label of a neighbour that all their corners allow; of the changes that leave
/// fewer faults the one is taken whose tetrahedra are the least certain. Where `core` is not empty, only vertices that
/// it marks are looked at, and what their mending leads to.
void MakeManifold(const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra, MaterialId outside,
  const std::vector<char>& core, TetraLabels& labels);
}

#endif
