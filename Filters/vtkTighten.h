// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTighten
 * @brief   Masks become smooth signed distances, with their volumes kept or as in the paper (section 5.1).
 *
 * Input port 0 (vtkPartitionedDataSetCollection): the masks, from vtkLabelSplit; block array "Mask".
 *
 * Output port 0 (vtkPartitionedDataSetCollection): blocks as the input's.
 *  - block point data "TightDistance" (float32): signed distance to the material's surface, world length, > 0 inside,
 *    clamped to 4 voxels on either side
 *  - field data of the collection: the input's, and MaskVolumes, TightVolumes (float64 x materials, in the order of the
 *    blocks): the volume of each material before and after, world length cubed; after: where its distance is
 *    the largest, which is what a mesh will enclose
 *  - KeptVolumes (float64 x materials) beside them: TightVolumes / MaskVolumes, 1 for a material without voxels
 * A voxel as a length is the geometric mean of the three spacings.
 *
 * Smoothing VolumeKeeping (see Core/JointSmoothing.h), all materials together:
 *  - exact signed distances of the masks;
 *  - Rounds of curvature flow, which Fidelity holds to the voxels, each followed by a correction that makes the fields
 *    one partition again and gives back the volume that the flow took;
 *  - tightening (Williams and Rossignac 2005): TightenIterations of curvature flow between the opening and the closing
 *    by a ball of Radius. Then |mean curvature| <= 1 / Radius, and only the mortar between the two bounds has changed;
 *    parts, and gaps, that are too thin for the ball are left alone;
 *  - connected parts that are small, or thin everywhere, get their volume back to a fiftieth (Core/PartKeeping.h), and
 *    those that are gone their voxels.
 * Smoothing Tightening (the paper's; see Core/LevelSet.h), each material by itself:
 *  - exact signed distance of the mask;
 *  - antialiasing (Whitaker 2000): AntialiasIterations of curvature flow that keep every voxel on its side;
 *  - tightening, as above.
 *
 * Memory: where the filter before is told to release its data (vtkAlgorithm::ReleaseDataFlagOn) and nothing else holds
 * its arrays, each mask goes as soon as it is used up.
 *
 * Limits: with Tightening, parts thinner than twice the radius vanish, whole small materials with them, and where
 * neighbours, smoothed apart from each other, overlap or leave a gap the largest field wins. With VolumeKeeping, spikes
 * of one voxel on a thick part may vanish, and rows of voxels that meet at corners only may come apart. Meshes of parts
 * of one or two voxels hold less than the fields do, since their edges cut across: a shorter edge there helps.
 *
 * Errors: blocks without "Mask", options out of range; for VolumeKeeping also blocks with a grid of their own.
 * Warnings: materials that vanish or lose more than half of their volume, with the figures; a radius for a material
 * that does not exist. An empty collection gives an empty collection.
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

  enum SmoothingMode
  {
    VolumeKeeping = 0, ///< all materials together; volumes and thin parts stay
    Tightening = 1     ///< the paper's: antialiasing, then tightening, each material by itself
  };

  ///@{
  /// How to smooth. Default VolumeKeeping.
  vtkSetClampMacro(Smoothing, int, VolumeKeeping, Tightening);
  vtkGetMacro(Smoothing, int);
  void SetSmoothingToVolumeKeeping() { this->SetSmoothing(VolumeKeeping); }
  void SetSmoothingToTightening() { this->SetSmoothing(Tightening); }
  ///@}

  ///@{
  /// The least radius of curvature, voxels; 0: no tightening. Both modes. Default 0.7.
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
  /// Steps of the flow that takes the staircase away. More make kinks. Tightening only. Default 10.
  vtkSetClampMacro(AntialiasIterations, int, 0, 10000);
  vtkGetMacro(AntialiasIterations, int);
  ///@}

  ///@{
  /// Steps of the flow between the opening and the closing. Both modes. Default 20.
  vtkSetClampMacro(TightenIterations, int, 0, 10000);
  vtkGetMacro(TightenIterations, int);
  ///@}

  ///@{
  /// The curvature, 1 / voxel, that it takes to turn a voxel over: larger keeps finer detail, and more staircase.
  /// VolumeKeeping only. Default 0.6.
  vtkSetMacro(Fidelity, double);
  vtkGetMacro(Fidelity, double);
  ///@}

  ///@{
  /// Rounds of flow and correction. VolumeKeeping only. Default 8.
  vtkSetClampMacro(Rounds, int, 0, 1000);
  vtkGetMacro(Rounds, int);
  ///@}

protected:
  vtkTighten() = default;
  ~vtkTighten() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Smoothing = VolumeKeeping;
  double Radius = 0.7;
  std::map<vtkIdType, double> MaterialRadii;
  int AntialiasIterations = 10;
  int TightenIterations = 20;
  double Fidelity = 0.6;
  int Rounds = 8;

private:
  vtkTighten(const vtkTighten&) = delete;
  void operator=(const vtkTighten&) = delete;
};

#endif
