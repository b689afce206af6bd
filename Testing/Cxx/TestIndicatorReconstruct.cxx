// SPDX-License-Identifier: BSD-3-Clause
// The contract of vtkIndicatorReconstruct.
#include "TestCollections.h"
#include "vtkIndicatorReconstruct.h"

#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>
#include <vtkTrivialProducer.h>
#include <vtkTypeInt64Array.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace TestCollections;

namespace
{
const Mat3 Straight = Mat3::Identity();

GridFrame Source(const Mat3& direction = Straight, const Vec3& spacing = Vec3(1, 1, 2))
{
  return GridFrame({ 3, 22, -4, 17, 0, 11 }, Vec3(10, 20, 30), spacing, direction);
}

/// The negated distances to sites: label -2, 0, 3 and 9 meet in a point near the middle of Source().
std::map<Label, Field> FourCells()
{
  const auto site = [](const Vec3& at) { return [=](const Vec3& x) { return 20 - (x - at).norm(); }; };
  return { { -2, site(Vec3(6, 2, 6)) }, { 0, site(Vec3(19, 3, 7)) }, { 3, site(Vec3(12, 14, 6)) },
    { 9, site(Vec3(12, 6, 18)) } };
}

vtkSmartPointer<vtkPartitionedDataSetCollection> Distances(const GridFrame& source)
{
  auto collection = MakeCollection(source, 3, FourCells(), Names::TightDistance);
  vtkNew<vtkIntArray> extra;
  extra->SetName("Extra");
  extra->InsertNextValue(42);
  collection->GetFieldData()->AddArray(extra);
  return collection;
}

/// The image's position of a point, in the local frame of the source.
Vec3 LocalPosition(vtkImageData* image, vtkIdType at, const GridFrame& source)
{
  double x[3];
  image->GetPoint(at, x);
  return source.WorldToLocal(Vec3(x[0], x[1], x[2]));
}
}

TEST(IndicatorReconstruct, AddsADifferentConstantToEachMaterial)
{
  const GridFrame source = Source(ObliqueDirection(true));
  const auto input = Distances(source);
  vtkNew<vtkIndicatorReconstruct> filter;
  filter->SetInputDataObject(input);
  filter->Update();
  vtkPartitionedDataSetCollection* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPartitionedDataSets(), 4u);
  const double voxel = std::cbrt(2.0);
  std::set<double> constants;
  for (unsigned int n = 0; n < 4; ++n)
  {
    vtkImageData* from = BlockImage(input, n);
    vtkImageData* to = BlockImage(output, n);
    EXPECT_TRUE(std::equal(from->GetExtent(), from->GetExtent() + 6, to->GetExtent()));
    const float* before = BlockValues(input, n, Names::TightDistance);
    const float* after = BlockValues(output, n, Names::Indicator);
    const double constant = after[0] - before[0];
    EXPECT_GE(constant, 0);
    EXPECT_LE(constant, 0.03 * voxel + 1e-5);
    for (vtkIdType at = 0; at < from->GetNumberOfPoints(); ++at)
    {
      ASSERT_NEAR(after[at] - before[at], constant, 1e-5);
    }
    constants.insert(std::round(constant * 1e3));
    EXPECT_STREQ(to->GetPointData()->GetScalars()->GetName(), Names::Indicator);
  }
  EXPECT_EQ(constants.size(), 4u);
  const CollectionHeader header = ReadHeader(output);
  EXPECT_EQ(header.Padding, 3);
  EXPECT_EQ(header.Materials[0].Label, -2);
  EXPECT_STREQ(output->GetMetaData(2u)->Get(vtkCompositeDataSet::NAME()), "Label_3");
  EXPECT_TRUE(output->GetFieldData()->HasArray("Extra"));
  auto* kernel = vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray(Names::IndicatorKernel));
  ASSERT_TRUE(kernel);
  EXPECT_EQ(kernel->GetValue(0), Names::CatmullRom);

  filter->SetPerturbation(0);
  filter->Update();
  EXPECT_EQ(BlockValues(filter->GetOutput(), 1, Names::Indicator)[7], BlockValues(input, 1, Names::TightDistance)[7]);
}

