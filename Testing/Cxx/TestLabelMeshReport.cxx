// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMeshReport.h"

#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"
#include "vtkLabelMesher.h"
#include "vtkTighten.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace TestMeshes;

namespace
{
/// Labels 4 and 7 as the two boxes, a corner of 9, and 11, which nobody asked for.
vtkSmartPointer<vtkImageData> Volume()
{
  const auto volume = LabelVolume({ 2, 9, 0, 5, 0, 5 },
    [](int i, int j, int k)
    {
      if (i == 9)
      {
        return j == 0 && k == 0 ? 9 : j == 5 && k == 5 ? 11 : 0;
      }
      return j < 1 || j > 4 || k < 1 || k > 4 || i < 3 ? 0 : i < 6 ? 4 : i < 8 ? 7 : 0;
    });
  volume->SetSpacing(0.5, 1, 2);
  return volume;
}

vtkSmartPointer<vtkPolyData> Mesh(const std::vector<Label>& labels)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  InterfaceToPolyData(TwoBoxes(1, 2, 0), HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), labels, 0), mesh);
  return mesh;
}

/// A volume and a mesh of it: label 4 is a box of 4 x 4 x 4 voxels, meshed as it is; a speck of 4 is not in the mesh,
/// nor are the labels 7 and 9, which touch one another.
vtkSmartPointer<vtkImageData> VolumeWithLosses()
{
  return LabelVolume({ 3, 12, 0, 9, -2, 7 },
    [](int i, int j, int k)
    {
      const bool box = i >= 5 && i <= 8 && j >= 2 && j <= 5 && k >= 0 && k <= 3;
      return box || (i == 12 && j == 9 && k == 7) ? 4 : j == 8 && k == 5 ? (i == 4 ? 7 : i == 5 || i == 6 ? 9 : 0) : 0;
    });
}

vtkSmartPointer<vtkPolyData> BoxMesh(const Vec3& low, const Vec3& high)
{
  InterfaceMesh mesh;
  for (int n = 0; n < 8; ++n)
  {
    Particle particle;
    particle.Position = Vec3(n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2]);
    particle.Materials.Insert(0);
    particle.Materials.Insert(1);
    mesh.Vertices.push_back(particle);
  }
  for (const auto& q : { std::array<Index, 4>{ 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
         { 0, 4, 6, 2 }, { 1, 3, 7, 5 } })
  {
    mesh.Triangles.push_back({ { q[0], q[1], q[2] }, { 1, 0 } });
    mesh.Triangles.push_back({ { q[0], q[2], q[3] }, { 1, 0 } });
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  const GridFrame frame({ 0, 9, 0, 9, 0, 9 }, Vec3::Zero(), Vec3::Ones(), Mat3::Identity());
  InterfaceToPolyData(mesh, HeaderWith(frame, { 0, 4, 7, 9 }, 0), output);
  return output;
}

std::string Text(vtkTable* table, vtkIdType row, const char* column)
{
  return table->GetValueByName(row, column).ToString();
}

double Total(vtkTable* table, const char* name)
{
  vtkDataArray* array = table->GetFieldData()->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  return array ? array->GetComponent(0, 0) : 0.0;
}

std::string Certificate(vtkLabelMeshReport* report)
{
  return vtkStringArray::SafeDownCast(report->GetOutput(0)->GetFieldData()->GetAbstractArray("Certificate"))
    ->GetValue(0);
}

double Cell(vtkTable* table, vtkIdType row, const char* column)
{
  EXPECT_NE(table->GetColumnByName(column), nullptr) << column;
  return table->GetValueByName(row, column).ToDouble();
}
}

