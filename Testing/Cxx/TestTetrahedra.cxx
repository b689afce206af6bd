// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra inside the materials: from handmade surfaces, and through all stages.
#include "Core/ConstrainedDelaunay.h"
#include "Core/TetraFaces.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestCollections.h"
#include "TestMeshes.h"
#include "TetraReader.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkLabelMeshReport.h"
#include "vtkLabelMesher.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVariant.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace TestMeshes;

namespace
{
constexpr int Faces[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

/// What a grid of tetrahedra holds.
struct Tetrahedra
{
  std::vector<Vec3> Points;
  std::vector<std::array<Index, 4>> Corners;
  std::vector<Label> Labels;
  std::vector<double> Ratios;

  explicit Tetrahedra(vtkUnstructuredGrid* grid)
  {
    this->Points.resize(grid->GetNumberOfPoints());
    for (std::size_t p = 0; p < this->Points.size(); ++p)
    {
      grid->GetPoint(vtkIdType(p), this->Points[p].data());
    }
    for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t)
    {
      EXPECT_EQ(grid->GetCellType(t), VTK_TETRA);
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      grid->GetCellPoints(t, count, ids);
      this->Corners.push_back({ ids[0], ids[1], ids[2], ids[3] });
      this->Labels.push_back(Label(grid->GetCellData()->GetArray(Names::Label)->GetComponent(t, 0)));
      this->Ratios.push_back(grid->GetCellData()->GetArray(Names::RadiusRatio)->GetComponent(t, 0));
    }
  }
  double Volume(std::size_t t) const
  {
    const auto& c = this->Corners[t];
    const Vec3& a = this->Points[c[0]];
    return (this->Points[c[1]] - a).cross(this->Points[c[2]] - a).dot(this->Points[c[3]] - a) / 6.0;
  }
  std::map<Label, double> Volumes() const
  {
    std::map<Label, double> volumes;
    for (std::size_t t = 0; t < this->Corners.size(); ++t)
    {
      volumes[this->Labels[t]] += this->Volume(t);
    }
    return volumes;
  }
  double MeanRatio() const
  {
    double sum = 0;
    for (const double ratio : this->Ratios)
    {
      sum += ratio;
    }
    return sum / double(this->Ratios.size());
  }
  Index Slivers() const
  {
    return std::count_if(this->Ratios.begin(), this->Ratios.end(), [](double r) { return r < 0.1; });
  }
};

std::map<Label, double> EnclosedVolumes(const InterfaceData& data)
{
  std::map<Label, double> volumes;
  for (const InterfaceTriangle& t : data.Triangles)
  {
    const double signedVolume =
      data.Points[t.Vertices[0]].dot(data.Points[t.Vertices[1]].cross(data.Points[t.Vertices[2]])) / 6.0;
    volumes[data.Materials[t.Materials[0]].Label] += signedVolume;
    volumes[data.Materials[t.Materials[1]].Label] -= signedVolume;
  }
  volumes.erase(data.Background);
  return volumes;
}

/// Positively oriented, as large as what the surfaces enclose, faces between labels the interface and nothing else.
void ExpectConforming(vtkUnstructuredGrid* grid, vtkPolyData* interface)
{
  const Tetrahedra tets(grid);
  const InterfaceData data = ReadInterface(interface);
  ASSERT_GE(tets.Points.size(), data.Points.size());
  for (std::size_t p = 0; p < data.Points.size(); ++p)
  {
    ASSERT_TRUE(tets.Points[p] == data.Points[p]);
  }
  // By its corners in ascending order: the labels on the side that sees them in an even order, and on the other.
  std::map<std::array<Index, 3>, std::array<Label, 2>> sides;
  const auto add = [&](const std::array<Index, 3>& face, Label label)
  {
    std::array<Index, 3> key = face;
    std::sort(key.begin(), key.end());
    const auto at = std::min_element(face.begin(), face.end()) - face.begin();
    const bool even = face[(at + 1) % 3] == key[1];
    auto& entry = sides.try_emplace(key, std::array<Label, 2>{ data.Background, data.Background }).first->second;
    EXPECT_EQ(entry[even], data.Background) << "two tetrahedra on one side of a face";
    entry[even] = label;
  };
  for (std::size_t t = 0; t < tets.Corners.size(); ++t)
  {
    ASSERT_GT(tets.Volume(t), 0.0);
    ASSERT_NE(tets.Labels[t], data.Background);
    for (const auto& face : Faces)
    {
      const auto& c = tets.Corners[t];
      add({ c[face[0]], c[face[1]], c[face[2]] }, tets.Labels[t]);
    }
  }
  std::map<std::array<Index, 3>, std::array<Label, 2>> wanted;
  for (const InterfaceTriangle& t : data.Triangles)
  {
    std::array<Index, 3> key = t.Vertices;
    std::sort(key.begin(), key.end());
    const auto at = std::min_element(t.Vertices.begin(), t.Vertices.end()) - t.Vertices.begin();
    const bool even = t.Vertices[(at + 1) % 3] == key[1];
    auto& entry = wanted[key];
    entry[even] = data.Materials[t.Materials[0]].Label;
    entry[!even] = data.Materials[t.Materials[1]].Label;
  }
  for (auto face = sides.begin(); face != sides.end();)
  {
    face = face->second[0] == face->second[1] ? sides.erase(face) : std::next(face);
  }
  EXPECT_TRUE(sides == wanted);
  const std::map<Label, double> volumes = tets.Volumes(), enclosed = EnclosedVolumes(data);
  ASSERT_EQ(volumes.size(), enclosed.size());
  for (const auto& [label, volume] : enclosed)
  {
    EXPECT_NEAR(volumes.at(label), volume, 1e-9 * volume);
  }
}

constexpr int Improved = 10; // passes

vtkSmartPointer<vtkLabelMesher> Filled(
  vtkImageData* volume, int mode = vtkDelaunayLabelMesh::Packed, int rounds = 0, int improvePasses = Improved)
{
  auto mesher = vtkSmartPointer<vtkLabelMesher>::New();
  mesher->SetInputData(volume);
  mesher->SetTetrahedra(mode);
  mesher->SetRefinementRounds(rounds);
  mesher->SetTetraImprovePasses(improvePasses);
  mesher->Update();
  return mesher;
}

bool SameBits(vtkDataArray* a, vtkDataArray* b)
{
  const auto bytes = [](vtkDataArray* array)
  {
    const char* data = static_cast<const char*>(array->GetVoidPointer(0));
    return std::string(data, data + array->GetNumberOfValues() * array->GetDataTypeSize());
  };
  return bytes(a) == bytes(b);
}
}

