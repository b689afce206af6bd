// SPDX-License-Identifier: BSD-3-Clause
#include "NarrowBand.h"

#include "BandFlows.h"
#include "Parallel.h"

#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr int Margin = BandLayout::Margin;

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

/// The sides of the mask on the lattice grown by the margin.
void FindSides(const Lattice& grown, const std::uint8_t* mask, Sides& sides)
{
  const Index nx = grown.Dims[0] - 2 * Margin, ny = grown.Dims[1] - 2 * Margin, nz = grown.Dims[2] - 2 * Margin;
  sides.resize(static_cast<std::size_t>(grown.Size()));
  ParallelFor(0, Index(grown.Dims[1]) * grown.Dims[2], 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const Index j = std::clamp<Index>(row % grown.Dims[1] - Margin, 0, ny - 1);
        const Index k = std::clamp<Index>(row / grown.Dims[1] - Margin, 0, nz - 1);
        const std::uint8_t* const from = mask + nx * (j + ny * k);
        std::uint8_t* const to = sides.data() + row * grown.Dims[0] + Margin;
        for (Index i = 0; i < nx; ++i)
        {
          to[i] = from[i] != 0;
        }
        std::fill_n(to - Margin, Margin, to[0]);
        std::fill_n(to + nx, Margin, to[nx - 1]);
      }
    });
}

/// The samples without margin that are less than `end` from the zero set.
BitLattice FindActive(const Lattice& grown, const float* phi, float end)
{
  BitLattice bits(grown.Dims);
  const int nx = grown.Dims[0] - Margin;
  ParallelFor(Margin, grown.Dims[2] - Margin, 0,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        for (Index j = Margin; j < grown.Dims[1] - Margin; ++j)
        {
          const float* const row = phi + grown.At(0, j, k);
          for (int i = Margin; i < nx;)
          {
            const int from = i =
              int(std::find_if(row + i, row + nx, [end](float v) { return std::abs(v) < end; }) - row);
            i = int(std::find_if(row + i, row + nx, [end](float v) { return !(std::abs(v) < end); }) - row);
            bits.Add({ from, i }, j, k);
          }
        }
      }
    });
  return bits;
}
}

NarrowBand::NarrowBand(const Lattice& frame, const std::uint8_t* mask, double band, std::shared_ptr<BandMemory> memory)
  : Memory(std::move(memory))
  , End(float(band))
{
  const Lattice grown = BandLayout::Grown(frame);
  this->Phi = this->Memory->Phi.Sized(grown.Size());
  this->Next = this->Memory->Next.Sized(grown.Size());
  FindSides(grown, mask, this->Memory->Inside);
  SignedDistance(grown, this->Memory->Inside, band, this->Phi);
  this->Where = std::make_shared<BandLayout>(grown, mask, FindActive(grown, this->Phi, this->End));
  for (const BandLayout::Ghost& ghost : this->Where->Ghosts())
  {
    this->Phi[ghost.To] = this->Phi[ghost.From];
  }
  ParallelFor(0, grown.Size(), 0,
    [&](Index first, Index last) { std::copy(this->Phi + first, this->Phi + last, this->Next + first); });
}

NarrowBand::NarrowBand(std::shared_ptr<const BandLayout> layout, double band, const std::vector<float>& packed,
  std::shared_ptr<BandMemory> memory)
  : Where(std::move(layout))
  , Memory(std::move(memory))
  , End(float(band))
{
  this->Phi = this->Memory->Phi.Sized(this->Where->Frame().Size());
  this->Next = this->Memory->Next.Sized(this->Where->Frame().Size());
  this->FillRims();
  this->Assign(packed);
}

void NarrowBand::FillRims()
{
  const std::vector<BandLayout::Rim>& rims = this->Where->Rims();
  ParallelFor(0, Index(rims.size()), 0,
    [&](Index first, Index last)
    {
      for (Index r = first; r < last; ++r)
      {
        const float value = rims[r].Inside ? this->End : -this->End;
        std::fill_n(this->Phi + rims[r].First, rims[r].Count, value);
        std::fill_n(this->Next + rims[r].First, rims[r].Count, value);
      }
    });
}

