// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMesher.h"

#include "Core/MeshChecks.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataAssembly.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStringArray.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <thread>

using namespace TestMeshes;

namespace
{
MeshCheck CheckOf(vtkPolyData* mesh)
{
  const InterfaceData data = ReadInterface(mesh);
  return CheckMesh(data.Points, data.Triangles, int(data.Materials.size()), data.Sets);
}

/// The positions and connectivity of a mesh as bytes.
std::string BytesOf(vtkPolyData* mesh)
{
  std::string bytes;
  const auto append = [&](vtkDataArray* array)
  {
    const char* data = static_cast<const char*>(array->GetVoidPointer(0));
    bytes.append(data, static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize());
  };
  append(mesh->GetPoints()->GetData());
  append(mesh->GetPolys()->GetConnectivityArray());
  append(mesh->GetCellData()->GetArray(Names::BoundaryLabels));
  return bytes;
}

/// Stops a filter at its first progress beyond a fraction.
class Stopper
{
public:
  Stopper(vtkAlgorithm* filter, double fraction)
    : Fraction(fraction)
    , Tag(filter->AddObserver(vtkCommand::ProgressEvent, this, &Stopper::Watch))
  {
  }
  void Watch(vtkObject* caller, unsigned long, void*)
  {
    vtkAlgorithm* filter = vtkAlgorithm::SafeDownCast(caller);
    if (filter->GetProgress() >= this->Fraction)
    {
      filter->SetAbortExecute(1);
    }
  }
  double Fraction;
  unsigned long Tag;
};
}

TEST(LabelMesher, TwoSpheres)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(TwoSpheres(64));
  mesher->SetMaterialName(1, "upper");
  mesher->Update();
  const MeshCheck check = CheckOf(mesher->GetOutput());
  ASSERT_EQ(check.Materials.size(), 3u);
  for (const MaterialCheck& material : check.Materials)
  {
    EXPECT_TRUE(material.EdgeManifold());
    EXPECT_TRUE(material.Oriented());
    EXPECT_EQ(material.NonManifoldVertices, 0);
    EXPECT_EQ(material.Euler, 2);
  }
  EXPECT_EQ(check.WrongFaces + check.DuplicateTriangles + check.SameMaterialTriangles, 0);
  vtkDataArray* kept = mesher->GetOutput()->GetFieldData()->GetArray(Names::KeptFromCutting);
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->GetComponent(0, 0), 0) << "improving it was possible everywhere";
  EXPECT_GE(check.Quality.MinRadiusRatio, 0.5);
  EXPECT_GE(check.Quality.MeanRadiusRatio, 0.93);
  const double sphere = 4.0 / 3.0 * M_PI * std::pow(17.0, 3);
  EXPECT_NEAR(check.Materials[1].Volume, sphere, 0.06 * sphere) << "less by what lies beyond the chords";

  vtkPartitionedDataSetCollection* surfaces = mesher->GetSurfaces();
  ASSERT_EQ(surfaces->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_STREQ(surfaces->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "upper");
  EXPECT_EQ(surfaces->GetFieldData()->GetArray(Names::TightVolumes)->GetNumberOfValues(), 3);
  EXPECT_GT(mesher->GetParticles()->GetNumberOfPoints(), 200);
  ASSERT_EQ(mesher->GetCurves()->GetNumberOfLines(), 1) << "the circle where both balls and the background meet";
}

TEST(LabelMesher, EqualsTheChainOfItsStages)
{
  const auto volume = TwoSpheres(40);
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  mesher->SetEpsilon(0.6);
  mesher->SetMaterialRadius(2, 1.0);
  mesher->Update();

  vtkNew<vtkLabelSplit> split;
  split->SetInputDataObject(volume);
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  tighten->SetMaterialRadius(2, 1.0);
  vtkNew<vtkIndicatorReconstruct> reconstruct;
  reconstruct->SetInputConnection(tighten->GetOutputPort());
  vtkNew<vtkSizingField> sizing;
  sizing->SetInputConnection(reconstruct->GetOutputPort());
  sizing->SetEpsilon(0.6);
  vtkNew<vtkParticleSampleCells> sample;
  sample->SetInputConnection(0, reconstruct->GetOutputPort());
  sample->SetInputConnection(1, sizing->GetOutputPort());
  vtkNew<vtkDelaunayLabelMesh> mesh;
  mesh->SetInputConnection(0, sample->GetOutputPort());
  mesh->SetInputConnection(1, reconstruct->GetOutputPort());
  mesh->Update();
  EXPECT_GT(mesh->GetOutput()->GetNumberOfCells(), 100);
  EXPECT_TRUE(BytesOf(mesh->GetOutput()) == BytesOf(mesher->GetOutput()));
}

