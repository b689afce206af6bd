// SPDX-License-Identifier: BSD-3-Clause
#include "PointTree.h"

namespace LabelMesh
{
namespace
{
constexpr int Width = PointTree::Width;

/// Which of eight boxes are near enough to another one; returns how many.
template <typename Node, typename Box>
int NearChildren(const Node& node, const Box& box, float factor, std::array<int, Width>& near)
{
  std::array<float, Width> excess;
  for (int n = 0; n < Width; ++n)
  {
    const float dx = std::max(std::max(node.LowX[n] - box.High[0], box.Low[0] - node.HighX[n]), 0.0f);
    const float dy = std::max(std::max(node.LowY[n] - box.High[1], box.Low[1] - node.HighY[n]), 0.0f);
    const float dz = std::max(std::max(node.LowZ[n] - box.High[2], box.Low[2] - node.HighZ[n]), 0.0f);
    const float reach = factor * std::min(box.Length, node.Length[n]);
    excess[n] = dx * dx + dy * dy + dz * dz - reach * reach;
  }
  int count = 0;
  for (int n = 0; n < Width; ++n)
  {
    near[count] = n;
    count += int(excess[n] < 0.0f);
  }
  return count;
}
}

void PointTree::Build()
{
  std::vector<Box> boxes(this->Leaves.size());
  for (Index n = 0; n < this->Count; ++n)
  {
    const Leaf& leaf = this->Leaves[n / Width];
    const int lane = int(n % Width);
    const Vec3f x(leaf.X[lane], leaf.Y[lane], leaf.Z[lane]);
    boxes[n / Width].Add(x, x, leaf.Length[lane]);
  }
  while (!boxes.empty())
  {
    std::vector<Node> nodes((boxes.size() + Width - 1) / Width);
    std::vector<Box> parents(nodes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b)
    {
      const Box& box = boxes[b];
      Node& node = nodes[b / Width];
      const int lane = int(b % Width);
      node.LowX[lane] = box.Low[0];
      node.LowY[lane] = box.Low[1];
      node.LowZ[lane] = box.Low[2];
      node.HighX[lane] = box.High[0];
      node.HighY[lane] = box.High[1];
      node.HighZ[lane] = box.High[2];
      node.Length[lane] = box.Length;
      parents[b / Width].Add(box.Low, box.High, box.Length);
    }
    this->Levels.push_back(std::move(nodes));
    boxes = std::move(parents);
    if (boxes.size() == 1)
    {
      break;
    }
  }
}

void PointTree::FindLeaves(const Box& box, float factor, std::vector<std::int32_t>& leaves) const
{
  if (this->Levels.empty())
  {
    return;
  }
  // Depth first, with what is still to be opened of each level.
  constexpr int most = 24; // 8^24 points
  std::array<std::array<int, Width>, most> near;
  std::array<int, most> count, next;
  std::array<std::int32_t, most> node;
  const auto open = [&](int level, std::int32_t n)
  {
    node[level] = n;
    next[level] = 0;
    count[level] = NearChildren(this->Levels[level][n], box, factor, near[level]);
  };
  const int top = int(this->Levels.size()) - 1;
  open(top, 0);
  for (int level = top; level <= top;)
  {
    if (level == 0)
    {
      for (int n = 0; n < count[0]; ++n)
      {
        leaves.push_back(node[0] * Width + near[0][n]);
      }
    }
    if (level == 0 || next[level] == count[level])
    {
      ++level;
      continue;
    }
    const std::int32_t child = node[level] * Width + near[level][next[level]++];
    open(--level, child);
  }
}
}
