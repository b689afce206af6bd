// SPDX-License-Identifier: BSD-3-Clause
#include "TetraSliding.h"

#include "BoxTree.h"
#include "InterfaceMesh.h"
#include "SelfIntersections.h"
#include "TetraFlips.h"

#include <algorithm>

namespace LabelMesh
{
namespace
{
constexpr double LeastTurn = 0.8; // cosine of how far a triangle may turn
constexpr int Halvings = 3;       // of a move that spoils triangles

using Triangles = std::vector<FaceCorners>;

/// The triangles of the interface at a vertex, from the tetrahedra at it; `outer`: those against the background alone.
Triangles TrianglesAt(const TetraComplex& complex, const std::vector<std::int32_t>& star, Index v, bool outer)
{
  Triangles triangles;
  for (const std::int32_t t : star)
  {
    for (int j = 0; j < 4; ++j)
    {
      const std::int32_t beyond = outer ? complex.Neighbor(t, j) : complex.Inside(t, j);
      if (complex.Corners(t)[j] != v && beyond < 0)
      {
        triangles.push_back(FaceOpposite(complex.Corners(t), j));
      }
    }
  }
  return triangles;
}

Box BoxOf(const TetraComplex& complex, const FaceCorners& triangle)
{
  Box box;
  for (const std::int32_t v : triangle)
  {
    box.Add(complex.Point(v));
  }
  return box;
}

std::vector<Vec3> NormalsOf(const TetraComplex& complex, const Triangles& triangles)
{
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : triangles)
  {
    normals.push_back(
      (complex.Point(b) - complex.Point(a)).cross(complex.Point(c) - complex.Point(a)).stableNormalized());
  }
  return normals;
}

double WorstRatio(const TetraComplex& complex, const Triangles& triangles)
{
  double worst = 1.0;
  for (const auto& [a, b, c] : triangles)
  {
    worst = std::min(worst, RadiusRatio(complex.Point(a), complex.Point(b), complex.Point(c)));
  }
  return worst;
}

double MeanEdge(const TetraComplex& complex, const Triangles& triangles, Index v)
{
  double sum = 0.0;
  for (const FaceCorners& triangle : triangles)
  {
    for (const std::int32_t c : triangle)
    {
      sum += (complex.Point(c) - complex.Point(v)).norm();
    }
  }
  return triangles.empty() ? 0.0 : sum / double(2 * triangles.size());
}

/// Where a vertex may go, the faces of the box included that it lies in.
MoveRegion RegionAround(const Vec3& x, double radius, const std::optional<VolumeBox>& box)
{
  MoveRegion region{ x, radius };
  for (int a = 0; a < 3 && box; ++a)
  {
    region.Fixed[a] = x[a] == box->Low[a] || x[a] == box->High[a];
  }
  return region;
}
}

/// The triangles against the background, to ask whether a moved one cuts others. They may have moved themselves since
/// they were listed, by `farthest` at most.
class TetraSliding::OuterTriangles
{
public:
  OuterTriangles(const TetraComplex& complex, double farthest)
    : Complex(complex)
    , All(List(complex))
    , Tree(Boxes(complex, this->All))
    , Farthest(farthest)
  {
  }

