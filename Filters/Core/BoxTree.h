// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes, to find those that overlap.
#ifndef LabelMesh_Core_BoxTree_h
#define LabelMesh_Core_BoxTree_h

#include "Types.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace LabelMesh
{
/// A box with its faces.
struct Box
{
  Vec3 Low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 High = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void Add(const Vec3& x)
  {
    this->Low = this->Low.cwiseMin(x);
    this->High = this->High.cwiseMax(x);
  }
  void Add(const Box& other)
  {
    this->Low = this->Low.cwiseMin(other.Low);
    this->High = this->High.cwiseMax(other.High);
  }
  bool Empty() const { return !(this->Low[0] <= this->High[0]); }
  bool Overlaps(const Box& other) const
  {
    return this->Low[0] <= other.High[0] && other.Low[0] <= this->High[0] && this->Low[1] <= other.High[1] &&
      other.Low[1] <= this->High[1] && this->Low[2] <= other.High[2] && other.Low[2] <= this->High[2];
  }
};

/// Halves the boxes by their centres along the longest side until a few are left. Boxes stand in the order of the
/// tree, "at" a position; the order depends on the boxes alone.
class BoxTree
{
public:
  explicit BoxTree(std::vector<Box> boxes);

  Index Size() const { return Index(this->Order.size()); }
  /// The box at a position, and its number among those that were given.
  const Box& At(Index position) const { return this->Boxes[position]; }
  Index Number(Index position) const { return this->Order[position]; }

  /// Calls visit(position) for each box at `first` or later that overlaps the query.
  template <typename Visit>
  void VisitOverlaps(const Box& query, Index first, Visit&& visit) const
  {
    Range stack[2 * 64];
    int top = 0;
    stack[top++] = { 0, 0, this->Size() };
    while (top > 0)
    {
      const Range range = stack[--top];
      if (range.Last <= first || !this->Nodes[range.Node].Overlaps(query))
      {
        continue;
      }
      if (range.IsLeaf())
      {
        for (Index position = std::max(first, range.First); position < range.Last; ++position)
        {
          if (this->Boxes[position].Overlaps(query))
          {
            visit(position);
          }
        }
        continue;
      }
      stack[top++] = range.Upper();
      stack[top++] = range.Lower();
    }
  }

private:
  static constexpr Index LeafSize = 4;

  /// The positions under a node; the children of node n are 2 n + 1 and 2 n + 2.
  struct Range
  {
    Index Node, First, Last;

    bool IsLeaf() const { return this->Last - this->First <= LeafSize; }
    Index Middle() const { return (this->First + this->Last) / 2; }
    Range Lower() const { return { 2 * this->Node + 1, this->First, this->Middle() }; }
    Range Upper() const { return { 2 * this->Node + 2, this->Middle(), this->Last }; }
  };
  /// The box of a node, after those of its children.
  void Enclose(const Range& range);

  std::vector<Index> Order;
  std::vector<Box> Boxes; ///< in that order
  std::vector<Box> Nodes;
};
}

#endif
