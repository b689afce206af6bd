// SPDX-License-Identifier: BSD-3-Clause
// The loops of Core over threads. The only file of Core that knows VTK.
#ifndef LabelMesh_Core_Parallel_h
#define LabelMesh_Core_Parallel_h

#include "Types.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace LabelMesh
{
/// Calls body(first, last) on pieces of [begin, end), at most `grain` long (0: chosen by the backend).
/// Pieces run in any order: a body writes only what belongs to its own indices, so that the result has the same
/// bits for any number of threads.
template <typename Body>
void ParallelFor(Index begin, Index end, Index grain, Body&& body)
{
  if (end > begin)
  {
    vtkSMPTools::For(begin, end, grain, [&body](vtkIdType first, vtkIdType last) { body(Index(first), Index(last)); });
  }
}

/// Calls body(n, found) for each n in [0, count), which appends what it finds; returns all, in the order of n.
template <typename T, typename Body>
std::vector<T> ParallelCollect(Index count, Body&& body)
{
  std::vector<std::vector<T>> parts(static_cast<std::size_t>(std::max<Index>(count, 0)));
  ParallelFor(0, count, 1,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        body(n, parts[n]);
      }
    });
  std::size_t total = 0;
  for (const auto& part : parts)
  {
    total += part.size();
  }
  std::vector<T> all;
  all.reserve(total);
  for (const auto& part : parts)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// Runs `work` with threads switched on. ParaView's VTK starts with a sequential backend, so a filter that only
/// called vtkSMPTools would use one core there. VTK_SMP_MAX_THREADS and vtkSMPTools::Initialize() still bound the
/// number, and VTK_SMP_BACKEND_IN_USE still chooses the backend. May be entered by several filters at once.
void WithThreads(const std::function<void()>& work);
}

#endif
