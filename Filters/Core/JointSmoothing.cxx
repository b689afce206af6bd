// SPDX-License-Identifier: BSD-3-Clause
#include "JointSmoothing.h"

#include "GaussianBlur.h"
#include "NarrowBand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
// Lengths in voxels, times in voxels squared.
constexpr double FlowTime = 0.2; // of one step of curvature flow
constexpr int FlowSteps = 2;     // per round
constexpr double RoundRedistance = 1.0;
constexpr double FinalRedistance = 2.0;
constexpr double ResidualWidth = 1.5; // standard deviation of the Gaussian
constexpr float CorrectionGain = 0.7f;
constexpr float LargestCorrection = 0.4f;
constexpr float LeastArea = 0.05f; // keeps the quotient of two small means small
constexpr float IntegralGain = 0.5f;
constexpr float LargestIntegral = 0.45f;

constexpr Index LargeBlock = 1 << 20; // samples: enough work for threads inside one material

/// The two largest fields at every sample of the working lattice.
struct TopTwo
{
  std::vector<float> First, Second;
  std::vector<std::uint16_t> Winner;
};

/// Memory that large materials use one after another: taking it anew each time costs more than some of the steps.
struct Scratch
{
  std::vector<float> Differences, Residual, Area;
};

class JointSmoother
{
public:
  JointSmoother(const Lattice& working, const std::vector<MaterialMask>& materials,
    const JointSmoothingOptions& options, const Monitor& monitor)
    : Working(working)
    , Materials(materials)
    , Options(options)
    , Progress(monitor)
  {
    for (const MaterialMask& material : materials)
    {
      const Vec3 first = working.ToIndex(material.Frame.Origin);
      std::array<Index, 3> offset;
      for (int a = 0; a < 3; ++a)
      {
        offset[a] = std::lround(first[a]);
        if (std::abs(first[a] - double(offset[a])) > 1e-3 || offset[a] < 0 ||
          offset[a] + material.Frame.Dims[a] > working.Dims[a] ||
          std::abs(material.Frame.Spacing[a] / working.Spacing[a] - 1.0) > 1e-6)
        {
          throw std::invalid_argument("'" + material.Name +
            "' is not on the samples of the others. Volume-keeping smoothing needs one grid for all materials.");
        }
      }
      this->Offsets.push_back(offset);
    }
  }

  std::vector<TightenResult> Run()
  {
    const std::size_t count = this->Materials.size();
    this->Bands.resize(count);
    this->Sides.resize(count);
    this->Integrals.resize(count);
    this->Blurs.resize(count);
    this->ForEachMaterial(0.0, 0.1, "Distance",
      [this](std::size_t m, Scratch&)
      {
        const MaterialMask& material = this->Materials[m];
        this->Bands[m] =
          std::make_unique<NarrowBand>(material.Frame, material.Mask, BandReach(this->TightenOptionsOf(m)));
        this->Sides[m] = this->Bands[m]->Pack();
        this->Integrals[m].assign(this->Sides[m].size(), 0.0f);
        this->Blurs[m] = this->BlurOf(m);
      });
    for (int round = 0; round < this->Options.Rounds; ++round)
    {
      const double start = 0.1 + 0.6 * round / this->Options.Rounds, length = 0.6 / this->Options.Rounds;
      this->ForEachMaterial(start, start + 0.5 * length, "Smoothing",
        [this](std::size_t m, Scratch&) { this->Flow(m, FlowSteps, RoundRedistance); });
      this->FindTopTwo();
      this->ForEachMaterial(start + 0.5 * length, start + length, "Keeping volume",
        [this](std::size_t m, Scratch& scratch) { this->Correct(m, scratch); });
    }
    this->ForEachMaterial(
      0.7, 0.75, "Smoothing", [this](std::size_t m, Scratch&) { this->Flow(m, 1, FinalRedistance); });
    this->FindTopTwo();
    std::vector<TightenResult> results(count);
    this->ForEachMaterial(0.75, 1.0, "Tightening",
      [&](std::size_t m, Scratch& scratch)
      {
        this->FindDifferences(m, scratch.Differences);
        this->Bands[m]->Assign(scratch.Differences);
        this->Bands[m]->Redistance(FinalRedistance);
        results[m] = TightenBand(*this->Bands[m], this->Materials[m].Frame, this->TightenOptionsOf(m), Monitor());
        this->Bands[m].reset();
      });
    return results;
  }

private:
  TightenOptions TightenOptionsOf(std::size_t m) const
  {
    TightenOptions options;
    options.Radius = this->Materials[m].Radius;
    options.TightenIterations = this->Options.TightenIterations;
    options.Band = this->Options.Band;
    return options;
  }