TEST(Tetrahedra, RadiusRatio)
{
  const double s = std::sqrt(0.5);
  const Vec3 a(1, 0, -s), b(-1, 0, -s), c(0, 1, s), d(0, -1, s);
  EXPECT_NEAR(TetraRadiusRatio(a, b, c, d), -1.0, 1e-12) << "regular, inside out";
  EXPECT_NEAR(TetraRadiusRatio(b, a, c, d), 1.0, 1e-12);
  // The corner of a cube: r_in = (3 - sqrt 3) / 6, r_circ = sqrt 3 / 2.
  EXPECT_NEAR(TetraRadiusRatio(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()),
    (3.0 - std::sqrt(3.0)) / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(TetraRadiusRatio(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3(1, 1, 0)), 0.0) << "flat";
}

TEST(Tetrahedra, FillTwoBoxesExactly)
{
  const InterfaceMesh boxes = TwoBoxes(1, 2, 0);
  const std::vector<InnerPoint> inside = { { Vec3(0.5, 0.5, 0.5), 0.5 }, { Vec3(2.0, 0.5, 0.5), 0.5 },
    { Vec3(1.5, 0.5, 0.01), 0.5 } };
  const TetraResult result = FillWithTetrahedra(boxes, 0, inside, TetraOptions());
  EXPECT_EQ(result.LeftOut, 1) << "the last one is too near to the interface";
  EXPECT_EQ(result.Mesh.SurfacePoints, 12);
  EXPECT_EQ(result.Mesh.Points.size(), 14u + std::size_t(result.Added));
  std::map<MaterialId, double> volumes;
  std::set<std::array<Index, 3>> faces;
  for (std::size_t t = 0; t < result.Mesh.Corners.size(); ++t)
  {
    const auto& c = result.Mesh.Corners[t];
    const Vec3& a = result.Mesh.Points[c[0]];
    const double volume =
      (result.Mesh.Points[c[1]] - a).cross(result.Mesh.Points[c[2]] - a).dot(result.Mesh.Points[c[3]] - a) / 6.0;
    EXPECT_GT(volume, 0.0);
    volumes[result.Mesh.Materials[t]] += volume;
    for (const auto& face : Faces)
    {
      std::array<Index, 3> key = { c[face[0]], c[face[1]], c[face[2]] };
      std::sort(key.begin(), key.end());
      faces.insert(key);
    }
  }
  ASSERT_EQ(volumes.size(), 2u);
  EXPECT_NEAR(volumes[1], 1.0, 1e-12);
  EXPECT_NEAR(volumes[2], 2.0, 1e-12);
  for (const InterfaceTriangle& t : boxes.Triangles)
  {
    std::array<Index, 3> key = t.Vertices;
    std::sort(key.begin(), key.end());
    EXPECT_EQ(faces.count(key), 1u);
  }
}

TEST(Tetrahedra, FailInWords)
{
  InterfaceMesh boxes = TwoBoxes(1, 2, 0);
  boxes.Vertices[0].Position = Vec3(2.2, 0.6, 0.7); // through the other walls
  try
  {
    FillWithTetrahedra(boxes, 0, {}, TetraOptions());
    FAIL() << "surfaces that cut each other were filled";
  }
  catch (const std::runtime_error& problem)
  {
    EXPECT_NE(std::string(problem.what()).find("cut each other"), std::string::npos) << problem.what();
  }
  InterfaceMesh wrong = TwoBoxes(1, 2, 0);
  wrong.Triangles[0].Materials = { 2, 1 };
  EXPECT_THROW(FillWithTetrahedra(wrong, 0, {}, TetraOptions()), std::runtime_error) << "labels contradict each other";
  EXPECT_TRUE(FillWithTetrahedra(InterfaceMesh(), 0, {}, TetraOptions()).Mesh.Corners.empty());
}

TEST(Tetrahedra, KeepTheTrianglesWhereTheyFail)
{
  // Four particles of a ball on a circle through its middle, but for rounding: in some turns of the circle their
  // tetrahedron has a volume, but none that can be computed.
  const GridFrame source({ 0, 19, 0, 19, 0, 19 }, Vec3::Zero(), Vec3::Ones(), Mat3::Identity());
  const Vec3 centre(9.3, 9.6, 9.7);
  const double radius = 6.0;
  const auto indicators =
    TestCollections::MakeCollection(source, 6, TestCollections::BallFields(centre, radius), Names::Indicator);
  int failures = 0;
  for (int turn = 0; turn < 40; ++turn)
  {
    const Mat3 frame = Eigen::AngleAxisd(0.1 + 0.07 * turn, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    std::vector<Particle> particles(4);
    for (int n = 0; n < 4; ++n)
    {
      Particle& p = particles[n];
      p.Normal = (n % 2 == 0 ? -1.0 : 1.0) * frame.col(n / 2);
      p.Position = centre + radius * p.Normal;
      p.TargetLength = 8.0;
      p.Materials.Insert(0);
      p.Materials.Insert(1);
    }
    vtkNew<vtkPolyData> points;
    ParticlesToPolyData(particles, ReadHeader(indicators), points);
    vtkNew<vtkDelaunayLabelMesh> mesher;
    mesher->SetInputData(0, points);
    mesher->SetInputData(1, indicators);
    mesher->SetRepairRounds(0);
    mesher->SetImprovePasses(0);
    mesher->SetRepairBelow(0.0);
    mesher->ChordCorrectionOff();
    mesher->SetTetrahedraToTetGen();
    const TestCollections::Listener listener(mesher);
    mesher->Update();
    EXPECT_TRUE(listener.Errors.empty()) << listener.Errors;
    const std::string failure = mesher->GetTetrahedraFailure();
    if (!failure.empty())
    {
      ++failures;
      EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 4);
      EXPECT_EQ(mesher->GetTetrahedraOutput()->GetNumberOfCells(), 0);
      EXPECT_NE(listener.Warnings.find(failure), std::string::npos) << listener.Warnings;
      mesher->SetTetrahedraToOff();
      mesher->Update();
      EXPECT_TRUE(std::string(mesher->GetTetrahedraFailure()).empty()) << "of the update before";
    }
  }
  EXPECT_GT(failures, 0);
}

TEST(Tetrahedra, OfTwoSpheres)
{
  // The rows of the paper's table 3.
  const auto volume = TwoSpheres(64);
  const auto mesher = Filled(volume, vtkDelaunayLabelMesh::Packed, 0, 0);
  ExpectConforming(mesher->GetTetrahedraOutput(), mesher->GetOutput());
  const Tetrahedra packed(mesher->GetTetrahedraOutput());
  EXPECT_GE(packed.MeanRatio(), 0.78);
  EXPECT_LT(double(packed.Slivers()), 0.004 * double(packed.Ratios.size()));
  EXPECT_EQ(mesher->GetTetrahedraOutput()->GetFieldData()->GetAbstractArray(Names::MaterialNames)->GetNumberOfTuples(),
    mesher->GetOutput()->GetFieldData()->GetAbstractArray(Names::MaterialNames)->GetNumberOfTuples());

  const auto refined = Filled(volume, vtkDelaunayLabelMesh::Packed, 2, 0);
  ExpectConforming(refined->GetTetrahedraOutput(), refined->GetOutput());
  const Tetrahedra twice(refined->GetTetrahedraOutput());
  EXPECT_LT(double(twice.Slivers()), 0.2 * double(packed.Slivers()));

  const auto byTetGen = Filled(volume, vtkDelaunayLabelMesh::TetGen, 0, 0);
  ExpectConforming(byTetGen->GetTetrahedraOutput(), byTetGen->GetOutput());
  EXPECT_LT(byTetGen->GetParticles()->GetNumberOfPoints(), mesher->GetParticles()->GetNumberOfPoints())
    << "TetGen needs no particles inside";
}

TEST(Tetrahedra, AreImprovedToSimulationQuality)
{
  const auto volume = TwoSpheres(64);
  for (const int mode : { vtkDelaunayLabelMesh::Packed, vtkDelaunayLabelMesh::TetGen })
  {
    const auto mesher = Filled(volume, mode);
    ExpectConforming(mesher->GetTetrahedraOutput(), mesher->GetOutput());
    const Tetrahedra tets(mesher->GetTetrahedraOutput());
    EXPECT_GE(*std::min_element(tets.Ratios.begin(), tets.Ratios.end()), 0.25);
    EXPECT_GE(tets.MeanRatio(), mode == vtkDelaunayLabelMesh::Packed ? 0.8 : 0.7);
    double least = 180.0, most = 0.0;
    for (const auto& c : tets.Corners)
    {
      const auto angles = DihedralAngles(tets.Points[c[0]], tets.Points[c[1]], tets.Points[c[2]], tets.Points[c[3]]);
      least = std::min(least, *std::min_element(angles.begin(), angles.end()));
      most = std::max(most, *std::max_element(angles.begin(), angles.end()));
    }
    EXPECT_GE(least, 12.0);
    EXPECT_LE(most, 155.0);
  }
}

TEST(Tetrahedra, AreReported)
{
  const auto mesher = Filled(TwoSpheres(40));
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputData(0, mesher->GetOutput());
  report->Update();
  EXPECT_EQ(report->GetTetrahedraOutput()->GetNumberOfRows(), 0) << "without tetrahedra";
  report->SetInputData(5, mesher->GetTetrahedraOutput());
  report->Update();
  const Tetrahedra tets(mesher->GetTetrahedraOutput());
  vtkTable* table = report->GetTetrahedraOutput();
  const auto total = [table](const char* name) { return table->GetFieldData()->GetArray(name)->GetComponent(0, 0); };
  EXPECT_EQ(total("Tetrahedra"), double(tets.Corners.size()));
  EXPECT_EQ(total("TurnedOver"), 0.0);
  EXPECT_EQ(total("Slivers"), double(tets.Slivers()));
  EXPECT_NEAR(total("MeanRadiusRatio"), tets.MeanRatio(), 1e-9);
  EXPECT_NEAR(total("MinRadiusRatio"), *std::min_element(tets.Ratios.begin(), tets.Ratios.end()), 1e-9);
  vtkNew<vtkUnstructuredGrid> bare;
  bare->ShallowCopy(mesher->GetTetrahedraOutput());
  bare->GetCellData()->Initialize();
  const TestCollections::Listener listener(report);
  report->SetInputData(5, bare);
  report->Update();
  EXPECT_NE(listener.Errors.find("no cell array 'Label'"), std::string::npos) << listener.Errors;
  report->SetInputData(5, mesher->GetTetrahedraOutput());
  report->Update();
  // The volumes are those that the report finds for the surfaces.
  vtkTable* surfaces = report->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows() + 1, surfaces->GetNumberOfRows());
  double count = 0.0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(table->GetValueByName(row, "Label"), surfaces->GetValueByName(row + 1, "Label"));
    EXPECT_EQ(table->GetValueByName(row, "Name"), surfaces->GetValueByName(row + 1, "Name"));
    const double volume = surfaces->GetValueByName(row + 1, "Volume").ToDouble();
    EXPECT_NEAR(table->GetValueByName(row, "Volume").ToDouble(), volume, 1e-9 * volume);
    count += table->GetValueByName(row, "Tetrahedra").ToDouble();
  }
  EXPECT_EQ(count, total("Tetrahedra"));
  vtkTable* dihedrals = report->GetDihedralsOutput();
  ASSERT_EQ(dihedrals->GetNumberOfRows(), 18);
  double angles = 0.0;
  for (vtkIdType bin = 0; bin < 18; ++bin)
  {
    const double all = dihedrals->GetValueByName(bin, "Angles").ToDouble();
    angles += all;
    EXPECT_EQ(dihedrals->GetValueByName(bin, "From").ToDouble(), 10.0 * double(bin));
    EXPECT_EQ(
      dihedrals->GetValueByName(bin, "Angles_1").ToDouble() + dihedrals->GetValueByName(bin, "Angles_2").ToDouble(),
      all);
  }
  EXPECT_EQ(angles, 6.0 * total("Tetrahedra"));
  vtkTable* ratios = report->GetRadiusRatiosOutput();
  ASSERT_EQ(ratios->GetNumberOfRows(), 50);
  double cells[2] = { 0.0, 0.0 }, means[2] = { 0.0, 0.0 };
  const char* const columns[] = { "Triangles", "Tetrahedra" };
  for (vtkIdType bin = 0; bin < 50; ++bin)
  {
    const double middle = ratios->GetValueByName(bin, Names::BinExtents).ToDouble();
    EXPECT_NEAR(middle, 0.01 + 0.02 * double(bin), 1e-12);
    for (int c = 0; c < 2; ++c)
    {
      const double here = ratios->GetValueByName(bin, columns[c]).ToDouble();
      cells[c] += here;
      means[c] += here * middle;
    }
  }
  EXPECT_EQ(cells[0], double(mesher->GetOutput()->GetNumberOfCells()));
  EXPECT_EQ(cells[1], total("Tetrahedra"));
  // Half a bin at most is lost where ratios are counted by bins.
  EXPECT_NEAR(means[0] / cells[0], surfaces->GetFieldData()->GetArray("MeanRadiusRatio")->GetComponent(0, 0), 0.01);
  EXPECT_NEAR(means[1] / cells[1], total("MeanRadiusRatio"), 0.01);
}