TEST(LabelImage, ReadsAnyType)
{
  const auto volume = Volume();
  const LabelImage image = ReadLabelImage(volume, volume->GetPointData()->GetScalars(), false);
  EXPECT_EQ(image.Labels, (std::vector<Label>{ 0, 4, 7, 9, 11 }));
  EXPECT_EQ(std::count(image.Ids.begin(), image.Ids.end(), MaterialId(1)), 3 * 4 * 4);
  EXPECT_EQ(std::count(image.Ids.begin(), image.Ids.end(), MaterialId(2)), 2 * 4 * 4);

  LabelImage merged = image;
  MergeIntoBackground(merged, { 4, 9 }, 0);
  EXPECT_EQ(merged.Labels, (std::vector<Label>{ 0, 4, 9 }));
  EXPECT_EQ(std::count(merged.Ids.begin(), merged.Ids.end(), MaterialId(1)), 48);

  vtkNew<vtkFloatArray> floats;
  floats->DeepCopy(volume->GetPointData()->GetScalars());
  EXPECT_EQ(ReadLabelImage(volume, floats, false).Ids, image.Ids);
  floats->SetValue(17, 0.5f);
  EXPECT_THROW(ReadLabelImage(volume, floats, false), std::invalid_argument);
  EXPECT_THROW(ReadLabelImage(volume, nullptr, false), std::invalid_argument);

  vtkNew<vtkFloatArray> cells;
  cells->SetNumberOfValues(volume->GetNumberOfCells());
  cells->FillValue(3);
  const LabelImage ofCells = ReadLabelImage(volume, cells, true);
  EXPECT_LT((ofCells.Frame.ToWorld(2, 0, 0) - Vec3(1.25, 0.5, 1)).norm(), 1e-12) << "centres of the cells";
  EXPECT_EQ(ofCells.Labels, (std::vector<Label>{ 3 }));
  EXPECT_THROW(ReadLabelImage(volume, cells, false), std::invalid_argument);
  const auto flat = LabelVolume({ 0, 5, 0, 5, 0, 0 }, [](int, int, int) { return 1; });
  EXPECT_THROW(ReadLabelImage(flat, flat->GetPointData()->GetScalars(), false), std::invalid_argument);
}

TEST(LabelMeshReport, MeshAlone)
{
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, Mesh({ 0, 4, 7 }));
  report->Update();
  vtkTable* materials = report->GetOutput(0);
  vtkTable* pairs = report->GetOutput(1);
  ASSERT_EQ(materials->GetNumberOfRows(), 3);
  ASSERT_EQ(pairs->GetNumberOfRows(), 3);
  EXPECT_EQ(Cell(materials, 0, "Label"), 0);
  EXPECT_EQ(materials->GetValueByName(2, "Name").ToString(), "Label_7");
  EXPECT_NEAR(Cell(materials, 1, "Volume"), 1, 1e-12);
  EXPECT_NEAR(Cell(materials, 2, "Volume"), 2, 1e-12);
  EXPECT_NEAR(Cell(materials, 0, "Volume"), -3, 1e-12);
  for (int row = 0; row < 3; ++row)
  {
    EXPECT_EQ(Cell(materials, row, "Closed"), 1);
    EXPECT_EQ(Cell(materials, row, "EdgeManifold"), 1);
    EXPECT_EQ(Cell(materials, row, "Oriented"), 1);
    EXPECT_EQ(Cell(materials, row, "NonManifoldVertices"), 0);
    EXPECT_EQ(Cell(materials, row, "Components"), 1);
    EXPECT_EQ(Cell(materials, row, "Euler"), 2);
    EXPECT_EQ(Cell(materials, row, "Lost"), 0);
  }
  EXPECT_EQ(Cell(materials, 1, "Triangles"), 12);
  EXPECT_EQ(Cell(materials, 1, "Vertices"), 8);
  EXPECT_NEAR(Cell(materials, 1, "Area"), 6, 1e-12);
  EXPECT_EQ(materials->GetColumnByName("VoxelVolume"), nullptr);
  EXPECT_EQ(Cell(pairs, 2, "LabelA"), 7);
  EXPECT_EQ(Cell(pairs, 2, "LabelB"), 0) << "the background second";
  EXPECT_EQ(Cell(pairs, 1, "LabelB"), 7);
  EXPECT_EQ(Cell(pairs, 1, "Triangles"), 2);
  EXPECT_EQ(materials->GetFieldData()->GetArray("Triangles")->GetComponent(0, 0), 22);
  EXPECT_EQ(materials->GetFieldData()->GetArray("Points")->GetComponent(0, 0), 12);
  EXPECT_EQ(materials->GetFieldData()->GetArray("WrongFaces")->GetComponent(0, 0), 0);
}

