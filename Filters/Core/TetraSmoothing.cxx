// SPDX-License-Identifier: BSD-3-Clause
#include "TetraSmoothing.h"

#include "Parallel.h"
#include "TetraQuality.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <numeric>

namespace LabelMesh
{
namespace
{
constexpr double LeastGain = 1e-3;  // of quality: less is not worth another step
constexpr int Steps = 8;            // of RaiseWorst
constexpr int Halvings = 4;         // of a step that does not help
constexpr double ActiveBand = 0.02; // terms so much above the lowest have a say in the direction
constexpr double LongestStep = 0.5; // of the distance to the nearest corner

/// The shortest vector in the convex hull of some vectors, near enough (Gilbert 1966).
Vec3 ShortestInHull(const std::vector<Vec3>& vectors)
{
  constexpr int most = 30;
  Vec3 shortest = vectors.front();
  for (int n = 0; n < most; ++n)
  {
    const Vec3* lowest = &vectors.front();
    for (const Vec3& v : vectors)
    {
      lowest = v.dot(shortest) < lowest->dot(shortest) ? &v : lowest;
    }
    const Vec3 way = *lowest - shortest;
    const double fall = -way.dot(shortest);
    if (fall <= 1e-3 * shortest.squaredNorm())
    {
      break;
    }
    shortest += std::min(1.0, fall / way.squaredNorm()) * way;
  }
  return shortest;
}

/// The direction in which all terms near the lowest grow, longest where they grow together; and the step after which,
/// by the slopes, another term is the lowest.
struct Ascent
{
  Vec3 Direction;
  double Step;
};

Ascent SteepestAscent(const std::vector<OpenTetra>& faces, const Vec3& x, double lowest)
{
  thread_local std::vector<QualityTerm> terms;
  thread_local std::vector<Vec3> active;
  terms.clear();
  active.clear();
  for (const auto& [a, b, c] : faces)
  {
    for (const QualityTerm& term : QualityTerms(a, b, c, x))
    {
      (term.Value < lowest + ActiveBand ? active.push_back(term.Gradient) : terms.push_back(term));
    }
  }
  Ascent ascent{ ShortestInHull(active), std::numeric_limits<double>::infinity() };
  const double growth = ascent.Direction.squaredNorm();
  for (const QualityTerm& term : terms)
  {
    const double slope = term.Gradient.dot(ascent.Direction);
    if (slope < growth)
    {
      ascent.Step = std::min(ascent.Step, (term.Value - lowest) / (growth - slope));
    }
  }
  return ascent;
}

double NearestCorner(const std::vector<OpenTetra>& faces, const Vec3& x)
{
  double squared = std::numeric_limits<double>::infinity();
  for (const OpenTetra& face : faces)
  {
    for (const Vec3& corner : face)
    {
      squared = std::min(squared, (corner - x).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

/// The sum of eta^2 over the tetrahedra at x, where eta, the inverse mean ratio, is the sum of squared lengths over
/// 12 (3 volume)^(2/3): 1 for regular tetrahedra, infinite for flat ones.
struct MeanRatioEnergy
{
  double Value = 0.0;
  Vec3 Gradient = Vec3::Zero();
  Mat3 Hessian = Mat3::Zero();

  static double Eta(const OpenTetra& face, const Vec3& x)
  {
    const auto& [a, b, c] = face;
    const double volume3 = 3.0 * SignedVolume(a, b, c, x);
    if (!(volume3 > 0.0))
    {
      return std::numeric_limits<double>::infinity();
    }
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm() +
      (x - a).squaredNorm() + (x - b).squaredNorm() + (x - c).squaredNorm();
    const double root = std::cbrt(volume3);
    return squares / (12.0 * root * root);
  }

  void Add(const OpenTetra& face, const Vec3& x)
  {
    const auto& [a, b, c] = face;
    const double eta = Eta(face, x);
    if (!std::isfinite(eta))
    {
      return;
    }
    const Vec3 area = (b - a).cross(c - a);
    const Vec3 volume = area / area.dot(x - a); // relative growth of the volume
    const Vec3 toX = 3.0 * x - a - b - c;
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm() +
      (x - a).squaredNorm() + (x - b).squaredNorm() + (x - c).squaredNorm();
    const Vec3 square = 2.0 / squares * toX; // relative growth of the sum of squares
    const Vec3 growth = square - 2.0 / 3.0 * volume;
    // eta^2: twice the relative growth.
    const double energy = eta * eta;
    this->Value += energy;
    this->Gradient += 2.0 * energy * growth;
    this->Hessian += energy *
      (4.0 * growth * growth.transpose() +
        2.0 *
          (6.0 / squares * Mat3::Identity() - square * square.transpose() + 2.0 / 3.0 * volume * volume.transpose()));
  }
};

/// Whether x is better than a sum of eta^2 of `energy`, with no quality below `least`.
bool IsBetter(const std::vector<OpenTetra>& faces, const Vec3& x, double energy, double least)
{
  double sum = 0.0;
  for (const OpenTetra& face : faces)
  {
    const double eta = MeanRatioEnergy::Eta(face, x);
    sum += eta * eta;
    if (!(sum < energy))
    {
      return false;
    }
  }
  return WorstQuality(faces, x) >= least;
}

/// The tetrahedra at each vertex inside a material, for as long as none comes or goes: those at v are
/// Tetrahedra[Begin[v]] to Tetrahedra[Begin[v + 1]].
struct AllStars
{
  std::vector<Index> Begin;
  std::vector<std::int32_t> Tetrahedra;

  explicit AllStars(const TetraComplex& complex)
    : Begin(std::size_t(complex.NumberOfPoints()) + 1, 0)
  {
    EachCorner(complex, [this](Index, std::int32_t v) { ++this->Begin[v + 1]; });
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    this->Tetrahedra.resize(std::size_t(this->Begin.back()));
    std::vector<Index> next(this->Begin.begin(), this->Begin.end() - 1);
    EachCorner(complex, [&](Index t, std::int32_t v) { this->Tetrahedra[next[v]++] = std::int32_t(t); });
  }

  void Get(Index v, std::vector<std::int32_t>& star) const
  {
    star.assign(this->Tetrahedra.begin() + this->Begin[v], this->Tetrahedra.begin() + this->Begin[v + 1]);
  }

private:
  template <typename Visit>
  static void EachCorner(const TetraComplex& complex, Visit&& visit)
  {
    for (Index t = 0; t < complex.Size(); ++t)
    {
      for (int j = 0; j < 4 && complex.IsAlive(t); ++j)
      {
        const std::int32_t v = complex.Corners(t)[j];
        if (!complex.IsFixed(v))
        {
          visit(t, v);
        }
      }
    }
  }
};

bool SmoothByNewton(TetraComplex& complex, const AllStars& stars, Index v, double floor)
{
  constexpr double leastFall = 1e-3, shortest = 1e-2; // of the energy; of the distance to the nearest corner
  constexpr int halvings = 2;
  thread_local std::vector<std::int32_t> star;
  thread_local std::vector<OpenTetra> faces;
  stars.Get(v, star);
  FacesAround(complex, star, v, faces);
  const Vec3 x = complex.Point(v);
  MeanRatioEnergy energy;
  double worst = floor;
  for (std::size_t n = 0; n < faces.size(); ++n)
  {
    energy.Add(faces[n], x);
    worst = std::min(worst, complex.Quality(star[n]));
  }
  Vec3 step = -energy.Hessian.ldlt().solve(energy.Gradient);
  const double scale = NearestCorner(faces, x), length = step.norm();
  if (!(length > shortest * scale) || !(step.dot(energy.Gradient) < 0.0))
  {
    return false;
  }
  step *= std::min(1.0, LongestStep * scale / length);
  for (int attempt = 0; attempt <= halvings; ++attempt, step *= 0.5)
  {
    if (IsBetter(faces, x + step, energy.Value * (1.0 - leastFall), worst))
    {
      complex.MovePoint(v, x + step, star);
      return true;
    }
  }
  return false;
}

/// Sets of vertices inside materials of which no two are joined: each vertex gets the first colour that none around
/// it has.
std::vector<std::vector<std::int32_t>> IndependentSets(const TetraComplex& complex, const AllStars& stars)
{
  constexpr std::uint8_t none = 255;
  std::vector<std::uint8_t> colors(std::size_t(complex.NumberOfPoints()), none);
  std::vector<std::vector<std::int32_t>> sets;
  for (Index v = 0; v < complex.NumberOfPoints(); ++v)
  {
    if (complex.IsFixed(v))
    {
      continue;
    }
    std::array<bool, 256> taken{};
    for (Index n = stars.Begin[v]; n < stars.Begin[v + 1]; ++n)
    {
      for (const std::int32_t other : complex.Corners(stars.Tetrahedra[n]))
      {
        taken[colors[other]] = true;
      }
    }
    // Should all be taken, the last is shared, and the vertex stays where it is.
    const std::size_t color = std::size_t(std::find(taken.begin(), taken.begin() + none, false) - taken.begin());
    if (color == none)
    {
      continue;
    }
    colors[v] = std::uint8_t(color);
    sets.resize(std::max(sets.size(), color + 1));
    sets[color].push_back(std::int32_t(v));
  }
  return sets;
}
}

double WorstQuality(const std::vector<OpenTetra>& faces, const Vec3& x)
{
  double worst = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : faces)
  {
    worst = std::min(worst, TetraQuality(a, b, c, x));
  }
  return worst;
}

Vec3 MoveRegion::Nearest(const Vec3& x) const
{
  Vec3 way = x - this->Centre;
  for (int a = 0; a < 3; ++a)
  {
    way[a] = this->Fixed[a] ? 0.0 : way[a];
  }
  const double length = way.norm();
  return this->Centre + (length > this->Radius ? this->Radius / length : 1.0) * way;
}

double RaiseWorst(const std::vector<OpenTetra>& faces, Vec3& x, const MoveRegion* region)
{
  double worst = WorstQuality(faces, x);
  for (int n = 0; n < Steps; ++n)
  {
    const auto [direction, step] = SteepestAscent(faces, x, worst);
    const double growth = direction.squaredNorm(), scale = NearestCorner(faces, x);
    if (!(growth * scale * scale > LeastGain * LeastGain) || !std::isfinite(growth))
    {
      break;
    }
    const double before = worst;
    const double longest = LongestStep * scale / std::sqrt(growth);
    double length = std::min(step, longest);
    for (int attempt = 0; attempt <= Halvings; ++attempt, length *= 0.5)
    {
      const Vec3 straight = x + length * direction;
      const Vec3 moved = region ? region->Nearest(straight) : straight;
      const double now = WorstQuality(faces, moved);
      if (now > worst)
      {
        worst = now;
        x = moved;
        break;
      }
    }
    if (worst < before + LeastGain)
    {
      break;
    }
  }
  return worst;
}

void FacesAround(
  const TetraComplex& complex, const std::vector<std::int32_t>& star, Index v, std::vector<OpenTetra>& faces)
{
  faces.clear();
  for (const std::int32_t t : star)
  {
    const FaceCorners face = FaceOpposite(complex.Corners(t), complex.CornerOf(t, v));
    faces.push_back({ complex.Point(face[0]), complex.Point(face[1]), complex.Point(face[2]) });
  }
}

bool RaiseWorstAt(TetraComplex& complex, Index v)
{
  thread_local std::vector<std::int32_t> star;
  thread_local std::vector<OpenTetra> faces;
  complex.Star(v, star);
  FacesAround(complex, star, v, faces);
  Vec3 x = complex.Point(v);
  const double before = WorstQuality(faces, x);
  if (!(RaiseWorst(faces, x) > before + LeastGain))
  {
    return false;
  }
  complex.MovePoint(v, x, star);
  return true;
}

Index SmoothAll(TetraComplex& complex, double floor)
{
  Index moves = 0;
  const AllStars stars(complex);
  for (const std::vector<std::int32_t>& set : IndependentSets(complex, stars))
  {
    std::vector<char> moved(set.size(), 0);
    ParallelFor(0, Index(set.size()), 256,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          moved[n] = SmoothByNewton(complex, stars, set[n], floor);
        }
      });
    moves += std::count(moved.begin(), moved.end(), char(1));
  }
  return moves;
}
}
