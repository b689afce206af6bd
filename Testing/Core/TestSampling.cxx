// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "CurveSampling.h"
#include "ParticleSystem.h"
#include "Relaxation.h"
#include "SurfaceSampling.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <numeric>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
const Lattice Frame = MakeLattice(64, 64, 64);
const Vec3 A(32, 32, 40), B(32, 32, 24);

// Two balls that cut each other in a circle of radius sqrt(189), and the outside.
SampledFields TwoBalls()
{
  return SampledFields(Frame, { [](const Vec3&) { return 0.0; }, Ball(A, 17), Ball(B, 15) });
}
Grid<float> Constant(float h)
{
  return Grid<float>(Frame, h);
}
double DistanceToInterfaces(const Vec3& x)
{
  // Of the sphere parts and of the plane disk between them (the radical plane of the two fields is a hyperboloid: test
  // those with the fields instead).
  return std::min(std::abs((x - A).norm() - 17), std::abs((x - B).norm() - 15));
}
}

TEST(CurveSampling, ACircleGetsEqualSpacingsOfTheTargetLength)
{
  const SampledFields fields = TwoBalls();
  const JunctionNetwork network = TraceJunctions(*fields, Monitor());
  const CurveSamples samples = SampleCurves(network, *fields, Constant(2.5f));
  ASSERT_EQ(samples.Curves.size(), 1u);
  const std::vector<Index>& loop = samples.Curves[0].Particles;
  EXPECT_EQ(loop.front(), loop.back());
  const double circumference = 2 * M_PI * std::sqrt(189.0);
  EXPECT_EQ(Index(loop.size()) - 1, std::lround(circumference / 2.5));
  for (std::size_t n = 1; n < loop.size(); ++n)
  {
    const Vec3 step = samples.Particles[loop[n]].Position - samples.Particles[loop[n - 1]].Position;
    EXPECT_NEAR(step.norm(), circumference / double(loop.size() - 1), 0.05);
  }
  for (const Particle& p : samples.Particles)
  {
    EXPECT_EQ(p.CellDimension, 1);
    EXPECT_EQ(p.Materials.Size(), 3);
    EXPECT_NEAR(p.Position[2], 30.0, 0.01);
  }
}

TEST(CurveSampling, JunctionsCloserThanHalfALengthBecomeOneParticle)
{
  // Two 0-cells one voxel apart: with h = 4 they are one, with all five materials.
  JunctionNetwork network;
  const auto zeroCell = [](const Vec3& x, std::initializer_list<int> materials)
  {
    ZeroCell cell;
    cell.Position = x;
    for (const int m : materials)
    {
      cell.Materials.Insert(MaterialId(m));
    }
    return cell;
  };
  network.ZeroCells = { zeroCell(Vec3(20, 20, 20), { 0, 1, 2, 3 }), zeroCell(Vec3(21, 20, 20), { 0, 1, 2, 4 }) };
  OneCell between;
  between.Materials = { 0, 1, 2 };
  between.Points = { Vec3(20, 20, 20), Vec3(20.5, 20, 20), Vec3(21, 20, 20) };
  between.Start = 0;
  between.End = 1;
  network.OneCells = { between };
  const SampledFields fields(Frame, std::vector<Field>(5, [](const Vec3&) { return 0.0; }));
  const CurveSamples merged = SampleCurves(network, *fields, Constant(4.0f));
  ASSERT_EQ(merged.Particles.size(), 1u);
  EXPECT_EQ(merged.Particles[0].Materials.Size(), 5);
  EXPECT_TRUE(merged.Curves.empty());
  const CurveSamples apart = SampleCurves(network, *fields, Constant(1.0f));
  EXPECT_EQ(apart.Particles.size(), 2u);
  ASSERT_EQ(apart.Curves.size(), 1u);
  EXPECT_EQ(apart.Curves[0].Particles, (std::vector<Index>{ 0, 1 }));
}