TEST(LabelMeshReport, WithTheImageAndTheStages)
{
  vtkNew<vtkPartitionedDataSetCollection> stages;
  WriteMaterials(stages->GetFieldData(), { DefaultMaterial(4), DefaultMaterial(7) }, 0);
  for (const char* name : { Names::MaskVolumes, Names::TightVolumes })
  {
    vtkNew<vtkDoubleArray> volumes;
    volumes->SetName(name);
    volumes->InsertNextValue(10);
    volumes->InsertNextValue(20);
    stages->GetFieldData()->AddArray(volumes);
  }
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, Mesh({ 0, 4, 7, 9 }));
  report->SetInputData(1, Volume());
  report->SetInputData(2, stages);
  report->Update();
  vtkTable* materials = report->GetOutput(0);
  ASSERT_EQ(materials->GetNumberOfRows(), 4) << "11 is not one of the mesh's labels: background";
  EXPECT_DOUBLE_EQ(Cell(materials, 1, "VoxelVolume"), 48);
  EXPECT_DOUBLE_EQ(Cell(materials, 3, "VoxelVolume"), 1);
  EXPECT_EQ(Cell(materials, 3, "Lost"), 1) << "9 has a voxel and no triangle";
  EXPECT_EQ(Cell(materials, 2, "TightVolume"), 20);
  EXPECT_EQ(Cell(materials, 1, "MaskVolume"), 10);
  vtkTable* pairs = report->GetOutput(1);
  ASSERT_EQ(pairs->GetNumberOfRows(), 4);
  EXPECT_EQ(Cell(pairs, 1, "VoxelFaces"), 16);
  EXPECT_EQ(Cell(pairs, 1, "Lost"), 0);
  EXPECT_EQ(Cell(pairs, 3, "LabelA"), 9);
  EXPECT_EQ(Cell(pairs, 3, "Lost"), 1);

  vtkPolyData* unlisted = vtkPolyData::SafeDownCast(report->GetInputDataObject(0, 0));
  unlisted->GetFieldData()->Initialize();
  unlisted->Modified();
  report->Update();
  EXPECT_EQ(report->GetOutput(0)->GetNumberOfRows(), 5) << "without a list every label of the image counts";
}

TEST(LabelMeshReport, BrokenAndEmptyMeshes)
{
  vtkNew<vtkLabelMeshReport> report;
  const auto mesh = Mesh({ 0, 4, 7 });
  mesh->BuildCells();
  mesh->DeleteCell(0);
  mesh->RemoveDeletedCells();
  report->SetInputData(0, mesh);
  report->Update();
  EXPECT_EQ(Cell(report->GetOutput(0), 1, "Closed"), 0);
  EXPECT_EQ(Cell(report->GetOutput(0), 1, "OpenEdges"), 3);
  EXPECT_EQ(Cell(report->GetOutput(0), 2, "Closed"), 1);

  vtkNew<vtkPolyData> empty;
  report->SetInputData(0, empty);
  report->SetInputData(1, Volume());
  report->Update();
  EXPECT_EQ(report->GetOutput(0)->GetNumberOfRows(), 5);
  EXPECT_EQ(Cell(report->GetOutput(0), 4, "Lost"), 1);
}

