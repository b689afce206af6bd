// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelSplit.h"

#include "Core/MaterialMasks.h"
#include "IndicatorCollection.h"
#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "MemoryEstimate.h"
#include "TestCollections.h"

#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkDataAssembly.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkLongArray.h>
#include <vtkLongLongArray.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkSignedCharArray.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnsignedLongArray.h>
#include <vtkUnsignedLongLongArray.h>
#include <vtkUnsignedShortArray.h>

#include <gtest/gtest.h>

#include <limits>
#include <set>

using namespace TestCollections;

namespace
{
using Labeling = std::function<double(int, int, int)>;

/// An image whose point or cell array "Segments" has the label of each index.
vtkSmartPointer<vtkImageData> MakeImage(const std::array<int, 6>& extent, const Labeling& label,
  vtkSmartPointer<vtkDataArray> array = vtkSmartPointer<vtkIntArray>::New(), bool cells = false)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const int more = cells ? 1 : 0;
  image->SetExtent(extent[0], extent[1] + more, extent[2], extent[3] + more, extent[4], extent[5] + more);
  array->SetName("Segments");
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        array->InsertNextTuple1(label(i, j, k));
      }
    }
  }
  image->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT)->SetScalars(array);
  return image;
}

/// 3 and -2 are boxes side by side, 2147483647 is one voxel apart; background 0.
constexpr std::array<int, 6> Extent = { -3, 12, 5, 16, 2, 14 };
constexpr int Far = std::numeric_limits<int>::max();
double ThreeMaterials(int i, int j, int k)
{
  const bool inside = j >= 8 && j <= 12 && k >= 5 && k <= 11;
  return inside && i >= 0 && i < 4 ? 3 : inside && i >= 4 && i < 8 ? -2 : i == 10 && j == 14 && k == 4 ? Far : 0;
}

/// The fixed-width names that are no types of their own are left out.
std::vector<vtkSmartPointer<vtkDataArray>> SignedArrays()
{
  return { vtkSmartPointer<vtkIntArray>::New(), vtkSmartPointer<vtkLongArray>::New(),
    vtkSmartPointer<vtkLongLongArray>::New(), vtkSmartPointer<vtkDoubleArray>::New() };
}
std::vector<vtkSmartPointer<vtkDataArray>> AllArrays()
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays = SignedArrays();
  for (const vtkSmartPointer<vtkDataArray>& array :
    std::initializer_list<vtkSmartPointer<vtkDataArray>>{ vtkSmartPointer<vtkCharArray>::New(),
      vtkSmartPointer<vtkSignedCharArray>::New(), vtkSmartPointer<vtkUnsignedCharArray>::New(),
      vtkSmartPointer<vtkShortArray>::New(), vtkSmartPointer<vtkUnsignedShortArray>::New(),
      vtkSmartPointer<vtkUnsignedIntArray>::New(), vtkSmartPointer<vtkUnsignedLongArray>::New(),
      vtkSmartPointer<vtkUnsignedLongLongArray>::New(), vtkSmartPointer<vtkFloatArray>::New() })
  {
    arrays.push_back(array);
  }
  return arrays;
}

/// Every sample of every block against the label image.
void ExpectMasks(vtkPartitionedDataSetCollection* output, const Labeling& label, const std::array<int, 6>& extent)
{
  const CollectionHeader header = ReadHeader(output);
  for (unsigned int n = 0; n < header.Materials.size(); ++n)
  {
    vtkImageData* block = BlockImage(output, n);
    const std::uint8_t* mask = BlockMask(output, n);
    const int* e = block->GetExtent();
    for (int k = e[4]; k <= e[5]; ++k)
    {
      for (int j = e[2]; j <= e[3]; ++j)
      {
        for (int i = e[0]; i <= e[1]; ++i)
        {
          const bool in =
            i >= extent[0] && i <= extent[1] && j >= extent[2] && j <= extent[3] && k >= extent[4] && k <= extent[5];
          const double expected = in ? label(i, j, k) : 0;
          ASSERT_EQ(*mask++, expected == header.Materials[n].Label ? 1 : 0)
            << header.Materials[n].Name << " at " << i << " " << j << " " << k;
        }
      }
    }
  }
}

