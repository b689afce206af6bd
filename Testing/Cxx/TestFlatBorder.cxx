// SPDX-License-Identifier: BSD-3-Clause
// Mode Flat of the volume's border, through all stages.
#include "Core/MeshChecks.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelMesher.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

using namespace TestMeshes;

namespace
{
using Mesher = vtkSmartPointer<vtkLabelMesher>;

Mesher Meshed(vtkImageData* volume)
{
  auto mesher = Mesher::New();
  mesher->SetInputData(volume);
  mesher->SetBorderToFlat();
  mesher->Update();
  return mesher;
}

/// 24 grains around random points, background nowhere.
int Grain(int i, int j, int k)
{
  unsigned state = 12345;
  const auto next = [&state]()
  {
    state = state * 1664525u + 1013904223u;
    return double(state >> 8) / double(1 << 24);
  };
  int nearest = 0;
  double best = 1e30;
  for (int n = 1; n <= 24; ++n)
  {
    const Vec3 site(30 * next(), 26 * next(), 22 * next());
    const double distance = (site - Vec3(i, j, k)).squaredNorm();
    nearest = distance < best ? n : nearest;
    best = std::min(best, distance);
  }
  return nearest;
}
const std::array<int, 6> GrainExtent{ 0, 29, 0, 25, 0, 21 };

/// Certified: closed, manifold, oriented, no triangle wrong, none that cut each other.
MeshCheck CheckCertified(vtkPolyData* mesh)
{
  const InterfaceData data = ReadInterface(mesh);
  const MeshCheck check = CheckMesh(data.Points, data.Triangles, int(data.Materials.size()), data.Sets);
  for (const MaterialCheck& material : check.Materials)
  {
    EXPECT_TRUE(material.EdgeManifold());
    EXPECT_TRUE(material.Oriented());
    EXPECT_EQ(material.NonManifoldVertices + material.SelfIntersections, 0);
  }
  EXPECT_EQ(check.WrongFaces + check.DuplicateTriangles + check.SameMaterialTriangles, 0);
  return check;
}

/// The faces, in index coordinates, that a position lies on; expects one that is near a face to be on it.
std::array<bool, 6> FacesOf(const GridFrame& frame, const Vec3& x, double tolerance)
{
  const Vec3 local = frame.WorldToLocal(x);
  std::array<bool, 6> on{};
  for (int f = 0; f < 6; ++f)
  {
    const int a = f / 2;
    const double plane = (frame.Extent()[f] + (f % 2 == 0 ? -0.5 : 0.5)) * frame.Spacing()[a];
    on[f] = std::abs(local[a] - plane) <= tolerance;
    EXPECT_GE((f % 2 == 0 ? 1 : -1) * (local[a] - plane), -tolerance) << "beyond the box";
  }
  return on;
}

/// Triangles against the background lie in one face each and their area is that of the box; the edges of the box are
/// edges of the mesh.
void ExpectWholeBox(vtkPolyData* mesh, const GridFrame& frame, double tolerance)
{
  const InterfaceData data = ReadInterface(mesh);
  std::array<double, 6> areas{};
  std::map<std::pair<int, int>, std::set<std::pair<Index, Index>>> edges;
  for (const InterfaceTriangle& t : data.Triangles)
  {
    if (data.Materials[t.Materials[1]].Label != data.Background)
    {
      continue;
    }
    std::array<std::array<bool, 6>, 3> on;
    for (int c = 0; c < 3; ++c)
    {
      on[c] = FacesOf(frame, data.Points[t.Vertices[c]], tolerance);
    }
    const Vec3 &a = data.Points[t.Vertices[0]], &b = data.Points[t.Vertices[1]], &c = data.Points[t.Vertices[2]];
    int faces = 0;
    for (int f = 0; f < 6; ++f)
    {
      const bool within = on[0][f] && on[1][f] && on[2][f];
      faces += within;
      areas[f] += within ? 0.5 * (b - a).cross(c - a).norm() : 0.0;
      for (int g = f + 1; g < 6; ++g)
      {
        for (int v = 0; v < 3; ++v)
        {
          const int w = (v + 1) % 3;
          if (on[v][f] && on[v][g] && on[w][f] && on[w][g])
          {
            edges[{ f, g }].insert(std::minmax(t.Vertices[v], t.Vertices[w]));
          }
        }
      }
    }
    EXPECT_EQ(faces, 1) << "a dent";
  }
  const Lattice samples = frame.Samples();
  const Vec3 size = samples.Spacing.cwiseProduct(Vec3(samples.Dims[0], samples.Dims[1], samples.Dims[2]));
  for (int f = 0; f < 6; ++f)
  {
    EXPECT_NEAR(areas[f], size.prod() / size[f / 2], 1e-9 * size.prod());
  }
  ASSERT_EQ(edges.size(), 12u);
  for (const auto& [pair, segments] : edges)
  {
    double length = 0.0;
    for (const auto& [v, w] : segments)
    {
      length += (data.Points[v] - data.Points[w]).norm();
    }
    EXPECT_NEAR(length, size[3 - pair.first / 2 - pair.second / 2], 1e-9 * size.maxCoeff());
  }
}

double VolumeOfLabels(const MeshCheck& check)
{
  double sum = 0.0;
  for (std::size_t m = 1; m < check.Materials.size(); ++m)
  {
    sum += check.Materials[m].Volume;
  }
  return sum;
}
}

