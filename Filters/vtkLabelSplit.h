// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLabelSplit
 * @brief   One mask per material of a label volume: the first stage.
 *
 * Input port 0 (vtkImageData): labels, SetInputArrayToProcess(0, ...), by default the active point or cell scalars; any
 * integer type, or floats that hold integers; negative labels too. Any extent, spacing and direction matrix. Cell data
 * are samples at the cells' centres.
 *
 * Output port 0 (vtkPartitionedDataSetCollection): one vtkImageData per material, ascending by label, the background
 * among them (see IndicatorCollection.h).
 *  - block point data "Mask" (uint8): 1 inside, 0 outside
 *  - block field data "Label" (int64), "Color" (float64 x 3); block name: the material's name
 *  - field data of the collection: Labels (int64), MaterialNames (string), MaterialColors (float64 x 3),
 * BackgroundLabel (int64), SourceExtent (int32 x 6), SourceOrigin (float64 x 3), SourceDirection (float64 x 9),
 * VoxelSize (float64 x 3: the spacing), Padding (int32), Border (int32: 1, with a flat border alone). A block reaches
 * Padding samples beyond its material, and where the spacing is small 5 voxels (geometric means of the spacings), but
 * not beyond the working grid; the background's covers the whole working grid, which is the source grid with
 * Padding samples around it. The same grid is published for filters that make images of it.
 *
 * Method: one pass over the labels finds the materials and their boxes, one pass over each box makes its mask. Space
 * outside the volume, and labels that are not asked for, belong to the background.
 *  - Border: with Flat the outermost labels are continued beyond the volume, for 5 voxels and the largest radius of
 * openings and closings, and the padding is around those. Later stages cut the materials at the faces of the box of
 * voxels, half a voxel beyond the outermost samples: what meets the border ends in a plane there, with the box's edges
 * and corners.
 *  - ResamplingFactor: each label's 0/1 function is interpolated linearly at the new samples and the largest wins. The
 * new grid covers the same voxels; its extent starts at 0. A finer grid keeps thinner parts in vtkTighten.
 *  - MaximumUpsampling: the labels are measured, and where a label has much that is thin or small the whole volume
 * gets a finer grid. Voxels of thin and small parts are repeated, the others interpolated as above. Field data of the
 * output say what was chosen and why: Upsampling (int32), UpsamplingReason (string).
 *  - OpeningRadius, ClosingRadius: binary opening, then closing, of a material by a ball. Other materials' masks do not
 *    change: what an opening takes away goes to the nearest material in later stages, and where a closing overlaps
 * another material the deeper one wins. The background is changed only by a radius of its own.
 *
 * Limits: 65528 labels; memory is that of the boxes, four bytes a sample.
 *
 * Errors: no array of labels, several components, a value that is not an integer, a two-dimensional image, options out
 * of range. Warnings: labels that were asked for and do not occur, a material that its opening took away, nothing but
 * background (the output then has the background's block alone). An empty image gives an empty collection.
 */
#ifndef vtkLabelSplit_h
#define vtkLabelSplit_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <array>  // for colours
#include <map>    // for what materials have of their own
#include <string> // for names
#include <vector> // for the labels

class VTKLABELMESHFILTERS_EXPORT vtkLabelSplit : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkLabelSplit* New();
  vtkTypeMacro(vtkLabelSplit, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The label image, without a pipeline.
  void SetInputData(vtkDataObject* input) { this->SetInputDataInternal(0, input); }

  ///@{
  /// The labels to mesh; all others become background. Default: none given, which means all that occur.
  void AddLabel(vtkIdType label);
  void ClearLabels();
  vtkIdType GetNumberOfLabels() const { return static_cast<vtkIdType>(this->Labels.size()); }
  vtkIdType GetLabel(vtkIdType index) const { return this->Labels.at(static_cast<std::size_t>(index)); }
  ///@}

  ///@{
  /// The label of the background, which space outside the volume has too. Default 0.
  vtkSetMacro(BackgroundLabel, vtkIdType);
  vtkGetMacro(BackgroundLabel, vtkIdType);
  ///@}

  ///@{
  /// Samples of background around the volume. Less than 6 spoils the mesh at the border. Default 6.
  vtkSetClampMacro(Padding, int, 0, 1000);
  vtkGetMacro(Padding, int);
  ///@}

  enum BorderMode
  {
    Closed = 0,
    Flat = 1
  };
  ///@{
  /// What becomes of materials at the border of the volume. Closed: space beyond is background, and surfaces close half
  /// a voxel beyond the outermost samples, rounded. Flat: they end exactly in the faces of the box of voxels; a volume
  /// full of labels comes out as that box. Default Closed.
  vtkSetClampMacro(Border, int, Closed, Flat);
  vtkGetMacro(Border, int);
  void SetBorderToClosed() { this->SetBorder(Closed); }
  void SetBorderToFlat() { this->SetBorder(Flat); }
  ///@}

  ///@{
  /// Samples per voxel along each axis, above 0. Default 1.
  vtkSetMacro(ResamplingFactor, double);
  vtkGetMacro(ResamplingFactor, double);
  ///@}

  ///@{
  /// Samples per voxel along each axis, at most, that the labels may ask for: the least number of them is taken that
  /// holds what is under two voxels thick and components of fewer than 300 voxels (see Core/DelicateParts.h), less
  /// where MemoryLimit does not allow it, with a warning. With ResamplingFactor 1 alone. 1: nothing is looked for.
  /// Default 1.
  vtkSetClampMacro(MaximumUpsampling, int, 1, 4);
  vtkGetMacro(MaximumUpsampling, int);
  ///@}

  ///@{
  /// Connected components (voxels that share a face, an edge or a corner) of a label with fewer voxels are given to the
  /// label that they share most faces with, before anything else. Field data of the output names them: DroppedLabels,
  /// DroppedInto, DroppedVoxels (int64), DroppedPositions (world, of the first voxel). 0: none are. Default 0.
  vtkSetClampMacro(MinimumComponentSize, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(MinimumComponentSize, vtkIdType);
  ///@}

  ///@{
  /// GiB that the whole chain may take by estimate (see Filters/MemoryEstimate.h): larger volumes are an error, before
  /// any work is done. 0: no limit. Default 0.
  vtkSetClampMacro(MemoryLimit, double, 0.0, 1e9);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /// Radius of the opening of every material, voxels of the working grid; 0: none. Default 0.
  vtkSetMacro(OpeningRadius, double);
  vtkGetMacro(OpeningRadius, double);
  ///@}

  ///@{
  /// Radius of the closing of every material, voxels of the working grid; 0: none. Default 0.
  vtkSetMacro(ClosingRadius, double);
  vtkGetMacro(ClosingRadius, double);
  ///@}

  ///@{
  /// Radii for the material with this label, in the place of the common ones. Default: none given.
  void SetMaterialOpeningRadius(vtkIdType label, double radius);
  void ClearMaterialOpeningRadii();
  void SetMaterialClosingRadius(vtkIdType label, double radius);
  void ClearMaterialClosingRadii();
  /// The radius that a label gets: its own, or the common one (0 for the background).
  double GetMaterialOpeningRadius(vtkIdType label) const;
  double GetMaterialClosingRadius(vtkIdType label) const;
  /// The largest of all openings and closings that are asked for.
  double GetLargestRadius() const;
  ///@}

  ///@{
  /// Name of a material, which travels to every output. Default: Label_<label>.
  void SetMaterialName(vtkIdType label, const char* name);
  void ClearMaterialNames();
  std::string GetMaterialName(vtkIdType label) const;
  ///@}

  ///@{
  /// Colour of a material, 0 to 1, which travels to every output. Default: by label, from a categorical palette.
  void SetMaterialColor(vtkIdType label, double red, double green, double blue);
  void ClearMaterialColors();
  void GetMaterialColor(vtkIdType label, double color[3]) const;
  ///@}

protected:
  vtkLabelSplit();
  ~vtkLabelSplit() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<vtkIdType> Labels;
  vtkIdType BackgroundLabel = 0;
  int Padding = 6;
  int Border = Closed;
  double ResamplingFactor = 1.0;
  int MaximumUpsampling = 1;
  vtkIdType MinimumComponentSize = 0;
  double MemoryLimit = 0.0;
  double OpeningRadius = 0.0;
  double ClosingRadius = 0.0;
  std::map<vtkIdType, double> MaterialOpeningRadii;
  std::map<vtkIdType, double> MaterialClosingRadii;
  std::map<vtkIdType, std::string> MaterialNames;
  std::map<vtkIdType, std::array<double, 3>> MaterialColors;

private:
  /// Whether the labels decide on the grid.
  bool Upsamples() const { return this->MaximumUpsampling > 1 && this->ResamplingFactor == 1.0; }
  /// What they ask for: it has to be known before RequestData, so the input is brought up to date.
  double FindUpsampling(vtkInformationVector** inputVector);
  int UpsamplingFactor = 1;                            // found last,
  std::array<vtkMTimeType, 2> UpsamplingState{ 0, 0 }; // when the input and this were last modified then

  vtkLabelSplit(const vtkLabelSplit&) = delete;
  void operator=(const vtkLabelSplit&) = delete;
};

#endif
