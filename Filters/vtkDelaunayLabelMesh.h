// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDelaunayLabelMesh
 * @brief   Joins particles into a watertight triangle mesh of all material interfaces.
 *
 * Delaunay tetrahedra of the particles get a material each; the faces between tetrahedra of different materials are the
 * mesh (paper, sections 4.3 and 5.3). So it is closed and conforming by construction.
 *
 * On request (Tetrahedra) the materials are filled with tetrahedra that conform to that mesh (paper, section 6).
 *
 * Input port 0 (vtkPolyData): the particles, from vtkParticleSampleCells. Those of 3-cells take part in tetrahedra
 * only. Input port 1 (vtkPartitionedDataSetCollection): the indicators, from vtkIndicatorReconstruct; block array
 * "Indicator".
 *
 * Output port 0 (vtkPolyData): triangles, each once.
 *  - cell data "BoundaryLabels" (int64 x 2): the labels on its two sides; the normal points from the first to the
 *    second; the background second, else ascending. Space outside the volume is background.
 *  - cell data "RadiusRatio" (double): 2 r_in / r_circ, 1 for an equilateral triangle
 *  - point data "CellDimension" (uint8), "NumberOfMaterials" (uint8), "Materials" (int64 x 8, ascending, the rest
 *    repeats the last): of the particle
 *  - field data Labels, MaterialNames, MaterialColors, BackgroundLabel; "KeptFromCutting" (int64), see
 *    GetKeptFromCutting
 *
 * Output port 1 (vtkPartitionedDataSetCollection, assembly root "Surfaces"): a block per material but the background,
 * ascending by label, NAME the material's: its closed surface, normals outward, with the points of port 0 to the last
 * bit and their arrays. "BoundaryLabels" is (own label, other side's) there. Field data Label, Color. A material that
 * was lost has an empty block. A point where the surface touches itself stands there once for each fan of triangles.
 *
 * Output port 2 (vtkUnstructuredGrid): positively oriented tetrahedra that fill every material but the background; no
 * points and cells unless Tetrahedra is on. The points of port 0 come first, to the last bit and in the same order,
 * then those inside. The triangles of port 0 are faces of tetrahedra just as they are, each between the two labels that
 * it says, and no other face is between two labels (checked).
 *  - cell data "Label" (int64), "RadiusRatio" (double): 3 r_in / r_circ, 1 for a regular tetrahedron
 *  - field data Labels, MaterialNames, MaterialColors, BackgroundLabel
 *
 * Method: a tetrahedron takes the material with the largest indicator at its circumcentre among those that are in the
 * sets of all four corners, so that no face crosses an interface (the paper asks the circumcentre alone). Then
 * local repair at faces whose materials are not in the sets of all their vertices, at edges and vertices where a
 * surface is not manifold and at slivers; then ImprovePasses passes of edge flips and of vertex smoothing by the
 * inverse mean ratio, each vertex within its own cell; then single edits at triangles that are still below RepairBelow.
 * Last, ChordCorrection moves vertices so that faces lie on the interfaces, and VolumeCorrection so that each material
 * encloses its volume.
 * No step makes triangles cut each other. The same input gives the same bits for any number of threads.
 *
 * Errors: arrays that are missing, labels that the indicators do not have, a failed Delaunay tetrahedralisation.
 * Warnings: what repair could not mend, with its figure; a mesh that cannot be filled with tetrahedra. Empty inputs
 * give empty outputs with their arrays.
 */
#ifndef vtkDelaunayLabelMesh_h
#define vtkDelaunayLabelMesh_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <string> // for the failure of tetrahedra

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

class VTKLABELMESHFILTERS_EXPORT vtkDelaunayLabelMesh : public vtkPolyDataAlgorithm
{
public:
  static vtkDelaunayLabelMesh* New();
  vtkTypeMacro(vtkDelaunayLabelMesh, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Rounds of local repair at most, while there are faults and it helps; 0: none. Where wrong faces or non-manifold
  /// edges stay, particles are added around them, up to four times, with two rounds each. Default 8.
  vtkSetClampMacro(RepairRounds, int, 0, 1000);
  vtkGetMacro(RepairRounds, int);
  ///@}

  ///@{
  /// Passes over the finished mesh that flip edges and move vertices within their cells for better triangles; 0: none.
  /// Default 3.
  vtkSetClampMacro(ImprovePasses, int, 0, 1000);
  vtkGetMacro(ImprovePasses, int);
  ///@}

  ///@{
  /// Whether the vertices leave their interfaces, along the normal, so that the faces lie there on average and not the
  /// vertices: faces cut off what is convex, and small materials would lose some percent of their volume. Off: every
  /// vertex is on its interface, as in the paper. Default on.
  vtkSetMacro(ChordCorrection, bool);
  vtkGetMacro(ChordCorrection, bool);
  vtkBooleanMacro(ChordCorrection, bool);
  ///@}

  ///@{
  /// Whether the vertices move, by the least that does it, so that each material encloses its volume as the indicators'
  /// field data TightVolumes (vtkTighten) says it: few faces around a small part miss some of it. Default on.
  vtkSetMacro(VolumeCorrection, bool);
  vtkGetMacro(VolumeCorrection, bool);
  vtkBooleanMacro(VolumeCorrection, bool);
  ///@}

  ///@{
  /// The radius ratio below which a triangle is mended. Default 0.75.
  vtkSetClampMacro(RepairBelow, double, 0.0, 0.9);
  vtkGetMacro(RepairBelow, double);
  ///@}

  ///@{
  /**
   * After an update: tetrahedra of the Delaunay triangulation; rounds of repair; and what repair left: faces whose two
   * materials are not in the sets of all their vertices, edges that a material's surface does not use exactly twice,
   * vertices where it has more than one fan, and the smallest radius ratio; and vertices that improving left as they
   * were, since improved triangles there cut others. A warning gives these figures when one of the first three counts
   * is not zero, the ratio is below 0.3, or improving left more than a hundredth of the vertices.
   */
  vtkGetMacro(NumberOfTetrahedra, vtkIdType);
  vtkGetMacro(RoundsDone, int);
  vtkGetMacro(WrongFaces, vtkIdType);
  vtkGetMacro(NonManifoldEdges, vtkIdType);
  vtkGetMacro(NonManifoldVertices, vtkIdType);
  vtkGetMacro(WorstRadiusRatio, double);
  vtkGetMacro(KeptFromCutting, vtkIdType);
  ///@}

  /// Where tetrahedra come from.
  enum TetrahedraMode
  {
    Off = 0,    ///< none are made
    Packed = 1, ///< the particles of 3-cells (vtkParticleSampleCells, SampleVolume) are their inner points: SP
    TetGen =
      2 ///< TetGen inserts inner points by RadiusEdgeRatio and MinimumDihedral; particles inside are not used: TG
  };

  ///@{
  /// Tetrahedra on port 2. In both modes TetGen makes them, and may add a few points inside to keep to the triangles.
  /// Default Off.
  vtkSetClampMacro(Tetrahedra, int, Off, TetGen);
  vtkGetMacro(Tetrahedra, int);
  void SetTetrahedraToOff() { this->SetTetrahedra(Off); }
  void SetTetrahedraToPacked() { this->SetTetrahedra(Packed); }
  void SetTetrahedraToTetGen() { this->SetTetrahedra(TetGen); }
  ///@}

  ///@{
  /// With Packed: rounds in which the circumcentres of slivers, tetrahedra with a radius ratio below 0.1, become
  /// points: the paper's SP-1R, SP-2R. Each round makes all tetrahedra anew. Default 0.
  vtkSetClampMacro(RefinementRounds, int, 0, 100);
  vtkGetMacro(RefinementRounds, int);
  ///@}

  ///@{
  /// With TetGen: the largest circumradius over shortest edge that is asked for. Below 1.2 it may not end. Default 1.4.
  vtkSetClampMacro(RadiusEdgeRatio, double, 1.0, 100.0);
  vtkGetMacro(RadiusEdgeRatio, double);
  ///@}

  ///@{
  /// With TetGen: the least dihedral angle that is asked for, degrees; 0: none. Beyond 18 it may not end. Default 0.
  vtkSetClampMacro(MinimumDihedral, double, 0.0, 60.0);
  vtkGetMacro(MinimumDihedral, double);
  ///@}

  ///@{
  /// Passes of improvement over the tetrahedra that are badly shaped, at most; the worst first: their vertices inside
  /// move, edges and faces are flipped, vertices are taken out and put in. The triangles of port 0 stay as they are.
  /// It ends when nothing helps any more. 0 leaves the tetrahedra as TetGen made them. Default 10.
  vtkSetClampMacro(TetraImprovePasses, int, 0, 1000);
  vtkGetMacro(TetraImprovePasses, int);
  ///@}

  ///@{
  /// Whether, at the end of improvement, vertices of the interface move where tetrahedra between two sheets of it that
  /// all but touch are slivers for any place of the vertices inside: by a tenth of the mean edge there at most, in all
  /// outputs alike. No triangle becomes worse than 0.75 and the worst of the mesh, none cuts another. Off: ports 0 and
  /// 1 are the same bits with and without tetrahedra. Default on.
  vtkSetMacro(SlideSurface, bool);
  vtkGetMacro(SlideSurface, bool);
  vtkBooleanMacro(SlideSurface, bool);
  ///@}

  ///@{
  /// After an update with tetrahedra: particles inside that were too near to the interface and left out; points that
  /// TetGen added inside; circumcentres that became points; moves of vertices of the interface (SlideSurface).
  vtkGetMacro(InnerPointsLeftOut, vtkIdType);
  vtkGetMacro(InnerPointsAdded, vtkIdType);
  vtkGetMacro(CircumcentresInserted, vtkIdType);
  vtkGetMacro(InterfaceMoves, vtkIdType);
  ///@}

  /// After an update with tetrahedra: why there are none, a sentence; empty where nothing went wrong. It is a warning:
  /// ports 0 and 1 have their mesh all the same.
  const char* GetTetrahedraFailure() const { return this->TetrahedraFailure.c_str(); }

  /// Output port 1.
  vtkPartitionedDataSetCollection* GetSurfaces();
  /// Output port 2.
  vtkUnstructuredGrid* GetTetrahedraOutput();

protected:
  vtkDelaunayLabelMesh();
  ~vtkDelaunayLabelMesh() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int RepairRounds = 8;
  int ImprovePasses = 3;
  double RepairBelow = 0.75;
  bool ChordCorrection = true;
  bool VolumeCorrection = true;
  int Tetrahedra = Off;
  int RefinementRounds = 0;
  double RadiusEdgeRatio = 1.4;
  double MinimumDihedral = 0.0;
  int TetraImprovePasses = 10;
  bool SlideSurface = true;
  vtkIdType InnerPointsLeftOut = 0;
  vtkIdType InnerPointsAdded = 0;
  vtkIdType CircumcentresInserted = 0;
  vtkIdType InterfaceMoves = 0;
  std::string TetrahedraFailure;
  vtkIdType NumberOfTetrahedra = 0;
  int RoundsDone = 0;
  vtkIdType WrongFaces = 0;
  vtkIdType NonManifoldEdges = 0;
  vtkIdType NonManifoldVertices = 0;
  double WorstRadiusRatio = 1.0;
  vtkIdType KeptFromCutting = 0;

private:
  vtkDelaunayLabelMesh(const vtkDelaunayLabelMesh&) = delete;
  void operator=(const vtkDelaunayLabelMesh&) = delete;
};

#endif
