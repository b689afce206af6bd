// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LevelSet.h"
#include "Core/NarrowBand.h"

#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

namespace
{
using namespace LabelMesh;

Lattice MakeLattice(int nx, int ny, int nz, const Vec3& spacing = Vec3::Ones())
{
  Lattice lattice;
  lattice.Dims = { nx, ny, nz };
  lattice.Spacing = spacing;
  return lattice;
}

template <typename Inside>
Sides MakeMask(const Lattice& lattice, Inside&& inside)
{
  Sides mask(static_cast<std::size_t>(lattice.Size()));
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    const auto c = lattice.Coordinates(at);
    mask[at] = inside(lattice.Position(c[0], c[1], c[2])) ? 1 : 0;
  }
  return mask;
}

/// What Tighten gives.
struct Result
{
  std::vector<float> Distance;
  double MaskVolume = 0, TightVolume = 0;
};

Result Tightened(const Lattice& frame, const Sides& mask, const TightenOptions& options)
{
  Result result;
  result.Distance.resize(mask.size());
  const TightenVolumes volumes = Tighten(frame, mask.data(), options, Monitor(), result.Distance.data());
  result.MaskVolume = volumes.Mask;
  result.TightVolume = volumes.Tight;
  return result;
}

/// A ball around a point that is no sample.
struct Ball
{
  Ball(double radius, const Vec3& spacing)
    : Radius(radius)
  {
    for (int a = 0; a < 3; ++a)
    {
      const int n = int(std::ceil(radius / spacing[a])) + 7;
      this->Frame.Dims[a] = 2 * n + 1;
      this->Frame.Origin[a] = -n * spacing[a];
    }
    this->Frame.Spacing = spacing;
    this->Center = spacing.cwiseProduct(Vec3(0.13, 0.27, -0.21));
    this->Mask = MakeMask(this->Frame, [this](const Vec3& x) { return (x - this->Center).norm() < this->Radius; });
  }
  double Volume() const { return 4.18879020479 * this->Radius * this->Radius * this->Radius; }

  Lattice Frame;
  double Radius;
  Vec3 Center;
  Sides Mask;
};

struct SurfaceErrors
{
  double MeanAngle = 0; // degrees
  double MeanRadius = 0, LargestRadius = 0;
  double MeanSlope = 0; // of | |grad| - 1 | within 1.5 voxels
};

/// Where grid edges cross the zero level, with central differences as gradients (as the Catmull-Rom spline has them).
SurfaceErrors ErrorsOf(const Ball& ball, const std::vector<float>& d)
{
  const Lattice& frame = ball.Frame;
  const Index step[3] = { 1, frame.Dims[0], Index(frame.Dims[0]) * frame.Dims[1] };
  const auto gradient = [&](Index at) -> Vec3
  {
    return Vec3(d[at + step[0]] - d[at - step[0]], d[at + step[1]] - d[at - step[1]], d[at + step[2]] - d[at - step[2]])
      .cwiseQuotient(2 * frame.Spacing);
  };
  SurfaceErrors errors;
  double crossings = 0, near = 0;
  for (Index at = step[2]; at < frame.Size() - 2 * step[2]; ++at)
  {
    const auto c = frame.Coordinates(at);
    if (std::abs(d[at]) < 1.5 * frame.VoxelSize())
    {
      errors.MeanSlope += std::abs(gradient(at).norm() - 1);
      ++near;
    }
    for (int a = 0; a < 3; ++a)
    {
      const double u = d[at], v = d[at + step[a]];
      if (c[a] + 1 < frame.Dims[a] && (u > 0) != (v > 0))
      {
        const double t = u / (u - v);
        Vec3 x = frame.Position(c[0], c[1], c[2]) - ball.Center;
        x[a] += t * frame.Spacing[a];
        const Vec3 outwards = -((1 - t) * gradient(at) + t * gradient(at + step[a]));
        errors.MeanAngle += std::acos(std::min(1.0, outwards.normalized().dot(x.normalized()))) * 57.29577951;
        errors.MeanRadius += x.norm() - ball.Radius;
        errors.LargestRadius = std::max(errors.LargestRadius, std::abs(x.norm() - ball.Radius));
        ++crossings;
      }
    }
  }
  errors.MeanAngle /= crossings;
  errors.MeanRadius /= crossings;
  errors.MeanSlope /= near;
  return errors;
}

TightenOptions WithRadius(double radius)
{
  TightenOptions options;
  options.Radius = radius;
  return options;
}

