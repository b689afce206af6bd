// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

#include "Parallel.h"

namespace LabelMesh
{
namespace
{
struct Center
{
  Vec3 Twice; ///< the centre
  Index Number;
};
}

BoxTree::BoxTree(std::vector<Box> boxes)
{
  std::vector<Center> centers;
  centers.reserve(boxes.size());
  for (const Box& box : boxes)
  {
    centers.push_back({ box.Low + box.High, Index(centers.size()) });
  }
  const auto divide = [&centers](const Range& range)
  {
    Box hull;
    for (Index p = range.First; p < range.Last; ++p)
    {
      hull.Add(centers[p].Twice);
    }
    int axis = 0;
    (hull.High - hull.Low).maxCoeff(&axis);
    const auto begin = centers.begin();
    std::nth_element(begin + range.First, begin + range.Middle(), begin + range.Last,
      [axis](const Center& a, const Center& b)
      { return a.Twice[axis] != b.Twice[axis] ? a.Twice[axis] < b.Twice[axis] : a.Number < b.Number; });
  };
  // Level by level; the nodes of a level have ranges of their own.
  std::vector<std::vector<Range>> levels{ { { 0, 0, Index(boxes.size()) } } };
  for (;;)
  {
    std::vector<Range> next;
    for (const Range& range : levels.back())
    {
      if (!range.IsLeaf())
      {
        next.push_back(range.Lower());
        next.push_back(range.Upper());
      }
    }
    if (next.empty())
    {
      break;
    }
    ParallelFor(0, Index(levels.back().size()), 1,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          if (!levels.back()[n].IsLeaf())
          {
            divide(levels.back()[n]);
          }
        }
      });
    levels.push_back(std::move(next));
  }
  // Of millions of boxes no copy lives longer than it must.
  this->Order.reserve(boxes.size());
  for (const Center& center : centers)
  {
    this->Order.push_back(center.Number);
  }
  centers = {};
  this->Boxes.reserve(boxes.size());
  for (const Index number : this->Order)
  {
    this->Boxes.push_back(boxes[number]);
  }
  boxes = {};
  this->Nodes.resize(static_cast<std::size_t>(levels.back().back().Node) + 1);
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
  {
    for (const Range& range : *level)
    {
      this->Enclose(range);
    }
  }
}

void BoxTree::Enclose(const Range& range)
{
  Box& node = this->Nodes[range.Node];
  if (range.IsLeaf())
  {
    for (Index p = range.First; p < range.Last; ++p)
    {
      node.Add(this->Boxes[p]);
    }
    return;
  }
  node.Add(this->Nodes[range.Lower().Node]);
  node.Add(this->Nodes[range.Upper().Node]);
}
}
