// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelSurvey.h"

#include "TestCollections.h"
#include "TestMeshes.h"
#include "vtkLabelSplit.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

using namespace TestMeshes;
using TestCollections::Listener;

namespace
{
double Value(vtkAbstractArray* column, vtkIdType row)
{
  return vtkDataArray::SafeDownCast(column)->GetComponent(row, 0);
}

/// Labels -4 (the left half), 900 (a voxel) and 0, in a corner of the volume.
vtkSmartPointer<vtkImageData> SmallVolume()
{
  return LabelVolume(
    { 3, 6, 0, 2, -1, 1 }, [](int i, int j, int k) { return i < 5                   ? -4
                                                       : i == 6 && j == 1 && k == 0 ? 900
                                                                                    : 0; });
}
}

TEST(LabelSurveyFilter, CountsVoxelsAndFaces)
{
  vtkNew<vtkLabelSurvey> survey;
  EXPECT_EQ(survey->GetLabels(), nullptr) << "before it has run";
  survey->SetInputDataObject(SmallVolume());
  survey->Update();
  vtkTable* labels = survey->GetOutput();
  ASSERT_EQ(labels->GetNumberOfRows(), 3);
  const std::array<std::array<double, 2>, 3> expected{ { { -4, 18 }, { 0, 17 }, { 900, 1 } } };
  vtkNew<vtkLabelSplit> split;
  for (int row = 0; row < 3; ++row)
  {
    const vtkIdType label = vtkIdType(expected[row][0]);
    EXPECT_EQ(labels->GetValueByName(row, "Label").ToLongLong(), label);
    EXPECT_EQ(labels->GetValueByName(row, "Voxels").ToLongLong(), expected[row][1]);
    EXPECT_EQ(labels->GetValueByName(row, "Name").ToString(), split->GetMaterialName(label));
    std::array<double, 3> color, own;
    split->GetMaterialColor(label, color.data());
    vtkDataArray::SafeDownCast(labels->GetColumnByName("Color"))->GetTuple(row, own.data());
    EXPECT_EQ(own, color);
    EXPECT_EQ(Value(survey->GetLabels(), row), double(label));
    EXPECT_EQ(Value(survey->GetVoxels(), row), expected[row][1]);
    EXPECT_EQ(vtkStringArray::SafeDownCast(survey->GetNames())->GetValue(row), split->GetMaterialName(label));
  }
  ASSERT_EQ(vtkDoubleArray::SafeDownCast(survey->GetColors())->GetNumberOfComponents(), 3);

  // -4 has the border's faces around its 2 x 3 x 3 voxels, and a layer of 9 towards 0; 900 one face at the border.
  vtkTable* pairs = vtkTable::SafeDownCast(survey->GetOutputDataObject(1));
  ASSERT_EQ(pairs->GetNumberOfRows(), 2);
  const std::array<std::array<double, 3>, 2> contacts{ { { -4, 0, 9 + 9 + 4 * 6 }, { 0, 900, 6 } } };
  for (int row = 0; row < 2; ++row)
  {
    EXPECT_EQ(Value(survey->GetPairLabelsA(), row), contacts[row][0]);
    EXPECT_EQ(Value(survey->GetPairLabelsB(), row), contacts[row][1]);
    EXPECT_EQ(Value(survey->GetPairVoxelFaces(), row), contacts[row][2]);
    EXPECT_EQ(pairs->GetValueByName(row, "VoxelFaces").ToDouble(), contacts[row][2]);
  }
}

TEST(LabelSurveyFilter, ABackgroundThatDoesNotOccurTouchesTheBorderOnly)
{
  vtkNew<vtkLabelSurvey> survey;
  survey->SetInputDataObject(SmallVolume());
  survey->SetBackgroundLabel(7);
  survey->Update();
  EXPECT_EQ(survey->GetOutput()->GetNumberOfRows(), 3) << "no row for a label without voxels";
  EXPECT_EQ(survey->GetPairLabelsA()->GetNumberOfTuples(), 5); // each label with 7, and the two from before
  EXPECT_EQ(Value(survey->GetPairLabelsA(), 0), -4);
  EXPECT_EQ(Value(survey->GetPairLabelsB(), 0), 0);
  EXPECT_EQ(Value(survey->GetPairVoxelFaces(), 0), 9);
}

TEST(LabelSurveyFilter, SaysWhatIsWrongAsAnErrorOrInAString)
{
  vtkSmartPointer<vtkImageData> image = SmallVolume();
  vtkNew<vtkDoubleArray> fractions;
  fractions->SetName("density");
  fractions->SetNumberOfValues(image->GetNumberOfPoints());
  fractions->FillValue(0.5);
  image->GetPointData()->SetScalars(fractions);
  vtkNew<vtkLabelSurvey> survey;
  survey->SetInputDataObject(image);
  Listener listener(survey), pipeline(survey->GetExecutive());
  survey->Update();
  EXPECT_NE(listener.Errors.find("not an integer label"), std::string::npos) << listener.Errors;
  listener.Errors.clear();
  survey->QuietOn();
  survey->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_NE(std::string(survey->GetTrouble()).find("'density' holds 0.5"), std::string::npos) << survey->GetTrouble();
  EXPECT_EQ(survey->GetOutput()->GetNumberOfRows(), 0);
  EXPECT_EQ(survey->GetLabels()->GetNumberOfTuples(), 0);
  survey->SetInputDataObject(SmallVolume());
  survey->Update();
  EXPECT_STREQ(survey->GetTrouble(), "");
}

TEST(LabelSurveyFilter, AnEmptyImageGivesEmptyTables)
{
  vtkNew<vtkImageData> empty;
  vtkNew<vtkLabelSurvey> survey;
  survey->SetInputDataObject(empty);
  Listener listener(survey), pipeline(survey->GetExecutive());
  survey->Update();
  EXPECT_EQ(listener.Errors + pipeline.Errors, "");
  EXPECT_EQ(survey->GetOutput()->GetNumberOfColumns(), 4);
  EXPECT_EQ(survey->GetOutput()->GetNumberOfRows(), 0);
}
