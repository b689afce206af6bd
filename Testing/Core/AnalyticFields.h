// SPDX-License-Identifier: BSD-3-Clause
// Indicator sets sampled from analytic functions: the truth that the unit tests of Core compare with.
#ifndef AnalyticFields_h
#define AnalyticFields_h

#include "IndicatorSet.h"

#include <functional>
#include <memory>
#include <vector>

namespace LabelMesh::Testing
{
using Field = std::function<double(const Vec3&)>;

inline Lattice MakeLattice(
  int nx, int ny, int nz, const Vec3& spacing = Vec3::Ones(), const Vec3& origin = Vec3::Zero())
{
  Lattice lattice;
  lattice.Dims = { nx, ny, nz };
  lattice.Spacing = spacing;
  lattice.Origin = origin;
  return lattice;
}

/// Owns the samples that its IndicatorSet looks at. Labels are 0, 1, 2 ...; 0 is the background.
class SampledFields
{
public:
  SampledFields(
    const Lattice& lattice, const std::vector<Field>& fields, const std::optional<VolumeBox>& border = std::nullopt)
    : Samples(fields.size())
  {
    std::vector<IndicatorBlock> blocks(fields.size());
    for (std::size_t m = 0; m < fields.size(); ++m)
    {
      this->Samples[m].resize(lattice.Size());
      for (Index at = 0; at < lattice.Size(); ++at)
      {
        const auto c = lattice.Coordinates(at);
        this->Samples[m][at] = float(fields[m](lattice.Position(c[0], c[1], c[2])));
      }
      blocks[m].Label = Label(m);
      blocks[m].Frame = lattice;
      blocks[m].Values = this->Samples[m].data();
      blocks[m].Outside = m == 0 ? 100.0 : -100.0;
    }
    this->Set = std::make_unique<IndicatorSet>(std::move(blocks), 0, lattice, border);
  }
  const IndicatorSet& operator*() const { return *this->Set; }
  const IndicatorSet* operator->() const { return this->Set.get(); }

private:
  std::vector<std::vector<float>> Samples;
  std::unique_ptr<IndicatorSet> Set;
};

inline Field Ball(const Vec3& centre, double radius)
{
  return [=](const Vec3& x) { return radius - (x - centre).norm(); };
}
inline Field Not(const Field& f)
{
  return [=](const Vec3& x) { return -f(x); };
}
/// A ball cut in two by the plane through its centre, material 1 above and 2 below: three interfaces that meet along a
/// circle.
inline SampledFields HalvedBall(const Lattice& frame, const Vec3& centre, double radius)
{
  const Field ball = Ball(centre, radius);
  return SampledFields(frame,
    { Not(ball), [=](const Vec3& x) { return std::min(ball(x), x[2] - centre[2]); },
      [=](const Vec3& x) { return std::min(ball(x), centre[2] - x[2]); } });
}
/// The distance to the sites of a Voronoi diagram, negated: its differences are zero on the Voronoi walls.
inline Field Site(const Vec3& site)
{
  return [=](const Vec3& x) { return -(x - site).norm(); };
}
}

#endif
