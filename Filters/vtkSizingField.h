// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSizingField
 * @brief   How long the edges of the mesh shall be, everywhere: the sizing field (paper, section 5.2).
 *
 * Input port 0 (vtkPartitionedDataSetCollection): the indicators, from vtkIndicatorReconstruct; block array
 * "Indicator".
 *
 * Input port 1 (vtkImageData, optional): a further upper bound, a point array of lengths in world units chosen with
 * SetInputArrayToProcess(0, 1, 0, ...), by default the active point scalars. Any extent, spacing and direction
 * matrix; it is read by linear interpolation. Where it does not reach, and where it is not a positive number, there
 * is no bound.
 *
 * Output (vtkImageData): on the working grid, which is the source grid and its padding, with the source's direction
 * matrix; point data
 *  - "TargetLength" (float32): the edge length h, world length; the active scalars
 *  - "FeatureSize" (float32): the distance to the medial axis at interface voxels, spread to the voxels nearest to
 *    each, world length
 *
 * Method:
 *  - the local feature size of all interfaces by the distance to their medial axis, the minimum over the materials;
 *  - near the interfaces h0 = Epsilon * max(feature size, FeatureSizeFloor), at most the radius of curvature (though
 *    not below 0.6 Epsilon * FeatureSizeFloor): at the sharp edges where three materials meet the feature size goes
 *    to zero, and particles are put on those edges explicitly, so the floor may stand in for it;
 *  - h0 <= sqrt(8 MaximumDeviation / curvature), though not below Epsilon * FeatureSizeFloor: large smooth parts have
 *    large features, and edges of that length would stay far beside them;
 *  - bounds: the maxima, port 1, and the minimum, which wins over all others;
 *  - the gradient is limited: h(x) = min over y of h0(y) + Gradation |x - y|.
 * With TargetTriangles h0 is scaled by one factor, before the bounds, until the predicted number of triangles is near
 * it.
 *
 * Limits: parts thinner than a voxel that no sample hits have no feature size.
 *
 * Errors: blocks without "Indicator", options out of range, an input on port 1 without a point array of lengths.
 * Warnings: a material of SetMaterialMaximumLength or SetInterfaceMaximumLength that does not exist; a TargetTriangles
 * that the bounds keep out of reach.
 * An empty collection gives an empty image with empty arrays.
 */
#ifndef vtkSizingField_h
#define vtkSizingField_h

#include "vtkImageAlgorithm.h"
#include "vtkLabelMeshFiltersModule.h"

#include <array> // for pairs of labels
#include <map>   // for the materials' lengths

class VTKLABELMESHFILTERS_EXPORT vtkSizingField : public vtkImageAlgorithm
{
public:
  static vtkSizingField* New();
  vtkTypeMacro(vtkSizingField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Edge length relative to the local feature size. Default 0.65.
  vtkSetMacro(Epsilon, double);
  vtkGetMacro(Epsilon, double);
  ///@}

  ///@{
  /// The least feature size, in voxels: about the radius of vtkTighten. Default 0.8.
  vtkSetMacro(FeatureSizeFloor, double);
  vtkGetMacro(FeatureSizeFloor, double);
  ///@}

  ///@{
  /// How far edges may stay beside the curved surfaces that they span, in voxels; 0: no bound. Default 0.2.
  vtkSetMacro(MaximumDeviation, double);
  vtkGetMacro(MaximumDeviation, double);
  ///@}

  ///@{
  /// The largest change of length per length. Default 0.4.
  vtkSetMacro(Gradation, double);
  vtkGetMacro(Gradation, double);
  ///@}

  ///@{
  /// The shortest length, world units; 0: none. Default 0.
  vtkSetMacro(MinimumLength, double);
  vtkGetMacro(MinimumLength, double);
  ///@}

  ///@{
  /// The longest length, world units; 0: none. Default 0.
  vtkSetMacro(MaximumLength, double);
  vtkGetMacro(MaximumLength, double);
  ///@}

  ///@{
  /**
   * The longest length, world units, on the interfaces of the material with this label; 0 takes its bound away.
   * Default: none given.
   */
  void SetMaterialMaximumLength(vtkIdType label, double length);
  double GetMaterialMaximumLength(vtkIdType label) const;
  void ClearMaterialMaximumLengths();
  ///@}

  ///@{
  /**
   * The longest length, world units, on the interface between the materials with these two labels, in any order; the
   * background is one of them. Within a voxel of a curve where another material begins it may be longer by Gradation
   * times that voxel. 0 takes its bound away. Default: none given.
   */
  void SetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB, double length);
  double GetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB) const;
  void ClearInterfaceMaximumLengths();
  ///@}

  ///@{
  /// About how many interface triangles the mesh shall have; 0: lengths are not scaled. Default 0.
  vtkSetClampMacro(TargetTriangles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetTriangles, vtkIdType);
  ///@}

  ///@{
  /// About how many particles (vertices) the mesh will have, half as many as triangles. Known after the filter has run.
  vtkGetMacro(PredictedParticles, vtkIdType);
  ///@}

protected:
  vtkSizingField();
  ~vtkSizingField() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Epsilon = 0.65;
  double FeatureSizeFloor = 0.8;
  double MaximumDeviation = 0.2;
  double Gradation = 0.4;
  double MinimumLength = 0.0;
  double MaximumLength = 0.0;
  std::map<vtkIdType, double> MaterialMaximumLengths;
  std::map<std::array<vtkIdType, 2>, double> InterfaceMaximumLengths; ///< labels ascend
  vtkIdType TargetTriangles = 0;
  vtkIdType PredictedParticles = 0;

private:
  vtkSizingField(const vtkSizingField&) = delete;
  void operator=(const vtkSizingField&) = delete;
};

#endif
