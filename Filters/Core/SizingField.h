// SPDX-License-Identifier: BSD-3-Clause
// The sizing field: how far apart particles should be (paper, section 5.2).
#ifndef LabelMesh_Core_SizingField_h
#define LabelMesh_Core_SizingField_h

#include "IndicatorSet.h"
#include "Monitor.h"

namespace LabelMesh
{
struct SizingOptions
{
  double Epsilon = 0.5;        ///< h0 = Epsilon * max(LFS, FeatureSizeFloor)
  double FeatureSizeFloor = 1; ///< voxels: the paper's lower bound of the local feature size, the tightening radius
  double Gradation = 0.4;      ///< the largest |grad h|
  double MinimumLength = 0;    ///< world length; 0: none
  double MaximumLength = 0;    ///< world length; 0: none
  /// World length per material, 0: none; empty: none at all. Bounds h0 on that material's interfaces.
  std::vector<double> MaterialMaximumLength;
};

struct SizingResult
{
  Grid<float> TargetLength; ///< world length, on the working lattice
  Grid<float> FeatureSize;  ///< world length: distance to the medial axis at interface voxels, spread to the nearest others
  double PredictedParticles = 0; ///< before any moves
};

/// `user`, if not null, is a further upper bound of h: world length, on any lattice of the same local frame.
SizingResult ComputeSizing(const IndicatorSet& indicators, const SizingOptions& options, const Grid<float>* user,
  const Monitor& monitor);

/// About how many particles (vertices) a mesh with this sizing field has: 0.93 sum over label-changing grid edges of
/// w / (0.866 h^2). The number of triangles is about twice that.
double PredictParticles(const IndicatorSet& indicators, const Grid<float>& targetLength);
}

#endif
