// SPDX-License-Identifier: BSD-3-Clause
//
// Openings and closings of NarrowBand as unions of balls. Moving the zero set by the radius, making it a distance and
// moving it back would do the same in theory; on a grid the moved zero set is full of corners and sheets thinner than a
// voxel, of which it loses half a voxel and more.
#include "NarrowBand.h"

#include "Parallel.h"
#include "VectorLoops.h"

namespace LabelMesh
{
namespace
{
constexpr float Tolerance =
  0.1f; // voxels: what a ball's reach loses because its centre is a sample, if those are a voxel apart
constexpr float RoundOff = 0.01f; // voxels: a plate as thick as the ball fits
constexpr float Nothing = -1e6f;  // no ball
constexpr float Everything = 1e6f;
constexpr double HeldBeyond = 1.0; // voxels beyond the radius: farther samples keep their value. 0.5 saves a twentieth
                                   // of the time, and 45 of a million samples of the frog change their side.

/// Samples within reach of a ball's centre, as offsets in memory.
struct Offset
{
  Index Step = 0;
  std::array<int, 3> Steps{ 0, 0, 0 };
  float Length = 0;
};

std::vector<Offset> OffsetsWithin(const Lattice& frame, double reach)
{
  std::vector<Offset> offsets;
  int n[3];
  for (int a = 0; a < 3; ++a)
  {
    n[a] = int(reach / frame.Spacing[a]);
  }
  for (int k = -n[2]; k <= n[2]; ++k)
  {
    for (int j = -n[1]; j <= n[1]; ++j)
    {
      for (int i = -n[0]; i <= n[0]; ++i)
      {
        const double length = frame.Spacing.cwiseProduct(Vec3(i, j, k)).norm();
        if (length <= reach)
        {
          offsets.push_back({ i + frame.Dims[0] * (j + Index(frame.Dims[1]) * k), { i, j, k }, float(length) });
        }
      }
    }
  }
  return offsets;
}

/// best = max over the offsets of s phi(y) - |x - y|, where s phi(y) >= radius.
LABELMESH_FOR_ANY_X86
void BallsAtSamples(const float* __restrict phi, float* __restrict best, Index count, float sign, float radius,
  const std::vector<Offset>& offsets)
{
  ForLanes(count,
    [&](auto lanes, Index i)
    {
      using Vector = typename decltype(lanes)::Vector;
      const Vector nothing = Vector{} + Nothing;
      Vector largest = nothing, value;
      for (const Offset& offset : offsets)
      {
        Load(phi + i + offset.Step, value);
        value *= sign;
        const Vector ball = (value >= radius ? value : nothing) - offset.Length;
        largest = largest > ball ? largest : ball;
      }
      Store(largest, best + i);
    });
}

/// The same near the border of the lattice, whose samples are all that there is.
void BallsAtBorder(const Lattice& frame, const float* phi, const std::array<int, 3>& at, float* best, Index count,
  float sign, float radius, const std::vector<Offset>& offsets)
{
  for (Index i = 0; i < count; ++i)
  {
    best[i] = Nothing;
    for (const Offset& offset : offsets)
    {
      const int x = at[0] + int(i) + offset.Steps[0], y = at[1] + offset.Steps[1], z = at[2] + offset.Steps[2];
      const bool within = x >= 0 && x < frame.Dims[0] && y >= 0 && y < frame.Dims[1] && z >= 0 && z < frame.Dims[2];
      if (within && sign * phi[i + offset.Step] >= radius)
      {
        best[i] = std::max(best[i], sign * phi[i + offset.Step] - offset.Length);
      }
    }
  }
}

/// A ball centred between two samples.
struct RidgePoint
{
  Index Sample = 0; ///< the lower one
  int Axis = 0;
  float FromMiddle = 0; ///< of the two samples, in samples
  float Radius = 0;
};

/// Whether s phi, below the radius at p[0] and p[step], reaches it between them, as the slopes before and after say.
bool RidgeBetween(const float* p, Index step, float sign, float radius, RidgePoint& ridge)
{
  const float here = sign * p[0], next = sign * p[step];
  const float up = here - sign * p[-step], down = next - sign * p[2 * step];
  if (here >= radius || next >= radius || up <= 0 || down <= 0)
  {
    return false;
  }
  // Where the two slopes meet; written so that the mirror image gives the same bits.
  ridge.FromMiddle = 0.5f * ((next + down) - (here + up)) / (up + down);
  ridge.Radius = ((here * down + next * up) + up * down) / (up + down);
  return std::abs(ridge.FromMiddle) <= 0.5f && ridge.Radius >= radius;
}

void BallAtRidge(const Lattice& frame, const RidgePoint& ridge, double reach, float* best)
{
  const auto at = frame.Coordinates(ridge.Sample);
  Vec3 center(at[0], at[1], at[2]);
  center[ridge.Axis] += 0.5 + double(ridge.FromMiddle);
  int low[3], high[3];
  for (int a = 0; a < 3; ++a)
  {
    low[a] = std::max(0, int(std::ceil(center[a] - reach / frame.Spacing[a])));
    high[a] = std::min(frame.Dims[a] - 1, int(std::floor(center[a] + reach / frame.Spacing[a])));
  }
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      for (int i = low[0]; i <= high[0]; ++i)
      {
        const double length = frame.Spacing.cwiseProduct(Vec3(i, j, k) - center).norm();
        float& value = best[frame.At(i, j, k)];
        value = std::max(value, ridge.Radius - float(length));
      }
    }
  }
}