/// Blobs without any symmetry, several of them thin.
Sides RandomMask(const Lattice& lattice, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int n = 0; n < 12; ++n)
  {
    Vec3 center;
    for (int a = 0; a < 3; ++a)
    {
      center[a] = (0.3 + 0.4 * unit(random)) * lattice.Dims[a] * lattice.Spacing[a];
    }
    centers.push_back(center);
    radii.push_back((1 + 4 * unit(random)) * lattice.VoxelSize());
  }
  return MakeMask(lattice,
    [&](const Vec3& x)
    {
      for (std::size_t n = 0; n < centers.size(); ++n)
      {
        if ((x - centers[n]).norm() < radii[n])
        {
          return true;
        }
      }
      return false;
    });
}

TEST(SignedDistance, IsExactForCubicVoxels)
{
  const Lattice lattice = MakeLattice(23, 21, 19);
  const Sides mask = RandomMask(lattice, 7);
  const double band = 4.0;
  std::vector<float> distance(mask.size());
  SignedDistance(lattice, mask, band, distance.data());
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    const auto c = lattice.Coordinates(at);
    double nearest = 1e9;
    for (Index other = 0; other < lattice.Size(); ++other)
    {
      if (mask[other] != mask[at])
      {
        const auto o = lattice.Coordinates(other);
        nearest = std::min(nearest, Vec3(c[0] - o[0], c[1] - o[1], c[2] - o[2]).norm());
      }
    }
    const double expected = std::min(nearest - 0.5, band) * (mask[at] > 0 ? 1 : -1);
    ASSERT_NEAR(distance[at], expected, 1e-5);
  }
}

TEST(SignedDistance, OfAPlaneCountsInWorldLengths)
{
  const Lattice lattice = MakeLattice(9, 9, 20, Vec3(1, 2, 3));
  const auto mask = MakeMask(lattice, [](const Vec3& x) { return x[2] < 28; }); // samples 0 to 9 along z
  std::vector<float> distance(mask.size());
  SignedDistance(lattice, mask, 20.0, distance.data());
  for (int k = 0; k < 20; ++k)
  {
    EXPECT_FLOAT_EQ(distance[lattice.At(4, 4, k)], std::clamp(28.5 - 3.0 * k, -20.0, 20.0)) << k;
  }
}

TEST(SignedDistance, OpeningAndClosingByABall)
{
  const Lattice lattice = MakeLattice(40, 30, 30);
  // A block, a bar one sample thick on it, and a slit one sample wide in it.
  const auto block = [](const Vec3& x)
  { return x[0] >= 8 && x[0] <= 20 && x[1] >= 8 && x[1] <= 20 && x[2] >= 8 && x[2] <= 20; };
  const auto bar = [](const Vec3& x) { return x[0] > 20 && x[0] <= 32 && x[1] == 14 && x[2] == 14; };
  const auto slit = [](const Vec3& x) { return x[0] == 12 && x[1] >= 12; };
  const Sides sides = MakeMask(lattice, [&](const Vec3& x) { return (block(x) && !slit(x)) || bar(x); });
  const Sides opened = Opened(lattice, sides, 1.0);
  const Sides closed = Closed(lattice, sides, 1.0);
  EXPECT_FALSE(opened[lattice.At(26, 14, 14)]); // the bar is gone
  EXPECT_TRUE(closed[lattice.At(26, 14, 14)]);
  EXPECT_FALSE(opened[lattice.At(12, 14, 14)]);
  EXPECT_TRUE(closed[lattice.At(12, 14, 14)]); // the slit is filled
  EXPECT_TRUE(opened[lattice.At(16, 8, 14)]);  // a face stays where it is
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    ASSERT_LE(opened[at], sides[at]);
    ASSERT_GE(closed[at], sides[at]);
  }
}

TEST(LevelSet, AntialiasingSmoothsASphere)
{
  const Ball ball(30, Vec3::Ones());
  TightenOptions options = WithRadius(0);
  options.AntialiasIterations = 0;
  const SurfaceErrors rough = ErrorsOf(ball, Tightened(ball.Frame, ball.Mask, options).Distance);
  options.AntialiasIterations = 10;
  const Result result = Tightened(ball.Frame, ball.Mask, options);
  const SurfaceErrors smooth = ErrorsOf(ball, result.Distance);
  EXPECT_GT(rough.MeanAngle, 7.0);
  EXPECT_LT(smooth.MeanAngle, 1.8);
  EXPECT_LT(std::abs(smooth.MeanRadius), 0.11);
  EXPECT_LT(smooth.LargestRadius, 0.5);
  EXPECT_LT(smooth.MeanSlope, 0.02);
  EXPECT_NEAR(result.MaskVolume, ball.Volume(), 0.002 * ball.Volume());
  EXPECT_NEAR(result.TightVolume, ball.Volume(), 0.015 * ball.Volume());
}

