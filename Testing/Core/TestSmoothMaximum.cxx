// SPDX-License-Identifier: BSD-3-Clause
// The smooth maximum and its functions against their definitions and finite differences.
#include "AnalyticFields.h"
#include "Junction.h"
#include "SmoothMaximum.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
constexpr double Epsilon = 1e-5;

/// Four cells around a point, as the distances to their sites, shifted so that they are not zero where they meet.
SampledFields FourCells(double shift)
{
  std::vector<Field> fields;
  for (const Vec3& site : { Vec3(2, 3, 4), Vec3(20, 5, 6), Vec3(9, 21, 4), Vec3(10, 9, 22) })
  {
    fields.push_back([=](const Vec3& x) { return shift - (x - site).norm(); });
  }
  return SampledFields(MakeLattice(24, 24, 24), fields);
}

/// Central differences of a scalar field of position.
template <typename Function>
Vec3 Differences(const Function& function, const Vec3& x, double step)
{
  Vec3 gradient;
  for (int a = 0; a < 3; ++a)
  {
    Vec3 ahead = x, behind = x;
    ahead[a] += step;
    behind[a] -= step;
    gradient[a] = (function(ahead) - function(behind)) / (2 * step);
  }
  return gradient;
}
}

TEST(SmoothMaximum, IsTheMaximumAwayFromTies)
{
  const double values[4] = { -3.0, 1.25, 0.5, -2.0 };
  EXPECT_NEAR(SmoothMaximum(values, 4, Epsilon), 1.25, 1e-8);
  EXPECT_NEAR(SmoothMaximum(values, 1, Epsilon), -3.0, 0);
}

TEST(SmoothMaximum, InterpolatesTiesOfTwo)
{
  for (const double v : { -1.5, 0.0, 2.0 })
  {
    const double two[2] = { v, v };
    EXPECT_DOUBLE_EQ(SmoothMaximum(two, 2, Epsilon), v);
    const double below[4] = { v - 1, v, v, v - 3 };
    EXPECT_NEAR(SmoothMaximum(below, 4, Epsilon), v, 1e-8);
  }
}

TEST(SmoothMaximum, IsBiasedWhereThreeOrMoreAreEqual)
{
  const double values[5] = { 2, 2, 2, 2, 2 };
  for (int m = 1; m <= 5; ++m)
  {
    EXPECT_DOUBLE_EQ(SmoothMaximum(values, m, Epsilon), m * 2.0 / std::pow(2.0, m - 1));
  }
}

TEST(SmoothMaximum, HasTheDerivativesOfFiniteDifferences)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 200; ++trial)
  {
    const int count = 1 + trial % 6;
    const double epsilon = trial % 2 ? 0.3 : 0.05; // wide enough for differences to see the slopes
    std::vector<double> values(count), partials(count);
    for (double& value : values)
    {
      value = uniform(random);
    }
    SmoothMaximum(values.data(), count, epsilon, partials.data());
    for (int k = 0; k < count; ++k)
    {
      std::vector<double> ahead = values, behind = values;
      ahead[k] += 1e-6;
      behind[k] -= 1e-6;
      const double slope =
        (SmoothMaximum(ahead.data(), count, epsilon) - SmoothMaximum(behind.data(), count, epsilon)) / 2e-6;
      EXPECT_NEAR(partials[k], slope, 1e-6 * std::max(1.0, std::abs(slope)));
    }
  }
}

TEST(InsideOutside, HasTheGradientOfFiniteDifferences)
{
  const SampledFields set = FourCells(1.5);
  for (const Vec3& x : { Vec3(9.3, 8.2, 7.7), Vec3(10.4, 9.1, 9.6), Vec3(5.2, 6.3, 6.1), Vec3(12.7, 11.2, 8.4) })
  {
    for (MaterialId m = 0; m < 4; ++m)
    {
      Vec3 gradient;
      const double value = InsideOutside(*set, m, x, 0.2, &gradient);
      EXPECT_DOUBLE_EQ(value, InsideOutside(*set, m, x, 0.2));
      const auto function = [&](const Vec3& y) { return InsideOutside(*set, m, y, 0.2); };
      EXPECT_LT((gradient - Differences(function, x, 0.02)).norm(), 5e-3) << int(m) << " at " << x.transpose();
    }
  }
}

