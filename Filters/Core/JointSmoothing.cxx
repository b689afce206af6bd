// SPDX-License-Identifier: BSD-3-Clause
#include "JointSmoothing.h"

#include "GaussianBlur.h"
#include "NarrowBand.h"
#include "PartKeeping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
// Lengths in voxels, times in voxels squared.
constexpr double FlowTime = 0.2;  // of one step of curvature flow
constexpr int FlowSteps = 2;      // per round
constexpr double RoundBand = 2.5; // half width of the bands while the fields move
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
};

/// Memory that materials use one after another.
struct Scratch
{
  std::shared_ptr<BandMemory> Band = std::make_shared<BandMemory>();
  std::vector<float> Differences, Residual, Area; // packed
};

/// As many of them as threads ask for at once.
class ScratchPool
{
public:
  template <typename Body>
  void With(Body&& body)
  {
    std::unique_ptr<Scratch> scratch = this->Take();
    body(*scratch);
    const std::lock_guard<std::mutex> lock(this->Guard);
    this->Free.push_back(std::move(scratch));
  }

private:
  std::unique_ptr<Scratch> Take()
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    if (this->Free.empty())
    {
      return std::make_unique<Scratch>();
    }
    std::unique_ptr<Scratch> scratch = std::move(this->Free.back());
    this->Free.pop_back();
    return scratch;
  }
  std::mutex Guard;
  std::vector<std::unique_ptr<Scratch>> Free;
};

/// What is kept of a material from one round to the next, for its active samples alone.
struct Field
{
  std::shared_ptr<const BandLayout> Layout;
  std::vector<std::uint8_t> Sides; // 1 where the label is
  std::vector<float> Phi;
  std::vector<float> Integral; // of the corrections
  std::optional<GaussianBlur> Blur;
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

