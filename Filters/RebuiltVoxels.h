// SPDX-License-Identifier: BSD-3-Clause
// What the indicators say of the voxels, in few numbers: the voxels where it is not their label.
#ifndef RebuiltVoxels_h
#define RebuiltVoxels_h

#include "LabelImage.h"

#include <vector>

class vtkFieldData;
class vtkImageData;

namespace LabelMesh
{
/// The label that an image of rebuilt labels (port 1 of vtkIndicatorReconstruct), on any grid of the same space, has at
/// each sample of another grid; `outside` beyond it. Throws std::invalid_argument when it has no point array "Label".
std::vector<Label> RebuiltLabelsAt(vtkImageData* rebuilt, const GridFrame& frame, Label outside);

/// Field data "RebuiltVoxels", "RebuiltLabels" (int64): the voxels whose rebuilt label is another than theirs, by their
/// position in the volume, x fastest, and that label.
void WriteRebuiltVoxels(vtkFieldData* fieldData, const LabelImage& volume, vtkImageData* rebuilt, Label background);

/// The rebuilt labels of a volume from that field data; empty when it has none. Throws std::invalid_argument when they
/// are those of another volume.
std::vector<Label> ReadRebuiltVoxels(vtkFieldData* fieldData, const LabelImage& volume);
}

#endif
