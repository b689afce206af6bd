// SPDX-License-Identifier: BSD-3-Clause
// Feature sizes and sizing fields against shapes whose medial axes are known.
#include "AnalyticFields.h"
#include "FeatureTransform.h"
#include "ParticleSystem.h"
#include "SizingField.h"

#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
constexpr double Pi = 3.14159265358979;

SampledFields BallIn(const Lattice& lattice, const Vec3& centre, double radius)
{
  return SampledFields(lattice, { Not(Ball(centre, radius)), Ball(centre, radius) });
}

/// A plate |n x - offset| < thickness / 2 of material 1 in material 0.
SampledFields PlateIn(const Lattice& lattice, const Vec3& normal, double offset, double thickness)
{
  const Vec3 n = normal.normalized();
  const Field plate = [=](const Vec3& x) { return 0.5 * thickness - std::abs(n.dot(x) - offset); };
  return SampledFields(lattice, { Not(plate), plate });
}

std::vector<float> SortedFeatureSizes(const FeatureSizes& features)
{
  std::vector<float> sizes;
  for (const InterfaceSample& sample : features.Samples)
  {
    sizes.push_back(sample.FeatureSize);
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// The largest |h(x) - h(y)| / |x - y| over pairs of samples some way apart, in units of the slope.
double SteepestSlope(const Grid<float>& h, double slope)
{
  std::mt19937 random(7);
  double steepest = 0;
  for (int pair = 0; pair < 200000; ++pair)
  {
    const Index a = random() % h.Frame.Size(), b = random() % h.Frame.Size();
    const auto ca = h.Frame.Coordinates(a), cb = h.Frame.Coordinates(b);
    const double distance = (h.Frame.Position(ca[0], ca[1], ca[2]) - h.Frame.Position(cb[0], cb[1], cb[2])).norm();
    if (a != b)
    {
      steepest = std::max(steepest, std::abs(double(h.Values[a]) - h.Values[b]) / (slope * distance));
    }
  }
  return steepest;
}

/// h at the interface samples of a set, by the voxels that hold them.
template <typename Body>
void AtInterface(const IndicatorSet& set, const Grid<float>& h, const Body& body)
{
  for (const InterfaceSample& sample : FindFeatureSizes(set, Monitor()).Samples)
  {
    body(sample, h.Trilinear(sample.Position.cast<double>()));
  }
}
}

TEST(FeatureTransform, FindsTheNearestOfAllSeeds)
{
  const Lattice lattice = MakeLattice(17, 13, 19, Vec3(1.0, 0.7, 2.5));
  std::mt19937 random(3);
  std::vector<Index> seeds;
  for (int s = 0; s < 40; ++s)
  {
    seeds.push_back(random() % lattice.Size());
  }
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  const auto position = [&](Index at)
  {
    const auto c = lattice.Coordinates(at);
    return lattice.Position(c[0], c[1], c[2]);
  };
  const auto nearest = NearestSeeds(lattice, seeds);
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Index seed : seeds)
    {
      least = std::min(least, (position(seed) - position(at)).norm());
    }
    ASSERT_NEAR((position(seeds[nearest[at]]) - position(at)).norm(), least, 1e-9) << "sample " << at;
  }
  for (const std::int32_t none : NearestSeeds(lattice, {}))
  {
    ASSERT_EQ(none, -1);
  }
}

TEST(FeatureSize, OfASphereIsItsRadius)
{
  const Vec3 centre(39.3, 40.1, 39.8);
  const SampledFields set = BallIn(MakeLattice(80, 80, 80), centre, 30);
  const FeatureSizes features = FindFeatureSizes(*set, Monitor());
  const auto sizes = SortedFeatureSizes(features);
  ASSERT_GT(sizes.size(), 8000u);
  EXPECT_NEAR(sizes[sizes.size() / 2], 30, 1.0);
  EXPECT_GT(sizes.front(), 28.0);
  EXPECT_LT(sizes.back(), 32.0);
  for (const InterfaceSample& sample : features.Samples)
  {
    const Vec3 outward = sample.Position.cast<double>() - centre;
    ASSERT_NEAR(outward.norm(), 30, 0.01);
    const double sign = sample.Materials[0] == 1 ? 1 : -1; // from the first material into the second
    ASSERT_GT(sign * sample.Normal.cast<double>().dot(outward.normalized()), 0.999);
    ASSERT_NEAR(sample.Curvature, 1.0 / 30, 0.02);
  }
}