TEST(LabelMeshReport, Certificate)
{
  vtkNew<vtkLabelMeshReport> report;
  const auto mesh = Mesh({ 0, 4, 7 });
  report->SetInputData(0, mesh);
  report->Update();
  vtkTable* materials = report->GetOutput(0);
  EXPECT_EQ(Total(materials, "Certified"), 1);
  EXPECT_EQ(Certificate(report).find("certified: 22 triangles"), 0u) << Certificate(report);
  for (int row = 0; row < 3; ++row)
  {
    EXPECT_EQ(Cell(materials, row, "Certified"), 1);
    EXPECT_EQ(Cell(materials, row, "VertexManifold"), 1);
    EXPECT_EQ(Cell(materials, row, "Genus"), 0);
    EXPECT_EQ(Cell(materials, row, "Parts"), 1);
    EXPECT_EQ(Cell(materials, row, "Cavities"), row == 0 ? 1 : 0);
  }
  // The worst triangle, and where it is.
  const auto worst = vtkIdType(Total(materials, "WorstTriangle"));
  double position[3], expected[3] = { 0, 0, 0 };
  materials->GetFieldData()->GetArray("WorstPosition")->GetTuple(0, position);
  for (int c = 0; c < 3; ++c)
  {
    double x[3];
    mesh->GetPoint(mesh->GetCell(worst)->GetPointId(c), x);
    for (int a = 0; a < 3; ++a)
    {
      expected[a] += x[a] / 3;
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(position[a], expected[a], 1e-5);
  }
  EXPECT_NEAR(mesh->GetCellData()->GetArray(Names::RadiusRatio)->GetComponent(worst, 0),
    Total(materials, "MinRadiusRatio"), 1e-12);

  // A corner pulled through the opposite side: closed and manifold as before, but it cuts itself.
  double x[3], far[3];
  mesh->GetPoint(0, x);
  mesh->GetPoint(11, far);
  mesh->GetPoints()->SetPoint(0, 2 * far[0] - x[0], 2 * far[1] - x[1], 2 * far[2] - x[2]);
  mesh->Modified();
  report->Update();
  EXPECT_EQ(Total(materials, "Certified"), 0);
  EXPECT_GT(Total(materials, "SelfIntersectingPairs"), 0);
  EXPECT_GT(Cell(materials, 0, "SelfIntersections"), 0);
  EXPECT_EQ(Cell(materials, 1, "EdgeManifold"), 1);
  EXPECT_EQ(Certificate(report).find("not certified: "), 0u);
  EXPECT_NE(Certificate(report).find("of triangles intersect"), std::string::npos) << Certificate(report);

  const auto open = Mesh({ 0, 4, 7 });
  open->BuildCells();
  open->DeleteCell(0);
  open->RemoveDeletedCells();
  report->SetInputData(0, open);
  report->Update();
  EXPECT_EQ(Total(materials, "Certified"), 0);
  EXPECT_EQ(Cell(materials, 1, "Genus"), -1) << "an open surface has none";
  EXPECT_NE(Certificate(report).find("6 open edges of the surfaces of labels 0, 4"), std::string::npos)
    << Certificate(report);
}

TEST(LabelMeshReport, LedgerOfLosses)
{
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, BoxMesh(Vec3(4.5, 1.5, -0.5), Vec3(8.5, 5.5, 3.5)));
  report->SetInputData(1, VolumeWithLosses());
  report->Update();
  vtkTable* materials = report->GetOutput(0);
  EXPECT_EQ(Cell(materials, 1, "Voxels"), 65);
  EXPECT_EQ(Cell(materials, 1, "VoxelParts"), 2);
  EXPECT_EQ(Cell(materials, 1, "VoxelEuler"), 4);
  EXPECT_EQ(Cell(materials, 1, "VoxelGenus"), 0);
  EXPECT_EQ(Cell(materials, 1, "VoxelComponents"), 2);
  EXPECT_EQ(Cell(materials, 1, "Parts"), 1);
  EXPECT_EQ(Cell(materials, 1, "LostParts"), 1);
  EXPECT_EQ(Cell(materials, 1, "MisclassifiedVoxels"), 1);
  EXPECT_EQ(Total(materials, "MisclassifiedVoxels"), 1 + 1 + 2);
  EXPECT_EQ(Total(materials, "UndecidedVoxels"), 0);

  vtkTable* losses = report->GetOutput(2);
  const char* const kinds[] = { "label", "label", "parts", "pair", "pair", "pair" };
  const int labels[][2] = { { 7, 7 }, { 9, 9 }, { 4, 4 }, { 7, 0 }, { 9, 0 }, { 7, 9 } };
  const int sizes[][2] = { { 1, 1 }, { 1, 2 }, { 1, 1 }, { 0, 5 }, { 0, 9 }, { 0, 1 } };
  ASSERT_EQ(losses->GetNumberOfRows(), 6);
  for (int row = 0; row < 6; ++row)
  {
    EXPECT_EQ(Text(losses, row, "Kind"), kinds[row]);
    EXPECT_EQ(Cell(losses, row, "LabelA"), labels[row][0]);
    EXPECT_EQ(Cell(losses, row, "LabelB"), labels[row][1]);
    EXPECT_EQ(Cell(losses, row, "Parts"), sizes[row][0]);
    EXPECT_EQ(Cell(losses, row, "Voxels"), sizes[row][1]);
    EXPECT_EQ(Text(losses, row, "Stage"), "") << "nothing tells it";
    EXPECT_FALSE(Text(losses, row, "Advice").empty());
  }
  double position[3];
  vtkDataArray::SafeDownCast(losses->GetColumnByName("Position"))->GetTuple(2, position);
  EXPECT_EQ(Vec3(position[0], position[1], position[2]), Vec3(12, 9, 7));
}

