// SPDX-License-Identifier: BSD-3-Clause
// The contract of the material collections: the only place where their VTK data meets Core.
//
// A vtkPartitionedDataSetCollection with one vtkImageData per material (one partition each), ascending by label:
//  - block NAME = material name; one active point array named Mask (uint8), TightDistance or Indicator (float32);
//    block field data Label (int64), Color;
//  - collection field data: Labels, MaterialNames, MaterialColors, BackgroundLabel, VoxelSize, SourceExtent,
//  SourceOrigin,
//    SourceDirection, Padding, Border, IndicatorKernel, and what the stages add; assembly root "Indicators".
// The background is a material with a block of its own, which covers the whole working grid.
#ifndef IndicatorCollection_h
#define IndicatorCollection_h

#include "Core/GridFrame.h"
#include "Core/IndicatorSet.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataArray;
class vtkFieldData;
class vtkImageData;
class vtkInformation;
class vtkPartitionedDataSetCollection;

namespace LabelMesh
{
struct Material
{
  LabelMesh::Label Label = 0;
  std::string Name;
  Vec3 Color = Vec3::Constant(0.7);
};

/// What every stage knows of the whole collection.
struct CollectionHeader
{
  GridFrame Source;        ///< the label image's grid, after resampling
  int Padding = 0;         ///< samples; the working grid is Source.Grown(Padding)
  bool FlatBorder = false; ///< materials end at the faces of the box of the source's voxels
  LabelMesh::Label Background = 0;
  std::vector<Material> Materials; ///< ascending by label, the background among them

  GridFrame WorkingFrame() const { return this->Source.Grown(this->Padding); }
  /// The box of the source's voxels, in its local frame.
  VolumeBox SourceBox() const;
};

GridFrame FrameOf(vtkImageData* image);
void SetFrame(vtkImageData* image, const GridFrame& frame);

/// Default name ("Label_3") and colour (a categorical palette, by label) of a label.
Material DefaultMaterial(LabelMesh::Label label);

/// Writes and reads the materials of field data: Labels, MaterialNames, MaterialColors, BackgroundLabel. Meshes carry
/// them too.
void WriteMaterials(vtkFieldData* fieldData, const std::vector<Material>& materials, LabelMesh::Label background);
std::vector<Material> ReadMaterials(vtkFieldData* fieldData);

void WriteHeader(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header);
/// A collection without blocks and labels (an empty volume) is legal: its header has no materials and no grid.
/// Throws std::invalid_argument with a sentence for the user when the collection does not keep the contract.
CollectionHeader ReadHeader(vtkPartitionedDataSetCollection* collection);

/// Appends a block on `frame` with its name, label and colour, and `values` as its active array (shared).
void AppendBlock(
  vtkPartitionedDataSetCollection* collection, const Material& material, const GridFrame& frame, vtkDataArray* values);
/// The blocks of a collection without samples, for a process that has none of them: each an empty image, with its name,
/// label and colour; and the header.
void AppendEmptyBlocks(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header);
/// The n-th material's image. Throws std::invalid_argument when the block is not one image.
vtkImageData* BlockImage(vtkPartitionedDataSetCollection* collection, unsigned int n);
/// Its samples. Throws std::invalid_argument when it has no float32 point array `arrayName`, naming the filter whose
/// output is expected.
const float* BlockValues(vtkPartitionedDataSetCollection* collection, unsigned int n, const char* arrayName);
/// The same of the uint8 array Mask.
const std::uint8_t* BlockMask(vtkPartitionedDataSetCollection* collection, unsigned int n);

/// Whether the filter before releases its data once the filter has run that this is the input information of.
bool IsGivenUp(vtkInformation* inInfo);
/// Takes an array out of a block of a collection that is given up; null when others hold the block or the array.
vtkSmartPointer<vtkDataArray> TakeArray(
  vtkPartitionedDataSetCollection* collection, unsigned int n, const char* arrayName);

/// An evaluator over the collection's Indicator arrays (shared, not copied: keep the collection alive). With a flat
/// border the space beyond the faces of the volume's box is among its materials.
IndicatorSet MakeIndicatorSet(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header);

/// The source grid must be known before there is data: information keys that every stage copies.
void PublishFrame(vtkInformation* outInfo, const GridFrame& source, int padding);
void UnpublishFrame(vtkInformation* outInfo);
void CopyPublishedFrame(vtkInformation* inInfo, vtkInformation* outInfo);
/// From the keys or, where a reader does not publish them, from the data object if it is there. False when unknown.
bool PublishedFrame(vtkInformation* inInfo, GridFrame& source, int& padding);
}

#endif