TEST(LabelMesher, HandsTheSmoothingOn)
{
  const auto volume = TwoSpheres(32);
  vtkNew<vtkLabelSplit> split;
  split->SetInputDataObject(volume);
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  EXPECT_EQ(mesher->GetSmoothing(), vtkTighten::VolumeKeeping);
  const auto kept = [](vtkDataObject* data)
  { return data->GetFieldData()->GetArray(Names::KeptVolumes)->GetTuple1(1); };
  double last = 0.0;
  const auto expectBoth = [&](const char* what)
  {
    tighten->Update();
    mesher->Update();
    EXPECT_EQ(kept(mesher->GetSurfaces()), kept(tighten->GetOutput())) << what;
    EXPECT_NE(kept(mesher->GetSurfaces()), last) << what;
    last = kept(mesher->GetSurfaces());
  };
  expectBoth("defaults");
  mesher->SetFidelity(0.4);
  tighten->SetFidelity(0.4);
  expectBoth("Fidelity");
  mesher->SetRounds(3);
  tighten->SetRounds(3);
  expectBoth("Rounds");
  mesher->SetSmoothingToTightening();
  tighten->SetSmoothingToTightening();
  expectBoth("Smoothing");
  EXPECT_EQ(mesher->GetSmoothing(), vtkTighten::Tightening);
  EXPECT_EQ(mesher->GetFidelity(), 0.4);
  EXPECT_EQ(mesher->GetRounds(), 3);
  mesher->SetSmoothingToVolumeKeeping();
  EXPECT_EQ(mesher->GetSmoothing(), vtkTighten::VolumeKeeping);
}

TEST(LabelMesher, RunsOnlyTheStagesThatChanged)
{
  vtkNew<vtkLabelMesher> mesher;
  const auto volume = TwoSpheres(32);
  mesher->SetInputData(volume);
  mesher->Update();
  const auto runs = [&]()
  {
    std::vector<int> counts;
    for (int s = 0; s < mesher->GetNumberOfStages(); ++s)
    {
      counts.push_back(mesher->GetStageRuns(mesher->GetStageName(s)));
    }
    return counts;
  };
  EXPECT_EQ(runs(), (std::vector<int>{ 1, 1, 1, 1, 1, 1 }));
  mesher->Update();
  EXPECT_EQ(runs(), (std::vector<int>{ 1, 1, 1, 1, 1, 1 }));
  const std::string first = BytesOf(mesher->GetOutput());
  mesher->SetEpsilon(0.8);
  mesher->Update();
  EXPECT_EQ(runs(), (std::vector<int>{ 1, 1, 1, 2, 2, 2 })) << "a new sizing does not tighten again";
  EXPECT_FALSE(first == BytesOf(mesher->GetOutput()));
  mesher->SetRepairRounds(2);
  mesher->Update();
  EXPECT_EQ(runs(), (std::vector<int>{ 1, 1, 1, 2, 2, 3 }));
  mesher->SetRadius(0.9);
  mesher->Update();
  EXPECT_EQ(runs(), (std::vector<int>{ 2, 2, 2, 3, 3, 4 })) << "masks are not kept";
  volume->GetPointData()->GetScalars()->Modified();
  volume->Modified();
  mesher->SetRadius(0.7);
  mesher->SetRepairRounds(8);
  mesher->SetEpsilon(0.65);
  mesher->Update();
  EXPECT_EQ(runs(), (std::vector<int>{ 3, 3, 3, 4, 4, 5 })) << "new data runs everything";
  EXPECT_TRUE(first == BytesOf(mesher->GetOutput())) << "and what is kept has left no trace";
  EXPECT_GT(mesher->GetStageSeconds("Tighten"), 0.0);
  EXPECT_EQ(mesher->GetStageSeconds("no such stage"), 0.0);
}