TEST(LevelSet, TighteningKeepsWhatTheBallFits)
{
  const Ball ball(30, Vec3::Ones());
  const Result result = Tightened(ball.Frame, ball.Mask, WithRadius(1));
  const SurfaceErrors errors = ErrorsOf(ball, result.Distance);
  EXPECT_LT(errors.MeanAngle, 1.8);
  EXPECT_LT(std::abs(errors.MeanRadius), 0.11);
  EXPECT_LT(errors.MeanSlope, 0.015);
  EXPECT_NEAR(result.TightVolume, ball.Volume(), 0.02 * ball.Volume());
}

TEST(LevelSet, UnequalSpacings)
{
  for (const Vec3& spacing : { Vec3(1, 1, 3), Vec3(2, 2, 1.5), Vec3(3, 1, 1) })
  {
    const Ball ball(40, spacing);
    const Result result = Tightened(ball.Frame, ball.Mask, WithRadius(1));
    const SurfaceErrors errors = ErrorsOf(ball, result.Distance);
    EXPECT_LT(errors.MeanAngle, 2.6) << spacing.transpose();
    EXPECT_LT(std::abs(errors.MeanRadius), 0.2 * ball.Frame.VoxelSize()) << spacing.transpose();
    EXPECT_LT(errors.MeanSlope, 0.025) << spacing.transpose();
    EXPECT_NEAR(result.TightVolume, ball.Volume(), 0.03 * ball.Volume()) << spacing.transpose();
  }
}

TEST(LevelSet, ScalesWithTheUnitOfLength)
{
  const Lattice small = MakeLattice(30, 30, 30, Vec3(1, 1, 1.5));
  const Lattice large = MakeLattice(30, 30, 30, Vec3(64, 64, 96)); // a power of two: exact
  const auto mask = RandomMask(small, 3);
  const auto a = Tightened(small, mask, TightenOptions());
  const auto b = Tightened(large, mask, TightenOptions());
  for (std::size_t at = 0; at < a.Distance.size(); ++at)
  {
    ASSERT_NEAR(64 * a.Distance[at], b.Distance[at], 0.01);
  }
  EXPECT_NEAR(a.TightVolume * 64 * 64 * 64, b.TightVolume, 1e-3 * b.TightVolume);
}

TEST(LevelSet, AntialiasingChangesNoSide)
{
  for (const Vec3& spacing : { Vec3(1, 1, 1), Vec3(0.8, 0.8, 5) })
  {
    const Lattice lattice = MakeLattice(40, 40, 40, spacing);
    const auto mask = RandomMask(lattice, 11);
    const auto result = Tightened(lattice, mask, WithRadius(0));
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      ASSERT_EQ(result.Distance[at] > 0, mask[at] == 1);
    }
  }
}

TEST(NarrowBand, MeasuredDistanceReachesTheMedialAxis)
{
  const Ball ball(3.5, Vec3::Ones());
  NarrowBand band(ball.Frame, ball.Mask.data(), 4.0);
  const auto peak = [&]()
  {
    std::vector<float> d(ball.Mask.size());
    band.Distance(1.0, 10.0, d.data());
    return *std::max_element(d.begin(), d.end());
  };
  band.Redistance(4.0);
  const double upwind = peak();
  band.MeasureDistance(4.0);
  EXPECT_GT(peak(), upwind + 0.1);
  EXPECT_LT(peak(), 3.6);
}

TEST(NarrowBand, OpeningsAndClosingsAreBounds)
{
  const Lattice lattice = MakeLattice(40, 38, 36, Vec3(1, 1, 1.2));
  const auto mask = RandomMask(lattice, 17);
  NarrowBand band(lattice, mask.data(), 4.0);
  band.Redistance(4.0);
  band.MeasureDistance(NarrowBand::BallReach(1.0));
  const auto phi = band.Pack(), opening = band.Opening(1.0), closing = band.Closing(1.0);
  Index lower = 0, higher = 0;
  for (std::size_t at = 0; at < phi.size(); ++at)
  {
    ASSERT_LE(opening[at], phi[at]);
    ASSERT_GE(closing[at], phi[at]);
    lower += opening[at] < phi[at];
    higher += closing[at] > phi[at];
  }
  EXPECT_GT(lower, 0);
  EXPECT_GT(higher, 0);
}

