// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLabelMesher
 * @brief   From a label volume to a watertight mesh of all its materials, in one step.
 *
 * The whole chain in one filter: vtkLabelSplit, vtkTighten, vtkIndicatorReconstruct, vtkSizingField,
 * vtkParticleSampleCells, vtkDelaunayLabelMesh. Stages keep their outputs, so that a change runs only the stages that
 * it concerns: a new Epsilon does not tighten again. The first three share one output, the indicators, which are by far
 * the largest data: a change of any of their properties runs all three.
 *
 * Input port 0 (vtkImageData): labels, SetInputArrayToProcess(0, ...), by default the active point or cell scalars; see
 * vtkLabelSplit.
 * Input port 1 (vtkImageData, optional): a further upper bound of the edge length, its active point scalars; see
 * vtkSizingField.
 *
 * Output port 0 (vtkPolyData): the interface triangles, each once; see vtkDelaunayLabelMesh for its arrays.
 * Output port 1 (vtkPartitionedDataSetCollection): a closed surface per material; see vtkDelaunayLabelMesh. Field data
 * MaskVolumes, TightVolumes, KeptVolumes (float64, in the order of Labels) as vtkTighten's, and DroppedLabels and so on
 * and Upsampling as vtkLabelSplit's; RebuiltVoxels, RebuiltLabels (int64): the voxels whose label in the indicators is
 * another than theirs, by their position in the volume, x fastest, and that label. All for vtkLabelMeshReport.
 * Output port 2 (vtkPolyData): the particles, before repair; see vtkParticleSampleCells.
 * Output port 3 (vtkPolyData): the curves where three materials meet; see vtkParticleSampleCells.
 * Output port 4 (vtkUnstructuredGrid): with Tetrahedra the tetrahedra that fill the materials; see
 * vtkDelaunayLabelMesh.
 *
 * Properties are those of the stages, under the same names; see there for what they mean. Warnings of the stages are
 * warnings of this filter, an error of a stage is its error; progress names the stage that runs; an abort stops it.
 */
#ifndef vtkLabelMesher_h
#define vtkLabelMesher_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for the stages
#include <string> // for names

class vtkImageData;
class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