std::vector<LabelMesh::Label> LabelsOf(vtkPartitionedDataSetCollection* output)
{
  std::vector<LabelMesh::Label> labels;
  for (const Material& material : ReadHeader(output).Materials)
  {
    labels.push_back(material.Label);
  }
  return labels;
}

double Sum(vtkPartitionedDataSetCollection* output, unsigned int n)
{
  const std::uint8_t* mask = BlockMask(output, n);
  double sum = 0;
  for (vtkIdType i = 0; i < BlockImage(output, n)->GetNumberOfPoints(); ++i)
  {
    sum += mask[i];
  }
  return sum;
}

std::string ErrorOf(vtkImageData* image)
{
  vtkNew<vtkLabelSplit> split;
  Listener listener(split);
  Listener executive(split->GetExecutive());
  split->SetInputData(image);
  split->Update();
  EXPECT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  return listener.Errors;
}
}

TEST(LabelSplit, KeepsTheContract)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage(Extent, ThreeMaterials));
  split->SetMaterialName(3, "left");
  split->SetMaterialColor(3, 0.1, 0.2, 0.3);
  Listener listener(split);
  split->Update();
  EXPECT_EQ(listener.Errors + listener.Warnings, "");
  vtkPartitionedDataSetCollection* output = split->GetOutput();
  ASSERT_EQ(output->GetNumberOfPartitionedDataSets(), 4u);

  vtkFieldData* field = output->GetFieldData();
  auto* labels = vtkTypeInt64Array::SafeDownCast(field->GetArray("Labels"));
  ASSERT_TRUE(labels);
  const std::vector<vtkTypeInt64> expected = { -2, 0, 3, Far };
  for (int n = 0; n < 4; ++n)
  {
    EXPECT_EQ(labels->GetValue(n), expected[n]);
    vtkImageData* block = BlockImage(output, n);
    EXPECT_EQ(block->GetPointData()->GetNumberOfArrays(), 1);
    EXPECT_STREQ(block->GetPointData()->GetScalars()->GetName(), "Mask");
    EXPECT_EQ(block->GetPointData()->GetScalars()->GetDataType(), VTK_UNSIGNED_CHAR);
    EXPECT_EQ(block->GetFieldData()->GetArray("Label")->GetTuple1(0), double(expected[n]));
    EXPECT_EQ(block->GetFieldData()->GetArray("Color")->GetNumberOfComponents(), 3);
  }
  EXPECT_STREQ(output->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "Label_-2");
  EXPECT_STREQ(output->GetMetaData(2u)->Get(vtkCompositeDataSet::NAME()), "left");
  auto* names = vtkStringArray::SafeDownCast(field->GetAbstractArray("MaterialNames"));
  ASSERT_TRUE(names);
  EXPECT_EQ(names->GetValue(2), "left");
  EXPECT_EQ(field->GetArray("MaterialColors")->GetComponent(2, 1), 0.2);
  EXPECT_EQ(BlockImage(output, 2)->GetFieldData()->GetArray("Color")->GetComponent(0, 2), 0.3);
  EXPECT_EQ(field->GetArray("BackgroundLabel")->GetTuple1(0), 0);
  EXPECT_EQ(field->GetArray("Padding")->GetTuple1(0), 6);
  EXPECT_EQ(field->GetArray("SourceExtent")->GetComponent(0, 0), -3);
  EXPECT_STREQ(output->GetDataAssembly()->GetRootNodeName(), "Indicators");

  // Cropped to the material and its padding; the background covers all.
  const int* e = BlockImage(output, 2)->GetExtent();
  EXPECT_EQ((std::array<int, 6>{ e[0], e[1], e[2], e[3], e[4], e[5] }), (std::array<int, 6>{ -6, 9, 2, 18, -1, 17 }));
  e = BlockImage(output, 1)->GetExtent();
  EXPECT_EQ((std::array<int, 6>{ e[0], e[1], e[2], e[3], e[4], e[5] }), (std::array<int, 6>{ -9, 18, -1, 22, -4, 20 }));
  ExpectMasks(output, ThreeMaterials, Extent);
}

