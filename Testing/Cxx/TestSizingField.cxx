// SPDX-License-Identifier: BSD-3-Clause
// The contract of vtkSizingField.
#include "Core/SizingField.h"
#include "TestCollections.h"
#include "vtkSizingField.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace TestCollections;

namespace
{
const Vec3 Centre(14.2, 13.9, 14.1);

GridFrame Source(const Mat3& direction = Mat3::Identity(), const Vec3& spacing = Vec3::Ones())
{
  const auto last = [&](int axis) { return int(std::lround(28 / spacing[axis])); };
  return GridFrame({ 0, last(0), 0, last(1), 0, last(2) }, Vec3(100, -20, 3), spacing, direction);
}

vtkSmartPointer<vtkPartitionedDataSetCollection> BallCollection(const GridFrame& source)
{
  return MakeCollection(source, 2, BallFields(Centre, 10), Names::Indicator);
}

/// The length at the sample nearest to a local position of the source frame.
double ValueAt(vtkImageData* image, const char* name, const GridFrame& source, const Vec3& local)
{
  const Vec3 index = source.ToIndex(source.LocalToWorld(local));
  int ijk[3] = { int(std::lround(index[0])), int(std::lround(index[1])), int(std::lround(index[2])) };
  return image->GetPointData()->GetArray(name)->GetComponent(image->ComputePointId(ijk), 0);
}
}

TEST(SizingFieldFilter, KeepsItsContractInAnyFrame)
{
  for (const Mat3& direction : { Mat3(Mat3::Identity()), ObliqueDirection(false), ObliqueDirection(true) })
  {
    for (const Vec3& spacing : { Vec3(1, 1, 1), Vec3(0.5, 1, 1) })
    {
      const GridFrame source = Source(direction, spacing);
      vtkNew<vtkSizingField> filter;
      filter->SetInputDataObject(BallCollection(source));
      filter->SetEpsilon(0.5);
      filter->SetFeatureSizeFloor(1.0);
      filter->SetMaximumDeviation(0); // the feature size alone
      filter->UpdateInformation();
      const auto extent = source.Grown(2).Extent();
      const int* whole = filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
      ASSERT_TRUE(std::equal(extent.begin(), extent.end(), whole));
      filter->Update();
      vtkImageData* output = filter->GetOutput();
      ASSERT_TRUE(std::equal(extent.begin(), extent.end(), output->GetExtent()));
      for (int i = 0; i < 9; ++i)
      {
        EXPECT_DOUBLE_EQ(output->GetDirectionMatrix()->GetElement(i / 3, i % 3), direction(i / 3, i % 3));
      }
      for (const char* name : { Names::TargetLength, Names::FeatureSize })
      {
        auto* array = vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray(name));
        ASSERT_TRUE(array) << name;
        EXPECT_EQ(array->GetNumberOfComponents(), 1);
        EXPECT_EQ(array->GetNumberOfTuples(), output->GetNumberOfPoints());
      }
      EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), Names::TargetLength);
      EXPECT_NEAR(ValueAt(output, Names::FeatureSize, source, Centre + Vec3(10, 0, 0)), 10, 1.0);
      EXPECT_NEAR(ValueAt(output, Names::TargetLength, source, Centre + Vec3(10, 0, 0)), 5, 0.6);
      const double area = 4 * 3.14159 * 100;
      EXPECT_NEAR(double(filter->GetPredictedParticles()), 1.2 * area / (0.866 * 25), 15);
    }
  }
}

TEST(SizingFieldFilter, TakesTheUsersImageOnAnyGrid)
{
  const GridFrame source = Source(ObliqueDirection(true));
  // A user's grid with another direction, spacing and extent that covers the half x < 14 of the local frame.
  const Mat3 other = Eigen::AngleAxisd(-1.1, Vec3(0, 1, 2).normalized()).toRotationMatrix();
  const Vec3 middle = source.LocalToWorld(Vec3(14, 14, 14));
  const GridFrame userFrame({ -12, 12, -12, 12, -12, 12 }, middle, Vec3(2, 2.5, 3), other);
  vtkNew<vtkImageData> user;
  SetFrame(user, userFrame);
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("longest");
  lengths->SetNumberOfValues(user->GetNumberOfPoints());
  for (vtkIdType at = 0; at < user->GetNumberOfPoints(); ++at)
  {
    double x[3];
    user->GetPoint(at, x);
    lengths->SetValue(at, source.WorldToLocal(Vec3(x[0], x[1], x[2]))[0] < 14 ? 2.0 : 0.0); // 0: no bound
  }
  user->GetPointData()->AddArray(lengths);

  vtkNew<vtkSizingField> filter;
  filter->SetEpsilon(0.5);
  filter->SetMaximumDeviation(0); // the feature size and the user's bound alone
  filter->SetInputDataObject(0, BallCollection(source));
  filter->SetInputDataObject(1, user);
  Listener listener(filter), pipeline(filter->GetExecutive());
  filter->Update();
  EXPECT_NE(listener.Errors.find("port 1"), std::string::npos) << "no active scalars: " << listener.Errors;

  filter->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "longest");
  filter->Update();
  vtkImageData* output = filter->GetOutput();
  EXPECT_NEAR(ValueAt(output, Names::TargetLength, source, Centre - Vec3(10, 0, 0)), 2, 1e-3);
  EXPECT_NEAR(ValueAt(output, Names::TargetLength, source, Centre + Vec3(10, 0, 0)), 5, 0.6);
  const vtkIdType bounded = filter->GetPredictedParticles();

  filter->SetInputConnection(1, nullptr);
  filter->Update();
  EXPECT_GT(bounded, 2 * filter->GetPredictedParticles());
}