TEST(FlatBorder, FullVolumeIsExactlyItsBox)
{
  const auto volume = LabelVolume({ 0, 19, 0, 23, 0, 27 }, [](int, int, int) { return 4; });
  const Mesher mesher = Meshed(volume);
  const MeshCheck check = CheckCertified(mesher->GetOutput());
  EXPECT_NEAR(VolumeOfLabels(check), 20.0 * 24 * 28, 1e-12 * 20 * 24 * 28);
  EXPECT_EQ(check.Materials[1].Euler, 2);
  EXPECT_LT(mesher->GetOutput()->GetNumberOfCells(), 400) << "flat faces are coarse";
  ExpectWholeBox(mesher->GetOutput(), FrameOf(volume), 0.0);
}

TEST(FlatBorder, TwoHalves)
{
  const auto volume = LabelVolume({ 0, 23, 0, 19, 0, 19 }, [](int i, int, int) { return i < 10 ? 1 : 2; });
  const Mesher mesher = Meshed(volume);
  const MeshCheck check = CheckCertified(mesher->GetOutput());
  EXPECT_NEAR(check.Materials[1].Volume, 4000, 20);
  EXPECT_NEAR(VolumeOfLabels(check), 9600, 1e-9);
  ExpectWholeBox(mesher->GetOutput(), FrameOf(volume), 0.0);
  // The interface between the two stays flat up to the border.
  const InterfaceData data = ReadInterface(mesher->GetOutput());
  for (const InterfaceTriangle& t : data.Triangles)
  {
    for (const Index v : t.Vertices)
    {
      EXPECT_TRUE(t.Materials[1] == 0 || std::abs(data.Points[v][0] - 9.5) < 0.02);
    }
  }
}

TEST(FlatBorder, GrainsFillTheBox)
{
  const auto volume = LabelVolume(GrainExtent, Grain);
  const Mesher mesher = Meshed(volume);
  const MeshCheck check = CheckCertified(mesher->GetOutput());
  EXPECT_NEAR(VolumeOfLabels(check), 30.0 * 26 * 22, 1e-9);
  ExpectWholeBox(mesher->GetOutput(), FrameOf(volume), 0.0);
  vtkDataArray* masks = mesher->GetSurfaces()->GetFieldData()->GetArray(Names::MaskVolumes);
  vtkDataArray* tight = mesher->GetSurfaces()->GetFieldData()->GetArray(Names::TightVolumes);
  double maskSum = 0.0, tightSum = 0.0;
  for (vtkIdType n = 0; n < masks->GetNumberOfTuples(); ++n)
  {
    maskSum += masks->GetTuple1(n);
    tightSum += tight->GetTuple1(n);
  }
  EXPECT_NEAR(maskSum, 30 * 26 * 22, 1e-6) << "what lies beyond the border does not count";
  EXPECT_NEAR(tightSum, 30 * 26 * 22, 1e-6);
}

TEST(FlatBorder, BodyThatLeavesThroughAFace)
{
  const auto ball = [](double high)
  { return [high](int i, int j, int k) { return (Vec3(i, j, k) - Vec3(high, 15, 15)).norm() <= 10.2 ? 1 : 0; }; };
  const auto volume = LabelVolume({ 0, 26, 0, 30, 0, 30 }, ball(26));
  const Mesher mesher = Meshed(volume);
  CheckCertified(mesher->GetOutput());
  const InterfaceData data = ReadInterface(mesher->GetOutput());
  double cap = 0.0;
  Index onFace = 0;
  for (const Vec3& x : data.Points)
  {
    EXPECT_LE(x[0], 26.5);
    onFace += x[0] == 26.5;
    EXPECT_TRUE(x[0] == 26.5 || x[0] < 26.5 - 1e-6);
  }
  for (const InterfaceTriangle& t : data.Triangles)
  {
    const Vec3 &a = data.Points[t.Vertices[0]], &b = data.Points[t.Vertices[1]], &c = data.Points[t.Vertices[2]];
    cap += a[0] == 26.5 && b[0] == 26.5 && c[0] == 26.5 ? 0.5 * (b - a).cross(c - a).norm() : 0.0;
  }
  EXPECT_GT(onFace, 20);
  EXPECT_NEAR(cap, M_PI * (10.2 * 10.2 - 0.25), 0.04 * M_PI * 104);
}