TEST(Relaxation, AHexagonalArrangementOfTheTargetLengthStays)
{
  // At the target length d = 1 / sqrt(3); the ring beyond is just out of range, so the forces cancel.
  const SampledFields fields(
    Frame, { [](const Vec3& x) { return 32.3 - x[2]; }, [](const Vec3& x) { return x[2] - 32.3; } });
  std::vector<Particle> particles;
  std::vector<Index> moving;
  const double h = 3.0;
  for (int j = 0; j < 12; ++j)
  {
    for (int i = 0; i < 12; ++i)
    {
      Particle p;
      p.Materials.Insert(0);
      p.Materials.Insert(1);
      p.TargetLength = h;
      ASSERT_TRUE(
        PutOnInterface(*fields, 0, 1, Vec3(10 + h * (i + 0.5 * (j % 2)), 10 + h * j * std::sqrt(0.75), 32), 1.0, p));
      EXPECT_NEAR(p.Position[2], 32.3, 1e-5);
      EXPECT_GT(p.Normal[2], 0.999);
      if (i > 0 && i < 11 && j > 0 && j < 11)
      {
        moving.push_back(Index(particles.size()));
      }
      particles.push_back(p);
    }
  }
  const std::vector<Particle> before = particles;
  Relax(*fields, nullptr, particles, moving, RelaxOptions());
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    EXPECT_LT((particles[n].Position - before[n].Position).norm(), 1e-3 * h);
  }
  // One that is pushed out of its place comes back.
  const Index middle = 12 * 6 + 6;
  ASSERT_TRUE(PutOnInterface(*fields, 0, 1, particles[middle].Position + Vec3(0.8, 0.5, 0), 1.0, particles[middle]));
  RelaxOptions longer;
  longer.Sweeps = 60;
  Relax(*fields, nullptr, particles, moving, longer);
  EXPECT_LT((particles[middle].Position - before[middle].Position).norm(), 0.02 * h);
}

TEST(SampleCells, ParticlesLieOnTheirJunctionsAboutATargetLengthApart)
{
  const SampledFields fields = TwoBalls();
  const SampleResult result = SampleCells(*fields, Constant(2.0f), SampleOptions(), Monitor());
  EXPECT_EQ(result.CellCounts[0], 0);
  EXPECT_EQ(result.OpenCurveEnds, 0);
  ASSERT_GT(result.CellCounts[2], 1000);
  double area = 0;
  for (const Particle& p : result.Particles)
  {
    RankedMaterial top[3];
    const int count = fields->Largest(p.Position, 3, top);
    ASSERT_GE(count, p.Materials.Size());
    for (int n = 0; n < p.Materials.Size(); ++n)
    {
      EXPECT_TRUE(p.Materials.Contains(top[n].Material) || top[n].Value - top[p.Materials.Size() - 1].Value < 0.02);
    }
    EXPECT_LT(top[0].Value - top[p.Materials.Size() - 1].Value, 0.03);
    if (p.Materials[0] == 0 && p.CellDimension == 2)
    {
      EXPECT_LT(DistanceToInterfaces(p.Position), 0.02);
    }
    area += 0.866 * 4.0;
  }
  // The two caps, and the surface where both fields are equal: between its flat disk and the larger cap.
  const double caps = 2 * M_PI * 17 * (17 + 10) + 2 * M_PI * 15 * (15 + 6), disk = M_PI * 189;
  EXPECT_GT(area, 0.85 * (caps + disk));
  EXPECT_LT(area, 1.15 * (caps + 1.5 * disk));
}

TEST(SampleCells, SameBitsForAnyNumberOfThreads)
{
  const SampledFields fields = TwoBalls();
  const auto run = [&](int threads)
  {
    SampleResult result;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&] { result = SampleCells(*fields, Constant(2.0f), SampleOptions(), Monitor()); });
    return result;
  };
  const SampleResult one = run(1), two = run(2), three = run(3);
  ASSERT_EQ(one.Particles.size(), two.Particles.size());
  ASSERT_EQ(one.Particles.size(), three.Particles.size());
  for (std::size_t n = 0; n < one.Particles.size(); ++n)
  {
    EXPECT_EQ(one.Particles[n].Position, two.Particles[n].Position);
    EXPECT_EQ(one.Particles[n].Position, three.Particles[n].Position);
    EXPECT_TRUE(one.Particles[n].Materials == two.Particles[n].Materials);
  }
}

