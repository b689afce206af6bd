// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLabelMeshReport
 * @brief   The certificate of an interface mesh, and the ledger of what it has lost, as tables.
 *
 * Judges any interface mesh that keeps the BoundaryLabels contract: the output of vtkDelaunayLabelMesh, vtkLabelMesher,
 * vtkGridLabelMesh, or of VTK's own vtkSurfaceNets3D. Topology is by point index, as a user of the mesh sees it.
 * Self-intersections are found exactly: triangles without a common vertex that touch or cross, with one that cross
 * elsewhere, with two that overlap in a plane.
 *
 * Input port 0 (vtkPolyData): triangles with the cell array "BoundaryLabels" (2 components; the normal points from the
 * first label to the second). Field data Labels, MaterialNames and BackgroundLabel are used where they are there
 * (without them: the labels of the triangles, default names, background 0), and the point arrays Materials and
 * NumberOfMaterials.
 *
 * Input port 1 (vtkImageData, optional): the label volume, SetInputArrayToProcess(0, 1, ...), by default the active
 * point or cell scalars. Labels that the mesh's field data does not list count as background there.
 *
 * What tells at which stage something was lost, all optional:
 * Input port 2 (any data object): its field data Labels, MaskVolumes and TightVolumes, as vtkTighten and
 * vtkIndicatorReconstruct write them; with port 1 of vtkLabelMesher also RebuiltVoxels and RebuiltLabels, which stand
 * in for input 3.
 * Input port 3 (vtkImageData): point array "Label", rebuilt from the indicators: port 1 of vtkIndicatorReconstruct.
 * Input port 4 (vtkPolyData): the particles, with Materials and NumberOfMaterials.
 *
 * Input port 5 (vtkUnstructuredGrid, optional): tetrahedra with the cell array "Label", as vtkDelaunayLabelMesh makes
 * them.
 *
 * Output port 0 (vtkTable), a row per material, ascending by label, the background among them:
 *  - "Label" (int64), "Name" (string)
 *  - "Triangles", "Vertices" (int64)
 *  - "MinRadiusRatio", "MeanRadiusRatio" (double): of 2 r_in / r_circ over the triangles of the material's surface; 1
 *    is equilateral, also reported for no triangle at all
 *  - "Certified" (uint8): the next four, and no self-intersection
 *  - "Closed", "EdgeManifold", "VertexManifold", "Oriented" (uint8): every edge of the surface is used by an even
 *    number of its triangles; by exactly two; the triangles around every vertex are one fan; every edge is used
 *    equally often in both directions
 *  - "OpenEdges", "NonManifoldEdges", "NonManifoldVertices", "MisorientedEdges" (int64): edges used by an odd number of
 *    triangles; by an even number of four or more; vertices where the surface touches itself; edges used more often in
 *    one direction
 *  - "SelfIntersections" (int64): pairs of the surface's triangles that intersect
 *  - "Components", "Euler" (int64): pieces of the surface that share no vertex; vertices - edges + triangles
 *  - "Genus" (int64): handles of all components together; -1 where the surface is not closed and manifold
 *  - "Parts", "Cavities" (int64): connected parts of the material, closed hollows in them: components that enclose a
 *    positive and a negative volume. The background has one part more, around everything
 *  - "Area", "Volume" (double, world length squared and cubed): the volume by the divergence theorem, valid where
 *    Closed and Oriented; the background's is negative: the space that the other materials take
 *  - "WorstTriangle" (int64, its cell; -1: none), "WorstPosition" (double x 3): the least radius ratio
 *  - with input 1: "VoxelVolume" (double, world length cubed), "Voxels" (int64) of the label, and of the solid that
 *    they make up, as above: "VoxelComponents", "VoxelEuler", "VoxelGenus", "VoxelParts", "VoxelCavities" (int64).
 *    Voxels belong together that share a face, an edge or a corner (Core/VoxelObjects.h)
 *  - with input 1: "LostParts" (int64): parts of which no voxel has the label in the mesh; "MisclassifiedVoxels"
 *    (int64): voxels of the label whose centre is not in it in the mesh
 *  - "MaskVolume", "TightVolume" (double, world length cubed): before and after tightening; with input 2
 *  - "Lost" (uint8): no triangle has the label, though the mesh's field data or the image has it
 *
 * Output port 1 (vtkTable), a row per pair of labels that has triangles or (with input 1) touching voxels:
 *  - "LabelA", "LabelB" (int64; the background second, else ascending), "Triangles" (int64), "Area",
 *    "MinRadiusRatio", "MeanRadiusRatio" (double), "WorstTriangle", "WorstPosition"
 *  - "VoxelFaces" (int64): faces of voxels between the two labels; with input 1
 *  - "Lost" (uint8): voxels of the two labels touch but no triangle lies between them
 *
 * Output port 2 (vtkTable), a row per loss (needs input 1): labels, then parts (a row per label and stage), then pairs:
 *  - "Kind" (string: label, parts, dropped or pair), "LabelA", "LabelB" (int64; a pair, or what was dropped on
 *    request and the label that got it; else the same twice)
 *  - "Stage" (string): the first filter after which it is gone; empty when no stage was given
 *  - "Parts", "Voxels" (int64): how many; of a pair the faces of voxels
 *  - "Position" (double x 3): the first voxel of the largest lost part; NaN for a pair
 *  - "What", "Advice" (string): a sentence each
 *
 * Output port 3 (vtkPolyData): empty, or with ErrorMap the mesh with the point array "DistanceToVoxels" (double, world
 * length): to the nearest face of voxels between two labels that are both around the point; NaN where there is none
 * within 16 voxels.
 *
 * Output port 4 (vtkTable), of the tetrahedra, a row per material that is not the background, ascending by label; empty
 * without input 5:
 *  - "Label" (int64), "Name" (string)
 *  - "Tetrahedra", "TurnedOver" (of no or negative volume), "Slivers" (radius ratio below 0.1) (int64)
 *  - "MinRadiusRatio", "FirstPercentileRadiusRatio" (one in a hundred is below), "MeanRadiusRatio" (double): of
 *    3 r_in / r_circ, 1 for a regular tetrahedron; also reported for no tetrahedron at all
 *  - "MinDihedral", "MaxDihedral" (double, degrees): of the angles between faces; NaN for no tetrahedron at all
 *  - "Volume" (double, world length cubed): the sum over the tetrahedra
 *  - "WorstTetrahedron" (int64, its cell; -1: none): the least radius ratio
 * and each of these but Label and Name as field data, for all tetrahedra together.
 *
 * Output port 5 (vtkTable), 18 rows: how many dihedral angles, six of each tetrahedron, are in 10 degrees each; empty
 * without input 5:
 *  - "From", "To" (double, degrees); "Angles" (int64) of all, "Angles_<label>" (int64) of each material
 *
 * Output port 6 (vtkTable), 50 rows: how many cells have a radius ratio in each fiftieth of 0 to 1:
 *  - "bin_extents" (double): the middle of the bin, under the name that ParaView's charts take for the x axis
 *  - "Triangles" (int64), without those of one label on both sides; with input 5 "Tetrahedra" (int64), where those of
 * no or negative volume are in the first row
 *
 * Field data of the tables of ports 0 to 2 (one value each): "Points", "Triangles" (int64, each triangle once),
 * "MinRadiusRatio", "FirstPercentileRadiusRatio" (one triangle in a hundred is below), "MeanRadiusRatio" (double),
 * "WorstTriangle", "WorstPosition", "DuplicateTriangles" (more triangles than one on the same three points),
 * "DegenerateTriangles" (ratio below 1e-10), "SameLabelTriangles" (left out of everything else), "WrongFaces" (whose
 * two labels are not in the Materials of all their points), "SelfIntersectingPairs", "SelfIntersectingTriangles",
 * "Certified" (1: no fault of any kind) (int64), "Certificate" (string: that in a sentence, or all that is wrong); with
 * input 1 "MisclassifiedVoxels", and "UndecidedVoxels" among them: in no material or in several (int64); with ErrorMap
 * "MeanDistanceToVoxels", "MaxDistanceToVoxels" (double, world length), "FarPoints" (int64): those without a distance.
 *
 * Errors: cells that are no triangles, no BoundaryLabels, tetrahedra without Label, an image without integer labels,
 * ErrorMap without an image. An empty mesh gives a report of what was lost.
 */
#ifndef vtkLabelMeshReport_h
#define vtkLabelMeshReport_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkTableAlgorithm.h"

class vtkPolyData;
class vtkTable;

class VTKLABELMESHFILTERS_EXPORT vtkLabelMeshReport : public vtkTableAlgorithm
{
public:
  static vtkLabelMeshReport* New();
  vtkTypeMacro(vtkLabelMeshReport, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether to measure how far each point of the mesh is from the interfaces of the voxels (off).
  vtkSetMacro(ErrorMap, vtkTypeBool);
  vtkGetMacro(ErrorMap, vtkTypeBool);
  vtkBooleanMacro(ErrorMap, vtkTypeBool);
  ///@}

  /// Output ports 4, 5 and 6.
  vtkTable* GetTetrahedraOutput();
  vtkTable* GetDihedralsOutput();
  vtkTable* GetRadiusRatiosOutput();

  /// Output port 3.
  vtkPolyData* GetErrorMapOutput();

protected:
  vtkLabelMeshReport();
  ~vtkLabelMeshReport() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTypeBool ErrorMap = 0;

  vtkLabelMeshReport(const vtkLabelMeshReport&) = delete;
  void operator=(const vtkLabelMeshReport&) = delete;
};

#endif
