// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "GaussianBlur.h"
#include "JointSmoothing.h"
#include "PartitionVolumes.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <numeric>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
struct Result
{
  std::vector<float> Distance;
  double MaskVolume = 0, TightVolume = 0;
};

/// Masks of a label function on one lattice.
struct Volume
{
  Lattice Frame;
  std::vector<Sides> Masks;
  std::vector<MaterialMask> Materials;

  Volume(const Lattice& frame, int labels, const std::function<int(const Vec3&)>& labelAt)
    : Frame(frame)
    , Masks(labels, Sides(frame.Size(), 0))
  {
    for (Index at = 0; at < frame.Size(); ++at)
    {
      const auto c = frame.Coordinates(at);
      this->Masks[labelAt(frame.Position(c[0], c[1], c[2]))][at] = 1;
    }
    for (int m = 0; m < labels; ++m)
    {
      this->Materials.push_back({ "Label_" + std::to_string(m), frame, this->Masks[m].data(), 0.7, nullptr });
    }
  }
  std::vector<Result> Smooth(const Monitor& monitor = Monitor()) const
  {
    std::vector<Result> results(this->Materials.size());
    std::vector<MaterialMask> materials = this->Materials;
    for (std::size_t m = 0; m < materials.size(); ++m)
    {
      results[m].Distance.resize(materials[m].Frame.Size());
      materials[m].Place = [&results, m]() { return results[m].Distance.data(); };
    }
    const auto volumes = SmoothJointly(this->Frame, materials, JointSmoothingOptions(), monitor);
    for (std::size_t m = 0; m < materials.size(); ++m)
    {
      results[m].MaskVolume = volumes[m].Mask;
      results[m].TightVolume = volumes[m].Tight;
    }
    return results;
  }
};

/// What each material holds of its voxels' volume, as a mesh of the interpolated fields would enclose it.
std::vector<double> KeptShares(const Volume& volume)
{
  const auto results = volume.Smooth();
  std::vector<IndicatorBlock> blocks;
  for (std::size_t m = 0; m < results.size(); ++m)
  {
    blocks.push_back({ Label(m), volume.Frame, results[m].Distance.data(), -4.0 * volume.Frame.VoxelSize() });
  }
  std::vector<double> shares = PartitionVolumes(blocks, volume.Frame);
  for (std::size_t m = 0; m < shares.size(); ++m)
  {
    shares[m] /= results[m].MaskVolume;
  }
  return shares;
}

/// A layout whose active samples are those of a set; its mask does not matter.
BandLayout LayoutOf(const Lattice& frame, const std::function<bool(int, int, int)>& active)
{
  const Lattice grown = BandLayout::Grown(frame);
  const Sides mask(frame.Size(), 0);
  BitLattice bits(grown.Dims);
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    if (active(c[0], c[1], c[2]))
    {
      const int i = c[0] + BandLayout::Margin;
      bits.Add({ i, i + 1 }, c[1] + BandLayout::Margin, c[2] + BandLayout::Margin);
    }
  }
  return BandLayout(grown, mask.data(), bits);
}

void Blur(const BandLayout& layout, double sigma, std::vector<float>& values)
{
  std::vector<float> box(layout.Frame().Size(), 1e9f); // what is not written must not be read
  GaussianBlur(layout, sigma).Apply(layout, values.data(), box.data());
}
}

TEST(GaussianBlur, KeepsTheSumAndHasItsVariance)
{
  const BandLayout layout = LayoutOf(MakeLattice(31, 31, 31, Vec3(1, 1.5, 0.75)), [](int, int, int) { return true; });
  const Lattice& frame = layout.Frame(); // in voxels
  std::vector<float> field(layout.NumberOfActive(), 0.0f);
  field[15 + 31 * (15 + 31 * 15)] = 1.0f;
  Blur(layout, 2.0, field);
  double sum = 0;
  Vec3 variance = Vec3::Zero();
  for (Index at = 0; at < Index(field.size()); ++at)
  {
    const Vec3 x = frame.Spacing.cwiseProduct(Vec3(at % 31 - 15, at / 31 % 31 - 15, at / (31 * 31) - 15));
    sum += field[at];
    variance += field[at] * x.cwiseAbs2();
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(variance[a], 4.0, 0.15); // cut at three standard deviations
  }
}

