// SPDX-License-Identifier: BSD-3-Clause
// What happens to labels before they become masks: small components go, and grids become finer or coarser.
#ifndef LabelPreparation_h
#define LabelPreparation_h

#include "Core/DelicateParts.h"
#include "LabelImage.h"

#include <string>

class vtkFieldData;

namespace LabelMesh
{
/// Gives components with fewer than `least` voxels away (see Core/SmallComponents.h) and names them in the field data.
/// Labels that are gone are none of the image's any more.
void DropSmall(LabelImage& image, Label background, Index least, vtkFieldData* fieldData);

struct UpsamplingOptions
{
  int Limit = 1; ///< samples per voxel along each axis, at most; 1: nothing is looked for
  Label Background = 0;
  bool FlatBorder = false;
  int Padding = 6;          ///< for the estimate of the memory
  double MemoryLimit = 0.0; ///< GiB; 0: none
};

/// What was chosen, and why.
struct Upsampling
{
  int Factor = 1;                 ///< samples per voxel along each axis
  bool HeldByMemory = false;      ///< the labels ask for more than the memory limit allows
  std::string Reason;             ///< a sentence with the figures; empty where nothing was looked for
  LabelMesh::DelicateParts Parts; ///< whose voxels are repeated as they are
};

/// The least factor that holds what is thin or small (see Core/DelicateParts.h), within both limits.
Upsampling ChooseUpsampling(const LabelImage& image, const UpsamplingOptions& options);

/// Field data "Upsampling" (int32) and "UpsamplingReason" (string); nothing where nothing was looked for.
void WriteUpsampling(vtkFieldData* fieldData, const Upsampling& upsampling);

/// Puts the labels on a grid with `factor` samples per voxel along each axis. Throws std::invalid_argument for a factor
/// that is not positive.
void Resample(LabelImage& image, double factor);
/// The same, with the voxels of delicate parts repeated: interpolation would take the corners of a small part away.
void Resample(LabelImage& image, const Upsampling& upsampling);
}

#endif
