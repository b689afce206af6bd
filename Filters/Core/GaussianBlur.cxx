// SPDX-License-Identifier: BSD-3-Clause
//
// Each pass writes just what the next one reads: along x all rows that the pass along y looks at, and so on. Then inner
// loops need no look at what is there and what is not.
#include "GaussianBlur.h"

#include "Parallel.h"
#include "VectorLoops.h"

namespace LabelMesh
{
namespace
{
constexpr Index RowsAtOnce = 16;

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

std::array<std::vector<float>, 3> KernelsOf(const Lattice& frame, double sigma)
{
  return { Kernel(sigma / frame.Spacing[0]), Kernel(sigma / frame.Spacing[1]), Kernel(sigma / frame.Spacing[2]) };
}

/// The samples that lie up to half a kernel from the set along an axis.
BitLattice ReadAlong(const BitLattice& set, int axis, const std::vector<float>& kernel)
{
  std::array<int, 3> reach{ 0, 0, 0 };
  reach[axis] = int(kernel.size()) / 2;
  return Dilated(set, BoxOffsets(reach));
}

/// to[i] = sum over n of weights[n] from[i + n step].
LABELMESH_FOR_ANY_X86
void SumWeighted(const float* __restrict from, Index step, const float* __restrict weights, Index taps,
  float* __restrict to, Index count)
{
  ForLanes(count,
    [&](auto lanes, Index i)
    {
      typename decltype(lanes)::Vector sum{}, values;
      const float* row = from + i;
      for (Index n = 0; n < taps; ++n, row += step)
      {
        Load(row, values);
        sum += weights[n] * values;
      }
      Store(sum, to + i);
    });
}

/// The part of a kernel around position `at` of `size` that lies within.
struct Clipped
{
  Clipped(const std::vector<float>& kernel, Index at, Index size)
    : First(std::max<Index>(0, at - Index(kernel.size()) / 2))
    , Taps(std::min(size, at + Index(kernel.size()) / 2 + 1) - this->First)
    , Weights(kernel.data() + (this->First - at + Index(kernel.size()) / 2))
  {
  }
  Index First, Taps;
  const float* Weights;
};
}

GaussianBlur::RowSpans::RowSpans(const BitLattice& bits)
{
  const Index rows = Index(bits.Dimensions()[1]) * bits.Dimensions()[2];
  this->Starts.reserve(static_cast<std::size_t>(rows + 1));
  for (Index row = 0; row < rows; ++row)
  {
    this->Starts.push_back(std::uint32_t(this->Spans.size()));
    FindSpans(bits.Row(row, 0), bits.WordsPerRow(), this->Spans);
  }
  this->Starts.push_back(std::uint32_t(this->Spans.size()));
  this->Spans.shrink_to_fit();
}

GaussianBlur::GaussianBlur(const BandLayout& layout, double sigma)
  : Kernels(KernelsOf(layout.Frame(), sigma))
  , AfterX(ReadAlong(ReadAlong(layout.ActiveBits(), 2, this->Kernels[2]), 1, this->Kernels[1]))
  , AfterY(ReadAlong(layout.ActiveBits(), 2, this->Kernels[2]))
{
}

void GaussianBlur::Apply(const BandLayout& layout, float* values, float* box) const
{
  const auto& dims = layout.Frame().Dims;
  ParallelFor(0, dims[2], 0,
    [&](Index firstSlice, Index lastSlice)
    {
      std::vector<float> slice(static_cast<std::size_t>(Index(dims[0]) * dims[1])); // stays in the cache
      std::vector<float> padded(static_cast<std::size_t>(dims[0]) + this->Kernels[0].size(), 0.0f);
      for (Index k = firstSlice; k < lastSlice; ++k)
      {
        this->AlongX(layout, values, k, padded, slice.data());
        this->AlongY(layout, slice.data(), k, box);
      }
    });
  this->AlongZ(layout, box, values);
}

/// Into one slice. `padded` has a row of zeros, and half a kernel of them on either side.
void GaussianBlur::AlongX(
  const BandLayout& layout, const float* values, Index k, std::vector<float>& padded, float* slice) const
{
  const std::vector<float>& kernel = this->Kernels[0];
  const Index nx = layout.Frame().Dims[0], ny = layout.Frame().Dims[1], reach = Index(kernel.size()) / 2;
  const BandLayout::Run* run = layout.Runs().data() + layout.Slice(k).Run;
  const BandLayout::Run* const end = layout.Runs().data() + layout.Slice(k + 1).Run;
  if (run == end)
  {
    return;
  }
  const float* const packed = values + layout.Slice(k).Packed;
  for (Index j = 0; j < ny; ++j)
  {
    const Index row = j + ny * k;
    const BandLayout::Run* const first = run;
    for (; run < end && run->First < (row + 1) * nx; ++run)
    {
      std::copy_n(packed + run->Packed, run->Count, padded.data() + (run->First - row * nx) + reach);
    }
    for (std::uint32_t s = this->AfterX.Starts[row]; s < this->AfterX.Starts[row + 1]; ++s)
    {
      const Span& span = this->AfterX.Spans[s];
      float* const target = slice + j * nx + span.First;
      if (first == run)
      {
        std::fill_n(target, span.Last - span.First, 0.0f);
      }
      else
      {
        SumWeighted(padded.data() + span.First, 1, kernel.data(), Index(kernel.size()), target, span.Last - span.First);
      }
    }
    for (const BandLayout::Run* r = first; r < run; ++r)
    {
      std::fill_n(padded.data() + (r->First - row * nx) + reach, r->Count, 0.0f);
    }
  }
}

/// From that slice.
void GaussianBlur::AlongY(const BandLayout& layout, const float* slice, Index k, float* box) const
{
  const Index nx = layout.Frame().Dims[0], ny = layout.Frame().Dims[1];
  const bool empty = layout.Slice(k).Run == layout.Slice(k + 1).Run;
  for (Index j = 0; j < ny; ++j)
  {
    const Clipped part(this->Kernels[1], j, ny);
    const Index row = j + ny * k;
    for (std::uint32_t s = this->AfterY.Starts[row]; s < this->AfterY.Starts[row + 1]; ++s)
    {
      const Span& span = this->AfterY.Spans[s];
      float* const target = box + row * nx + span.First;
      if (empty)
      {
        std::fill_n(target, span.Last - span.First, 0.0f);
      }
      else
      {
        SumWeighted(slice + part.First * nx + span.First, nx, part.Weights, part.Taps, target, span.Last - span.First);
      }
    }
  }
}

void GaussianBlur::AlongZ(const BandLayout& layout, const float* box, float* values) const
{
  // A few rows of all slices, which stay in the cache.
  const auto& dims = layout.Frame().Dims;
  const Index slice = Index(dims[0]) * dims[1], ny = dims[1], nz = dims[2];
  ParallelFor(0, (ny + RowsAtOnce - 1) / RowsAtOnce, 0,
    [&](Index firstRows, Index lastRows)
    {
      for (Index j = firstRows * RowsAtOnce; j < std::min(ny, lastRows * RowsAtOnce); j += RowsAtOnce)
      {
        const Index rows = std::min(RowsAtOnce, ny - j);
        for (Index k = 0; k < nz; ++k)
        {
          const Clipped part(this->Kernels[2], k, nz);
          float* const to = values + layout.Slice(k).Packed;
          const BandLayout::Run* const end = layout.Runs().data() + layout.Slice(k + 1).Run;
          const Index beyond = layout.Frame().At(0, j + rows, k);
          for (const BandLayout::Run* run = layout.RowBegin(j, k); run < end && run->First < beyond; ++run)
          {
            SumWeighted(box + run->First + (part.First - k) * slice, slice, part.Weights, part.Taps, to + run->Packed,
              run->Count);
          }
        }
      }
    });
}
}
