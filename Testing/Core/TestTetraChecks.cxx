// SPDX-License-Identifier: BSD-3-Clause
#include "TetraChecks.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace LabelMesh;

TEST(TetraChecks, OfKnownTetrahedra)
{
  // A corner of a cube, the same turned over, a flat one, in another material; and a third material without any.
  TetraMesh mesh;
  mesh.Points = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0) };
  mesh.Corners = { { 0, 1, 2, 3 }, { 1, 0, 2, 3 }, { 0, 1, 2, 4 } };
  mesh.Materials = { 0, 1, 1 };
  const TetraChecks checks = CheckTetrahedra(mesh, 3);
  const double ratio = std::sqrt(3.0) - 1.0;

  const TetraCheck& corner = checks.Materials[0];
  EXPECT_EQ(corner.Tetrahedra, 1);
  EXPECT_EQ(corner.TurnedOver, 0);
  EXPECT_EQ(corner.Slivers, 0);
  EXPECT_NEAR(corner.MinRadiusRatio, ratio, 1e-14);
  EXPECT_NEAR(corner.MeanRadiusRatio, ratio, 1e-14);
  EXPECT_NEAR(corner.FirstPercentileRatio, ratio, 1e-14);
  EXPECT_NEAR(corner.MinDihedral, std::acos(1.0 / std::sqrt(3.0)) * 180.0 / M_PI, 1e-12);
  EXPECT_NEAR(corner.MaxDihedral, 90.0, 1e-12);
  EXPECT_NEAR(corner.Volume, 1.0 / 6.0, 1e-15);
  EXPECT_EQ(corner.Dihedrals[5], 3) << "54.7 degrees";

  EXPECT_EQ(checks.Materials[1].Tetrahedra, 2);
  EXPECT_EQ(checks.Materials[1].TurnedOver, 2);
  EXPECT_EQ(checks.Materials[1].Slivers, 2);
  EXPECT_NEAR(checks.Materials[1].Volume, -1.0 / 6.0, 1e-15);

  EXPECT_EQ(checks.Materials[2].Tetrahedra, 0);
  EXPECT_EQ(checks.Materials[2].MinRadiusRatio, 1.0);
  EXPECT_TRUE(std::isnan(checks.Materials[2].MinDihedral));
  EXPECT_EQ(checks.Materials[2].Worst, -1);

  EXPECT_EQ(checks.All.Tetrahedra, 3);
  EXPECT_EQ(checks.All.Worst, 1);
  EXPECT_NEAR(checks.All.MinRadiusRatio, -ratio, 1e-14);
  EXPECT_NEAR(checks.All.Volume, 0.0, 1e-15);
  Index angles = 0;
  for (const Index count : checks.All.Dihedrals)
  {
    angles += count;
  }
  EXPECT_EQ(angles, 18);
}
