// SPDX-License-Identifier: BSD-3-Clause
#include "VertexFans.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace LabelMesh
{
namespace
{
/// A triangle's use of an edge, by the corners (3 * triangle + 0, 1, 2) at its ends; First at the smaller vertex.
struct EdgeUse
{
  Index Low, High;
  Index First, Second;
};

Index Root(std::vector<Index>& parents, Index n)
{
  while (parents[n] != n)
  {
    n = parents[n] = parents[parents[n]];
  }
  return n;
}

void Join(std::vector<Index>& parents, Index a, Index b)
{
  const Index rootA = Root(parents, a), rootB = Root(parents, b);
  parents[std::max(rootA, rootB)] = std::min(rootA, rootB);
}
}

std::vector<Index> SplitFans(std::vector<std::array<Index, 3>>& triangles, Index vertices)
{
  std::vector<EdgeUse> uses;
  for (Index t = 0; t < Index(triangles.size()); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const Index a = triangles[t][i], b = triangles[t][j];
      uses.push_back(a < b ? EdgeUse{ a, b, 3 * t + i, 3 * t + j } : EdgeUse{ b, a, 3 * t + j, 3 * t + i });
    }
  }
  std::sort(uses.begin(), uses.end(),
    [](const EdgeUse& p, const EdgeUse& q)
    { return std::tie(p.Low, p.High, p.First) < std::tie(q.Low, q.High, q.First); });
  // Corners at one vertex are joined to fans; the smallest corner stands for its fan.
  std::vector<Index> fans(3 * triangles.size());
  std::iota(fans.begin(), fans.end(), Index(0));
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last)
  {
    while (last < uses.size() && uses[last].Low == uses[first].Low && uses[last].High == uses[first].High)
    {
      ++last;
    }
    if (last - first == 2)
    {
      Join(fans, uses[first].First, uses[first + 1].First);
      Join(fans, uses[first].Second, uses[first + 1].Second);
    }
  }
  std::vector<Index> firstFan(static_cast<std::size_t>(vertices), -1), copies, numbers(fans.size(), -1);
  for (Index corner = 0; corner < Index(fans.size()); ++corner)
  {
    Index& vertex = triangles[corner / 3][corner % 3];
    const Index fan = Root(fans, corner);
    if (firstFan[vertex] < 0)
    {
      firstFan[vertex] = fan;
    }
    if (firstFan[vertex] != fan)
    {
      if (numbers[fan] < 0)
      {
        numbers[fan] = vertices + Index(copies.size());
        copies.push_back(vertex);
      }
      vertex = numbers[fan];
    }
  }
  return copies;
}
}
