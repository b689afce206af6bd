// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialGrids.h"

#include "MeshAdapter.h"
#include "TetraReport.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

namespace LabelMesh
{
namespace
{
/// The given cells with the points that they use. `numbers` holds a -1 for each point of the grid, before and after.
vtkSmartPointer<vtkUnstructuredGrid> CellsOf(
  vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& cells, std::vector<vtkIdType>& numbers)
{
  auto part = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(grid->GetPoints() ? grid->GetPoints()->GetDataType() : VTK_DOUBLE);
  part->Allocate(vtkIdType(cells.size()));
  part->GetPointData()->CopyAllOn();
  part->GetCellData()->CopyAllOn();
  part->GetPointData()->CopyAllocate(grid->GetPointData());
  part->GetCellData()->CopyAllocate(grid->GetCellData(), vtkIdType(cells.size()));
  std::vector<vtkIdType> used;
  vtkNew<vtkIdList> corners;
  for (std::size_t n = 0; n < cells.size(); ++n)
  {
    grid->GetCellPoints(cells[n], corners);
    for (vtkIdType c = 0; c < corners->GetNumberOfIds(); ++c)
    {
      const vtkIdType point = corners->GetId(c);
      if (numbers[point] < 0)
      {
        numbers[point] = points->InsertNextPoint(grid->GetPoint(point));
        part->GetPointData()->CopyData(grid->GetPointData(), point, numbers[point]);
        used.push_back(point);
      }
      corners->SetId(c, numbers[point]);
    }
    part->InsertNextCell(grid->GetCellType(cells[n]), corners);
    part->GetCellData()->CopyData(grid->GetCellData(), cells[n], vtkIdType(n));
  }
  for (const vtkIdType point : used)
  {
    numbers[point] = -1;
  }
  part->SetPoints(points);
  return part;
}
}

void GridsOfMaterials(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* output)
{
  const std::vector<Label> labels = LabelsOf(grid);
  const std::vector<Material> materials = MaterialsOf(grid->GetFieldData(), labels);
  std::vector<std::vector<vtkIdType>> cells(materials.size());
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
  {
    const auto at = std::lower_bound(
      materials.begin(), materials.end(), labels[cell], [](const Material& m, Label label) { return m.Label < label; });
    cells[at - materials.begin()].push_back(vtkIdType(cell));
  }
  StartMaterials(output);
  std::vector<vtkIdType> numbers(static_cast<std::size_t>(grid->GetNumberOfPoints()), -1);
  for (std::size_t m = 0; m < materials.size(); ++m)
  {
    AppendMaterial(materials[m], CellsOf(grid, cells[m], numbers), output);
  }
  output->GetFieldData()->ShallowCopy(grid->GetFieldData());
}
}
