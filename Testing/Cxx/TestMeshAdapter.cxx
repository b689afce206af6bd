// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAdapter.h"

#include "Core/MeshChecks.h"
#include "LabelMeshNames.h"
#include "TestMeshes.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataAssembly.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

using namespace TestMeshes;

namespace
{
const std::vector<Label> SomeLabels = { -3, 0, 5, 5000000000 };

std::vector<Particle> SomeParticles()
{
  std::vector<Particle> particles(3);
  particles[0].Position = Vec3(1.5, 2.25, 3.125);
  particles[0].CellDimension = 1;
  particles[0].TargetLength = 0.75;
  particles[0].Residual = 1e-5;
  for (const MaterialId m : { 0, 1, 3 })
  {
    particles[0].Materials.Insert(m);
  }
  particles[1] = particles[0];
  particles[1].Position = Vec3(-4, 0.1, 7);
  particles[2].Position = Vec3(2, 3, 4);
  particles[2].Normal = Vec3(0.6, 0, 0.8);
  particles[2].TargetLength = 1.5;
  particles[2].Materials.Insert(2);
  particles[2].Materials.Insert(1);
  return particles;
}

MeshCheck CheckOf(vtkPolyData* mesh)
{
  const InterfaceData data = ReadInterface(mesh);
  return CheckMesh(data.Points, data.Triangles, int(data.Materials.size()), data.Sets);
}

std::array<Label, 2> PairOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkDataArray* pairs = mesh->GetCellData()->GetArray(Names::BoundaryLabels);
  return { Label(pairs->GetComponent(cell, 0)), Label(pairs->GetComponent(cell, 1)) };
}
}

TEST(MeshAdapter, ParticlesRoundTrip)
{
  const CollectionHeader header = HeaderWith(OrientedFrame({ -3, 9, 4, 12, 0, 7 }, true), SomeLabels, 0);
  const std::vector<Particle> particles = SomeParticles();
  vtkNew<vtkPolyData> data;
  ParticlesToPolyData(particles, header, data);
  EXPECT_EQ(data->GetNumberOfVerts(), 3);
  EXPECT_EQ(data->GetPointData()->GetArray(Names::Materials)->GetNumberOfComponents(), 8);
  EXPECT_EQ(data->GetPointData()->GetArray(Names::Materials)->GetComponent(0, 2), 5e9);
  EXPECT_EQ(data->GetPointData()->GetArray(Names::Materials)->GetComponent(0, 7), 5e9) << "the rest repeats the last";
  EXPECT_EQ(data->GetPointData()->GetArray(Names::CellDimension)->GetDataType(), VTK_UNSIGNED_CHAR);
  Vec3 world;
  data->GetPoint(0, world.data());
  EXPECT_LT((world - header.Source.LocalToWorld(particles[0].Position)).norm(), 1e-12);
  EXPECT_EQ(ReadMaterials(data->GetFieldData()).size(), 4u);

  const std::vector<Particle> back = ParticlesFromPolyData(data, header);
  ASSERT_EQ(back.size(), particles.size());
  for (std::size_t i = 0; i < back.size(); ++i)
  {
    EXPECT_LT((back[i].Position - particles[i].Position).norm(), 1e-12);
    EXPECT_LT((back[i].Normal - particles[i].Normal).norm(), 1e-14);
    EXPECT_EQ(back[i].TargetLength, particles[i].TargetLength);
    EXPECT_EQ(back[i].Residual, particles[i].Residual);
    EXPECT_EQ(back[i].CellDimension, particles[i].CellDimension);
    EXPECT_TRUE(back[i].Materials == particles[i].Materials);
  }
}

TEST(MeshAdapter, ParticlesSayWhatIsMissing)
{
  const CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), SomeLabels, 0);
  vtkNew<vtkPolyData> data;
  ParticlesToPolyData(SomeParticles(), header, data);
  const CollectionHeader other = HeaderWith(header.Source, { 0, 5 }, 0);
  EXPECT_THROW(ParticlesFromPolyData(data, other), std::invalid_argument) << "label -3 is unknown";
  data->GetPointData()->RemoveArray(Names::TargetLength);
  try
  {
    ParticlesFromPolyData(data, header);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("TargetLength"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("Particle Sample Cells"), std::string::npos);
  }
}