TEST(IndicatorReconstruct, RebuildsLabelsAtAnyResolutionInAnyFrame)
{
  for (const Mat3& direction : { Straight, ObliqueDirection(false), ObliqueDirection(true) })
  {
    for (const double resolution : { 1.0, 2.0, 0.7 })
    {
      const GridFrame source = Source(direction);
      vtkNew<vtkIndicatorReconstruct> filter;
      filter->SetInputDataObject(Distances(source));
      filter->SetPerturbation(0);
      filter->SetImageResolution(resolution);
      filter->Update();
      vtkImageData* image = filter->GetLabelImage();
      const int* whole = filter->GetOutputInformation(1)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
      ASSERT_TRUE(std::equal(whole, whole + 6, image->GetExtent()));
      EXPECT_EQ(image->GetDimensions()[0], std::lround(20 * resolution));
      auto* labels = vtkTypeInt64Array::SafeDownCast(image->GetPointData()->GetArray(Names::Label));
      auto* margin = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(Names::Margin));
      ASSERT_TRUE(labels && margin);
      EXPECT_EQ(image->GetPointData()->GetScalars(), labels);
      ASSERT_EQ(labels->GetNumberOfTuples(), image->GetNumberOfPoints());
      const auto cells = FourCells();
      Index wrong = 0;
      for (vtkIdType at = 0; at < image->GetNumberOfPoints(); ++at)
      {
        const Vec3 x = LocalPosition(image, at, source);
        std::vector<std::pair<double, Label>> ranked;
        for (const auto& cell : cells)
        {
          ranked.emplace_back(-cell.second(x), cell.first);
        }
        std::sort(ranked.begin(), ranked.end());
        const double expected = ranked[1].first - ranked[0].first;
        wrong += expected > 0.1 && labels->GetValue(at) != ranked[0].second;
        if (expected < 2.0)
        {
          EXPECT_NEAR(margin->GetValue(at), expected, 0.1);
        }
      }
      EXPECT_EQ(wrong, 0);
    }
  }
}

TEST(IndicatorReconstruct, MakesTheInspectedFunctions)
{
  const GridFrame source = Source();
  vtkNew<vtkIndicatorReconstruct> filter;
  filter->SetInputDataObject(Distances(source));
  filter->SetPerturbation(0);
  filter->AddInspectedLabel(-2);
  filter->Update();
  EXPECT_TRUE(filter->GetLabelImage()->GetPointData()->HasArray("InsideOutside_-2"));
  EXPECT_FALSE(filter->GetLabelImage()->GetPointData()->HasArray(Names::CellIndicator));
  filter->AddInspectedLabel(0);
  filter->AddInspectedLabel(0);
  EXPECT_EQ(filter->GetNumberOfInspectedLabels(), 2);
  filter->Update();
  vtkPointData* data = filter->GetLabelImage()->GetPointData();
  vtkDataArray* first = data->GetArray("InsideOutside_-2");
  vtkDataArray* second = data->GetArray("InsideOutside_0");
  vtkDataArray* cell = data->GetArray(Names::CellIndicator);
  vtkDataArray* labels = data->GetArray(Names::Label);
  vtkDataArray* margin = data->GetArray(Names::Margin);
  ASSERT_TRUE(first && second && cell);
  for (vtkIdType at = 0; at < labels->GetNumberOfTuples(); ++at)
  {
    const double a = first->GetComponent(at, 0), b = second->GetComponent(at, 0);
    ASSERT_NEAR(cell->GetComponent(at, 0), a * a + b * b, 1e-3 * (1 + a * a + b * b));
    if (margin->GetComponent(at, 0) > 0.01)
    {
      ASSERT_EQ(a > 0, labels->GetComponent(at, 0) == -2) << "at " << at;
      ASSERT_EQ(b > 0, labels->GetComponent(at, 0) == 0) << "at " << at;
    }
  }
  filter->ClearInspectedLabels();
  filter->Update();
  EXPECT_FALSE(filter->GetLabelImage()->GetPointData()->HasArray(Names::CellIndicator));
}