TEST(FeatureSize, OfAPlateIsHalfItsThickness)
{
  for (const Vec3& normal : { Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 2, 3) })
  {
    for (const double thickness : { 12.0, 5.0, 3.0, 2.0, 1.2 })
    {
      const Lattice lattice = MakeLattice(48, 48, 48);
      const SampledFields set = PlateIn(lattice, normal, 0.5 * 47 * normal.sum() / normal.norm() + 0.13, thickness);
      const FeatureSizes features = FindFeatureSizes(*set, Monitor());
      std::vector<float> sizes;
      for (const InterfaceSample& sample : features.Samples)
      {
        // Away from the border of the volume, which cuts the plate.
        if (((sample.Position.array() - 23.5f).abs() < 15).all())
        {
          sizes.push_back(sample.FeatureSize);
        }
      }
      std::sort(sizes.begin(), sizes.end());
      ASSERT_GT(sizes.size(), 500u);
      // The plate's own medial plane; the sampling of the interface may put it up to half a voxel beside.
      EXPECT_NEAR(sizes[sizes.size() / 2], 0.5 * thickness, 0.35) << thickness << " along " << normal.transpose();
      EXPECT_LT(sizes[sizes.size() * 95 / 100], 0.5 * thickness + 0.9) << thickness << " along " << normal.transpose();
      EXPECT_GT(sizes.front(), 0.5 * thickness - 0.9) << thickness << " along " << normal.transpose();
    }
  }
}

TEST(FeatureSize, SeesTheGapOutsideTwoBalls)
{
  const Vec3 a(20.2, 24.1, 24.3), b(44.4, 24.1, 24.3);
  const Field balls = [=](const Vec3& x) { return std::max(Ball(a, 10)(x), Ball(b, 10)(x)); };
  const SampledFields set(MakeLattice(66, 48, 48), { Not(balls), balls });
  for (const InterfaceSample& sample : FindFeatureSizes(*set, Monitor()).Samples)
  {
    const Vec3 x = sample.Position.cast<double>();
    if ((x - Vec3(30.2, 24.1, 24.3)).norm() < 2)
    {
      EXPECT_NEAR(sample.FeatureSize, 32.3 - x[0], 0.5); // the plane half way
    }
    if ((x - Vec3(10.2, 24.1, 24.3)).norm() < 2)
    {
      EXPECT_NEAR(sample.FeatureSize, 10, 1.0); // the centre
    }
  }
}

TEST(FeatureSize, IsNotTinyWhereInterfacesMeetAt120Degrees)
{
  // Three sectors around a line: the medial axis of each reaches the line.
  std::vector<Field> sectors;
  for (int m = 0; m < 3; ++m)
  {
    const double angle = 0.3 + 2 * Pi * m / 3;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
    sectors.push_back([=](const Vec3& x) { return direction.dot(x - Vec3(23.7, 24.2, 0)); });
  }
  const SampledFields set(MakeLattice(48, 48, 24), sectors);
  for (const InterfaceSample& sample : FindFeatureSizes(*set, Monitor()).Samples)
  {
    EXPECT_GT(sample.FeatureSize, 3.0);
  }
  const SizingResult result = ComputeSizing(*set, SizingOptions(), nullptr, Monitor());
  AtInterface(*set, result.TargetLength,
    [](const InterfaceSample& sample, double h)
    {
      // At the border of the volume the samples are repeated: the field has a kink there.
      if (((sample.Position - Eigen::Vector3f(23.5f, 23.5f, 11.5f)).array().abs() < 6).all())
      {
        EXPECT_GT(h, 1.5);
      }
    });
}