TEST(Tetrahedra, LeaveTheSurfaceAsItIs)
{
  const auto volume = TwoSpheres(40);
  vtkNew<vtkLabelMesher> bare;
  bare->SetInputData(volume);
  bare->Update();
  const auto filled = Filled(volume);
  EXPECT_EQ(bare->GetTetrahedraOutput()->GetNumberOfCells(), 0);
  EXPECT_TRUE(bare->GetTetrahedraOutput()->GetCellData()->HasArray(Names::Label)) << "typed, if empty";
  EXPECT_TRUE(SameBits(bare->GetOutput()->GetPoints()->GetData(), filled->GetOutput()->GetPoints()->GetData()));
  EXPECT_TRUE(SameBits(
    bare->GetOutput()->GetPolys()->GetConnectivityArray(), filled->GetOutput()->GetPolys()->GetConnectivityArray()));
}

TEST(Tetrahedra, FillAFlatBoxExactly)
{
  // Two halves of a full box that is oriented, anisotropic and mirrored.
  const std::array<int, 6> extent{ 3, 14, -2, 9, 0, 15 };
  const auto volume = LabelVolume(extent, [](int, int, int k) { return k < 8 ? 1 : 2; });
  const GridFrame frame = OrientedFrame(extent, true);
  volume->SetSpacing(frame.Spacing().data());
  volume->SetOrigin(frame.Origin().data());
  double direction[9];
  for (int i = 0; i < 9; ++i)
  {
    direction[i] = frame.Direction()(i / 3, i % 3);
  }
  volume->SetDirectionMatrix(direction);
  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(volume);
  mesher->SetBorderToFlat();
  mesher->SetTetrahedraToPacked();
  mesher->SetVolumeMaximumLength(1.5);
  mesher->Update();
  ExpectConforming(mesher->GetTetrahedraOutput(), mesher->GetOutput());
  const Tetrahedra tets(mesher->GetTetrahedraOutput());
  double sum = 0;
  for (const auto& [label, part] : tets.Volumes())
  {
    sum += part;
  }
  const double box = 12 * 12 * 16 * frame.Spacing().prod();
  EXPECT_NEAR(sum, box, 1e-9 * box);
  // Sets for all six sides of the turned box.
  const TetraData data = ReadTetrahedra(mesher->GetTetrahedraOutput());
  std::map<int, double> sides;
  for (const FacePatch& patch : FindPatches(data.Mesh, data.Background, data.Axes))
  {
    for (const TetraFace& face : patch.Faces)
    {
      const auto& c = data.Mesh.Corners[face.Tetra];
      const auto& n = LabelMesh::FaceCorners[face.Opposite];
      const Vec3& a = data.Mesh.Points[c[n[0]]];
      sides[patch.Side] += 0.5 * (data.Mesh.Points[c[n[1]]] - a).cross(data.Mesh.Points[c[n[2]]] - a).norm();
    }
  }
  const Vec3 size = frame.Spacing().cwiseProduct(Vec3(12, 12, 16));
  for (int side = 0; side < 6; ++side)
  {
    EXPECT_NEAR(sides[side] * size[side / 2], box, 1e-9 * box) << side;
  }
}