  std::vector<TightenVolumes> Run()
  {
    this->Fields.resize(this->Materials.size());
    const VoxelObjects parts = this->PartsOfLabels();
    this->Distances.resize(this->Materials.size());
    this->ForEachMaterial(0.0, 0.1, "Distance", [this](std::size_t m, Scratch& scratch) { this->Begin(m, scratch); });
    for (int round = 1; round <= this->Options.Rounds; ++round)
    {
      const double start = 0.1 + 0.6 * (round - 1) / this->Options.Rounds, length = 0.6 / this->Options.Rounds;
      this->FindTopTwo();
      this->ForEachMaterial(start, start + length, "Smoothing",
        [this, round](std::size_t m, Scratch& scratch)
        {
          this->Correct(m, scratch);
          this->Flow(m, round, scratch);
        });
    }
    this->FindTopTwo();
    std::vector<TightenVolumes> results(this->Materials.size());
    this->ForEachMaterial(
      0.7, 0.95, "Tightening", [&](std::size_t m, Scratch& scratch) { results[m] = this->Finish(m, scratch); });
    this->KeepParts(parts);
    return results;
  }

private:
  TightenOptions TightenOptionsOf(std::size_t m) const
  {
    TightenOptions options;
    options.Radius = this->Materials[m].Radius;
    options.TightenIterations = this->Options.TightenIterations;
    options.KeepThin = true;
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
      this->Scratches.With([&](Scratch& scratch) { body(m, scratch); });
    }
    this->Progress.Step(end, text);
    ParallelFor(0, Index(small.size()), 1,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          this->Scratches.With([&](Scratch& scratch) { body(small[n], scratch); });
        }
      });
  }

  void Begin(std::size_t m, Scratch& scratch)
  {
    const MaterialMask& material = this->Materials[m];
    Field& field = this->Fields[m];
    NarrowBand band(material.Frame, material.Mask, RoundBand, scratch.Band);
    field.Layout = band.Layout();
    field.Sides = field.Layout->PackSides(material.Mask);
    field.Integral.assign(field.Sides.size(), 0.0f);
    field.Blur.emplace(*field.Layout, ResidualWidth);
    band.Pack(field.Phi);
    this->Flow(m, 0, scratch);
  }

  /// The flow after `round` corrections; the last one has nothing after it that would need a long step.
  void Flow(std::size_t m, int round, Scratch& scratch)
  {
    Field& field = this->Fields[m];
    const bool last = round == this->Options.Rounds;
    std::vector<float>& sides = scratch.Area;
    sides.resize(field.Sides.size());
    std::transform(
      field.Sides.begin(), field.Sides.end(), sides.begin(), [](std::uint8_t side) { return side ? 1.0f : -1.0f; });
    NarrowBand band(field.Layout, RoundBand, field.Phi, scratch.Band);
    for (int step = 0; step < (last ? 1 : FlowSteps); ++step)
    {
      band.SmoothTowards(FlowTime, sides, this->Options.Fidelity);
    }
    band.Redistance(last ? FinalRedistance : RoundRedistance);
    band.Pack(field.Phi);
  }

  TightenVolumes Finish(std::size_t m, Scratch& scratch)
  {
    const MaterialMask& material = this->Materials[m];
    const TightenOptions options = this->TightenOptionsOf(m);
    this->FindDifferences(m, scratch.Differences);
    NarrowBand band(this->Fields[m].Layout, RoundBand, scratch.Differences, scratch.Band);
    this->Fields[m] = Field();
    band.Redistance(FinalRedistance);
    band.Widen(material.Mask, BandReach(options));
    this->Distances[m] = material.Place();
    return TightenBand(band, material.Frame, options, Monitor(), this->Distances[m]);
  }

  /// The parts of the masks, as labels of the working lattice.
  VoxelObjects PartsOfLabels() const
  {
    const int none = int(this->Materials.size());
    std::vector<MaterialId> ids(static_cast<std::size_t>(this->Working.Size()), MaterialId(none));
    for (std::size_t m = 0; m < this->Materials.size(); ++m)
    {
      const Lattice& frame = this->Materials[m].Frame;
      const auto& offset = this->Offsets[m];
      ParallelFor(0, Index(frame.Dims[1]) * frame.Dims[2], 0,
        [&](Index first, Index last)
        {
          for (Index row = first; row < last; ++row)
          {
            const Index j = row % frame.Dims[1], k = row / frame.Dims[1];
            const std::uint8_t* const mask = this->Materials[m].Mask + frame.At(0, j, k);
            MaterialId* const to = ids.data() + this->Working.At(offset[0], offset[1] + j, offset[2] + k);
            for (Index i = 0; i < frame.Dims[0]; ++i)
            {
              to[i] = mask[i] ? MaterialId(m) : to[i];
            }
          }
        });
    }
    return FindVoxelParts(this->Working.Dims, ids, ids.front(), none + 1);
  }

  void KeepParts(const VoxelObjects& parts)
  {
    this->Top = TopTwo();
    std::vector<PartField> fields;
    for (std::size_t m = 0; m < this->Materials.size(); ++m)
    {
      const float end = float(this->Options.Band * this->Working.VoxelSize());
      fields.push_back({ this->Materials[m].Frame, this->Offsets[m], this->Distances[m], -end });
    }
    LabelMesh::KeepParts(this->Working, fields, parts, PartKeepingOptions(), this->Progress.Part(0.95, 1.0));
  }

  /// The sample of the working lattice that a sample of a material's grown lattice is.
  Index InWorking(std::size_t m, Index sample) const
  {
    const auto& offset = this->Offsets[m];
    const std::array<int, 3> at = this->Fields[m].Layout->Frame().Coordinates(sample);
    constexpr Index margin = BandLayout::Margin;
    return this->Working.At(offset[0] + at[0] - margin, offset[1] + at[1] - margin, offset[2] + at[2] - margin);
  }

  void FindTopTwo()
  {
    const float lowest = std::numeric_limits<float>::lowest();
    this->Top.First.resize(this->Working.Size());
    this->Top.Second.resize(this->Working.Size());
    const Index slice = Index(this->Working.Dims[0]) * this->Working.Dims[1];
    ParallelFor(0, this->Working.Dims[2], 1,
      [&](Index first, Index last)
      {
        for (Index k = first; k < last; ++k)
        {
          std::fill_n(this->Top.First.begin() + k * slice, slice, lowest);
          std::fill_n(this->Top.Second.begin() + k * slice, slice, lowest);
          for (std::size_t m = 0; m < this->Materials.size(); ++m)
          {
            const Index own = k - this->Offsets[m][2];
            if (own >= 0 && own < this->Materials[m].Frame.Dims[2])
            {
              this->Compete(m, own + BandLayout::Margin);
            }
          }
        }
      });
  }

  /// A material's active samples in slice k of its grown lattice. Where a field is the largest without being active,
  /// no other field is active.
  void Compete(std::size_t m, Index k)
  {
    const Field& field = this->Fields[m];
    const BandLayout& layout = *field.Layout;
    const float* values = field.Phi.data() + layout.Slice(k).Packed;
    for (Index r = layout.Slice(k).Run; r < layout.Slice(k + 1).Run; ++r)
    {
      const BandLayout::Run& run = layout.Runs()[r];
      const Index start = this->InWorking(m, run.First);
      float* const first = this->Top.First.data() + start;
      float* const second = this->Top.Second.data() + start;
#pragma omp simd
      for (int i = 0; i < run.Count; ++i)
      {
        const float loser = values[i] > first[i] ? first[i] : values[i];
        second[i] = second[i] > loser ? second[i] : loser;
        first[i] = first[i] > values[i] ? first[i] : values[i];
      }
      values += run.Count;
    }
  }

  /// Half the difference to the largest of the other fields, of the active samples.
  void FindDifferences(std::size_t m, std::vector<float>& differences) const
  {
    const Field& field = this->Fields[m];
    const float end = float(RoundBand);
    differences.resize(field.Phi.size());
    field.Layout->ForRuns(
      [&](Index sample, Index count, Index packed)
      {
        const Index at = this->InWorking(m, sample);
        const float *const first = this->Top.First.data() + at, *const second = this->Top.Second.data() + at;
        const float* const own = field.Phi.data() + packed;
        float* const to = differences.data() + packed;
#pragma omp simd
        for (Index n = 0; n < count; ++n)
        {
          // The largest field is one's own, or another that is as large, which is the second then.
          const float other = own[n] < first[n] ? first[n] : second[n];
          to[n] = 0.5f * (own[n] - (other > -end ? other : -end));
        }
      });
  }

  void Correct(std::size_t m, Scratch& scratch)
  {
    Field& field = this->Fields[m];
    const BandLayout& layout = *field.Layout;
    const Index count = layout.NumberOfActive();
    std::vector<float>&differences = scratch.Differences, &residual = scratch.Residual, &area = scratch.Area;
    this->FindDifferences(m, differences);
    residual.resize(differences.size());
    area.resize(differences.size());
    ParallelFor(0, count, 0,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          const float d = differences[n], share = 0.5f + d;
          const float inside = share < 0.0f ? 0.0f : share > 1.0f ? 1.0f : share;
          residual[n] = (field.Sides[n] ? 1.0f : 0.0f) - inside;
          area[n] = std::abs(d) < 0.5f ? 1.0f : 0.0f;
        }
      });
    float* const box = scratch.Band->Phi.Sized(layout.Frame().Size());
    field.Blur->Apply(layout, residual.data(), box);
    field.Blur->Apply(layout, area.data(), box);
    ParallelFor(0, count, 0,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          const float correction =
            std::clamp(CorrectionGain * residual[n] / (area[n] + LeastArea), -LargestCorrection, LargestCorrection);
          float& sum = field.Integral[n];
          field.Phi[n] = differences[n] + (correction + sum);
          sum = std::clamp(sum + IntegralGain * correction, -LargestIntegral, LargestIntegral);
        }
      });
  }

  const Lattice& Working;
  const std::vector<MaterialMask>& Materials;
  const JointSmoothingOptions& Options;
  const Monitor& Progress;
  std::vector<std::array<Index, 3>> Offsets;
  std::vector<Field> Fields;
  std::vector<float*> Distances; ///< results
  TopTwo Top;
  ScratchPool Scratches;
};

void CheckOptions(const std::vector<MaterialMask>& materials, const JointSmoothingOptions& options)
{
  if (!(options.Fidelity >= 0) || !std::isfinite(options.Fidelity))
  {
    throw std::invalid_argument("Fidelity is " + std::to_string(options.Fidelity) +
      "; expected 0 or more, in units of curvature (1 / voxel), such as 0.6.");
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

std::vector<TightenVolumes> SmoothJointly(const Lattice& working, const std::vector<MaterialMask>& materials,
  const JointSmoothingOptions& options, const Monitor& monitor)
{
  CheckOptions(materials, options); // here: small materials run in threads, which must not throw
  return JointSmoother(working, materials, options, monitor).Run();
}
}
