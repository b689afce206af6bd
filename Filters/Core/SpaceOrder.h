// SPDX-License-Identifier: BSD-3-Clause
// Particles in an order in which neighbours are near in memory too.
#ifndef LabelMesh_Core_SpaceOrder_h
#define LabelMesh_Core_SpaceOrder_h

#include "Lattice.h"
#include "Particles.h"

#include <vector>

namespace LabelMesh
{
/// Orders the particles from `first` on along a space-filling curve. Returns the new numbers of all.
std::vector<std::int32_t> SortInSpace(const Lattice& frame, std::vector<Particle>& particles, Index first);
}

#endif