TEST(LabelSplit, TakesEveryNumericType)
{
  const Labeling label = [](int i, int j, int k) { return i >= 3 && i < 6 && j >= 3 && j < 6 && k >= 3 ? 100 : 7; };
  const std::array<int, 6> extent = { 0, 8, 0, 8, 0, 8 };
  for (const auto& array : AllArrays())
  {
    vtkNew<vtkLabelSplit> split;
    split->SetBackgroundLabel(7);
    split->SetInputData(MakeImage(extent, label, array));
    split->Update();
    ASSERT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 7, 100 })) << array->GetClassName();
    EXPECT_EQ(Sum(split->GetOutput(), 1), 54) << array->GetClassName();
  }
  for (const auto& array : SignedArrays())
  {
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(MakeImage(Extent, ThreeMaterials, array));
    split->Update();
    ASSERT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ -2, 0, 3, Far })) << array->GetClassName();
    ExpectMasks(split->GetOutput(), ThreeMaterials, Extent);
  }
}

TEST(LabelSplit, KeepsOrientedFrames)
{
  for (const bool mirrored : { false, true })
  {
    const auto image = MakeImage(Extent, ThreeMaterials);
    const GridFrame frame(Extent, Vec3(10, -20, 30), Vec3(0.5, 0.7, 1.1), ObliqueDirection(mirrored));
    SetFrame(image, frame);
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(image);
    split->Update();
    const CollectionHeader header = ReadHeader(split->GetOutput());
    EXPECT_EQ(header.Source.Mirrored(), mirrored);
    EXPECT_EQ(header.Source.Extent(), Extent);
    EXPECT_TRUE(header.Source.Direction().isApprox(frame.Direction()));
    for (unsigned int n = 0; n < 4; ++n)
    {
      const GridFrame block = FrameOf(BlockImage(split->GetOutput(), n));
      EXPECT_TRUE(block.ToWorld(3, 9, 6).isApprox(frame.ToWorld(3, 9, 6)));
    }
    ExpectMasks(split->GetOutput(), ThreeMaterials, Extent);
  }
}

TEST(LabelSplit, CellsAreSamplesAtTheirCentres)
{
  const auto image = MakeImage(Extent, ThreeMaterials, vtkSmartPointer<vtkIntArray>::New(), true);
  image->SetSpacing(2, 3, 4);
  image->SetOrigin(1, 1, 1);
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(image);
  split->UpdateInformation();
  GridFrame promised;
  int padding = 0;
  ASSERT_TRUE(PublishedFrame(split->GetOutputInformation(0), promised, padding));
  split->Update();
  const CollectionHeader header = ReadHeader(split->GetOutput());
  EXPECT_EQ(header.Source.Extent(), Extent);
  EXPECT_EQ(promised.Extent(), Extent);
  EXPECT_TRUE(header.Source.ToWorld(0, 0, 0).isApprox(Vec3(2, 2.5, 3)));
  EXPECT_TRUE(promised.ToWorld(0, 0, 0).isApprox(Vec3(2, 2.5, 3)));
  ExpectMasks(split->GetOutput(), ThreeMaterials, Extent);
}

TEST(LabelSplit, ChoosesTheArrayByName)
{
  const auto image = MakeImage(Extent, ThreeMaterials);
  vtkNew<vtkUnsignedCharArray> other;
  other->SetName("Other");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    other->InsertNextValue(i % 2 ? 9 : 0);
  }
  image->GetPointData()->AddArray(other);
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(image);
  split->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Other");
  split->Update();
  EXPECT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 0, 9 }));

  split->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Nothing");
  Listener listener(split);
  Listener executive(split->GetExecutive());
  split->Update();
  EXPECT_NE(listener.Errors.find("'Segments'"), std::string::npos) << listener.Errors;
  EXPECT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
}