TEST(SizingField, ObeysTheGradationAndTheFormula)
{
  const SampledFields set = PlateIn(MakeLattice(60, 20, 20), Vec3(1, 0, 0), 10.3, 4.0);
  SizingOptions options;
  options.Epsilon = 0.5;
  options.Gradation = 0.3;
  const SizingResult result = ComputeSizing(*set, options, nullptr, Monitor());
  const double atPlate = options.Epsilon * 2.0;
  AtInterface(*set, result.TargetLength, [&](const InterfaceSample&, double h) { EXPECT_NEAR(h, atPlate, 0.2); });
  // Along the normal the chamfer distance is exact; h0 is held by two samples on either side of the plate.
  const double h = result.TargetLength(50, 10, 10);
  EXPECT_NEAR(h, atPlate + options.Gradation * (50 - 12.3 - 2), 0.5);
  EXPECT_LT(SteepestSlope(result.TargetLength, options.Gradation), 1.13);
}

TEST(SizingField, KeepsTheMinimumAndTheMaxima)
{
  const Vec3 centre(24.3, 24.1, 23.8);
  const SampledFields set = BallIn(MakeLattice(48, 48, 48), centre, 18);
  SizingOptions options;
  options.MinimumLength = 3.0;
  options.MaximumLength = 5.0;
  SizingResult result = ComputeSizing(*set, options, nullptr, Monitor());
  AtInterface(*set, result.TargetLength, [](const InterfaceSample&, double h) { EXPECT_NEAR(h, 5.0, 1e-5); });
  options.MaximumLength = 0.0;
  options.MaterialMaximumLength = { 0.0, 4.0 };
  result = ComputeSizing(*set, options, nullptr, Monitor());
  AtInterface(*set, result.TargetLength, [](const InterfaceSample&, double h) { EXPECT_NEAR(h, 4.0, 1e-5); });
  options.MaterialMaximumLength = { 0.0, 1.0 };
  result = ComputeSizing(*set, options, nullptr, Monitor());
  AtInterface(*set, result.TargetLength, [](const InterfaceSample&, double h) { EXPECT_NEAR(h, 3.0, 1e-5); });
  options.MaximumLength = 2.0;
  EXPECT_THROW(ComputeSizing(*set, options, nullptr, Monitor()), std::invalid_argument);
  options = SizingOptions();
  options.Epsilon = 0;
  EXPECT_THROW(ComputeSizing(*set, options, nullptr, Monitor()), std::invalid_argument);
}

TEST(SizingField, BoundsSingleInterfaces)
{
  const SampledFields set = HalvedBall(MakeLattice(48, 48, 48), Vec3(24.3, 24.1, 23.8), 18);
  SizingOptions options;
  options.Epsilon = 2;
  options.MinimumLength = 1.0;
  const SizingResult free = ComputeSizing(*set, options, nullptr, Monitor());
  options.InterfaceMaximumLength = { { { 1, 2 }, 1.5 } };
  const SizingResult bound = ComputeSizing(*set, options, nullptr, Monitor());
  int between = 0, elsewhere = 0;
  for (const InterfaceSample& sample : FindFeatureSizes(*set, Monitor()).Samples)
  {
    const Vec3 x = sample.Position.cast<double>();
    if (sample.Materials[0] + sample.Materials[1] == 3)
    {
      ++between;
      // At the rim the samples of the other interfaces are the nearest: one voxel along the gradation.
      const double rim = 18 - (x - Vec3(24.3, 24.1, 23.8)).norm();
      EXPECT_LE(bound.TargetLength.Trilinear(x), 1.5 + (rim > 2 ? 1e-4 : options.Gradation));
    }
    else if (std::abs(x[2] - 23.8) > 16)
    {
      // Beyond the reach of the gradation nothing has changed.
      ++elsewhere;
      EXPECT_EQ(bound.TargetLength.Trilinear(x), free.TargetLength.Trilinear(x));
    }
  }
  EXPECT_GT(between, 500);
  EXPECT_GT(elsewhere, 50);
  EXPECT_GT(bound.PredictedParticles, 1.4 * free.PredictedParticles);
  // The minimum wins, and 0 is no bound.
  options.InterfaceMaximumLength = { { { 1, 2 }, 0.5 } };
  const SizingResult least = ComputeSizing(*set, options, nullptr, Monitor());
  EXPECT_GE(*std::min_element(least.TargetLength.Values.begin(), least.TargetLength.Values.end()), 1.0f);
  options.InterfaceMaximumLength = { { { 1, 2 }, 0.0 } };
  EXPECT_EQ(ComputeSizing(*set, options, nullptr, Monitor()).TargetLength.Values, free.TargetLength.Values);
}

