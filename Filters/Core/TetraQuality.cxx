// SPDX-License-Identifier: BSD-3-Clause
#include "TetraQuality.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LabelMesh
{
namespace
{
/// What all measures are made of. The index of a face is that of the corner opposite.
struct Shape
{
  std::array<Vec3, 4> Normals;   // outward, twice as long as the face is large
  std::array<double, 4> Areas;   // lengths of the normals
  std::array<double, 6> Squares; // of the lengths of TetraEdges
  double Volume6;

  Shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
  {
    const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
    this->Normals = { bc.cross(bd), ad.cross(ac), ab.cross(ad), ac.cross(ab) };
    for (int f = 0; f < 4; ++f)
    {
      this->Areas[f] = this->Normals[f].norm();
    }
    this->Squares = { ab.squaredNorm(), ac.squaredNorm(), ad.squaredNorm(), bc.squaredNorm(), bd.squaredNorm(),
      cd.squaredNorm() };
    this->Volume6 = -this->Normals[3].dot(ad);
  }

  bool HasAreas() const { return *std::min_element(this->Areas.begin(), this->Areas.end()) > 0.0; }

  /// The faces at an edge are those opposite the edge's other two corners.
  static std::array<int, 2> FacesAt(int edge) { return TetraEdges[5 - edge]; }

  /// The sine at an edge, times its weight, over Volume6.
  double SineByVolume(int edge) const
  {
    const auto [f, g] = FacesAt(edge);
    const double sine = std::sqrt(this->Squares[edge]) / (this->Areas[f] * this->Areas[g]);
    return this->Normals[f].dot(this->Normals[g]) > 0.0 ? ObtuseWeight * sine : sine;
  }

  double AreaSum() const { return this->Areas[0] + this->Areas[1] + this->Areas[2] + this->Areas[3]; }

  /// Squares of the products of opposite edges; the circumradius is sqrt(Crelle(products)) / (4 Volume6).
  Vec3 OppositeProducts() const
  {
    return { this->Squares[0] * this->Squares[5], this->Squares[1] * this->Squares[4],
      this->Squares[2] * this->Squares[3] };
  }
  static double Crelle(const Vec3& products)
  {
    const double sum = products.sum();
    return std::max(0.0, sum * sum - 2.0 * products.squaredNorm());
  }

  double RadiusRatio() const
  {
    const double below = this->AreaSum() * std::sqrt(Crelle(this->OppositeProducts()));
    return below > 0.0 ? 12.0 * this->Volume6 * std::abs(this->Volume6) / below : 0.0;
  }
};
}

double SignedVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

double TetraRadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return Shape(a, b, c, d).RadiusRatio();
}

std::array<double, 6> DihedralAngles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  constexpr double degrees = 57.295779513082320877;
  const Shape shape(a, b, c, d);
  std::array<double, 6> angles;
  for (int edge = 0; edge < 6; ++edge)
  {
    const auto [f, g] = Shape::FacesAt(edge);
    const double sine = std::abs(shape.Volume6) * std::sqrt(shape.Squares[edge]);
    angles[edge] =
      shape.Areas[f] * shape.Areas[g] > 0.0 ? degrees * std::atan2(sine, -shape.Normals[f].dot(shape.Normals[g])) : 0.0;
  }
  return angles;
}

double TetraQuality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Shape shape(a, b, c, d);
  if (!shape.HasAreas())
  {
    return -1.0;
  }
  double least = RadiusRatioWeight * shape.RadiusRatio();
  for (int edge = 0; edge < 6; ++edge)
  {
    least = std::min(least, shape.Volume6 * shape.SineByVolume(edge));
  }
  return least;
}

std::array<QualityTerm, 7> QualityTerms(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Shape shape(a, b, c, d);
  // Relative growths: the gradient of a product or quotient is its value times their sum or difference. Not that of
  // the volume, which may be 0.
  const Vec3 volume = -shape.Normals[3];
  const std::array<Vec3, 3> edges = { c - b, a - c, b - a }; // of the base, each in a face with d
  const std::array<Vec3, 3> toD = { d - a, d - b, d - c };
  std::array<Vec3, 4> area;
  Vec3 areaSum = Vec3::Zero();
  for (int f = 0; f < 3; ++f)
  {
    const Vec3 growth = shape.Normals[f].cross(edges[f]) / shape.Areas[f];
    area[f] = growth / shape.Areas[f];
    areaSum += growth;
  }
  area[3] = Vec3::Zero();

  std::array<QualityTerm, 7> terms;
  for (int edge = 0; edge < 6; ++edge)
  {
    const auto [f, g] = Shape::FacesAt(edge);
    Vec3 growth = -area[f] - area[g];
    if (TetraEdges[edge][1] == 3)
    {
      growth += toD[TetraEdges[edge][0]] / shape.Squares[edge];
    }
    const double factor = shape.SineByVolume(edge);
    terms[edge].Value = shape.Volume6 * factor;
    terms[edge].Gradient = factor * volume + terms[edge].Value * growth;
  }
  const Vec3 products = shape.OppositeProducts();
  const double crelle = Shape::Crelle(products);
  const std::array<double, 3> opposite = { shape.Squares[3], shape.Squares[1], shape.Squares[0] }; // of edges at d
  const std::array<double, 3> slopes = { products.sum() - 2.0 * products[2], products.sum() - 2.0 * products[1],
    products.sum() - 2.0 * products[0] };
  Vec3 crelleGrowth = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
  {
    crelleGrowth += 4.0 * slopes[i] * opposite[i] * toD[i];
  }
  const double factor = crelle > 0.0 ? RadiusRatioWeight * 12.0 / (shape.AreaSum() * std::sqrt(crelle)) : 0.0;
  terms[6].Value = factor * shape.Volume6 * shape.Volume6;
  terms[6].Gradient = crelle > 0.0 ? Vec3(2.0 * factor * shape.Volume6 * volume -
                                       terms[6].Value * (areaSum / shape.AreaSum() + 0.5 / crelle * crelleGrowth))
                                   : Vec3(Vec3::Zero());
  return terms;
}
}