TEST(InsideOutside, IsZeroOnTheInterfaceAndOppositeBesideIt)
{
  const SampledFields set = FourCells(0.0);
  const MaterialId pair[2] = { 0, 1 };
  const Projection on = ProjectToJunction(*set, pair, 2, Vec3(11, 5, 5));
  ASSERT_TRUE(on.Converged);
  EXPECT_NEAR(InsideOutside(*set, 0, on.Position), 0, 1e-4);
  EXPECT_NEAR(InsideOutside(*set, 1, on.Position), 0, 1e-4);
  EXPECT_LT(InsideOutside(*set, 2, on.Position), -0.5);
  const Vec3 inZero = on.Position - Vec3(1, 0, 0);
  EXPECT_GT(InsideOutside(*set, 0, inZero), 0.5);
  EXPECT_NEAR(InsideOutside(*set, 0, inZero), -InsideOutside(*set, 1, inZero), 1e-6);
  // Deep inside one material the rival is the largest of all others.
  const Vec3 deep(2, 3, 3);
  EXPECT_NEAR(InsideOutside(*set, 0, deep), set->Value(0, deep) - set->Value(1, deep), 0.5);
}

TEST(InsideOutside, IsTheDifferenceToTheLargestOtherAlsoAwayFromInterfaces)
{
  // A slab between two others: in its middle the second largest changes, far from where either can win.
  const SampledFields set(MakeLattice(40, 8, 8),
    { [](const Vec3& x) { return 10 - x[0]; }, [](const Vec3& x) { return 10 - std::abs(x[0] - 20); },
      [](const Vec3& x) { return x[0] - 30; } });
  for (double x = 2; x < 37; x += 0.3)
  {
    const double other = std::max(10 - x, x - 30);
    EXPECT_NEAR(InsideOutside(*set, 1, Vec3(x, 4, 4)), set->Value(1, Vec3(x, 4, 4)) - other, 1e-4) << x;
  }
}

TEST(CellIndicator, HasTheGradientOfFiniteDifferences)
{
  const SampledFields set = FourCells(1.0);
  const MaterialId materials[4] = { 0, 1, 2, 3 };
  for (const Vec3& x : { Vec3(9.3, 8.2, 7.7), Vec3(10.4, 9.1, 9.6), Vec3(8.2, 6.3, 6.1) })
  {
    for (int count = 2; count <= 4; ++count)
    {
      Vec3 gradient;
      const double value = CellIndicator(*set, materials, count, x, 0.2, &gradient);
      EXPECT_GE(value, 0);
      const auto function = [&](const Vec3& y) { return CellIndicator(*set, materials, count, y, 0.2); };
      const double scale = std::max(1.0, gradient.norm());
      EXPECT_LT((gradient - Differences(function, x, 0.02)).norm(), 1e-2 * scale) << count << " at " << x.transpose();
    }
  }
}

TEST(CellIndicator, IsZeroOnItsCellOnlyAsFarAsTheMaximumIsNotBiased)
{
  // Where the four meet each indicator is about -10 + shift; with three equal rivals the maximum is 0.75 of that.
  const SampledFields set = FourCells(0.0);
  const MaterialId materials[4] = { 0, 1, 2, 3 };
  const Projection pair = ProjectToJunction(*set, materials, 2, Vec3(11, 5, 5));
  EXPECT_NEAR(CellIndicator(*set, materials, 2, pair.Position), 0, 1e-6);
  const Projection point = ProjectToJunction(*set, materials, 4, Vec3(10, 10, 9));
  ASSERT_TRUE(point.Converged);
  const double v = set->Value(0, point.Position);
  // The projection ends within its tolerance of the point, so the values are equal to about 1e-5, not exactly.
  EXPECT_NEAR(CellIndicator(*set, materials, 4, point.Position, 0.1), 4 * std::pow(v - 0.75 * v, 2), 0.05 * v * v);
}