TEST(SampleCells, ParticlesOfCurvesAreOrderedInSpaceAndCurvesFollowThem)
{
  // The Voronoi cells of 64 sites, with some two hundred curves: 64 particles in a row are near each other, as in
  // any other part of a space-filling curve, so that what is looked up in a PointTree costs the same for any number.
  const Lattice frame = MakeLattice(40, 40, 40);
  std::vector<Field> sites;
  for (int n = 0; n < 64; ++n)
  {
    sites.push_back(Site(Vec3(n % 4 * 10 + 5 + 3 * std::sin(12.9 * n), n / 4 % 4 * 10 + 5 + 3 * std::sin(78.2 * n),
      n / 16 * 10 + 5 + 3 * std::sin(3.7 * n))));
  }
  const SampledFields fields(frame, sites);
  SampleOptions options;
  options.Sweeps = 1;
  const SampleResult result = SampleCells(*fields, Grid<float>(frame, 1.0f), options, Monitor());
  const Index zeroCells = result.CellCounts[0], fixed = zeroCells + result.CellCounts[1];
  ASSERT_GT(result.Curves.size(), 100u);
  ASSERT_GT(fixed - zeroCells, 1000);
  constexpr Index row = 64;
  double volume = 0.0;
  for (Index first = zeroCells; first + row <= fixed; first += row)
  {
    Vec3 low = result.Particles[first].Position, high = low;
    for (Index n = first; n < first + row; ++n)
    {
      EXPECT_EQ(result.Particles[n].CellDimension, 1);
      low = low.cwiseMin(result.Particles[n].Position);
      high = high.cwiseMax(result.Particles[n].Position);
    }
    volume += (high - low).prod();
  }
  EXPECT_LT(volume, 4.0 * 39 * 39 * 39); // one curve after another: 13 times
  for (const Curve& curve : result.Curves)
  {
    for (std::size_t n = 0; n < curve.Particles.size(); ++n)
    {
      const Particle& p = result.Particles[curve.Particles[n]];
      EXPECT_TRUE(std::all_of(
        curve.Materials.begin(), curve.Materials.end(), [&p](MaterialId m) { return p.Materials.Contains(m); }));
      EXPECT_TRUE(n == 0 || (p.Position - result.Particles[curve.Particles[n - 1]].Position).norm() < 2.0);
    }
  }
}

TEST(SampleCells, StopsWhenItsMonitorSaysSo)
{
  const SampledFields fields = TwoBalls();
  // Whatever the step, progress grows until then and nothing is asked afterwards.
  for (int last = 1; last < 12; ++last)
  {
    int calls = 0;
    double before = 0.0;
    EXPECT_THROW(SampleCells(*fields, Constant(2.0f), SampleOptions(),
                   Monitor(
                     [&](double fraction, const std::string&)
                     {
                       EXPECT_GE(fraction, before);
                       before = fraction;
                       return ++calls == last;
                     })),
      Aborted);
    EXPECT_EQ(calls, last);
  }
}

TEST(ProtectionBalls, HoldTheDiametralBallsOfTheSegments)
{
  std::vector<Particle> particles(2);
  particles[0].Position = Vec3(10, 10, 10);
  particles[1].Position = Vec3(12, 10, 10);
  Curve curve;
  curve.Particles = { 0, 1 };
  const ProtectionBalls balls(particles, { curve });
  EXPECT_TRUE(balls.Contains(Vec3(11, 10.9, 10)));
  EXPECT_TRUE(balls.Contains(Vec3(11, 10, 10.0 - 1.04)));
  EXPECT_FALSE(balls.Contains(Vec3(11, 11.06, 10)));
  EXPECT_FALSE(balls.Contains(Vec3(12.1, 10, 10)));
}

TEST(CandidatePool, FillsGapsAndKnowsWhoBlocksThem)
{
  const SampledFields fields = TwoBalls();
  const Grid<float> lengths = Constant(2.0f);
  const std::vector<Particle> candidates = InterfaceCandidates(*fields, lengths, 1);
  const ProtectionBalls none({}, {});
  CandidatePool pool(candidates, none);
  std::vector<Particle> particles;
  pool.AddWhereFree(particles, PoissonDistance);
  const std::vector<Particle> filled = particles;
  // Every candidate is near a particle, and no two particles that interact are near each other.
  for (const Particle& candidate : candidates)
  {
    EXPECT_TRUE(std::any_of(particles.begin(), particles.end(),
      [&](const Particle& p) { return (p.Position - candidate.Position).norm() <= PoissonDistance * 2.0; }));
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_TRUE((particles[i].Position - particles[j].Position).norm() >= PoissonDistance * 2.0 ||
        !Interact(particles[i], particles[j]));
    }
  }
  pool.AddWhereFree(particles, PoissonDistance);
  EXPECT_EQ(particles.size(), filled.size());
  // Every third one is deleted: a pool that was told fills the gaps as a new one does.
  std::vector<std::int32_t> numbers(particles.size(), -1);
  std::vector<Particle> fewer;
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    if (n % 3 != 0)
    {
      numbers[n] = std::int32_t(fewer.size());
      fewer.push_back(particles[n]);
    }
  }
  std::vector<Particle> told = fewer, anew = fewer;
  pool.Renumber(numbers);
  pool.AddWhereFree(told, GapDistance);
  CandidatePool(candidates, none).AddWhereFree(anew, GapDistance);
  ASSERT_EQ(told.size(), anew.size());
  EXPECT_GT(told.size(), fewer.size());
  for (std::size_t n = 0; n < told.size(); ++n)
  {
    EXPECT_EQ(told[n].Position, anew[n].Position);
  }
}