TEST(LabelMeshReport, StagesOfLosses)
{
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, BoxMesh(Vec3(4.5, 1.5, -0.5), Vec3(8.5, 5.5, 3.5)));
  const auto volume = VolumeWithLosses();
  report->SetInputData(1, volume);
  const auto stageOf = [&](int row)
  {
    report->Update();
    return Text(report->GetOutput(2), row, "Stage");
  };
  // Volumes: label 7 has no mask, 9 is gone after tightening.
  vtkNew<vtkPartitionedDataSetCollection> stages;
  WriteMaterials(stages->GetFieldData(), { DefaultMaterial(4), DefaultMaterial(7), DefaultMaterial(9) }, 0);
  const double values[2][3] = { { 65, 0, 2 }, { 64, 0, 0 } };
  for (int stage = 0; stage < 2; ++stage)
  {
    vtkNew<vtkDoubleArray> volumes;
    volumes->SetName(stage == 0 ? Names::MaskVolumes : Names::TightVolumes);
    for (const double value : values[stage])
    {
      volumes->InsertNextValue(value);
    }
    stages->GetFieldData()->AddArray(volumes);
  }
  report->SetInputData(2, stages);
  EXPECT_EQ(stageOf(0), "LabelSplit");
  EXPECT_EQ(stageOf(1), "Tighten");
  EXPECT_EQ(stageOf(2), "") << "the volume of 4 says nothing of its speck";

  // What the indicators say of the voxels: the speck is there.
  const auto tight =
    LabelVolume({ 3, 12, 0, 9, -2, 7 }, [](int i, int j, int k) { return i == 12 && j == 9 && k == 7 ? 4 : 0; });
  tight->GetPointData()->GetScalars()->SetName(Names::Label);
  report->SetInputData(3, tight);
  EXPECT_EQ(stageOf(2), "ParticleSampleCells or later");
  EXPECT_EQ(stageOf(5), "LabelSplit") << "7 and 9";

  // Particles that know of the speck, and then none that do.
  vtkNew<vtkPolyData> particles;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(12.4, 9, 7);
  particles->SetPoints(points);
  vtkNew<vtkTypeInt64Array> sets;
  sets->SetName(Names::Materials);
  sets->SetNumberOfComponents(8);
  const double set[8] = { 0, 4, 4, 4, 4, 4, 4, 4 };
  sets->InsertNextTuple(set);
  vtkNew<vtkUnsignedCharArray> numbers;
  numbers->SetName(Names::NumberOfMaterials);
  numbers->InsertNextValue(2);
  particles->GetPointData()->AddArray(sets);
  particles->GetPointData()->AddArray(numbers);
  report->SetInputData(4, particles);
  EXPECT_EQ(stageOf(2), "DelaunayLabelMesh");
  points->SetPoint(0, 9, 9, 7);
  points->Modified();
  particles->Modified();
  EXPECT_EQ(stageOf(2), "ParticleSampleCells");
  report->RemoveAllInputConnections(3);
  EXPECT_EQ(stageOf(2), "Tighten") << "particles lie on all that smoothing has left";
  points->SetPoint(0, 12.4, 9, 7);
  points->Modified();
  particles->Modified();
  EXPECT_EQ(stageOf(2), "Tighten or later") << "a particle beside the speck may be of another part";
}

