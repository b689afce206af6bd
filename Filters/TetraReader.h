// SPDX-License-Identifier: BSD-3-Clause
// Labelled tetrahedra of a vtkUnstructuredGrid in Core's terms, as the writers of simulation formats need them.
#ifndef TetraReader_h
#define TetraReader_h

#include "Core/TetraMesh.h"
#include "IndicatorCollection.h"

#include <vector>

class vtkUnstructuredGrid;

namespace LabelMesh
{
struct TetraData
{
  std::vector<Material> Materials; ///< ascending by label; those of the field data, of the cells, and the background
  MaterialId Background = NoMaterial;
  /// In world coordinates, in the order of points and cells. Points without a tetrahedron are left out.
  TetraMesh Mesh;
  Index FlatTetrahedra = 0; ///< of no volume
  /// The axes of the image that the mesh is of, as columns; the world's where the field data does not say.
  Mat3 Axes = Mat3::Identity();
};

/// Reads tetrahedra with the cell array Label (integers). Field data Labels, MaterialNames, BackgroundLabel and
/// SourceDirection as everywhere; without them default names, background 0 and the world's axes. Tetrahedra of negative
/// volume are turned over. Throws std::invalid_argument with a sentence when there are cells of another type, no labels
/// or coordinates that are not finite.
TetraData ReadTetrahedra(vtkUnstructuredGrid* grid);
}

#endif
