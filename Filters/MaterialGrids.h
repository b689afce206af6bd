// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra taken apart by their labels.
#ifndef MaterialGrids_h
#define MaterialGrids_h

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace LabelMesh
{
/// A block per material, ascending, with its cells in their order, the points that they use, and all arrays; a material
/// without cells has an empty block. Throws std::invalid_argument with a sentence when there is no cell array Label.
void GridsOfMaterials(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* output);
}

#endif
