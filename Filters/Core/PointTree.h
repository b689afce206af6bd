// SPDX-License-Identifier: BSD-3-Clause
// Near neighbours among points that are all known and ordered in space.
#ifndef LabelMesh_Core_PointTree_h
#define LabelMesh_Core_PointTree_h

#include "Types.h"

#include <algorithm>
#include <vector>

namespace LabelMesh
{
/// Points, each with a length h, in a tree of boxes, each around eight consecutive points or boxes: for points whose
/// order follows a space-filling curve, or curves, a look-up opens few boxes, whatever the range of h. Right for any
/// order. Positions are kept in single precision.
class PointTree
{
public:
  static constexpr int Width = 8;

  PointTree() = default;
  /// position(n) and length(n) for n in [0, count).
  template <typename Position, typename Length>
  PointTree(Index count, const Position& position, const Length& length)
    : Count(count)
    , Leaves((count + Width - 1) / Width)
  {
    this->Origin = count > 0 ? Vec3(position(0)) : Vec3::Zero();
    for (Index n = 0; n < count; ++n)
    {
      this->Leaves[n / Width].Set(
        int(n % Width), (position(n) - this->Origin).template cast<float>(), float(length(n)));
    }
    this->Build();
  }

  Index Size() const { return this->Count; }

  class Scaled;

private:
  using Vec3f = Eigen::Vector3f;

  /// Eight points side by side; those that are missing have length 0.
  struct Leaf
  {
    std::array<float, Width> X{}, Y{}, Z{}, Length{};
    void Set(int lane, const Vec3f& x, float length)
    {
      this->X[lane] = x[0];
      this->Y[lane] = x[1];
      this->Z[lane] = x[2];
      this->Length[lane] = length;
    }
  };
  struct Box
  {
    Vec3f Low = Vec3f::Constant(1e30f), High = Vec3f::Constant(-1e30f);
    float Length = 0.0f; ///< the largest of the points
    void Add(const Vec3f& low, const Vec3f& high, float length)
    {
      this->Low = this->Low.cwiseMin(low);
      this->High = this->High.cwiseMax(high);
      this->Length = std::max(this->Length, length);
    }
  };
  /// Eight boxes side by side.
  struct Node
  {
    std::array<float, Width> LowX{}, LowY{}, LowZ{}, HighX{}, HighY{}, HighZ{}, Length{};
  };

  void Build();
  /// The leaves that are nearer to the box than factor times the smaller of its length and their own largest,
  /// ascending.
  void FindLeaves(const Box& box, float factor, std::vector<std::int32_t>& leaves) const;

  Index Count = 0;
  Vec3 Origin = Vec3::Zero(); ///< of the single-precision positions
  std::vector<Leaf> Leaves;
  std::vector<std::vector<Node>> Levels; ///< Levels[0][n] holds the boxes of leaves 8 n to 8 n + 7, and so on
};

/// Look-ups of the points with |x - p| < factor * min(h, h_p), for a few x near each other (about Width) after each
/// Gather. One object per thread.
class PointTree::Scaled
{
public:
  Scaled(const PointTree& tree, double factor)
    : Tree(tree)
    , Factor(float(factor))
  {
  }

  /// Finds what is near any of the points that will be asked about: position(n) and length(n) for n in [first, last).
  template <typename Position, typename Length>
  void Gather(Index first, Index last, const Position& position, const Length& length)
  {
    Box asked;
    for (Index n = first; n < last; ++n)
    {
      const Vec3f at = (position(n) - this->Tree.Origin).template cast<float>();
      asked.Add(at, at, float(length(n)));
    }
    this->Found.clear();
    this->Tree.FindLeaves(asked, this->Factor, this->Found);
  }

  /// Calls visit(number, squared distance) for every point until it returns true; returns whether it did.
  template <typename Visit>
  bool Any(const Vec3& x, double h, const Visit& visit) const
  {
    const Vec3f at = (x - this->Tree.Origin).cast<float>();
    for (const std::int32_t leaf : this->Found)
    {
      std::array<float, Width> squares;
      std::array<int, Width> lanes;
      const int near = this->Near(this->Tree.Leaves[leaf], at, float(h), squares, lanes);
      for (int n = 0; n < near; ++n)
      {
        if (visit(Index(leaf) * Width + lanes[n], double(squares[lanes[n]])))
        {
          return true;
        }
      }
    }
    return false;
  }
  /// The same for all.
  template <typename Visit>
  void ForEach(const Vec3& x, double h, const Visit& visit) const
  {
    this->Any(x, h,
      [&visit](Index n, double squared)
      {
        visit(n, squared);
        return false;
      });
  }

private:
  /// The squared distances of eight points; how many are in reach, and which.
  int Near(const Leaf& points, const Vec3f& at, float h, std::array<float, Width>& squares,
    std::array<int, Width>& lanes) const
  {
    std::array<float, Width> reaches;
    int any = 0;
    for (int n = 0; n < Width; ++n)
    {
      const float dx = points.X[n] - at[0], dy = points.Y[n] - at[1], dz = points.Z[n] - at[2];
      const float reach = this->Factor * std::min(h, points.Length[n]);
      squares[n] = dx * dx + dy * dy + dz * dz;
      reaches[n] = reach * reach;
      any |= int(squares[n] < reaches[n]);
    }
    int count = 0;
    for (int n = 0; any && n < Width; ++n) // no branch that would be guessed wrong every other time
    {
      lanes[count] = n;
      count += int(squares[n] < reaches[n]);
    }
    return count;
  }

  const PointTree& Tree;
  float Factor;
  std::vector<std::int32_t> Found; ///< leaves
};
}

#endif