TEST(GaussianBlur, OfASparseFieldIsWhatItIsEverywhere)
{
  const Lattice frame = MakeLattice(70, 30, 20); // rows of more than one word of bits
  const auto active = [](int i, int j, int k)
  { return (i >= (j + k) / 2 && i < (j + k) / 2 + (j * k) % 9) || (i > 60 && i < 60 + j % 11) || (j == 7 && k == 3); };
  const BandLayout sparse = LayoutOf(frame, active), dense = LayoutOf(frame, [](int, int, int) { return true; });
  std::vector<float> within, everywhere;
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    const bool on = active(c[0], c[1], c[2]);
    everywhere.push_back(on ? float(std::sin(double(c[0] + 3 * c[1] + 7 * c[2]))) : 0.0f);
    if (on)
    {
      within.push_back(everywhere.back());
    }
  }
  ASSERT_EQ(Index(within.size()), sparse.NumberOfActive());
  Blur(sparse, 1.5, within);
  Blur(dense, 1.5, everywhere);
  std::size_t packed = 0;
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    if (active(c[0], c[1], c[2]))
    {
      ASSERT_NEAR(within[packed++], everywhere[at], 1e-6);
    }
  }
}

TEST(JointSmoothing, ABallKeepsItsVolumeAndLosesItsStaircase)
{
  const Vec3 centre(24.2, 23.9, 24.1);
  const double radius = 15;
  const Volume volume(MakeLattice(48, 48, 48), 2, [&](const Vec3& x) { return int((x - centre).norm() < radius); });
  const auto results = volume.Smooth();
  EXPECT_NEAR(results[1].TightVolume / results[1].MaskVolume, 1.0, 0.01);
  // The zero level is the sphere, to a tenth of a voxel on average.
  double error = 0;
  int count = 0;
  for (Index at = 0; at < volume.Frame.Size(); ++at)
  {
    const auto c = volume.Frame.Coordinates(at);
    const double exact = radius - (volume.Frame.Position(c[0], c[1], c[2]) - centre).norm();
    if (std::abs(exact) < 1)
    {
      error += std::abs(results[1].Distance[at] - exact);
      ++count;
    }
  }
  EXPECT_LT(error / count, 0.1);
}

TEST(JointSmoothing, APlateAndARodOfTwoVoxelsStay)
{
  const Volume volume(MakeLattice(48, 48, 48), 3,
    [](const Vec3& x)
    {
      const bool across = x[0] > 8 && x[0] < 40 && x[1] > 8 && x[1] < 40;
      const bool plate = across && (x[2] == 14 || x[2] == 15);
      const bool rod = x[0] > 8 && x[0] < 40 && (x[1] == 23 || x[1] == 24) && (x[2] == 32 || x[2] == 33);
      return plate ? 1 : rod ? 2 : 0;
    });
  const auto results = volume.Smooth();
  for (const int m : { 1, 2 })
  {
    EXPECT_NEAR(results[m].TightVolume / results[m].MaskVolume, 1.0, 0.12) << volume.Materials[m].Name;
  }
  EXPECT_GT(results[1].Distance[volume.Frame.At(24, 24, 14)], 0);
  EXPECT_GT(results[2].Distance[volume.Frame.At(24, 23, 32)], 0);
}

TEST(JointSmoothing, PartsOfOneVoxelKeepTheirVolume)
{
  const auto within = [](const Vec3& x, const Vec3& first, const Vec3& last)
  { return (x - first).minCoeff() > -0.1 && (last - x).minCoeff() > -0.1; };
  for (const Vec3& spacing : { Vec3(1, 1, 1), Vec3(1, 1, 1.5) })
  {
    const Volume volume(MakeLattice(64, 48, 48, spacing), 10,
      [&](const Vec3& at)
      {
        const Vec3 x = at.cwiseQuotient(spacing);
        const double oblique = (x - Vec3(46, 14, 14)).dot(Vec3(1, 2, 3).normalized());
        return within(x, Vec3(8, 8, 10), Vec3(26, 22, 10))                         ? 1 // a plate
          : within(x, Vec3(8, 12, 20), Vec3(26, 12, 20))                           ? 2 // a rod
          : within(x, Vec3(10, 30, 10), Vec3(10, 30, 10))                          ? 3 // a voxel
          : within(x, Vec3(20, 30, 10), Vec3(21, 31, 11))                          ? 4 // eight
          : within(x, Vec3(8, 26, 30), Vec3(26, 40, 30))                           ? 5 // two plates, one on the other
          : within(x, Vec3(8, 26, 31), Vec3(26, 40, 31))                           ? 6
          : within(x, Vec3(36, 28, 28), Vec3(43, 40, 40))                          ? 7 // two blocks with a gap
          : within(x, Vec3(45, 28, 28), Vec3(52, 40, 40))                          ? 8
          : std::abs(oblique) < 0.6 && within(x, Vec3(38, 6, 6), Vec3(54, 22, 22)) ? 9 // across the grid
                                                                                   : 0;
      });
    const std::vector<double> shares = KeptShares(volume);
    for (int m = 1; m < 10; ++m)
    {
      EXPECT_NEAR(shares[m], 1.0, m == 3 ? 0.15 : m == 4 ? 0.08 : 0.05) << volume.Materials[m].Name;
    }
  }
}

