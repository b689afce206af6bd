// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeBorder.h"

#include "AnalyticFields.h"
#include "CurveTracing.h"
#include "FeatureSize.h"
#include "Junction.h"
#include "MeshInterfaces.h"
#include "ParticleSystem.h"
#include "Relaxation.h"
#include "SurfaceSampling.h"

#include <gtest/gtest.h>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const VolumeBox Box{ Vec3(5.5, 5.5, 5.5), Vec3(25.5, 21.5, 17.5) };
const MaterialId LowX = FirstBorder, HighX = FirstBorder + 1, LowY = FirstBorder + 2, LowZ = FirstBorder + 4,
                 HighZ = FirstBorder + 5;

/// A lattice that reaches six samples beyond the box.
Lattice Around()
{
  return MakeLattice(32, 28, 24);
}

/// All of the space is material 1, or the half spaces on the two sides of x = 13.2 are 1 and 2.
SampledFields Full()
{
  return SampledFields(Around(), { [](const Vec3&) { return -3.0; }, [](const Vec3&) { return 3.0; } }, Box);
}
SampledFields Halves()
{
  return SampledFields(Around(),
    { [](const Vec3&) { return -3.0; }, [](const Vec3& x) { return 13.2 - x[0]; },
      [](const Vec3& x) { return x[0] - 13.2; } },
    Box);
}
/// A ball that reaches beyond the face of high x.
SampledFields Leaving()
{
  const Field ball = Ball(Vec3(24, 13, 11), 4.3);
  return SampledFields(Around(), { Not(ball), ball }, Box);
}

MaterialSet SetOf(std::initializer_list<MaterialId> materials)
{
  MaterialSet set;
  for (const MaterialId m : materials)
  {
    set.Insert(m);
  }
  return set;
}
}

TEST(VolumeBorder, SpaceBeyondTheFacesIsAMaterialOfItsOwn)
{
  const SampledFields fields = Full();
  EXPECT_EQ(fields->LargestMaterial(Vec3(13, 13, 13)), 1);
  EXPECT_EQ(fields->LargestMaterial(Vec3(5.5 + 1e-4, 13, 13)), 1);
  EXPECT_EQ(fields->LargestMaterial(Vec3(5.5 - 1e-4, 13, 13)), LowX);
  EXPECT_EQ(fields->LargestMaterial(Vec3(-40, 13, 13)), LowX) << "beyond the lattice too";
  EXPECT_EQ(fields->LargestMaterial(Vec3(13, 13, 60)), HighZ);
  EXPECT_EQ(fields->LabelOf(LowX), 0);
  EXPECT_EQ(fields->NumberOfMaterials(), 2) << "they are no labels of the user's";
  const Lattice lattice = Around();
  EXPECT_EQ(fields->Labels()[lattice.At(5, 12, 12)], LowX);
  EXPECT_EQ(fields->Labels()[lattice.At(6, 12, 12)], 1);
  EXPECT_EQ(fields->Labels()[lattice.At(25, 12, 12)], 1);
  EXPECT_EQ(fields->Labels()[lattice.At(26, 12, 12)], HighX);
  EXPECT_EQ(fields->Labels()[lattice.At(8, 8, 2)], LowZ);
  EXPECT_FALSE(fields->HaveInterface(0, LowX));
  EXPECT_FALSE(fields->HaveInterface(LowX, LowY));
  EXPECT_TRUE(fields->HaveInterface(1, LowX));
  EXPECT_TRUE(fields->HaveInterface(0, 1));
}

TEST(VolumeBorder, ProjectionsLieOnTheFacesToTheBit)
{
  const SampledFields fields = Halves();
  const MaterialId curve[3] = { 1, 2, LowY }, edge[3] = { 1, LowX, LowY }, corner[4] = { 1, LowX, LowY, LowZ },
                   crossing[4] = { 1, 2, LowY, HighZ };
  const Projection onCurve = ProjectToJunction(*fields, curve, 3, Vec3(12.9, 5.8, 9));
  ASSERT_TRUE(onCurve.Converged);
  EXPECT_EQ(onCurve.Position[1], 5.5);
  EXPECT_NEAR(onCurve.Position[0], 13.2, 1e-5);
  EXPECT_NEAR(std::abs(CurveTangent(*fields, curve, onCurve.Position)[2]), 1.0, 1e-6);
  const Projection onEdge = ProjectToJunction(*fields, edge, 3, Vec3(5.2, 5.9, 9.3));
  ASSERT_TRUE(onEdge.Converged);
  EXPECT_EQ(onEdge.Position, Vec3(5.5, 5.5, 9.3));
  EXPECT_EQ(ProjectToJunction(*fields, corner, 4, Vec3(5.2, 5.9, 5.3)).Position, Vec3(5.5, 5.5, 5.5));
  const Projection atCrossing = ProjectToJunction(*fields, crossing, 4, Vec3(13, 5.6, 17.3));
  EXPECT_EQ(atCrossing.Position[1], 5.5);
  EXPECT_EQ(atCrossing.Position[2], 17.5);

  Particle particle;
  ASSERT_TRUE(PutOnInterface(*fields, 1, LowX, Vec3(5.9, 9, 9), 1.0, particle));
  EXPECT_EQ(particle.Position, Vec3(5.5, 9, 9));
  EXPECT_EQ(particle.Normal, Vec3(-1, 0, 0));
  EXPECT_FALSE(PutOnInterface(*fields, 1, LowY, Vec3(14.2, 5.5, 9), 1.0, particle)) << "material 2 is there";
  EXPECT_FALSE(PutOnInterface(*fields, 1, LowX, Vec3(5.5, 5.4, 9), 1.0, particle)) << "beyond the edge of the face";
}

