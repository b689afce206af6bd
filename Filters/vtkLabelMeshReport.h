// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLabelMeshReport
 * @brief   Quality, closedness, volume and losses of an interface mesh, as tables.
 *
 * Judges any interface mesh that keeps the BoundaryLabels contract: the output of vtkDelaunayLabelMesh, vtkLabelMesher,
 * vtkGridLabelMesh, or of VTK's own vtkSurfaceNets3D. Topology is by point index, as a user of the mesh sees it.
 *
 * Input port 0 (vtkPolyData): triangles with the cell array "BoundaryLabels" (2 components; the normal points from the
 * first label to the second). Field data Labels, MaterialNames and BackgroundLabel are used where they are there
 * (without them: the labels of the triangles, default names, background 0), and the point arrays Materials and
 * NumberOfMaterials.
 *
 * Input port 1 (vtkImageData, optional): the label volume, SetInputArrayToProcess(0, 1, ...), by default the active
 * point or cell scalars. Labels that the mesh's field data does not list count as background there.
 *
 * Input port 2 (any data object, optional): its field data Labels, MaskVolumes and TightVolumes, as vtkTighten and
 * vtkIndicatorReconstruct write them.
 *
 * Output port 0 (vtkTable), a row per material, ascending by label, the background among them:
 *  - "Label" (int64), "Name" (string)
 *  - "Triangles", "Vertices" (int64)
 *  - "MinRadiusRatio", "MeanRadiusRatio" (double): of 2 r_in / r_circ over the triangles of the material's surface; 1
 *    is equilateral, also reported for no triangle at all
 *  - "Closed", "EdgeManifold", "Oriented" (uint8): every edge of the surface is used by an even number of its
 *    triangles; by exactly two; equally often in both directions
 *  - "OpenEdges", "NonManifoldEdges", "NonManifoldVertices" (int64): edges used by an odd number of triangles; by an
 *    even number of four or more; vertices where the surface touches itself
 *  - "Components", "Euler" (int64): pieces that share no vertex; vertices - edges + triangles
 *  - "Area", "Volume" (double, world length squared and cubed): the volume by the divergence theorem, valid where
 *    Closed and Oriented; the background's is negative: the space that the other materials take
 *  - "VoxelVolume" (double, world length cubed): the label's voxels; with input 1
 *  - "MaskVolume", "TightVolume" (double, world length cubed): before and after tightening; with input 2
 *  - "Lost" (uint8): no triangle has the label, though the mesh's field data or the image has it
 *
 * Output port 1 (vtkTable), a row per pair of labels that has triangles or (with input 1) touching voxels:
 *  - "LabelA", "LabelB" (int64; the background second, else ascending), "Triangles" (int64), "Area",
 *    "MinRadiusRatio", "MeanRadiusRatio" (double)
 *  - "VoxelFaces" (int64): faces of voxels between the two labels; with input 1
 *  - "Lost" (uint8): voxels of the two labels touch but no triangle lies between them
 *
 * Field data of both tables (one value each): "Points", "Triangles" (int64, each triangle once), "MinRadiusRatio",
 * "FirstPercentileRadiusRatio" (one triangle in a hundred is below), "MeanRadiusRatio" (double), "DuplicateTriangles"
 * (more triangles than one on the same three points),
 * "DegenerateTriangles" (ratio below 1e-10), "SameLabelTriangles" (left out of everything else), "WrongFaces" (whose
 * two labels are not in the Materials of all their points) (int64).
 *
 * Errors: cells that are no triangles, no BoundaryLabels, an image without integer labels. An empty mesh gives a report
 * of what was lost.
 */
#ifndef vtkLabelMeshReport_h
#define vtkLabelMeshReport_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkTableAlgorithm.h"

class VTKLABELMESHFILTERS_EXPORT vtkLabelMeshReport : public vtkTableAlgorithm
{
public:
  static vtkLabelMeshReport* New();
  vtkTypeMacro(vtkLabelMeshReport, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkLabelMeshReport();
  ~vtkLabelMeshReport() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLabelMeshReport(const vtkLabelMeshReport&) = delete;
  void operator=(const vtkLabelMeshReport&) = delete;
};

#endif