TEST(LevelSet, TighteningRoundsACornerByTheRadius)
{
  const Lattice lattice = MakeLattice(45, 45, 45);
  const auto mask = MakeMask(lattice, [](const Vec3& x) { return x.minCoeff() >= 10 && x.maxCoeff() <= 34; });
  for (const double radius : { 2.0, 4.0 })
  {
    Grid<float> distance(lattice);
    distance.Values = Tightened(lattice, mask, WithRadius(radius)).Distance;
    // The cube's faces are at 9.5 and 34.5. A corner rounded by r is (sqrt(3) - 1) r below the sharp one.
    const double cut = 0.7320508 * radius;
    double along = 0;
    while (distance.Trilinear(Vec3::Constant(9.5 + along / std::sqrt(3.0))) < 0)
    {
      along += 0.01;
    }
    EXPECT_GT(along, 0.8 * cut) << radius;
    EXPECT_LT(along, cut + 0.9) << radius; // antialiasing has taken 0.8 of the corner itself
    EXPECT_NEAR(distance.Trilinear(Vec3(22, 22, 9.5)), 0.0, 0.02);
    EXPECT_NEAR(distance.Trilinear(Vec3(22, 22, 11.5)), 2.0, 0.05);
  }
}

TEST(LevelSet, PlatesThinnerThanTheBallVanish)
{
  const Lattice lattice = MakeLattice(50, 50, 30);
  const auto plate = [&](int thickness)
  {
    return MakeMask(lattice,
      [thickness](const Vec3& x)
      { return x[0] >= 8 && x[0] <= 41 && x[1] >= 8 && x[1] <= 41 && x[2] >= 12 && x[2] < 12 + thickness; });
  };
  const auto thick = plate(4), three = plate(3), one = plate(1);
  const auto kept = Tightened(lattice, thick, WithRadius(1));
  EXPECT_GT(kept.TightVolume, 0.85 * kept.MaskVolume);
  EXPECT_LT(kept.TightVolume, 1.0 * kept.MaskVolume);
  const auto alsoKept = Tightened(lattice, three, WithRadius(1));
  EXPECT_GT(alsoKept.TightVolume, 0.8 * alsoKept.MaskVolume);
  const auto gone = Tightened(lattice, one, WithRadius(1));
  EXPECT_EQ(gone.TightVolume, 0.0);
  EXPECT_LT(*std::max_element(gone.Distance.begin(), gone.Distance.end()), 0.0f);
  const auto antialiased = Tightened(lattice, one, WithRadius(0));
  EXPECT_GT(antialiased.TightVolume, 0.0);
}

TEST(LevelSet, BallsFitBetweenSamples)
{
  // Two samples thick: the medial sheet lies between them, half a voxel deeper than either.
  const Lattice lattice = MakeLattice(50, 50, 30);
  const auto plate = MakeMask(lattice,
    [](const Vec3& x) { return x[0] >= 8 && x[0] <= 41 && x[1] >= 8 && x[1] <= 41 && x[2] >= 12 && x[2] < 14; });
  const auto result = Tightened(lattice, plate, WithRadius(1));
  EXPECT_GT(result.TightVolume, 0.5 * result.MaskVolume); // thinner than the ball along the rim
}

TEST(LevelSet, TheMirrorImageGivesTheMirrorImage)
{
  const Lattice lattice = MakeLattice(36, 34, 32, Vec3(1, 1.2, 0.9));
  const auto mask = RandomMask(lattice, 5);
  const auto plain = Tightened(lattice, mask, TightenOptions());
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto mirror = [&](Index at)
    {
      auto c = lattice.Coordinates(at);
      c[axis] = lattice.Dims[axis] - 1 - c[axis];
      return lattice.At(c[0], c[1], c[2]);
    };
    Sides mirrored(mask.size());
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      mirrored[mirror(at)] = mask[at];
    }
    const auto result = Tightened(lattice, mirrored, TightenOptions());
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      ASSERT_EQ(result.Distance[mirror(at)], plain.Distance[at]) << "axis " << axis;
    }
  }
}