TEST(SizingFieldFilter, PassesItsOptionsOn)
{
  const GridFrame source = Source();
  vtkNew<vtkSizingField> filter;
  filter->SetInputDataObject(BallCollection(source));
  const auto atPole = [&]()
  {
    filter->Update();
    return ValueAt(filter->GetOutput(), Names::TargetLength, source, Centre + Vec3(10, 0, 0));
  };
  EXPECT_EQ(filter->GetEpsilon(), SizingOptions().Epsilon);
  EXPECT_EQ(filter->GetFeatureSizeFloor(), SizingOptions().FeatureSizeFloor);
  EXPECT_EQ(filter->GetMaximumDeviation(), SizingOptions().MaximumDeviation);
  filter->SetEpsilon(0.25);
  EXPECT_NEAR(atPole(), 2.5, 0.3);
  filter->SetMaximumLength(2);
  EXPECT_NEAR(atPole(), 2, 1e-6);
  filter->SetMaximumLength(0);
  filter->SetMaterialMaximumLength(7, 1.5);
  EXPECT_EQ(filter->GetMaterialMaximumLength(7), 1.5);
  EXPECT_NEAR(atPole(), 1.5, 1e-6);
  filter->ClearMaterialMaximumLengths();
  filter->SetInterfaceMaximumLength(7, 0, 1.25);
  EXPECT_EQ(filter->GetInterfaceMaximumLength(0, 7), 1.25) << "labels in any order";
  EXPECT_NEAR(atPole(), 1.25, 1e-6);
  filter->ClearInterfaceMaximumLengths();
  EXPECT_EQ(filter->GetInterfaceMaximumLength(7, 0), 0.0);
  filter->SetMinimumLength(4);
  EXPECT_NEAR(atPole(), 4, 1e-6);
  filter->SetMinimumLength(0);
  filter->SetTargetTriangles(3000);
  atPole();
  EXPECT_NEAR(double(filter->GetPredictedParticles()), 1500, 20);

  Listener listener(filter);
  filter->SetMaximumLength(0.5);
  filter->SetMaterialMaximumLength(99, 1.0);
  filter->SetInterfaceMaximumLength(7, 98, 1.0);
  filter->SetInterfaceMaximumLength(7, 7, 1.0);
  atPole();
  EXPECT_NE(listener.Warnings.find("no interface between the labels 7 and 98"), std::string::npos);
  EXPECT_NE(listener.Warnings.find("no interface between the labels 7 and 7"), std::string::npos);
  EXPECT_NE(listener.Warnings.find("cannot be reached"), std::string::npos) << listener.Warnings;
  EXPECT_NE(listener.Warnings.find("1 labels that are not"), std::string::npos) << listener.Warnings;
  EXPECT_TRUE(listener.Errors.empty()) << listener.Errors;
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("99: 1"), std::string::npos);
  EXPECT_NE(text.str().find("7, 98: 1"), std::string::npos);
}

TEST(SizingFieldFilter, SaysWhatIsWrong)
{
  vtkNew<vtkSizingField> filter;
  Listener listener(filter), pipeline(filter->GetExecutive());
  filter->SetInputDataObject(MakeCollection(Source(), 2, BallFields(Centre, 10), Names::TightDistance));
  filter->Update();
  EXPECT_NE(listener.Errors.find("Indicator Reconstruct"), std::string::npos) << listener.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  listener.Errors.clear();
  filter->SetInputDataObject(BallCollection(Source()));
  filter->SetEpsilon(-1);
  filter->Update();
  EXPECT_NE(listener.Errors.find("Epsilon is -1"), std::string::npos) << listener.Errors;
}

TEST(SizingFieldFilter, GivesAnEmptyImageForAnEmptyCollection)
{
  vtkNew<vtkPartitionedDataSetCollection> empty;
  vtkNew<vtkSizingField> filter;
  Listener listener(filter), pipeline(filter->GetExecutive());
  filter->SetInputDataObject(empty);
  filter->Update();
  EXPECT_TRUE(listener.Errors.empty()) << listener.Errors;
  EXPECT_TRUE(pipeline.Errors.empty()) << pipeline.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray(Names::TargetLength));
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray(Names::FeatureSize));
}

TEST(SizingFieldFilter, StopsWhenAborted)
{
  vtkNew<vtkSizingField> filter;
  filter->SetInputDataObject(BallCollection(Source()));
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*) { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}
