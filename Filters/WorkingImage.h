// SPDX-License-Identifier: BSD-3-Clause
// Images made from a material collection: their grid must be known before there is data.
#ifndef WorkingImage_h
#define WorkingImage_h

#include "Core/GridFrame.h"

#include <vector>

class vtkAlgorithm;
class vtkImageData;
class vtkInformation;

namespace LabelMesh
{
/// The source grid and padding of the collection on input port 0. Where no filter of ours published them, as with a
/// reader, the input is brought up to date to look into it. False when that does not help: an empty collection.
bool FindFrame(vtkAlgorithm* filter, vtkInformation* inInfo, GridFrame& source, int& padding);

/// Whole extent, origin, spacing and direction of an image output; an empty one when `frame` is null.
void PublishImage(vtkInformation* outInfo, const GridFrame* frame);

/// Adds a float32 point array to an image whose extent is set.
void AddImageArray(vtkImageData* image, const char* name, const std::vector<float>& values);
}

#endif
