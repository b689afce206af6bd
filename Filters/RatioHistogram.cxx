// SPDX-License-Identifier: BSD-3-Clause
#include "RatioHistogram.h"

#include "Core/TetraQuality.h"
#include "LabelMeshNames.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>

namespace LabelMesh
{
namespace
{
void AddCounts(vtkTable* table, const char* name, const std::array<vtkTypeInt64, RatioBins>& counts)
{
  vtkNew<vtkTypeInt64Array> column;
  column->SetName(name);
  for (const vtkTypeInt64 count : counts)
  {
    column->InsertNextValue(count);
  }
  table->AddColumn(column);
}

int BinOf(double ratio)
{
  return ratio > 0.0 ? std::min(int(ratio * RatioBins), RatioBins - 1) : 0; // also where it is no number
}
}

void FillRadiusRatios(vtkTable* table, const InterfaceData& mesh, vtkUnstructuredGrid* tetrahedra)
{
  vtkNew<vtkDoubleArray> centers;
  centers->SetName(Names::BinExtents);
  for (int bin = 0; bin < RatioBins; ++bin)
  {
    centers->InsertNextValue((bin + 0.5) / RatioBins);
  }
  table->AddColumn(centers);

  std::array<vtkTypeInt64, RatioBins> triangles{};
  for (const InterfaceTriangle& triangle : mesh.Triangles)
  {
    if (triangle.Materials[0] != triangle.Materials[1])
    {
      const auto& v = triangle.Vertices;
      ++triangles[BinOf(RadiusRatio(mesh.Points[v[0]], mesh.Points[v[1]], mesh.Points[v[2]]))];
    }
  }
  AddCounts(table, "Triangles", triangles);
  if (!tetrahedra)
  {
    return;
  }
  std::array<vtkTypeInt64, RatioBins> counts{};
  for (vtkIdType cell = 0; cell < tetrahedra->GetNumberOfCells(); ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    tetrahedra->GetCellPoints(cell, count, ids);
    std::array<Vec3, 4> corners;
    for (int c = 0; c < 4; ++c)
    {
      tetrahedra->GetPoint(ids[c], corners[c].data());
    }
    ++counts[BinOf(TetraRadiusRatio(corners[0], corners[1], corners[2], corners[3]))];
  }
  AddCounts(table, "Tetrahedra", counts);
}
}
