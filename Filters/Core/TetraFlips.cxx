// SPDX-License-Identifier: BSD-3-Clause
#include "TetraFlips.h"

#include <algorithm>
#include <limits>

namespace LabelMesh
{
namespace
{
constexpr int LargestRing = 10; // tetrahedra around an edge that is taken out
constexpr int MostFaces = 8;    // between two vertices that are joined

double WorstOf(const TetraComplex& complex, const std::vector<std::int32_t>& tetrahedra)
{
  double worst = std::numeric_limits<double>::infinity();
  for (const std::int32_t t : tetrahedra)
  {
    worst = std::min(worst, complex.Quality(t));
  }
  return worst;
}

/// The best triangulation of the polygon around an edge.
class RingTriangulation
{
public:
  RingTriangulation(const TetraComplex& complex, std::int32_t first, std::int32_t second,
    const std::vector<std::int32_t>& vertices, double before)
    : Complex(complex)
    , First(first)
    , Second(second)
    , Vertices(vertices)
  {
    const int size = int(vertices.size());
    for (int i = 0; i + 1 < size; ++i)
    {
      this->Worst[i][i + 1] = std::numeric_limits<double>::infinity();
    }
    for (int length = 2; length < size; ++length)
    {
      for (int i = 0; i + length < size; ++i)
      {
        this->Join(i, i + length, before);
      }
    }
  }

  /// The lowest quality of its tetrahedra; at most `before` where no triangulation is better than that.
  double Quality() const { return this->Worst[0][this->Vertices.size() - 1]; }

  void Append(std::vector<TetraCorners>& added) const { this->Append(0, int(this->Vertices.size()) - 1, added); }

private:
  /// The polygon of vertices i to j.
  void Join(int i, int j, double before)
  {
    const auto& v = this->Vertices;
    this->Worst[i][j] = -std::numeric_limits<double>::infinity();
    this->Middle[i][j] = -1;
    for (int k = i + 1; k < j; ++k)
    {
      // Nothing that is no better needs to be computed to its end.
      const double enough = std::max(before, this->Worst[i][j]);
      double worst = std::min(this->Worst[i][k], this->Worst[k][j]);
      if (worst > enough)
      {
        worst = std::min(worst, this->Complex.QualityOf({ v[i], v[k], v[j], this->Second }));
      }
      if (worst > enough)
      {
        worst = std::min(worst, this->Complex.QualityOf({ v[i], v[j], v[k], this->First }));
      }
      if (worst > enough)
      {
        this->Worst[i][j] = worst;
        this->Middle[i][j] = k;
      }
    }
  }
  void Append(int i, int j, std::vector<TetraCorners>& added) const
  {
    if (j > i + 1)
    {
      const auto& v = this->Vertices;
      const int k = this->Middle[i][j];
      added.push_back({ v[i], v[k], v[j], this->Second });
      added.push_back({ v[i], v[j], v[k], this->First });
      this->Append(i, k, added);
      this->Append(k, j, added);
    }
  }

  const TetraComplex& Complex;
  std::int32_t First, Second;
  const std::vector<std::int32_t>& Vertices;
  double Worst[LargestRing][LargestRing];
  int Middle[LargestRing][LargestRing];
};

/// Faces between the vertices `below` and `above`, and the tetrahedra that join those two to the faces' border.
class FacesBetween
{
public:
  FacesBetween(const TetraComplex& complex, std::int32_t below, std::int32_t above)
    : Complex(complex)
    , Below(below)
    , Above(above)
  {
  }

  std::vector<std::int32_t> Removed;
  std::vector<TetraCorners> Added;

