// SPDX-License-Identifier: BSD-3-Clause
// What vtkLabelMeshReport says of tetrahedra.
#ifndef TetraReport_h
#define TetraReport_h

#include "Core/TetraChecks.h"
#include "IndicatorCollection.h"

#include <vector>

class vtkFieldData;
class vtkTable;
class vtkUnstructuredGrid;

namespace LabelMesh
{
/// The label of each cell. Throws std::invalid_argument with a sentence when there are none.
std::vector<Label> LabelsOf(vtkUnstructuredGrid* grid);
/// Those of the field data and of the cells, ascending; without the background where no cell has it.
std::vector<Material> MaterialsOf(vtkFieldData* fieldData, const std::vector<Label>& labels);

struct TetraReport
{
  std::vector<Material> Materials; ///< ascending; those with tetrahedra, and those of the field data
  TetraChecks Checks;
};

/// Throws std::invalid_argument with a sentence when there are cells that are no tetrahedra, or no labels.
TetraReport ReportOfTetrahedra(vtkUnstructuredGrid* grid);

/// The columns are listed in vtkLabelMeshReport.h.
void FillTetrahedra(vtkTable* table, const TetraReport& report);
void FillDihedrals(vtkTable* table, const TetraReport& report);
}

#endif
