// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Vec3 Spacing(1.0, 1.5, 0.75);
const Lattice Frame = MakeLattice(24, 20, 28, Spacing, Vec3(-3, 2, 1));

std::vector<Vec3> RandomPoints(int count, double margin)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n)
  {
    Vec3 index;
    for (int a = 0; a < 3; ++a)
    {
      index[a] = margin + uniform(random) * (Frame.Dims[a] - 1 - 2 * margin);
    }
    points.push_back(Frame.Position(index[0], index[1], index[2]));
  }
  return points;
}
}

TEST(IndicatorSet, ReproducesAQuadraticWithItsDerivatives)
{
  // Catmull-Rom reproduces quadratics, so all three are exact but for the rounding of float samples.
  Mat3 q;
  q << 0.02, 0.01, -0.03, 0.01, -0.05, 0.02, -0.03, 0.02, 0.04;
  const Vec3 b(0.3, -0.2, 0.5);
  const SampledFields fields(Frame, { [&](const Vec3& x) { return 1.0 + b.dot(x) + 0.5 * x.dot(q * x); } });
  for (const Vec3& x : RandomPoints(200, 1.001))
  {
    Vec3 gradient;
    Mat3 hessian;
    const double value = fields->ValueGradientHessian(0, x, gradient, hessian);
    EXPECT_NEAR(value, 1.0 + b.dot(x) + 0.5 * x.dot(q * x), 2e-5);
    EXPECT_LT((gradient - (b + q * x)).norm(), 2e-5);
    EXPECT_LT((hessian - q).norm(), 2e-4);
    EXPECT_EQ(value, fields->Value(0, x));
  }
}

TEST(IndicatorSet, DerivativesAgreeWithFiniteDifferencesUpToTheBorder)
{
  const SampledFields fields(
    Frame, { [](const Vec3& x) { return 3.0 * std::sin(0.3 * x[0]) * std::cos(0.2 * x[1]) + 0.1 * x[2] * x[2]; } });
  const double h = 1e-2;
  for (const Vec3& x : RandomPoints(200, 0.05))
  {
    Vec3 gradient;
    fields->ValueAndGradient(0, x, gradient);
    for (int a = 0; a < 3; ++a)
    {
      const Vec3 step = h * Vec3::Unit(a);
      const double difference = (fields->Value(0, x + step) - fields->Value(0, x - step)) / (2 * h);
      EXPECT_NEAR(gradient[a], difference, 0.02) << x.transpose();
    }
  }
}

TEST(IndicatorSet, ErrorOfASmoothFieldFallsWithTheCubeOfTheGrid)
{
  const auto error = [](int n)
  {
    const double s = 16.0 / n;
    const Lattice frame = MakeLattice(n + 1, n + 1, n + 1, Vec3::Constant(s));
    const Field ball = Ball(Vec3(8.1, 7.9, 8.05), 5.0);
    const SampledFields fields(frame, { ball });
    double worst = 0;
    for (int i = 0; i < 200; ++i)
    {
      const double t = 0.1 * i, z = -1 + 2 * (i + 0.5) / 200, r = std::sqrt(1 - z * z);
      const Vec3 x = Vec3(8.1, 7.9, 8.05) + 5.0 * Vec3(r * std::cos(7 * t), r * std::sin(7 * t), z);
      worst = std::max(worst, std::abs(fields->Value(0, x) - ball(x)));
    }
    return worst;
  };
  EXPECT_LT(error(32), error(16) / 6);
  EXPECT_LT(error(64), error(32) / 6);
}

TEST(IndicatorSet, CandidatesHoldTheWinnerEverywhereAndFewOthers)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Field> sites;
  for (int n = 0; n < 40; ++n)
  {
    const Vec3 at(uniform(random) * 23, uniform(random) * 19, uniform(random) * 27);
    sites.push_back(Site(Frame.Position(at[0], at[1], at[2])));
  }
  const SampledFields fields(Frame, sites);
  double candidates = 0;
  const auto points = RandomPoints(3000, 0.0);
  for (const Vec3& x : points)
  {
    MaterialId best = 0;
    for (MaterialId m = 1; m < fields->NumberOfMaterials(); ++m)
    {
      best = fields->Value(m, x) > fields->Value(best, x) ? m : best;
    }
    EXPECT_EQ(fields->LargestMaterial(x), best);
    RankedMaterial ranked[3];
    const int count = fields->Largest(x, 3, ranked);
    ASSERT_GE(count, 1);
    EXPECT_EQ(ranked[0].Material, best);
    for (int n = 1; n < count; ++n)
    {
      EXPECT_LE(ranked[n].Value, ranked[n - 1].Value);
    }
    EXPECT_NE(fields->LargestBut(x, &best, 1).Material, best);
    if (count > 2)
    {
      EXPECT_FALSE(fields->IsBeaten(ranked[0].Material, ranked[1].Material, x));
      EXPECT_TRUE(fields->IsBeaten(ranked[1].Material, ranked[2].Material, x) || ranked[0].Value == ranked[1].Value);
    }
    candidates += fields->Candidates(x).Count;
  }
  EXPECT_LT(candidates / double(points.size()), 12);
}