  /// Large materials one after another with threads inside, small ones side by side.
  template <typename Body>
  void ForEachMaterial(double start, double end, const char* text, Body&& body)
  {
    std::vector<std::size_t> small;
    for (std::size_t m = 0; m < this->Materials.size(); ++m)
    {
      if (this->Materials[m].Frame.Size() < LargeBlock)
      {
        small.push_back(m);
        continue;
      }
      this->Progress.Step(
        start + (end - start) * double(m) / double(this->Materials.size()), text + (" of " + this->Materials[m].Name));
      body(m, this->LargeScratch);
    }
    this->Progress.Step(end, text);
    ParallelFor(0, Index(small.size()), 1,
      [&](Index first, Index last)
      {
        Scratch scratch;
        for (Index n = first; n < last; ++n)
        {
          body(small[n], scratch);
        }
      });
  }

  void Flow(std::size_t m, int steps, double redistance)
  {
    for (int step = 0; step < steps; ++step)
    {
      this->Bands[m]->SmoothTowards(FlowTime, this->Sides[m], this->Options.Fidelity);
    }
    this->Bands[m]->Redistance(redistance);
  }

  GaussianBlur BlurOf(std::size_t m) const
  {
    const Lattice& frame = this->Materials[m].Frame;
    Lattice inVoxels = frame;
    inVoxels.Spacing /= frame.VoxelSize();
    return GaussianBlur(inVoxels, ResidualWidth, this->Bands[m]->ActiveRows());
  }

  void FindTopTwo()
  {
    const float lowest = std::numeric_limits<float>::lowest();
    this->Top.First.resize(this->Working.Size());
    this->Top.Second.resize(this->Working.Size());
    this->Top.Winner.resize(this->Working.Size());
    const Index slice = Index(this->Working.Dims[0]) * this->Working.Dims[1];
    ParallelFor(0, this->Working.Dims[2], 1,
      [&](Index first, Index last)
      {
        for (Index k = first; k < last; ++k)
        {
          std::fill_n(this->Top.First.begin() + k * slice, slice, lowest);
          std::fill_n(this->Top.Second.begin() + k * slice, slice, lowest);
          std::fill_n(this->Top.Winner.begin() + k * slice, slice, std::uint16_t(0xFFFF));
          for (std::size_t m = 0; m < this->Materials.size(); ++m)
          {
            const auto& offset = this->Offsets[m];
            const auto& dims = this->Materials[m].Frame.Dims;
            if (k < offset[2] || k >= offset[2] + dims[2])
            {
              continue;
            }
            for (Index j = 0; j < dims[1]; ++j)
            {
              this->Compete(m, this->Bands[m]->Row(j, k - offset[2]), this->Working.At(offset[0], offset[1] + j, k));
            }
          }
        }
      });
  }

  void Compete(std::size_t m, const float* values, Index start)
  {
    for (Index i = 0; i < this->Materials[m].Frame.Dims[0]; ++i)
    {
      const float value = values[i];
      float &first = this->Top.First[start + i], &second = this->Top.Second[start + i];
      if (value > first)
      {
        second = first;
        first = value;
        this->Top.Winner[start + i] = std::uint16_t(m);
      }
      else if (value > second)
      {
        second = value;
      }
    }
  }

