// SPDX-License-Identifier: BSD-3-Clause
#include "NarrowBand.h"

#include "Parallel.h"
#include "ZeroCrossing.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr Index ChunkSize = 8192; // active samples in a piece of work: a few dozen microseconds

/// Steps and step length for a flow over `time` that must not exceed `longest`.
struct TimeSteps
{
  TimeSteps(double time, double longest)
    : Count(int(std::ceil(time / longest - 1e-6)))
    , Length(this->Count > 0 ? float(time / this->Count) : 0.0f)
  {
  }
  int Count;
  float Length;
};

/// The longest stable step of the curvature flow: explicit diffusion is stable up to 1 / (2 sum 1/h^2) in all
/// directions, and the flow has none along the normal.
double LongestStep(const Lattice& frame)
{
  return 0.6 / frame.Spacing.cwiseAbs2().cwiseInverse().sum();
}

/// The second-order differences of a function times their denominators.
struct CurvatureStencil
{
  CurvatureStencil(const Lattice& frame, float step)
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

  /// to = phi + Step curvature |grad phi|.
  /// curvature |grad phi| = ((|grad|^2 I - grad grad^T) : Hessian) / |grad|^2. Where the gradient vanishes, on the
  /// ridges of thin parts, it is taken to have the direction of the strongest second difference: a plate stays, a speck
  /// shrinks.
  template <typename Clamp>
  void Apply(const float* __restrict phi, float* __restrict to, Index count, Clamp&& clamp) const
  {
    const Index y = this->Y, z = this->Z;
    const float fx = this->First[0], fy = this->First[1], fz = this->First[2];
    const float sx = this->Second[0], sy = this->Second[1], sz = this->Second[2];
    const float mxy = this->Mixed[0], myz = this->Mixed[1], mzx = this->Mixed[2], step = this->Step;
    constexpr float tiny = 1e-4f; // against |grad|^2 = 1
    for (Index i = 0; i < count; ++i)
    {
      const float* p = phi + i;
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
      to[i] = clamp(p[0], p[0] + step * flow, i);
    }
  }

  Index Y, Z;
  float Step;
  float First[3], Second[3], Mixed[3];
};

/// One upwind step of phi_t = s (1 - |grad phi|), s = -1, 0 or 1 per sample (Godunov's flux).
void UpwindStep(const float* __restrict phi, float* __restrict to, const float* __restrict signs, Index count, Index y,
  Index z, const float* inverse, float step)
{
  const float ix = inverse[0], iy = inverse[1], iz = inverse[2];
  for (Index i = 0; i < count; ++i)
  {
    const float* p = phi + i;
    const float s = signs[i];
    // How far the sample is above its lower neighbour, as seen from the zero set.
    const auto rise = [&](Index axis, float scale)
    {
      const float a = s * (p[0] - p[-axis]), b = s * (p[0] - p[axis]);
      const float larger = a > b ? a : b;
      return (larger > 0 ? larger : 0.0f) * scale;
    };
    const float gx = rise(1, ix), gy = rise(y, iy), gz = rise(z, iz);
    to[i] = p[0] + step * s * (1.0f - std::sqrt(gx * gx + gy * gy + gz * gz));
  }
}

/// The share of a cell where the trilinear interpolant of its corners' distances (in voxels; x fastest) is positive:
/// 4^3 parts, each by its distance to a plane.
double VolumeInside(const std::array<float, 8>& phi, float spacing)
{
  constexpr int parts = 4;
  double volume = 0.0;
  for (int k = 0; k < parts; ++k)
  {
    const float w = (float(k) + 0.5f) / parts;
    for (int j = 0; j < parts; ++j)
    {
      const float v = (float(j) + 0.5f) / parts;
      const auto alongYZ = [&](int x)
      {
        const float low = phi[x] + v * (phi[x + 2] - phi[x]), high = phi[x + 4] + v * (phi[x + 6] - phi[x + 4]);
        return low + w * (high - low);
      };
      const float left = alongYZ(0), right = alongYZ(1);
      for (int i = 0; i < parts; ++i)
      {
        const float value = left + (float(i) + 0.5f) / parts * (right - left);
        volume += std::clamp(0.5f + parts * value / spacing, 0.0f, 1.0f);
      }
    }
  }
  return volume / (parts * parts * parts);
}

