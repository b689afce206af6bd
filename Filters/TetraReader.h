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
};

/// Reads tetrahedra with the cell array Label (integers). Field data Labels, MaterialNames and BackgroundLabel as
/// everywhere; without them default names and background 0. Tetrahedra of negative volume are turned over. Throws
/// std::invalid_argument with a sentence when there are cells of another type, no labels or coordinates that are not
/// finite.
TetraData ReadTetrahedra(vtkUnstructuredGrid* grid);
}

#endif
