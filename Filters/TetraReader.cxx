// SPDX-License-Identifier: BSD-3-Clause
#include "TetraReader.h"

#include "Core/TetraFaces.h"
#include "LabelMeshNames.h"
#include "MaterialArrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
void CheckCells(vtkUnstructuredGrid* grid)
{
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (grid->GetCellType(cell) != VTK_TETRA)
    {
      throw std::invalid_argument("Cell " + std::to_string(cell) + " is a " +
        vtkCellTypes::GetClassNameFromTypeId(grid->GetCellType(cell)) +
        "; expected tetrahedra only (vtkTetra). Extract the tetrahedra of one dimension first.");
    }
  }
  constexpr vtkIdType most = std::numeric_limits<std::int32_t>::max();
  if (grid->GetNumberOfPoints() > most || grid->GetNumberOfCells() > most)
  {
    throw std::invalid_argument("The mesh has " + std::to_string(grid->GetNumberOfPoints()) + " points and " +
      std::to_string(grid->GetNumberOfCells()) + " tetrahedra, at most " + std::to_string(most) + " are possible.");
  }
}

/// The cells' labels, whole numbers of whatever type.
std::vector<Label> ReadLabels(vtkUnstructuredGrid* grid)
{
  vtkDataArray* array =
    RequiredArray(grid->GetCellData(), "cell", Names::Label, 1, "Delaunay Label Mesh or Label Mesher (tetrahedra)");
  const bool floating = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  for (vtkIdType cell = 0; floating && cell < array->GetNumberOfTuples(); ++cell)
  {
    const double value = array->GetTuple1(cell);
    if (value != std::floor(value) || std::abs(value) > 9e15)
    {
      throw std::invalid_argument("Cell " + std::to_string(cell) + " has " + std::to_string(value) + " in the array '" +
        Names::Label + "'; labels are whole numbers.");
    }
  }
  const auto labels = As<vtkTypeInt64Array>(array);
  const vtkTypeInt64* values = labels->GetPointer(0);
  return std::vector<Label>(values, values + grid->GetNumberOfCells());
}

Mat3 ReadAxes(vtkFieldData* fieldData)
{
  vtkDataArray* array = fieldData->GetArray(Names::SourceDirection);
  Mat3 axes = Mat3::Identity();
  if (array && array->GetNumberOfValues() == 9)
  {
    const auto numbers = As<vtkDoubleArray>(array);
    for (int i = 0; i < 9; ++i)
    {
      axes(i / 3, i % 3) = numbers->GetPointer(0)[i];
    }
  }
  // A direction of something else is not taken for one.
  return (axes.transpose() * axes).isIdentity(1e-4) ? axes : Mat3(Mat3::Identity());
}

/// The corners, and the points that are one, in their order.
void ReadGeometry(vtkUnstructuredGrid* grid, TetraMesh& mesh)
{
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(grid->GetNumberOfPoints()), -1);
  mesh.Corners.resize(static_cast<std::size_t>(grid->GetNumberOfCells()));
  vtkCellArray* cells = grid->GetCells();
  for (std::size_t cell = 0; cell < mesh.Corners.size(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(vtkIdType(cell), size, corners);
    for (int c = 0; c < 4; ++c)
    {
      mesh.Corners[cell][c] = std::int32_t(corners[c]);
      numbers[corners[c]] = 0;
    }
  }
  for (std::size_t point = 0; point < numbers.size(); ++point)
  {
    if (numbers[point] < 0)
    {
      continue;
    }
    numbers[point] = std::int32_t(mesh.Points.size());
    Vec3 position;
    grid->GetPoint(vtkIdType(point), position.data());
    if (!position.allFinite())
    {
      throw std::invalid_argument("Point " + std::to_string(point) + " has a coordinate that is not a number.");
    }
    mesh.Points.push_back(position);
  }
  for (auto& corners : mesh.Corners)
  {
    for (std::int32_t& corner : corners)
    {
      corner = numbers[corner];
    }
  }
}
}

TetraData ReadTetrahedra(vtkUnstructuredGrid* grid)
{
  TetraData data;
  vtkFieldData* fieldData = grid->GetFieldData();
  const bool named = fieldData->GetAbstractArray(Names::Labels) != nullptr;
  data.Materials = named ? ReadMaterials(fieldData) : std::vector<Material>();
  const Label background = ReadBackground(fieldData);
  AddMissingMaterials({ background }, data.Materials);
  if (grid->GetNumberOfCells() > 0)
  {
    CheckCells(grid);
    const std::vector<Label> labels = ReadLabels(grid);
    AddMissingMaterials(labels, data.Materials);
    ReadGeometry(grid, data.Mesh);
    data.Mesh.Materials.reserve(labels.size());
    for (const Label label : labels)
    {
      data.Mesh.Materials.push_back(FindMaterial(data.Materials, label));
    }
    data.FlatTetrahedra = OrientTetrahedra(data.Mesh);
  }
  data.Background = FindMaterial(data.Materials, background);
  data.Axes = ReadAxes(fieldData);
  return data;
}
}