TEST(LabelMesher, SameBytesForAnyNumberOfThreads)
{
  std::string bytes[2];
  for (int n = 0; n < 2; ++n)
  {
    vtkSMPTools::Initialize(n + 1);
    vtkNew<vtkLabelMesher> mesher;
    mesher->SetInputData(TwoSpheres(40));
    mesher->Update();
    bytes[n] = BytesOf(mesher->GetOutput());
  }
  vtkSMPTools::Initialize();
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST(LabelMesher, UserSizing)
{
  const auto volume = TwoSpheres(48);
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  mesher->Update();
  const vtkIdType free = mesher->GetOutput()->GetNumberOfCells();
  vtkNew<vtkImageData> bound;
  bound->CopyStructure(volume);
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Bound");
  lengths->SetNumberOfValues(bound->GetNumberOfPoints());
  lengths->FillValue(1.0f);
  bound->GetPointData()->SetScalars(lengths);
  mesher->SetInputData(1, bound);
  mesher->Update();
  EXPECT_GT(mesher->GetOutput()->GetNumberOfCells(), 1.3 * free);
  EXPECT_EQ(mesher->GetStageRuns("Tighten"), 1);
  mesher->SetInputData(1, nullptr);
  mesher->Update();
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), free);
}

TEST(LabelMesher, NamesAndColorsRunNoStage)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputDataObject(TwoSpheres(24));
  mesher->Update();
  const auto nameOf = [&](int block)
  { return std::string(mesher->GetSurfaces()->GetMetaData(block)->Get(vtkCompositeDataSet::NAME())); };
  const auto colorOf = [&](int block)
  { return mesher->GetSurfaces()->GetPartition(block, 0)->GetFieldData()->GetArray(Names::Color)->GetTuple3(0)[2]; };
  const double before = colorOf(0);
  const std::string bytes = BytesOf(mesher->GetOutput());
  mesher->SetMaterialName(1, "upper");
  mesher->SetMaterialColor(1, 0.125, 0.25, 0.375);
  mesher->Update();
  EXPECT_EQ(nameOf(0), "upper");
  EXPECT_EQ(nameOf(1), "Label_2");
  EXPECT_EQ(colorOf(0), 0.375);
  vtkDataAssembly* assembly = mesher->GetSurfaces()->GetDataAssembly();
  EXPECT_EQ(assembly->GetDataSetIndices(assembly->FindFirstNodeWithName("upper")), std::vector<unsigned int>{ 0 });
  for (int port : { 0, 1, 2, 3 })
  {
    vtkFieldData* fieldData = mesher->GetOutputDataObject(port)->GetFieldData();
    EXPECT_EQ(vtkStringArray::SafeDownCast(fieldData->GetAbstractArray(Names::MaterialNames))->GetValue(1), "upper");
    EXPECT_EQ(fieldData->GetArray(Names::MaterialColors)->GetComponent(1, 1), 0.25) << port;
  }
  for (int stage = 0; stage < mesher->GetNumberOfStages(); ++stage)
  {
    EXPECT_EQ(mesher->GetStageRuns(mesher->GetStageName(stage)), 1) << mesher->GetStageName(stage);
  }
  EXPECT_EQ(BytesOf(mesher->GetOutput()), bytes);
  mesher->ClearMaterialNames();
  mesher->ClearMaterialColors();
  mesher->Update();
  EXPECT_EQ(nameOf(0), "Label_1") << "what the stages keep has not been written to";
  EXPECT_EQ(colorOf(0), before);
}

