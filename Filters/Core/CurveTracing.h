// SPDX-License-Identifier: BSD-3-Clause
// The 0-cells and 1-cells of the material interfaces, found and followed exactly.
#ifndef LabelMesh_Core_CurveTracing_h
#define LabelMesh_Core_CurveTracing_h

#include "IndicatorSet.h"
#include "Monitor.h"
#include "Particles.h"

namespace LabelMesh
{
/// A point where four materials meet.
struct ZeroCell
{
  Vec3 Position = Vec3::Zero();
  MaterialSet Materials;
};

/// A curve where three materials meet, as a dense polyline. A closed one does not repeat its first point.
struct OneCell
{
  std::array<MaterialId, 3> Materials{ NoMaterial, NoMaterial, NoMaterial }; ///< ascending
  std::vector<Vec3> Points;   ///< with the positions of the 0-cells at its ends
  Index Start = -1, End = -1; ///< 0-cells; -1 at both ends of a closed curve and at an open end
  bool Closed = false;
};

struct JunctionNetwork
{
  std::vector<ZeroCell> ZeroCells;
  std::vector<OneCell> OneCells;
  /// (0-cell, triple) pairs with other than one curve end, plus open ends: 0 where the fields are in general position.
  Index OpenEnds = 0;
};

/// Seeds are the cells of the working lattice whose corners carry four or more labels (0-cells) and three or more
/// (1-cells). From each 0-cell its four triples are traced, starting to where the fourth material falls, with steps of
/// 0.2 voxel and a Gauss-Newton corrector; where a fourth material wins, that 0-cell is solved and the curve ends
/// there. The junctions of nothing but outside (IndicatorSet::IsOutside) are left out. Left-over three-label seeds give
/// closed curves and those between 0-cells that the lattice does not show.
JunctionNetwork TraceJunctions(const IndicatorSet& indicators, const Monitor& monitor);

/// From x to the nearest point of the segment from a to b.
double DistanceToSegment(const Vec3& x, const Vec3& a, const Vec3& b);
}

#endif
