// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "GaussianBlur.h"
#include "JointSmoothing.h"

#include <gtest/gtest.h>

#include <vtkSMPTools.h>

#include <numeric>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
/// Masks of a label function on one lattice.
struct Volume
{
  Lattice Frame;
  std::vector<std::vector<float>> Masks;
  std::vector<MaterialMask> Materials;

  Volume(const Lattice& frame, int labels, const std::function<int(const Vec3&)>& labelAt)
    : Frame(frame)
    , Masks(labels, std::vector<float>(frame.Size(), 0.0f))
  {
    for (Index at = 0; at < frame.Size(); ++at)
    {
      const auto c = frame.Coordinates(at);
      this->Masks[labelAt(frame.Position(c[0], c[1], c[2]))][at] = 1.0f;
    }
    for (int m = 0; m < labels; ++m)
    {
      this->Materials.push_back({ "Label_" + std::to_string(m), frame, this->Masks[m].data(), 0.7 });
    }
  }
  std::vector<TightenResult> Smooth() const
  {
    return SmoothJointly(this->Frame, this->Materials, JointSmoothingOptions(), Monitor());
  }
};
}

TEST(GaussianBlur, KeepsTheSumAndHasItsVariance)
{
  const Lattice frame = MakeLattice(31, 31, 31, Vec3(1, 1.5, 0.75));
  const GaussianBlur blur(frame, 2.0, std::vector<RowRange>(31 * 31, RowRange{ 0, 31 }));
  std::vector<float> field;
  blur.Clear(field);
  field[frame.At(15, 15, 15)] = 1.0f;
  blur.Apply(field);
  double sum = 0;
  Vec3 variance = Vec3::Zero();
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    const Vec3 x = frame.Position(c[0], c[1], c[2]) - frame.Position(15, 15, 15);
    sum += field[at];
    variance += field[at] * x.cwiseAbs2();
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(variance[a], 4.0, 0.15); // cut at three standard deviations
  }
}

TEST(GaussianBlur, InRangesIsWhatItIsEverywhere)
{
  const Lattice frame = MakeLattice(40, 30, 20);
  std::vector<RowRange> rows(30 * 20);
  std::vector<float> everywhere, within(frame.Size(), 1e9f); // what lies beyond the ranges must not be read
  const GaussianBlur whole(frame, 1.5, std::vector<RowRange>(30 * 20, RowRange{ 0, 40 }));
  whole.Clear(everywhere);
  for (Index k = 0; k < 20; ++k)
  {
    for (Index j = 0; j < 30; ++j)
    {
      const Index first = (j + k) / 2, last = std::min<Index>(40, first + (j * k) % 9);
      rows[j + 30 * k] = { first, last };
      for (Index i = first; i < last; ++i)
      {
        everywhere[frame.At(i, j, k)] = within[frame.At(i, j, k)] = float(std::sin(double(i + 3 * j + 7 * k)));
      }
    }
  }
  whole.Apply(everywhere);
  GaussianBlur(frame, 1.5, rows).Apply(within);
  for (Index k = 0; k < 20; ++k)
  {
    for (Index j = 0; j < 30; ++j)
    {
      for (Index i = rows[j + 30 * k].First; i < rows[j + 30 * k].Last; ++i)
      {
        ASSERT_NEAR(within[frame.At(i, j, k)], everywhere[frame.At(i, j, k)], 1e-6);
      }
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
  std::vector<TightenResult> one, two;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1, "STDThread", false), [&] { one = volume.Smooth(); });
  vtkSMPTools::LocalScope(vtkSMPTools::Config(2, "STDThread", false), [&] { two = volume.Smooth(); });
  EXPECT_EQ(one[1].Distance, two[1].Distance);
}

TEST(JointSmoothing, RefusesAMaterialOnAGridOfItsOwnAndStopsOnRequest)
{
  Volume volume(MakeLattice(20, 20, 20), 2, [](const Vec3& x) { return int(x[0] > 10); });
  EXPECT_THROW(SmoothJointly(volume.Frame, volume.Materials, JointSmoothingOptions(),
                 Monitor([](double, const std::string&) { return true; })),
    Aborted);
  volume.Materials[1].Frame.Spacing *= 0.5;
  EXPECT_THROW(volume.Smooth(), std::invalid_argument);
}
