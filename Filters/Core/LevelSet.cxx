// SPDX-License-Identifier: BSD-3-Clause
#include "LevelSet.h"

#include "NarrowBand.h"
#include "Parallel.h"

#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
constexpr double IterationTime = 0.2; // voxels squared of curvature flow in one iteration
constexpr double LargestRadius = 10;  // voxels: the work of the bounds grows with its cube

void Check(const TightenOptions& options)
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
}

TightenResult Tighten(const Lattice& frame, const float* mask, const TightenOptions& options, const Monitor& monitor)
{
  Check(options);
  TightenResult result;
  if (frame.Size() == 0)
  {
    return result;
  }
  // The opening and closing need the distance on both sides of a zero set that is moved by the radius.
  const double reach = std::max(options.Band, options.Radius + 3.0);
  monitor.Step(0.0, "Distance");
  NarrowBand band(frame, mask, reach);

  monitor.Step(0.1, "Antialiasing");
  band.SmoothKeepingSides(IterationTime * options.AntialiasIterations);
  band.Redistance(reach);

  if (options.Radius > 0)
  {
    monitor.Step(0.25, "Opening");
    band.MeasureDistance(NarrowBand::BallReach(options.Radius));
    const std::vector<float> opening = band.Opening(options.Radius);
    monitor.Step(0.45, "Closing");
    const std::vector<float> closing = band.Closing(options.Radius);
    monitor.Step(0.65, "Tightening");
    band.SmoothBetween(IterationTime * options.TightenIterations, opening, closing);
    monitor.Step(0.85, "Re-distancing");
    band.Redistance(reach);
  }

  const double voxelVolume = frame.VoxelVolume();
  result.MaskVolume = double(band.NumberOfInsideSamples()) * voxelVolume;
  result.TightVolume = band.Volume() * voxelVolume;
  result.Distance = band.Distance(frame.VoxelSize(), options.Band * frame.VoxelSize());
  return result;
}
}
