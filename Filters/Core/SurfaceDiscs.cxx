// SPDX-License-Identifier: BSD-3-Clause
//
// The distance of NarrowBand to its zero set, measured: each sample beside the zero set knows a point on it and a
// normal, and so a small disc of it. A sample's distance is that to the nearest disc.
#include "NarrowBand.h"

#include "Parallel.h"
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
  const ZeroCrossing crossing(this->Frame);
  std::vector<std::vector<Disc>> chunks(this->Chunks.size());
  ParallelFor(0, Index(this->Chunks.size()) - 1, 0,
    [&](Index first, Index last)
    {
      for (Index c = first; c < last; ++c)
      {
        for (Index r = this->Chunks[c]; r < this->Chunks[c + 1]; ++r)
        {
          const Run& run = this->Runs[r];
          auto at = this->Frame.Coordinates(run.First);
          for (Index i = run.First; i < run.First + run.Count; ++i, ++at[0])
          {
            std::array<float, 3> slopes;
            if (crossing.Slopes(&this->Phi[i], slopes.data()))
            {
              const float slope = std::sqrt(slopes[0] * slopes[0] + slopes[1] * slopes[1] + slopes[2] * slopes[2]);
              Disc disc{ at, {}, {} };
              for (int a = 0; a < 3 && slope > 0; ++a)
              {
                disc.Normal[a] = slopes[a] / slope;
                disc.Center[a] = -this->Phi[i] / slope * disc.Normal[a];
              }
              chunks[c].push_back(disc);
            }
          }
        }
      }
    });
  std::vector<std::vector<Disc>> slices(static_cast<std::size_t>(this->Frame.Dims[2]));
  for (const auto& chunk : chunks)
  {
    for (const Disc& disc : chunk)
    {
      slices[disc.Sample[2]].push_back(disc);
    }
  }
  return slices;
}

/// Writes the squared distances to a disc into the rows of samples around it.
class NarrowBand::DiscStamp
{
public:
  DiscStamp(const Lattice& frame, double reach)
    : Frame(frame)
    , Reach(reach)
    , Hx(float(frame.Spacing[0]))
    , Hy(float(frame.Spacing[1]))
    , Hz(float(frame.Spacing[2]))
  {
  }

  /// The row at j, k from the disc's sample.
  void Row(const Disc& disc, int j, int k, std::vector<float>& squared) const
  {
    const auto& [x, y, z] = disc.Sample;
    const double left = this->Reach * this->Reach - std::pow(this->Hy * j, 2) - std::pow(this->Hz * k, 2);
    const int reach = left < 0 ? -1 : int(std::sqrt(left) / this->Hx);
    const int first = std::max(-reach, -x), last = std::min(reach, this->Frame.Dims[0] - 1 - x);
    const auto [nx, ny, nz] = disc.Normal;
    const float dy = this->Hy * float(j) - disc.Center[1], dz = this->Hz * float(k) - disc.Center[2];
    const float cx = disc.Center[0], across = dy * ny + dz * nz;
    const float hx = this->Hx, hx2 = hx * hx, hy2 = this->Hy * this->Hy, hz2 = this->Hz * this->Hz;
    float* __restrict to = squared.data() + this->Frame.At(x, y + j, z + k);
    for (int i = first; i <= last; ++i)
    {
      const float dx = hx * float(i) - cx;
      const float away = dx * nx + across;
      const float tx = dx - away * nx, ty = dy - away * ny, tz = dz - away * nz;
      const float beside2 = tx * tx + ty * ty + tz * tz + 1e-12f;
      const float sample2 = (hx2 * tx * tx + hy2 * ty * ty + hz2 * tz * tz) / beside2; // its length in that direction
      const float beyond = std::sqrt(beside2) - DiscRadius * std::sqrt(sample2);
      const float outside = beyond > 0 ? beyond : 0.0f;
      const float distance2 = away * away + outside * outside;
      to[i] = to[i] < distance2 ? to[i] : distance2;
    }
  }

private:
  const Lattice& Frame;
  double Reach;
  float Hx, Hy, Hz;
};

void NarrowBand::MeasureDistance(double reach)
{
  const auto& dims = this->Frame.Dims;
  const std::vector<std::vector<Disc>> discs = this->FindDiscs();
  const DiscStamp stamp(this->Frame, reach);
  const int ny = int(reach / this->Frame.Spacing[1]), nz = int(reach / this->Frame.Spacing[2]);
  std::vector<float> squared(this->Phi.size(), float(reach * reach));
  ParallelFor(0, (dims[2] + SlabThickness - 1) / SlabThickness, 1,
    [&](Index firstSlab, Index lastSlab)
    {
      const int k0 = int(firstSlab) * SlabThickness, k1 = std::min(int(lastSlab) * SlabThickness, dims[2]);
      for (int z = std::max(0, k0 - nz); z < std::min(dims[2], k1 + nz); ++z)
      {
        for (const Disc& disc : discs[z])
        {
          const int y = disc.Sample[1];
          for (int k = std::max(-nz, k0 - z); k <= std::min(nz, k1 - 1 - z); ++k)
          {
            for (int j = std::max(-ny, -y); j <= std::min(ny, dims[1] - 1 - y); ++j)
            {
              stamp.Row(disc, j, k, squared);
            }
          }
        }
      }
    });
  const float far = float(reach);
  this->Advance(
    [&](const Run& run)
    {
      for (Index i = run.First; i < run.First + run.Count; ++i)
      {
        const float distance = std::sqrt(squared[i]), before = std::abs(this->Phi[i]);
        const float measured = distance < far ? distance : std::max(before, far);
        this->Next[i] = this->Phi[i] > 0 ? measured : -measured;
      }
    });
}
}
