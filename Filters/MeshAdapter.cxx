// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAdapter.h"

#include "BorderFaces.h"
#include "Core/ConstrainedDelaunay.h"
#include "Core/VertexFans.h"
#include "LabelMeshNames.h"
#include "MaterialArrays.h"

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataAssembly.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
template <typename Array>
vtkSmartPointer<Array> NewArray(const char* name, int components, Index tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Cells of equal size, from their vertices one after the other.
vtkSmartPointer<vtkCellArray> EqualCells(vtkTypeInt64Array* connectivity, Index size)
{
  const Index count = connectivity->GetNumberOfValues() / size;
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  for (Index i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, i * size);
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

Index SetPoints(const std::vector<Particle>& particles, const GridFrame& frame, vtkPolyData* output)
{
  const Index count = Index(particles.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (Index i = 0; i < count; ++i)
  {
    points->SetPoint(i, frame.LocalToWorld(particles[i].Position).data());
  }
  output->SetPoints(points);
  return count;
}

/// CellDimension, NumberOfMaterials and Materials of the points.
void AddMaterialSets(
  const std::vector<Particle>& particles, const std::vector<Material>& materials, vtkPointData* pointData)
{
  const Index count = Index(particles.size());
  auto dimensions = NewArray<vtkUnsignedCharArray>(Names::CellDimension, 1, count);
  auto numbers = NewArray<vtkUnsignedCharArray>(Names::NumberOfMaterials, 1, count);
  auto sets = NewArray<vtkTypeInt64Array>(Names::Materials, MaterialSet::Capacity, count);
  for (Index i = 0; i < count; ++i)
  {
    const MaterialSet& set = particles[i].Materials;
    dimensions->SetValue(i, particles[i].CellDimension);
    numbers->SetValue(i, static_cast<unsigned char>(set.Size()));
    for (int c = 0; c < MaterialSet::Capacity; ++c)
    {
      const Label label = set.Size() > 0 ? materials[set[std::min(c, set.Size() - 1)]].Label : 0;
      sets->SetTypedComponent(i, c, label);
    }
  }
  pointData->AddArray(dimensions);
  pointData->AddArray(numbers);
  pointData->AddArray(sets);
}

/// The material set of every point. Throws when a label is unknown.
std::vector<MaterialSet> ReadSets(
  vtkDataArray* numberArray, vtkDataArray* setArray, const std::vector<Material>& materials)
{
  const auto numbers = As<vtkTypeInt64Array>(numberArray);
  const auto labels = As<vtkTypeInt64Array>(setArray);
  std::vector<MaterialSet> sets(static_cast<std::size_t>(labels->GetNumberOfTuples()));
  for (Index i = 0; i < Index(sets.size()); ++i)
  {
    const Index number = numbers->GetValue(i);
    if (number < 0 || number > MaterialSet::Capacity)
    {
      throw std::invalid_argument("Point " + std::to_string(i) + " has " + std::to_string(number) + " in '" +
        Names::NumberOfMaterials + "', expected 0 to " + std::to_string(MaterialSet::Capacity) + ".");
    }
    for (int c = 0; c < int(number); ++c)
    {
      const Label label = labels->GetTypedComponent(i, c);
      const MaterialId material = FindMaterial(materials, label);
      if (material == NoMaterial)
      {
        throw std::invalid_argument("Point " + std::to_string(i) + " has the label " + std::to_string(label) + " in '" +
          Names::Materials + "', which is not one of the collection's materials.");
      }
      sets[i].Insert(material);
    }
  }
  return sets;
}

/// Only the vertices that a triangle has, in their order; `renumbered` maps old indices to new ones.
std::vector<Particle> UsedVertices(const InterfaceMesh& mesh, std::vector<Index>& renumbered)
{
  renumbered.assign(mesh.Vertices.size(), -1);
  for (const InterfaceTriangle& triangle : mesh.Triangles)
  {
    for (const Index v : triangle.Vertices)
    {
      renumbered[v] = 0;
    }
  }
  std::vector<Particle> used;
  used.reserve(mesh.Vertices.size());
  for (std::size_t v = 0; v < mesh.Vertices.size(); ++v)
  {
    if (renumbered[v] == 0)
    {
      renumbered[v] = Index(used.size());
      used.push_back(mesh.Vertices[v]);
    }
  }
  return used;
}

/// Copies the tuples `ids` of every array.
void CopyTuples(vtkFieldData* from, vtkIdList* ids, vtkFieldData* to)
{
  for (int a = 0; a < from->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* source = from->GetAbstractArray(a);
    const auto copy = vtkSmartPointer<vtkAbstractArray>::Take(source->NewInstance());
    copy->SetName(source->GetName());
    copy->SetNumberOfComponents(source->GetNumberOfComponents());
    copy->SetNumberOfTuples(ids->GetNumberOfIds());
    if (ids->GetNumberOfIds() > 0)
    {
      source->GetTuples(ids, copy);
    }
    to->AddArray(copy);
  }
}

/// The surface of material m: its triangles, turned so that normals point out of it. Where it touches itself in a
/// vertex each part gets a vertex of its own. `numbers` holds a -1 for each point of the interface.
vtkSmartPointer<vtkPolyData> SurfaceOf(MaterialId m, const std::vector<Index>& triangles,
  const InterfaceData& interface, vtkPolyData* mesh, std::vector<Index>& numbers)
{
  const Index count = Index(triangles.size());
  auto connectivity = NewArray<vtkTypeInt64Array>("", 1, 3 * count);
  auto pairs = NewArray<vtkTypeInt64Array>(Names::BoundaryLabels, 2, count);
  vtkNew<vtkIdList> cellIds;
  cellIds->SetNumberOfIds(count);
  std::vector<std::array<Index, 3>> corners(static_cast<std::size_t>(count));
  // The interface's points that the surface uses, ascending; `numbers` is -1 again at the end.
  std::vector<Index> used;
  for (const Index t : triangles)
  {
    for (const Index v : interface.Triangles[t].Vertices)
    {
      if (numbers[v] < 0)
      {
        numbers[v] = 0;
        used.push_back(v);
      }
    }
  }
  std::sort(used.begin(), used.end());
  for (std::size_t n = 0; n < used.size(); ++n)
  {
    numbers[used[n]] = Index(n);
  }
  for (Index i = 0; i < count; ++i)
  {
    const InterfaceTriangle& triangle = interface.Triangles[triangles[i]];
    const bool first = triangle.Materials[0] == m;
    const std::array<int, 3> order = first ? std::array<int, 3>{ 0, 1, 2 } : std::array<int, 3>{ 0, 2, 1 };
    for (int c = 0; c < 3; ++c)
    {
      corners[i][c] = numbers[triangle.Vertices[order[c]]];
    }
    pairs->SetTypedComponent(i, 0, interface.Materials[m].Label);
    pairs->SetTypedComponent(i, 1, interface.Materials[triangle.Materials[first ? 1 : 0]].Label);
    cellIds->SetId(i, triangles[i]);
  }
  for (const Index v : used)
  {
    numbers[v] = -1;
  }
  for (const Index copied : SplitFans(corners, Index(used.size())))
  {
    used.push_back(used[copied]);
  }
  for (Index i = 0; i < 3 * count; ++i)
  {
    connectivity->SetValue(i, corners[i / 3][i % 3]);
  }
  vtkNew<vtkIdList> pointIds;
  pointIds->SetNumberOfIds(Index(used.size()));
  std::copy(used.begin(), used.end(), pointIds->GetPointer(0));

  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(mesh->GetPoints() ? mesh->GetPoints()->GetDataType() : VTK_DOUBLE);
  points->SetNumberOfPoints(pointIds->GetNumberOfIds());
  if (!used.empty())
  {
    mesh->GetPoints()->GetPoints(pointIds, points);
  }
  surface->SetPoints(points);
  surface->SetPolys(EqualCells(connectivity, 3));
  CopyTuples(mesh->GetPointData(), pointIds, surface->GetPointData());
  CopyTuples(mesh->GetCellData(), cellIds, surface->GetCellData());
  surface->GetCellData()->SetScalars(pairs);
  return surface;
}

void AddMaterialFields(const Material& material, vtkFieldData* fieldData)
{
  auto label = NewArray<vtkTypeInt64Array>(Names::Label, 1, 1);
  label->SetValue(0, material.Label);
  fieldData->AddArray(label);
  auto color = NewArray<vtkDoubleArray>(Names::Color, 3, 1);
  color->SetTuple(0, material.Color.data());
  fieldData->AddArray(color);
}

std::vector<std::array<Index, 3>> ReadTriangles(vtkPolyData* mesh)
{
  if (mesh->GetNumberOfVerts() + mesh->GetNumberOfLines() + mesh->GetNumberOfStrips() > 0)
  {
    throw std::invalid_argument("The interface mesh has vertex, line or strip cells; expected triangles only.");
  }
  std::vector<std::array<Index, 3>> triangles;
  triangles.reserve(static_cast<std::size_t>(mesh->GetNumberOfPolys()));
  vtkCellArray* cells = mesh->GetPolys();
  vtkIdType size = 0;
  const vtkIdType* vertices = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(size, vertices);)
  {
    if (size != 3)
    {
      throw std::invalid_argument("The interface mesh has a polygon with " + std::to_string(size) +
        " vertices; expected triangles only (the Triangulate filter makes them).");
    }
    triangles.push_back({ vertices[0], vertices[1], vertices[2] });
  }
  return triangles;
}
}

void ParticlesToPolyData(const std::vector<Particle>& particles, const CollectionHeader& header, vtkPolyData* output)
{
  const Index count = SetPoints(particles, header.Source, output);
  auto vertices = NewArray<vtkTypeInt64Array>("", 1, count);
  auto lengths = NewArray<vtkDoubleArray>(Names::TargetLength, 1, count);
  auto residuals = NewArray<vtkDoubleArray>(Names::Residual, 1, count);
  auto normals = NewArray<vtkDoubleArray>(Names::Normal, 3, count);
  for (Index i = 0; i < count; ++i)
  {
    vertices->SetValue(i, i);
    lengths->SetValue(i, particles[i].TargetLength);
    residuals->SetValue(i, particles[i].Residual);
    normals->SetTuple(i, header.Source.VectorToWorld(particles[i].Normal).data());
  }
  output->SetVerts(EqualCells(vertices, 1));
  const MaterialId background = FindMaterial(header.Materials, header.Background);
  AddMaterialSets(header.FlatBorder ? WithoutBorders(particles, background, output->GetPointData()) : particles,
    header.Materials, output->GetPointData());
  output->GetPointData()->AddArray(lengths);
  output->GetPointData()->AddArray(residuals);
  output->GetPointData()->AddArray(normals);
  WriteMaterials(output->GetFieldData(), header.Materials, header.Background);
}

std::vector<Particle> ParticlesFromPolyData(vtkPolyData* input, const CollectionHeader& header)
{
  const char* origin = "Particle Sample Cells";
  vtkPointData* data = input->GetPointData();
  const auto dimensions = As<vtkTypeInt64Array>(RequiredArray(data, "point", Names::CellDimension, 1, origin));
  const auto lengths = As<vtkDoubleArray>(RequiredArray(data, "point", Names::TargetLength, 1, origin));
  const auto residuals = As<vtkDoubleArray>(RequiredArray(data, "point", Names::Residual, 1, origin));
  const auto normals = As<vtkDoubleArray>(RequiredArray(data, "point", Names::Normal, 3, origin));
  vtkDataArray* setArray = RequiredArray(data, "point", Names::Materials, MaterialSet::Capacity, origin);
  vtkDataArray* numberArray = RequiredArray(data, "point", Names::NumberOfMaterials, 1, origin);
  std::vector<MaterialSet> sets = ReadSets(numberArray, setArray, header.Materials);
  if (vtkDataArray* faces = data->GetArray(Names::BorderFaces))
  {
    if (!header.FlatBorder)
    {
      throw std::invalid_argument(std::string("The particles have the array '") + Names::BorderFaces +
        "' of a flat border, but the indicators are of a closed one. Connect those that the particles were made from.");
    }
    AddBorders(faces, FindMaterial(header.Materials, header.Background), sets);
  }
  std::vector<Particle> particles(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (Index i = 0; i < Index(particles.size()); ++i)
  {
    Particle& particle = particles[i];
    Vec3 world, normal;
    input->GetPoint(i, world.data());
    normals->GetTuple(i, normal.data());
    if (!world.allFinite())
    {
      throw std::invalid_argument("The position of point " + std::to_string(i) + " is not finite.");
    }
    particle.Position = header.Source.WorldToLocal(world);
    particle.Normal = header.Source.Direction().transpose() * normal;
    particle.TargetLength = lengths->GetValue(i);
    particle.Residual = residuals->GetValue(i);
    particle.Materials = sets[i];
    particle.CellDimension = static_cast<std::uint8_t>(dimensions->GetValue(i));
  }
  return particles;
}

void CurvesToPolyData(const std::vector<Curve>& curves, const std::vector<Particle>& particles,
  const CollectionHeader& header, vtkPolyData* output)
{
  std::vector<Index> renumbered(particles.size(), -1);
  std::vector<Particle> used;
  vtkNew<vtkCellArray> lines;
  auto triples = NewArray<vtkTypeInt64Array>(Names::Materials, 3, Index(curves.size()));
  for (std::size_t c = 0; c < curves.size(); ++c)
  {
    lines->InsertNextCell(vtkIdType(curves[c].Particles.size()));
    for (const Index p : curves[c].Particles)
    {
      if (renumbered[p] < 0)
      {
        renumbered[p] = Index(used.size());
        used.push_back(particles[p]);
      }
      lines->InsertCellPoint(renumbered[p]);
    }
    for (int k = 0; k < 3; ++k)
    {
      const MaterialId material = curves[c].Materials[k];
      triples->SetTypedComponent(
        Index(c), k, IsBorder(material) ? header.Background : header.Materials[material].Label);
    }
  }
  SetPoints(used, header.Source, output);
  output->SetLines(lines);
  output->GetCellData()->AddArray(triples);
  WriteMaterials(output->GetFieldData(), header.Materials, header.Background);
}

bool OrderPair(std::array<Label, 2>& pair, Label background)
{
  const bool turn = pair[1] != background && (pair[0] == background || pair[0] > pair[1]);
  if (turn)
  {
    std::swap(pair[0], pair[1]);
  }
  return turn;
}

void InterfaceToPolyData(const InterfaceMesh& mesh, const CollectionHeader& header, vtkPolyData* output)
{
  std::vector<Index> renumbered;
  const std::vector<Particle> vertices = UsedVertices(mesh, renumbered);
  SetPoints(vertices, header.Source, output);
  const Index count = Index(mesh.Triangles.size());
  auto connectivity = NewArray<vtkTypeInt64Array>("", 1, 3 * count);
  auto pairs = NewArray<vtkTypeInt64Array>(Names::BoundaryLabels, 2, count);
  auto ratios = NewArray<vtkDoubleArray>(Names::RadiusRatio, 1, count);
  const bool mirrored = header.Source.Mirrored();
  for (Index i = 0; i < count; ++i)
  {
    const InterfaceTriangle& triangle = mesh.Triangles[i];
    std::array<Label, 2> pair = { header.Materials[triangle.Materials[0]].Label,
      header.Materials[triangle.Materials[1]].Label };
    // A mirroring turns the right-hand rule around, and so does reading the pair backwards.
    const bool turn = OrderPair(pair, header.Background) != mirrored;
    const std::array<Index, 3>& v = triangle.Vertices;
    connectivity->SetValue(3 * i, renumbered[v[0]]);
    connectivity->SetValue(3 * i + 1, renumbered[v[turn ? 2 : 1]]);
    connectivity->SetValue(3 * i + 2, renumbered[v[turn ? 1 : 2]]);
    pairs->SetTypedComponent(i, 0, pair[0]);
    pairs->SetTypedComponent(i, 1, pair[1]);
    ratios->SetValue(
      i, RadiusRatio(mesh.Vertices[v[0]].Position, mesh.Vertices[v[1]].Position, mesh.Vertices[v[2]].Position));
  }
  output->SetPolys(EqualCells(connectivity, 3));
  output->GetCellData()->SetScalars(pairs); // what viewers colour by, without being told
  output->GetCellData()->AddArray(ratios);
  AddMaterialSets(vertices, header.Materials, output->GetPointData());
  WriteMaterials(output->GetFieldData(), header.Materials, header.Background);
}

void TetrahedraToGrid(const TetraMesh& mesh, const CollectionHeader& header, vtkUnstructuredGrid* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(mesh.Points.size()));
  for (std::size_t p = 0; p < mesh.Points.size(); ++p)
  {
    points->SetPoint(vtkIdType(p), header.Source.LocalToWorld(mesh.Points[p]).data());
  }
  output->SetPoints(points);
  const Index count = Index(mesh.Corners.size());
  auto connectivity = NewArray<vtkTypeInt64Array>("", 1, 4 * count);
  auto labels = NewArray<vtkTypeInt64Array>(Names::Label, 1, count);
  auto ratios = NewArray<vtkDoubleArray>(Names::RadiusRatio, 1, count);
  const bool mirrored = header.Source.Mirrored();
  for (Index t = 0; t < count; ++t)
  {
    const auto& c = mesh.Corners[t];
    connectivity->SetValue(4 * t, c[0]);
    connectivity->SetValue(4 * t + 1, c[mirrored ? 2 : 1]); // a mirroring turns it inside out
    connectivity->SetValue(4 * t + 2, c[mirrored ? 1 : 2]);
    connectivity->SetValue(4 * t + 3, c[3]);
    labels->SetValue(t, header.Materials[mesh.Materials[t]].Label);
    ratios->SetValue(t, TetraRadiusRatio(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]));
  }
  output->SetCells(VTK_TETRA, EqualCells(connectivity, 4));
  output->GetCellData()->AddArray(labels);
  output->GetCellData()->AddArray(ratios);
  WriteMaterials(output->GetFieldData(), header.Materials, header.Background);
  auto direction = NewArray<vtkDoubleArray>(Names::SourceDirection, 9, 1);
  const Mat3& axes = header.Source.Direction();
  for (int i = 0; i < 9; ++i)
  {
    direction->SetValue(i, axes(i / 3, i % 3));
  }
  output->GetFieldData()->AddArray(direction);
}