TEST(MeshAdapter, EmptyKeepsItsArrays)
{
  const CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), SomeLabels, 0);
  vtkNew<vtkPolyData> particles, curves, mesh;
  ParticlesToPolyData({}, header, particles);
  CurvesToPolyData({}, {}, header, curves);
  InterfaceToPolyData({}, header, mesh);
  EXPECT_TRUE(ParticlesFromPolyData(particles, header).empty());
  EXPECT_TRUE(particles->GetPointData()->HasArray(Names::Residual));
  EXPECT_TRUE(curves->GetCellData()->HasArray(Names::Materials));
  EXPECT_TRUE(mesh->GetCellData()->HasArray(Names::BoundaryLabels));
  EXPECT_TRUE(mesh->GetPointData()->HasArray(Names::CellDimension));
  vtkNew<vtkPartitionedDataSetCollection> surfaces;
  SurfacesOfMaterials(mesh, surfaces);
  EXPECT_EQ(surfaces->GetNumberOfPartitionedDataSets(), 3u);
}

TEST(MeshAdapter, Curves)
{
  const CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), SomeLabels, 0);
  Curve loop;
  loop.Particles = { 1, 2, 0, 1 };
  loop.Materials = { 0, 1, 3 };
  Curve line;
  line.Particles = { 2, 1 };
  line.Materials = { 1, 2, 3 };
  vtkNew<vtkPolyData> data;
  CurvesToPolyData({ loop, line }, SomeParticles(), header, data);
  EXPECT_EQ(data->GetNumberOfLines(), 2);
  EXPECT_EQ(data->GetNumberOfPoints(), 3) << "shared particles are shared points";
  EXPECT_EQ(data->GetCellData()->GetArray(Names::Materials)->GetComponent(0, 0), -3);
  EXPECT_EQ(data->GetCellData()->GetArray(Names::Materials)->GetComponent(1, 2), 5e9);
}

TEST(MeshAdapter, InterfaceKeepsItsContractInEveryFrame)
{
  for (const bool mirrored : { false, true })
  {
    // The background's label 0 stands between those of the boxes.
    const CollectionHeader header = HeaderWith(OrientedFrame({ -2, 9, 0, 9, 0, 9 }, mirrored), { -3, 0, 5 }, 0);
    for (const bool turned : { false, true })
    {
      InterfaceMesh mesh = TwoBoxes(2, 0, 1);
      if (turned) // the same mesh, its pairs read backwards
      {
        for (InterfaceTriangle& t : mesh.Triangles)
        {
          std::swap(t.Vertices[0], t.Vertices[1]);
          std::swap(t.Materials[0], t.Materials[1]);
        }
      }
      vtkNew<vtkPolyData> data;
      InterfaceToPolyData(mesh, header, data);
      const MeshCheck check = CheckOf(data);
      EXPECT_NEAR(check.Materials[2].Volume, 1.0, 1e-12) << "mirrored " << mirrored << ", turned " << turned;
      EXPECT_NEAR(check.Materials[0].Volume, 2.0, 1e-12);
      EXPECT_NEAR(check.Materials[1].Volume, -3.0, 1e-12);
      EXPECT_TRUE(check.Materials[0].Oriented() && check.Materials[0].EdgeManifold());
      EXPECT_EQ(check.WrongFaces, 0);
      for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
      {
        const std::array<Label, 2> pair = PairOf(data, c);
        EXPECT_TRUE(pair[1] == 0 || (pair[0] != 0 && pair[0] < pair[1]));
      }
    }
  }
}

