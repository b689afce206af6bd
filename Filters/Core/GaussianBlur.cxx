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

RowRange Joined(const RowRange& a, const RowRange& b)
{
  return a.Empty() ? b : b.Empty() ? a : RowRange{ std::min(a.First, b.First), std::max(a.Last, b.Last) };
}
}

GaussianBlur::GaussianBlur(const Lattice& frame, double sigma, std::vector<RowRange> rows)
  : Dims(frame.Dims)
  , Rows(std::move(rows))
{
  for (int a = 0; a < 3; ++a)
  {
    this->Kernels[a] = Kernel(sigma / frame.Spacing[a]);
  }
  const Index nx = this->Dims[0], ny = this->Dims[1], nz = this->Dims[2];
  const Index reachX = Index(this->Kernels[0].size()) / 2, reachY = Index(this->Kernels[1].size()) / 2;
  this->AfterX = this->Rows;
  for (RowRange& range : this->AfterX)
  {
    range =
      range.Empty() ? range : RowRange{ std::max<Index>(0, range.First - reachX), std::min(nx, range.Last + reachX) };
  }
  this->AfterY.resize(this->AfterX.size());
  for (Index k = 0; k < nz; ++k)
  {
    for (Index j = 0; j < ny; ++j)
    {
      for (Index n = std::max<Index>(0, j - reachY); n <= std::min(ny - 1, j + reachY); ++n)
      {
        this->AfterY[j + ny * k] = Joined(this->AfterY[j + ny * k], this->AfterX[n + ny * k]);
      }
    }
  }
}

void GaussianBlur::Clear(std::vector<float>& field) const
{
  const Index nx = this->Dims[0];
  field.resize(nx * Index(this->Rows.size()));
  ParallelFor(0, Index(this->Rows.size()), 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const RowRange& range = this->Rows[row];
        std::fill(
          field.begin() + row * nx + range.First, field.begin() + row * nx + std::max(range.First, range.Last), 0.0f);
      }
    });
}

void GaussianBlur::Apply(std::vector<float>& field) const
{
  const Index ny = this->Dims[1], nz = this->Dims[2];
  this->AlongX(field);
  this->Across(nz, ny, ny, 1, this->Kernels[1], this->AfterX, this->AfterY, field);
  this->Across(ny, 1, nz, ny, this->Kernels[2], this->AfterY, this->Rows, field);
}

void GaussianBlur::AlongX(std::vector<float>& field) const
{
  const std::vector<float>& kernel = this->Kernels[0];
  const Index nx = this->Dims[0], reach = Index(kernel.size()) / 2;
  ParallelFor(0, Index(this->Rows.size()), 0,
    [&](Index first, Index last)
    {
      std::vector<float> padded(nx + 4 * reach);
      for (Index row = first; row < last; ++row)
      {
        const RowRange &from = this->Rows[row], &to = this->AfterX[row];
        if (from.Empty())
        {
          continue;
        }
        float* const values = field.data() + row * nx;
        // padded[i + reach] is the value at to.First + i.
        std::fill(padded.begin(), padded.begin() + (to.Last - to.First) + 2 * reach, 0.0f);
        std::copy(values + from.First, values + from.Last, padded.begin() + reach + (from.First - to.First));
        std::fill(values + to.First, values + to.Last, 0.0f);
        for (Index n = 0; n < Index(kernel.size()); ++n)
        {
          const float weight = kernel[n];
          const float* const shifted = padded.data() + n;
          for (Index i = 0; i < to.Last - to.First; ++i)
          {
            values[to.First + i] += weight * shifted[i];
          }
        }
      }
    });
}

/// Sets of `count` rows, `rowStep` rows apart, set s starting at row s * setRows: each row becomes the weighted sum of
/// its neighbours in the set.
void GaussianBlur::Across(Index sets, Index setRows, Index count, Index rowStep, const std::vector<float>& kernel,
  const std::vector<RowRange>& from, const std::vector<RowRange>& to, std::vector<float>& field) const
{
  const Index nx = this->Dims[0], reach = Index(kernel.size()) / 2;
  ParallelFor(0, sets, 0,
    [&](Index first, Index last)
    {
      std::vector<float> copy(count * nx);
      for (Index set = first; set < last; ++set)
      {
        for (Index j = 0; j < count; ++j)
        {
          const Index row = set * setRows + j * rowStep;
          if (!from[row].Empty())
          {
            std::copy(field.data() + row * nx + from[row].First, field.data() + row * nx + from[row].Last,
              copy.data() + j * nx + from[row].First);
          }
        }
        for (Index j = 0; j < count; ++j)
        {
          const Index row = set * setRows + j * rowStep;
          const RowRange& wanted = to[row];
          if (wanted.Empty())
          {
            continue;
          }
          float* const values = field.data() + row * nx;
          std::fill(values + wanted.First, values + wanted.Last, 0.0f);
          for (Index n = std::max<Index>(0, j - reach); n <= std::min(count - 1, j + reach); ++n)
          {
            const RowRange& there = from[set * setRows + n * rowStep];
            const float weight = kernel[n - j + reach];
            const float* const source = copy.data() + n * nx;
            for (Index i = std::max(wanted.First, there.First); i < std::min(wanted.Last, there.Last); ++i)
            {
              values[i] += weight * source[i];
            }
          }
        }
      }
    });
}
}
