// SPDX-License-Identifier: BSD-3-Clause
// A finer grid where labels ask for one: MaximumUpsampling of vtkLabelSplit and what comes of it.
#include "LabelMeshNames.h"
#include "MemoryEstimate.h"
#include "TestMeshes.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelMeshReport.h"
#include "vtkLabelMesher.h"
#include "vtkLabelSplit.h"
#include "vtkTighten.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <limits>

using namespace TestMeshes;

namespace
{
constexpr int Size = 14;

/// A sheet of one voxel, 2, that leans between 1 and 3.
vtkSmartPointer<vtkImageData> Sheet()
{
  return LabelVolume({ 0, Size - 1, 0, Size - 1, 0, Size - 1 },
    [](int i, int j, int k)
    {
      const int height = 4 + (i + 2 * j) / 8;
      return k < height ? 1 : k == height ? 2 : 3;
    });
}

/// Voronoi cells of some thirty voxels.
vtkSmartPointer<vtkImageData> Grains()
{
  return LabelVolume({ 0, Size - 1, 0, Size - 1, 0, Size - 1 },
    [](int i, int j, int k)
    {
      int nearest = 0, least = std::numeric_limits<int>::max();
      for (int n = 0; n < 90; ++n)
      {
        const int x = i - n * 37 % 97 * Size / 97, y = j - n * 59 % 89 * Size / 89, z = k - n * 71 % 83 * Size / 83;
        const int distance = x * x + y * y + z * z;
        nearest = distance < least ? n + 1 : nearest;
        least = std::min(least, distance);
      }
      return nearest;
    });
}

struct Outcome
{
  vtkIdType LostPairs = 0, LostLabels = 0;
  double LargestChange = 0.0; ///< of a label's volume, of the volume of its voxels
  bool Certified = false;
};

Outcome MeshAndReport(vtkImageData* volume, int limit)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  mesher->SetMaximumUpsampling(limit);
  mesher->Update();
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, mesher->GetOutput());
  report->SetInputData(1, volume);
  report->SetInputData(2, mesher->GetSurfaces());
  report->Update();
  Outcome outcome;
  vtkTable* materials = report->GetOutput(0);
  for (vtkIdType row = 0; row < materials->GetNumberOfRows(); ++row)
  {
    const auto cell = [&](const char* name) { return materials->GetValueByName(row, name).ToDouble(); };
    if (cell("Label") != 0 && cell("VoxelVolume") > 0)
    {
      outcome.LargestChange = std::max(outcome.LargestChange, std::abs(cell("Volume") / cell("VoxelVolume") - 1));
    }
  }
  vtkTable* losses = report->GetOutput(2);
  for (vtkIdType row = 0; row < losses->GetNumberOfRows(); ++row)
  {
    const std::string kind = losses->GetValueByName(row, "Kind").ToString();
    outcome.LostPairs += kind == "pair" ? 1 : 0;
    outcome.LostLabels += kind == "pair" ? 0 : 1;
  }
  outcome.Certified = materials->GetFieldData()->GetArray("Certified")->GetComponent(0, 0) != 0;
  return outcome;
}

int FactorOf(vtkDataObject* data)
{
  vtkDataArray* factor = data->GetFieldData()->GetArray(Names::Upsampling);
  return factor ? int(factor->GetComponent(0, 0)) : 0;
}
}

TEST(Upsampling, AThinSheetKeepsItsVolumeAndItsNeighbours)
{
  const Outcome outcome = MeshAndReport(Sheet(), 3);
  EXPECT_TRUE(outcome.Certified);
  EXPECT_EQ(outcome.LostPairs + outcome.LostLabels, 0);
  EXPECT_LT(outcome.LargestChange, 0.05);
}

TEST(Upsampling, SmallGrainsKeepTheirNeighbours)
{
  const auto grains = Grains();
  const Outcome without = MeshAndReport(grains, 1), with = MeshAndReport(grains, 3);
  EXPECT_TRUE(with.Certified);
  EXPECT_GT(without.LostPairs, 0) << "else this volume shows nothing";
  EXPECT_EQ(with.LostPairs + with.LostLabels, 0);
  EXPECT_LT(with.LargestChange, 0.1);
  EXPECT_LT(with.LargestChange, without.LargestChange);
}

TEST(Upsampling, TheGridIsKnownBeforeThereIsData)
{
  const auto sheet = Sheet();
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(sheet);
  const auto published = [&]()
  {
    split->UpdateInformation();
    GridFrame source;
    int padding = 0;
    EXPECT_TRUE(PublishedFrame(split->GetOutputInformation(0), source, padding));
    return source.Samples().Dims[0];
  };
  EXPECT_EQ(published(), Size);
  split->SetMaximumUpsampling(3);
  EXPECT_EQ(published(), 2 * Size);
  split->Update();
  EXPECT_EQ(ReadHeader(split->GetOutput()).Source.Samples().Dims[0], 2 * Size);
  EXPECT_EQ(FactorOf(split->GetOutput()), 2);
  auto* reason =
    vtkStringArray::SafeDownCast(split->GetOutput()->GetFieldData()->GetAbstractArray(Names::UpsamplingReason));
  ASSERT_NE(reason, nullptr);
  EXPECT_NE(reason->GetValue(0).find("100 % under two voxels thick"), std::string::npos) << reason->GetValue(0);

  vtkNew<vtkTighten> tighten;
  vtkNew<vtkIndicatorReconstruct> reconstruct;
  tighten->SetInputConnection(split->GetOutputPort());
  reconstruct->SetInputConnection(tighten->GetOutputPort());
  for (const int limit : { 1, 2 })
  {
    split->SetMaximumUpsampling(limit);
    reconstruct->Update();
    EXPECT_EQ(reconstruct->GetLabelImage()->GetDimensions()[0], limit * Size);
  }
  split->SetResamplingFactor(3); // by hand
  EXPECT_EQ(published(), 3 * Size);
  split->Update();
  EXPECT_EQ(FactorOf(split->GetOutput()), 0);
}

TEST(Upsampling, ThickLabelsAskForNothing)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(TwoSpheres(32));
  split->SetMaximumUpsampling(4);
  Complaints complaints(split);
  split->Update();
  EXPECT_EQ(ReadHeader(split->GetOutput()).Source.Samples().Dims[0], 32);
  EXPECT_EQ(FactorOf(split->GetOutput()), 1);
  EXPECT_EQ(complaints.Count, 0);
}

TEST(Upsampling, StaysWithinTheMemoryLimit)
{
  const auto grains = Grains();
  const LabelImage labels = ReadLabelImage(grains, grains->GetPointData()->GetScalars(), false);
  const auto estimate = [&](int factor) { return EstimateMemory(labels, 0, 6, factor) / 1073741824; };
  for (const int allowed : { 1, 2, 3 })
  {
    vtkNew<vtkLabelSplit> split;
    split->SetInputData(grains);
    split->SetMaximumUpsampling(3);
    split->SetMemoryLimit(1.01 * estimate(allowed));
    Complaints complaints(split);
    split->Update();
    EXPECT_EQ(FactorOf(split->GetOutput()), allowed);
    EXPECT_EQ(complaints.Count, allowed < 3 ? 1 : 0) << complaints.Text;
    EXPECT_EQ(complaints.Say("memory limit"), allowed < 3);
  }
}

TEST(Upsampling, WhatCannotBeReadIsAnError)
{
  const auto sheet = Sheet();
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(sheet);
  split->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Nothing");
  split->SetMaximumUpsampling(2);
  Complaints complaints(split);
  split->Update();
  EXPECT_TRUE(complaints.Say("no such array")) << complaints.Text;
}
