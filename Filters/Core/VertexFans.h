// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that touch themselves in a vertex, taken apart there.
#ifndef LabelMesh_Core_VertexFans_h
#define LabelMesh_Core_VertexFans_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// Gives every fan of triangles at a vertex but the first a vertex of its own. A fan is what hangs together across
/// edges of exactly two triangles. `triangles` name vertices 0 to vertices - 1; new ones follow. Returns, for each new
/// vertex, the one that it is a copy of.
std::vector<Index> SplitFans(std::vector<std::array<Index, 3>>& triangles, Index vertices);
}

#endif
