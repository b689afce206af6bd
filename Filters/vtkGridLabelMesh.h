// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGridLabelMesh
 * @brief   The grid-based baseline: discrete marching cubes, smoothing and decimation of all materials in one mesh.
 *
 * What section 6 of the paper compares its particles with, made of VTK's own filters: vtkDiscreteMarchingCubes with all
 * labels and merged points, then vtkWindowedSincPolyDataFilter, then vtkQuadricDecimation down to TargetTriangles.
 * The outputs have the form of vtkDelaunayLabelMesh, so that both can be compared. Where you want a good mesh, use
 * vtkLabelMesher.
 *
 * Input port 0 (vtkImageData): labels, SetInputArrayToProcess(0, ...), by default the active point or cell scalars; any
 * integer type, or floats that hold integers. Any extent, spacing and direction matrix. The volume is padded by a layer
 * of background so that surfaces close at its border.
 *
 * Output port 0 (vtkPolyData): triangles, each once.
 *  - cell data "BoundaryLabels" (int64 x 2): the normal points from the first label to the second; the background
 *    second, else ascending
 *  - cell data "RadiusRatio" (double): 2 r_in / r_circ
 *  - point data "CellDimension" (uint8), "NumberOfMaterials" (uint8), "Materials" (int64 x 8): the labels of the
 *    triangles around the point, and 2, 1 or 0 for two, three, more labels
 *  - field data Labels, MaterialNames, MaterialColors, BackgroundLabel
 *
 * Output port 1 (vtkPartitionedDataSetCollection): the surface of each material but the background, outward, by label;
 * see vtkDelaunayLabelMesh.
 *
 * Method: marching cubes makes a surface for each label against all the rest. Where in a cell of the grid the surfaces
 * of two labels have the same border they become one piece of interface with both labels. So the surfaces are closed,
 * and stay so when smoothing moves their vertices.
 *
 * Known flaws, which are the baseline's own:
 *  - where three or more labels meet, and at ambiguous faces, the labels' surfaces do not fit together: narrow tunnels
 *    of background run along the junctions (or labels overlap there by less than a voxel). Their triangles carry the
 *    background as one label though none is near;
 *  - cracks after decimation: where collapsing an edge lays two triangles on one another, vtkQuadricDecimation drops
 *    one, though both may be needed where surfaces meet (about one edge in a thousand);
 *  - edges with four triangles of a label and vertices where a surface touches itself, as the voxels have them;
 *  - triangles as bad as a grid makes them (minimal ratios near 0), sizes that do not follow the shape;
 *  - smoothing and decimation ignore the other sheet of a thin part: surfaces may cross.
 *
 * Errors: no labels, a two-dimensional image, fractions in a float array, nothing but background. An empty image gives
 * empty outputs.
 */
#ifndef vtkGridLabelMesh_h
#define vtkGridLabelMesh_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <vector> // for the labels

class vtkPartitionedDataSetCollection;

class VTKLABELMESHFILTERS_EXPORT vtkGridLabelMesh : public vtkPolyDataAlgorithm
{
public:
  static vtkGridLabelMesh* New();
  vtkTypeMacro(vtkGridLabelMesh, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The labels to mesh; all others become background. Default: none given, which means all that occur. A label that
   * does not occur is listed in the output's field data but has no triangle.
   */
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
  /// Iterations of vtkWindowedSincPolyDataFilter; 0: no smoothing. Default 20.
  vtkSetClampMacro(SmoothingIterations, int, 0, 10000);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /// Its pass band, between 0 (very smooth) and 2 (nothing smoothed). Default 0.1.
  vtkSetClampMacro(PassBand, double, 0.0, 2.0);
  vtkGetMacro(PassBand, double);
  ///@}

  ///@{
  /// Decimate to about this many triangles (vtkQuadricDecimation); 0: no decimation. Default 0.
  vtkSetClampMacro(TargetTriangles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetTriangles, vtkIdType);
  ///@}

  /// Output port 1.
  vtkPartitionedDataSetCollection* GetSurfaces();

protected:
  vtkGridLabelMesh();
  ~vtkGridLabelMesh() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<vtkIdType> Labels;
  vtkIdType BackgroundLabel = 0;
  int SmoothingIterations = 20;
  double PassBand = 0.1;
  vtkIdType TargetTriangles = 0;

private:
  vtkGridLabelMesh(const vtkGridLabelMesh&) = delete;
  void operator=(const vtkGridLabelMesh&) = delete;
};

#endif