/// Whether all offsets from `count` samples in a row stay in the lattice.
bool IsInner(const Lattice& frame, const std::array<int, 3>& at, Index count, double reach)
{
  bool inner = true;
  for (int a = 0; a < 3; ++a)
  {
    const int margin = int(reach / frame.Spacing[a]), last = at[a] + (a == 0 ? int(count) - 1 : 0);
    inner = inner && at[a] >= margin && last < frame.Dims[a] - margin;
  }
  return inner;
}

void FindRidges(const Lattice& frame, const float* phi, Index from, Index count, float sign, float radius,
  std::vector<RidgePoint>& found)
{
  const Index step[3] = { 1, frame.Dims[0], Index(frame.Dims[0]) * frame.Dims[1] };
  RidgePoint ridge;
  for (ridge.Sample = from; ridge.Sample < from + count; ++ridge.Sample)
  {
    for (ridge.Axis = 0; ridge.Axis < 3; ++ridge.Axis)
    {
      if (RidgeBetween(phi + ridge.Sample, step[ridge.Axis], sign, radius, ridge))
      {
        found.push_back(ridge);
      }
    }
  }
}
}

std::vector<float> NarrowBand::UnionOfBalls(double radius, float sign) const
{
  const Lattice& frame = this->Where->Frame();
  const float* const phi = this->Phi;
  const float least = float(radius) - RoundOff, far = float(-radius - HeldBeyond);
  const double reach = BallReach(radius);
  const std::vector<Offset> offsets = OffsetsWithin(frame, reach);
  float* const best = this->Memory->Third.Sized(frame.Size());
  std::vector<std::vector<RidgePoint>> ridges(static_cast<std::size_t>(this->Where->NumberOfPieces()));
  const auto visit = [&](const BandLayout::Run& run, std::vector<RidgePoint>& found)
  {
    float* const to = best + run.First;
    const float* const row = phi + run.First;
    std::fill_n(to, run.Count, Everything);
    // A sample as deep as the ball is inside of its own.
    const auto open = [&](float value) { return sign * value < least && sign * value > far; };
    for (int i = 0; i < run.Count;)
    {
      const int first = i = int(std::find_if(row + i, row + run.Count, open) - row);
      i = int(std::find_if_not(row + i, row + run.Count, open) - row);
      if (i > first)
      {
        const auto at = frame.Coordinates(run.First + first);
        IsInner(frame, at, i - first, reach)
          ? BallsAtSamples(row + first, to + first, i - first, sign, least, offsets)
          : BallsAtBorder(frame, row + first, at, to + first, i - first, sign, least, offsets);
        FindRidges(frame, phi, run.First + first, i - first, sign, least, found);
      }
    }
  };
  ParallelFor(0, Index(ridges.size()), 0,
    [&](Index first, Index last)
    {
      for (Index piece = first; piece < last; ++piece)
      {
        this->Where->VisitPiece(piece,
          [&](const BandLayout::Run* runs, Index count, Index)
          { std::for_each(runs, runs + count, [&](const BandLayout::Run& run) { visit(run, ridges[piece]); }); });
      }
    });
  for (const auto& piece : ridges)
  {
    for (const RidgePoint& ridge : piece)
    {
      BallAtRidge(frame, ridge, reach, best);
    }
  }
  // A centre that is off by half a sample to the side costs the square of that.
  const float tolerance = Tolerance * float(std::max(1.0, frame.Spacing.cwiseAbs2().maxCoeff()));
  std::vector<float> bound(static_cast<std::size_t>(this->Where->NumberOfActive()));
  this->Where->ForRuns(
    [&](Index first, Index count, Index packed)
    {
      for (Index i = 0; i < count; ++i)
      {
        const float value = sign * phi[first + i];
        bound[packed + i] = sign * std::min(value, best[first + i] + tolerance);
      }
    });
  return bound;
}

std::vector<float> NarrowBand::Opening(double radius) const
{
  return this->UnionOfBalls(radius, 1.0f);
}

std::vector<float> NarrowBand::Closing(double radius) const
{
  return this->UnionOfBalls(radius, -1.0f);
}
}