void NarrowBand::FillSides(const std::uint8_t* mask)
{
  Sides& sides = this->Memory->Inside;
  FindSides(this->Where->Frame(), mask, sides);
  const float end = this->End;
  ParallelFor(0, Index(sides.size()), 0,
    [&](Index first, Index last)
    {
      for (Index at = first; at < last; ++at)
      {
        this->Phi[at] = this->Next[at] = sides[at] ? end : -end;
      }
    });
}

void NarrowBand::Widen(const std::uint8_t* mask, double band)
{
  const std::vector<float> packed = this->Pack();
  const std::shared_ptr<const BandLayout> narrow = this->Where;
  const Lattice& grown = narrow->Frame();
  BitLattice wide = Dilated(narrow->ActiveBits(), BallOffsets(grown, std::max(0.0, band - double(this->End))));
  // The margin stays what it is.
  BitLattice inner(grown.Dims);
  for (int k = Margin; k < grown.Dims[2] - Margin; ++k)
  {
    for (int j = Margin; j < grown.Dims[1] - Margin; ++j)
    {
      inner.Add({ Margin, grown.Dims[0] - Margin }, j, k);
      std::transform(inner.Row(j, k), inner.Row(j, k) + inner.WordsPerRow(), wide.Row(j, k), inner.Row(j, k),
        [](BitLattice::Word a, BitLattice::Word b) { return a & b; });
    }
  }
  this->Where = std::make_shared<BandLayout>(grown, mask, inner);
  this->End = float(band);
  this->FillSides(mask);
  narrow->ForRuns(
    [&](Index first, Index count, Index at) { std::copy_n(packed.data() + at, count, this->Phi + first); });
  for (const BandLayout::Ghost& ghost : this->Where->Ghosts())
  {
    this->Phi[ghost.To] = this->Phi[ghost.From];
  }
}

void NarrowBand::Finish()
{
  for (const BandLayout::Ghost& ghost : this->Where->Ghosts())
  {
    this->Next[ghost.To] = this->Next[ghost.From];
  }
  this->Memory->Phi.Swap(this->Memory->Next);
  std::swap(this->Phi, this->Next);
}

void NarrowBand::SmoothKeepingSides(double time)
{
  const Lattice& frame = this->Where->Frame();
  const TimeSteps steps(time, LongestStep(frame));
  const CurvatureStencil stencil(frame, steps.Length);
  const float least = float(0.05 * frame.Spacing.minCoeff());
  for (int step = 0; step < steps.Count; ++step)
  {
    this->Advance([&](const BandLayout::Run* runs, Index count, Index)
      { FlowKeepingSides(stencil, this->Phi, this->Next, runs, count, least); });
  }
}

void NarrowBand::SmoothTowards(double time, const std::vector<float>& sides, double force)
{
  constexpr float least = 0.05f; // voxels: so far the force pushes
  const Lattice& frame = this->Where->Frame();
  const TimeSteps steps(time, LongestStep(frame));
  const CurvatureStencil stencil(frame, steps.Length);
  // Each step of the flow pushes for its own time.
  const float push = float(force * steps.Length);
  for (int step = 0; step < steps.Count; ++step)
  {
    this->Advance([&](const BandLayout::Run* runs, Index count, Index packed)
      { FlowTowards(stencil, this->Phi, this->Next, runs, count, sides.data() + packed, push, least); });
  }
}

void NarrowBand::SmoothBetween(double time, const std::vector<float>& lower, const std::vector<float>& upper)
{
  // The others hold their values, in both arrays.
  std::vector<Mortar> pieces(static_cast<std::size_t>(this->Where->NumberOfPieces()));
  ParallelFor(0, Index(pieces.size()), 0,
    [&](Index first, Index last)
    {
      for (Index piece = first; piece < last; ++piece)
      {
        this->Where->VisitPiece(piece,
          [&](const BandLayout::Run* runs, Index count, Index packed)
          {
            for (Index r = 0; r < count; packed += runs[r].Count, ++r)
            {
              std::copy_n(this->Phi + runs[r].First, runs[r].Count, this->Next + runs[r].First);
              pieces[piece].Add(runs[r], lower.data() + packed, upper.data() + packed);
            }
          });
      }
    });
  const Lattice& frame = this->Where->Frame();
  const TimeSteps steps(time, LongestStep(frame));
  const CurvatureStencil stencil(frame, steps.Length);
  for (int step = 0; step < steps.Count; ++step)
  {
    ParallelFor(0, Index(pieces.size()), 0,
      [&](Index first, Index last)
      {
        for (Index piece = first; piece < last; ++piece)
        {
          FlowBetween(stencil, this->Phi, this->Next, pieces[piece]);
        }
      });
    this->Finish();
  }
}

