// SPDX-License-Identifier: BSD-3-Clause
//
// The distance of NarrowBand to its zero set, measured: each sample beside the zero set knows a point on it and a
// normal, and so a small disc of it. A sample's distance is that to the nearest disc.
#include "NarrowBand.h"

#include "BandFlows.h"
#include "Parallel.h"
#include "VectorLoops.h"
#include "ZeroCrossing.h"

namespace LabelMesh
{
namespace
{
constexpr float DiscRadius = 0.4f; // samples, in any direction: neighbouring discs about touch
constexpr int SlabThickness = 8;   // slices that one task writes
}

struct NarrowBand::Disc
{
  std::array<int, 3> Sample;   ///< the one beside the zero set
  std::array<float, 3> Center; ///< from there, in voxels
  std::array<float, 3> Normal;
};

/// The discs, by slice of their samples.
std::vector<std::vector<NarrowBand::Disc>> NarrowBand::FindDiscs() const
{
  const Lattice& frame = this->Where->Frame();
  const ZeroCrossing crossing(frame);
  const Index y = frame.Dims[0], z = y * frame.Dims[1];
  std::vector<std::vector<Disc>> slices(static_cast<std::size_t>(frame.Dims[2]));
  ParallelFor(0, frame.Dims[2], 1,
    [&](Index firstSlice, Index lastSlice)
    {
      std::vector<std::int32_t> beside(static_cast<std::size_t>(frame.Dims[0]));
      for (Index k = firstSlice; k < lastSlice; ++k)
      {
        for (Index r = this->Where->Slice(k).Run; r < this->Where->Slice(k + 1).Run; ++r)
        {
          const BandLayout::Run& run = this->Where->Runs()[r];
          const float* const p = this->Phi + run.First;
          FindBeside(p, run.Count, y, z, beside.data());
          const std::array<int, 3> at = frame.Coordinates(run.First);
          for (int i = 0; i < run.Count; ++i)
          {
            std::array<float, 3> slopes;
            if (beside[i] && crossing.Slopes(p + i, slopes.data()))
            {
              const float slope = std::sqrt(slopes[0] * slopes[0] + slopes[1] * slopes[1] + slopes[2] * slopes[2]);
              Disc disc{ { at[0] + i, at[1], at[2] }, {}, {} };
              for (int a = 0; a < 3 && slope > 0; ++a)
              {
                disc.Normal[a] = slopes[a] / slope;
                disc.Center[a] = -p[i] / slope * disc.Normal[a];
              }
              slices[k].push_back(disc);
            }
          }
        }
      }
    });
  return slices;
}

namespace
{
/// A disc, and the part of a row of samples that its squared distances go to.
struct DiscRow
{
  float Dy, Dz;            ///< of the row, from the disc's centre
  float Cx;                ///< the centre, from the disc's sample
  float Nx, Ny, Nz;        ///< normal
  float Hx, Hx2, Hy2, Hz2; ///< spacing and its squares
  int First, Last;         ///< samples of the row, from the disc's sample
};

[[gnu::always_inline]] inline float SquaredDistance(const DiscRow& row, float across, int i)
{
  const float dx = row.Hx * float(i) - row.Cx;
  const float away = dx * row.Nx + across;
  const float tx = dx - away * row.Nx, ty = row.Dy - away * row.Ny, tz = row.Dz - away * row.Nz;
  const float beside2 = tx * tx + ty * ty + tz * tz + 1e-12f;
  const float sample2 = (row.Hx2 * tx * tx + row.Hy2 * ty * ty + row.Hz2 * tz * tz) / beside2; // its length that way
  const float beyond = std::sqrt(beside2) - DiscRadius * std::sqrt(sample2);
  const float outside = beyond > 0 ? beyond : 0.0f;
  return away * away + outside * outside;
}

/// to = min(to, squared distance). `room`: samples that may be read and written from row.First on.
[[gnu::always_inline]] inline void StampRow(const DiscRow& row, float* __restrict to, int room)
{
  const float across = row.Dy * row.Ny + row.Dz * row.Nz;
  for (int first = row.First; first <= row.Last; first += 8, room -= 8)
  {
    if (room >= 8)
    {
      // A whole vector; what is beyond the last sample stays.
      float distance2[8];
#pragma omp simd
      for (int l = 0; l < 8; ++l)
      {
        distance2[l] = SquaredDistance(row, across, first + l);
      }
#pragma omp simd
      for (int l = 0; l < 8; ++l)
      {
        const float reached = first + l <= row.Last ? distance2[l] : 1e30f;
        const float old = to[first + l];
        to[first + l] = old < reached ? old : reached;
      }
    }
    else
    {
      for (int i = first; i <= row.Last; ++i)
      {
        const float reached = SquaredDistance(row, across, i);
        to[i] = to[i] < reached ? to[i] : reached;
      }
    }
  }
}
}

/// Writes the squared distances to a disc into the samples around it.
class NarrowBand::DiscStamp
{
public:
  DiscStamp(const Lattice& frame, double reach)
    : Frame(frame)
    , Hx(float(frame.Spacing[0]))
    , Hy(float(frame.Spacing[1]))
    , Hz(float(frame.Spacing[2]))
    , Rows(BallOffsets(frame, reach))
  {
  }

