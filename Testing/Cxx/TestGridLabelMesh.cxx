// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGridLabelMesh.h"

#include "Core/MeshChecks.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "TestMeshes.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace TestMeshes;

namespace
{
struct Checked
{
  InterfaceData Mesh;
  MeshCheck Check;

  explicit Checked(vtkPolyData* mesh)
    : Mesh(ReadInterface(mesh))
    , Check(CheckMesh(Mesh.Points, Mesh.Triangles, int(Mesh.Materials.size()), Mesh.Sets))
  {
  }
  Index TrianglesBetween(Label a, Label b) const
  {
    Index count = 0;
    for (const PairCheck& pair : this->Check.Pairs)
    {
      const Label x = this->Mesh.Materials[pair.Materials[0]].Label, y = this->Mesh.Materials[pair.Materials[1]].Label;
      count += (x == a && y == b) || (x == b && y == a) ? pair.Quality.Triangles : 0;
    }
    return count;
  }
};

/// A block 1 and a block 2 side by side; 3 touches the border of the volume.
vtkSmartPointer<vtkImageData> Blocks()
{
  return LabelVolume({ -4, 11, 3, 14, 0, 11 },
    [](int i, int j, int k)
    {
      const bool within = j >= 6 && j <= 11 && k >= 3 && k <= 8;
      return k == 0 && j > 9 ? 3 : within && i >= 0 && i < 4 ? 1 : within && i >= 4 && i < 8 ? 2 : 0;
    });
}
}

TEST(GridLabelMesh, ClosesEverySurfaceInEveryFrame)
{
  for (const bool mirrored : { false, true })
  {
    const auto volume = Blocks();
    SetFrame(volume, OrientedFrame(FrameOf(volume).Extent(), mirrored));
    vtkNew<vtkGridLabelMesh> grid;
    grid->SetInputData(volume);
    grid->SetSmoothingIterations(0);
    grid->Update();
    const Checked result(grid->GetOutput());
    ASSERT_EQ(result.Mesh.Materials.size(), 4u);
    const double voxel = 0.5 * 0.7 * 1.1;
    // Marching cubes bevel the edges and corners of a box of voxels.
    EXPECT_NEAR(result.Check.Materials[1].Volume, 4 * 6 * 6 * voxel, 0.1 * 4 * 6 * 6 * voxel);
    EXPECT_NEAR(result.Check.Materials[2].Volume, 4 * 6 * 6 * voxel, 0.1 * 4 * 6 * 6 * voxel);
    for (const MaterialCheck& material : result.Check.Materials)
    {
      EXPECT_TRUE(material.Closed());
      EXPECT_TRUE(material.Oriented());
    }
    EXPECT_EQ(result.Check.DuplicateTriangles, 0);
    EXPECT_EQ(result.Check.SameMaterialTriangles, 0);
    EXPECT_EQ(result.Check.WrongFaces, 0);
    EXPECT_GE(result.TrianglesBetween(1, 2), 2 * 5 * 5);
    // Positions: the shared face of 1 and 2 lies at index 3.5 along x.
    const GridFrame frame = FrameOf(volume);
    for (const InterfaceTriangle& t : result.Mesh.Triangles)
    {
      if (t.Materials == std::array<MaterialId, 2>{ 1, 2 })
      {
        EXPECT_NEAR(frame.ToIndex(result.Mesh.Points[t.Vertices[0]])[0], 3.5, 1e-6);
      }
    }
  }
}

TEST(GridLabelMesh, TwoSpheres)
{
  vtkNew<vtkGridLabelMesh> grid;
  grid->SetInputData(TwoSpheres(48));
  grid->Update();
  const Checked full(grid->GetOutput());
  grid->SetTargetTriangles(1500);
  grid->Update();
  const Checked decimated(grid->GetOutput());
  EXPECT_NEAR(double(decimated.Check.Quality.Triangles), 1500, 30);
  EXPECT_GT(full.Check.Quality.Triangles, 4000);
  for (const Checked* result : { &full, &decimated })
  {
    for (const MaterialCheck& material : result->Check.Materials)
    {
      // Cracks of vtkQuadricDecimation are a known flaw of the baseline.
      const Index most = result == &full ? 0 : material.Quality.Triangles / 50;
      EXPECT_LE(material.OpenEdges, most);
      EXPECT_LE(material.MisorientedEdges, most);
    }
    const double sphere = 4.0 / 3.0 * M_PI * std::pow(34 * 48.0 / 128, 3);
    EXPECT_NEAR(result->Check.Materials[1].Volume, sphere, 0.04 * sphere);
    EXPECT_GT(result->TrianglesBetween(1, 2), 20);
    EXPECT_GT(result->TrianglesBetween(0, 1), result->TrianglesBetween(1, 2));
  }
  vtkPartitionedDataSetCollection* surfaces = grid->GetSurfaces();
  ASSERT_EQ(surfaces->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_GT(vtkPolyData::SafeDownCast(surfaces->GetPartition(0, 0))->GetNumberOfPolys(), 500);
}

TEST(GridLabelMesh, ChosenLabelsAndBackground)
{
  vtkNew<vtkGridLabelMesh> grid;
  grid->SetInputData(Blocks());
  grid->AddLabel(2);
  grid->AddLabel(77);
  grid->Update();
  const Checked chosen(grid->GetOutput());
  ASSERT_EQ(chosen.Mesh.Materials.size(), 3u);
  EXPECT_EQ(chosen.Mesh.Materials[2].Label, 77) << "asked for, listed, without a triangle";
  EXPECT_EQ(chosen.Check.Pairs.size(), 1u);

  grid->ClearLabels();
  grid->SetBackgroundLabel(2);
  grid->Update();
  const Checked other(grid->GetOutput());
  EXPECT_GT(other.TrianglesBetween(0, 2), 0);
  EXPECT_EQ(other.Mesh.Background, 2);
  EXPECT_EQ(grid->GetSurfaces()->GetNumberOfPartitionedDataSets(), 3u) << "0 is a material like others now";
}

TEST(GridLabelMesh, CellData)
{
  const auto volume = LabelVolume({ 0, 8, 0, 8, 0, 8 }, [](int, int, int) { return 0; });
  vtkNew<vtkFloatArray> labels;
  labels->SetName("InCells");
  labels->SetNumberOfValues(volume->GetNumberOfCells());
  labels->FillValue(5);
  volume->GetCellData()->SetScalars(labels);
  vtkNew<vtkGridLabelMesh> grid;
  grid->SetInputData(volume);
  grid->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "InCells");
  grid->SetSmoothingIterations(0);
  grid->Update();
  // Eight cells along each axis, all of label 5: the surface is where the cells end.
  double bounds[6];
  grid->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 0.0, 1e-6);
  EXPECT_NEAR(bounds[1], 8.0, 1e-6);
}

TEST(GridLabelMesh, Complains)
{
  vtkNew<vtkGridLabelMesh> grid;
  Complaints complaints(grid);
  grid->SetInputData(LabelVolume({ 0, 5, 0, 5, 0, 5 }, [](int, int, int) { return 0; }));
  grid->Update();
  EXPECT_TRUE(complaints.Say("nothing to mesh")) << complaints.Text;
  grid->SetInputData(LabelVolume({ 0, 5, 0, 5, 0, 0 }, [](int, int, int) { return 1; }));
  grid->Update();
  EXPECT_TRUE(complaints.Say("6 x 6 x 1")) << complaints.Text;
  EXPECT_EQ(complaints.Count, 2);
  EXPECT_EQ(grid->GetOutput()->GetNumberOfCells(), 0);
}
