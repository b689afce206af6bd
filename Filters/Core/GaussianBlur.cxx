// SPDX-License-Identifier: BSD-3-Clause
#include "GaussianBlur.h"

#include "Parallel.h"

namespace LabelMesh
{
namespace
{
std::vector<float> Kernel(double sigma)
{
  const int reach = std::max(1, int(std::ceil(3.0 * sigma)));
  std::vector<float> kernel(2 * reach + 1);
  double sum = 0.0;
  for (int n = -reach; n <= reach; ++n)
  {
    sum += std::exp(-0.5 * n * n / (sigma * sigma));
  }
  for (int n = -reach; n <= reach; ++n)
  {
    kernel[n + reach] = float(std::exp(-0.5 * n * n / (sigma * sigma)) / sum);
  }
  return kernel;
}

void BlurRows(const Lattice& frame, const std::vector<float>& kernel, std::vector<float>& field)
{
  const Index nx = frame.Dims[0], reach = Index(kernel.size()) / 2;
  ParallelFor(0, Index(frame.Dims[1]) * frame.Dims[2], 0,
    [&](Index first, Index last)
    {
      std::vector<float> padded(nx + 2 * reach, 0.0f);
      for (Index row = first; row < last; ++row)
      {
        float* const values = field.data() + row * nx;
        if (std::all_of(values, values + nx, [](float v) { return v == 0.0f; }))
        {
          continue;
        }
        std::copy(values, values + nx, padded.begin() + reach);
        std::fill(values, values + nx, 0.0f);
        for (Index n = 0; n < Index(kernel.size()); ++n)
        {
          const float weight = kernel[n];
          const float* const shifted = padded.data() + n;
          for (Index i = 0; i < nx; ++i)
          {
            values[i] += weight * shifted[i];
          }
        }
      }
    });
}

/// Along y or z: `lines` independent sets of `count` rows of `width` values, `stride` apart.
void BlurAcross(Index sets, Index setStride, Index count, Index stride, Index width, const std::vector<float>& kernel,
  std::vector<float>& field)
{
  const Index reach = Index(kernel.size()) / 2;
  ParallelFor(0, sets, 0,
    [&](Index first, Index last)
    {
      std::vector<float> copy(count * width);
      std::vector<char> filled(count);
      for (Index set = first; set < last; ++set)
      {
        float* const base = field.data() + set * setStride;
        for (Index j = 0; j < count; ++j)
        {
          const float* const row = base + j * stride;
          filled[j] = std::any_of(row, row + width, [](float v) { return v != 0.0f; });
          if (filled[j])
          {
            std::copy(row, row + width, copy.begin() + j * width);
          }
        }
        for (Index j = 0; j < count; ++j)
        {
          float* const row = base + j * stride;
          if (filled[j])
          {
            std::fill(row, row + width, 0.0f);
          }
          for (Index n = std::max<Index>(0, j - reach); n <= std::min(count - 1, j + reach); ++n)
          {
            if (filled[n])
            {
              const float weight = kernel[n - j + reach];
              const float* const from = copy.data() + n * width;
              for (Index i = 0; i < width; ++i)
              {
                row[i] += weight * from[i];
              }
            }
          }
        }
      }
    });
}
}

void GaussianBlur(const Lattice& frame, double sigma, std::vector<float>& field)
{
  const Index nx = frame.Dims[0], ny = frame.Dims[1], nz = frame.Dims[2];
  BlurRows(frame, Kernel(sigma / frame.Spacing[0]), field);
  BlurAcross(nz, nx * ny, ny, nx, nx, Kernel(sigma / frame.Spacing[1]), field);
  // Rows of one y through all z.
  BlurAcross(ny, nx, nz, nx * ny, nx, Kernel(sigma / frame.Spacing[2]), field);
}
}
