// SPDX-License-Identifier: BSD-3-Clause
#include "LossLedger.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace LabelMesh
{
namespace
{
using Pair = std::array<MaterialId, 2>;

/// Whether a volume is known to be nothing.
bool Gone(const std::vector<double>& volumes, MaterialId id)
{
  return id < volumes.size() && volumes[id] <= 0.0;
}

class Ledger
{
public:
  explicit Ledger(const LedgerInput& input)
    : Input(input)
    , KeptInMesh(input.Voxels.Parts.size(), false)
    , KeptByTighten(input.Voxels.Parts.size(), false)
    , Sampled(input.Voxels.Parts.size(), false)
  {
    for (const VoxelRun& run : input.Voxels.Runs)
    {
      const MaterialId id = input.Voxels.Parts[run.Part].Id;
      for (Index v = run.First; v < run.Last; ++v)
      {
        this->KeptInMesh[run.Part] = this->KeptInMesh[run.Part] || input.MeshIds[v] == id;
        if (!input.TightIds.empty())
        {
          this->KeptByTighten[run.Part] = this->KeptByTighten[run.Part] || input.TightIds[v] == id;
        }
      }
    }
    this->KeptInMesh[0] = true; // space outside
    if (!input.TightIds.empty())
    {
      this->FindTightPairs();
    }
    this->FindSampledPairs();
  }

  std::vector<Loss> Losses()
  {
    std::vector<Loss> losses;
    std::vector<bool> lost(this->Input.Voxels.Objects.size(), false);
    for (std::size_t id = 0; id < lost.size(); ++id)
    {
      lost[id] = this->Input.Voxels.Objects[id].Voxels > 0 && this->Input.Triangles[id] == 0;
    }
    this->FindSampledParts(lost);
    this->AddParts(lost, losses);
    for (const VoxelContact& contact : this->Input.Voxels.Contacts)
    {
      if (this->Input.Pairs.count(contact.Ids) == 0)
      {
        Loss loss;
        loss.Kind = Loss::TouchingPair;
        loss.Materials = contact.Ids;
        loss.Stage = this->StageOfPair(contact.Ids);
        loss.Voxels = contact.Faces;
        losses.push_back(loss);
      }
    }
    return losses;
  }

private:
  void FindTightPairs()
  {
    const std::array<int, 3>& dims = this->Input.Dims;
    const std::array<Index, 3> step{ 1, dims[0], Index(dims[0]) * dims[1] };
    const std::vector<MaterialId>& ids = this->Input.TightIds;
    const MaterialId outside = this->Input.Voxels.Parts[0].Id;
    const auto touch = [this](MaterialId a, MaterialId b)
    {
      if (a != b)
      {
        this->TightPairs.insert({ std::min(a, b), std::max(a, b) });
      }
    };
    for (Index v = 0; v < Index(ids.size()); ++v)
    {
      const std::array<Index, 3> at{ v % dims[0], v / step[1] % dims[1], v / step[2] };
      for (int a = 0; a < 3; ++a)
      {
        touch(ids[v], at[a] + 1 < dims[a] ? ids[v + step[a]] : outside);
        touch(ids[v], at[a] > 0 ? ids[v] : outside);
      }
    }
  }

  void FindSampledPairs()
  {
    for (const ParticleSite& particle : this->Input.Particles)
    {
      for (const MaterialId a : particle.Materials)
      {
        this->SampledIds.insert(a);
        for (const MaterialId b : particle.Materials)
        {
          if (a < b)
          {
            this->SampledPairs.insert({ a, b });
          }
        }
      }
    }
  }

  /// Looks for particles within a voxel of the parts that the mesh has not.
  void FindSampledParts(const std::vector<bool>& lost)
  {
    std::map<Index, Index> partOf; // voxels of those parts
    for (const VoxelRun& run : this->Input.Voxels.Runs)
    {
      if (!this->KeptInMesh[run.Part] && !lost[this->Input.Voxels.Parts[run.Part].Id])
      {
        for (Index v = run.First; v < run.Last; ++v)
        {
          partOf.emplace(v, run.Part);
        }
      }
    }
    if (partOf.empty())
    {
      return;
    }
    const std::array<int, 3>& dims = this->Input.Dims;
    for (const ParticleSite& particle : this->Input.Particles)
    {
      for (int n = 0; n < 27; ++n)
      {
        const std::array<int, 3> offset{ n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
        Index v = 0;
        bool inside = true;
        for (int a = 2; a >= 0; --a)
        {
          const double at = std::round(particle.Position[a]) + offset[a];
          inside = inside && at >= 0 && at < dims[a];
          v = v * dims[a] + (inside ? Index(at) : 0);
        }
        const auto found = inside ? partOf.find(v) : partOf.end();
        if (found != partOf.end() && particle.Materials.Contains(this->Input.Voxels.Parts[found->second].Id))
        {
          this->Sampled[found->second] = true;
        }
      }
    }
  }

  /// The stage of something that has a mask. `tight`, `sampled`: whether it is there after those stages, if they are
  /// known.
  LossStage StageOf(bool tightenedAway, bool tight, bool sampled) const
  {
    const bool knowTight = !this->Input.TightIds.empty(), knowSampled = !this->Input.Particles.empty();
    if (tightenedAway || (knowTight && !tight))
    {
      return LossStage::Tighten;
    }
    if (knowSampled)
    {
      return sampled ? LossStage::Mesh : knowTight ? LossStage::Sample : LossStage::Tighten;
    }
    return knowTight ? LossStage::AfterTighten : LossStage::Unknown;
  }

  LossStage StageOfLabel(MaterialId id, bool tight) const
  {
    if (Gone(this->Input.MaskVolumes, id))
    {
      return LossStage::Split;
    }
    const LossStage stage = this->StageOf(Gone(this->Input.TightVolumes, id), tight, this->SampledIds.count(id) > 0);
    // A label with a volume after tightening was not lost there, whether or not its voxels' centres show it.
    const bool hasVolume = id < this->Input.TightVolumes.size() && this->Input.TightVolumes[id] > 0.0;
    if (hasVolume && (stage == LossStage::Tighten || stage == LossStage::Unknown))
    {
      return this->Input.Particles.empty() ? LossStage::AfterTighten : LossStage::Sample;
    }
    return stage == LossStage::Unknown && id < this->Input.MaskVolumes.size() && this->Input.MaskVolumes[id] > 0.0
      ? LossStage::AfterSplit
      : stage;
  }

  LossStage StageOfPart(Index p) const
  {
    // A particle beside a part may belong to another part of the label: alone it does not prove that the part was
    // there.
    const MaterialId id = this->Input.Voxels.Parts[p].Id;
    const LossStage stage = this->StageOf(Gone(this->Input.TightVolumes, id), this->KeptByTighten[p], this->Sampled[p]);
    return stage == LossStage::Mesh && this->Input.TightIds.empty() ? LossStage::AfterSplit : stage;
  }

  LossStage StageOfPair(const Pair& pair) const
  {
    // Space outside is always there; a volume full of labels has no background of its own.
    const auto gone = [&](const std::vector<double>& volumes)
    {
      return std::any_of(pair.begin(), pair.end(),
        [&](MaterialId id) { return id != this->Input.Voxels.Parts[0].Id && Gone(volumes, id); });
    };
    if (gone(this->Input.MaskVolumes))
    {
      return LossStage::Split;
    }
    return this->StageOf(
      gone(this->Input.TightVolumes), this->TightPairs.count(pair) > 0, this->SampledPairs.count(pair) > 0);
  }

  void AddParts(const std::vector<bool>& lost, std::vector<Loss>& losses) const
  {
    std::vector<Loss> whole(lost.size());
    std::vector<bool> tight(lost.size(), false);
    std::map<std::pair<MaterialId, LossStage>, Loss> some;
    for (std::size_t p = 1; p < this->Input.Voxels.Parts.size(); ++p)
    {
      const VoxelPart& part = this->Input.Voxels.Parts[p];
      if (lost[part.Id])
      {
        tight[part.Id] = tight[part.Id] || this->KeptByTighten[p];
        this->Add(part, whole[part.Id]);
      }
      else if (!this->KeptInMesh[p])
      {
        this->Add(part, some[{ part.Id, this->StageOfPart(Index(p)) }]);
      }
    }
    for (std::size_t id = 0; id < lost.size(); ++id)
    {
      if (lost[id])
      {
        Loss loss = whole[id];
        loss.Materials[0] = MaterialId(id);
        loss.Stage = this->StageOfLabel(MaterialId(id), tight[id]);
        losses.push_back(loss);
      }
    }
    for (auto& entry : some)
    {
      entry.second.Kind = Loss::SomeParts;
      entry.second.Materials[0] = entry.first.first;
      entry.second.Stage = entry.first.second;
      losses.push_back(entry.second);
    }
  }

  static void Add(const VoxelPart& part, Loss& loss)
  {
    ++loss.Parts;
    loss.Voxels += part.Voxels;
    if (part.Voxels > loss.Largest)
    {
      loss.Largest = part.Voxels;
      loss.Sample = part.First;
    }
  }

  const LedgerInput& Input;
  std::vector<bool> KeptInMesh, KeptByTighten, Sampled; ///< by part
  std::set<Pair> TightPairs, SampledPairs;
  std::set<MaterialId> SampledIds;
};
}

std::vector<Loss> FindLosses(const LedgerInput& input)
{
  return Ledger(input).Losses();
}
}
