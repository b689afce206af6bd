// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticFields.h"
#include "NarrowBand.h"
#include "VectorLoops.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;
using namespace LabelMesh::Testing;

namespace
{
/// A ball near the origin.
Sides BallMask(const Lattice& frame, double radius)
{
  Sides mask(frame.Size());
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    mask[at] = (frame.Position(c[0], c[1], c[2]) - Vec3(6.2, 7.1, 7.4)).norm() < radius;
  }
  return mask;
}
}

TEST(BitLattice, SpansAreWhatWasAdded)
{
  BitLattice bits({ 200, 3, 2 });
  const std::vector<Span> added = { { 0, 1 }, { 3, 64 }, { 65, 130 }, { 190, 200 } };
  for (const Span& span : added)
  {
    bits.Add(span, 1, 1);
  }
  std::vector<Span> found;
  FindSpans(bits.Row(1, 1), bits.WordsPerRow(), found);
  ASSERT_EQ(found.size(), added.size());
  for (std::size_t n = 0; n < found.size(); ++n)
  {
    EXPECT_EQ(found[n].First, added[n].First);
    EXPECT_EQ(found[n].Last, added[n].Last);
  }
  found.clear();
  FindSpans(bits.Row(0, 1), bits.WordsPerRow(), found);
  EXPECT_TRUE(found.empty());
}

TEST(BitLattice, DilationByABallIsAllThatIsNear)
{
  Lattice frame = MakeLattice(130, 12, 11, Vec3(1, 1.3, 0.8));
  BitLattice bits(frame.Dims);
  std::mt19937 random(3);
  std::vector<Vec3> points;
  for (int n = 0; n < 25; ++n)
  {
    const int i = int(random() % 130), j = int(random() % 12), k = int(random() % 11);
    bits.Add({ i, i + 1 }, j, k);
    points.push_back(frame.Position(i, j, k));
  }
  const double radius = 2.5;
  const BitLattice grown = Dilated(bits, BallOffsets(frame, radius));
  for (Index at = 0; at < frame.Size(); ++at)
  {
    const auto c = frame.Coordinates(at);
    const Vec3 x = frame.Position(c[0], c[1], c[2]);
    const bool near =
      std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return (p - x).norm() <= radius; });
    ASSERT_EQ(grown.Has(c[0], c[1], c[2]), near) << x.transpose();
  }
}

TEST(ForLanes, CoversEveryNumberAndNoOther)
{
  for (Index count = 0; count < 40; ++count)
  {
    std::vector<int> seen(count, 0);
    ForLanes(count,
      [&](auto lanes, Index first)
      {
        for (int l = 0; l < decltype(lanes)::Size; ++l)
        {
          seen.at(first + l) = 1;
        }
      });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
  }
}

TEST(NarrowBand, KeptAsItsPackedValuesItFlowsOnAsBefore)
{
  const Lattice frame = MakeLattice(40, 30, 28, Vec3(1, 1.1, 0.9));
  const Sides mask = BallMask(frame, 9); // its band meets the border
  NarrowBand band(frame, mask.data(), 2.5);
  const auto layout = band.Layout();
  const std::vector<float> start = band.Pack();
  const auto flow = [&](NarrowBand& narrow)
  {
    narrow.SmoothTowards(0.4, start, 0.8);
    narrow.Redistance(1.0);
  };
  flow(band);
  const std::vector<float> expected = band.Pack();
  // In memory full of something else: what is not near an active sample is not read.
  auto memory = std::make_shared<BandMemory>();
  for (BandMemory::Array* array : { &memory->Phi, &memory->Next })
  {
    std::fill_n(array->Sized(layout->Frame().Size()), layout->Frame().Size(), 1e9f);
  }
  NarrowBand again(layout, 2.5, start, memory);
  flow(again);
  EXPECT_EQ(again.Pack(), expected);
}

TEST(NarrowBand, WidenedItIsWhatItWouldBeIfWideFromTheStart)
{
  const Lattice frame = MakeLattice(40, 40, 40, Vec3(1, 1.2, 0.9), Vec3(-13, -12, -12));
  const Sides mask = BallMask(frame, 12);
  const auto distance = [&](double first, double then)
  {
    NarrowBand band(frame, mask.data(), first);
    band.SmoothKeepingSides(2.0);
    band.Redistance(2.0);
    band.Widen(mask.data(), then);
    band.Redistance(4.0);
    EXPECT_EQ(band.Layout()->NumberOfInside(), std::count(mask.begin(), mask.end(), 1));
    std::vector<float> values(mask.size());
    band.Distance(1.0, 3.5, values.data());
    return values;
  };
  const std::vector<float> widened = distance(2.5, 4.0), wide = distance(4.0, 4.0);
  for (std::size_t at = 0; at < wide.size(); ++at)
  {
    ASSERT_NEAR(widened[at], wide[at], 0.02);
  }
}
