// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryEstimate.h"

#include "Core/MaterialMasks.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
constexpr double GiB = 1024.0 * 1024.0 * 1024.0;
constexpr double Base = 50.0 * 1024.0 * 1024.0;
constexpr double PerBlockSample = 17.0, PerWorkingSample = 8.0, PerFace = 1000.0;

/// Samples of a box after resampling, with its padding along each axis.
double SamplesOf(const Box& box, double resampling, const std::array<int, 3>& padding)
{
  double samples = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    samples *= resampling * (box[2 * a + 1] - box[2 * a] + 1) + 2.0 * padding[a];
  }
  return samples;
}

/// Faces between samples of different labels; those of the volume's border count for all but the background.
double FacesBetweenLabels(const LabelImage& image, Label background)
{
  const Lattice samples = image.Frame.Samples();
  const std::array<Index, 3> steps = { 1, samples.Dims[0], Index(samples.Dims[0]) * samples.Dims[1] };
  const auto outside = std::lower_bound(image.Labels.begin(), image.Labels.end(), background);
  const bool hasBackground = outside != image.Labels.end() && *outside == background;
  Index faces = 0;
  for (Index at = 0; at < samples.Size(); ++at)
  {
    const auto c = samples.Coordinates(at);
    const bool foreground = !hasBackground || image.Labels[image.Ids[at]] != background;
    for (int a = 0; a < 3; ++a)
    {
      faces += c[a] == 0 && foreground;
      faces += c[a] + 1 == samples.Dims[a] ? foreground : image.Ids[at] != image.Ids[at + steps[a]];
    }
  }
  return double(faces);
}
}

double EstimateMemory(const LabelImage& image, Label background, int padding, double resampling)
{
  const Lattice samples = image.Frame.Samples();
  const Box whole = { 0, samples.Dims[0] - 1, 0, samples.Dims[1] - 1, 0, samples.Dims[2] - 1 };
  const double working = SamplesOf(whole, resampling, { padding, padding, padding });
  const std::array<int, 3> reach = { BlockReach(samples, 0, padding), BlockReach(samples, 1, padding),
    BlockReach(samples, 2, padding) };
  double blocks = working;
  const std::vector<Box> boxes = BoxesOf(image.Ids, samples, int(image.Labels.size()));
  for (std::size_t id = 0; id < boxes.size(); ++id)
  {
    const bool occurs = boxes[id][0] <= boxes[id][1];
    blocks +=
      occurs && image.Labels[id] != background ? std::min(SamplesOf(boxes[id], resampling, reach), working) : 0.0;
  }
  return Base + PerBlockSample * blocks + PerWorkingSample * working +
    PerFace * resampling * resampling * FacesBetweenLabels(image, background);
}

void RequireMemory(double estimate, double limit)
{
  if (limit > 0 && estimate > limit * GiB)
  {
    std::array<char, 64> words{};
    std::snprintf(words.data(), words.size(), "%.2f GiB of memory, the limit is %.2f GiB", estimate / GiB, limit);
    throw std::runtime_error("This volume would take about " + std::string(words.data()) +
      ". Crop it, mesh fewer labels, lower the resampling factor, or raise the memory limit.");
  }
}
}