InterfaceData ReadInterface(vtkPolyData* mesh)
{
  InterfaceData data;
  const std::vector<std::array<Index, 3>> triangles = ReadTriangles(mesh);
  data.Materials = mesh->GetFieldData()->GetAbstractArray(Names::Labels) ? ReadMaterials(mesh->GetFieldData())
                                                                         : std::vector<Material>();
  data.Background = ReadBackground(mesh->GetFieldData());
  vtkDataArray* pairArray = mesh->GetCellData()->GetArray(Names::BoundaryLabels);
  if (triangles.empty() && !pairArray)
  {
    return data; // an empty mesh needs no arrays
  }
  const auto pairs = As<vtkTypeInt64Array>(RequiredArray(
    mesh->GetCellData(), "cell", Names::BoundaryLabels, 2, "Delaunay Label Mesh, Grid Label Mesh or Label Mesher"));
  const vtkTypeInt64* values = pairs->GetPointer(0);
  const std::vector<Label> labels(values, values + 2 * triangles.size());
  AddMissingMaterials(labels, data.Materials);
  data.Triangles.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    data.Triangles[t].Vertices = triangles[t];
    data.Triangles[t].Materials = { FindMaterial(data.Materials, labels[2 * t]),
      FindMaterial(data.Materials, labels[2 * t + 1]) };
  }
  data.Points.resize(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  for (std::size_t i = 0; i < data.Points.size(); ++i)
  {
    mesh->GetPoint(vtkIdType(i), data.Points[i].data());
  }
  vtkDataArray* sets = mesh->GetPointData()->GetArray(Names::Materials);
  vtkDataArray* numbers = mesh->GetPointData()->GetArray(Names::NumberOfMaterials);
  if (sets && numbers && sets->GetNumberOfComponents() == MaterialSet::Capacity)
  {
    data.Sets = ReadSets(numbers, sets, data.Materials);
  }
  return data;
}

