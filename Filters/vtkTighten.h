// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTighten
 * @brief   Masks become smooth signed distances whose curvature is bounded (paper, section 5.1).
 *
 * Input port 0 (vtkPartitionedDataSetCollection): the masks, from vtkLabelSplit; block array "Mask".
 *
 * Output port 0 (vtkPartitionedDataSetCollection): blocks as the input's.
 *  - block point data "TightDistance" (float32): signed distance to the material's surface, world length, > 0 inside,
 *    clamped to 4 voxels on either side
 *  - field data of the collection: the input's, and MaskVolumes, TightVolumes (float64 x materials, in the order of the
 *    blocks): the volume of each material before and after, world length cubed
 * A voxel as a length is the geometric mean of the three spacings.
 *
 * Method (see Core/LevelSet.h), in a narrow band of each material by itself:
 *  - exact signed distance of the mask;
 *  - antialiasing (Whitaker 2000): AntialiasIterations of curvature flow that keep every voxel on its side;
 *  - tightening (Williams and Rossignac 2005): TightenIterations of curvature flow between the opening and the closing
 * by a ball of Radius. Then |mean curvature| <= 1 / Radius, and only the mortar between the two bounds has changed.
 *
 * Limits: parts thinner than twice the radius vanish, whole small materials with them. The fields of neighbouring
 * materials are smoothed apart from each other: the largest wins where both or neither is positive.
 *
 * Errors: blocks without "Mask", options out of range. Warnings: materials that vanish or lose more than half of their
 * volume, with the figures; a radius for a material that does not exist. An empty collection gives an empty collection.
 */
#ifndef vtkTighten_h
#define vtkTighten_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <map> // for the materials' radii

class VTKLABELMESHFILTERS_EXPORT vtkTighten : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkTighten* New();
  vtkTypeMacro(vtkTighten, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The masks, without a pipeline.
  void SetInputData(vtkDataObject* input) { this->SetInputDataInternal(0, input); }

  ///@{
  /// The least radius of curvature, voxels; 0: antialiasing alone. Default 1.
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /// A radius for the material with this label, in the place of the common one. Default: none given.
  void SetMaterialRadius(vtkIdType label, double radius);
  void ClearMaterialRadii();
  /// The radius that a label gets.
  double GetMaterialRadius(vtkIdType label) const;
  ///@}

  ///@{
  /// Steps of the flow that takes the staircase away. More make kinks. Default 10.
  vtkSetClampMacro(AntialiasIterations, int, 0, 10000);
  vtkGetMacro(AntialiasIterations, int);
  ///@}

  ///@{
  /// Steps of the flow between the opening and the closing. Default 20.
  vtkSetClampMacro(TightenIterations, int, 0, 10000);
  vtkGetMacro(TightenIterations, int);
  ///@}

protected:
  vtkTighten() = default;
  ~vtkTighten() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Radius = 1.0;
  std::map<vtkIdType, double> MaterialRadii;
  int AntialiasIterations = 10;
  int TightenIterations = 20;

private:
  vtkTighten(const vtkTighten&) = delete;
  void operator=(const vtkTighten&) = delete;
};

#endif