TEST(LabelMesher, ALengthPerInterface)
{
  // The longest edge between 1 and 2, and among those of 1 and the background that are far from 2.
  const auto longest = [](vtkPolyData* mesh, double& between, double& away)
  {
    between = away = 0;
    vtkDataArray* labels = mesh->GetCellData()->GetArray(Names::BoundaryLabels);
    const InterfaceData data = ReadInterface(mesh);
    for (vtkIdType t = 0; t < mesh->GetNumberOfCells(); ++t)
    {
      const double sum = labels->GetComponent(t, 0) + labels->GetComponent(t, 1);
      for (int corner = 0; corner < 3; ++corner)
      {
        const Vec3& a = data.Points[data.Triangles[t].Vertices[corner]];
        const double length = (a - data.Points[data.Triangles[t].Vertices[(corner + 1) % 3]]).norm();
        double& most = sum == 3 ? between : away;
        if (sum == 3 || (sum == 1 && a[2] > 0.7 * 32))
        {
          most = std::max(most, length);
        }
      }
    }
  };
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputDataObject(TwoSpheres(32));
  mesher->Update();
  double between = 0, away = 0, fineBetween = 0, fineAway = 0;
  longest(mesher->GetOutput(), between, away);
  mesher->SetInterfaceMaximumLength(2, 1, 0.5);
  EXPECT_EQ(mesher->GetInterfaceMaximumLength(1, 2), 0.5);
  mesher->Update();
  longest(mesher->GetOutput(), fineBetween, fineAway);
  EXPECT_GT(between, 1.5);
  EXPECT_LT(fineBetween, 1.0); // edges are at most about 1.6 target lengths long
  EXPECT_NEAR(fineAway, away, 0.35 * away);
  EXPECT_EQ(mesher->GetStageRuns("Tighten"), 1) << "only the sizing and what follows it";
  mesher->ClearInterfaceMaximumLengths();
  EXPECT_EQ(mesher->GetInterfaceMaximumLength(1, 2), 0.0);
}

TEST(LabelMesher, MirroredAndOriented)
{
  for (const bool mirrored : { false, true })
  {
    const auto volume = TwoSpheres(40);
    Mat3 direction = Mat3::Identity();
    direction(2, 2) = mirrored ? -1 : 1;
    SetFrame(volume, GridFrame(FrameOf(volume).Extent(), Vec3(5, 6, 7), Vec3(1, 1.25, 0.8), direction));
    vtkNew<vtkLabelMesher> mesher;
    mesher->SetInputData(volume);
    mesher->Update();
    const MeshCheck check = CheckOf(mesher->GetOutput());
    const double sphere = 4.0 / 3.0 * M_PI * std::pow(34 * 40.0 / 128, 3);
    EXPECT_TRUE(check.Materials[1].EdgeManifold() && check.Materials[1].Oriented());
    EXPECT_NEAR(check.Materials[1].Volume, sphere, 0.12 * sphere) << "outward, whichever way the image is";
  }
}

namespace
{
/// Frames of one grid: turned, mirrored, exchanged axes, moved.
std::vector<GridFrame> FramesOf(const std::array<int, 6>& extent, const Vec3& spacing)
{
  Mat3 turned;
  turned << 0.36, -0.48, 0.8, 0.8, 0.6, 0.0, -0.48, 0.64, 0.6;
  Mat3 mirrored = turned;
  mirrored.col(1) *= -1;
  Mat3 exchanged;
  exchanged << 0, 1, 0, 1, 0, 0, 0, 0, 1; // a mirror, too
  Mat3 inverted = -Mat3::Identity();
  std::vector<GridFrame> frames;
  for (const Mat3& direction : { turned, mirrored, exchanged, inverted })
  {
    frames.emplace_back(extent, Vec3(12, -345, 6.5), spacing, direction);
  }
  return frames;
}

/// Expects the mesh of `plain`, whose frame has neither origin nor direction, moved by the isometry of `frame`.
void ExpectMoved(vtkPolyData* plain, vtkPolyData* moved, const GridFrame& frame)
{
  ASSERT_EQ(moved->GetNumberOfPoints(), plain->GetNumberOfPoints());
  double farthest = 0;
  for (vtkIdType n = 0; n < plain->GetNumberOfPoints(); ++n)
  {
    const Vec3 expected = frame.Direction() * Vec3(plain->GetPoint(n)) + frame.Origin();
    farthest = std::max(farthest, (Vec3(moved->GetPoint(n)) - expected).norm());
  }
  EXPECT_LT(farthest, 1e-9) << "rounding of coordinates below a thousand";
  const InterfaceData a = ReadInterface(plain), b = ReadInterface(moved);
  const bool mirror = frame.Direction().determinant() < 0;
  ASSERT_EQ(a.Triangles.size(), b.Triangles.size());
  for (std::size_t t = 0; t < a.Triangles.size(); ++t)
  {
    std::array<Index, 3> before, after;
    std::copy_n(a.Triangles[t].Vertices.begin(), 3, before.begin());
    std::copy_n(b.Triangles[t].Vertices.begin(), 3, after.begin());
    // The first vertex may be another, the way around is that of the frame.
    if (mirror)
    {
      std::reverse(after.begin(), after.end());
    }
    std::rotate(before.begin(), std::min_element(before.begin(), before.end()), before.end());
    std::rotate(after.begin(), std::min_element(after.begin(), after.end()), after.end());
    ASSERT_EQ(before, after) << "triangle " << t;
    ASSERT_EQ(a.Triangles[t].Materials, b.Triangles[t].Materials) << "triangle " << t;
  }
}
}