TEST(FlatBorder, AnisotropicTurnedAndMirrored)
{
  const auto volume = LabelVolume({ 3, 22, -4, 17, 5, 20 }, [](int i, int j, int) { return i + j < 14 ? 1 : 2; });
  volume->SetSpacing(0.8, 1.1, 1.7);
  volume->SetOrigin(-3, 20, 7);
  const double c = std::cos(0.6), s = std::sin(0.6);
  volume->SetDirectionMatrix(c, s, 0, s, -c, 0, 0, 0, 1); // of determinant -1
  const Mesher mesher = Meshed(volume);
  const MeshCheck check = CheckCertified(mesher->GetOutput());
  const double whole = 20 * 22 * 16 * 0.8 * 1.1 * 1.7;
  EXPECT_NEAR(VolumeOfLabels(check), whole, 1e-9 * whole);
  ExpectWholeBox(mesher->GetOutput(), FrameOf(volume), 1e-12 * 50);
}

TEST(FlatBorder, SameBitsForAnyNumberOfThreads)
{
  const auto volume = LabelVolume(GrainExtent, Grain);
  std::vector<std::vector<double>> meshes;
  for (const int threads : { 1, 2 })
  {
    vtkSMPTools::Initialize(threads);
    const InterfaceData data = ReadInterface(Meshed(volume)->GetOutput());
    meshes.emplace_back();
    for (const Vec3& x : data.Points)
    {
      meshes.back().insert(meshes.back().end(), x.data(), x.data() + 3);
    }
    for (const InterfaceTriangle& t : data.Triangles)
    {
      meshes.back().insert(meshes.back().end(), t.Vertices.begin(), t.Vertices.end());
    }
  }
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(meshes[0], meshes[1]);
}

TEST(FlatBorder, MasksGoOnBeyondTheBorder)
{
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(LabelVolume({ 0, 9, 0, 9, 0, 9 }, [](int i, int, int) { return i < 4 ? 1 : 0; }));
  EXPECT_EQ(split->GetBorder(), vtkLabelSplit::Closed);
  split->Update();
  EXPECT_EQ(split->GetOutput()->GetFieldData()->GetArray(Names::Border), nullptr);
  split->SetBorderToFlat();
  split->Update();
  vtkPartitionedDataSetCollection* output = split->GetOutput();
  const CollectionHeader header = ReadHeader(output);
  EXPECT_TRUE(header.FlatBorder);
  EXPECT_EQ(header.Padding, 6 + 5);
  vtkImageData* mask = BlockImage(output, 1);
  EXPECT_EQ(FrameOf(mask).Extent(), (std::array<int, 6>{ -11, 9, -11, 20, -11, 20 }));
  const auto at = [mask](int i, int j, int k) { return int(mask->GetScalarComponentAsDouble(i, j, k, 0)); };
  EXPECT_EQ(at(-5, 4, 4), 1);
  EXPECT_EQ(at(-6, 4, 4), 0);
  EXPECT_EQ(at(-5, -5, 14), 1);
  EXPECT_EQ(at(3, 4, 15), 0);
  EXPECT_EQ(at(4, 4, 4), 0);
}

TEST(FlatBorder, ParticlesSayOnWhichFacesTheyAre)
{
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(LabelVolume({ 0, 15, 0, 15, 0, 15 }, [](int i, int, int) { return i < 8 ? 1 : 0; }));
  mesher->SetBorderToFlat();
  mesher->Update();
  vtkPolyData* particles = mesher->GetParticles();
  vtkDataArray* faces = particles->GetPointData()->GetArray(Names::BorderFaces);
  vtkDataArray* numbers = particles->GetPointData()->GetArray(Names::NumberOfMaterials);
  vtkDataArray* dimensions = particles->GetPointData()->GetArray(Names::CellDimension);
  ASSERT_NE(faces, nullptr);
  for (vtkIdType n = 0; n < particles->GetNumberOfPoints(); ++n)
  {
    const int bits = int(faces->GetTuple1(n));
    const Vec3 x(particles->GetPoint(n));
    int count = 0;
    for (int f = 0; f < 6; ++f)
    {
      EXPECT_EQ((bits >> f & 1) != 0, x[f / 2] == (f % 2 == 0 ? -0.5 : 15.5));
      count += bits >> f & 1;
    }
    EXPECT_EQ(numbers->GetTuple1(n), 2) << "label 1 and the background, which the space beyond the faces is";
    const bool atSurface = std::abs(x[0] - 7.5) < 0.1;
    EXPECT_EQ(dimensions->GetTuple1(n), 3 - count - (atSurface ? 1 : 0));
    EXPECT_EQ((bits & 64) != 0, count > 0 && atSurface);
  }
}

TEST(FlatBorder, ParticlesOfAnotherBorderAreRefused)
{
  const auto volume = LabelVolume({ 0, 15, 0, 15, 0, 15 }, [](int, int, int) { return 1; });
  const Mesher flat = Meshed(volume);
  vtkNew<vtkLabelSplit> split;
  split->SetInputData(volume);
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());
  vtkNew<vtkIndicatorReconstruct> reconstruct;
  reconstruct->SetInputConnection(tighten->GetOutputPort());
  vtkNew<vtkDelaunayLabelMesh> mesh;
  mesh->SetInputData(0, flat->GetParticles());
  mesh->SetInputConnection(1, reconstruct->GetOutputPort());
  Complaints complaints(mesh);
  mesh->Update();
  EXPECT_TRUE(complaints.Say("of a flat border")) << complaints.Text;
}
