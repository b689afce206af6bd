// SPDX-License-Identifier: BSD-3-Clause
#include "LabelSurvey.h"

#include "Parallel.h"

#include <map>
#include <unordered_map>

namespace LabelMesh
{
namespace
{
/// Two ids, the smaller in the upper half: ascending pairs have ascending keys.
using Key = std::uint32_t;
static_assert(sizeof(MaterialId) == 2, "two ids make a key");

Key KeyOf(MaterialId a, MaterialId b)
{
  return Key(std::min(a, b)) << 16 | std::max(a, b);
}

/// Counts pairs; most are those of the one before, so that the table is seldom asked.
class PairCounter
{
public:
  void Add(MaterialId a, MaterialId b)
  {
    const Key key = KeyOf(a, b);
    if (!this->Last || key != this->LastKey)
    {
      this->Last = &this->Counts[key];
      this->LastKey = key;
    }
    ++*this->Last;
  }
  std::unordered_map<Key, Index> Counts;

private:
  Index* Last = nullptr; // elements of an unordered_map stay where they are
  Key LastKey = 0;
};

/// One slice: voxels, as pairs of an id with itself, and the faces to the next voxel along each axis and to the
/// outside.
class SliceCounter
{
public:
  SliceCounter(const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background)
    : Dims(dims)
    , Ids(ids)
    , Background(background)
  {
  }

  std::vector<std::pair<Key, Index>> Count(int k) const
  {
    PairCounter voxels, faces;
    const Index row = this->Dims[0], slice = row * this->Dims[1];
    for (int j = 0; j < this->Dims[1]; ++j)
    {
      const MaterialId* line = this->Ids.data() + k * slice + j * row;
      this->CountLine(line, voxels, faces);
      this->CountAcross(line, j + 1 < this->Dims[1] ? line + row : nullptr, faces);
      this->CountAcross(line, k + 1 < this->Dims[2] ? line + slice : nullptr, faces);
      if (j == 0)
      {
        this->CountAcross(line, nullptr, faces);
      }
      if (k == 0)
      {
        this->CountAcross(line, nullptr, faces);
      }
    }
    std::vector<std::pair<Key, Index>> found(voxels.Counts.begin(), voxels.Counts.end());
    found.insert(found.end(), faces.Counts.begin(), faces.Counts.end());
    return found;
  }

private:
  void CountFace(MaterialId a, MaterialId b, PairCounter& faces) const
  {
    if (a != b)
    {
      faces.Add(a, b);
    }
  }

  void CountLine(const MaterialId* line, PairCounter& voxels, PairCounter& faces) const
  {
    this->CountFace(this->Background, line[0], faces);
    for (int i = 0; i < this->Dims[0]; ++i)
    {
      voxels.Add(line[i], line[i]);
      this->CountFace(line[i], i + 1 < this->Dims[0] ? line[i + 1] : this->Background, faces);
    }
  }

  /// `other`: the line beside it; null for the space outside.
  void CountAcross(const MaterialId* line, const MaterialId* other, PairCounter& faces) const
  {
    for (int i = 0; i < this->Dims[0]; ++i)
    {
      this->CountFace(line[i], other ? other[i] : this->Background, faces);
    }
  }

  const std::array<int, 3> Dims;
  const std::vector<MaterialId>& Ids;
  const MaterialId Background;
};
}

LabelSurvey SurveyLabels(const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background,
  int numberOfIds, const Monitor& monitor)
{
  LabelSurvey survey;
  survey.Voxels.assign(static_cast<std::size_t>(numberOfIds), 0);
  const SliceCounter counter(dims, ids, background);
  monitor.Step(0.0, "Counting voxels");
  const auto found = ParallelCollect<std::pair<Key, Index>>(
    dims[2], [&](Index k, std::vector<std::pair<Key, Index>>& part) { part = counter.Count(int(k)); });
  std::map<Key, Index> sums;
  for (const auto& [key, count] : found)
  {
    sums[key] += count;
  }
  for (const auto& [key, count] : sums)
  {
    const MaterialId a = MaterialId(key >> 16), b = MaterialId(key & 0xffff);
    if (a == b)
    {
      survey.Voxels[a] = count;
    }
    else
    {
      survey.Contacts.push_back({ { a, b }, count });
    }
  }
  monitor.Step(1.0);
  return survey;
}
}