TEST(LabelSplit, UnselectedLabelsJoinTheBackground)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage(Extent, ThreeMaterials));
  split->AddLabel(3);
  split->AddLabel(55);
  Listener listener(split);
  split->Update();
  EXPECT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 0, 3 }));
  EXPECT_NE(listener.Warnings.find("55"), std::string::npos);
  ExpectMasks(
    split->GetOutput(), [](int i, int j, int k) { return ThreeMaterials(i, j, k) == 3 ? 3 : 0; }, Extent);
  split->ClearLabels();
  split->Update();
  EXPECT_EQ(LabelsOf(split->GetOutput()).size(), 4u);
}

TEST(LabelSplit, TheBackgroundNeedNotOccur)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage({ 0, 4, 0, 4, 0, 4 }, [](int i, int, int) { return i < 2 ? 4 : 6; }));
  split->SetBackgroundLabel(5);
  split->SetPadding(2);
  split->Update();
  EXPECT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 4, 5, 6 }));
  EXPECT_EQ(Sum(split->GetOutput(), 1), 9 * 9 * 9 - 5 * 5 * 5);
  EXPECT_EQ(Sum(split->GetOutput(), 2), 75);
}

TEST(LabelSplit, BlocksHoldTheBandOfTheirDistancesWhereTheSpacingIsSmall)
{
  // One voxel in the middle of others: the geometric mean of the spacings is 1, five of it are 20 and 2.5 samples.
  const auto image = MakeImage({ 0, 60, 0, 60, 0, 60 },
    [](int i, int j, int k) { return i == 30 && j == 30 && k == 30 ? 2 : (i == 3 && j == 3 && k == 3 ? 1 : 0); });
  image->SetSpacing(0.25, 2, 2);
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(image);
  split->Update();
  const auto expectExtent = [&split](unsigned int block, const std::array<int, 6>& extent)
  {
    int found[6];
    vtkImageData::SafeDownCast(split->GetOutput()->GetPartition(block, 0))->GetExtent(found);
    EXPECT_EQ((std::array<int, 6>{ found[0], found[1], found[2], found[3], found[4], found[5] }), extent);
  };
  expectExtent(2, { 10, 50, 24, 36, 24, 36 });
  expectExtent(1, { -6, 23, -3, 9, -3, 9 }); // not beyond the working grid
  split->SetPadding(2);                      // of two voxels no more than eight samples
  split->Update();
  expectExtent(2, { 22, 38, 28, 32, 28, 32 });
}

TEST(LabelSplit, PublishesItsFrameBeforeThereIsData)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage(Extent, ThreeMaterials));
  split->SetPadding(4);
  split->SetResamplingFactor(2);
  split->UpdateInformation();
  GridFrame source;
  int padding = 0;
  ASSERT_TRUE(PublishedFrame(split->GetOutputInformation(0), source, padding));
  EXPECT_EQ(padding, 4);
  split->Update();
  const CollectionHeader header = ReadHeader(split->GetOutput());
  EXPECT_EQ(header.Source.Extent(), source.Extent());
  EXPECT_TRUE(header.Source.Origin().isApprox(source.Origin()));
  EXPECT_TRUE(header.Source.Spacing().isApprox(source.Spacing()));
}