TEST(LabelMesher, FramesMoveTheMeshAndNothingElse)
{
  for (const Vec3& spacing : { Vec3(1, 1, 1), Vec3(0.3, 1, 3), Vec3(1, 10, 1) })
  {
    for (const int first : { 0, -7 })
    {
      // Balls of voxels, however long the voxels are; one reaches the border of the volume.
      const std::array<int, 6> extent = { first, first + 23, first, first + 19, 0, 21 };
      const auto volume = LabelVolume(extent,
        [first](int i, int j, int k)
        {
          const Vec3 x(i - first, j - first, k);
          return (x - Vec3(9, 9, 9)).norm() < 8 ? 1 : (x - Vec3(17, 10, 12)).norm() < 8 ? 2 : 0;
        });
      SetFrame(volume, GridFrame(extent, Vec3::Zero(), spacing, Mat3::Identity()));
      vtkNew<vtkLabelMesher> plain;
      plain->SetInputData(volume);
      plain->Update();
      ASSERT_GT(plain->GetOutput()->GetNumberOfCells(), 500);
      const MeshCheck check = CheckOf(plain->GetOutput());
      for (const GridFrame& frame : FramesOf(extent, spacing))
      {
        const auto turned = vtkSmartPointer<vtkImageData>::New();
        turned->DeepCopy(volume);
        SetFrame(turned, frame);
        vtkNew<vtkLabelMesher> mesher;
        mesher->SetInputData(turned);
        mesher->Update();
        ExpectMoved(plain->GetOutput(), mesher->GetOutput(), frame);
        const MeshCheck moved = CheckOf(mesher->GetOutput());
        for (std::size_t m = 1; m < moved.Materials.size(); ++m)
        {
          EXPECT_TRUE(moved.Materials[m].Sound());
          EXPECT_GT(moved.Materials[m].Volume, 0) << "outward";
          EXPECT_NEAR(moved.Materials[m].Volume, check.Materials[m].Volume, 1e-6 * check.Materials[m].Volume);
        }
      }
    }
  }
}

TEST(LabelMesher, ErrorsAreItsOwnAndSaidOnce)
{
  vtkNew<vtkLabelMesher> mesher;
  Complaints complaints(mesher);
  mesher->SetInputData(LabelVolume({ 0, 9, 0, 9, 0, 0 }, [](int, int, int) { return 1; }));
  mesher->Update();
  EXPECT_EQ(complaints.Count, 1) << complaints.Text;
  EXPECT_TRUE(complaints.Say("vtkLabelMesher")) << complaints.Text;
  EXPECT_FALSE(complaints.Say("vtkLabelSplit")) << complaints.Text;
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 0);
  mesher->SetInputData(TwoSpheres(32));
  mesher->Update();
  EXPECT_GT(mesher->GetOutput()->GetNumberOfCells(), 100) << "works again after an error";
}

TEST(LabelMesher, AbortStopsTheRunningStage)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(TwoSpheres(48));
  Stopper stopper(mesher, 0.1);
  mesher->Update();
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(mesher->GetStageRuns("DelaunayLabelMesh"), 0);
  EXPECT_EQ(mesher->GetStageRuns("SizingField"), 0) << "a tenth of the way is within Tighten";
  mesher->RemoveObserver(stopper.Tag);
  mesher->SetAbortExecute(0);
  mesher->Modified();
  mesher->Update();
  EXPECT_GT(mesher->GetOutput()->GetNumberOfCells(), 100) << "runs again after an abort";
}