TEST(LabelMeshReport, RebuiltVoxelsStandInForTheirImage)
{
  // Smoothing takes the speck of two voxels and the thread away, and rounds the ball.
  const auto volume = LabelVolume({ 2, 21, -3, 16, 5, 24 },
    [](int i, int j, int k)
    {
      const bool ball = (i - 12) * (i - 12) + (j - 6) * (j - 6) + (k - 14) * (k - 14) < 30;
      return ball ? 4 : i == 4 && j == 0 && k < 9 ? 7 : i < 6 && j == 14 && k == 20 ? 9 : k == 23 ? 5 : 0;
    });
  vtkNew<vtkLabelMesher> mesher;
  Complaints complaints(mesher);
  mesher->SetInputData(volume);
  mesher->SetSmoothing(vtkTighten::Tightening);
  mesher->SetRadius(1.5);
  mesher->AddLabel(4);
  mesher->AddLabel(7);
  mesher->AddLabel(9); // 5 is not to be meshed
  mesher->Update();
  vtkDataArray* voxels = mesher->GetSurfaces()->GetFieldData()->GetArray(Names::RebuiltVoxels);
  ASSERT_NE(voxels, nullptr);
  EXPECT_LT(voxels->GetNumberOfValues(), 300) << "those that smoothing took alone";

  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, mesher->GetOutput());
  report->SetInputData(1, volume);
  report->SetInputData(2, mesher->GetSurfaces());
  report->SetInputData(4, mesher->GetParticles());
  const auto ledger = [&]()
  {
    report->Update();
    std::string text;
    for (vtkIdType row = 0; row < report->GetOutput(2)->GetNumberOfRows(); ++row)
    {
      text += Text(report->GetOutput(2), int(row), "What") + " " + Text(report->GetOutput(2), int(row), "Stage") + "\n";
    }
    return text;
  };
  const std::string withVoxels = ledger();
  EXPECT_EQ(Text(report->GetOutput(2), 0, "Stage"), "Tighten") << withVoxels;
  EXPECT_EQ(Text(report->GetOutput(2), 1, "Stage"), "Tighten") << withVoxels;
  report->SetInputData(3, mesher->GetLabelImage());
  EXPECT_EQ(ledger(), withVoxels);

  // Those of another volume.
  report->SetInputData(3, nullptr);
  report->SetInputData(1, LabelVolume({ 0, 3, 0, 3, 0, 3 }, [](int i, int, int) { return i < 2 ? 4 : 0; }));
  Complaints words(report);
  report->Update();
  EXPECT_TRUE(words.Say("another volume")) << words.Text;
}