  /// Half the difference to the largest of the other fields, of the active samples.
  void FindDifferences(std::size_t m, std::vector<float>& differences) const
  {
    const NarrowBand& band = *this->Bands[m];
    const auto& offset = this->Offsets[m];
    const float end = float(BandReach(this->TightenOptionsOf(m)));
    differences.resize(this->Sides[m].size());
    band.ForActive(
      [&](Index packed, Index i, Index j, Index k, Index count)
      {
        const float* const own = band.Row(j, k) + i;
        const Index at = this->Working.At(offset[0] + i, offset[1] + j, offset[2] + k);
        for (Index n = 0; n < count; ++n)
        {
          const float other = this->Top.Winner[at + n] == m ? this->Top.Second[at + n] : this->Top.First[at + n];
          differences[packed + n] = 0.5f * (own[n] - std::max(other, -end));
        }
      });
  }

  void Correct(std::size_t m, Scratch& scratch)
  {
    const Lattice& frame = this->Materials[m].Frame;
    NarrowBand& band = *this->Bands[m];
    this->FindDifferences(m, scratch.Differences);
    this->Blurs[m]->Clear(scratch.Residual);
    this->Blurs[m]->Clear(scratch.Area);
    const float* const sides = this->Sides[m].data();
    band.ForActive(
      [&](Index packed, Index i, Index j, Index k, Index count)
      {
        const Index at = frame.At(i, j, k);
        for (Index n = 0; n < count; ++n)
        {
          const float d = scratch.Differences[packed + n];
          const float inside = std::clamp(0.5f + d, 0.0f, 1.0f);
          scratch.Residual[at + n] = (sides[packed + n] > 0 ? 1.0f : 0.0f) - inside;
          scratch.Area[at + n] = std::abs(d) < 0.5f ? 1.0f : 0.0f;
        }
      });
    this->Blurs[m]->Apply(scratch.Residual);
    this->Blurs[m]->Apply(scratch.Area);
    float* const integral = this->Integrals[m].data();
    band.ForActive(
      [&](Index packed, Index i, Index j, Index k, Index count)
      {
        const Index at = frame.At(i, j, k);
        for (Index n = 0; n < count; ++n)
        {
          const float correction =
            std::clamp(CorrectionGain * scratch.Residual[at + n] / (scratch.Area[at + n] + LeastArea),
              -LargestCorrection, LargestCorrection);
          float& sum = integral[packed + n];
          scratch.Differences[packed + n] += correction + sum;
          sum = std::clamp(sum + IntegralGain * correction, -LargestIntegral, LargestIntegral);
        }
      });
    band.Assign(scratch.Differences);
  }

  const Lattice& Working;
  const std::vector<MaterialMask>& Materials;
  const JointSmoothingOptions& Options;
  const Monitor& Progress;
  std::vector<std::array<Index, 3>> Offsets;
  std::vector<std::unique_ptr<NarrowBand>> Bands;
  std::vector<std::vector<float>> Sides;     // the first distances of the active samples: > 0 where the label is
  std::vector<std::vector<float>> Integrals; // of the corrections
  std::vector<std::optional<GaussianBlur>> Blurs;
  TopTwo Top;
  Scratch LargeScratch;
};

void CheckOptions(const std::vector<MaterialMask>& materials, const JointSmoothingOptions& options)
{
  if (!(options.Fidelity >= 0) || !std::isfinite(options.Fidelity))
  {
    throw std::invalid_argument("Fidelity is " + std::to_string(options.Fidelity) +
      "; expected 0 or more, in units of curvature (1 / voxel), such as 0.85.");
  }
  if (options.Rounds < 0)
  {
    throw std::invalid_argument("The number of rounds of smoothing must not be negative.");
  }
  for (const MaterialMask& material : materials)
  {
    TightenOptions tighten;
    tighten.Radius = material.Radius;
    tighten.TightenIterations = options.TightenIterations;
    tighten.Band = options.Band;
    CheckTightenOptions(tighten);
  }
}
}

std::vector<TightenResult> SmoothJointly(const Lattice& working, const std::vector<MaterialMask>& materials,
  const JointSmoothingOptions& options, const Monitor& monitor)
{
  CheckOptions(materials, options); // here: small materials run in threads, which must not throw
  return JointSmoother(working, materials, options, monitor).Run();
}
}