  /// Adds the face of tetrahedra `lower` and `upper`, with, beyond those of its edges where it is better, the faces
  /// next to it. `from` is the edge that it was reached by. Returns the worst new quality.
  double Spread(std::int32_t lower, std::int32_t upper, std::array<std::int32_t, 2> from)
  {
    this->Removed.push_back(lower);
    this->Removed.push_back(upper);
    const FaceCorners face = FaceOpposite(this->Complex.Corners(lower), this->Complex.CornerOf(lower, this->Below));
    double worst = std::numeric_limits<double>::infinity();
    for (int e = 0; e < 3; ++e)
    {
      const std::int32_t v = face[e], w = face[(e + 1) % 3];
      if (w != from[0] || v != from[1])
      {
        worst = std::min(worst, this->BestAt(lower, upper, v, w, face[(e + 2) % 3]));
      }
    }
    return worst;
  }

private:
  /// The better of the tetrahedron at the edge v, w, and of the faces beyond it, which is added.
  double BestAt(std::int32_t lower, std::int32_t upper, std::int32_t v, std::int32_t w, std::int32_t opposite)
  {
    // The face turns to the left seen from below.
    const TetraCorners tetra = { this->Below, w, v, this->Above };
    const double own = this->Complex.QualityOf(tetra);
    const std::int32_t nextLower = this->Complex.Inside(lower, this->Complex.CornerOf(lower, opposite));
    const std::int32_t nextUpper = this->Complex.Inside(upper, this->Complex.CornerOf(upper, opposite));
    if (nextLower >= 0 && nextUpper >= 0 && int(this->Removed.size()) < 2 * MostFaces &&
      this->ShareFace(nextLower, nextUpper) &&
      std::find(this->Removed.begin(), this->Removed.end(), nextLower) == this->Removed.end())
    {
      const std::size_t removed = this->Removed.size(), added = this->Added.size();
      const double beyond = this->Spread(nextLower, nextUpper, { v, w });
      if (beyond > own)
      {
        return beyond;
      }
      this->Removed.resize(removed);
      this->Added.resize(added);
    }
    this->Added.push_back(tetra);
    return own;
  }
  bool ShareFace(std::int32_t lower, std::int32_t upper) const
  {
    return this->Complex.Neighbor(lower, this->Complex.CornerOf(lower, this->Below)) == upper &&
      this->Complex.CornerOf(upper, this->Above) >= 0;
  }

  const TetraComplex& Complex;
  std::int32_t Below, Above;
};
}

bool RemoveEdge(TetraComplex& complex, Index t, int i, int j)
{
  thread_local TetraComplex::Ring ring;
  complex.EdgeRing(t, i, j, ring);
  if (!ring.Closed || ring.Vertices.size() < 3 || ring.Vertices.size() > std::size_t(LargestRing))
  {
    return false;
  }
  const double before = WorstOf(complex, ring.Tetrahedra) + LeastRise;
  const RingTriangulation best(complex, complex.Corners(t)[i], complex.Corners(t)[j], ring.Vertices, before);
  if (!(best.Quality() > before))
  {
    return false;
  }
  std::vector<TetraCorners> added;
  best.Append(added);
  return complex.Replace(ring.Tetrahedra, added);
}

bool RemoveFaces(TetraComplex& complex, Index t, int j)
{
  const std::int32_t other = complex.Inside(t, j);
  if (other < 0)
  {
    return false;
  }
  const FaceCorners face = FaceOpposite(complex.Corners(t), j);
  std::int32_t above = -1;
  for (const std::int32_t v : complex.Corners(other))
  {
    above = std::find(face.begin(), face.end(), v) == face.end() ? v : above;
  }
  FacesBetween between(complex, complex.Corners(t)[j], above);
  const double after = between.Spread(std::int32_t(t), other, { -1, -1 });
  return after > WorstOf(complex, between.Removed) + LeastRise && complex.Replace(between.Removed, between.Added);
}

bool Contract(TetraComplex& complex, Index v, Index u)
{
  if (complex.IsFixed(v))
  {
    return false;
  }
  thread_local std::vector<std::int32_t> star;
  complex.Star(v, star);
  const double before = WorstOf(complex, star) + LeastRise;
  std::vector<TetraCorners> added;
  for (const std::int32_t t : star)
  {
    if (complex.CornerOf(t, u) < 0)
    {
      TetraCorners corners = complex.Corners(t);
      corners[complex.CornerOf(t, v)] = std::int32_t(u);
      added.push_back(corners);
      if (!(complex.QualityOf(corners) > before))
      {
        return false;
      }
    }
  }
  return complex.Replace(star, added);
}
}