TEST(LabelSplit, ResamplesOverTheSameVoxels)
{
  const auto image = MakeImage(Extent, ThreeMaterials);
  image->SetSpacing(1, 2, 1.5);
  for (const double factor : { 2.0, 3.0 })
  {
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(image);
    split->SetResamplingFactor(factor);
    split->Update();
    const CollectionHeader header = ReadHeader(split->GetOutput());
    const GridFrame before = FrameOf(image);
    EXPECT_EQ(header.Source.Extent()[1], int(16 * factor) - 1);
    EXPECT_TRUE(header.Source.Spacing().isApprox(before.Spacing() / factor));
    const auto& e = header.Source.Extent();
    EXPECT_TRUE(header.Source.ToWorld(-0.5, -0.5, -0.5).isApprox(before.ToWorld(-3.5, 4.5, 1.5)));
    EXPECT_TRUE(header.Source.ToWorld(e[1] + 0.5, e[3] + 0.5, e[5] + 0.5).isApprox(before.ToWorld(12.5, 16.5, 14.5)));
    // Boxes keep their volume, but for their edges and corners, which linear interpolation rounds.
    const double volume = Sum(split->GetOutput(), 2) / (factor * factor * factor);
    EXPECT_NEAR(volume, 4 * 5 * 7, 0.06 * 4 * 5 * 7);
  }
  vtkNew<vtkLabelSplit> coarse;
  coarse->SetInputData(image);
  coarse->SetResamplingFactor(0.5);
  Listener listener(coarse);
  coarse->Update();
  EXPECT_EQ(LabelsOf(coarse->GetOutput()), (std::vector<LabelMesh::Label>{ -2, 0, 3 }));
  EXPECT_NE(listener.Warnings.find(std::to_string(Far)), std::string::npos); // one voxel is too small for it
}

TEST(LabelSplit, OpensAndCloses)
{
  // A block with a thread on it and a hole in it.
  const Labeling label = [](int i, int j, int k)
  {
    const bool block = i >= 4 && i <= 12 && j >= 4 && j <= 12 && k >= 4 && k <= 12;
    const bool hole = i == 8 && j == 8 && k == 8;
    const bool thread = i > 12 && i <= 18 && j == 8 && k == 8;
    return (block && !hole) || thread ? 1 : 0;
  };
  const std::array<int, 6> extent = { 0, 20, 0, 20, 0, 20 };
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage(extent, label));
  split->SetClosingRadius(1);
  split->Update();
  EXPECT_EQ(Sum(split->GetOutput(), 1), 9 * 9 * 9 + 6 + 4);              // four in the corner at the thread's foot
  EXPECT_EQ(Sum(split->GetOutput(), 0), 33 * 33 * 33 - (9 * 9 * 9 + 5)); // the background keeps the hole
  split->SetMaterialOpeningRadius(1, 1);
  split->Update();
  EXPECT_LT(Sum(split->GetOutput(), 1), 9 * 9 * 9 + 1);
  split->SetMaterialOpeningRadius(1, 20);
  Listener listener(split);
  split->Update();
  EXPECT_EQ(Sum(split->GetOutput(), 1), 0);
  EXPECT_NE(listener.Warnings.find("Nothing is left"), std::string::npos);
  split->ClearMaterialOpeningRadii();
  split->SetMaterialClosingRadius(1, 0);
  split->Update();
  ExpectMasks(split->GetOutput(), label, extent);
}

