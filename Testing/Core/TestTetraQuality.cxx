// SPDX-License-Identifier: BSD-3-Clause
#include "TetraQuality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace LabelMesh;

namespace
{
using Corners = std::array<Vec3, 4>;

const Corners Regular = { Vec3(1, -1, -1), Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(-1, -1, 1) };
const Corners CubeCorner = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1) };

double Quality(const Corners& x)
{
  return TetraQuality(x[0], x[1], x[2], x[3]);
}

/// Tetrahedra by chance, all positively oriented.
std::vector<Corners> ByChance(int count)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  std::vector<Corners> all;
  while (int(all.size()) < count)
  {
    Corners x;
    for (Vec3& corner : x)
    {
      corner = Vec3(coordinate(random), coordinate(random), coordinate(random));
    }
    const double volume = SignedVolume(x[0], x[1], x[2], x[3]);
    if (std::abs(volume) > 1e-3)
    {
      if (volume < 0.0)
      {
        std::swap(x[0], x[1]);
      }
      all.push_back(x);
    }
  }
  return all;
}
}

TEST(TetraQuality, OfKnownTetrahedra)
{
  const auto& [a, b, c, d] = Regular;
  EXPECT_NEAR(SignedVolume(a, b, c, d), 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(TetraRadiusRatio(a, b, c, d), 1.0, 1e-14);
  for (const double angle : DihedralAngles(a, b, c, d))
  {
    EXPECT_NEAR(angle, std::acos(1.0 / 3.0) * 180.0 / M_PI, 1e-12);
  }
  const auto& [o, x, y, z] = CubeCorner;
  EXPECT_NEAR(SignedVolume(o, x, y, z), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(TetraRadiusRatio(o, x, y, z), std::sqrt(3.0) - 1.0, 1e-14);
  const auto angles = DihedralAngles(o, x, y, z);
  for (int edge = 0; edge < 6; ++edge)
  {
    const double expected = edge < 3 ? 90.0 : std::acos(1.0 / std::sqrt(3.0)) * 180.0 / M_PI;
    EXPECT_NEAR(angles[edge], expected, 1e-12);
  }
}

TEST(TetraQuality, SeesFlatAndTurnedOver)
{
  const auto& [o, x, y, z] = CubeCorner;
  EXPECT_LT(TetraQuality(x, o, y, z), 0.0);
  EXPECT_EQ(TetraQuality(o, x, y, Vec3(1, 1, 0)), 0.0);
  EXPECT_EQ(TetraRadiusRatio(o, x, y, Vec3(1, 1, 0)), 0.0);
  EXPECT_EQ(TetraRadiusRatio(x, o, y, z), -TetraRadiusRatio(o, x, y, z));
  EXPECT_EQ(TetraQuality(o, x, 2 * x, z), -1.0) << "a face without area";
  EXPECT_EQ(TetraQuality(o, o, o, o), -1.0);
}

TEST(TetraQuality, DoesNotDependOnScalePlaceOrOrder)
{
  for (const Corners& x : ByChance(20))
  {
    const double quality = Quality(x);
    Corners far = x;
    for (Vec3& corner : far)
    {
      corner = 7.0 * corner + Vec3(3, -2, 5);
    }
    EXPECT_NEAR(Quality(far), quality, 1e-12);
    EXPECT_NEAR(TetraQuality(x[1], x[2], x[0], x[3]), quality, 1e-12);
    EXPECT_NEAR(TetraQuality(x[2], x[3], x[0], x[1]), quality, 1e-12);
  }
}

TEST(TetraQuality, BoundsAnglesAndRadiusRatio)
{
  int good = 0;
  for (const Corners& x : ByChance(5000))
  {
    if (Quality(x) >= 0.21)
    {
      ++good;
      const auto angles = DihedralAngles(x[0], x[1], x[2], x[3]);
      EXPECT_GE(*std::min_element(angles.begin(), angles.end()), 12.0);
      EXPECT_LE(*std::max_element(angles.begin(), angles.end()), 155.5);
      EXPECT_GE(TetraRadiusRatio(x[0], x[1], x[2], x[3]), 0.25);
    }
  }
  EXPECT_GT(good, 100);
}

TEST(TetraQuality, GradientsAreThoseOfDifferences)
{
  constexpr double step = 1e-6;
  for (const Corners& x : ByChance(50))
  {
    const auto terms = QualityTerms(x[0], x[1], x[2], x[3]);
    double least = 1e9;
    for (const QualityTerm& term : terms)
    {
      least = std::min(least, term.Value);
    }
    EXPECT_NEAR(least, Quality(x), 1e-12);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 move = step * Vec3::Unit(axis);
      const auto after = QualityTerms(x[0], x[1], x[2], x[3] + move);
      const auto before = QualityTerms(x[0], x[1], x[2], x[3] - move);
      for (int n = 0; n < 7; ++n)
      {
        const double difference = (after[n].Value - before[n].Value) / (2.0 * step);
        if (std::abs(after[n].Value - before[n].Value) < 0.01) // not where an angle becomes obtuse
        {
          EXPECT_NEAR(terms[n].Gradient[axis], difference, 1e-4 * (1.0 + std::abs(difference))) << "term " << n;
        }
      }
    }
  }
}
