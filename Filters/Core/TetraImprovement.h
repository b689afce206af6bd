// SPDX-License-Identifier: BSD-3-Clause
// The last stage of meshing with tetrahedra: no slivers, better angles.
#ifndef LabelMesh_Core_TetraImprovement_h
#define LabelMesh_Core_TetraImprovement_h

#include "Monitor.h"
#include "TetraSliding.h"

namespace LabelMesh
{
struct TetraImproveOptions
{
  int SmoothingPasses = 1;     ///< over all vertices inside materials
  int Passes = 10;             ///< over the tetrahedra below WantedQuality, at most, before smoothing and after
  double WantedQuality = 0.4;  ///< TetraQuality below which a tetrahedron is worked on
  double InsertionBelow = 0.3; ///< TetraQuality below which, where all else fails, a vertex may be added
  SlideOptions Slide;          ///< Slide.Rounds = 0: no vertex of the interface moves
};

struct TetraImproveResult
{
  Index Moves = 0, Edges = 0, Faces = 0, Contractions = 0, Insertions = 0;
  Index Slides = 0; ///< moves of vertices of the interface
  int Passes = 0;   ///< until nothing helped any more
};

/// Improves the tetrahedra inside each material. What material is where stays as it is, and so do the interface's
/// triangles. From the worst tetrahedron on, vertices inside are moved, edges and faces are flipped, vertices taken out
/// and put in, each where the worst quality of the tetrahedra that it touches rises. Then vertices inside are smoothed
/// all together: not before, since slivers would say where they go. Where tetrahedra are badly shaped all the same,
/// vertices of the interface move a little (TetraSliding); all others of it stay where they are, to the bit. The same
/// bits for any number of threads. Throws Aborted when the monitor asks to stop.
TetraImproveResult ImproveTetrahedra(TetraMesh& mesh, const TetraImproveOptions& options, const Monitor& monitor);
}

#endif
