// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "ChordCorrection.h"
#include "ParticleSystem.h"
#include "TetraLabeling.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(40, 40, 40);
const Vec3 Centre(19.7, 20.1, 19.9);
constexpr double Radius = 13.0;

SurfaceComplex Sampled(const SampledFields& fields, float h)
{
  const std::vector<Particle> particles =
    SampleCells(*fields, Grid<float>(Frame, h), SampleOptions(), Monitor()).Particles;
  return SurfaceComplex({ particles, BuildInterface(*fields, particles).Faces });
}

double VolumeOf(MaterialId m, const SurfaceComplex& complex)
{
  double volume = 0.0;
  for (const InterfaceTriangle& t : complex.AliveTriangles())
  {
    const auto p = [&](int i) -> const Vec3& { return complex.Vertex(t.Vertices[i]).Position; };
    const double cone = (p(0) - Centre).dot((p(1) - Centre).cross(p(2) - Centre)) / 6.0;
    volume += t.Materials[0] == m ? cone : t.Materials[1] == m ? -cone : 0.0;
  }
  return volume;
}

double MeanRadiusOfCurve(const SurfaceComplex& complex)
{
  double sum = 0.0;
  Index count = 0;
  for (const Particle& p : complex.AllVertices())
  {
    if (p.CellDimension == 1)
    {
      sum += (p.Position - Centre).norm();
      ++count;
    }
  }
  return sum / double(count);
}
}

TEST(ChordCorrection, FacesCutNothingOffABall)
{
  const SampledFields fields(Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) });
  const double volume = 4.0 / 3.0 * M_PI * Radius * Radius * Radius;
  for (const float h : { 4.0f, 2.0f })
  {
    SurfaceComplex complex = Sampled(fields, h);
    const double cutOff = volume - VolumeOf(1, complex);
    ASSERT_GT(cutOff, 0.01 * volume * h / 4.0);
    EXPECT_EQ(CorrectChords(*fields, complex, 0.5), complex.NumberOfVertices());
    EXPECT_NEAR(VolumeOf(1, complex), volume, 0.08 * cutOff) << "h " << h;
    double inner = 0.0, outer = 0.0;
    for (const Particle& p : complex.AllVertices())
    {
      const double distance = (p.Position - Centre).norm() - Radius;
      inner = std::min(inner, distance);
      outer = std::max(outer, distance);
      EXPECT_NEAR(p.Residual, std::abs(distance), 0.02);
    }
    EXPECT_GT(inner, -0.01) << "all move outwards";
    EXPECT_LT(outer, 0.25 * h * h / Radius) << "by about h^2 / (12 R) times two";
  }
}

TEST(ChordCorrection, CurvesKeepTheirPlaneAndLeaveTheirChords)
{
  const SampledFields fields = HalvedBall(Frame, Centre, Radius);
  SurfaceComplex complex = Sampled(fields, 3.0f);
  const double half = 2.0 / 3.0 * M_PI * Radius * Radius * Radius;
  const double before = VolumeOf(1, complex), radius = MeanRadiusOfCurve(complex);
  CorrectChords(*fields, complex, 0.5);
  EXPECT_LT(std::abs(VolumeOf(1, complex) - half), 0.25 * std::abs(before - half));
  EXPECT_NEAR(VolumeOf(1, complex), VolumeOf(2, complex), 0.003 * half);
  // The circle's chords of length h lie h^2 / (12 R) inside it on average.
  EXPECT_NEAR(MeanRadiusOfCurve(complex) - radius, 3.0 * 3.0 / (12.0 * Radius), 0.015);
}

TEST(ChordCorrection, WhatIsFlatStays)
{
  const SampledFields fields(
    Frame, { [](const Vec3& x) { return 10.0 - x[2]; }, [](const Vec3& x) { return x[2] - 10.0; } });
  SurfaceComplex complex = Sampled(fields, 4.0f);
  ASSERT_GT(complex.NumberOfVertices(), 50);
  const std::vector<Particle> before = complex.AllVertices();
  CorrectChords(*fields, complex, 0.5);
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    EXPECT_LT((complex.Vertex(v).Position - before[v].Position).norm(), 1e-4);
  }
}

TEST(ChordCorrection, FrozenVerticesAndPoorTrianglesStay)
{
  const SampledFields fields(Frame, { Not(Ball(Centre, Radius)), Ball(Centre, Radius) });
  SurfaceComplex complex = Sampled(fields, 4.0f);
  complex.Freeze(3);
  const Vec3 frozen = complex.Vertex(3).Position;
  std::vector<double> ratios;
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    ratios.push_back(complex.Ratio(t));
  }
  CorrectChords(*fields, complex, 0.99);
  EXPECT_EQ(complex.Vertex(3).Position, frozen);
  for (Index t = 0; t < complex.NumberOfTriangles(); ++t)
  {
    EXPECT_GE(complex.Ratio(t), std::min(0.99, ratios[t]));
  }
}

TEST(ChordCorrection, NoSheetMovesIntoAThinPart)
{
  // A shell one voxel thick: the faces of its inner side would bulge into it by a third of that, those of its outer
  // side bulge outwards.
  const auto shell = [](const Vec3& x) { return 0.5 - std::abs((x - Centre).norm() - Radius); };
  const SampledFields fields(
    Frame, { [](const Vec3& x) { return (x - Centre).norm() - Radius - 0.5; }, shell, Ball(Centre, Radius - 0.5) });
  SurfaceComplex complex = Sampled(fields, 7.0f);
  std::vector<Vec3> before;
  for (const Particle& p : complex.AllVertices())
  {
    before.push_back(p.Position);
  }
  CorrectChords(*fields, complex, 0.5);
  std::array<double, 2> sums{}, counts{};
  for (Index v = 0; v < complex.NumberOfVertices(); ++v)
  {
    const int side = complex.Vertex(v).Materials.Contains(2);
    sums[side] += (complex.Vertex(v).Position - before[v]).norm();
    counts[side] += 1.0;
  }
  EXPECT_GT(sums[0] / counts[0], 0.15);
  EXPECT_LT(sums[1] / counts[1], 0.05);
}
