// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTighten.h"

#include "Core/JointSmoothing.h"
#include "LabelMeshNames.h"
#include "TestCollections.h"
#include "TestMeshes.h"
#include "vtkLabelSplit.h"

#include <vtkCompositeDataSet.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>

#include <gtest/gtest.h>

using namespace TestCollections;
using TestMeshes::LabelVolume;

namespace
{
/// A ball 7 (radius 9 voxels), a bar 12 two voxels thick and a speck 20 in background 0.
vtkSmartPointer<vtkImageData> BallBarSpeck(const Mat3& direction = Mat3::Identity(), const Vec3& spacing = Vec3::Ones())
{
  const GridFrame frame({ -2, 37, 3, 32, 0, 29 }, Vec3(5, 6, 7), spacing, direction);
  auto image = vtkSmartPointer<vtkImageData>::New();
  SetFrame(image, frame);
  vtkNew<vtkShortArray> labels;
  labels->SetName("Segments");
  for (int k = 0; k <= 29; ++k)
  {
    for (int j = 3; j <= 32; ++j)
    {
      for (int i = -2; i <= 37; ++i)
      {
        const bool ball = (Vec3(i, j, k) - Vec3(10.2, 17.1, 15.3)).norm() < 9;
        const bool bar = i >= 26 && i <= 27 && j >= 10 && j <= 11 && k >= 5 && k <= 24;
        labels->InsertNextValue(ball ? 7 : bar ? 12 : i == 33 && j == 28 && k == 4 ? 20 : 0);
      }
    }
  }
  image->GetPointData()->SetScalars(labels);
  return image;
}

/// Half a ball 2 (radius 14 voxels) and, on its flat side, a plate 1 that juts out.
vtkSmartPointer<vtkImageData> PlateOnHalfABall(const Vec3& normal, double thickness)
{
  return LabelVolume({ 0, 47, 0, 47, 0, 47 },
    [=](int i, int j, int k)
    {
      const Vec3 x = Vec3(i, j, k) - Vec3(23.4, 23.7, 23.2);
      const double across = x.dot(normal);
      const bool plate = std::abs(across - 3) < 0.5 * thickness && (x - across * normal).norm() < 18;
      return plate ? 1 : across < 3 && x.norm() < 14 ? 2 : 0;
    });
}

double Volume(vtkPartitionedDataSetCollection* output, const char* name, int n)
{
  return output->GetFieldData()->GetArray(name)->GetTuple1(n);
}
}

TEST(Tighten, KeepsTheContract)
{
  for (const auto& [smoothing, mirrored] :
    { std::pair(int(vtkTighten::VolumeKeeping), false), std::pair(int(vtkTighten::VolumeKeeping), true),
      std::pair(int(vtkTighten::Tightening), false), std::pair(int(vtkTighten::Tightening), true) })
  {
    SCOPED_TRACE(std::to_string(smoothing) + (mirrored ? " mirrored" : ""));
    const Vec3 spacing(0.5, 0.5, 0.5);
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(BallBarSpeck(ObliqueDirection(mirrored), spacing));
    split->SetMaterialName(7, "ball");
    vtkNew<vtkTighten> tighten;
    tighten->SetInputConnection(split->GetOutputPort());
    tighten->SetSmoothing(smoothing);
    Listener listener(tighten);
    tighten->UpdateInformation();
    GridFrame promised;
    int padding = 0;
    ASSERT_TRUE(PublishedFrame(tighten->GetOutputInformation(0), promised, padding));
    EXPECT_EQ(padding, 6);
    tighten->Update();
    EXPECT_EQ(listener.Errors, "");

    vtkPartitionedDataSetCollection* output = tighten->GetOutput();
    const CollectionHeader header = ReadHeader(output);
    EXPECT_EQ(header.Source.Extent(), promised.Extent());
    EXPECT_EQ(header.Source.Mirrored(), mirrored);
    ASSERT_EQ(output->GetNumberOfPartitionedDataSets(), 4u);
    EXPECT_STREQ(output->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "ball");
    for (unsigned int n = 0; n < 4; ++n)
    {
      vtkImageData* block = BlockImage(output, n);
      EXPECT_EQ(block->GetPointData()->GetNumberOfArrays(), 1);
      EXPECT_STREQ(block->GetPointData()->GetScalars()->GetName(), "TightDistance");
      EXPECT_EQ(block->GetPointData()->GetScalars()->GetDataType(), VTK_FLOAT);
      const GridFrame before = FrameOf(BlockImage(split->GetOutput(), n)), after = FrameOf(block);
      EXPECT_EQ(before.Extent(), after.Extent());
      EXPECT_EQ(before.Origin(), after.Origin());
      const float* d = BlockValues(output, n, Names::TightDistance);
      EXPECT_EQ(d[0], n == 0 ? 2.0f : -2.0f); // 4 voxels of 0.5
    }
    // The distance, in world lengths, at samples of the ball.
    vtkImageData* ball = BlockImage(output, 1);
    const float* d = BlockValues(output, 1, Names::TightDistance);
    const Lattice lattice = header.Source.LatticeOf(FrameOf(ball));
    const Vec3 centre = spacing.cwiseProduct(Vec3(10.2, 17.1, 15.3));
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      const auto c = lattice.Coordinates(at);
      const double expected = 4.5 - (lattice.Position(c[0], c[1], c[2]) - centre).norm();
      if (std::abs(expected) < 1.0)
      {
        ASSERT_NEAR(d[at], expected, 0.35);
      }
    }
    const double exact = 4.18879 * 4.5 * 4.5 * 4.5;
    EXPECT_NEAR(Volume(output, "MaskVolumes", 1), exact, 0.02 * exact);
    EXPECT_NEAR(Volume(output, "TightVolumes", 1), exact, 0.13 * exact);
    for (int n = 0; n < 4; ++n)
    {
      EXPECT_DOUBLE_EQ(
        Volume(output, "KeptVolumes", n), Volume(output, "TightVolumes", n) / Volume(output, "MaskVolumes", n));
    }
  }
}

