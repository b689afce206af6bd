// SPDX-License-Identifier: BSD-3-Clause
#include "TetraLabeling.h"

#include "ManifoldLabels.h"
#include "Parallel.h"

#include <Eigen/Dense>

#include <limits>

namespace LabelMesh
{
namespace
{
constexpr double Certain = std::numeric_limits<double>::max();

/// The largest of `materials` at x, and by how much.
std::pair<MaterialId, double> LargestOf(const IndicatorSet& indicators, const MaterialSet& materials, const Vec3& x)
{
  RankedMaterial best{ NoMaterial, -Certain }, second = best;
  for (const MaterialId m : materials)
  {
    const RankedMaterial now{ m, indicators.Value(m, x) };
    if (now.Value > best.Value)
    {
      second = best;
      best = now;
    }
    else if (now.Value > second.Value)
    {
      second = now;
    }
  }
  return { best.Material, materials.Size() > 1 ? best.Value - second.Value : Certain };
}
}

MaterialSet SharedMaterials(const std::vector<Particle>& particles, const std::array<std::int32_t, 4>& corners)
{
  MaterialSet shared;
  for (const MaterialId m : particles[corners[0]].Materials)
  {
    if (!IsBorder(m) && particles[corners[1]].Materials.Contains(m) && particles[corners[2]].Materials.Contains(m) &&
      particles[corners[3]].Materials.Contains(m))
    {
      shared.Insert(m);
    }
  }
  return shared;
}

Vec3 Circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 u = b - a, v = c - a, w = d - a;
  const Vec3 vw = v.cross(w);
  const double volume = 2.0 * u.dot(vw);
  return a + (u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)) / volume;
}

TetraLabels LabelTetrahedra(
  const IndicatorSet& indicators, const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra)
{
  const Index count = tetrahedra.Size();
  const Lattice& working = indicators.Working();
  TetraLabels result;
  result.Labels.assign(count, 0);
  result.Certainty.assign(count, Certain);
  std::vector<char> empty(count, 0);
  ParallelFor(0, count, 1024,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        const auto& corners = tetrahedra.Corners[t];
        const MaterialSet shared = SharedMaterials(particles, corners);
        if (shared.Size() == 1)
        {
          result.Labels[t] = shared[0];
          continue;
        }
        const Vec3 &a = particles[corners[0]].Position, &b = particles[corners[1]].Position,
                   &c = particles[corners[2]].Position, &d = particles[corners[3]].Position;
        Vec3 x = Circumcentre(a, b, c, d);
        if (indicators.Border())
        {
          // All tetrahedra lie within the box; the fields beyond it are made up.
          x = indicators.Border()->Clamped(x);
        }
        const Vec3 index = working.ToIndex(x);
        const bool inside = (index.array() >= 0).all() && index[0] <= working.Dims[0] - 1 &&
          index[1] <= working.Dims[1] - 1 && index[2] <= working.Dims[2] - 1;
        if (shared.Size() == 0)
        {
          empty[t] = 1;
          const MaterialId largest = indicators.LargestMaterial(0.25 * (a + b + c + d));
          result.Labels[t] = IsBorder(largest) ? indicators.Background() : largest;
          continue;
        }
        if (!inside && shared.Contains(indicators.Background()))
        {
          result.Labels[t] = indicators.Background();
          continue;
        }
        auto largest = LargestOf(indicators, shared, x);
        if (largest.second <= 0.0)
        {
          // All equally far below: the circumcentre lies deep in a material that the corners do not share.
          largest = LargestOf(indicators, shared, 0.25 * (a + b + c + d));
        }
        result.Labels[t] = largest.first;
        result.Certainty[t] = largest.second;
      }
    });
  result.EmptySets = std::count(empty.begin(), empty.end(), 1);
  return result;
}

bool IsWrong(const std::vector<Particle>& particles, const InterfaceTriangle& face)
{
  for (const Index v : face.Vertices)
  {
    if (!particles[v].Materials.Contains(face.Materials[0]) || !particles[v].Materials.Contains(face.Materials[1]))
    {
      return true;
    }
  }
  return false;
}

namespace
{
/// What lies beyond a face of the hull: the space beyond the face of the volume's box that all its vertices lie on, or
/// `outside`.
MaterialId BeyondHull(const std::vector<Particle>& particles, const std::array<Index, 3>& vertices, MaterialId outside)
{
  for (const MaterialId m : particles[vertices[0]].Materials)
  {
    if (IsBorder(m) && particles[vertices[1]].Materials.Contains(m) && particles[vertices[2]].Materials.Contains(m))
    {
      return m;
    }
  }
  return outside;
}
}

std::vector<InterfaceTriangle> InterfaceFaces(const std::vector<Particle>& particles,
  const Tetrahedralization& tetrahedra, const TetraLabels& labels, MaterialId outside)
{
  // The corners of the face opposite each corner.
  constexpr int faces[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };
  constexpr Index chunk = 4096;
  const Index count = tetrahedra.Size();
  return ParallelCollect<InterfaceTriangle>((count + chunk - 1) / chunk,
    [&](Index c, std::vector<InterfaceTriangle>& found)
    {
      for (Index t = c * chunk; t < std::min(count, (c + 1) * chunk); ++t)
      {
        const auto& corners = tetrahedra.Corners[t];
        for (int j = 0; j < 4; ++j)
        {
          const std::int32_t neighbor = tetrahedra.Neighbors[t][j];
          const MaterialId other = neighbor < 0 ? outside : labels.Labels[neighbor];
          if ((neighbor >= 0 && neighbor < t) || other == labels.Labels[t])
          {
            continue;
          }
          InterfaceTriangle face;
          face.Materials = { labels.Labels[t], other };
          for (int v = 0; v < 3; ++v)
          {
            face.Vertices[v] = corners[faces[j][v]];
          }
          if (neighbor < 0)
          {
            face.Materials[1] = BeyondHull(particles, face.Vertices, outside);
          }
          const Vec3& a = particles[face.Vertices[0]].Position;
          const Vec3 normal =
            (particles[face.Vertices[1]].Position - a).cross(particles[face.Vertices[2]].Position - a);
          if (normal.dot(particles[corners[j]].Position - a) > 0)
          {
            std::swap(face.Vertices[1], face.Vertices[2]);
          }
          found.push_back(face);
        }
      }
    });
}

InterfaceComplex BuildInterface(const IndicatorSet& indicators, const std::vector<Particle>& particles,
  const std::vector<char>& core, const Monitor& monitor)
{
  std::vector<Vec3> points;
  points.reserve(particles.size());
  for (const Particle& p : particles)
  {
    points.push_back(p.Position);
  }
  InterfaceComplex complex;
  monitor.Step(0.0, "Tetrahedralising");
  complex.Tetrahedra = DelaunayTetrahedra(points, monitor.Part(0.0, 0.5));
  monitor.Step(0.5, "Labelling tetrahedra");
  complex.Labels = LabelTetrahedra(indicators, particles, complex.Tetrahedra);
  const MaterialId outside = indicators.Background() != NoMaterial ? indicators.Background() : MaterialId(0);
  monitor.Step(0.7, "Labelling tetrahedra");
  MakeManifold(particles, complex.Tetrahedra, outside, core, complex.Labels);
  monitor.Step(0.9, "Labelling tetrahedra");
  complex.Faces = InterfaceFaces(particles, complex.Tetrahedra, complex.Labels, outside);
  return complex;
}
}
