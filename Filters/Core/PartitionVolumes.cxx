// SPDX-License-Identifier: BSD-3-Clause
#include "PartitionVolumes.h"

#include "Parallel.h"
#include "Particles.h"

namespace LabelMesh
{
namespace
{
constexpr int Parts = 4; // of a cell's edge

/// A cell of the working lattice whose corners differ, and its share of a material.
struct Share
{
  MaterialId Material;
  float Volume; // of the cell
};

void CutCell(const IndicatorSet& indicators, const std::array<Vec3, 8>& corners, const MaterialSet& materials,
  std::vector<Share>& shares)
{
  std::array<std::array<double, 8>, MaterialSet::Capacity> values;
  std::array<int, MaterialSet::Capacity> counts{};
  for (int m = 0; m < materials.Size(); ++m)
  {
    for (int c = 0; c < 8; ++c)
    {
      values[m][c] = indicators.Value(materials[m], corners[c]);
    }
  }
  for (int part = 0; part < Parts * Parts * Parts; ++part)
  {
    const double u = (part % Parts + 0.5) / Parts, v = (part / Parts % Parts + 0.5) / Parts,
                 w = (part / (Parts * Parts) + 0.5) / Parts;
    int best = 0;
    double largest = -1e300;
    for (int m = 0; m < materials.Size(); ++m)
    {
      const auto& f = values[m];
      const double low = (1 - v) * ((1 - u) * f[0] + u * f[1]) + v * ((1 - u) * f[2] + u * f[3]);
      const double high = (1 - v) * ((1 - u) * f[4] + u * f[5]) + v * ((1 - u) * f[6] + u * f[7]);
      const double value = (1 - w) * low + w * high;
      if (value > largest)
      {
        largest = value;
        best = m;
      }
    }
    ++counts[best];
  }
  for (int m = 0; m < materials.Size(); ++m)
  {
    shares.push_back({ materials[m], float(counts[m]) / float(Parts * Parts * Parts) });
  }
}
}

std::vector<double> PartitionVolumes(const IndicatorSet& indicators)
{
  const Lattice& frame = indicators.Working();
  const MaterialId* labels = indicators.Labels().data();
  // Cells whose corners agree are counted by layer, the others give shares.
  const Index layers = std::max(frame.Dims[2] - 1, 0);
  const std::size_t count = std::size_t(indicators.NumberOfMaterials());
  const std::vector<Share> shares = ParallelCollect<Share>(layers,
    [&](Index k, std::vector<Share>& found)
    {
      std::vector<Index> whole(count, 0);
      for (Index j = 0; j + 1 < frame.Dims[1]; ++j)
      {
        for (Index i = 0; i + 1 < frame.Dims[0]; ++i)
        {
          MaterialSet materials;
          std::array<Vec3, 8> corners;
          const MaterialId first = labels[frame.At(i, j, k)];
          bool same = true;
          for (int c = 0; c < 8; ++c)
          {
            same = same && labels[frame.At(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2))] == first;
          }
          if (same)
          {
            ++whole[first];
            continue;
          }
          for (int c = 0; c < 8; ++c)
          {
            const int x = int(i) + (c & 1), y = int(j) + ((c >> 1) & 1), z = int(k) + (c >> 2);
            materials.Insert(labels[frame.At(x, y, z)]);
            corners[c] = frame.Position(x, y, z);
          }
          CutCell(indicators, corners, materials, found);
        }
      }
      for (std::size_t m = 0; m < count; ++m)
      {
        if (whole[m] > 0)
        {
          found.push_back({ MaterialId(m), float(whole[m]) });
        }
      }
    });
  std::vector<double> volumes(count, 0.0);
  for (const Share& share : shares)
  {
    volumes[share.Material] += double(share.Volume) * frame.VoxelVolume();
  }
  return volumes;
}
}