namespace
{
/// Stops a filter at a chosen one of its progress events, and measures how much work lies between two of them.
class EventCounter
{
public:
  explicit EventCounter(vtkAlgorithm* filter, int last = -1)
    : Last(last)
    , Tag(filter->AddObserver(vtkCommand::ProgressEvent, this, &EventCounter::Watch))
    , Before(std::clock())
  {
  }
  void Watch(vtkObject* caller, unsigned long, void*)
  {
    const std::clock_t now = std::clock();
    this->LongestGap = std::max(this->LongestGap, double(now - this->Before) / CLOCKS_PER_SEC);
    this->Before = now;
    if (this->Count++ == this->Last)
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }
  int Last;
  unsigned long Tag;
  std::clock_t Before;
  int Count = 0;
  double LongestGap = 0.0; ///< seconds of all processors, which the load of the machine does not change
};
}

TEST(LabelMesher, AbortAtAnyPointLeavesNothingBehind)
{
  const auto volume = TwoSpheres(20);
  vtkNew<vtkLabelMesher> fresh;
  fresh->SetInputData(volume);
  fresh->Update();
  const std::string expected = BytesOf(fresh->GetOutput());
  // Of the run that is aborted, which has one label: how many steps mending and tracing take depends on the mesh.
  fresh->AddLabel(1);
  EventCounter all(fresh);
  fresh->Update();
  ASSERT_GT(all.Count, 60);
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  for (int last = 0; last + 2 < all.Count; last += 3)
  {
    EventCounter stopper(mesher, last);
    mesher->SetAbortExecute(0);
    mesher->Modified();
    mesher->AddLabel(1); // so that all stages run anew
    mesher->Update();
    for (int port = 0; port < 4; ++port)
    {
      if (auto* output = vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(port)))
      {
        EXPECT_EQ(output->GetNumberOfPoints(), 0) << "port " << port << ", event " << last;
      }
    }
    EXPECT_EQ(mesher->GetSurfaces()->GetNumberOfPartitionedDataSets(), 0u) << "event " << last;
    mesher->RemoveObserver(stopper.Tag);
    mesher->ClearLabels();
    mesher->SetAbortExecute(0);
    mesher->Modified();
    mesher->Update();
    EXPECT_EQ(BytesOf(mesher->GetOutput()), expected) << "after an abort at event " << last;
  }
}

#ifndef LABELMESH_SANITIZED // ten times slower
TEST(LabelMesher, HearsOfAnAbortInTime)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(TwoSpheres(160));
  EventCounter counter(mesher);
  mesher->Update();
  EXPECT_LT(counter.LongestGap, 1.0);
}
#endif

TEST(LabelMesher, TwoAtOnceInOneProcess)
{
  const auto meshOf = [](vtkImageData* volume)
  {
    vtkNew<vtkLabelMesher> mesher;
    mesher->SetInputData(volume);
    mesher->Update();
    return BytesOf(mesher->GetOutput());
  };
  const std::array<vtkSmartPointer<vtkImageData>, 2> volumes = { TwoSpheres(24), TwoSpheres(31) };
  std::array<std::string, 2> alone, together;
  for (std::size_t n = 0; n < 2; ++n)
  {
    alone[n] = meshOf(volumes[n]);
  }
  for (int round = 0; round < 5; ++round)
  {
    std::thread other([&]() { together[0] = meshOf(volumes[0]); });
    together[1] = meshOf(volumes[1]);
    other.join();
    EXPECT_EQ(together, alone);
  }
}

TEST(LabelMesher, ProgressNamesTheStages)
{
  struct Notes
  {
    std::string Text;
    double Last = 0.0;
    bool Monotone = true;
    void Note(vtkObject* caller, unsigned long, void*)
    {
      vtkAlgorithm* filter = vtkAlgorithm::SafeDownCast(caller);
      this->Monotone = this->Monotone && filter->GetProgress() >= this->Last - 1e-9;
      this->Last = filter->GetProgress();
      this->Text += filter->GetProgressText() ? filter->GetProgressText() : "";
    }
  } notes;
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(TwoSpheres(24));
  mesher->AddObserver(vtkCommand::ProgressEvent, &notes, &Notes::Note);
  mesher->Update();
  for (int s = 0; s < mesher->GetNumberOfStages(); ++s)
  {
    EXPECT_NE(notes.Text.find(mesher->GetStageName(s)), std::string::npos) << mesher->GetStageName(s);
  }
  EXPECT_TRUE(notes.Monotone);
  EXPECT_NEAR(notes.Last, 1.0, 1e-6);
}
