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
constexpr double LargestRadius = 32;  // voxels: beyond it the band is no longer narrow

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

/// Bound of the flow: the opening (radius > 0) or the closing (radius < 0) by a ball, as a distance, packed.
/// `original` is what phi was, and is again.  An opening is never larger than the original, a closing never smaller;
/// where features are as thin as the samples are apart, re-distancing alone would not see to that.
std::vector<float> OpeningOrClosing(NarrowBand& band, const std::vector<float>& original, double radius, double reach)
{
  band.Shift(-radius);
  band.Redistance(reach, true);
  band.Shift(radius);
  band.Redistance(reach);
  std::vector<float> bound = band.Pack();
  band.Unpack(original);
  ParallelFor(0, Index(bound.size()), 0,
    [&](Index first, Index last)
    {
      for (Index i = first; i < last; ++i)
      {
        bound[i] = radius > 0 ? std::min(bound[i], original[i]) : std::max(bound[i], original[i]);
      }
    });
  return bound;
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
    const std::vector<float> antialiased = band.Pack();
    const std::vector<float> opening = OpeningOrClosing(band, antialiased, options.Radius, reach);
    monitor.Step(0.45, "Closing");
    const std::vector<float> closing = OpeningOrClosing(band, antialiased, -options.Radius, reach);
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
