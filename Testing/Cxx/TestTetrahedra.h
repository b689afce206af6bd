// SPDX-License-Identifier: BSD-3-Clause
// Boxes of tetrahedra with a label for each cube, for the tests of what takes tetrahedra.
#ifndef TestTetrahedra_h
#define TestTetrahedra_h

#include "IndicatorCollection.h"
#include "LabelMeshNames.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <functional>

namespace TestTetrahedra
{
using namespace LabelMesh;

/// nx * ny * nz unit cubes from `origin` on, each of six tetrahedra along its diagonal, which conform to each other;
/// every other tetrahedron is turned inside out.
inline vtkSmartPointer<vtkUnstructuredGrid> Box(
  const std::array<int, 3>& size, const Vec3& origin, const std::function<Label(int, int, int)>& label)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto id = [&size](const std::array<int, 3>& at)
  { return vtkIdType(at[0] + (size[0] + 1) * (at[1] + (size[1] + 1) * at[2])); };
  for (int k = 0; k <= size[2]; ++k)
  {
    for (int j = 0; j <= size[1]; ++j)
    {
      for (int i = 0; i <= size[0]; ++i)
      {
        points->InsertNextPoint(Vec3(origin + Vec3(i, j, k)).data());
      }
    }
  }
  grid->SetPoints(points);
  grid->Allocate();
  vtkNew<vtkTypeInt64Array> labels;
  labels->SetName(Names::Label);
  for (int cube = 0; cube < size[0] * size[1] * size[2]; ++cube)
  {
    const std::array<int, 3> low = { cube % size[0], cube / size[0] % size[1], cube / size[0] / size[1] };
    std::array<int, 3> axes = { 0, 1, 2 };
    do
    {
      std::array<int, 3> at = low;
      vtkIdType corners[4] = { id(at) };
      for (int n = 0; n < 3; ++n)
      {
        ++at[axes[n]];
        corners[n + 1] = id(at);
      }
      grid->InsertNextCell(VTK_TETRA, 4, corners);
      labels->InsertNextValue(label(low[0], low[1], low[2]));
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  grid->GetCellData()->AddArray(labels);
  return grid;
}

/// 2 x 2 x 3 cubes: the label 1 below, 2 in the two layers above, whose corner at +x +y +z is 7.
inline vtkSmartPointer<vtkUnstructuredGrid> ThreeMaterials()
{
  return Box({ 2, 2, 3 }, Vec3(-1, 0.5, 10),
    [](int i, int j, int k) -> Label { return k == 0                  ? 1
                                         : i == 1 && j == 1 && k == 2 ? 7
                                                                      : 2; });
}
}

#endif
