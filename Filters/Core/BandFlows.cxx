// SPDX-License-Identifier: BSD-3-Clause
#include "BandFlows.h"

#include "VectorLoops.h"

namespace LabelMesh
{
CurvatureStencil::CurvatureStencil(const Lattice& frame, float step)
  : Y(frame.Dims[0])
  , Z(Index(frame.Dims[0]) * frame.Dims[1])
  , Step(step)
{
  const Vec3 h = frame.Spacing;
  for (int a = 0; a < 3; ++a)
  {
    const int b = (a + 1) % 3;
    this->First[a] = float(0.5 / h[a]);
    this->Second[a] = float(1 / (h[a] * h[a]));
    this->Mixed[a] = float(0.25 / (h[a] * h[b]));
  }
}

CrossingStencil::CrossingStencil(const Lattice& frame)
  : Y(frame.Dims[0])
  , Z(Index(frame.Dims[0]) * frame.Dims[1])
{
  for (int a = 0; a < 3; ++a)
  {
    this->Inverse[a] = float(1 / frame.Spacing[a]);
  }
}

void Mortar::Add(const BandLayout::Run& run, const float* lower, const float* upper)
{
  for (int i = 0; i < run.Count;)
  {
    const int first = i;
    while (i < run.Count && lower[i] < upper[i])
    {
      ++i;
    }
    if (i > first)
    {
      this->Runs.push_back({ run.First + first, i - first, 0 });
      this->Lower.insert(this->Lower.end(), lower + first, lower + i);
      this->Upper.insert(this->Upper.end(), upper + first, upper + i);
    }
    while (i < run.Count && !(lower[i] < upper[i]))
    {
      ++i;
    }
  }
}

namespace
{
/// next = clamp(phi, phi + Step curvature |grad phi|, sample).
/// curvature |grad phi| = ((|grad|^2 I - grad grad^T) : Hessian) / |grad|^2. Where the gradient vanishes, on the
/// ridges of thin parts, it is taken to have the direction of the strongest second difference: a plate stays, a speck
/// shrinks.
template <typename Clamp>
[[gnu::always_inline]] inline void CurvatureFlow(const CurvatureStencil& stencil, const float* __restrict phi,
  float* __restrict next, const BandLayout::Run* runs, Index count, Clamp&& clamp)
{
  const Index y = stencil.Y, z = stencil.Z;
  const float fx = stencil.First[0], fy = stencil.First[1], fz = stencil.First[2];
  const float sx = stencil.Second[0], sy = stencil.Second[1], sz = stencil.Second[2];
  const float mxy = stencil.Mixed[0], myz = stencil.Mixed[1], mzx = stencil.Mixed[2], step = stencil.Step;
  constexpr float tiny = 1e-4f; // against |grad|^2 = 1
  Index packed = 0;
  for (Index r = 0; r < count; packed += runs[r].Count, ++r)
  {
    const float* const row = phi + runs[r].First;
    float* const to = next + runs[r].First;
    ForLanes(runs[r].Count,
      [&](auto lanes, Index i)
      {
#pragma omp simd
        for (int l = 0; l < decltype(lanes)::Size; ++l)
        {
          const float* p = row + i + l;
          const float gx = (p[1] - p[-1]) * fx, gy = (p[y] - p[-y]) * fy, gz = (p[z] - p[-z]) * fz;
          const float xx = (p[1] + p[-1] - 2 * p[0]) * sx;
          const float yy = (p[y] + p[-y] - 2 * p[0]) * sy;
          const float zz = (p[z] + p[-z] - 2 * p[0]) * sz;
          const float xy = ((p[1 + y] + p[-1 - y]) - (p[1 - y] + p[-1 + y])) * mxy;
          const float yz = ((p[y + z] + p[-y - z]) - (p[y - z] + p[-y + z])) * myz;
          const float zx = ((p[1 + z] + p[-1 - z]) - (p[1 - z] + p[-1 + z])) * mzx;
          const float gx2 = gx * gx, gy2 = gy * gy, gz2 = gz * gz;
          const float ax = std::abs(xx), ay = std::abs(yy), az = std::abs(zz);
          const float axy = ax > ay ? ax : ay, sxy = ax > ay ? xx : yy;
          const float strongest = axy > az ? sxy : zz;
          const float flow = (xx * (gy2 + gz2) + yy * (gx2 + gz2) + zz * (gx2 + gy2) -
                               2 * (gx * gy * xy + gy * gz * yz + gz * gx * zx) + tiny * (xx + yy + zz - strongest)) /
            (gx2 + gy2 + gz2 + tiny);
          to[i + l] = clamp(p[0], p[0] + step * flow, packed + i + l);
        }
      });
  }
}
}

LABELMESH_FOR_ANY_X86
void FlowKeepingSides(
  const CurvatureStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs, Index count, float least)
{
  CurvatureFlow(stencil, phi, next, runs, count,
    [least](float before, float after, Index)
    {
      const float inside = after > least ? after : least, outside = after < -least ? after : -least;
      return before > 0 ? inside : outside;
    });
}

LABELMESH_FOR_ANY_X86
void FlowTowards(const CurvatureStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs,
  Index count, const float* sides, float push, float least)
{
  CurvatureFlow(stencil, phi, next, runs, count,
    [sides, push, least](float, float after, Index at)
    {
      const float s = sides[at] > 0 ? 1.0f : -1.0f;
      const float own = s * after;
      const float pushed = own + push < least ? own + push : least;
      return own < least ? s * pushed : after;
    });
}

LABELMESH_FOR_ANY_X86
void FlowBetween(const CurvatureStencil& stencil, const float* phi, float* next, const Mortar& mortar)
{
  const float* const low = mortar.Lower.data();
  const float* const high = mortar.Upper.data();
  CurvatureFlow(stencil, phi, next, mortar.Runs.data(), Index(mortar.Runs.size()),
    [low, high](float, float after, Index at)
    {
      const float raised = after > low[at] ? after : low[at];
      return raised < high[at] ? raised : high[at];
    });
}

LABELMESH_FOR_ANY_X86
void FlowUpwind(const CrossingStencil& stencil, const float* __restrict phi, float* __restrict next,
  const BandLayout::Run* runs, Index count, const float* __restrict signs, float step)
{
  const Index y = stencil.Y, z = stencil.Z;
  const float ix = stencil.Inverse[0], iy = stencil.Inverse[1], iz = stencil.Inverse[2];
  for (Index r = 0; r < count; signs += runs[r].Count, ++r)
  {
    const float* const row = phi + runs[r].First;
    float* const to = next + runs[r].First;
    ForLanes(runs[r].Count,
      [&](auto lanes, Index i)
      {
#pragma omp simd
        for (int l = 0; l < decltype(lanes)::Size; ++l)
        {
          const float* p = row + i + l;
          const float s = signs[i + l];
          // How far the sample is above its lower neighbour, as seen from the zero set.
          const auto rise = [&](Index axis, float scale)
          {
            const float a = s * (p[0] - p[-axis]), b = s * (p[0] - p[axis]);
            const float larger = a > b ? a : b;
            return (larger > 0 ? larger : 0.0f) * scale;
          };
          const float gx = rise(1, ix), gy = rise(y, iy), gz = rise(z, iz);
          to[i + l] = p[0] + step * s * (1.0f - std::sqrt(gx * gx + gy * gy + gz * gz));
        }
      });
  }
}

LABELMESH_FOR_ANY_X86
void FindCrossedCells(const float* __restrict row, Index count, Index y, Index z, std::int32_t* __restrict crossed)
{
  ForLanes(count,
    [&](auto lanes, Index i)
    {
#pragma omp simd
      for (int l = 0; l < decltype(lanes)::Size; ++l)
      {
        const float* p = row + i + l;
        const int side = p[0] > 0;
        crossed[i + l] = ((p[1] > 0) ^ side) | ((p[y] > 0) ^ side) | ((p[y + 1] > 0) ^ side) | ((p[z] > 0) ^ side) |
          ((p[z + 1] > 0) ^ side) | ((p[z + y] > 0) ^ side) | ((p[z + y + 1] > 0) ^ side);
      }
    });
}

LABELMESH_FOR_ANY_X86
void FindBeside(const float* __restrict row, Index count, Index y, Index z, std::int32_t* __restrict beside)
{
  ForLanes(count,
    [&](auto lanes, Index i)
    {
#pragma omp simd
      for (int l = 0; l < decltype(lanes)::Size; ++l)
      {
        const float* p = row + i + l;
        const int side = p[0] > 0;
        beside[i + l] = ((p[1] > 0) ^ side) | ((p[-1] > 0) ^ side) | ((p[y] > 0) ^ side) | ((p[-y] > 0) ^ side) |
          ((p[z] > 0) ^ side) | ((p[-z] > 0) ^ side);
      }
    });
}

LABELMESH_FOR_ANY_X86
void PlaceBeside(const CrossingStencil& stencil, const float* __restrict phi, float* __restrict next,
  const BandLayout::Run* runs, Index count, float* __restrict signs)
{
  const Index y = stencil.Y, z = stencil.Z;
  const float ix = stencil.Inverse[0], iy = stencil.Inverse[1], iz = stencil.Inverse[2];
  for (Index r = 0; r < count; signs += runs[r].Count, ++r)
  {
    const float* const row = phi + runs[r].First;
    float* const to = next + runs[r].First;
    ForLanes(runs[r].Count,
      [&](auto lanes, Index i)
      {
#pragma omp simd
        for (int l = 0; l < decltype(lanes)::Size; ++l)
        {
          // ZeroCrossing::Slopes without branches; sides and crossings are 0 or 1.
          const float* p = row + i + l;
          const float side = p[0] > 0 ? 1.0f : 0.0f;
          float beside = 0.0f;
          const auto slope = [&](Index axis, float scale)
          {
            const float before = p[-axis], after = p[axis];
            const float first = std::abs((before > 0 ? 1.0f : 0.0f) - side),
                        second = std::abs((after > 0 ? 1.0f : 0.0f) - side);
            const float back = p[0] - before, ahead = after - p[0];
            const float steeper = std::abs(back) > std::abs(ahead) ? back : ahead;
            const float crossing = first > 0 ? (second > 0 ? steeper : back) : ahead;
            beside += first + second;
            return (first + second > 0 ? crossing : 0.5f * (after - before)) * scale;
          };
          const float gx = slope(1, ix), gy = slope(y, iy), gz = slope(z, iz);
          const float slope2 = gx * gx + gy * gy + gz * gz;
          const float placed = p[0] / std::sqrt(slope2 > 0 ? slope2 : 1.0f);
          to[i + l] = beside > 0 ? placed : p[0];
          signs[i + l] = beside > 0 ? 0.0f : side + side - 1.0f;
        }
      });
  }
}
}
