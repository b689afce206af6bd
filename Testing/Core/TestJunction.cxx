// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "Junction.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(24, 24, 24);
// Four sites around (12, 12, 12): their Voronoi diagram has one 0-cell there, four 1-cells and six 2-cells.
const Vec3 Centre(12.2, 11.9, 12.1);
const std::vector<Vec3> Offsets{ Vec3(5, 5, 5), Vec3(5, -5, -5), Vec3(-5, 5, -5), Vec3(-5, -5, 5) };

SampledFields FourSites()
{
  std::vector<Field> sites;
  for (const Vec3& offset : Offsets)
  {
    sites.push_back(Site(Centre + offset));
  }
  return SampledFields(Frame, sites);
}
const MaterialId All[4] = { 0, 1, 2, 3 };
}

TEST(Junction, ProjectsOntoTheInterfaceOfTwo)
{
  const SampledFields fields = FourSites();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int n = 0; n < 100; ++n)
  {
    const Vec3 x = Centre + Vec3(uniform(random), uniform(random), uniform(random));
    const Projection p = ProjectToJunction(*fields, All, 2, x);
    EXPECT_TRUE(p.Converged);
    // The bisector plane of the sites 0 and 1.
    const Vec3 normal = (Offsets[0] - Offsets[1]).normalized();
    EXPECT_LT(std::abs((p.Position - Centre).dot(normal)), 5e-3);
    // A projection moves along the normal: the tangential move is of second order.
    EXPECT_LT(ToTangentPlane(p.Position - x, normal).norm(), 0.3);
  }
}

TEST(Junction, ProjectsOntoTheCurveOfThree)
{
  const SampledFields fields = FourSites();
  const Vec3 direction = (Offsets[0] - Offsets[1]).cross(Offsets[0] - Offsets[2]).normalized();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int n = 0; n < 100; ++n)
  {
    const Vec3 x = Centre + Vec3(uniform(random), uniform(random), uniform(random));
    const Projection p = ProjectToJunction(*fields, All, 3, x);
    EXPECT_TRUE(p.Converged);
    const Vec3 off = p.Position - Centre;
    EXPECT_LT((off - off.dot(direction) * direction).norm(), 1e-2);
  }
}

TEST(Junction, ProjectsOntoThePointOfFour)
{
  const SampledFields fields = FourSites();
  const Projection p = ProjectToJunction(*fields, All, 4, Centre + Vec3(0.6, -0.8, 0.7));
  EXPECT_TRUE(p.Converged);
  EXPECT_LT((p.Position - Centre).norm(), 1e-2);
}

TEST(Junction, DoesNotClaimConvergenceWhereTheMaterialsDoNotMeet)
{
  const SampledFields fields(Frame, { [](const Vec3&) { return 1.0; }, [](const Vec3&) { return -1.0; } });
  EXPECT_FALSE(ProjectToJunction(*fields, All, 2, Vec3(12, 12, 12)).Converged);
}

TEST(Junction, NormalPointsFromTheFirstMaterialIntoTheSecond)
{
  const SampledFields fields = FourSites();
  const Vec3 expected = (Offsets[1] - Offsets[0]).normalized();
  EXPECT_GT(InterfaceNormal(*fields, 0, 1, Centre).dot(expected), 0.999);
  EXPECT_GT(InterfaceNormal(*fields, 1, 0, Centre).dot(-expected), 0.999);
}

TEST(Junction, TangentAgreesWithEquationEightOfTheInsideOutsideFunctions)
{
  const SampledFields fields = FourSites();
  const MaterialId three[3] = { 0, 1, 2 };
  const Vec3 tangent = CurveTangent(*fields, three, Centre);
  // Equation 8 with the gradients of f_i minus its largest rival; the rival of 0 is 1, of 1 is 2, of 2 is 0.
  Vec3 g[3], io[3], sum = Vec3::Zero();
  for (int n = 0; n < 3; ++n)
  {
    fields->ValueAndGradient(three[n], Centre, g[n]);
  }
  for (int n = 0; n < 3; ++n)
  {
    io[n] = (g[n] - g[(n + 1) % 3]).normalized();
  }
  for (int n = 0; n < 3; ++n)
  {
    sum += io[n].cross(io[(n + 1) % 3]);
  }
  EXPECT_GT(std::abs(tangent.dot(sum.normalized())), 0.9999);
  EXPECT_LT(ToTangentLine(Vec3(1, 2, 3), tangent).cross(tangent).norm(), 1e-12);
}
