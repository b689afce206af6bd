// SPDX-License-Identifier: BSD-3-Clause
// Particles, curves and interface meshes as vtkPolyData and back: positions become world coordinates here.
#ifndef MeshAdapter_h
#define MeshAdapter_h

#include "Core/GridFrame.h"
#include "Core/InterfaceMesh.h"
#include "Core/Particles.h"
#include "Core/TetraMesh.h"
#include "IndicatorCollection.h"

#include <vector>

class vtkDataSet;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace LabelMesh
{
/// One vertex cell per particle; point arrays CellDimension, NumberOfMaterials, Materials, TargetLength, Residual,
/// Normal. Field data as WriteMaterials.
void ParticlesToPolyData(const std::vector<Particle>& particles, const CollectionHeader& header, vtkPolyData* output);
/// Throws std::invalid_argument with a sentence when an array of the contract is missing or a label is unknown.
std::vector<Particle> ParticlesFromPolyData(vtkPolyData* input, const CollectionHeader& header);

/// One polyline per 1-cell; cell array Materials (int64 x 3).
void CurvesToPolyData(const std::vector<Curve>& curves, const std::vector<Particle>& particles,
  const CollectionHeader& header, vtkPolyData* output);

/// Triangles with cell arrays BoundaryLabels (the active scalars) and RadiusRatio and point arrays CellDimension,
/// NumberOfMaterials, Materials. Turns triangles over for mirrored frames and orders each pair as the contract says:
/// the background label second, else ascending. Field data as WriteMaterials.
void InterfaceToPolyData(const InterfaceMesh& mesh, const CollectionHeader& header, vtkPolyData* output);

/// Tetrahedra with cell arrays Label and RadiusRatio; the points of the interface come first, with the bits that
/// InterfaceToPolyData gives them. Field data as WriteMaterials, and SourceDirection.
void TetrahedraToGrid(const TetraMesh& mesh, const CollectionHeader& header, vtkUnstructuredGrid* output);

/// One closed, outward-oriented vtkPolyData per label that is not the background, ascending, NAME and field data Label
/// and Color, with the interface's own points (one where a surface touches itself stands there once for each fan of its
/// triangles); from any interface mesh that keeps the BoundaryLabels contract. A
/// material without triangles has an empty block. Point and cell arrays are kept; BoundaryLabels is (own label, the
/// other side's), the active scalars, so that here too the normal points from the first to the second. Throws as
/// ReadInterface does.
void SurfacesOfMaterials(vtkPolyData* interfaceMesh, vtkPartitionedDataSetCollection* output);

/// Makes an empty collection of meshes, a block per material, and appends to it: with the material's name, field data
/// Label and Color, and a node of the assembly.
void StartMaterials(vtkPartitionedDataSetCollection* output);
void AppendMaterial(const Material& material, vtkDataSet* piece, vtkPartitionedDataSetCollection* output);

/// An interface mesh in Core's terms, in world coordinates.
struct InterfaceData
{
  std::vector<Material> Materials; ///< ascending; those of the field data and every label that a triangle has
  LabelMesh::Label Background = 0;
  std::vector<Vec3> Points;
  std::vector<InterfaceTriangle> Triangles; ///< in the order of the cells
  std::vector<MaterialSet> Sets;            ///< per point; empty when the mesh has no point array Materials
};

/// Reads any interface mesh that keeps the BoundaryLabels contract. Without field data BackgroundLabel the background
/// is 0. Throws std::invalid_argument with a sentence when there are cells that are not triangles or BoundaryLabels is
/// missing.
InterfaceData ReadInterface(vtkPolyData* interfaceMesh);

/// The pair in the order of the contract: the background second, else ascending. True when it was turned over.
bool OrderPair(std::array<LabelMesh::Label, 2>& pair, LabelMesh::Label background);
}

#endif
