// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSets.h"

#include "TestTetrahedra.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

using namespace TestTetrahedra;

namespace
{
const NameRules AnyName = { 120, false, {} };

/// The sum of the areas' vectors.
Vec3 AreaOf(const TetraMesh& mesh, const FacePatch& patch)
{
  Vec3 area = Vec3::Zero();
  for (const TetraFace& face : patch.Faces)
  {
    const int* order = FaceCorners[face.Opposite];
    const auto& corners = mesh.Corners[face.Tetra];
    const Vec3& a = mesh.Points[corners[order[0]]];
    area += (mesh.Points[corners[order[1]]] - a).cross(mesh.Points[corners[order[2]]] - a) / 2;
  }
  return area;
}

std::map<std::string, Vec3> AreasOf(const TetraData& data, const MeshSets& sets)
{
  std::map<std::string, Vec3> areas;
  for (const FaceSet& set : sets.Faces)
  {
    Vec3 area = Vec3::Zero();
    for (const std::size_t p : set.Patches)
    {
      area += AreaOf(data.Mesh, sets.Patches[p]);
    }
    areas[set.Name] = area;
  }
  return areas;
}

void ExpectRefused(vtkUnstructuredGrid* grid, const std::string& words)
{
  try
  {
    FindSets(ReadTetrahedra(grid), AnyName);
    ADD_FAILURE() << "nothing was said of: " << words;
  }
  catch (const std::invalid_argument& problem)
  {
    EXPECT_NE(std::string(problem.what()).find(words), std::string::npos) << problem.what();
  }
}

void NameMaterials(vtkUnstructuredGrid* grid, const std::vector<std::pair<Label, std::string>>& names)
{
  std::vector<Material> materials;
  for (const auto& [label, name] : names)
  {
    materials.push_back(DefaultMaterial(label));
    materials.back().Name = name;
  }
  WriteMaterials(grid->GetFieldData(), materials, 0);
}
}

TEST(MeshSets, ReaderTurnsTetrahedraTheRightWay)
{
  const TetraData data = ReadTetrahedra(ThreeMaterials());
  ASSERT_EQ(data.Mesh.Corners.size(), 72u);
  EXPECT_EQ(data.FlatTetrahedra, 0);
  std::map<MaterialId, double> volumes;
  for (std::size_t t = 0; t < data.Mesh.Corners.size(); ++t)
  {
    const auto& c = data.Mesh.Corners[t];
    const Vec3& o = data.Mesh.Points[c[0]];
    const double volume =
      (data.Mesh.Points[c[1]] - o).cross(data.Mesh.Points[c[2]] - o).dot(data.Mesh.Points[c[3]] - o) / 6;
    EXPECT_GT(volume, 0);
    volumes[data.Mesh.Materials[t]] += volume;
  }
  ASSERT_EQ(data.Materials.size(), 4u) << "the background among them";
  EXPECT_EQ(data.Background, 0);
  EXPECT_NEAR(volumes[1], 4, 1e-12);
  EXPECT_NEAR(volumes[2], 7, 1e-12);
  EXPECT_NEAR(volumes[3], 1, 1e-12);
}

