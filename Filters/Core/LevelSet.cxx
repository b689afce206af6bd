// SPDX-License-Identifier: BSD-3-Clause
#include "LevelSet.h"

#include "NarrowBand.h"
#include "Parallel.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
constexpr double IterationTime = 0.2; // voxels squared of curvature flow in one iteration
// Of a surface from the opening or the closing, voxels: corners that are rounded, and parts that vanish.
constexpr float RoundedBy = 0.3f, ThinBeyond = 0.6f;
constexpr double LargestRadius = 10; // voxels: the work of the bounds grows with its cube

/// How far a bound may stay from the surface, if what is thin is kept: beyond rounding less and less.
float DistanceToBound(float distance)
{
  const float kept = RoundedBy * (ThinBeyond - distance) / (ThinBeyond - RoundedBy);
  return distance <= RoundedBy ? distance : std::max(kept, 0.0f);
}

/// Brings the bounds back to the surface where a thin part, or a thin gap, lies between. Where part and gap are thin
/// alike it is noise, and may go.
void SpareThinParts(const NarrowBand& band, std::vector<float>& opening, std::vector<float>& closing)
{
  const std::vector<float> surface = band.Pack();
  ParallelFor(0, Index(surface.size()), 0,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        const float below = surface[n] - opening[n], above = closing[n] - surface[n];
        if (std::min(below, above) <= RoundedBy)
        {
          opening[n] = surface[n] - DistanceToBound(below);
          closing[n] = surface[n] + DistanceToBound(above);
        }
      }
    });
}
}

void CheckTightenOptions(const TightenOptions& options)
{
  if (!(options.Radius >= 0) || options.Radius > LargestRadius)
  {
    throw std::invalid_argument("The tightening radius is " + std::to_string(options.Radius) +
      " voxels; expected 0 to " + std::to_string(int(LargestRadius)) + ".");
  }
  if (options.AntialiasIterations < 0 || options.TightenIterations < 0)
  {
    throw std::invalid_argument("The numbers of iterations of antialiasing and tightening must not be negative.");
  }
  if (!(options.Band >= 2))
  {
    throw std::invalid_argument(
      "The narrow band is " + std::to_string(options.Band) + " voxels wide; later stages need 2 at least.");
  }
}

double BandReach(const TightenOptions& options)
{
  // The opening and closing need the distance on both sides of a zero set that is moved by the radius.
  return std::max(options.Band, options.Radius + 3.0);
}

TightenVolumes TightenBand(
  NarrowBand& band, const Lattice& frame, const TightenOptions& options, const Monitor& monitor, float* distance)
{
  if (options.Radius > 0)
  {
    monitor.Step(0.0, "Opening");
    band.MeasureDistance(NarrowBand::BallReach(options.Radius));
    std::vector<float> opening = band.Opening(options.Radius);
    monitor.Step(0.25, "Closing");
    std::vector<float> closing = band.Closing(options.Radius);
    if (options.KeepThin)
    {
      SpareThinParts(band, opening, closing);
    }
    monitor.Step(0.5, "Tightening");
    band.SmoothBetween(IterationTime * options.TightenIterations, opening, closing);
    monitor.Step(0.8, "Re-distancing");
    band.Redistance(BandReach(options));
  }
  const double voxelVolume = frame.VoxelVolume();
  band.Distance(frame.VoxelSize(), options.Band * frame.VoxelSize(), distance);
  return { double(band.NumberOfInsideSamples()) * voxelVolume, band.Volume() * voxelVolume };
}

TightenVolumes Tighten(const Lattice& frame, const std::uint8_t* mask, const TightenOptions& options,
  const Monitor& monitor, float* distance)
{
  CheckTightenOptions(options);
  if (frame.Size() == 0)
  {
    return TightenVolumes();
  }
  const double reach = BandReach(options);
  monitor.Step(0.0, "Distance");
  NarrowBand band(frame, mask, reach);

  monitor.Step(0.1, "Antialiasing");
  band.SmoothKeepingSides(IterationTime * options.AntialiasIterations);
  band.Redistance(reach);
  return TightenBand(band, frame, options, monitor.Part(0.25, 1.0), distance);
}
}
