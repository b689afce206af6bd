// SPDX-License-Identifier: BSD-3-Clause
// Separable Gaussian of a dense field.
#ifndef LabelMesh_Core_GaussianBlur_h
#define LabelMesh_Core_GaussianBlur_h

#include "Lattice.h"

#include <vector>

namespace LabelMesh
{
/// Convolves `field` (on `frame`; zero beyond) in place with a Gaussian of standard deviation `sigma` (same unit as the
/// spacing), cut at three of them. Rows that hold only zeros cost little.
void GaussianBlur(const Lattice& frame, double sigma, std::vector<float>& field);
}

#endif