TEST(SizingField, TakesTheUsersImageAsABound)
{
  const Vec3 centre(24.3, 24.1, 23.8);
  const SampledFields set = BallIn(MakeLattice(48, 48, 48), centre, 18);
  // On a coarse lattice that covers the half x < 24 only, with a hole of no meaning.
  Grid<float> user(MakeLattice(7, 13, 13, Vec3::Constant(4.0)), 2.5f);
  user(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  user(1, 0, 0) = 0.0f;
  SizingOptions options;
  options.Epsilon = 0.5;
  const SizingResult free = ComputeSizing(*set, options, nullptr, Monitor());
  const SizingResult bound = ComputeSizing(*set, options, &user, Monitor());
  AtInterface(*set, bound.TargetLength,
    [&](const InterfaceSample& sample, double h)
    {
      if (sample.Position[0] < 23)
      {
        EXPECT_NEAR(h, 2.5, 1e-4);
      }
      if (sample.Position[0] > 40)
      {
        EXPECT_GT(h, 5.0);
      }
    });
  EXPECT_LT(SteepestSlope(bound.TargetLength, options.Gradation), 1.13);
  for (std::size_t at = 0; at < free.TargetLength.Values.size(); ++at)
  {
    ASSERT_LE(bound.TargetLength.Values[at], free.TargetLength.Values[at]);
  }
}

TEST(SizingField, KeepsEdgesNearCurvedSurfaces)
{
  // An edge of length h on a ball of radius R stays h^2 / (8 R) beside it.
  SizingOptions options;
  for (const double deviation : { 0.1, 0.4 })
  {
    options.MaximumDeviation = deviation;
    for (const double radius : { 12.0, 24.0 })
    {
      const SampledFields set = BallIn(MakeLattice(73, 73, 73), Vec3(36.3, 36.1, 35.8), radius);
      const SizingResult result = ComputeSizing(*set, options, nullptr, Monitor());
      double sum = 0.0, count = 0.0;
      AtInterface(*set, result.TargetLength,
        [&](const InterfaceSample&, double h)
        {
          sum += h * h / (8 * radius);
          ++count;
        });
      EXPECT_NEAR(sum / count, deviation, 0.15 * deviation) << radius;
    }
  }
}

TEST(SizingField, GivesTheSameLengthsOnAnAnisotropicLattice)
{
  const Vec3 centre(36.3, 36.1, 35.8);
  SizingOptions options;
  options.MaximumDeviation = 0;
  options.Epsilon = 0.5;
  options.FeatureSizeFloor = 0.5;
  const auto median = [&](const SampledFields& set, double& least)
  {
    const SizingResult result = ComputeSizing(*set, options, nullptr, Monitor());
    EXPECT_LT(SteepestSlope(result.TargetLength, options.Gradation), 1.2);
    std::vector<double> lengths;
    AtInterface(*set, result.TargetLength, [&](const InterfaceSample&, double h) { lengths.push_back(h); });
    std::sort(lengths.begin(), lengths.end());
    least = lengths.front();
    return lengths[lengths.size() / 2];
  };
  double leastFine = 0, leastCoarse = 0;
  const double fine = median(BallIn(MakeLattice(73, 73, 73), centre, 24), leastFine);
  const double coarse = median(BallIn(MakeLattice(73, 73, 25, Vec3(1, 1, 3)), centre, 24), leastCoarse);
  EXPECT_NEAR(fine, 12, 0.6);
  EXPECT_NEAR(coarse, 12, 1.0);
  EXPECT_GT(leastFine, 11.0);
  EXPECT_GT(leastCoarse, 10.0);
}

TEST(SizingField, PredictsParticlesFromTheArea)
{
  for (const Vec3& spacing : { Vec3(1, 1, 1), Vec3(1, 1, 3), Vec3(0.5, 1, 0.7) })
  {
    const Lattice lattice = MakeLattice(int(60 / spacing[0]), int(60 / spacing[1]), int(60 / spacing[2]), spacing);
    const SampledFields set = BallIn(lattice, Vec3(29.3, 29.1, 28.8), 20);
    const double area = 4 * Pi * 20 * 20;
    const double h = lattice.VoxelSize(); // where the share is 0.935
    const double expected = 0.935 * area / (0.866 * h * h);
    EXPECT_NEAR(PredictParticles(*set, Grid<float>(lattice, float(h))), expected, 0.03 * expected);
  }
}

TEST(SizingField, PredictsWhatTheSamplingMakes)
{
  const Lattice lattice = MakeLattice(48, 48, 48);
  const SampledFields set = BallIn(lattice, Vec3(23.3, 24.1, 23.8), 18);
  for (const float h : { 0.75f, 1.0f, 1.5f, 2.5f, 4.0f })
  {
    const Grid<float> lengths(lattice, h);
    const double made = double(SampleCells(*set, lengths, SampleOptions(), Monitor()).Particles.size());
    EXPECT_NEAR(PredictParticles(*set, lengths) / made, 1.0, 0.12) << "h " << h;
  }
}

TEST(SizingField, ReachesATargetOfTriangles)
{
  const SampledFields set = PlateIn(MakeLattice(60, 50, 40), Vec3(3, 1, 2), 31, 6.0);
  SizingOptions options;
  for (const double triangles : { 500.0, 4000.0, 50000.0 })
  {
    options.TargetTriangles = triangles;
    const SizingResult result = ComputeSizing(*set, options, nullptr, Monitor());
    EXPECT_NEAR(2 * result.PredictedParticles / triangles, 1.0, 0.01);
    EXPECT_NEAR(result.PredictedParticles, PredictParticles(*set, result.TargetLength), 1e-6 * triangles);
    EXPECT_LT(SteepestSlope(result.TargetLength, options.Gradation), 1.13);
  }
  // A maximum that holds keeps the target out of reach; the nearest field is given.
  options.TargetTriangles = 500;
  options.MaximumLength = 1.0;
  const SizingResult held = ComputeSizing(*set, options, nullptr, Monitor());
  EXPECT_GT(2 * held.PredictedParticles, 5000);
  EXPECT_LE(*std::max_element(held.TargetLength.Values.begin(), held.TargetLength.Values.end()), 1.0f);
}

TEST(SizingField, OfOneMaterialHasNoInterface)
{
  const SampledFields set(MakeLattice(9, 8, 7), { [](const Vec3&) { return 1.0; } });
  const SizingResult result = ComputeSizing(*set, SizingOptions(), nullptr, Monitor());
  EXPECT_EQ(result.PredictedParticles, 0);
  for (const float h : result.TargetLength.Values)
  {
    ASSERT_TRUE(std::isfinite(h) && h > 0);
  }
}

TEST(SizingField, HasTheSameBitsForAnyNumberOfThreads)
{
  const SampledFields set(MakeLattice(40, 40, 40),
    { Site(Vec3(8, 9, 10)), Site(Vec3(31, 12, 8)), Site(Vec3(20, 30, 31)), Site(Vec3(8, 28, 7)) });
  const auto compute = [&](int threads)
  {
    SizingResult result;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, "STDThread", false },
      [&]() { result = ComputeSizing(*set, SizingOptions(), nullptr, Monitor()); });
    return result;
  };
  const SizingResult one = compute(1), two = compute(2);
  EXPECT_EQ(one.TargetLength.Values, two.TargetLength.Values);
  EXPECT_EQ(one.FeatureSize.Values, two.FeatureSize.Values);
  EXPECT_EQ(one.PredictedParticles, two.PredictedParticles);
}

TEST(SizingField, StopsWhenAsked)
{
  const SampledFields set = BallIn(MakeLattice(20, 20, 20), Vec3(10, 10, 10), 6);
  const Monitor stop([](double fraction, const std::string&) { return fraction > 0.4; });
  EXPECT_THROW(ComputeSizing(*set, SizingOptions(), nullptr, stop), Aborted);
}
