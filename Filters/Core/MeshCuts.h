// SPDX-License-Identifier: BSD-3-Clause
// Where the triangles of a mesh cut each other, and putting the mesh back there to what it was without cuts.
#ifndef LabelMesh_Core_MeshCuts_h
#define LabelMesh_Core_MeshCuts_h

#include "SurfaceComplex.h"

namespace LabelMesh
{
/// A place where triangles cut each other: the vertices, ascending, of such triangles as have vertices in common.
using Cut = std::vector<Index>;

/// All cuts; where `near` is not empty (ascending), only those with triangles at its vertices.
std::vector<Cut> FindCuts(const SurfaceComplex& complex, const std::vector<Index>& near = {});

/// The vertices of all cuts, ascending.
std::vector<Index> VerticesOf(const std::vector<Cut>& cuts);

/// Puts what is around each cut back to what it was before the mesh was improved, triangles and positions; one ring of
/// vertices farther where that does not fit what is around it now, makes a triangle that is below `wantedRatio` and
/// below all that were there before, or leaves a cut. False, and the improved mesh is of no use, where six rings do not
/// do.
bool PutBack(const SurfaceComplex& before, std::vector<Cut> cuts, double wantedRatio, SurfaceComplex& improved);
}

#endif