TEST(VolumeBorder, CurvesAreTheEdgesOfTheBoxAndWhereInterfacesMeetIt)
{
  const JunctionNetwork box = TraceJunctions(*Full(), Monitor());
  EXPECT_EQ(box.ZeroCells.size(), 8u);
  EXPECT_EQ(box.OneCells.size(), 12u);
  EXPECT_EQ(box.OpenEnds, 0);
  const JunctionNetwork halves = TraceJunctions(*Halves(), Monitor());
  EXPECT_EQ(halves.ZeroCells.size(), 8u + 4u);
  EXPECT_EQ(halves.OneCells.size(), 8u + 2u * 4u + 4u) << "four edges are cut in two, four curves are new";
  EXPECT_EQ(halves.OpenEnds, 0);
  const JunctionNetwork leaving = TraceJunctions(*Leaving(), Monitor());
  EXPECT_TRUE(leaving.ZeroCells.empty());
  ASSERT_EQ(leaving.OneCells.size(), 1u) << "none along the edges of the box, where there is background";
  EXPECT_TRUE(leaving.OneCells[0].Closed);
  const double radius = std::sqrt(4.3 * 4.3 - 1.5 * 1.5);
  for (const Vec3& x : leaving.OneCells[0].Points)
  {
    EXPECT_EQ(x[0], 25.5);
    EXPECT_NEAR((x - Vec3(25.5, 13, 11)).norm(), radius, 0.05);
  }
}

TEST(VolumeBorder, FlatFacesAreNoFineFeature)
{
  const FeatureSizes sizes = FindFeatureSizes(*Full(), Monitor());
  ASSERT_FALSE(sizes.Samples.empty());
  for (const InterfaceSample& sample : sizes.Samples)
  {
    EXPECT_GE(sample.FeatureSize, 0.5 * 12 - 1.5) << "half the thickness of the box, also at its edges";
    EXPECT_LT(sample.Curvature, 1e-3);
  }
}

TEST(VolumeBorder, NoParticleBetweenTwoThatAreOutside)
{
  for (const SampledFields& fields : { Halves(), Leaving() })
  {
    const Grid<float> lengths(Around(), 1.5f);
    const SampleResult result = SampleCells(*fields, lengths, SampleOptions(), Monitor());
    ASSERT_GT(result.Particles.size(), 50u);
    for (const Particle& p : result.Particles)
    {
      EXPECT_TRUE(fields->AnyInside(p.Materials.begin(), p.Materials.Size()));
      for (const MaterialId m : p.Materials)
      {
        EXPECT_TRUE(!IsBorder(m) || Box.Beyond(m, p.Position) == 0.0);
      }
      EXPECT_EQ(Box.Clamped(p.Position), p.Position);
    }
  }
}

TEST(VolumeBorder, MeshCallsTheSpaceBeyondBackground)
{
  const SampledFields fields = Full();
  const SampleResult samples = SampleCells(*fields, Grid<float>(Around(), 2.5f), SampleOptions(), Monitor());
  const MeshResult result = MeshInterfaces(*fields, samples.Particles, MeshOptions(), Monitor());
  EXPECT_EQ(result.WrongFaces + result.NonManifoldEdges + result.NonManifoldVertices, 0);
  double volume = 0.0;
  for (const InterfaceTriangle& t : result.Mesh.Triangles)
  {
    EXPECT_EQ(t.Materials, (std::array<MaterialId, 2>{ 1, 0 }));
    const auto at = [&](int c) -> const Vec3& { return result.Mesh.Vertices[t.Vertices[c]].Position; };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
  }
  EXPECT_NEAR(volume, 20.0 * 16 * 12, 1e-9);
  std::array<int, 3> cells{ 0, 0, 0 };
  for (const Particle& p : result.Mesh.Vertices)
  {
    EXPECT_EQ(p.Materials, SetOf({ 0, 1 }));
    ++cells[p.CellDimension];
  }
  EXPECT_EQ(cells[0], 8) << "they keep the dimension of their cell";
  EXPECT_GE(cells[1], 12);
}
