// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "ParticleSystem.h"
#include "TetraLabeling.h"
#include "VolumeCorrection.h"

#include <gtest/gtest.h>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(40, 40, 40);
const Vec3 Centre(19.7, 20.1, 19.9);
constexpr double Radius = 13.0;
constexpr double BallVolume = 4.0 / 3.0 * M_PI * Radius * Radius * Radius;
constexpr double WantedError = 5e-4; // relative, of each volume

SurfaceComplex Sampled(const SampledFields& fields, float h)
{
  const std::vector<Particle> particles =
    SampleCells(*fields, Grid<float>(Frame, h), SampleOptions(), Monitor()).Particles;
  return SurfaceComplex({ particles, BuildInterface(*fields, particles).Faces });
}
}

TEST(VolumeCorrection, ABallOfFewFacesGrowsEvenly)
{
  const SampledFields fields(Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) });
  SurfaceComplex complex = Sampled(fields, 6.0f);
  ASSERT_LT(EnclosedVolumes(complex, 2)[1], 0.97 * BallVolume);
  const double error = CorrectVolumes(*fields, { 0.0, BallVolume }, 0.5, complex);
  EXPECT_LT(error, WantedError);
  EXPECT_NEAR(EnclosedVolumes(complex, 2)[1], BallVolume, WantedError * BallVolume);
  double least = Radius, most = 0.0;
  for (const Particle& p : complex.AllVertices())
  {
    const double distance = (p.Position - Centre).norm() - Radius;
    least = std::min(least, distance);
    most = std::max(most, distance);
    EXPECT_NEAR(p.Residual, distance, 0.05);
  }
  EXPECT_GT(least, 0.0);
  EXPECT_LT(most, 1.2 * least) << "everywhere by nearly the same";
}

TEST(VolumeCorrection, WhatOneMaterialGainsItsNeighbourLoses)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  SurfaceComplex complex = Sampled(fields, 3.0f);
  const std::vector<double> before = EnclosedVolumes(complex, 3);
  const double moved = 0.04 * before[1];
  EXPECT_LT(CorrectVolumes(*fields, { 0.0, before[1] + moved, before[2] - moved }, 0.5, complex), WantedError);
  const std::vector<double> after = EnclosedVolumes(complex, 3);
  EXPECT_NEAR(after[1], before[1] + moved, WantedError * before[1]);
  EXPECT_NEAR(after[2], before[2] - moved, WantedError * before[2]);
  // The least motion: the wall goes down by nearly the same everywhere, and more than the caps.
  for (const Particle& p : complex.AllVertices())
  {
    const double fromAxis = (p.Position - Centre).head<2>().norm();
    if (p.CellDimension == 2 && !p.Materials.Contains(0) && fromAxis < 0.7 * Radius)
    {
      EXPECT_LT(p.Position[2] - Centre[2], -0.15);
      EXPECT_GT(p.Position[2] - Centre[2], -0.5);
    }
  }
}

TEST(VolumeCorrection, WhatEndsInTheBoxStaysInItsFaces)
{
  const VolumeBox box{ Vec3(7.5, 7.5, 7.5), Vec3(31.5, 31.5, 31.5) };
  const double side = 24.0;
  const auto above = [](const Vec3& x) { return x[2] - 20.2 + 0.1 * std::sin(0.3 * x[0]); };
  const SampledFields fields(Frame, { [](const Vec3&) { return -50.0; }, above, Not(above) }, box);
  SurfaceComplex complex = Sampled(fields, 4.0f);
  const std::vector<double> before = EnclosedVolumes(complex, 3);
  ASSERT_NEAR(before[1] + before[2], side * side * side, 1e-6);
  const double moved = 0.03 * before[1];
  EXPECT_LT(CorrectVolumes(*fields, { 0.0, before[1] + moved, before[2] - moved }, 0.5, complex), WantedError);
  const std::vector<double> after = EnclosedVolumes(complex, 3);
  EXPECT_NEAR(after[1], before[1] + moved, WantedError * before[1]);
  EXPECT_NEAR(after[1] + after[2], side * side * side, 1e-9 * side * side * side);
  for (const Particle& p : complex.AllVertices())
  {
    for (const MaterialId m : p.Materials)
    {
      EXPECT_TRUE(!IsBorder(m) || box.Beyond(m, p.Position) == 0.0);
    }
  }
}

TEST(VolumeCorrection, WhatIsFrozenOrMostlyMissingStays)
{
  const SampledFields fields(Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) });
  SurfaceComplex complex = Sampled(fields, 5.0f);
  const std::vector<Particle> before = complex.AllVertices();
  CorrectVolumes(*fields, { 0.0, 2.5 * BallVolume }, 0.5, complex);
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    ASSERT_EQ(complex.Vertex(v).Position, before[v].Position) << "no move makes up for a missing part";
  }
  complex.Freeze(3);
  EXPECT_LT(CorrectVolumes(*fields, { 0.0, BallVolume }, 0.5, complex), WantedError);
  EXPECT_EQ(complex.Vertex(3).Position, before[3].Position);
}