  /// Samples of the slices from k0 up to k1.
  void Stamp(const std::vector<Disc>& discs, int k0, int k1, float* squared) const;

private:
  const Lattice& Frame;
  float Hx, Hy, Hz;
  std::vector<RowOffset> Rows;
};

LABELMESH_FOR_ANY_X86
void NarrowBand::DiscStamp::Stamp(const std::vector<Disc>& discs, int k0, int k1, float* squared) const
{
  const int width = this->Frame.Dims[0];
  DiscRow row{ 0, 0, 0, 0, 0, 0, this->Hx, this->Hx * this->Hx, this->Hy * this->Hy, this->Hz * this->Hz, 0, 0 };
  for (const Disc& disc : discs)
  {
    const auto& [x, y, z] = disc.Sample;
    row.Cx = disc.Center[0];
    row.Nx = disc.Normal[0];
    row.Ny = disc.Normal[1];
    row.Nz = disc.Normal[2];
    for (const RowOffset& offset : this->Rows)
    {
      const int j = y + offset.J, k = z + offset.K;
      if (k >= k0 && k < k1 && j >= 0 && j < this->Frame.Dims[1])
      {
        row.Dy = this->Hy * float(offset.J) - disc.Center[1];
        row.Dz = this->Hz * float(offset.K) - disc.Center[2];
        row.First = std::max(-offset.Reach, -x);
        row.Last = std::min(offset.Reach, width - 1 - x);
        StampRow(row, squared + this->Frame.At(x, j, k), width - (x + row.First));
      }
    }
  }
}

void NarrowBand::MeasureDistance(double reach)
{
  const Lattice& frame = this->Where->Frame();
  const int slices = frame.Dims[2];
  const std::vector<std::vector<Disc>> discs = this->FindDiscs();
  const DiscStamp stamp(frame, reach);
  const int nz = int(reach / frame.Spacing[2]);
  // Only active samples are asked for; what is written beside them does not matter.
  float* const squared = this->Memory->Third.Sized(frame.Size());
  const float far = float(reach);
  this->Where->ForRuns([&](Index first, Index count, Index) { std::fill_n(squared + first, count, far * far); });
  ParallelFor(0, (slices + SlabThickness - 1) / SlabThickness, 1,
    [&](Index firstSlab, Index lastSlab)
    {
      const int k0 = int(firstSlab) * SlabThickness, k1 = std::min(int(lastSlab) * SlabThickness, slices);
      for (int z = std::max(0, k0 - nz); z < std::min(slices, k1 + nz); ++z)
      {
        stamp.Stamp(discs[z], k0, k1, squared);
      }
    });
  this->Advance(
    [&](const BandLayout::Run* runs, Index count, Index)
    {
      for (Index r = 0; r < count; ++r)
      {
        for (Index i = runs[r].First; i < runs[r].First + runs[r].Count; ++i)
        {
          const float distance = std::sqrt(squared[i]), before = std::abs(this->Phi[i]);
          const float measured = distance < far ? distance : std::max(before, far);
          this->Next[i] = this->Phi[i] > 0 ? measured : -measured;
        }
      }
    });
}
}