TEST(IndicatorSet, BlocksMayBeCroppedShiftedAndFiner)
{
  const Lattice working = MakeLattice(30, 30, 30);
  const Field ball = Ball(Vec3(12, 13, 14), 5.0);
  const auto sample = [](const Lattice& frame, const Field& f)
  {
    std::vector<float> values;
    for (Index at = 0; at < frame.Size(); ++at)
    {
      const auto c = frame.Coordinates(at);
      values.push_back(float(std::clamp(f(frame.Position(c[0], c[1], c[2])), -4.0, 4.0)));
    }
    return values;
  };
  const Lattice finer = MakeLattice(41, 41, 41, Vec3::Constant(0.5), Vec3(2.25, 3.25, 4.25));
  const auto outside = sample(working, Not(ball)), inside = sample(finer, ball);
  const IndicatorSet set({ { -7, working, outside.data(), 4.0 }, { 3, finer, inside.data(), -4.0 } }, -7, working);
  EXPECT_EQ(set.Background(), 0);
  EXPECT_EQ(set.Value(1, Vec3(1, 1, 1)), -4.0);
  for (Index at = 0; at < working.Size(); ++at)
  {
    const auto c = working.Coordinates(at);
    const Vec3 x = working.Position(c[0], c[1], c[2]);
    if (std::abs(ball(x)) > 0.1)
    {
      ASSERT_EQ(set.Labels()[at], ball(x) > 0 ? 1 : 0) << x.transpose();
      ASSERT_EQ(set.LargestMaterial(x), ball(x) > 0 ? 1 : 0) << x.transpose();
    }
  }
}

TEST(IndicatorSet, DifferencesAreThoseOfTheValues)
{
  // Both blocks of the working lattice, one cropped (near and beyond its border), and one on a lattice of its own.
  const Lattice working = MakeLattice(30, 30, 30, Vec3(1.0, 0.75, 1.5), Vec3(1, 2, 3));
  Lattice cropped = MakeLattice(12, 14, 10, working.Spacing, working.Position(5, 6, 7));
  const Lattice finer = MakeLattice(31, 31, 31, Vec3(0.5, 0.5, 0.5), working.Position(3, 8, 4));
  const auto sample = [](const Lattice& frame, const Field& f)
  {
    std::vector<float> values;
    for (Index at = 0; at < frame.Size(); ++at)
    {
      const auto c = frame.Coordinates(at);
      values.push_back(float(f(frame.Position(c[0], c[1], c[2]))));
    }
    return values;
  };
  const Vec3 centre = working.Position(11, 13, 12);
  const auto outside = sample(working, Not(Ball(centre, 4))), first = sample(cropped, Ball(centre, 4)),
             second = sample(finer, Ball(centre, 3));
  const IndicatorSet set(
    { { 0, working, outside.data(), 9.0 }, { 1, cropped, first.data(), -4.0 }, { 2, finer, second.data(), -3.0 } }, 0,
    working);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 30);
  for (int n = 0; n < 2000; ++n)
  {
    const Vec3 x = working.Position(uniform(random), uniform(random), uniform(random));
    for (const auto& [a, b] : { std::pair(0, 1), std::pair(1, 0), std::pair(1, 2) })
    {
      Vec3 gradient, gradientA, gradientB;
      const double difference = set.Difference(MaterialId(a), MaterialId(b), x, gradient);
      const double expected =
        set.ValueAndGradient(MaterialId(a), x, gradientA) - set.ValueAndGradient(MaterialId(b), x, gradientB);
      ASSERT_NEAR(difference, expected, 2e-5) << x.transpose();
      ASSERT_LT((gradient - (gradientA - gradientB)).norm(), 2e-5) << x.transpose();
    }
  }
}

TEST(IndicatorSet, RefusesLabelsOutOfOrderAndNone)
{
  const std::vector<float> values(8, 1.0f);
  const Lattice frame = MakeLattice(2, 2, 2);
  EXPECT_THROW(IndicatorSet({ { 2, frame, values.data(), -1 }, { 1, frame, values.data(), -1 } }, 0, frame),
    std::invalid_argument);
  EXPECT_THROW(IndicatorSet({}, 0, frame), std::invalid_argument);
}
