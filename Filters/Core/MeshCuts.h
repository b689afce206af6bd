// SPDX-License-Identifier: BSD-3-Clause
// Where the triangles of a mesh cut each other, and putting the mesh back there to what it was without cuts.
#ifndef LabelMesh_Core_MeshCuts_h
#define LabelMesh_Core_MeshCuts_h

#include "SurfaceComplex.h"

namespace LabelMesh
{
/// The vertices of triangles that cut each other, ascending; where `near` is not empty (ascending), only of cuts with
/// triangles at those vertices.
std::vector<Index> VerticesOfCuts(const SurfaceComplex& complex, const std::vector<Index>& near = {});

/// Puts what is around the vertices `cuts` back to what it was before the mesh was improved, triangles and positions.
/// False, and the improved mesh is of no use, where that does not fit what is around it now, or leaves a triangle
/// below the wanted radius ratio or a cut.
bool PutBack(
  const SurfaceComplex& before, const std::vector<Index>& cuts, double wantedRatio, SurfaceComplex& improved);
}

#endif
