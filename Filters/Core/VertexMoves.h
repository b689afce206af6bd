// SPDX-License-Identifier: BSD-3-Clause
// Moving many vertices of a mesh at once without harm to its triangles.
#ifndef LabelMesh_Core_VertexMoves_h
#define LabelMesh_Core_VertexMoves_h

#include "IndicatorSet.h"
#include "Parallel.h"
#include "SurfaceComplex.h"

namespace LabelMesh
{
/// Calls functor(v) for every vertex, on all threads.
template <typename Functor>
void ForEachVertex(const SurfaceComplex& complex, Functor functor)
{
  ParallelFor(0, complex.NumberOfVertices(), 1024,
    [&](Index first, Index last)
    {
      for (Index v = first; v < last; ++v)
      {
        functor(v);
      }
    });
}

/// Moves each vertex by its entry of `moves` and adds the length of the move to its Residual. The corners of a triangle
/// stay where it would turn or fall below the radius ratio `leastRatio`, or lower if it is below; their entries are set
/// to zero. What lies on the volume's faces stays there. Returns the number of vertices moved.
Index MoveVertices(
  const IndicatorSet& indicators, double leastRatio, std::vector<Vec3>& moves, SurfaceComplex& complex);
}

#endif