TEST(MeshSets, FacesAreThoseBetweenMaterialsAndThoseOfTheBox)
{
  const TetraData data = ReadTetrahedra(ThreeMaterials());
  const MeshSets sets = FindSets(data, AnyName);
  const auto areas = AreasOf(data, sets);
  const std::map<std::string, Vec3> expected = { { "Label_1_Label_0", Vec3(0, 0, -4) },
    { "Label_1_Label_2", Vec3(0, 0, 4) }, { "Label_2_Label_0", Vec3(-1, -1, 3) }, { "Label_2_Label_7", Vec3(1, 1, 1) },
    { "Label_7_Label_0", Vec3(1, 1, 1) }, { "border_x_min", Vec3(-6, 0, 0) }, { "border_x_max", Vec3(6, 0, 0) },
    { "border_y_min", Vec3(0, -6, 0) }, { "border_y_max", Vec3(0, 6, 0) }, { "border_z_min", Vec3(0, 0, -4) },
    { "border_z_max", Vec3(0, 0, 4) } };
  ASSERT_EQ(areas.size(), expected.size());
  for (const auto& [name, area] : expected)
  {
    ASSERT_EQ(areas.count(name), 1u) << name;
    EXPECT_LT((areas.at(name) - area).norm(), 1e-12) << name << ": " << areas.at(name).transpose();
  }
  for (const FaceSet& set : sets.Faces)
  {
    const auto points = PointsOf(sets, set, data.Mesh);
    if (set.Name == "Label_1_Label_2")
    {
      EXPECT_EQ(points.size(), 9u);
    }
    if (set.Name == "border_x_min")
    {
      EXPECT_EQ(points.size(), 12u);
    }
  }
}

TEST(MeshSets, TheBoxIsTurnedWithTheImage)
{
  const auto grid = ThreeMaterials();
  const Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Vec3 x;
    grid->GetPoint(p, x.data());
    const Vec3 turned = axes * x + Vec3(1e4, -7.3, 0.1);
    grid->GetPoints()->SetPoint(p, turned.data());
  }
  EXPECT_EQ(FindSets(ReadTetrahedra(grid), AnyName).Faces.size(), 5u) << "no sides along the world's axes";
  vtkNew<vtkDoubleArray> direction;
  direction->SetName(Names::SourceDirection);
  direction->SetNumberOfComponents(9);
  const Mat3 rows = axes.transpose(); // Eigen's order is by columns
  direction->InsertNextTuple(rows.data());
  grid->GetFieldData()->AddArray(direction);
  const TetraData data = ReadTetrahedra(grid);
  const auto areas = AreasOf(data, FindSets(data, AnyName));
  ASSERT_EQ(areas.size(), 11u);
  EXPECT_LT((areas.at("border_x_min") - axes * Vec3(-6, 0, 0)).norm(), 1e-8);
  EXPECT_LT((areas.at("border_y_max") - axes * Vec3(0, 6, 0)).norm(), 1e-8);
  EXPECT_LT((areas.at("border_z_max") - axes * Vec3(0, 0, 4)).norm(), 1e-8);
  EXPECT_LT((areas.at("Label_1_Label_2") - axes * Vec3(0, 0, 4)).norm(), 1e-8);
}

TEST(MeshSets, TheBackgroundMayBeMeshedToo)
{
  const auto grid = Box({ 3, 3, 3 }, Vec3::Zero(), [](int i, int j, int k) -> Label { return i * j * k == 1 ? 4 : 0; });
  const TetraData data = ReadTetrahedra(grid);
  const MeshSets sets = FindSets(data, AnyName);
  EXPECT_EQ(sets.Elements.size(), 2u);
  for (const FacePatch& patch : sets.Patches)
  {
    if (patch.Materials[0] != data.Background)
    {
      EXPECT_EQ(patch.Faces.size(), 12u);
      EXPECT_EQ(patch.Side, NoSide);
      for (const TetraFace& face : patch.Faces)
      {
        EXPECT_NE(data.Mesh.Materials[face.Tetra], data.Background) << "normals point out of the label";
      }
    }
  }
  EXPECT_EQ(sets.Faces.size(), 8u) << "Label_0_Label_0, Label_4_Label_0 and the sides";
}

