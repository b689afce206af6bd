// SPDX-License-Identifier: BSD-3-Clause
// The differentiable maximum of the paper's appendix and the functions made with it (paper, section 4.1).
#ifndef LabelMesh_Core_SmoothMaximum_h
#define LabelMesh_Core_SmoothMaximum_h

#include "IndicatorSet.h"

namespace LabelMesh
{
/// The smooth maximum of equations 10 and 11, with epsilon in the unit of the values:
///   max(V) = 1 / 2^(m-1) sum_i v_i prod_{j != i} g(v_i - v_j),  g(v) = 1 + v / sqrt(v^2 + epsilon^2).
///
/// `partials`, if not null, gets the `count` derivatives d max / d v_i (equation 12 with 13 is sum_i partials[i] grad
/// v_i; its inner product runs over the indices other than i and j, which the paper's does not say).
///
/// It is the maximum itself where one value leads by much more than epsilon, and where exactly two are equal and
/// lead. Where m values v are equal and lead it is m v / 2^(m-1): 0.75 v for three, 0.5 v for four. The zero sets of
/// the cell indicators are thus displaced at 1-cells and 0-cells wherever the indicators that meet there are not
/// zero, by the lengths that they differ from zero. Particles are therefore sampled with the exact maximum
/// (Junction.h); these functions serve inspection and comparison. The work grows as count^2, with partials as
/// count^3.
double SmoothMaximum(const double* values, int count, double epsilon, double* partials = nullptr);

/// Equation 1: f_m - max over j != m of f_j, > 0 where material m is present. The maximum runs over the candidates at x
/// (IndicatorSet); where m is the only one, its rival is the largest of all others. Without any other material: f_m.
/// `gradient`, if not null, gets the gradient.
double InsideOutside(
  const IndicatorSet& indicators, MaterialId m, const Vec3& x, double epsilon = 1e-5, Vec3* gradient = nullptr);

/// Equations 2 to 4: the sum of the squared inside/outside functions of `count` (2 to 4) materials: zero on the cell
/// where they meet, positive elsewhere. `gradient`, if not null, gets equation 5.
double CellIndicator(const IndicatorSet& indicators, const MaterialId* materials, int count, const Vec3& x,
  double epsilon = 1e-5, Vec3* gradient = nullptr);
}

#endif