TEST(Tighten, HasTheDefaultsOfItsCore)
{
  vtkNew<vtkTighten> tighten;
  EXPECT_EQ(tighten->GetSmoothing(), vtkTighten::VolumeKeeping);
  EXPECT_EQ(tighten->GetRadius(), MaterialMask().Radius);
  EXPECT_EQ(tighten->GetFidelity(), JointSmoothingOptions().Fidelity);
  EXPECT_EQ(tighten->GetRounds(), JointSmoothingOptions().Rounds);
  EXPECT_EQ(tighten->GetTightenIterations(), JointSmoothingOptions().TightenIterations);
}

TEST(Tighten, KeepsTheVolumeOfAThinPlateUnlessToldOtherwise)
{
  for (const auto& [normal, thickness] : { std::pair(Vec3(0, 0, 1), 2.0), std::pair(Vec3(2, 1, 6), 3.0) })
  {
    SCOPED_TRACE(thickness);
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(PlateOnHalfABall(normal.normalized(), thickness));
    vtkNew<vtkTighten> tighten;
    tighten->SetInputConnection(split->GetOutputPort());
    tighten->Update();
    for (const int n : { 1, 2 })
    {
      EXPECT_NEAR(Volume(tighten->GetOutput(), "KeptVolumes", n), 1.0, 0.03) << n;
    }
    tighten->SetSmoothingToTightening();
    tighten->Update();
    EXPECT_LT(Volume(tighten->GetOutput(), "KeptVolumes", 1), 0.93) << "what the default is for";
  }
}

TEST(Tighten, KnobsActInTheirModeAlone)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(PlateOnHalfABall(Vec3(2, 1, 6).normalized(), 3.0));
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  tighten->SetSmoothingToTightening();
  Listener listener(tighten);
  const auto kept = [&](int n) { return Volume(tighten->GetOutput(), "KeptVolumes", n); };
  const auto change = [&](const std::function<void()>& turn)
  {
    tighten->Update();
    const double before = kept(1);
    turn();
    tighten->Update();
    return kept(1) - before;
  };
  EXPECT_EQ(change([&] { tighten->SetFidelity(0.3); }), 0.0);
  EXPECT_EQ(change([&] { tighten->SetRounds(2); }), 0.0);
  EXPECT_NE(change([&] { tighten->SetAntialiasIterations(2); }), 0.0);
  EXPECT_NE(change([&] { tighten->SetTightenIterations(2); }), 0.0);
  tighten->SetSmoothingToVolumeKeeping();
  EXPECT_NE(change([&] { tighten->SetFidelity(0.85); }), 0.0);
  EXPECT_NE(change([&] { tighten->SetRounds(8); }), 0.0);
  EXPECT_EQ(change([&] { tighten->SetAntialiasIterations(10); }), 0.0);
  EXPECT_NE(change([&] { tighten->SetTightenIterations(20); }), 0.0);
  EXPECT_NE(change([&] { tighten->SetMaterialRadius(1, 0.3); }), 0.0);
  EXPECT_EQ(listener.Errors, "");
}