TEST(JointSmoothing, GrainsOfAFewVoxelsKeepTheirVolume)
{
  // Every voxel belongs to the nearest of 60 sites: cells of a hundred voxels, and some of a few.
  std::vector<Vec3> sites;
  unsigned state = 7;
  const auto next = [&state]()
  {
    state = state * 1664525u + 1013904223u;
    return double(state >> 8) / double(1 << 24);
  };
  for (int n = 0; n < 60; ++n)
  {
    const double x = next(), y = next(), z = next();
    sites.emplace_back(17 * x, 17 * y, 17 * z);
  }
  const Volume volume(MakeLattice(30, 30, 30), 61,
    [&](const Vec3& at)
    {
      const Vec3 x = at - Vec3(6, 6, 6);
      if (x.minCoeff() < 0 || x.maxCoeff() > 17)
      {
        return 0;
      }
      const auto nearer = [&x](const Vec3& a, const Vec3& b) { return (a - x).norm() < (b - x).norm(); };
      return 1 + int(std::min_element(sites.begin(), sites.end(), nearer) - sites.begin());
    });
  const std::vector<double> shares = KeptShares(volume);
  for (int m = 1; m < 61; ++m)
  {
    EXPECT_NEAR(shares[m], 1.0, 0.05) << std::count(volume.Masks[m].begin(), volume.Masks[m].end(), 1) << " voxels";
  }
}

TEST(JointSmoothing, NeighboursShareTheirSurface)
{
  const Volume volume(MakeLattice(40, 40, 40), 3,
    [](const Vec3& x) { return (x - Vec3(20, 20, 20)).norm() > 14 ? 0
                          : x[0] < 19.5 + 0.2 * x[1] - 4          ? 1
                                                                  : 2; });
  const auto results = volume.Smooth();
  // Between 1 and 2, away from the rest, one is the other's negative.
  for (Index at = 0; at < volume.Frame.Size(); ++at)
  {
    const auto c = volume.Frame.Coordinates(at);
    const bool inner = (volume.Frame.Position(c[0], c[1], c[2]) - Vec3(20, 20, 20)).norm() < 9;
    if (inner && std::abs(results[1].Distance[at]) < 0.7)
    {
      EXPECT_NEAR(results[1].Distance[at], -results[2].Distance[at], 0.2);
    }
  }
}

TEST(JointSmoothing, SameBitsForAnyNumberOfThreads)
{
  const Volume volume(
    MakeLattice(110, 100, 100), 2, [](const Vec3& x) { return int(std::sin(x[0] / 5) * 20 + 50 > x[2]); });
  std::vector<Result> one, two;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1, "STDThread", false), [&] { one = volume.Smooth(); });
  vtkSMPTools::LocalScope(vtkSMPTools::Config(2, "STDThread", false), [&] { two = volume.Smooth(); });
  EXPECT_EQ(one[1].Distance, two[1].Distance);
}

TEST(JointSmoothing, RefusesAMaterialOnAGridOfItsOwnAndStopsOnRequest)
{
  Volume volume(MakeLattice(20, 20, 20), 2, [](const Vec3& x) { return int(x[0] > 10); });
  EXPECT_THROW(volume.Smooth(Monitor([](double, const std::string&) { return true; })), Aborted);
  volume.Materials[1].Frame.Spacing *= 0.5;
  EXPECT_THROW(volume.Smooth(), std::invalid_argument);
}