void NarrowBand::FindTargets()
{
  const CrossingStencil crossing(this->Where->Frame());
  float* const signs = this->Memory->Signs.Sized(this->Where->NumberOfActive());
  this->Advance([&](const BandLayout::Run* runs, Index count, Index packed)
    { PlaceBeside(crossing, this->Phi, this->Next, runs, count, signs + packed); });
}

void NarrowBand::Redistance(double reach)
{
  const Lattice& frame = this->Where->Frame();
  const TimeSteps steps(reach, 1.5 / frame.Spacing.cwiseInverse().sum());
  const CrossingStencil stencil(frame);
  this->FindTargets();
  const float* const signs = this->Memory->Signs.Data();
  for (int step = 0; step < steps.Count; ++step)
  {
    this->Advance([&](const BandLayout::Run* runs, Index count, Index packed)
      { FlowUpwind(stencil, this->Phi, this->Next, runs, count, signs + packed, steps.Length); });
  }
}

void NarrowBand::Assign(const std::vector<float>& packed)
{
  this->Where->ForRuns(
    [&](Index first, Index count, Index at) { std::copy_n(packed.data() + at, count, this->Next + first); });
  this->Finish();
}

void NarrowBand::Pack(std::vector<float>& packed) const
{
  packed.resize(static_cast<std::size_t>(this->Where->NumberOfActive()));
  this->Where->ForRuns(
    [&](Index first, Index count, Index at) { std::copy_n(this->Phi + first, count, packed.data() + at); });
}

std::vector<float> NarrowBand::Pack() const
{
  std::vector<float> packed;
  this->Pack(packed);
  return packed;
}

double NarrowBand::Volume() const
{
  const Lattice& frame = this->Where->Frame();
  const Index y = frame.Dims[0], z = y * frame.Dims[1];
  const Index corners[8] = { 0, 1, y, y + 1, z, z + 1, z + y, z + y + 1 };
  const float spacing = float(frame.Spacing.mean());
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
  std::vector<double> pieces(static_cast<std::size_t>(this->Where->NumberOfPieces()), 0.0);
  ParallelFor(0, Index(pieces.size()), 0,
    [&](Index first, Index last)
    {
      for (Index piece = first; piece < last; ++piece)
      {
        this->Where->VisitPiece(piece,
          [&](const BandLayout::Run* runs, Index count, Index)
          {
            std::vector<std::int32_t> crossed(static_cast<std::size_t>(frame.Dims[0]));
            for (Index r = 0; r < count; ++r)
            {
              const float* const row = this->Phi + runs[r].First;
              FindCrossedCells(row, runs[r].Count, y, z, crossed.data());
              for (Index i = 0; i < runs[r].Count; ++i)
              {
                pieces[piece] += crossed[i] ? part(row + i) : row[i] > 0 ? 1.0 : 0.0;
              }
            }
          });
      }
    });
  return double(this->Where->NumberOfDeep()) + std::accumulate(pieces.begin(), pieces.end(), 0.0);
}

void NarrowBand::Distance(double unit, double limit, float* distance) const
{
  const Lattice& frame = this->Where->Frame();
  const Index nx = frame.Dims[0] - 2 * Margin, ny = frame.Dims[1] - 2 * Margin, nz = frame.Dims[2] - 2 * Margin;
  const float scale = float(unit), end = float(limit);
  ParallelFor(0, ny * nz, 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const float* from = this->Phi + frame.At(Margin, Margin + row % ny, Margin + row / ny);
        float* to = distance + row * nx;
        for (Index i = 0; i < nx; ++i)
        {
          const float value = from[i] * scale;
          to[i] = value > end ? end : value < -end ? -end : value;
        }
      }
    });
}
}