TEST(Tighten, NamesWhatItLoses)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(BallBarSpeck());
  split->SetMaterialName(20, "speck");
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  Listener listener(tighten);
  tighten->SetSmoothingToTightening();
  tighten->SetRadius(1.5);
  tighten->Update();
  EXPECT_NE(listener.Warnings.find("speck vanishes"), std::string::npos) << listener.Warnings;
  EXPECT_NE(listener.Warnings.find("Label_12 vanishes"), std::string::npos) << listener.Warnings;
  EXPECT_EQ(listener.Warnings.find("Label_7"), std::string::npos) << listener.Warnings;
  EXPECT_NE(listener.Warnings.find("SetMaterialRadius"), std::string::npos);
  EXPECT_NE(listener.Warnings.find("volume-keeping"), std::string::npos);
  EXPECT_EQ(Volume(tighten->GetOutput(), "TightVolumes", 3), 0.0);
  EXPECT_EQ(Volume(tighten->GetOutput(), "MaskVolumes", 3), 1.0);

  // A smaller radius saves the bar, for it and for the background that would close over it.
  tighten->SetMaterialRadius(12, 0.0);
  tighten->SetMaterialRadius(0, 0.0);
  tighten->Update();
  EXPECT_GT(Volume(tighten->GetOutput(), "TightVolumes", 2), 0.2 * Volume(tighten->GetOutput(), "MaskVolumes", 2));
  EXPECT_EQ(Volume(tighten->GetOutput(), "TightVolumes", 3), 0.0);
  EXPECT_EQ(tighten->GetMaterialRadius(12), 0.0);
  EXPECT_EQ(tighten->GetMaterialRadius(7), 1.5);

  listener.Warnings.clear();
  tighten->ClearMaterialRadii();
  tighten->SetRadius(0);
  tighten->SetMaterialRadius(99, 1);
  tighten->Update();
  EXPECT_NE(listener.Warnings.find("99"), std::string::npos);
}

TEST(Tighten, OnlyTheIterationsAskedFor)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(BallBarSpeck());
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  tighten->SetSmoothingToTightening();
  tighten->SetRadius(0);
  tighten->SetAntialiasIterations(0);
  tighten->Update();
  for (unsigned int n = 0; n < 4; ++n)
  {
    const std::uint8_t* mask = BlockMask(split->GetOutput(), n);
    const float* d = BlockValues(tighten->GetOutput(), n, Names::TightDistance);
    for (vtkIdType at = 0; at < BlockImage(split->GetOutput(), n)->GetNumberOfPoints(); ++at)
    {
      ASSERT_EQ(mask[at] > 0.5f, d[at] > 0) << n;
    }
  }
}

