// SPDX-License-Identifier: BSD-3-Clause
// The one evaluator of the materials' indicator functions.
#ifndef LabelMesh_Core_IndicatorSet_h
#define LabelMesh_Core_IndicatorSet_h

#include "Lattice.h"

#include <string>
#include <vector>

namespace LabelMesh
{
/// One material's indicator samples: signed distance in world length, > 0 inside. Values are not owned.
struct IndicatorBlock
{
  LabelMesh::Label Label = 0;
  Lattice Frame;                 ///< in the local frame of the set
  const float* Values = nullptr; ///< Frame.Size() samples
  double Outside = -1.0;         ///< the indicator beyond the block; the background's is positive
};

/// A material and its indicator at some point.
struct RankedMaterial
{
  MaterialId Material = NoMaterial;
  double Value = 0.0;
};

/// A short ordered list of materials.
struct MaterialSpan
{
  const MaterialId* First = nullptr;
  int Count = 0;
  const MaterialId* begin() const { return this->First; }
  const MaterialId* end() const { return this->First + this->Count; }
};

/// The indicator functions f_i of all materials (paper, section 3): value, gradient and Hessian by separable
/// convolution with the interpolating 4^3 Catmull-Rom spline (paper, section 5.1), and which materials can be the
/// largest near a point. Positions are in the local frame of the working lattice.
///
/// Sparse: the work at a point depends on the materials near it, not on how many there are.
/// Const after construction and safe to ask from many threads.
class IndicatorSet
{
public:
  static constexpr int TileSize = 4; ///< cells of the working lattice along each axis that share their candidates

  /// `working` is the lattice that covers every block; blocks are ordered by label by the caller (checked).
  /// Throws std::invalid_argument when there is no block, labels are not ascending, or there are 65535 or more.
  IndicatorSet(std::vector<IndicatorBlock> blocks, LabelMesh::Label background, const Lattice& working);

  int NumberOfMaterials() const { return int(this->Blocks.size()); }
  LabelMesh::Label LabelOf(MaterialId m) const { return this->Blocks[m].Label; }
  const IndicatorBlock& Block(MaterialId m) const { return this->Blocks[m]; }
  /// NoMaterial when no block has the background label.
  MaterialId Background() const { return this->Background_; }
  const Lattice& Working() const { return this->Working_; }
  double VoxelSize() const { return this->Working_.VoxelSize(); }

  double Value(MaterialId m, const Vec3& x) const;
  double ValueAndGradient(MaterialId m, const Vec3& x, Vec3& gradient) const;
  /// f_a - f_b and its gradient, for less than two evaluations where both blocks are samples of the working lattice.
  double Difference(MaterialId a, MaterialId b, const Vec3& x, Vec3& gradient) const;
  double ValueGradientHessian(MaterialId m, const Vec3& x, Vec3& gradient, Mat3& hessian) const;

  /// The materials that can be the largest anywhere in the tile of x, ascending. Never empty.
  MaterialSpan Candidates(const Vec3& x) const;
  /// The (at most k) largest materials at x among the candidates, largest first, ties to the smaller id.
  /// Returns how many were written.
  int Largest(const Vec3& x, int k, RankedMaterial* ranked) const;
  MaterialId LargestMaterial(const Vec3& x) const;
  /// The largest indicator among candidates that are not in [excluded, excluded + count); NoMaterial if none.
  RankedMaterial LargestBut(const Vec3& x, const MaterialId* excluded, int count) const;
  /// True when a third material is larger at x than a and b, which are equal there (to first order). Asks the samples
  /// first, which mostly tell.
  bool IsBeaten(MaterialId a, MaterialId b, const Vec3& x) const;

  /// The largest material at every sample of the working lattice.
  const std::vector<MaterialId>& Labels() const { return this->Labels_; }

private:
  /// The samples of the working lattice that a block covers, and where its own zero lies if their samples coincide.
  struct SampleBox
  {
    std::array<Index, 3> First{}, Last{}, Offset{};
    bool Aligned = false;
  };
  SampleBox WorkingSamples(const Lattice& block) const;
  /// Fills Labels_; returns the largest indicator at every working sample.
  std::vector<float> FindLabels();
  void FindCandidates(const std::vector<float>& largest);
  /// Appends m to each tile of a layer (constant z) that it can win in.
  void FindTilesOf(MaterialId m, Index tileLayer, const std::vector<float>& largest,
    std::vector<std::vector<MaterialId>>& tiles) const;
  void FindAlignedTilesOf(MaterialId m, Index tileLayer, const std::vector<float>& largest,
    std::vector<std::vector<MaterialId>>& tiles) const;
  Index TileOf(const Vec3& x) const;
  /// False when the sample next to x shows that m is not the largest at x.
  bool CanWinAt(MaterialId m, const Vec3& x) const;
  /// How far below the largest at the next sample an aligned block may be and win.
  double Slack() const;

  std::vector<IndicatorBlock> Blocks;
  MaterialId Background_ = NoMaterial;
  Lattice Working_;
  std::vector<SampleBox> Boxes; // per block
  std::vector<MaterialId> Labels_;
  // Tiles of TileSize^3 cells of the working lattice; tile t has CandidateIds[TileStarts[t] .. TileStarts[t + 1]).
  std::array<int, 3> TileDims{ 0, 0, 0 };
  std::vector<Index> TileStarts;
  std::vector<MaterialId> CandidateIds;
};
}

#endif
