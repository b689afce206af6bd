// SPDX-License-Identifier: BSD-3-Clause
// For every sample of a lattice, the nearest of a set of seeds.
#ifndef LabelMesh_Core_FeatureTransform_h
#define LabelMesh_Core_FeatureTransform_h

#include "Lattice.h"

#include <vector>

namespace LabelMesh
{
/// The exact feature transform of the samples `seeds` of `lattice`: result[x] is the position in `seeds` of the sample
/// nearest to x (Euclidean, in world length, so anisotropic spacing is right); -1 everywhere when there are no seeds.
///
/// Separable lower envelopes of parabolas: linear in the number of samples. Among equally near seeds the choice is
/// fixed but not specified. At most 2^31 - 1 seeds, each sample at most once.
std::vector<std::int32_t> NearestSeeds(const Lattice& lattice, const std::vector<Index>& seeds);
}

#endif