Lattice GrownInVoxels(const Lattice& frame, int margin)
{
  Lattice grown = frame;
  for (int& n : grown.Dims)
  {
    n += 2 * margin;
  }
  grown.Spacing /= frame.VoxelSize();
  return grown;
}
}

NarrowBand::NarrowBand(const Lattice& frame, const float* mask, double band)
  : Frame(GrownInVoxels(frame, Margin))
  , End(float(band))
{
  const Index nx = frame.Dims[0], ny = frame.Dims[1], nz = frame.Dims[2];
  Sides sides(static_cast<std::size_t>(this->Frame.Size()));
  std::vector<Index> inside(static_cast<std::size_t>(nz), 0);
  ParallelFor(-Margin, nz + Margin, 0,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        for (Index j = -Margin; j < ny + Margin; ++j)
        {
          const float* from = mask + frame.At(0, std::clamp<Index>(j, 0, ny - 1), std::clamp<Index>(k, 0, nz - 1));
          std::uint8_t* to = sides.data() + this->Frame.At(Margin, j + Margin, k + Margin);
          int sum = 0;
          for (Index i = 0; i < nx; ++i)
          {
            to[i] = from[i] > 0.5f;
            sum += to[i];
          }
          std::fill_n(to - Margin, Margin, to[0]);
          std::fill_n(to + nx, Margin, to[nx - 1]);
          if (j >= 0 && j < ny && k >= 0 && k < nz)
          {
            inside[k] += sum;
          }
        }
      }
    });
  this->Inside = std::accumulate(inside.begin(), inside.end(), Index(0));
  this->Phi.resize(sides.size());
  SignedDistance(this->Frame, sides, band, this->Phi.data());
  this->FindRuns();
  this->FindGhosts();
  this->Next = this->Phi;
}

void NarrowBand::FindRuns()
{
  const Index nx = this->Frame.Dims[0] - 2 * Margin, ny = this->Frame.Dims[1] - 2 * Margin,
              nz = this->Frame.Dims[2] - 2 * Margin;
  std::vector<std::vector<Run>> slices(static_cast<std::size_t>(nz));
  std::vector<Index> activeInside(static_cast<std::size_t>(nz), 0);
  ParallelFor(0, nz, 0,
    [&](Index firstSlice, Index lastSlice)
    {
      for (Index at = firstSlice * ny; at < lastSlice * ny; ++at)
      {
        const Index start = this->Frame.At(Margin, Margin + at % ny, Margin + at / ny);
        const float* row = this->Phi.data() + start;
        for (Index i = 0; i < nx;)
        {
          const Index first = i =
            std::find_if(row + i, row + nx, [&](float v) { return std::abs(v) < this->End; }) - row;
          i = std::find_if(row + i, row + nx, [&](float v) { return !(std::abs(v) < this->End); }) - row;
          if (i > first)
          {
            slices[at / ny].push_back({ start + first, 0, i - first });
            activeInside[at / ny] += std::count_if(row + first, row + i, [](float v) { return v > 0; });
          }
        }
      }
    });
  this->Deep = this->Inside - std::accumulate(activeInside.begin(), activeInside.end(), Index(0));
  Index inChunk = ChunkSize;
  for (const auto& slice : slices)
  {
    for (Run run : slice)
    {
      if (inChunk >= ChunkSize)
      {
        this->Chunks.push_back(Index(this->Runs.size()));
        inChunk = 0;
      }
      run.Packed = this->Active;
      this->Active += run.Count;
      inChunk += run.Count;
      this->Runs.push_back(run);
    }
  }
  this->Chunks.push_back(Index(this->Runs.size()));
}

