// SPDX-License-Identifier: BSD-3-Clause
#include "DelicateParts.h"

#include "Parallel.h"
#include "VoxelObjects.h"

#include <algorithm>
#include <array>

namespace LabelMesh
{
namespace
{
constexpr Index EnoughVoxels = 300;  // of a component
constexpr double AskingShare = 0.05; // of a label's voxels

/// Whether a voxel is in no cube of 2 x 2 x 2 voxels of its label.
bool IsThin(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, const std::array<int, 3>& at, bool continued)
{
  const std::array<Index, 3> step{ 1, dims[0], Index(dims[0]) * dims[1] };
  const Index here = at[0] + step[1] * at[1] + step[2] * at[2];
  std::array<std::array<Index, 2>, 3> beside; // steps to the voxels before and after; 0 where the label goes on outside
  std::array<std::array<bool, 2>, 3> open;    // outside, and nothing goes on there
  for (int a = 0; a < 3; ++a)
  {
    const std::array<bool, 2> outside{ at[a] == 0, at[a] + 1 == dims[a] };
    beside[a] = { outside[0] ? 0 : -step[a], outside[1] ? 0 : step[a] };
    open[a] = { outside[0] && !continued, outside[1] && !continued };
  }
  for (int octant = 0; octant < 8; ++octant)
  {
    const std::array<int, 3> side{ octant & 1, octant >> 1 & 1, octant >> 2 };
    bool whole = !open[0][side[0]] && !open[1][side[1]] && !open[2][side[2]];
    for (int corner = 1; whole && corner < 8; ++corner)
    {
      const Index there = here + (corner & 1 ? beside[0][side[0]] : 0) + (corner & 2 ? beside[1][side[1]] : 0) +
        (corner & 4 ? beside[2][side[2]] : 0);
      whole = ids[there] == ids[here];
    }
    if (whole)
    {
      return false;
    }
  }
  return true;
}

std::vector<std::uint8_t> ThinVoxels(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background, bool continued)
{
  std::vector<std::uint8_t> thin(ids.size(), 0);
  ParallelFor(0, Index(dims[1]) * dims[2], 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const int j = int(row % dims[1]), k = int(row / dims[1]);
        for (int i = 0; i < dims[0]; ++i)
        {
          const Index at = row * dims[0] + i;
          thin[at] = ids[at] != background && IsThin(dims, ids, { i, j, k }, continued);
        }
      }
    });
  return thin;
}

/// The least number of samples per voxel that gives a component enough of them.
int FactorOf(Index voxels, int limit)
{
  int factor = 1;
  while (factor < limit && voxels * factor * factor * factor < EnoughVoxels)
  {
    ++factor;
  }
  return factor;
}
}

DelicateParts FindDelicateParts(const std::array<int, 3>& dims, const std::vector<MaterialId>& ids,
  MaterialId background, int numberOfIds, bool continued, int limit)
{
  DelicateParts found;
  if (limit < 2)
  {
    return found;
  }
  const VoxelObjects objects = FindVoxelParts(dims, ids, background, numberOfIds);
  found.Delicate = ThinVoxels(dims, ids, background, continued);
  std::vector<DelicateLabel> labels(static_cast<std::size_t>(numberOfIds));
  std::vector<std::vector<Index>> asking(labels.size(), std::vector<Index>(static_cast<std::size_t>(limit) + 1, 0));
  for (const VoxelRun& run : objects.Runs)
  {
    const VoxelPart& part = objects.Parts[run.Part];
    if (part.Id == background)
    {
      continue;
    }
    const int factor = FactorOf(part.Voxels, limit);
    const Index thin = std::count(found.Delicate.begin() + run.First, found.Delicate.begin() + run.Last, 1);
    DelicateLabel& label = labels[part.Id];
    label.Voxels += run.Last - run.First;
    label.ThinVoxels += thin;
    if (factor > 1)
    {
      label.SmallVoxels += run.Last - run.First;
      asking[part.Id][factor] += run.Last - run.First;
      std::fill(found.Delicate.begin() + run.First, found.Delicate.begin() + run.Last, std::uint8_t(1));
    }
    else
    {
      asking[part.Id][2] += thin;
    }
  }
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    Index ask = 0; // for this factor or a larger one
    for (int factor = limit; factor > 1 && labels[id].Factor == 1; --factor)
    {
      ask += asking[id][factor];
      labels[id].Factor = double(ask) > AskingShare * double(labels[id].Voxels) ? factor : 1;
    }
    if (labels[id].Factor > 1)
    {
      labels[id].Id = MaterialId(id);
      found.Labels.push_back(labels[id]);
      found.Factor = std::max(found.Factor, labels[id].Factor);
    }
  }
  if (found.Factor == 1)
  {
    found.Delicate.clear();
  }
  return found;
}
}
