// SPDX-License-Identifier: BSD-3-Clause
#include "PartKeeping.h"

#include "CubicPoints.h"
#include "DistanceTransform.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace LabelMesh
{
namespace
{
// Lengths in voxels.
constexpr double Deep = 1.25;          // from the surface
constexpr double DeepShare = 0.1;      // of the voxels of a part that has a core
constexpr Index SmallPart = 3000;      // voxels
constexpr double NearReach = 2.5;      // from a part's surface: where its weight is added
constexpr double MeasureReach = 1.3;   // all voxels that share a corner with one of the part
constexpr double RestoreBelow = 0.5;   // of its volume
constexpr float Rivalry = 2.5f;        // fields lower than the largest by this do not win in the same voxel
constexpr float NeighbourReach = 3.0f; // of a neighbour's surface from a part
constexpr float Shell = 0.25f;         // half width of the layer that tells how fast the volume grows
constexpr double LeastGrowth = 0.05;   // of a part's voxels
constexpr double LargestStep = 0.3;    // of a weight
constexpr double LargestWeight = 1.5;
constexpr int Width = 5; // samples along each axis that the points of a voxel depend on
using Cubic = CubicPoints<Width>;

/// A sample near a part, and its distance from the part's voxels, > 0 inside.
struct NearSample
{
  std::array<int, 3> At;
  float Distance = 0.0f;
};

/// What is known of a delicate part.
struct Part
{
  MaterialId Id = NoMaterial;
  Index Voxels = 0;
  std::vector<NearSample> Near;
  std::array<int, 6> Box;              // of Near
  std::vector<MaterialId> Overlapping; // materials whose samples overlap the box, without its own
  std::vector<MaterialId> Neighbours;  // those of them that come near
  double Volume = 0.0, Growth = 0.0;   // now, and per voxel of weight
  double Weight = 0.0;                 // the sum of what was added
  double Step = 0.0;                   // to add
  double Gain = 1.0;                   // of the step that Growth asks for
  bool Restore = false;
};

class Keeper
{
public:
  Keeper(const Lattice& working, const std::vector<PartField>& fields, const VoxelObjects& parts)
    : Working(working)
    , Fields(fields)
    , Unit(float(working.VoxelSize()))
  {
    this->FindDelicate(parts);
  }

  PartKeepingResult Keep(const PartKeepingOptions& options, const Monitor& monitor)
  {
    PartKeepingResult result;
    result.Delicate = Index(this->Parts.size());
    const std::vector<std::uint8_t> all(this->Fields.size(), 1);
    this->FindNeighbours();
    this->MeasureAll(options.Tolerance, all);
    for (Part& part : this->Parts)
    {
      part.Restore = part.Volume < RestoreBelow * double(part.Voxels);
      result.Restored += part.Restore ? 1 : 0;
      result.Adjusted += part.Step != 0.0 ? 1 : 0;
    }
    if (result.Restored > 0)
    {
      this->Restore();
      this->FindNeighbours();
      this->MeasureAll(options.Tolerance, all);
    }
    for (int round = 0; round < options.Rounds; ++round)
    {
      const std::vector<std::uint8_t> stepping = this->Stepping();
      if (std::none_of(stepping.begin(), stepping.end(), [](std::uint8_t s) { return s != 0; }))
      {
        break;
      }
      monitor.Step(double(round) / options.Rounds, "Volumes of small parts");
      this->AddWeights();
      this->MeasureAll(options.Tolerance, stepping);
    }
    return result;
  }

private:
  void FindDelicate(const VoxelObjects& objects)
  {
    const Index count = Index(objects.Parts.size());
    std::vector<Index> deep(static_cast<std::size_t>(count), 0), starts(static_cast<std::size_t>(count) + 1, 0);
    for (const VoxelRun& run : objects.Runs)
    {
      ++starts[run.Part + 1];
      const MaterialId id = objects.Parts[run.Part].Id;
      if (id < this->Fields.size())
      {
        std::array<int, 3> at = this->Working.Coordinates(run.First);
        for (Index v = run.First; v < run.Last; ++v, ++at[0])
        {
          deep[run.Part] += this->Value(id, at[0], at[1], at[2]) > float(Deep) * this->Unit;
        }
      }
    }
    for (Index p = 0; p < count; ++p)
    {
      starts[p + 1] += starts[p];
    }
    std::vector<VoxelRun> runs(objects.Runs.size()); // by part
    std::vector<Index> next(starts.begin(), starts.end() - 1);
    for (const VoxelRun& run : objects.Runs)
    {
      runs[next[run.Part]++] = run;
    }
    std::vector<Index> chosen;
    for (Index p = 1; p < count; ++p) // the first is the space outside
    {
      const VoxelPart& part = objects.Parts[p];
      if (part.Id < this->Fields.size() &&
        (part.Voxels <= SmallPart || double(deep[p]) < DeepShare * double(part.Voxels)))
      {
        chosen.push_back(p);
      }
    }
    this->Parts.resize(chosen.size());
    ParallelFor(0, Index(chosen.size()), 1,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          const Index p = chosen[n];
          this->Parts[n].Id = objects.Parts[p].Id;
          this->Parts[n].Voxels = objects.Parts[p].Voxels;
          this->Surround(this->Parts[n], runs.data() + starts[p], runs.data() + starts[p + 1]);
        }
      });
  }

  /// Finds what is near a part.
  void Surround(Part& part, const VoxelRun* firstRun, const VoxelRun* lastRun) const
  {
    std::array<int, 6> box{ std::numeric_limits<int>::max(), 0, std::numeric_limits<int>::max(), 0,
      std::numeric_limits<int>::max(), 0 };
    for (const VoxelRun* run = firstRun; run != lastRun; ++run)
    {
      const std::array<int, 3> at = this->Working.Coordinates(run->First);
      for (int a = 0; a < 3; ++a)
      {
        box[2 * a] = std::min(box[2 * a], at[a]);
        box[2 * a + 1] = std::max(box[2 * a + 1], at[a] + (a == 0 ? int(run->Last - run->First) - 1 : 0));
      }
    }
    Lattice local;
    local.Spacing = this->Working.Spacing / double(this->Unit);
    for (int a = 0; a < 3; ++a)
    {
      const int margin = int(std::ceil((NearReach + 0.5) / local.Spacing[a]));
      box[2 * a] = std::max(0, box[2 * a] - margin);
      box[2 * a + 1] = std::min(this->Working.Dims[a] - 1, box[2 * a + 1] + margin);
      local.Dims[a] = box[2 * a + 1] - box[2 * a] + 1;
    }
    Sides sides(static_cast<std::size_t>(local.Size()), 0);
    for (const VoxelRun* run = firstRun; run != lastRun; ++run)
    {
      const std::array<int, 3> at = this->Working.Coordinates(run->First);
      std::fill_n(sides.begin() + local.At(at[0] - box[0], at[1] - box[2], at[2] - box[4]), run->Last - run->First, 1);
    }
    std::vector<float> distance(sides.size());
    SignedDistance(local, sides, NearReach + 0.5, distance.data());
    for (Index at = 0; at < local.Size(); ++at)
    {
      if (distance[at] > -float(NearReach))
      {
        const std::array<int, 3> c = local.Coordinates(at);
        part.Near.push_back({ { box[0] + c[0], box[2] + c[1], box[4] + c[2] }, distance[at] });
      }
    }
    part.Box = box;
    for (std::size_t m = 0; m < this->Fields.size(); ++m)
    {
      if (m != part.Id && this->Overlaps(this->Fields[m], box))
      {
        part.Overlapping.push_back(MaterialId(m));
      }
    }
  }

  /// Among the materials around a part, those that may hold some of the space about it. Fields are far from most.
  void FindNeighbours()
  {
    ParallelFor(0, Index(this->Parts.size()), 1,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          Part& part = this->Parts[n];
          part.Neighbours.clear();
          std::copy_if(part.Overlapping.begin(), part.Overlapping.end(), std::back_inserter(part.Neighbours),
            [&](MaterialId m)
            {
              return std::any_of(part.Near.begin(), part.Near.end(),
                [&](const NearSample& near)
                {
                  return near.Distance > -float(MeasureReach) &&
                    this->Value(m, near.At[0], near.At[1], near.At[2]) > -NeighbourReach * this->Unit;
                });
            });
        }
      });
  }

  bool Overlaps(const PartField& field, const std::array<int, 6>& box) const
  {
    for (int a = 0; a < 3; ++a)
    {
      if (box[2 * a + 1] < field.Offset[a] || box[2 * a] >= field.Offset[a] + field.Frame.Dims[a])
      {
        return false;
      }
    }
    return true;
  }

  float* Sample(std::size_t m, Index i, Index j, Index k) const
  {
    const PartField& field = this->Fields[m];
    i -= field.Offset[0];
    j -= field.Offset[1];
    k -= field.Offset[2];
    const auto& dims = field.Frame.Dims;
    return i >= 0 && j >= 0 && k >= 0 && i < dims[0] && j < dims[1] && k < dims[2]
      ? field.Distance + field.Frame.At(i, j, k)
      : nullptr;
  }
  float Value(std::size_t m, Index i, Index j, Index k) const
  {
    const float* const sample = this->Sample(m, i, j, k);
    return sample ? *sample : this->Fields[m].Outside;
  }

  /// A field at the points of a voxel.
  void Interpolate(std::size_t m, const std::array<int, 3>& at, Cubic::Points& points) const
  {
    constexpr Index reach = Width / 2;
    Cubic::Samples samples;
    float* to = samples.data();
    const bool inside = this->Sample(m, at[0] - reach, at[1] - reach, at[2] - reach) &&
      this->Sample(m, at[0] + reach, at[1] + reach, at[2] + reach);
    for (Index k = at[2] - reach; k <= at[2] + reach; ++k)
    {
      for (Index j = at[1] - reach; j <= at[1] + reach; ++j, to += Width)
      {
        if (inside)
        {
          std::copy_n(this->Sample(m, at[0] - reach, j, k), Width, to);
          continue;
        }
        for (Index i = 0; i < Width; ++i)
        {
          to[i] = this->Value(m, at[0] - reach + i, j, k);
        }
      }
    }
    this->Points.Interpolate(samples, points);
  }

  /// The volume of a part, and how fast it grows with its weight.
  void Measure(Part& part) const
  {
    Index inside = 0, beside = 0; // points
    Cubic::Points own, other, values;
    std::vector<MaterialId> rivals;
    for (const NearSample& near : part.Near)
    {
      if (near.Distance < -float(MeasureReach))
      {
        continue;
      }
      const float mine = this->Value(part.Id, near.At[0], near.At[1], near.At[2]);
      bool hopeless = false;
      rivals.clear();
      for (const MaterialId m : part.Neighbours)
      {
        const float theirs = this->Value(m, near.At[0], near.At[1], near.At[2]);
        hopeless = hopeless || theirs > mine + Rivalry * this->Unit;
        if (theirs > mine - Rivalry * this->Unit)
        {
          rivals.push_back(m);
        }
      }
      if (rivals.empty() || hopeless)
      {
        inside += hopeless ? 0 : Cubic::Count;
        continue;
      }
      this->Interpolate(part.Id, near.At, own);
      other.fill(std::numeric_limits<float>::lowest());
      for (const MaterialId m : rivals)
      {
        this->Interpolate(m, near.At, values);
        for (int n = 0; n < Cubic::Count; ++n)
        {
          other[n] = other[n] > values[n] ? other[n] : values[n];
        }
      }
      for (int n = 0; n < Cubic::Count; ++n)
      {
        const float margin = own[n] - other[n];
        inside += margin > 0;
        beside += std::abs(margin) < Shell * this->Unit;
      }
    }
    part.Volume = double(inside) / Cubic::Count;
    part.Growth = double(beside) / Cubic::Count / (2 * double(Shell));
  }

  /// Measures the parts that a change of some materials concerns, and finds what to add to their weights.
  void MeasureAll(double tolerance, const std::vector<std::uint8_t>& changed)
  {
    ParallelFor(0, Index(this->Parts.size()), 1,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          Part& part = this->Parts[n];
          if (changed[part.Id] ||
            std::any_of(part.Neighbours.begin(), part.Neighbours.end(), [&](MaterialId m) { return changed[m]; }))
          {
            this->Measure(part);
            FindStep(part, tolerance);
          }
        }
      });
  }

  static void FindStep(Part& part, double tolerance)
  {
    const double lack = double(part.Voxels) - part.Volume, last = part.Step;
    part.Step = 0.0;
    if (std::abs(lack) > tolerance * double(part.Voxels))
    {
      part.Gain *= last * lack < 0 ? 0.5 : 1.0; // it went too far
      const double growth = std::max(part.Growth, LeastGrowth * double(part.Voxels));
      const double step = std::clamp(part.Gain * lack / growth, -LargestStep, LargestStep);
      part.Step = std::clamp(part.Weight + step, -LargestWeight, LargestWeight) - part.Weight;
    }
  }

  /// Materials of which some part has a step before it.
  std::vector<std::uint8_t> Stepping() const
  {
    std::vector<std::uint8_t> stepping(this->Fields.size(), 0);
    for (const Part& part : this->Parts)
    {
      stepping[part.Id] |= part.Step != 0.0 ? 1 : 0;
    }
    return stepping;
  }

  void AddWeights()
  {
    this->ForMaterials(
      [this](std::size_t m, const std::vector<Index>& own)
      {
        for (const Index n : own)
        {
          Part& part = this->Parts[n];
          part.Weight += part.Step;
          const float step = float(part.Step) * this->Unit;
          for (const NearSample& near : part.Near)
          {
            float* const sample = step != 0.0f ? this->Sample(m, near.At[0], near.At[1], near.At[2]) : nullptr;
            if (sample)
            {
              *sample += step;
            }
          }
        }
      });
  }

  void Restore()
  {
    this->ForMaterials(
      [this](std::size_t m, const std::vector<Index>& own)
      {
        for (const Index n : own)
        {
          for (const NearSample& near : this->Parts[n].Near)
          {
            float* const sample =
              this->Parts[n].Restore ? this->Sample(m, near.At[0], near.At[1], near.At[2]) : nullptr;
            if (sample)
            {
              *sample = std::max(*sample, near.Distance * this->Unit);
            }
          }
        }
        for (const Part& part : this->Parts)
        {
          if (part.Restore && part.Id != m && this->Overlaps(this->Fields[m], part.Box))
          {
            for (const NearSample& near : part.Near)
            {
              if (float* const sample = this->Sample(m, near.At[0], near.At[1], near.At[2]))
              {
                *sample = std::min(*sample, -near.Distance * this->Unit);
              }
            }
          }
        }
      });
  }

  /// body(material, its parts): nobody else writes to that material.
  template <typename Body>
  void ForMaterials(Body&& body)
  {
    std::vector<std::vector<Index>> byMaterial(this->Fields.size());
    for (std::size_t n = 0; n < this->Parts.size(); ++n)
    {
      byMaterial[this->Parts[n].Id].push_back(Index(n));
    }
    ParallelFor(0, Index(byMaterial.size()), 1,
      [&](Index first, Index last)
      {
        for (Index m = first; m < last; ++m)
        {
          body(std::size_t(m), byMaterial[m]);
        }
      });
  }

  const Lattice& Working;
  const std::vector<PartField>& Fields;
  float Unit; ///< a voxel
  Cubic Points;
  std::vector<Part> Parts;
};
}

PartKeepingResult KeepParts(const Lattice& working, const std::vector<PartField>& fields, const VoxelObjects& parts,
  const PartKeepingOptions& options, const Monitor& monitor)
{
  return Keeper(working, fields, parts).Keep(options, monitor);
}
}
