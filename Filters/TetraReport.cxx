// SPDX-License-Identifier: BSD-3-Clause
#include "TetraReport.h"

#include "LabelMeshNames.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
std::vector<Label> LabelsOf(vtkUnstructuredGrid* grid)
{
  std::vector<Label> labels(static_cast<std::size_t>(grid->GetNumberOfCells()));
  if (labels.empty())
  {
    return labels;
  }
  vtkDataArray* array = grid->GetCellData()->GetArray(Names::Label);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(std::string("The tetrahedra have no cell array '") + Names::Label +
      "' of one component. Connect the tetrahedra of Delaunay Label Mesh or Label Mesher.");
  }
  vtkNew<vtkTypeInt64Array> exact; // not through double, which cannot hold all labels
  exact->DeepCopy(array);
  std::copy(exact->GetPointer(0), exact->GetPointer(0) + labels.size(), labels.begin());
  return labels;
}

std::vector<Material> MaterialsOf(vtkFieldData* fieldData, const std::vector<Label>& labels)
{
  std::vector<Material> materials =
    fieldData->GetAbstractArray(Names::Labels) ? ReadMaterials(fieldData) : std::vector<Material>();
  std::set<Label> missing(labels.begin(), labels.end());
  // The background has no tetrahedra.
  vtkDataArray* background = fieldData->GetArray(Names::BackgroundLabel);
  const auto isEmptyBackground = [&](const Material& m)
  { return background && m.Label == Label(background->GetComponent(0, 0)) && missing.count(m.Label) == 0; };
  materials.erase(std::remove_if(materials.begin(), materials.end(), isEmptyBackground), materials.end());
  for (const Material& m : materials)
  {
    missing.erase(m.Label);
  }
  for (const Label label : missing)
  {
    materials.push_back(DefaultMaterial(label));
  }
  if (materials.size() >= NoMaterial)
  {
    throw std::invalid_argument("The tetrahedra have " + std::to_string(materials.size()) + " labels; at most " +
      std::to_string(NoMaterial - 1) + " can be told apart.");
  }
  std::sort(materials.begin(), materials.end(), [](const Material& a, const Material& b) { return a.Label < b.Label; });
  return materials;
}

namespace
{
/// Rows of the table in the order of materials.
template <typename Array, typename Get>
void AddColumn(vtkTable* table, const char* name, std::size_t rows, const Get& get)
{
  vtkNew<Array> column;
  column->SetName(name);
  for (std::size_t row = 0; row < rows; ++row)
  {
    column->InsertNextValue(get(row));
  }
  table->AddColumn(column);
}
}

TetraReport ReportOfTetrahedra(vtkUnstructuredGrid* grid)
{
  TetraReport report;
  const std::vector<Label> labels = LabelsOf(grid);
  report.Materials = MaterialsOf(grid->GetFieldData(), labels);
  TetraMesh mesh;
  mesh.Points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t p = 0; p < mesh.Points.size(); ++p)
  {
    grid->GetPoint(vtkIdType(p), mesh.Points[p].data());
  }
  mesh.Corners.resize(labels.size());
  mesh.Materials.resize(labels.size());
  for (std::size_t t = 0; t < labels.size(); ++t)
  {
    if (grid->GetCellType(vtkIdType(t)) != VTK_TETRA)
    {
      throw std::invalid_argument("Cell " + std::to_string(t) + " of the tetrahedra is none, but a cell of type " +
        std::to_string(grid->GetCellType(vtkIdType(t))) + ". Connect the tetrahedra of Delaunay Label Mesh.");
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(vtkIdType(t), count, ids);
    std::copy(ids, ids + 4, mesh.Corners[t].begin());
    const auto at = std::lower_bound(report.Materials.begin(), report.Materials.end(), labels[t],
      [](const Material& m, Label label) { return m.Label < label; });
    mesh.Materials[t] = MaterialId(at - report.Materials.begin());
  }
  report.Checks = CheckTetrahedra(mesh, Index(report.Materials.size()));
  return report;
}

void FillTetrahedra(vtkTable* table, const TetraReport& report)
{
  const std::size_t rows = report.Materials.size();
  AddColumn<vtkTypeInt64Array>(table, "Label", rows, [&](std::size_t m) { return report.Materials[m].Label; });
  AddColumn<vtkStringArray>(table, "Name", rows, [&](std::size_t m) { return report.Materials[m].Name; });
  // Each figure is a column, and a value of the field data for all together.
  const auto& checks = report.Checks.Materials;
  const auto total = [&](auto array, const char* name, auto value)
  {
    array->SetName(name);
    array->InsertNextValue(value);
    table->GetFieldData()->AddArray(array);
  };
  const auto integer = [&](const char* name, Index TetraCheck::*member)
  {
    AddColumn<vtkTypeInt64Array>(table, name, rows, [&](std::size_t m) { return checks[m].*member; });
    total(vtkSmartPointer<vtkTypeInt64Array>::New(), name, report.Checks.All.*member);
  };
  const auto real = [&](const char* name, double TetraCheck::*member)
  {
    AddColumn<vtkDoubleArray>(table, name, rows, [&](std::size_t m) { return checks[m].*member; });
    total(vtkSmartPointer<vtkDoubleArray>::New(), name, report.Checks.All.*member);
  };
  integer("Tetrahedra", &TetraCheck::Tetrahedra);
  integer("TurnedOver", &TetraCheck::TurnedOver);
  integer("Slivers", &TetraCheck::Slivers);
  real("MinRadiusRatio", &TetraCheck::MinRadiusRatio);
  real("FirstPercentileRadiusRatio", &TetraCheck::FirstPercentileRatio);
  real("MeanRadiusRatio", &TetraCheck::MeanRadiusRatio);
  real("MinDihedral", &TetraCheck::MinDihedral);
  real("MaxDihedral", &TetraCheck::MaxDihedral);
  real("Volume", &TetraCheck::Volume);
  integer("WorstTetrahedron", &TetraCheck::Worst);
}

void FillDihedrals(vtkTable* table, const TetraReport& report)
{
  constexpr double width = 180.0 / DihedralBins;
  AddColumn<vtkDoubleArray>(table, "From", DihedralBins, [](std::size_t bin) { return width * double(bin); });
  AddColumn<vtkDoubleArray>(table, "To", DihedralBins, [](std::size_t bin) { return width * double(bin + 1); });
  const auto& all = report.Checks.All.Dihedrals;
  AddColumn<vtkTypeInt64Array>(table, "Angles", DihedralBins, [&all](std::size_t bin) { return all[bin]; });
  for (std::size_t m = 0; m < report.Materials.size(); ++m)
  {
    const auto& own = report.Checks.Materials[m].Dihedrals;
    const std::string name = "Angles_" + std::to_string(report.Materials[m].Label);
    AddColumn<vtkTypeInt64Array>(table, name.c_str(), DihedralBins, [&own](std::size_t bin) { return own[bin]; });
  }
}
}