class VTKLABELMESHFILTERS_EXPORT vtkLabelMesher : public vtkPolyDataAlgorithm
{
public:
  static vtkLabelMesher* New();
  vtkTypeMacro(vtkLabelMesher, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkMTimeType GetMTime() override;

  ///@{
  /// vtkLabelSplit: which labels (default all), the background's (default 0).
  void AddLabel(vtkIdType label);
  void ClearLabels();
  vtkIdType GetNumberOfLabels() const;
  vtkIdType GetLabel(vtkIdType index) const;
  void SetBackgroundLabel(vtkIdType label);
  vtkIdType GetBackgroundLabel() const;
  ///@}

  ///@{
  /// vtkLabelSplit: names and colours (0 to 1) of materials. A change of them runs no stage again; warnings of the stages
  /// use the default names.
  void SetMaterialName(vtkIdType label, const char* name);
  void ClearMaterialNames();
  std::string GetMaterialName(vtkIdType label) const;
  void SetMaterialColor(vtkIdType label, double red, double green, double blue);
  void ClearMaterialColors();
  void GetMaterialColor(vtkIdType label, double color[3]) const;
  ///@}

  ///@{
  /// vtkLabelSplit: samples of background around the volume (6); samples per voxel along each axis (1).
  void SetPadding(int samples);
  int GetPadding() const;
  void SetResamplingFactor(double factor);
  double GetResamplingFactor() const;
  ///@}

  ///@{
  /// vtkLabelSplit: samples per voxel along each axis, at most, that thin and small parts may ask for (1: none do).
  void SetMaximumUpsampling(int limit);
  int GetMaximumUpsampling() const;
  ///@}

  ///@{
  /// vtkLabelSplit: what becomes of materials at the border of the volume, Closed or Flat (Closed).
  void SetBorder(int border);
  int GetBorder() const;
  void SetBorderToClosed();
  void SetBorderToFlat();
  ///@}

  ///@{
  /// vtkLabelSplit: components of labels with fewer voxels go to the label around them (0: none do).
  void SetMinimumComponentSize(vtkIdType voxels);
  vtkIdType GetMinimumComponentSize() const;
  ///@}

  ///@{
  /// vtkLabelSplit: GiB that the work may take by estimate (0: no limit); larger volumes are an error at once.
  void SetMemoryLimit(double gibibytes);
  double GetMemoryLimit() const;
  ///@}

  ///@{
  /// vtkLabelSplit: radii of binary opening and closing, voxels (0), for all and for single materials.
  void SetOpeningRadius(double radius);
  double GetOpeningRadius() const;
  void SetClosingRadius(double radius);
  double GetClosingRadius() const;
  void SetMaterialOpeningRadius(vtkIdType label, double radius);
  double GetMaterialOpeningRadius(vtkIdType label) const;
  void ClearMaterialOpeningRadii();
  void SetMaterialClosingRadius(vtkIdType label, double radius);
  double GetMaterialClosingRadius(vtkIdType label) const;
  void ClearMaterialClosingRadii();
  ///@}

  ///@{
  /// vtkTighten: VolumeKeeping or Tightening (VolumeKeeping); fidelity (0.6, 1 / voxel) and rounds (8) of the first.
  void SetSmoothing(int smoothing);
  int GetSmoothing() const;
  void SetSmoothingToVolumeKeeping();
  void SetSmoothingToTightening();
  void SetFidelity(double fidelity);
  double GetFidelity() const;
  void SetRounds(int rounds);
  int GetRounds() const;
  ///@}

  ///@{
  /// vtkTighten: least radius of curvature, voxels (0.7), for all and for single materials; steps of antialiasing (10)
  /// and of tightening (20).
  void SetRadius(double radius);
  double GetRadius() const;
  void SetMaterialRadius(vtkIdType label, double radius);
  double GetMaterialRadius(vtkIdType label) const;
  void ClearMaterialRadii();
  void SetAntialiasIterations(int iterations);
  int GetAntialiasIterations() const;
  void SetTightenIterations(int iterations);
  int GetTightenIterations() const;
  ///@}

  ///@{
  /// vtkIndicatorReconstruct: the largest constant added to a material's distance, voxels (0.01).
  void SetPerturbation(double voxels);
  double GetPerturbation() const;
  ///@}

  ///@{
  /// vtkSizingField: edge length over feature size (0.65); the least feature size, voxels (0.8); how far edges may stay
  /// beside curved surfaces, voxels (0.2); growth of length (0.4).
  void SetEpsilon(double epsilon);
  double GetEpsilon() const;
  void SetFeatureSizeFloor(double voxels);
  double GetFeatureSizeFloor() const;
  void SetMaximumDeviation(double voxels);
  double GetMaximumDeviation() const;
  void SetGradation(double gradation);
  double GetGradation() const;
  ///@}

  ///@{
  /// vtkSizingField: bounds of the edge length, world units (0: none), for all and for single materials.
  void SetMinimumLength(double length);
  double GetMinimumLength() const;
  void SetMaximumLength(double length);
  double GetMaximumLength() const;
  void SetMaterialMaximumLength(vtkIdType label, double length);
  double GetMaterialMaximumLength(vtkIdType label) const;
  void ClearMaterialMaximumLengths();
  ///@}

  ///@{
  /// vtkSizingField: bounds of the edge length, world units, between two materials.
  void SetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB, double length);
  double GetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB) const;
  void ClearInterfaceMaximumLengths();
  ///@}

  ///@{
  /// vtkSizingField: about how many triangles to make (0: as the other properties say).
  void SetTargetTriangles(vtkIdType triangles);
  vtkIdType GetTargetTriangles() const;
  ///@}

  ///@{
  /// vtkParticleSampleCells: relaxation sweeps (20), seed (1).
  void SetSweeps(int sweeps);
  int GetSweeps() const;
  void SetSeed(int seed);
  int GetSeed() const;
  ///@}

  ///@{
  /// vtkDelaunayLabelMesh: rounds of repair at most (8); passes of improvement (3); the radius ratio below which a
  /// triangle is mended (0.75); whether faces, not vertices, lie on the interfaces (on);
  /// whether each material encloses its smoothed volume (on).
  void SetRepairRounds(int rounds);
  int GetRepairRounds() const;
  void SetImprovePasses(int passes);
  int GetImprovePasses() const;
  void SetRepairBelow(double ratio);
  double GetRepairBelow() const;
  void SetChordCorrection(bool on);
  bool GetChordCorrection() const;
  void SetVolumeCorrection(bool on);
  bool GetVolumeCorrection() const;
  ///@}

  ///@{
  /// vtkDelaunayLabelMesh: tetrahedra inside the materials: Off, Packed or TetGen (Off; Packed also turns SampleVolume
  /// of vtkParticleSampleCells on); rounds of refining slivers (0); radius-edge ratio (1.4) and least dihedral angle
  /// (degrees, 0) for TetGen.
  void SetTetrahedra(int mode);
  int GetTetrahedra() const;
  void SetTetrahedraToOff();
  void SetTetrahedraToPacked();
  void SetTetrahedraToTetGen();
  void SetRefinementRounds(int rounds);
  int GetRefinementRounds() const;
  void SetRadiusEdgeRatio(double ratio);
  double GetRadiusEdgeRatio() const;
  void SetMinimumDihedral(double degrees);
  double GetMinimumDihedral() const;
  /// Passes of improvement over badly shaped tetrahedra (10).
  void SetTetraImprovePasses(int passes);
  int GetTetraImprovePasses() const;
  /// Whether vertices of the interface move a little where tetrahedra are slivers without (on).
  void SetSlideSurface(bool on);
  bool GetSlideSurface() const;
  /// After an update: why tetrahedra that were asked for are missing; empty where they are not.
  const char* GetTetrahedraFailure() const;
  ///@}

  ///@{
  /// vtkParticleSampleCells: growth of the length inside materials (0.4); its maximum, world units (0: none), for all
  /// and for single materials.
  void SetVolumeGradation(double gradation);
  double GetVolumeGradation() const;
  void SetVolumeMaximumLength(double length);
  double GetVolumeMaximumLength() const;
  void SetMaterialVolumeMaximumLength(vtkIdType label, double length);
  double GetMaterialVolumeMaximumLength(vtkIdType label) const;
  void ClearMaterialVolumeMaximumLengths();
  ///@}

  ///@{
  /**
   * The stages, in order: "LabelSplit", "Tighten", "IndicatorReconstruct", "SizingField", "ParticleSampleCells",
   * "DelaunayLabelMesh". Of each: the seconds that its last run took, and how often it has run. 0 before it ran and for
   * names that are no stage's.
   */
  int GetNumberOfStages() const;
  const char* GetStageName(int stage) const;
  double GetStageSeconds(const char* name) const;
  int GetStageRuns(const char* name) const;
  ///@}

  ///@{
  /// The same of all six, in order.
  double* GetAllStageSeconds() VTK_SIZEHINT(6);
  int* GetAllStageRuns() VTK_SIZEHINT(6);
  ///@}

  ///@{
  /// Of the last run: about how many particles the sizing predicted for the interfaces, how many there are, those
  /// inside the materials too, and how many triangles and tetrahedra came out.
  vtkIdType GetPredictedParticles() const;
  vtkIdType GetNumberOfParticles();
  vtkIdType GetNumberOfTriangles();
  vtkIdType GetNumberOfTetrahedra();
  ///@}

  ///@{
  /// Output ports 1 to 4.
  vtkPartitionedDataSetCollection* GetSurfaces();
  vtkPolyData* GetParticles();
  vtkPolyData* GetCurves();
  vtkUnstructuredGrid* GetTetrahedraOutput();
  ///@}

  /// The label image rebuilt from the indicators, which tells vtkLabelMeshReport what smoothing has lost: port 1 of the
  /// vtkIndicatorReconstruct inside; valid until the next update.
  vtkImageData* GetLabelImage();

protected:
  vtkLabelMesher();
  ~vtkLabelMesher() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLabelMesher(const vtkLabelMesher&) = delete;
  void operator=(const vtkLabelMesher&) = delete;

  class Pipeline;
  std::unique_ptr<Pipeline> Stages;
  double AllStageSeconds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  int AllStageRuns[6] = { 0, 0, 0, 0, 0, 0 };
};

#endif
