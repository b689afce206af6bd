// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExplodeLabels.h"

#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"
#include "TestTetrahedra.h"
#include "vtkLabelMesher.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

using namespace TestMeshes;

namespace
{
vtkPointSet* Block(vtkExplodeLabels* explode, unsigned int n)
{
  return vtkPointSet::SafeDownCast(explode->GetOutput()->GetPartitionAsDataObject(n, 0));
}

Vec3 CenterOf(vtkPointSet* points)
{
  Vec3 center;
  points->GetCenter(center.data());
  return center;
}

/// Two cubes of labels 3 and 5 side by side along x, with a point array.
vtkSmartPointer<vtkUnstructuredGrid> TwoCubes()
{
  auto grid =
    TestTetrahedra::Box({ 2, 1, 1 }, Vec3(10, 0, 0), [](int i, int, int) { return LabelMesh::Label(i == 0 ? 5 : 3); });
  vtkNew<vtkTypeInt64Array> numbers;
  numbers->SetName("Number");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    numbers->InsertNextValue(p);
  }
  grid->GetPointData()->AddArray(numbers);
  return grid;
}
}

TEST(ExplodeLabels, TakesTetrahedraApartByLabel)
{
  const auto grid = TwoCubes();
  vtkNew<vtkExplodeLabels> explode;
  explode->SetInputDataObject(grid);
  explode->SetFactor(2.0);
  explode->Update();
  ASSERT_EQ(explode->GetOutput()->GetNumberOfPartitionedDataSets(), 2u);
  // Label 3 is the cube around x = 11.5, 5 the one around 10.5; the centre of both is 11.
  EXPECT_NEAR((CenterOf(Block(explode, 0)) - Vec3(11.5 + 2 * 0.5, 0.5, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((CenterOf(Block(explode, 1)) - Vec3(10.5 - 2 * 0.5, 0.5, 0.5)).norm(), 0.0, 1e-12);
  const LabelMesh::Label labels[] = { 3, 5 };
  for (unsigned int n = 0; n < 2; ++n)
  {
    vtkPointSet* cube = Block(explode, n);
    EXPECT_EQ(cube->GetNumberOfCells(), 6);
    EXPECT_EQ(cube->GetNumberOfPoints(), 8);
    EXPECT_EQ(cube->GetCellData()->GetArray(Names::Label)->GetRange(0)[0], labels[n]);
    EXPECT_EQ(cube->GetCellData()->GetArray(Names::Label)->GetRange(0)[1], labels[n]);
    EXPECT_EQ(cube->GetFieldData()->GetArray(Names::Label)->GetTuple1(0), labels[n]);
    EXPECT_STREQ(
      explode->GetOutput()->GetMetaData(n)->Get(vtkCompositeDataSet::NAME()), n == 0 ? "Label_3" : "Label_5");
    // Each point still is the one that it was, moved.
    for (vtkIdType p = 0; p < cube->GetNumberOfPoints(); ++p)
    {
      const auto number = vtkIdType(cube->GetPointData()->GetArray("Number")->GetTuple1(p));
      EXPECT_NEAR(cube->GetPoint(p)[0] - grid->GetPoint(number)[0], n == 0 ? 1.0 : -1.0, 1e-12);
      EXPECT_EQ(cube->GetPoint(p)[1], grid->GetPoint(number)[1]);
    }
  }
}

TEST(ExplodeLabels, MovesSurfacesOfAMeshAndOfACollectionAlike)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(TwoSpheres(32));
  mesher->SetMaterialName(2, "lower");
  vtkNew<vtkExplodeLabels> one, other;
  one->SetInputConnection(mesher->GetOutputPort(0));
  other->SetInputConnection(mesher->GetOutputPort(1));
  one->Update();
  other->Update();
  ASSERT_EQ(one->GetOutput()->GetNumberOfPartitionedDataSets(), 2u);
  ASSERT_EQ(other->GetOutput()->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_STREQ(other->GetOutput()->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "lower");
  vtkPartitionedDataSetCollection* surfaces = mesher->GetSurfaces();
  double all[6];
  surfaces->GetBounds(all);
  const Vec3 middle(0.5 * (all[0] + all[1]), 0.5 * (all[2] + all[3]), 0.5 * (all[4] + all[5]));
  for (unsigned int n = 0; n < 2; ++n)
  {
    vtkPointSet* before = vtkPointSet::SafeDownCast(surfaces->GetPartitionAsDataObject(n, 0));
    const Vec3 moved = CenterOf(Block(one, n)) - CenterOf(before);
    EXPECT_NEAR((moved - 0.5 * (CenterOf(before) - middle)).norm(), 0.0, 1e-5);
    EXPECT_EQ(Block(one, n)->GetNumberOfCells(), before->GetNumberOfCells());
    EXPECT_NE(Block(one, n)->GetCellData()->GetArray(Names::RadiusRatio), nullptr);
    ASSERT_EQ(Block(one, n)->GetNumberOfPoints(), Block(other, n)->GetNumberOfPoints());
    for (vtkIdType p = 0; p < before->GetNumberOfPoints(); ++p)
    {
      const Vec3 x(Block(one, n)->GetPoint(p)), y(Block(other, n)->GetPoint(p));
      ASSERT_NEAR((x - y).norm(), 0.0, 1e-12);
    }
  }
  // The spheres, which touched, do not any more.
  EXPECT_LT(Block(one, 1)->GetBounds()[5], Block(one, 0)->GetBounds()[4]);
}

TEST(ExplodeLabels, MovesNothingByFactorZero)
{
  const auto grid = TwoCubes();
  vtkNew<vtkExplodeLabels> explode;
  explode->SetInputDataObject(grid);
  explode->SetFactor(0.0);
  explode->Update();
  EXPECT_EQ(CenterOf(Block(explode, 0)), Vec3(11.5, 0.5, 0.5));
}

TEST(ExplodeLabels, TakesEmptyInputs)
{
  vtkNew<vtkExplodeLabels> explode;
  for (const vtkSmartPointer<vtkDataObject>& input : { vtkSmartPointer<vtkDataObject>(vtkNew<vtkPolyData>()),
         vtkSmartPointer<vtkDataObject>(vtkNew<vtkUnstructuredGrid>()),
         vtkSmartPointer<vtkDataObject>(vtkNew<vtkPartitionedDataSetCollection>()) })
  {
    explode->SetInputDataObject(input);
    explode->Update();
    EXPECT_EQ(explode->GetOutput()->GetNumberOfPartitionedDataSets(), 0u) << input->GetClassName();
  }
}

TEST(ExplodeLabels, SaysWhatItCannotMove)
{
  vtkNew<vtkExplodeLabels> explode;
  vtkNew<vtkPartitionedDataSetCollection> images;
  images->SetPartition(0, 0, vtkNew<vtkImageData>());
  Complaints complaints(explode);
  explode->SetInputDataObject(images);
  explode->Update();
  EXPECT_TRUE(complaints.Say("has no points to move")) << complaints.Text;
  const auto grid = TwoCubes();
  grid->GetCellData()->RemoveArray(Names::Label);
  explode->SetInputDataObject(grid);
  explode->Update();
  EXPECT_TRUE(complaints.Say("no cell array 'Label'")) << complaints.Text;
}
