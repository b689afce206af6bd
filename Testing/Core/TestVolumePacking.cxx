// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "ParticleSystem.h"
#include "TriangleDistance.h"
#include "VolumePacking.h"

#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(40, 40, 40);
const Vec3 Centre(19.6, 20.1, 19.8);
constexpr double Radius = 14.0;

SampledFields BallFields()
{
  return SampledFields(Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) });
}

SampleResult Packed(const SampledFields& fields, double h, double gradation, double most = 0.0)
{
  SampleOptions options;
  options.Volume = true;
  options.Packing.Gradation = gradation;
  options.Packing.MaximumLength = most;
  return SampleCells(*fields, Grid<float>(Frame, float(h)), options, Monitor());
}
}

TEST(VolumePacking, LengthsGrowFromTheInterface)
{
  const SampledFields fields = BallFields();
  PackOptions options;
  options.Gradation = 0.25;
  const Grid<float> h = VolumeLengths(*fields, Grid<float>(Frame, 2.0f), options);
  for (Index at = 0; at < Frame.Size(); ++at)
  {
    const auto c = Frame.Coordinates(at);
    const double depth = Radius - (Frame.Position(c[0], c[1], c[2]) - Centre).norm();
    if (depth > 0)
    {
      // The chamfer distance is up to 13 % too long.
      EXPECT_GE(h.Values[at], 2.0 + 0.25 * depth - 0.2);
      EXPECT_LE(h.Values[at], 2.0 + 0.25 * 1.13 * depth + 0.2);
    }
  }
  options.MaximumLength = 3.0;
  EXPECT_NEAR(VolumeLengths(*fields, Grid<float>(Frame, 2.0f), options).Trilinear(Centre), 3.0, 1e-5);
  options.MaterialMaximumLength = { 0.0, 2.5 };
  EXPECT_NEAR(VolumeLengths(*fields, Grid<float>(Frame, 2.0f), options).Trilinear(Centre), 2.5, 1e-5);
  options.Gradation = 0.0;
  EXPECT_THROW(VolumeLengths(*fields, Grid<float>(Frame, 2.0f), options), std::invalid_argument);
}

TEST(VolumePacking, FillsABallEvenly)
{
  const SampledFields fields = BallFields();
  constexpr double h = 2.5;
  const SampleResult result = Packed(fields, h, 1.0, h);
  const Index first = Index(result.Particles.size()) - result.CellCounts[3];
  ASSERT_GT(result.CellCounts[3], 100);
  for (Index n = first; n < Index(result.Particles.size()); ++n)
  {
    const Particle& p = result.Particles[n];
    EXPECT_EQ(p.CellDimension, 3);
    ASSERT_EQ(p.Materials.Size(), 1);
    EXPECT_EQ(p.Materials[0], 1) << "the background stays empty";
    EXPECT_LT((p.Position - Centre).norm(), Radius - 0.4 * h);
    for (Index m = 0; m < n; ++m)
    {
      ASSERT_GE((p.Position - result.Particles[m].Position).norm(), 0.6 * h);
    }
  }
  // No hole: a body-centred lattice with a mean edge of h leaves nothing farther than 0.62 h from its points.
  Index far = 0, inside = 0;
  for (Index at = 0; at < Frame.Size(); ++at)
  {
    const auto c = Frame.Coordinates(at);
    const Vec3 x = Frame.Position(c[0], c[1], c[2]);
    if ((x - Centre).norm() < Radius)
    {
      double nearest = 1e30;
      for (const Particle& p : result.Particles)
      {
        nearest = std::min(nearest, (p.Position - x).norm());
      }
      ++inside;
      far += nearest > 0.8 * h;
      EXPECT_LE(nearest, 1.0 * h);
    }
  }
  EXPECT_LT(double(far), 0.01 * double(inside));
}

TEST(VolumePacking, LeavesTheOtherParticlesAlone)
{
  const SampledFields fields = BallFields();
  const SampleResult bare = SampleCells(*fields, Grid<float>(Frame, 2.0f), SampleOptions(), Monitor());
  const SampleResult packed = Packed(fields, 2.0, 0.4);
  EXPECT_EQ(bare.CellCounts[3], 0);
  ASSERT_EQ(bare.Particles.size(), packed.Particles.size() - packed.CellCounts[3]);
  for (std::size_t n = 0; n < bare.Particles.size(); ++n)
  {
    ASSERT_TRUE(bare.Particles[n].Position == packed.Particles[n].Position);
  }
}

TEST(VolumePacking, GrowsInwards)
{
  const SampledFields fields = BallFields();
  const Index slow = Packed(fields, 1.5, 0.1).CellCounts[3], fast = Packed(fields, 1.5, 0.8).CellCounts[3];
  EXPECT_LT(fast, 0.5 * double(slow));
}

TEST(VolumePacking, SameBitsForAnyNumberOfThreads)
{
  const SampledFields fields = BallFields();
  std::vector<Particle> particles[2];
  for (int n = 0; n < 2; ++n)
  {
    vtkSMPTools::Initialize(n + 1);
    particles[n] = Packed(fields, 1.7, 0.3).Particles;
  }
  vtkSMPTools::Initialize();
  ASSERT_EQ(particles[0].size(), particles[1].size());
  for (std::size_t n = 0; n < particles[0].size(); ++n)
  {
    ASSERT_TRUE(particles[0][n].Position == particles[1][n].Position);
  }
}

TEST(TriangleDistance, OfPointsAboveBesideAndBelow)
{
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  EXPECT_DOUBLE_EQ(SquaredDistance(Vec3(1, 1, 2), a, b, c), 4.0) << "above the face";
  EXPECT_DOUBLE_EQ(SquaredDistance(Vec3(2, -3, 4), a, b, c), 25.0) << "beside an edge";
  EXPECT_DOUBLE_EQ(SquaredDistance(Vec3(-2, -3, -6), a, b, c), 49.0) << "beyond a corner";
  EXPECT_DOUBLE_EQ(SquaredDistance(Vec3(4, 3, 0), a, b, c), 2.4 * 2.4) << "in the plane";
  const std::vector<Vec3> points{ a, b, c };
  const std::vector<TriangleCorners> triangles{ { 0, 1, 2 } };
  const TriangleDistance distance(points, triangles);
  EXPECT_TRUE(distance.IsNearer(Vec3(1, 1, 2), 2.01));
  EXPECT_FALSE(distance.IsNearer(Vec3(1, 1, 2), 1.99));
}