  bool AreCutBy(const Triangles& moved) const
  {
    Box box;
    for (const FaceCorners& triangle : moved)
    {
      box.Add(BoxOf(this->Complex, triangle));
    }
    box.Low.array() -= this->Farthest;
    box.High.array() += this->Farthest;
    std::vector<FaceCorners> near;
    this->Tree.VisitOverlaps(box, 0, [&](Index at) { near.push_back(this->All[this->Tree.Number(at)]); });
    for (const FaceCorners& a : moved)
    {
      for (const FaceCorners& b : near)
      {
        if (!SameCorners(a, b) && this->Cut(a, b))
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  static Triangles List(const TetraComplex& complex)
  {
    Triangles all;
    for (Index t = 0; t < complex.Size(); ++t)
    {
      for (int j = 0; j < 4 && complex.IsAlive(t); ++j)
      {
        if (complex.Neighbor(t, j) < 0)
        {
          all.push_back(FaceOpposite(complex.Corners(t), j));
        }
      }
    }
    return all;
  }
  static std::vector<Box> Boxes(const TetraComplex& complex, const Triangles& all)
  {
    std::vector<Box> boxes;
    for (const FaceCorners& triangle : all)
    {
      boxes.push_back(BoxOf(complex, triangle));
    }
    return boxes;
  }
  static bool SameCorners(FaceCorners a, FaceCorners b)
  {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  }
  bool Cut(const FaceCorners& a, const FaceCorners& b) const
  {
    return BoxOf(this->Complex, a).Overlaps(BoxOf(this->Complex, b)) &&
      TrianglesIntersect(this->Complex.Points(), { a[0], a[1], a[2] }, { b[0], b[1], b[2] });
  }

  const TetraComplex& Complex;
  Triangles All;
  BoxTree Tree;
  double Farthest;
};

std::vector<TetraSliding::Site> TetraSliding::FindSites() const
{
  std::vector<std::int32_t> bad;
  for (Index t = 0; t < this->Complex.Size(); ++t)
  {
    if (this->Complex.IsAlive(t) && this->Complex.Quality(t) < this->Options.Below)
    {
      bad.push_back(std::int32_t(t));
    }
  }
  std::stable_sort(bad.begin(), bad.end(),
    [this](std::int32_t a, std::int32_t b) { return this->Complex.Quality(a) < this->Complex.Quality(b); });
  std::vector<Site> sites;
  std::vector<char> found(std::size_t(this->Complex.NumberOfPoints()), 0);
  for (const std::int32_t t : bad)
  {
    for (const std::int32_t v : this->Complex.Corners(t))
    {
      if (this->Complex.IsFixed(v) && !found[v])
      {
        found[v] = 1;
        sites.push_back({ v, {} });
      }
    }
  }
  return sites;
}

void TetraSliding::FindStars(std::vector<Site>& sites) const
{
  // Not by walking from one tetrahedron to the next: where surfaces touch themselves that does not reach all.
  std::vector<std::int32_t> numbers(std::size_t(this->Complex.NumberOfPoints()), -1);
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    numbers[sites[n].Vertex] = std::int32_t(n);
  }
  for (Index t = 0; t < this->Complex.Size(); ++t)
  {
    for (int j = 0; j < 4 && this->Complex.IsAlive(t); ++j)
    {
      const std::int32_t n = numbers[this->Complex.Corners(t)[j]];
      if (n >= 0)
      {
        sites[n].Star.push_back(std::int32_t(t));
      }
    }
  }
}

bool TetraSliding::Slide(const Site& site, OuterTriangles& outer)
{
  const std::int32_t v = site.Vertex;
  const Triangles triangles = TrianglesAt(this->Complex, site.Star, v, false);
  const Triangles outside = TrianglesAt(this->Complex, site.Star, v, true);
  const std::vector<Vec3> normals = NormalsOf(this->Complex, triangles);
  const double leastRatio = std::min(this->Options.LeastRatio, WorstRatio(this->Complex, triangles));
  const Vec3 before = this->Complex.Point(v);
  const double reach = this->Options.Reach * MeanEdge(this->Complex, triangles, v);
  const MoveRegion region = this->Regions.emplace(v, RegionAround(before, reach, this->Options.Box)).first->second;

  std::vector<OpenTetra> faces;
  FacesAround(this->Complex, site.Star, v, faces);
  Vec3 after = before;
  RaiseWorst(faces, after, &region);
  const double least = WorstQuality(faces, before) + LeastRise;
  for (int attempt = 0; attempt <= Halvings; ++attempt)
  {
    const Vec3 x = before + std::ldexp(1.0, -attempt) * (after - before);
    if (!(WorstQuality(faces, x) > least))
    {
      continue;
    }
    this->Complex.MovePoint(v, x, site.Star);
    const std::vector<Vec3> turned = NormalsOf(this->Complex, triangles);
    const bool faceAlike = std::equal(normals.begin(), normals.end(), turned.begin(),
      [](const Vec3& a, const Vec3& b) { return a.dot(b) > LeastTurn; });
    if (faceAlike && WorstRatio(this->Complex, triangles) >= leastRatio && !outer.AreCutBy(outside))
    {
      return true;
    }
    this->Complex.MovePoint(v, before, site.Star);
  }
  return false;
}

Index TetraSliding::Round()
{
  std::vector<Site> sites = this->FindSites();
  if (sites.empty())
  {
    return 0;
  }
  this->FindStars(sites);
  double farthest = 0.0;
  for (const Site& site : sites)
  {
    const Triangles triangles = TrianglesAt(this->Complex, site.Star, site.Vertex, false);
    farthest = std::max(farthest, 2.0 * this->Options.Reach * MeanEdge(this->Complex, triangles, site.Vertex));
  }
  OuterTriangles outer(this->Complex, farthest);
  Index moved = 0;
  for (const Site& site : sites)
  {
    moved += this->Slide(site, outer);
  }
  return moved;
}
}
