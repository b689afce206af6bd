// SPDX-License-Identifier: BSD-3-Clause
// What readers of other makers find in the files is the business of Testing/Python/TestSimulationFormats.py.
#include "vtkAbaqusLabelMeshWriter.h"
#include "vtkGmshLabelMeshWriter.h"

#include "TestMeshes.h"
#include "TestTetrahedra.h"

#include <vtkErrorCode.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace TestTetrahedra;
using TestMeshes::Complaints;

namespace
{
namespace fs = std::filesystem;

class TetrahedraWriters : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string folder = (fs::temp_directory_path() / "labelmesh-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    this->Folder = folder;
  }
  void TearDown() override
  {
    std::error_code ignored;
    fs::remove_all(this->Folder, ignored);
  }
  std::string File(const std::string& name) const { return (this->Folder / name).string(); }
  std::size_t NumberOfFiles() const
  {
    return std::size_t(std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator()));
  }

  fs::path Folder;
};

std::string Contents(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

int Write(vtkTetrahedraWriter* writer, vtkUnstructuredGrid* grid, const std::string& file)
{
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  return writer->Write();
}
}

TEST_F(TetrahedraWriters, AbaqusNumbersReadBackWithinTwentyCharacters)
{
  const auto grid = ThreeMaterials();
  const double values[] = { 1.0 / 3, -1.0 / 3, -12345.678901234567, -1.2345678901234567e-5, 1.2345678901234567e-300,
    -0.0012345678901234567, 1e22, -5e-324 };
  for (vtkIdType n = 0; n < 8; ++n)
  {
    grid->GetPoints()->SetPoint(n, values[n], 0.1, 7);
  }
  vtkNew<vtkAbaqusLabelMeshWriter> writer;
  const Complaints complaints(writer);
  ASSERT_EQ(Write(writer, grid, this->File("numbers.inp")), 1) << complaints.Text;
  std::istringstream text(Contents(this->File("numbers.inp")));
  std::string line;
  while (line.rfind("*NODE", 0) != 0)
  {
    ASSERT_TRUE(std::getline(text, line));
  }
  for (const double value : values)
  {
    std::getline(text, line);
    const std::size_t first = line.find(',') + 1;
    const std::string number = line.substr(first, line.find(',', first) - first);
    EXPECT_LE(number.size(), 20u) << number;
    // Four characters of an exponent, sign, point and 0.00 leave at least twelve digits.
    EXPECT_NEAR(std::strtod(number.c_str(), nullptr), value, 1e-12 * std::abs(value)) << number;
    EXPECT_EQ(line.substr(line.find(',', first)), ",0.1,7");
  }
  EXPECT_NE(Contents(this->File("numbers.inp")).find(",0.3333333333333333,"), std::string::npos) << "all digits";
}

TEST_F(TetrahedraWriters, SameBytesAgain)
{
  vtkNew<vtkAbaqusLabelMeshWriter> abaqus;
  vtkNew<vtkGmshLabelMeshWriter> gmsh;
  const auto grid = ThreeMaterials();
  for (vtkTetrahedraWriter* writer :
    { static_cast<vtkTetrahedraWriter*>(abaqus), static_cast<vtkTetrahedraWriter*>(gmsh) })
  {
    ASSERT_EQ(Write(writer, grid, this->File("one")), 1);
    ASSERT_EQ(Write(writer, grid, this->File("two")), 1);
    EXPECT_FALSE(Contents(this->File("one")).empty());
    EXPECT_EQ(Contents(this->File("one")), Contents(this->File("two")));
  }
  EXPECT_EQ(this->NumberOfFiles(), 2u) << "nothing else is left";
}

TEST_F(TetrahedraWriters, WhatFailsLeavesTheOldFileAndSaysWhy)
{
  std::ofstream(this->File("old.msh")) << "old";
  vtkNew<vtkGmshLabelMeshWriter> writer;
  Complaints complaints(writer);
  const auto grid = ThreeMaterials();
  grid->GetCellData()->RemoveArray(Names::Label);
  EXPECT_EQ(Write(writer, grid, this->File("old.msh")), 0);
  EXPECT_TRUE(complaints.Say("no cell array 'Label'")) << complaints.Text;
  EXPECT_EQ(Contents(this->File("old.msh")), "old");

  EXPECT_EQ(Write(writer, ThreeMaterials(), this->File("nowhere/new.msh")), 0);
  EXPECT_TRUE(complaints.Say("nowhere/new.msh': No such file or directory")) << complaints.Text;
  EXPECT_EQ(writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::CannotOpenFileError));

  EXPECT_EQ(Write(writer, vtkNew<vtkUnstructuredGrid>(), this->File("old.msh")), 0);
  EXPECT_TRUE(complaints.Say("no tetrahedra to write")) << complaints.Text;
  writer->SetFileName(nullptr);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(complaints.Say("Set FileName")) << complaints.Text;
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(TetrahedraWriters, AFileThatCannotTakeItsPlaceIsSaid)
{
  // A folder cannot be replaced by a file: the last step fails, and nothing stays behind.
  fs::create_directories(this->Folder / "taken" / "by");
  vtkNew<vtkAbaqusLabelMeshWriter> writer;
  Complaints complaints(writer);
  EXPECT_EQ(Write(writer, ThreeMaterials(), this->File("taken")), 0);
  EXPECT_TRUE(complaints.Say("Cannot write '" + this->File("taken"))) << complaints.Text;
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(TetrahedraWriters, FlatTetrahedraAreWarnedOf)
{
  const auto grid = ThreeMaterials();
  const vtkIdType corners[4] = { 0, 1, 3, 4 };
  grid->InsertNextCell(VTK_TETRA, 4, corners);
  grid->GetCellData()->GetArray(Names::Label)->InsertNextTuple1(1);
  vtkNew<vtkAbaqusLabelMeshWriter> writer;
  Complaints complaints(writer);
  EXPECT_EQ(Write(writer, grid, this->File("flat.inp")), 1);
  EXPECT_TRUE(complaints.Say("1 of 73 tetrahedra have no volume")) << complaints.Text;
}

TEST_F(TetrahedraWriters, NamesStayInTheirComment)
{
  const auto grid = ThreeMaterials();
  std::vector<Material> materials = { DefaultMaterial(0), DefaultMaterial(1) };
  materials[1].Name = "one\n*NODE\n1,2,3";
  WriteMaterials(grid->GetFieldData(), materials, 0);
  vtkNew<vtkAbaqusLabelMeshWriter> writer;
  ASSERT_EQ(Write(writer, grid, this->File("names.inp")), 1);
  EXPECT_EQ(Contents(this->File("names.inp")).find("\n*NODE\n"), std::string::npos);
}
