// SPDX-License-Identifier: BSD-3-Clause
// Short loops over arrays of float that compilers turn into vector instructions.
#ifndef LabelMesh_Core_VectorLoops_h
#define LabelMesh_Core_VectorLoops_h

#include "Types.h"

#include <cstring>

/// A function that is compiled twice, for any x86-64 and for one with AVX2, which the loader chooses between. Both do
/// the same operations on each number in the same order (no fused multiply-add), so the results have the same bits.
/// A macro because only some compilers know the attribute. Not under ThreadSanitizer, whose calls GCC also puts into
/// the function that chooses, which the loader runs before the sanitizer is ready.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                           \
  !defined(__SANITIZE_THREAD__)
#define LABELMESH_FOR_ANY_X86 __attribute__((target_clones("avx2", "default")))
#else
#define LABELMESH_FOR_ANY_X86
#endif

namespace LabelMesh
{
/// Number of elements as a type, so that loops over them have a length that the compiler knows. `Vector` holds as many
/// numbers, for sums that must stay in a register: in an array they would not.
template <int Count>
struct Lanes
{
  static constexpr int Size = Count;
  using Vector [[gnu::vector_size(Count * sizeof(float))]] = float;
};
template <>
struct Lanes<1>
{
  static constexpr int Size = 1;
  using Vector = float;
};

template <typename Vector>
[[gnu::always_inline]] inline void Load(const float* from, Vector& to)
{
  std::memcpy(&to, from, sizeof(Vector));
}
template <typename Vector>
[[gnu::always_inline]] inline void Store(const Vector& from, float* to)
{
  std::memcpy(to, &from, sizeof(Vector));
}

/// Covers [0, count) with calls body(Lanes<N>(), first), each for [first, first + N), which may overlap: bodies write
/// what depends on `first` alone, to memory that they do not read. Runs in narrow bands are so short that what is left
/// over by whole vectors would cost more than the vectors.
template <typename Body>
[[gnu::always_inline]] inline void ForLanes(Index count, Body&& body)
{
  if (count >= 8)
  {
    Index i = 0;
    for (; i + 8 <= count; i += 8)
    {
      body(Lanes<8>(), i);
    }
    if (i < count)
    {
      body(Lanes<8>(), count - 8);
    }
  }
  else if (count >= 4)
  {
    body(Lanes<4>(), Index(0));
    if (count > 4)
    {
      body(Lanes<4>(), count - 4);
    }
  }
  else
  {
    for (Index i = 0; i < count; ++i)
    {
      body(Lanes<1>(), i);
    }
  }
}
}

#endif
