// SPDX-License-Identifier: BSD-3-Clause
// How much memory the chain of filters will take, before it takes any.
#ifndef MemoryEstimate_h
#define MemoryEstimate_h

#include "LabelImage.h"

namespace LabelMesh
{
/// Bytes at the peak of vtkLabelMesher with the default sizing, the program and its libraries among them:
///     50 MiB + 17 per sample of all blocks + 8 per sample of the working grid + 1000 per face between two labels,
/// rounded up from a fit to the peaks of nine scans, grain maps and rock models (0.07 to 1.1 GiB). Blocks are the boxes
/// of the labels, the background's being the whole grid, each with its padding. Shorter edges than the default's take
/// more: particles go with the inverse square of the edge length. `resampling`: samples per voxel along each axis.
double EstimateMemory(const LabelImage& image, Label background, int padding, double resampling);

/// Throws std::runtime_error with a sentence when the estimate is above the limit, GiB; 0: no limit.
void RequireMemory(double estimate, double limit);
}

#endif
