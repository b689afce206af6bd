// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMeshReport.h"

#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

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

double Cell(vtkTable* table, vtkIdType row, const char* column)
{
  EXPECT_NE(table->GetColumnByName(column), nullptr) << column;
  return table->GetValueByName(row, column).ToDouble();
}
}

TEST(LabelImage, ReadsAnyTypeAndCountsContacts)
{
  const auto volume = Volume();
  const LabelImage image = ReadLabelImage(volume, volume->GetPointData()->GetScalars(), false);
  EXPECT_EQ(image.Labels, (std::vector<Label>{ 0, 4, 7, 9, 11 }));
  const LabelCounts counts = CountLabels(image, 0);
  EXPECT_EQ(counts.Voxels[1], 3 * 4 * 4);
  EXPECT_EQ(counts.Voxels[2], 2 * 4 * 4);
  Index border = 0, shared = 0;
  for (const LabelCounts::Contact& contact : counts.Contacts)
  {
    shared += contact.Labels == std::array<Label, 2>{ 4, 7 } ? contact.Faces : 0;
    border += contact.Labels == std::array<Label, 2>{ 0, 9 } ? contact.Faces : 0;
  }
  EXPECT_EQ(shared, 16);
  EXPECT_EQ(border, 6) << "space outside the volume counts as background";

  LabelImage merged = image;
  MergeIntoBackground(merged, { 4, 9 }, 0);
  EXPECT_EQ(merged.Labels, (std::vector<Label>{ 0, 4, 9 }));
  EXPECT_EQ(CountLabels(merged, 0).Voxels[1], 48);

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
}