TEST(Tetrahedra, SameBitsForAnyNumberOfThreads)
{
  vtkSmartPointer<vtkLabelMesher> meshers[2];
  for (int n = 0; n < 2; ++n)
  {
    vtkSMPTools::Initialize(n + 1);
    meshers[n] = Filled(TwoSpheres(40), vtkDelaunayLabelMesh::Packed, 1);
  }
  vtkSMPTools::Initialize();
  vtkUnstructuredGrid *one = meshers[0]->GetTetrahedraOutput(), *two = meshers[1]->GetTetrahedraOutput();
  ASSERT_GT(one->GetNumberOfCells(), 0);
  EXPECT_TRUE(SameBits(one->GetPoints()->GetData(), two->GetPoints()->GetData()));
  EXPECT_TRUE(SameBits(one->GetCells()->GetConnectivityArray(), two->GetCells()->GetConnectivityArray()));
  EXPECT_TRUE(SameBits(one->GetCellData()->GetArray(Names::Label), two->GetCellData()->GetArray(Names::Label)));
}

TEST(Tetrahedra, PropertiesReachTheStages)
{
  vtkNew<vtkLabelMesher> mesher;
  EXPECT_EQ(mesher->GetTetrahedra(), vtkDelaunayLabelMesh::Off);
  EXPECT_EQ(mesher->GetVolumeGradation(), 0.4);
  mesher->SetTetrahedraToTetGen();
  EXPECT_EQ(mesher->GetTetrahedra(), vtkDelaunayLabelMesh::TetGen);
  mesher->SetMinimumDihedral(10.0);
  mesher->SetRadiusEdgeRatio(1.6);
  EXPECT_EQ(mesher->GetMinimumDihedral(), 10.0);
  EXPECT_EQ(mesher->GetRadiusEdgeRatio(), 1.6);
  EXPECT_EQ(mesher->GetTetraImprovePasses(), 10);
  EXPECT_TRUE(mesher->GetSlideSurface());
  mesher->SetSlideSurface(false);
  EXPECT_FALSE(mesher->GetSlideSurface());
  mesher->SetTetraImprovePasses(3);
  EXPECT_EQ(mesher->GetTetraImprovePasses(), 3);
  mesher->SetVolumeMaximumLength(5.0);
  mesher->SetMaterialVolumeMaximumLength(2, 3.0);
  EXPECT_EQ(mesher->GetVolumeMaximumLength(), 5.0);
  EXPECT_EQ(mesher->GetMaterialVolumeMaximumLength(2), 3.0);
  const vtkMTimeType before = mesher->GetMTime();
  mesher->ClearMaterialVolumeMaximumLengths();
  EXPECT_GT(mesher->GetMTime(), before);
  EXPECT_EQ(mesher->GetMaterialVolumeMaximumLength(2), 0.0);
}