TEST(IndicatorReconstruct, TakesBlocksOfAnotherResolution)
{
  // Material 7 on a grid of its own, twice as fine and smaller than the rest.
  const GridFrame source({ 0, 19, 0, 19, 0, 19 }, Vec3(0, 0, 0), Vec3(1, 1, 1), Straight);
  const Vec3 centre(9.6, 9.4, 9.7);
  const auto fields = BallFields(centre, 4);
  vtkNew<vtkPartitionedDataSetCollection> input;
  CollectionHeader header;
  header.Source = source;
  header.Padding = 2;
  header.Materials = { DefaultMaterial(0), DefaultMaterial(7) };
  WriteHeader(input, header);
  const GridFrame fine({ 4, 34, 4, 34, 4, 34 }, Vec3(0.1, 0.1, 0.1), Vec3(0.5, 0.5, 0.5), Straight);
  const GridFrame frames[2] = { header.WorkingFrame(), fine };
  for (int m = 0; m < 2; ++m)
  {
    const Lattice lattice = source.LatticeOf(frames[m]);
    std::vector<float> values(lattice.Size());
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      const auto c = lattice.Coordinates(at);
      values[at] = float(fields.at(m == 0 ? 0 : 7)(lattice.Position(c[0], c[1], c[2])));
    }
    AppendBlock(input, header.Materials[m], frames[m], FloatArray(Names::TightDistance, values));
  }
  vtkNew<vtkIndicatorReconstruct> filter;
  filter->SetInputDataObject(input);
  filter->Update();
  vtkImageData* image = filter->GetLabelImage();
  for (vtkIdType at = 0; at < image->GetNumberOfPoints(); ++at)
  {
    const double depth = 4 - (LocalPosition(image, at, source) - centre).norm();
    if (std::abs(depth) > 0.1)
    {
      ASSERT_EQ(image->GetPointData()->GetArray(Names::Label)->GetComponent(at, 0), depth > 0 ? 7 : 0);
    }
  }
}

TEST(IndicatorReconstruct, SaysWhatIsWrong)
{
  vtkNew<vtkIndicatorReconstruct> filter;
  Listener listener(filter), pipeline(filter->GetExecutive());
  filter->SetInputDataObject(MakeCollection(Source(), 1, FourCells(), Names::Mask));
  filter->Update();
  EXPECT_NE(listener.Errors.find("Connect the output of Tighten"), std::string::npos) << listener.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  EXPECT_EQ(filter->GetLabelImage()->GetNumberOfPoints(), 0);
  listener.Errors.clear();
  filter->SetInputDataObject(Distances(Source()));
  filter->AddInspectedLabel(5);
  filter->Update();
  EXPECT_NE(listener.Errors.find("inspected label 5"), std::string::npos) << listener.Errors;
  listener.Errors.clear();
  for (const vtkIdType label : { -2, 0, 3, 9 })
  {
    filter->AddInspectedLabel(label);
  }
  filter->Update();
  EXPECT_NE(listener.Errors.find("at most 4"), std::string::npos) << listener.Errors;
}

TEST(IndicatorReconstruct, GivesEmptyOutputsForAnEmptyCollection)
{
  vtkNew<vtkPartitionedDataSetCollection> empty;
  vtkNew<vtkIndicatorReconstruct> filter;
  Listener listener(filter), pipeline(filter->GetExecutive());
  filter->SetInputDataObject(empty);
  filter->Update();
  EXPECT_TRUE(listener.Errors.empty()) << listener.Errors;
  EXPECT_TRUE(pipeline.Errors.empty()) << pipeline.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  EXPECT_TRUE(filter->GetLabelImage()->GetPointData()->HasArray(Names::Label));
  EXPECT_TRUE(filter->GetLabelImage()->GetPointData()->HasArray(Names::Margin));
}

TEST(IndicatorReconstruct, TakesOverTheMemoryOfDistancesThatAreGivenUp)
{
  const auto address = [](vtkPartitionedDataSetCollection* collection, const char* name)
  { return BlockValues(collection, 1, name); };
  for (const bool held : { false, true })
  {
    vtkNew<vtkTrivialProducer> producer;
    const auto distances = MakeCollection(Source(), 1, FourCells(), Names::TightDistance);
    producer->SetOutput(distances);
    producer->ReleaseDataFlagOn();
    const float* const before = address(distances, Names::TightDistance);
    const std::vector<float> values(before, before + BlockImage(distances, 1)->GetNumberOfPoints());
    vtkSmartPointer<vtkDataObject> holder = held ? BlockImage(distances, 1) : nullptr;
    vtkNew<vtkIndicatorReconstruct> filter;
    filter->SetInputConnection(producer->GetOutputPort());
    filter->SetPerturbation(0.0);
    filter->Update();
    const float* const after = address(filter->GetOutput(), Names::Indicator);
    EXPECT_EQ(after == before, !held);
    EXPECT_TRUE(std::equal(values.begin(), values.end(), after));
  }
}
