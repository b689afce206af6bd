// SPDX-License-Identifier: BSD-3-Clause
#include "VertexFans.h"

#include "Parallel.h"

#include <algorithm>
#include <numeric>

namespace LabelMesh
{
namespace
{
/// A triangle at a vertex: which corner of which, and its other two vertices.
struct Corner
{
  Index Number; ///< 3 * triangle + corner
  Index A, B;
};

/// Numbers the fans of the corners around one vertex from 0; returns how many there are.
int NumberFans(const std::vector<Corner>& corners, std::vector<int>& fans)
{
  fans.assign(corners.size(), -1);
  const auto uses = [&](Index other)
  {
    return std::count_if(
      corners.begin(), corners.end(), [other](const Corner& c) { return c.A == other || c.B == other; });
  };
  int count = 0;
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < corners.size(); ++first)
  {
    if (fans[first] >= 0)
    {
      continue;
    }
    fans[first] = count;
    open.assign(1, first);
    while (!open.empty())
    {
      const Corner corner = corners[open.back()];
      open.pop_back();
      for (const Index other : { corner.A, corner.B })
      {
        for (std::size_t n = 0; uses(other) == 2 && n < corners.size(); ++n)
        {
          if (fans[n] < 0 && (corners[n].A == other || corners[n].B == other))
          {
            fans[n] = count;
            open.push_back(n);
          }
        }
      }
    }
    ++count;
  }
  return count;
}
}

std::vector<Index> SplitFans(std::vector<std::array<Index, 3>>& triangles, Index vertices)
{
  // The corners at vertex v: at[starts[v]] to at[starts[v + 1]].
  std::vector<Index> starts(static_cast<std::size_t>(vertices) + 1, 0), at(3 * triangles.size());
  for (const auto& triangle : triangles)
  {
    for (const Index v : triangle)
    {
      ++starts[v + 1];
    }
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index corner = 0; corner < Index(at.size()); ++corner)
  {
    at[next[triangles[corner / 3][corner % 3]]++] = corner;
  }
  const std::vector<std::array<Index, 3>> given = triangles;
  const auto cornersAt = [&](Index v, std::vector<Corner>& corners)
  {
    corners.clear();
    for (Index n = starts[v]; n < starts[v + 1]; ++n)
    {
      const auto& triangle = given[at[n] / 3];
      corners.push_back({ at[n], triangle[(at[n] + 1) % 3], triangle[(at[n] + 2) % 3] });
    }
  };
  // Nearly all vertices have one fan.
  constexpr Index chunk = 1024;
  const std::vector<Index> pinched = ParallelCollect<Index>((vertices + chunk - 1) / chunk,
    [&](Index c, std::vector<Index>& found)
    {
      std::vector<Corner> corners;
      std::vector<int> fans;
      for (Index v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v)
      {
        cornersAt(v, corners);
        if (NumberFans(corners, fans) > 1)
        {
          found.push_back(v);
        }
      }
    });
  std::vector<Index> copies;
  std::vector<Corner> corners;
  std::vector<int> fans;
  for (const Index v : pinched)
  {
    cornersAt(v, corners);
    const int count = NumberFans(corners, fans);
    for (std::size_t n = 0; n < corners.size(); ++n)
    {
      if (fans[n] > 0)
      {
        triangles[corners[n].Number / 3][corners[n].Number % 3] = vertices + Index(copies.size()) + fans[n] - 1;
      }
    }
    copies.insert(copies.end(), static_cast<std::size_t>(count - 1), v);
  }
  return copies;
}
}