TEST(MeshAdapter, SurfacesOfMaterials)
{
  CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, true), { 0, 4, 7, 9 }, 0);
  header.Materials[1].Name = "left box";
  header.Materials[1].Color = Vec3(0.25, 0.5, 0.75);
  vtkNew<vtkPolyData> data;
  InterfaceToPolyData(TwoBoxes(1, 2, 0), header, data);
  vtkNew<vtkPartitionedDataSetCollection> surfaces;
  SurfacesOfMaterials(data, surfaces);
  ASSERT_EQ(surfaces->GetNumberOfPartitionedDataSets(), 3u);
  EXPECT_STREQ(surfaces->GetDataAssembly()->GetRootNodeName(), Names::SurfacesRoot);
  EXPECT_STREQ(surfaces->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "left box");
  EXPECT_STREQ(surfaces->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "Label_7");
  std::set<std::array<double, 3>> positions;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> x;
    data->GetPoint(i, x.data());
    positions.insert(x);
  }
  const Label labels[2] = { 4, 7 };
  for (unsigned int n = 0; n < 2; ++n)
  {
    vtkPolyData* surface = vtkPolyData::SafeDownCast(surfaces->GetPartition(n, 0));
    EXPECT_EQ(surface->GetFieldData()->GetArray(Names::Label)->GetComponent(0, 0), labels[n]);
    EXPECT_EQ(surface->GetNumberOfPolys(), 12);
    EXPECT_EQ(surface->GetNumberOfPoints(), 8);
    EXPECT_TRUE(surface->GetCellData()->HasArray(Names::RadiusRatio));
    EXPECT_EQ(surface->GetPointData()->GetArray(Names::CellDimension)->GetNumberOfTuples(), 8);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      std::array<double, 3> x;
      surface->GetPoint(i, x.data());
      EXPECT_EQ(positions.count(x), 1u) << "shared positions agree in every bit";
    }
    for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c)
    {
      EXPECT_EQ(PairOf(surface, c)[0], labels[n]) << "own label first";
    }
    const InterfaceData own = ReadInterface(surface);
    const MeshCheck check = CheckOf(surface);
    for (std::size_t m = 0; m < own.Materials.size(); ++m)
    {
      if (own.Materials[m].Label == labels[n])
      {
        EXPECT_TRUE(check.Materials[m].EdgeManifold() && check.Materials[m].Oriented());
        EXPECT_NEAR(check.Materials[m].Volume, n + 1.0, 1e-12) << "outward";
      }
    }
  }
  vtkPolyData* lost = vtkPolyData::SafeDownCast(surfaces->GetPartition(2, 0));
  ASSERT_NE(lost, nullptr);
  EXPECT_EQ(lost->GetNumberOfCells(), 0);
  EXPECT_TRUE(lost->GetCellData()->HasArray(Names::BoundaryLabels));
  EXPECT_NEAR(
    vtkPolyData::SafeDownCast(surfaces->GetPartition(0, 0))->GetFieldData()->GetArray(Names::Color)->GetComponent(0, 2),
    0.75, 0.0);
}

TEST(MeshAdapter, SurfacesThatTouchInAVertexAreTakenApart)
{
  // Two tetrahedra of label 4 with one corner in common.
  const CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), { 0, 4 }, 0);
  InterfaceMesh pinched;
  for (const Vec3& x :
    { Vec3(2, 2, 2), Vec3(3, 2, 2), Vec3(2, 3, 2), Vec3(2, 2, 3), Vec3(1, 2, 2), Vec3(2, 1, 2), Vec3(2, 2, 1) })
  {
    Particle p;
    p.Position = x;
    p.Materials.Insert(0);
    p.Materials.Insert(1);
    pinched.Vertices.push_back(p);
  }
  for (const auto& c : { std::array<Index, 3>{ 0, 2, 1 }, { 0, 3, 2 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 4, 5 },
         { 0, 5, 6 }, { 0, 6, 4 }, { 4, 6, 5 } })
  {
    pinched.Triangles.push_back({ c, { 1, 0 } });
  }
  vtkNew<vtkPolyData> mesh;
  InterfaceToPolyData(pinched, header, mesh);
  EXPECT_EQ(CheckOf(mesh).Materials[1].NonManifoldVertices, 1);
  vtkNew<vtkPartitionedDataSetCollection> surfaces;
  SurfacesOfMaterials(mesh, surfaces);
  vtkPolyData* surface = vtkPolyData::SafeDownCast(surfaces->GetPartition(0, 0));
  EXPECT_EQ(surface->GetNumberOfPoints(), 8);
  EXPECT_EQ(surface->GetPointData()->GetArray(Names::CellDimension)->GetNumberOfTuples(), 8);
  const MeshCheck check = CheckOf(surface);
  EXPECT_EQ(check.Materials[1].NonManifoldVertices, 0);
  EXPECT_EQ(check.Materials[1].Components, 2);
  EXPECT_TRUE(check.Materials[1].EdgeManifold() && check.Materials[1].Oriented());
  std::array<double, 3> first, last;
  surface->GetPoint(0, first.data());
  surface->GetPoint(7, last.data());
  EXPECT_EQ(first, last) << "the copy stands where the vertex stands";
}

TEST(MeshAdapter, ReadInterfaceRefusesOtherMeshes)
{
  const CollectionHeader header = HeaderWith(OrientedFrame({ 0, 9, 0, 9, 0, 9 }, false), { 0, 4, 7 }, 0);
  vtkNew<vtkPolyData> mesh;
  InterfaceToPolyData(TwoBoxes(1, 2, 0), header, mesh);
  mesh->GetCellData()->RemoveArray(Names::BoundaryLabels);
  EXPECT_THROW(ReadInterface(mesh), std::invalid_argument);
  vtkNew<vtkPolyData> particles;
  ParticlesToPolyData(SomeParticles(), HeaderWith(header.Source, SomeLabels, 0), particles);
  EXPECT_THROW(ReadInterface(particles), std::invalid_argument);
}