TEST(Tighten, SaysWhatIsWrong)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(BallBarSpeck());
  vtkNew<vtkTighten> first, second;
  first->SetInputConnection(split->GetOutputPort());
  second->SetInputConnection(first->GetOutputPort());
  Listener listener(second), executive(second->GetExecutive());
  second->Update();
  EXPECT_NE(listener.Errors.find("'Mask'"), std::string::npos) << listener.Errors;
  EXPECT_NE(listener.Errors.find("Label Split"), std::string::npos) << listener.Errors;
  EXPECT_NE(listener.Errors.find("TightDistance"), std::string::npos) << listener.Errors;
  EXPECT_EQ(second->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);

  Listener radius(first), firstExecutive(first->GetExecutive());
  for (const int smoothing : { vtkTighten::VolumeKeeping, vtkTighten::Tightening })
  {
    radius.Errors.clear();
    first->SetSmoothing(smoothing);
    first->SetRadius(-1);
    first->Update();
    EXPECT_NE(radius.Errors.find("radius"), std::string::npos) << radius.Errors;
  }
  radius.Errors.clear();
  first->SetSmoothingToVolumeKeeping();
  first->SetRadius(1);
  first->SetFidelity(-1);
  first->Update();
  EXPECT_NE(radius.Errors.find("Fidelity"), std::string::npos) << radius.Errors;

  // A block of half the spacing: volume-keeping cannot, tightening can.
  vtkNew<vtkPartitionedDataSetCollection> twoGrids;
  const GridFrame source({ 0, 20, 0, 20, 0, 20 }, Vec3::Zero(), Vec3::Ones(), Mat3::Identity());
  CollectionHeader header;
  header.Source = source;
  header.Materials = { DefaultMaterial(0), DefaultMaterial(7) };
  WriteHeader(twoGrids, header);
  AppendBlock(twoGrids, header.Materials[0], source, MaskArray(source, 1));
  const GridFrame fine({ 0, 9, 0, 9, 0, 9 }, Vec3(5, 5, 5), Vec3::Constant(0.5), Mat3::Identity());
  AppendBlock(twoGrids, header.Materials[1], fine, MaskArray(fine, 0));
  vtkNew<vtkTighten> grids;
  Listener twoListener(grids), twoExecutive(grids->GetExecutive());
  grids->SetInputData(twoGrids);
  grids->Update();
  EXPECT_NE(twoListener.Errors.find("'Label_7' is not on the samples"), std::string::npos) << twoListener.Errors;
  twoListener.Errors.clear();
  grids->SetSmoothingToTightening();
  grids->Update();
  EXPECT_EQ(twoListener.Errors, "");

  vtkNew<vtkPartitionedDataSetCollection> foreign;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  foreign->SetNumberOfPartitionedDataSets(1);
  foreign->SetPartition(0, 0, image);
  vtkNew<vtkTighten> third;
  Listener stranger(third), thirdExecutive(third->GetExecutive());
  third->SetInputData(foreign);
  third->Update();
  EXPECT_NE(stranger.Errors.find("Label Split"), std::string::npos) << stranger.Errors;
}

TEST(Tighten, AnEmptyCollectionIsLegal)
{
  vtkNew<vtkImageData> empty;
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(empty);
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  Listener listener(tighten);
  tighten->Update();
  EXPECT_EQ(listener.Errors + listener.Warnings, "");
  EXPECT_EQ(tighten->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  EXPECT_EQ(tighten->GetOutput()->GetFieldData()->GetArray("TightVolumes")->GetNumberOfTuples(), 0);
}

class TightenModes : public testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(Tighten, TightenModes, testing::Values(vtkTighten::VolumeKeeping, vtkTighten::Tightening));

TEST_P(TightenModes, StopsOnRequest)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(BallBarSpeck());
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  tighten->SetSmoothing(GetParam());
  vtkNew<vtkCallbackCommand> stop;
  std::string text;
  stop->SetClientData(&text);
  stop->SetCallback(
    [](vtkObject* filter, unsigned long, void* client, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(filter);
      *static_cast<std::string*>(client) = algorithm->GetProgressText() ? algorithm->GetProgressText() : "";
      algorithm->SetAbortExecute(1);
    });
  tighten->AddObserver(vtkCommand::ProgressEvent, stop);
  Listener listener(tighten);
  tighten->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_EQ(tighten->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  EXPECT_NE(text, "");
}

TEST(Tighten, MasksThatAreGivenUpAreGoneAndComeBackWhenNeeded)
{
  for (const int smoothing : { vtkTighten::VolumeKeeping, vtkTighten::Tightening })
  {
    vtkNew<vtkLabelSplit> kept, released;
    vtkNew<vtkTighten> expected, tighten;
    for (const auto& [split, filter] :
      { std::pair(kept.Get(), expected.Get()), std::pair(released.Get(), tighten.Get()) })
    {
      split->SetInputData(BallBarSpeck());
      filter->SetInputConnection(split->GetOutputPort());
      filter->SetSmoothing(smoothing);
    }
    released->ReleaseDataFlagOn();
    for (const double radius : { 0.7, 1.0 })
    {
      expected->SetRadius(radius);
      tighten->SetRadius(radius);
      expected->Update();
      tighten->Update();
      const vtkIdType size = BlockImage(expected->GetOutput(), 1)->GetNumberOfPoints();
      const float* const d = BlockValues(expected->GetOutput(), 1, Names::TightDistance);
      EXPECT_TRUE(std::equal(d, d + size, BlockValues(tighten->GetOutput(), 1, Names::TightDistance)));
      EXPECT_EQ(kept->GetOutput()->GetNumberOfPartitionedDataSets(), 4u);
      EXPECT_EQ(released->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
    }
  }
}
