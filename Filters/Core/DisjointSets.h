// SPDX-License-Identifier: BSD-3-Clause
// Union-find.
#ifndef LabelMesh_Core_DisjointSets_h
#define LabelMesh_Core_DisjointSets_h

#include "Types.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace LabelMesh
{
/// Items in disjoint sets; a set is named by its lowest item.
class DisjointSets
{
public:
  explicit DisjointSets(Index size = 0)
    : Parents(static_cast<std::size_t>(size))
  {
    std::iota(this->Parents.begin(), this->Parents.end(), Index(0));
  }
  Index Size() const { return Index(this->Parents.size()); }
  /// A new item in a set of its own.
  Index Add()
  {
    this->Parents.push_back(this->Size());
    return this->Size() - 1;
  }
  Index Find(Index i)
  {
    while (this->Parents[i] != i)
    {
      i = this->Parents[i] = this->Parents[this->Parents[i]];
    }
    return i;
  }
  void Unite(Index a, Index b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parents[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<Index> Parents;
};
}

#endif
