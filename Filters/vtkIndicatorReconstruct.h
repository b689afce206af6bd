// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIndicatorReconstruct
 * @brief   From tightened distances to the materials' indicator functions; the label image rebuilt from them.
 *
 * The indicator function f_i of a material (paper, sections 3 and 5.1) is the smooth function that the interpolating
 * 4^3 Catmull-Rom spline makes of the samples of its distance. This filter makes the samples; the stages after it
 * interpolate.
 *
 * Input (vtkPartitionedDataSetCollection): tightened distances, from vtkTighten; block array "TightDistance".
 *
 * Output port 0 (vtkPartitionedDataSetCollection): the same blocks on the same grids, with names, field data "Label"
 * and "Color"; point data
 *  - "Indicator" (float32): > 0 inside, world length
 * The collection's field data are passed on; "IndicatorKernel" (string) is "CatmullRom".
 *
 * Output port 1 (vtkImageData): on the source grid, or with ImageResolution samples per voxel along each axis, over the
 * same space; point data
 *  - "Label" (int64): of the material with the largest indicator; the active scalars
 *  - "Margin" (float32): the largest indicator minus the second, world length: how far from an interface. Farther
 *    from it than other materials' indicators are known: twice the largest.
 *  - "InsideOutside_<label>" (float32), for each inspected label: f_i - max over j != i of f_j (equation 1), world
 *    length, > 0 where the material is present; the maximum is the smooth one of equations 10 and 11
 *  - "CellIndicator" (float32), for two to four inspected labels: the sum of their squares (equations 2 to 4), world
 *    length squared, zero on the 2-, 1- or 0-cell where they meet
 *
 * Perturbation: exactly symmetric volumes (four boxes along a line, eight around a point) have junctions of more than
 * four materials, which the method's general position excludes. A constant of at most Perturbation voxels is added to
 * each material's distance, from a golden-ratio sequence of its position among the labels, so that they come apart.
 *
 * Memory: the indicators are as large as the distances. Where the filter before is told to release its data
 * (vtkAlgorithm::ReleaseDataFlagOn) and nothing else holds its arrays, they take the distances' memory over.
 *
 * The smooth maximum is displaced where three or more materials meet (Core/SmoothMaximum.h); it serves inspection only.
 *
 * Errors: blocks without "TightDistance", more than four inspected labels, a label that is not among the materials.
 * An empty collection gives an empty collection and an empty image with its arrays.
 */
#ifndef vtkIndicatorReconstruct_h
#define vtkIndicatorReconstruct_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <vector> // for the inspected labels

class vtkImageData;

class VTKLABELMESHFILTERS_EXPORT vtkIndicatorReconstruct : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkIndicatorReconstruct* New();
  vtkTypeMacro(vtkIndicatorReconstruct, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The largest constant added to a material's distance, in voxels; 0: none. Default 0.01.
  vtkSetClampMacro(Perturbation, double, 0.0, 0.5);
  vtkGetMacro(Perturbation, double);
  ///@}

  ///@{
  /// Samples per voxel of the source grid, along each axis, of the image on port 1. Default 1.0.
  vtkSetClampMacro(ImageResolution, double, 0.01, 16.0);
  vtkGetMacro(ImageResolution, double);
  ///@}

  ///@{
  /// Up to four labels whose inside/outside functions, and cell indicator function, port 1 gets. Default: none.
  void AddInspectedLabel(vtkIdType label);
  void ClearInspectedLabels();
  vtkIdType GetNumberOfInspectedLabels() const { return static_cast<vtkIdType>(this->InspectedLabels.size()); }
  vtkIdType GetInspectedLabel(vtkIdType index) const
  {
    return this->InspectedLabels.at(static_cast<std::size_t>(index));
  }
  ///@}

  ///@{
  /// epsilon_max of equation 10, world length. Default 1e-5.
  vtkSetClampMacro(SmoothMaximumEpsilon, double, 1e-12, VTK_DOUBLE_MAX);
  vtkGetMacro(SmoothMaximumEpsilon, double);
  ///@}

  /// Output port 1.
  vtkImageData* GetLabelImage();

protected:
  vtkIndicatorReconstruct();
  ~vtkIndicatorReconstruct() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Perturbation = 0.01;
  double ImageResolution = 1.0;
  std::vector<vtkIdType> InspectedLabels;
  double SmoothMaximumEpsilon = 1e-5;

private:
  vtkIndicatorReconstruct(const vtkIndicatorReconstruct&) = delete;
  void operator=(const vtkIndicatorReconstruct&) = delete;
};

#endif
