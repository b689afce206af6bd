// SPDX-License-Identifier: BSD-3-Clause
// What the voxels have and the mesh has not, and the first stage after which it is gone.
#ifndef LabelMesh_Core_LossLedger_h
#define LabelMesh_Core_LossLedger_h

#include "Particles.h"
#include "VoxelObjects.h"

#include <array>
#include <set>
#include <vector>

namespace LabelMesh
{
/// In the order in which data flows. AfterSplit and AfterTighten: one of the stages from Tighten, or from sampling, on;
/// what would tell them apart was not given.
enum class LossStage
{
  Unknown,
  Split,
  AfterSplit,
  Tighten,
  AfterTighten,
  Sample,
  Mesh
};

struct Loss
{
  enum Kinds
  {
    WholeLabel,  ///< no triangle has the label
    SomeParts,   ///< connected parts of a label of which no voxel has it in the mesh
    Dropped,     ///< a component that was too small, given to the second material on request
    TouchingPair ///< labels whose voxels share faces, but no triangle
  };
  Kinds Kind = WholeLabel;
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial }; ///< a pair's, ascending; else the first (and what it was given to)
  LossStage Stage = LossStage::Unknown;
  Index Parts = 0;   ///< lost; of a pair 0
  Index Voxels = 0;  ///< of the lost parts, or faces of voxels of the pair
  Index Largest = 0; ///< voxels of the largest lost part
  Index Sample = -1; ///< first voxel of that part; -1 when the loss has no place
};

/// A particle as the ledger needs it.
struct ParticleSite
{
  Vec3 Position = Vec3::Zero(); ///< continuous index in the volume
  MaterialSet Materials;
};

/// All that is known. Vectors by material; empty where a stage was not given.
struct LedgerInput
{
  std::array<int, 3> Dims{ 0, 0, 0 };
  const VoxelObjects& Voxels;                ///< found in them
  const std::vector<MaterialId>& MeshIds;    ///< of the voxels, by the mesh (LabelsByMesh)
  std::vector<Index> Triangles;              ///< of each material
  std::set<std::array<MaterialId, 2>> Pairs; ///< that have triangles, ascending
  std::vector<double> MaskVolumes;           ///< NaN where unknown
  std::vector<double> TightVolumes;          ///< NaN where unknown
  std::vector<MaterialId> TightIds;          ///< of the voxels, by the indicators
  std::vector<ParticleSite> Particles;
};

/// Labels, then parts (one entry per label and stage), then pairs, each ascending. Parts of a label that is lost as a
/// whole are not listed again. The stage:
///  - Split, when a label has voxels and no mask;
///  - Tighten, when what the indicators say of the voxels (TightIds), or else the volume after tightening, is nothing;
///    or, without TightIds, when no particle knows of it: particles lie on all that smoothing has left, if it is not
///    much smaller than their spacing;
///  - Sample, when it is there after tightening but no particle knows of it (for a part: within a voxel of it);
///  - Mesh, when particles know of it; for a part only with TightIds, since the particles beside it may be those of
///    another part.
std::vector<Loss> FindLosses(const LedgerInput& input);
}

#endif
