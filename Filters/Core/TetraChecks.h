// SPDX-License-Identifier: BSD-3-Clause
// Figures of a tetrahedral mesh, for its report.
#ifndef LabelMesh_Core_TetraChecks_h
#define LabelMesh_Core_TetraChecks_h

#include "TetraMesh.h"

namespace LabelMesh
{
inline constexpr int DihedralBins = 18; // of 10 degrees each

/// Of a material's tetrahedra, or of all. What is said of none: ratios 1, angles NaN.
struct TetraCheck
{
  Index Tetrahedra = 0;
  Index TurnedOver = 0; ///< of no or negative volume
  Index Slivers = 0;    ///< radius ratio below SliverRatio
  double MinRadiusRatio = 1.0, FirstPercentileRatio = 1.0, MeanRadiusRatio = 1.0;
  double MinDihedral = 0.0, MaxDihedral = 0.0; ///< degrees
  double Volume = 0.0;                         ///< world length cubed: the sum of the signed volumes
  Index Worst = -1;                            ///< the tetrahedron of the least radius ratio
  /// How many dihedral angles, six of each tetrahedron, are in 0 to 10 degrees, 10 to 20 and so on.
  std::array<Index, DihedralBins> Dihedrals{};
};

struct TetraChecks
{
  TetraCheck All;
  std::vector<TetraCheck> Materials; ///< by MaterialId
};

/// The same bits for any number of threads.
TetraChecks CheckTetrahedra(const TetraMesh& mesh, Index materials);
}

#endif