TEST(LevelSet, TheBackgroundIsTheNegative)
{
  const Lattice lattice = MakeLattice(36, 34, 32);
  const auto mask = RandomMask(lattice, 9);
  auto background = mask;
  for (std::uint8_t& value : background)
  {
    value = 1 - value;
  }
  const auto inside = Tightened(lattice, mask, TightenOptions());
  const auto outside = Tightened(lattice, background, TightenOptions());
  for (std::size_t at = 0; at < mask.size(); ++at)
  {
    ASSERT_NEAR(inside.Distance[at], -outside.Distance[at], 1e-4);
  }
  EXPECT_EQ(outside.Distance[0], 4.0f);
}

TEST(LevelSet, MasksThatTouchTheBorderContinueThere)
{
  const Lattice lattice = MakeLattice(20, 20, 20);
  const auto mask = MakeMask(lattice, [](const Vec3& x) { return x[2] < 10; });
  const auto result = Tightened(lattice, mask, TightenOptions());
  for (Index at = 0; at < lattice.Size(); ++at)
  {
    const double expected = std::clamp(9.5 - lattice.Coordinates(at)[2], -4.0, 4.0);
    ASSERT_NEAR(result.Distance[at], expected, 0.01);
  }
}

TEST(LevelSet, DegenerateMasks)
{
  const Lattice lattice = MakeLattice(15, 14, 13, Vec3(2, 2, 2));
  const Sides empty(static_cast<std::size_t>(lattice.Size()), 0);
  const Sides full(empty.size(), 1);
  const auto none = Tightened(lattice, empty, TightenOptions());
  const auto all = Tightened(lattice, full, TightenOptions());
  EXPECT_EQ(none.TightVolume, 0.0);
  EXPECT_EQ(all.TightVolume, 8.0 * double(lattice.Size()));
  for (std::size_t at = 0; at < empty.size(); ++at)
  {
    ASSERT_EQ(none.Distance[at], -8.0f);
    ASSERT_EQ(all.Distance[at], 8.0f);
  }

  Sides one = empty;
  one[lattice.At(7, 7, 6)] = 1;
  const auto vanished = Tightened(lattice, one, TightenOptions());
  EXPECT_EQ(vanished.MaskVolume, 8.0);
  EXPECT_EQ(vanished.TightVolume, 0.0);
  const auto kept = Tightened(lattice, one, WithRadius(0));
  EXPECT_LT(kept.TightVolume, 0.08) << "a twentieth of a voxel wide";
  EXPECT_GT(kept.Distance[lattice.At(7, 7, 6)], 0.0f);
  for (const float value : vanished.Distance)
  {
    ASSERT_TRUE(std::isfinite(value));
  }

  EXPECT_EQ(Tighten(Lattice(), nullptr, TightenOptions(), Monitor(), nullptr).Mask, 0.0);
}

TEST(LevelSet, SameBitsForAnyNumberOfThreads)
{
  const Lattice lattice = MakeLattice(70, 60, 50, Vec3(1, 1, 1.3));
  const auto mask = RandomMask(lattice, 21);
  const std::string backend = vtkSMPTools::GetBackend();
  vtkSMPTools::SetBackend("STDThread");
  std::vector<Result> results;
  for (const int threads : { 1, 2, 3 })
  {
    vtkSMPTools::Initialize(threads);
    results.push_back(Tightened(lattice, mask, TightenOptions()));
  }
  vtkSMPTools::Initialize(0);
  vtkSMPTools::SetBackend(backend.c_str());
  EXPECT_EQ(results[0].Distance, results[1].Distance);
  EXPECT_EQ(results[0].Distance, results[2].Distance);
  EXPECT_EQ(results[0].TightVolume, results[1].TightVolume);
}

TEST(LevelSet, OptionsAndAbort)
{
  const Lattice lattice = MakeLattice(20, 20, 20);
  const auto mask = RandomMask(lattice, 2);
  EXPECT_THROW(Tightened(lattice, mask, WithRadius(-1)), std::invalid_argument);
  EXPECT_THROW(Tightened(lattice, mask, WithRadius(NAN)), std::invalid_argument);
  TightenOptions options;
  options.TightenIterations = -3;
  EXPECT_THROW(Tightened(lattice, mask, options), std::invalid_argument);
  std::string last;
  const Monitor stop(
    [&last](double fraction, const std::string& text)
    {
      last = text;
      return fraction > 0.3;
    });
  std::vector<float> distance(mask.size());
  EXPECT_THROW(Tighten(lattice, mask.data(), TightenOptions(), stop, distance.data()), Aborted);
  EXPECT_EQ(last, "Closing");
}
}