TEST(LabelMeshReport, ErrorMap)
{
  vtkNew<vtkLabelMeshReport> report;
  Complaints complaints(report);
  report->SetInputData(0, BoxMesh(Vec3(4.5, 1.5, -0.25), Vec3(8.5, 5.5, 3.5)));
  report->SetInputData(1, VolumeWithLosses());
  report->Update();
  EXPECT_EQ(report->GetErrorMapOutput()->GetNumberOfPoints(), 0);
  report->ErrorMapOn();
  report->Update();
  vtkPolyData* map = report->GetErrorMapOutput();
  ASSERT_EQ(map->GetNumberOfCells(), 12);
  vtkDataArray* distances = map->GetPointData()->GetArray(Names::DistanceToVoxels);
  ASSERT_NE(distances, nullptr);
  for (vtkIdType p = 0; p < 8; ++p)
  {
    // The lower side lies a quarter of a voxel inside; its corners are on the faces beside it.
    EXPECT_NEAR(distances->GetComponent(p, 0), 0.0, 1e-6);
  }
  EXPECT_NEAR(Total(report->GetOutput(0), "MaxDistanceToVoxels"), 0.0, 1e-6);
  EXPECT_EQ(Total(report->GetOutput(0), "FarPoints"), 0);
  EXPECT_EQ(complaints.Count, 0) << complaints.Text;
  report->RemoveAllInputConnections(1);
  report->Update();
  EXPECT_TRUE(complaints.Say("input port 1")) << complaints.Text;
}

TEST(LabelMeshReport, CountsRadiusRatiosInBins)
{
  // Halves of squares have a radius ratio of 2 (sqrt(2) - 1), those of rectangles of 2 by 1 of 0.68.
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, Mesh({ 0, 4, 7 }));
  report->Update();
  vtkTable* ratios = report->GetRadiusRatiosOutput();
  ASSERT_EQ(ratios->GetNumberOfRows(), 50);
  EXPECT_EQ(ratios->GetColumnByName("Tetrahedra"), nullptr);
  double counted = 0.0;
  for (vtkIdType bin = 0; bin < 50; ++bin)
  {
    counted += Cell(ratios, bin, "Triangles");
  }
  EXPECT_EQ(counted, Total(report->GetOutput(0), "Triangles"));
  EXPECT_EQ(Cell(ratios, 41, "Triangles") + Cell(ratios, 34, "Triangles") + Cell(ratios, 33, "Triangles"), counted);
  report->SetInputData(0, vtkNew<vtkPolyData>());
  report->Update();
  EXPECT_EQ(report->GetRadiusRatiosOutput()->GetNumberOfRows(), 50);
}

TEST(LabelMeshReport, SaysWhatIsMissing)
{
  vtkNew<vtkLabelMeshReport> report;
  Complaints complaints(report);
  const auto mesh = Mesh({ 0, 4, 7 });
  mesh->GetCellData()->RemoveArray(Names::BoundaryLabels);
  report->SetInputData(0, mesh);
  report->Update();
  EXPECT_EQ(complaints.Count, 1);
  EXPECT_TRUE(complaints.Say(Names::BoundaryLabels)) << complaints.Text;

  report->SetInputData(0, Mesh({ 0, 4, 7 }));
  report->SetInputData(1, Volume());
  report->SetInputData(3, Volume());
  report->Update();
  EXPECT_TRUE(complaints.Say("Indicator Reconstruct")) << complaints.Text;
  report->RemoveAllInputConnections(3);
  report->SetInputData(4, BoxMesh(Vec3::Zero(), Vec3::Ones()));
  report->Update();
  EXPECT_EQ(complaints.Count, 2) << "any points with Materials will do: " << complaints.Text;
  vtkNew<vtkPolyData> bare;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  bare->SetPoints(points);
  report->SetInputData(4, bare);
  report->Update();
  EXPECT_TRUE(complaints.Say("Particle Sample Cells")) << complaints.Text;
}
