// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of NarrowBand: one step of a flow on runs of samples, from one array to another.
#ifndef LabelMesh_Core_BandFlows_h
#define LabelMesh_Core_BandFlows_h

#include "BandLayout.h"

#include <vector>

namespace LabelMesh
{
/// The second-order differences of a function times their denominators.
struct CurvatureStencil
{
  CurvatureStencil(const Lattice& frame, float step);

  Index Y, Z;
  float Step; ///< voxels squared: the time
  float First[3], Second[3], Mixed[3];
};

/// Differences to the six neighbours.
struct CrossingStencil
{
  explicit CrossingStencil(const Lattice& frame);

  Index Y, Z;
  float Inverse[3];
};

/// Runs of samples that flow between two bounds, which are packed.
struct Mortar
{
  std::vector<BandLayout::Run> Runs;
  std::vector<float> Lower, Upper;

  /// Those samples of a run whose bounds differ.
  void Add(const BandLayout::Run& run, const float* lower, const float* upper);
};

// Curvature flow: phi + step curvature |grad phi|, and what keeps it. See NarrowBand.

void FlowKeepingSides(const CurvatureStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs,
  Index count, float least);
void FlowTowards(const CurvatureStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs,
  Index count, const float* sides, float push, float least);
void FlowBetween(const CurvatureStencil& stencil, const float* phi, float* next, const Mortar& mortar);

/// One upwind step of phi_t = s (1 - |grad phi|), s = -1, 0 or 1 per sample (Godunov's flux).
void FlowUpwind(const CrossingStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs, Index count,
  const float* signs, float step);
/// 1 for samples whose cell, the one between them and their neighbours further on, has corners on both sides, else 0.
void FindCrossedCells(const float* row, Index count, Index y, Index z, std::int32_t* crossed);
/// 1 for samples that have a neighbour on the other side, else 0.
void FindBeside(const float* row, Index count, Index y, Index z, std::int32_t* beside);

/// Samples beside the zero set get their distance to the plane through it (see ZeroCrossing) and sign 0, the others
/// stay and get the sign of theirs.
void PlaceBeside(const CrossingStencil& stencil, const float* phi, float* next, const BandLayout::Run* runs,
  Index count, float* signs);
}

#endif