TEST(LabelSplit, SaysWhatIsWrong)
{
  const std::array<int, 6> extent = { 2, 6, 2, 6, 2, 6 };
  const std::string fraction = ErrorOf(MakeImage(
    extent, [](int i, int j, int k) { return i == 4 && j == 3 && k == 5 ? 1.5 : 1; },
    vtkSmartPointer<vtkFloatArray>::New()));
  EXPECT_NE(fraction.find("1.5"), std::string::npos) << fraction;
  EXPECT_NE(fraction.find("(4, 3, 5)"), std::string::npos) << fraction;
  const std::string notANumber = ErrorOf(MakeImage(
    extent, [](int, int, int) { return NAN; }, vtkSmartPointer<vtkDoubleArray>::New()));
  EXPECT_NE(notANumber.find("nan"), std::string::npos) << notANumber;
  const std::string flat = ErrorOf(MakeImage({ 0, 9, 0, 9, 0, 0 }, [](int i, int, int) { return i; }));
  EXPECT_NE(flat.find("10 x 10 x 1"), std::string::npos) << flat;
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(4, 4, 4);
  EXPECT_NE(ErrorOf(bare).find("array of labels"), std::string::npos);
  const auto vectors = MakeImage(extent, [](int, int, int) { return 1; });
  vtkNew<vtkIntArray> pairs;
  pairs->SetName("Pairs");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(125);
  pairs->Fill(1);
  vectors->GetPointData()->SetScalars(pairs);
  EXPECT_NE(ErrorOf(vectors).find("2 components"), std::string::npos);

  for (const double factor : { 0.0, -1.0 })
  {
    vtkNew<vtkLabelSplit> split;
    Listener listener(split);
    Listener executive(split->GetExecutive());
    split->SetInputData(MakeImage(extent, [](int, int, int) { return 1; }));
    split->SetResamplingFactor(factor);
    split->Update();
    EXPECT_NE(listener.Errors.find("resampling factor"), std::string::npos);
  }
}

TEST(LabelSplit, RefusesWhatTakesTooMuchMemory)
{
  const auto image = MakeImage({ 0, 15, 0, 15, 0, 15 }, [](int i, int, int) { return i < 8 ? 1 : 0; });
  const LabelMesh::LabelImage labels =
    LabelMesh::ReadLabelImage(image, image->GetPointData()->GetArray("Segments"), false);
  const double working = 28 * 28 * 28, block = 20 * 28 * 28; // with six samples of padding
  const double faces = 16 * 16 + (16 * 16 + 4 * 8 * 16);     // between the labels, and on the border of the volume
  const double estimate = LabelMesh::EstimateMemory(labels, 0, 6, 1.0);
  EXPECT_DOUBLE_EQ(estimate, 50.0 * 1048576 + 17.0 * (working + block) + 8.0 * working + 1000.0 * faces);
  EXPECT_GT(LabelMesh::EstimateMemory(labels, 0, 6, 2.0), estimate);
  for (const double limit : { 0.0, 1.01 * estimate / 1073741824, 0.99 * estimate / 1073741824 })
  {
    vtkNew<vtkLabelSplit> split;
    Listener listener(split);
    Listener executive(split->GetExecutive());
    split->SetInputData(image);
    split->SetMemoryLimit(limit);
    split->Update();
    const bool refused = listener.Errors.find("raise the memory limit") != std::string::npos;
    EXPECT_EQ(refused, limit > 0 && limit * 1073741824 < estimate) << listener.Errors;
    EXPECT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), refused ? 0u : 2u);
  }
}

TEST(LabelSplit, EmptyAndUniformImagesAreLegal)
{
  vtkNew<vtkImageData> empty;
  vtkNew<vtkLabelSplit> split;
  Listener listener(split);
  split->SetInputData(empty);
  split->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
  EXPECT_TRUE(ReadHeader(split->GetOutput()).Materials.empty());

  split->SetInputData(MakeImage({ 0, 5, 0, 5, 0, 5 }, [](int, int, int) { return 0; }));
  split->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 0 }));
  EXPECT_NE(listener.Warnings.find("nothing to mesh"), std::string::npos);

  listener.Warnings.clear();
  split->SetInputData(MakeImage({ 0, 5, 0, 5, 0, 5 }, [](int, int, int) { return 8; }));
  split->Update();
  EXPECT_EQ(listener.Errors + listener.Warnings, "");
  EXPECT_EQ(LabelsOf(split->GetOutput()), (std::vector<LabelMesh::Label>{ 0, 8 }));
  EXPECT_EQ(Sum(split->GetOutput(), 1), 216);
}

TEST(LabelSplit, StopsOnRequest)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage(Extent, ThreeMaterials));
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* filter, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(filter);
      algorithm->SetAbortExecute(algorithm->GetProgress() > 0.3);
    });
  split->AddObserver(vtkCommand::ProgressEvent, stop);
  Listener listener(split);
  split->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), 0u);
}

