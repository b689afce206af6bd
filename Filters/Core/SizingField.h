// SPDX-License-Identifier: BSD-3-Clause
// The sizing field: how far apart particles should be (paper, section 5.2).
#ifndef LabelMesh_Core_SizingField_h
#define LabelMesh_Core_SizingField_h

#include "FeatureSize.h"
#include "IndicatorSet.h"
#include "Monitor.h"

#include <map>

namespace LabelMesh
{
struct SizingOptions
{
  double Epsilon = 0.65;         ///< h0 = Epsilon * max(LFS, FeatureSizeFloor)
  double FeatureSizeFloor = 0.8; ///< voxels: lower bound of the local feature size, near the tightening radius (paper)
  /// Voxels: how far an edge may stay beside the surface that it spans, by the curvature; never asks for less than
  /// Epsilon * FeatureSizeFloor, since curvatures that large are those of voxels; 0: no bound.
  double MaximumDeviation = 0.2;
  double Gradation = 0.4;   ///< the largest |grad h|
  double MinimumLength = 0; ///< world length; 0: none
  double MaximumLength = 0; ///< world length; 0: none
  /// World length per material, 0: none; empty: none at all. Bounds h0 on that material's interfaces.
  std::vector<double> MaterialMaximumLength;
  /// World length per pair of materials, ascending: bounds h0 on the interfaces between the two.
  std::map<std::array<MaterialId, 2>, double> InterfaceMaximumLength;
  /// Triangles wanted: h0 is scaled until about half as many particles are predicted; 0: off. The minimum, the maxima
  /// and the user's bound hold all the same, and may keep the target out of reach.
  double TargetTriangles = 0;
};

struct SizingResult
{
  Grid<float> TargetLength;      ///< world length, on the working lattice
  Grid<float> FeatureSize;       ///< world length, of the nearest interface sample
  double PredictedParticles = 0; ///< before any moves
  double Scale = 1;              ///< of h0, to reach TargetTriangles
};

/// The sizing field h on the working lattice:
///  - h0 = Epsilon max(LFS, floor) near the interfaces (FeatureSize.h), at most max(1/kappa, 0.6 Epsilon floor) with
///    kappa the larger principal curvature: the local feature size misses what the sampling of the lattice hides;
///  - h0 at most the maxima, and everywhere at most the user's bound; at least the minimum, which wins over the others;
///  - h(x) = min over y of h0(y) + Gradation |x - y|, the steady state of h_t = min(|grad h|, Gradation) - |grad h|.
///    The distance is that of a 3^3 chamfer mask (wider where the spacing is anisotropic): up to 13 % too long between
///    its directions.
///
/// `user`, if not null, is a further upper bound of h: world length, on any lattice of the same local frame. Where it
/// is not a positive number, and beyond its lattice, it bounds nothing.
/// Throws std::invalid_argument when an option has no meaning, with a sentence for the user.
SizingResult ComputeSizing(
  const IndicatorSet& indicators, const SizingOptions& options, const Grid<float>* user, const Monitor& monitor);

/// h(x) = min over y of h(y) + slope |x - y|, with the distance above: one sweep forwards and one backwards.
void LimitGradient(const Lattice& lattice, double slope, std::vector<float>& h);

/// About how many particles (vertices) a mesh with this sizing field has: the sum over label-changing grid edges of
/// s A / (0.866 h^2), A the area of interface that such an edge stands for, s the share of a hexagonal packing that the
/// sampling reaches, 0.78 to 1.23 by h in voxels (about 0.93 where h is a voxel). The number of triangles is about
/// twice that.
double PredictParticles(const IndicatorSet& indicators, const Grid<float>& targetLength);
}

#endif
