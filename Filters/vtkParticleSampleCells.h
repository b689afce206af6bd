// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkParticleSampleCells
 * @brief   Spreads particles over the places where materials meet: points, curves, surfaces.
 *
 * The interfaces of several materials form a CW-complex (paper, section 3): 0-cells where four materials meet, 1-cells
 * (curves) where three do, 2-cells (surfaces) where two do. Particles are put on the 0-cells, then along the 1-cells,
 * then on the 2-cells, so that those of lower cells are fixed while the next ones move (paper, sections 4.2 and 5.2).
 * On request (SampleVolume) the insides of the materials, the 3-cells, are packed too (paper, section 6).
 *
 * Input port 0 (vtkPartitionedDataSetCollection): the indicators, from vtkIndicatorReconstruct; block array
 * "Indicator".
 *
 * Input port 1 (vtkImageData): point array "TargetLength" (any real type): how far apart particles shall be, world
 * length, from vtkSizingField. Its direction matrix must be that of the indicators. Beyond it the nearest value holds.
 *
 * Output port 0 (vtkPolyData): a vertex per particle, those of 0-cells first, then 1-cells, 2-cells, 3-cells; point
 * data
 *  - "CellDimension" (uint8): 0 to 3: of the lowest cell that the particle lies on; 3: inside a material
 *  - "NumberOfMaterials" (uint8), "Materials" (int64 x 8): the labels that meet there, ascending, the rest repeats the
 *    last; more than four where junctions closer than the target length were merged
 *  - "BorderFaces" (uint8), where a flat border (vtkLabelSplit) has particles: bits 0 to 5 for the faces -x, +x, -y,
 *    +y, -z, +z of the volume's box that the particle lies on, whose other side is background in "Materials"; bit 6
 *    where background meets there within the box too
 *  - "TargetLength" (double), "Residual" (double): world lengths; the residual is the distance to the junction
 *  - "Normal" (double x 3): on 2-cells the unit normal from the first material into the second; else zero
 *  - field data Labels, MaterialNames, MaterialColors, BackgroundLabel
 *
 * Output port 1 (vtkPolyData): the 1-cells as polylines through their particles; closed ones end where they begin.
 *  - cell data "Materials" (int64 x 3): the labels that meet along the curve
 *
 * Method: 0-cells by Newton's method on three differences of indicators; 1-cells traced from them and from what is
 * left, and divided evenly in units of the target length; 2-cells by projected grid crossings thinned to a Poisson-disk
 * set, then relaxed: each particle steps in its tangent plane (eq. 6 and 7) by the energy of its neighbours and is
 * projected back, with particles deleted where they crowd and inserted where they are missing. The same input gives the
 * same bits for any number of threads.
 *
 * Limits: structures that no grid cell shows are not found. At most eight materials at a particle.
 *
 * Errors: blocks without "Indicator", an image without "TargetLength" or with another direction. Empty collections give
 * empty outputs with their arrays. Warning: several materials, but no interface between any of them.
 */
#ifndef vtkParticleSampleCells_h
#define vtkParticleSampleCells_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <map> // for maxima per material

class VTKLABELMESHFILTERS_EXPORT vtkParticleSampleCells : public vtkPolyDataAlgorithm
{
public:
  static vtkParticleSampleCells* New();
  vtkTypeMacro(vtkParticleSampleCells, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Relaxation sweeps over the particles on 2-cells. Default 20.
  vtkSetClampMacro(Sweeps, int, 0, 10000);
  vtkGetMacro(Sweeps, int);
  ///@}

  ///@{
  /// Of the random order in which the first particles are taken. Default 1.
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /// Particles inside every material but the background too, for tetrahedra. Default off.
  vtkSetMacro(SampleVolume, bool);
  vtkGetMacro(SampleVolume, bool);
  vtkBooleanMacro(SampleVolume, bool);
  ///@}

  ///@{
  /// How fast the distance of particles inside materials grows away from the interfaces, length per length. Default
  /// 0.3.
  vtkSetClampMacro(VolumeGradation, double, 0.01, 10.0);
  vtkGetMacro(VolumeGradation, double);
  ///@}

  ///@{
  /// The largest distance of particles inside materials, world units; 0: none. Default 0. A material's own wins over
  /// it.
  vtkSetClampMacro(VolumeMaximumLength, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VolumeMaximumLength, double);
  ///@}

  ///@{
  /// The same for one material; 0: as the others. Default none.
  void SetMaterialVolumeMaximumLength(vtkIdType label, double length);
  double GetMaterialVolumeMaximumLength(vtkIdType label) const;
  void ClearMaterialVolumeMaximumLengths();
  ///@}

  /// After an update: how many particles lie on cells of this dimension (0 to 3).
  vtkIdType GetNumberOfCellParticles(int dimension) const;

  ///@{
  /// After an update: (0-cell, three of its materials) pairs that are not the end of exactly one 1-cell. 0 on clean
  /// fields.
  vtkGetMacro(OpenCurveEnds, vtkIdType);
  ///@}

  ///@{
  /// After an update: how far particles moved in the last sweep, on average, in target lengths.
  vtkGetMacro(MeanMove, double);
  ///@}

protected:
  vtkParticleSampleCells();
  ~vtkParticleSampleCells() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Sweeps = 20;
  int Seed = 1;
  bool SampleVolume = false;
  double VolumeGradation = 0.4;
  double VolumeMaximumLength = 0.0;
  std::map<vtkIdType, double> MaterialVolumeMaximumLengths;
  vtkIdType CellParticles[4] = { 0, 0, 0, 0 };
  vtkIdType OpenCurveEnds = 0;
  double MeanMove = 0.0;

private:
  vtkParticleSampleCells(const vtkParticleSampleCells&) = delete;
  void operator=(const vtkParticleSampleCells&) = delete;
};

#endif