TEST(MeshSets, NamesAreFittedAndDifferent)
{
  const auto grid = ThreeMaterials();
  const std::string longest(100, 'x');
  NameMaterials(grid, { { 0, "air" }, { 1, "Left, \"lower\" lobe" }, { 2, "left__lower__lobe" }, { 7, longest } });
  const TetraData data = ReadTetrahedra(grid);

  const MeshSets any = FindSets(data, AnyName);
  EXPECT_EQ(any.Elements[0].Name, "Left, _lower_ lobe");
  EXPECT_EQ(any.Elements[1].Name, "left__lower__lobe");
  EXPECT_EQ(any.Elements[2].Name, longest);

  const MeshSets plain = FindSets(data, { 80, true, { "LEFT__LOWER__LOBE" } });
  EXPECT_EQ(plain.Elements[0].Name, "Left___lower__lobe");
  EXPECT_EQ(plain.Elements[1].Name, "left__lower__lobe_2") << "a name that is taken, capitals or not";
  EXPECT_EQ(plain.Elements[2].Name, std::string(80, 'x'));
  std::map<std::string, int> uses;
  for (const FaceSet& set : plain.Faces)
  {
    EXPECT_LE(set.Name.size(), 80u);
    ++uses[set.Name];
  }
  EXPECT_EQ(uses.size(), plain.Faces.size());
}

TEST(MeshSets, NamesThatFallTogetherAreNumberedAndCharactersStayWhole)
{
  const auto grid = ThreeMaterials();
  NameMaterials(grid, { { 0, "_" }, { 1, "\xC3\xA4\xC3\xA4\xC3\xA4" }, { 2, "12" }, { 7, "1-2" } });
  const MeshSets any = FindSets(ReadTetrahedra(grid), { 5, false, {} });
  EXPECT_EQ(any.Elements[0].Name, "\xC3\xA4\xC3\xA4") << "five bytes have room for two letters";
  const MeshSets plain = FindSets(ReadTetrahedra(grid), { 80, true, {} });
  EXPECT_EQ(plain.Elements[0].Name, "M______");
  EXPECT_EQ(plain.Elements[1].Name, "M12");
  EXPECT_EQ(plain.Elements[2].Name, "M1_2");
}

TEST(MeshSets, PointsWithoutTetrahedronAreLeftOut)
{
  const auto grid = ThreeMaterials();
  grid->GetPoints()->InsertNextPoint(100, 100, 100);
  EXPECT_EQ(ReadTetrahedra(grid).Mesh.Points.size(), 36u);
}

TEST(MeshSets, RefusesWhatIsNoLabelledMesh)
{
  auto grid = ThreeMaterials();
  grid->GetCellData()->RemoveArray(Names::Label);
  ExpectRefused(grid, "no cell array 'Label'");

  grid = ThreeMaterials();
  vtkNew<vtkDoubleArray> halves;
  halves->SetName(Names::Label);
  halves->SetNumberOfTuples(grid->GetNumberOfCells());
  halves->FillValue(1.5);
  grid->GetCellData()->AddArray(halves);
  ExpectRefused(grid, "labels are whole numbers");

  grid = ThreeMaterials();
  grid->GetPoints()->SetPoint(3, 0, std::nan(""), 0);
  ExpectRefused(grid, "Point 3 has a coordinate that is not a number");

  grid = ThreeMaterials();
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_QUAD, 4, corners);
  grid->GetCellData()->GetArray(Names::Label)->InsertNextTuple1(1);
  ExpectRefused(grid, "Cell 72 is a vtkQuad");

  grid = ThreeMaterials();
  for (int n = 0; n < 2; ++n)
  {
    vtkIdType same[4];
    std::copy_n(grid->GetCell(0)->GetPointIds()->GetPointer(0), 4, same);
    grid->InsertNextCell(VTK_TETRA, 4, same);
    grid->GetCellData()->GetArray(Names::Label)->InsertNextTuple1(1);
  }
  ExpectRefused(grid, "More than two tetrahedra have the face");
}

TEST(MeshSets, NothingGivesNothing)
{
  const MeshSets sets = FindSets(ReadTetrahedra(vtkNew<vtkUnstructuredGrid>()), AnyName);
  EXPECT_TRUE(sets.Patches.empty() && sets.Elements.empty() && sets.Faces.empty());
}
