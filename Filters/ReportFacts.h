// SPDX-License-Identifier: BSD-3-Clause
// What vtkLabelMeshReport finds out, before it becomes tables.
#ifndef ReportFacts_h
#define ReportFacts_h

#include "Core/GridFrame.h"
#include "Core/LossLedger.h"
#include "Core/MeshChecks.h"
#include "Core/Monitor.h"
#include "MeshAdapter.h"

#include <map>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;
class vtkPolyData;

namespace LabelMesh
{
/// Inputs of the report; all but the mesh may be missing.
struct ReportInputs
{
  vtkPolyData* Mesh = nullptr;
  vtkImageData* Volume = nullptr;
  vtkDataArray* VolumeLabels = nullptr;
  bool LabelsOfCells = false;
  vtkDataObject* Stages = nullptr;   ///< field data Labels, MaskVolumes, TightVolumes
  vtkImageData* Tightened = nullptr; ///< point array Label
  vtkPolyData* Particles = nullptr;
};

/// Facts about the voxels, and about the mesh by the voxels.
struct VolumeFacts
{
  GridFrame Frame;
  std::vector<MaterialId> Ids; ///< of the voxels
  VoxelObjects Voxels;
  std::vector<Index> LostParts;     ///< by material; without those of a label that is lost as a whole
  std::vector<Index> Misclassified; ///< by material: its voxels whose centre is not in it in the mesh
  Index Undecided = 0;              ///< voxels that no material has in the mesh, or several
  std::vector<Loss> Losses;
};

struct ReportFacts
{
  /// With the materials of the volume among its own: every id below is a position there.
  InterfaceData Mesh;
  MaterialId Background = 0;
  bool ShowBackground = true; ///< false when neither the mesh nor the volume knows of one
  MeshCheck Check;
  std::vector<double> MaskVolumes, TightVolumes; ///< by material, NaN where unknown; empty when not given
  bool HasVolume = false;
  VolumeFacts Volume;

  /// No fault was found in the mesh.
  bool Certified() const;
};

/// Throws std::invalid_argument with a sentence.
ReportFacts FindFacts(const ReportInputs& inputs, const Monitor& monitor);

/// For each point of the mesh, world length; see DistancesToVoxels.
std::vector<double> DistancesOf(const ReportFacts& facts);
}

#endif
