// SPDX-License-Identifier: BSD-3-Clause
// Label images at the door: any numeric array becomes compact ids.
#ifndef LabelImage_h
#define LabelImage_h

#include "Core/GridFrame.h"

#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkInformation;

namespace LabelMesh
{
struct LabelImage
{
  GridFrame Frame;             ///< of the samples; those of cell data lie at the cells' centres
  std::vector<Label> Labels;   ///< ascending; those that occur
  std::vector<MaterialId> Ids; ///< per sample, x fastest: positions in Labels
};

/// A label's id; that of the next larger label where it does not occur.
MaterialId IdOf(const LabelImage& image, Label label);

/// The samples of an image's cells: their centres.
GridFrame FrameOfCells(const GridFrame& points);

/// Reads the labels of a point array (or a cell array) of an image: any integer type, or floats that hold integers.
/// Throws std::invalid_argument with a sentence for the user: no array, several components, a fraction, an image that
/// is not three-dimensional, or more labels than ids.
LabelImage ReadLabelImage(vtkImageData* image, vtkDataArray* array, bool cellData);

/// Gives every label that is not in `kept` (ascending) the background's label, which may be new to the image.
void MergeIntoBackground(LabelImage& image, const std::vector<Label>& kept, Label background);

/// The sample lattice that an image will have, from what is known before there is data. False when nothing is.
bool PromisedFrame(vtkInformation* inInfo, bool cellData, GridFrame& frame);
/// Whether the array to process is cell data, as far as can be told before there is data.
bool PromisesCellData(vtkInformation* arrayInfo, vtkInformation* inInfo);
}

#endif