TEST(MaterialMasks, ManySmallLabelsCostTheirBoxes)
{
  // 512 labels in 64^3: each block is its 8^3 box and padding, not the volume.
  const Labeling label = [](int i, int j, int k) { return 1 + i / 8 + 8 * (j / 8) + 64 * (k / 8); };
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(MakeImage({ 0, 63, 0, 63, 0, 63 }, label));
  split->SetPadding(2);
  split->Update();
  ASSERT_EQ(split->GetOutput()->GetNumberOfPartitionedDataSets(), 513u);
  for (unsigned int n = 1; n < 513; ++n)
  {
    ASSERT_EQ(BlockImage(split->GetOutput(), n)->GetNumberOfPoints(), 12 * 12 * 12);
    ASSERT_EQ(Sum(split->GetOutput(), n), 512);
  }
}

TEST(MaterialMasks, ResamplingIsFairToThinLabels)
{
  // On a finer grid a sheet one voxel thick stays one voxel thick; on a coarser one the majority wins.
  const GridFrame frame({ 0, 9, 0, 9, 0, 9 }, Vec3::Zero(), Vec3::Ones(), Mat3::Identity());
  std::vector<MaterialId> ids(1000, 0);
  for (int at = 400; at < 500; ++at)
  {
    ids[at] = 1;
  }
  const GridFrame fine = Resampled(frame, 2);
  const auto finer = ResampleLabels(ids, frame, fine);
  EXPECT_EQ(std::count(finer.begin(), finer.end(), 1), 800);
  const GridFrame coarse = Resampled(frame, 0.5);
  EXPECT_EQ(coarse.Samples().Size(), 125);
  const auto coarser = ResampleLabels(ids, frame, coarse);
  EXPECT_EQ(std::count(coarser.begin(), coarser.end(), 1), 0);
}

TEST(LabelSplit, DropsSmallComponentsAndNamesThem)
{
  // A block of 1 with a speck of 2 inside, and two voxels of 3 outside.
  const std::array<int, 6> extent{ -2, 13, 4, 15, 0, 11 };
  const auto image = MakeImage(extent,
    [](int i, int j, int k)
    {
      const bool block = i >= 2 && i < 8 && j >= 7 && j < 13 && k >= 3 && k < 9;
      return i == 4 && j == 9 && k == 5 ? 2 : block ? 1 : i == 11 && j == 6 && k < 2 ? 3 : 0;
    });
  image->SetOrigin(10, 20, 30);
  image->SetSpacing(1, 2, 3);
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(image);
  split->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segments");
  split->SetMinimumComponentSize(2);
  split->Update();
  vtkFieldData* fieldData = split->GetOutput()->GetFieldData();
  EXPECT_EQ(ReadHeader(split->GetOutput()).Materials.size(), 3u); // 0, 1, 3
  ASSERT_EQ(fieldData->GetArray(Names::DroppedLabels)->GetNumberOfValues(), 1);
  EXPECT_EQ(fieldData->GetArray(Names::DroppedLabels)->GetComponent(0, 0), 2);
  EXPECT_EQ(fieldData->GetArray(Names::DroppedInto)->GetComponent(0, 0), 1);
  EXPECT_EQ(fieldData->GetArray(Names::DroppedVoxels)->GetComponent(0, 0), 1);
  const Vec3 position(fieldData->GetArray(Names::DroppedPositions)->GetTuple3(0));
  EXPECT_LT((position - Vec3(14, 38, 45)).norm(), 1e-9);
  split->SetMinimumComponentSize(3);
  split->Update();
  EXPECT_EQ(ReadHeader(split->GetOutput()).Materials.size(), 2u);
  EXPECT_EQ(split->GetOutput()->GetFieldData()->GetArray(Names::DroppedLabels)->GetNumberOfValues(), 2);
}