void StartMaterials(vtkPartitionedDataSetCollection* output)
{
  output->Initialize();
  vtkNew<vtkDataAssembly> assembly;
  assembly->Initialize();
  assembly->SetRootNodeName(Names::SurfacesRoot);
  output->SetDataAssembly(assembly);
}

void AppendMaterial(const Material& material, vtkDataSet* piece, vtkPartitionedDataSetCollection* output)
{
  AddMaterialFields(material, piece->GetFieldData());
  const unsigned int block = output->GetNumberOfPartitionedDataSets();
  output->SetPartition(block, 0, piece);
  output->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), material.Name.c_str());
  vtkDataAssembly* assembly = output->GetDataAssembly();
  const int node = assembly->AddNode(vtkDataAssembly::MakeValidNodeName(material.Name.c_str()).c_str());
  assembly->AddDataSetIndex(node, block);
}

void SurfacesOfMaterials(vtkPolyData* interfaceMesh, vtkPartitionedDataSetCollection* output)
{
  const InterfaceData interface = ReadInterface(interfaceMesh);
  std::vector<std::vector<Index>> triangles(interface.Materials.size());
  for (std::size_t t = 0; t < interface.Triangles.size(); ++t)
  {
    const auto& pair = interface.Triangles[t].Materials;
    if (pair[0] != pair[1])
    {
      triangles[pair[0]].push_back(Index(t));
      triangles[pair[1]].push_back(Index(t));
    }
  }
  StartMaterials(output);
  std::vector<Index> numbers(interface.Points.size(), -1);
  for (std::size_t m = 0; m < interface.Materials.size(); ++m)
  {
    const Material& material = interface.Materials[m];
    if (material.Label == interface.Background)
    {
      continue;
    }
    const auto surface = SurfaceOf(MaterialId(m), triangles[m], interface, interfaceMesh, numbers);
    AppendMaterial(material, surface, output);
  }
  WriteMaterials(output->GetFieldData(), interface.Materials, interface.Background);
}
}