void NarrowBand::FindGhosts()
{
  const auto& n = this->Frame.Dims;
  const auto add = [&](int i, int j, int k)
  {
    const Index to = this->Frame.At(i, j, k);
    const Index from = this->Frame.At(std::clamp(i, Margin, n[0] - 1 - Margin),
      std::clamp(j, Margin, n[1] - 1 - Margin), std::clamp(k, Margin, n[2] - 1 - Margin));
    if (std::abs(this->Phi[from]) < this->End)
    {
      this->Ghosts.push_back({ to, from });
    }
  };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      const bool wholeRow = k < Margin || k >= n[2] - Margin || j < Margin || j >= n[1] - Margin;
      for (int i = 0; i < n[0]; ++i)
      {
        if (!wholeRow && i == Margin)
        {
          i = n[0] - Margin;
        }
        add(i, j, k);
      }
    }
  }
  for (const Ghost& ghost : this->Ghosts)
  {
    this->Phi[ghost.To] = this->Phi[ghost.From];
  }
}

template <typename Clamp>
void NarrowBand::Smooth(double time, Clamp&& clamp)
{
  const TimeSteps steps(time, LongestStep(this->Frame));
  const CurvatureStencil stencil(this->Frame, steps.Length);
  for (int step = 0; step < steps.Count; ++step)
  {
    this->Advance(
      [&](const Run& run)
      {
        stencil.Apply(this->Phi.data() + run.First, this->Next.data() + run.First, run.Count,
          [&](float before, float after, Index i) { return clamp(before, after, run.Packed + i); });
      });
  }
}

void NarrowBand::SmoothKeepingSides(double time)
{
  const float least = float(0.05 * this->Frame.Spacing.minCoeff());
  this->Smooth(time,
    [least](float before, float after, Index)
    {
      const float inside = after > least ? after : least, outside = after < -least ? after : -least;
      return before > 0 ? inside : outside;
    });
}

void NarrowBand::SmoothTowards(double time, const std::vector<float>& sides, double force)
{
  constexpr float least = 0.05f; // voxels: so far the force pushes
  // Each step of the flow pushes for its own time.
  const float push = float(force * TimeSteps(time, LongestStep(this->Frame)).Length);
  const float* const side = sides.data();
  this->Smooth(time,
    [side, push](float, float after, Index at)
    {
      const float s = side[at] > 0 ? 1.0f : -1.0f;
      const float own = s * after;
      const float pushed = own + push < least ? own + push : least;
      return own < least ? s * pushed : after;
    });
}

void NarrowBand::SmoothBetween(double time, const std::vector<float>& lower, const std::vector<float>& upper)
{
  const float* const low = lower.data();
  const float* const high = upper.data();
  this->Smooth(time,
    [low, high](float, float after, Index at)
    {
      const float raised = after > low[at] ? after : low[at];
      return raised < high[at] ? raised : high[at];
    });
}

void NarrowBand::FindTargets()
{
  const ZeroCrossing crossing(this->Frame);
  this->Signs.resize(static_cast<std::size_t>(this->Active));
  this->Advance(
    [&](const Run& run)
    {
      for (Index i = 0; i < run.Count; ++i)
      {
        const float* p = this->Phi.data() + run.First + i;
        float slopes[3];
        const bool beside = crossing.Slopes(p, slopes);
        const float slope2 = slopes[0] * slopes[0] + slopes[1] * slopes[1] + slopes[2] * slopes[2];
        this->Next[run.First + i] = beside && slope2 > 0 ? p[0] / std::sqrt(slope2) : p[0];
        this->Signs[run.Packed + i] = beside ? 0.0f : p[0] > 0 ? 1.0f : -1.0f;
      }
    });
}

