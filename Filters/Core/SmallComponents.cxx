// SPDX-License-Identifier: BSD-3-Clause
#include "SmallComponents.h"

#include "VoxelObjects.h"

#include <algorithm>
#include <map>

namespace LabelMesh
{
namespace
{
/// Faces between components; those of the space outside belong to part 0.
using Faces = std::vector<std::map<Index, Index>>;

Faces FacesOfSmall(const std::array<int, 3>& dims, const VoxelObjects& objects, const std::vector<std::uint8_t>& small)
{
  std::vector<Index> partOf(static_cast<std::size_t>(Index(dims[0]) * dims[1] * dims[2]));
  for (const VoxelRun& run : objects.Runs)
  {
    std::fill(partOf.begin() + run.First, partOf.begin() + run.Last, run.Part);
  }
  const std::array<Index, 3> step{ 1, dims[0], Index(dims[0]) * dims[1] };
  Faces faces(objects.Parts.size());
  for (const VoxelRun& run : objects.Runs)
  {
    for (Index v = run.First; small[run.Part] && v < run.Last; ++v)
    {
      const std::array<Index, 3> at{ v % dims[0], v / step[1] % dims[1], v / step[2] };
      for (int a = 0; a < 3; ++a)
      {
        const Index before = at[a] > 0 ? partOf[v - step[a]] : 0, after = at[a] + 1 < dims[a] ? partOf[v + step[a]] : 0;
        for (const Index beside : { before, after })
        {
          if (beside != run.Part)
          {
            ++faces[run.Part][beside];
          }
        }
      }
    }
  }
  return faces;
}
}

std::vector<DroppedComponent> DropSmallComponents(
  const std::array<int, 3>& dims, std::vector<MaterialId>& ids, MaterialId background, int numberOfIds, Index least)
{
  const VoxelObjects objects = FindVoxelParts(dims, ids, background, numberOfIds);
  std::vector<std::uint8_t> small;
  std::vector<MaterialId> owner; // of each component in the end; none yet for small ones
  std::vector<Index> waiting;
  for (const VoxelPart& part : objects.Parts)
  {
    small.push_back(part.Id != background && part.Voxels < least ? 1 : 0);
    owner.push_back(small.back() ? NoMaterial : part.Id);
    if (small.back())
    {
      waiting.push_back(Index(small.size()) - 1);
    }
  }
  if (waiting.empty())
  {
    return {};
  }
  const Faces faces = FacesOfSmall(dims, objects, small);
  while (!waiting.empty())
  {
    std::vector<std::pair<Index, MaterialId>> given; // all by what was there before this round
    for (const Index p : waiting)
    {
      std::map<MaterialId, Index> shared;
      for (const auto& [beside, count] : faces[p])
      {
        if (owner[beside] != NoMaterial)
        {
          shared[owner[beside]] += count;
        }
      }
      const auto most = std::max_element(
        shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
      if (most != shared.end())
      {
        given.emplace_back(p, most->first);
      }
    }
    for (const auto& [p, id] : given)
    {
      owner[p] = id;
    }
    waiting.erase(
      std::remove_if(waiting.begin(), waiting.end(), [&](Index p) { return owner[p] != NoMaterial; }), waiting.end());
  }
  std::vector<DroppedComponent> dropped;
  for (std::size_t p = 0; p < small.size(); ++p)
  {
    if (small[p])
    {
      dropped.push_back({ objects.Parts[p].Id, owner[p], objects.Parts[p].Voxels, objects.Parts[p].First });
    }
  }
  for (const VoxelRun& run : objects.Runs)
  {
    std::fill(ids.begin() + run.First, ids.begin() + run.Last, owner[run.Part]);
  }
  return dropped;
}
}
