// SPDX-License-Identifier: BSD-3-Clause
#include "SpaceOrder.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
/// Interleaves the lower 21 bits of three numbers: near positions get near codes.
std::uint64_t MortonCode(const Lattice& frame, const Vec3& x)
{
  const Vec3 index = frame.ToIndex(x);
  std::uint64_t code = 0;
  for (int a = 0; a < 3; ++a)
  {
    std::uint64_t bits = std::uint64_t(std::max(index[a], 0.0)) & 0x1FFFFF;
    bits = (bits | bits << 32) & 0x1F00000000FFFF;
    bits = (bits | bits << 16) & 0x1F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    code |= bits << a;
  }
  return code;
}
}

std::vector<std::int32_t> SortInSpace(const Lattice& frame, std::vector<Particle>& particles, Index first)
{
  std::vector<std::pair<std::uint64_t, Index>> order;
  order.reserve(particles.size() - first);
  for (Index n = first; n < Index(particles.size()); ++n)
  {
    order.emplace_back(MortonCode(frame, particles[n].Position), n);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> numbers(particles.size());
  std::iota(numbers.begin(), numbers.begin() + first, 0);
  std::vector<Particle> sorted;
  sorted.reserve(order.size());
  for (const auto& [code, n] : order)
  {
    numbers[n] = std::int32_t(first + Index(sorted.size()));
    sorted.push_back(particles[n]);
  }
  std::copy(sorted.begin(), sorted.end(), particles.begin() + first);
  return numbers;
}
}