void NarrowBand::Redistance(double reach)
{
  const Vec3 inverse = this->Frame.Spacing.cwiseInverse();
  const float scales[3] = { float(inverse[0]), float(inverse[1]), float(inverse[2]) };
  const TimeSteps steps(reach, 1.5 / inverse.sum());
  const Index y = this->Frame.Dims[0], z = y * this->Frame.Dims[1];
  this->FindTargets();
  for (int step = 0; step < steps.Count; ++step)
  {
    this->Advance(
      [&](const Run& run)
      {
        UpwindStep(this->Phi.data() + run.First, this->Next.data() + run.First, this->Signs.data() + run.Packed,
          run.Count, y, z, scales, steps.Length);
      });
  }
}

void NarrowBand::Assign(const std::vector<float>& packed)
{
  this->Advance(
    [&](const Run& run) { std::copy_n(packed.data() + run.Packed, run.Count, this->Next.data() + run.First); });
}

std::vector<float> NarrowBand::Pack() const
{
  std::vector<float> packed(static_cast<std::size_t>(this->Active));
  this->ForRuns(
    [&](const Run& run) { std::copy_n(this->Phi.data() + run.First, run.Count, packed.data() + run.Packed); });
  return packed;
}

std::vector<RowRange> NarrowBand::ActiveRows() const
{
  const Index ny = this->Frame.Dims[1] - 2 * Margin, nz = this->Frame.Dims[2] - 2 * Margin;
  std::vector<RowRange> rows(static_cast<std::size_t>(ny * nz));
  for (const Run& run : this->Runs)
  {
    const std::array<int, 3> at = this->Frame.Coordinates(run.First);
    RowRange& row = rows[at[1] - Margin + ny * (at[2] - Margin)];
    const Index first = at[0] - Margin;
    row = row.Empty() ? RowRange{ first, first + run.Count } : RowRange{ row.First, first + run.Count };
  }
  return rows;
}

double NarrowBand::Volume() const
{
  const Index y = this->Frame.Dims[0], z = y * this->Frame.Dims[1];
  const Index corners[8] = { 0, 1, y, y + 1, z, z + 1, z + y, z + y + 1 };
  const float spacing = float(this->Frame.Spacing.mean());
  // Each sample inside gives an eighth to each of the cells that it is a corner of; cells that the zero set crosses
  // give what lies inside of them instead.
  const auto part = [&](const float* p)
  {
    int inside = 0;
    std::array<float, 8> phi;
    for (int c = 0; c < 8; ++c)
    {
      phi[c] = p[corners[c]];
      inside += phi[c] > 0;
    }
    const double own = phi[0] > 0 ? 1.0 : 0.0;
    return inside == 0 || inside == 8 ? own : own + VolumeInside(phi, spacing) - inside / 8.0;
  };
  std::vector<double> chunks(this->Chunks.size(), 0.0);
  ParallelFor(0, Index(this->Chunks.size()) - 1, 0,
    [&](Index first, Index last)
    {
      for (Index c = first; c < last; ++c)
      {
        for (Index r = this->Chunks[c]; r < this->Chunks[c + 1]; ++r)
        {
          for (Index i = 0; i < this->Runs[r].Count; ++i)
          {
            chunks[c] += part(this->Phi.data() + this->Runs[r].First + i);
          }
        }
      }
    });
  return double(this->Deep) + std::accumulate(chunks.begin(), chunks.end(), 0.0);
}

std::vector<float> NarrowBand::Distance(double unit, double limit) const
{
  const Index nx = this->Frame.Dims[0] - 2 * Margin, ny = this->Frame.Dims[1] - 2 * Margin,
              nz = this->Frame.Dims[2] - 2 * Margin;
  std::vector<float> distance(static_cast<std::size_t>(nx * ny * nz));
  const float scale = float(unit), end = float(limit);
  ParallelFor(0, ny * nz, 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const float* from = this->Phi.data() + this->Frame.At(Margin, Margin + row % ny, Margin + row / ny);
        float* to = distance.data() + row * nx;
        for (Index i = 0; i < nx; ++i)
        {
          const float value = from[i] * scale;
          to[i] = value > end ? end : value < -end ? -end : value;
        }
      }
    });
  return distance;
}
}
