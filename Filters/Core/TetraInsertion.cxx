// SPDX-License-Identifier: BSD-3-Clause
#include "TetraInsertion.h"

#include "TetraFlips.h"
#include "TetraQuality.h"
#include "TetraSmoothing.h"

#include <algorithm>
#include <limits>

namespace LabelMesh
{
namespace
{
constexpr std::size_t LargestCavity = 40; // tetrahedra
constexpr double GoodEnough = 0.45;       // quality: a face that makes a better tetrahedron stays
constexpr int Rounds = 3;                 // of letting the cavity grow and moving the vertex

/// The tetrahedra that a new vertex replaces, and the faces around them.
class Cavity
{
public:
  Cavity(const TetraComplex& complex, const std::vector<std::int32_t>& seeds, const Vec3& x)
    : Complex(complex)
    , Position(x)
  {
    for (const std::int32_t t : seeds)
    {
      this->Add(t);
    }
  }

  const std::vector<std::int32_t>& Tetrahedra() const { return this->Removed; }

  /// Lets it grow and moves the vertex in turn; returns the worst quality at the vertex.
  double Optimize()
  {
    double worst = -1.0;
    for (int round = 0; round < Rounds; ++round)
    {
      const std::size_t size = this->Removed.size();
      this->Grow();
      if (round > 0 && this->Removed.size() == size)
      {
        break;
      }
      std::vector<OpenTetra> open;
      for (const Face& face : this->Faces)
      {
        open.push_back(this->Points(face.Corners));
      }
      worst = RaiseWorst(open, this->Position);
    }
    return worst;
  }

  bool Apply(TetraComplex& complex) const
  {
    const std::int32_t v = complex.AddPoint(this->Position);
    std::vector<TetraCorners> added;
    for (const Face& face : this->Faces)
    {
      added.push_back({ face.Corners[0], face.Corners[1], face.Corners[2], v });
    }
    if (complex.Replace(this->Removed, added))
    {
      return true;
    }
    complex.DropLastPoint();
    return false;
  }

private:
  struct Face
  {
    FaceCorners Corners; // turned to the left seen from inside
    std::int32_t Tetra;  // inside
    int Corner;
    double Quality;
    bool Stays;
  };

  OpenTetra Points(const FaceCorners& c) const
  {
    return { this->Complex.Point(c[0]), this->Complex.Point(c[1]), this->Complex.Point(c[2]) };
  }
  bool Has(std::int32_t t) const
  {
    return t >= 0 && std::find(this->Removed.begin(), this->Removed.end(), t) != this->Removed.end();
  }
  double QualityAt(const FaceCorners& face) const
  {
    const auto [a, b, c] = this->Points(face);
    return TetraQuality(a, b, c, this->Position);
  }

  void Add(std::int32_t t)
  {
    this->Removed.push_back(t);
    const auto covered = [this, t](const Face& face) { return this->Complex.Neighbor(face.Tetra, face.Corner) == t; };
    this->Faces.erase(std::remove_if(this->Faces.begin(), this->Faces.end(), covered), this->Faces.end());
    for (int j = 0; j < 4; ++j)
    {
      if (!this->Has(this->Complex.Neighbor(t, j)))
      {
        this->Faces.push_back({ FaceOpposite(this->Complex.Corners(t), j), t, j, 0.0, false });
      }
    }
  }

  /// The worst that t would leave, of the faces that it would be entered by.
  double WorstBeyond(std::int32_t t) const
  {
    double worst = std::numeric_limits<double>::infinity();
    for (int j = 0; j < 4; ++j)
    {
      if (!this->Has(this->Complex.Neighbor(t, j)))
      {
        worst = std::min(worst, this->QualityAt(FaceOpposite(this->Complex.Corners(t), j)));
      }
    }
    return worst;
  }

  void Grow()
  {
    for (Face& face : this->Faces)
    {
      face.Quality = this->QualityAt(face.Corners);
      face.Stays = face.Quality > GoodEnough;
    }
    while (this->Removed.size() < LargestCavity)
    {
      Face* worst = nullptr;
      for (Face& face : this->Faces)
      {
        worst = !face.Stays && (!worst || face.Quality < worst->Quality) ? &face : worst;
      }
      if (!worst)
      {
        return;
      }
      const std::int32_t next = this->Complex.Inside(worst->Tetra, worst->Corner);
      if (next < 0 || !(this->WorstBeyond(next) > worst->Quality))
      {
        worst->Stays = true;
        continue;
      }
      this->Add(next);
      for (Face& face : this->Faces)
      {
        if (face.Tetra == next)
        {
          face.Quality = this->QualityAt(face.Corners);
          face.Stays = face.Quality > GoodEnough;
        }
      }
    }
  }

  const TetraComplex& Complex;
  Vec3 Position;
  std::vector<std::int32_t> Removed;
  std::vector<Face> Faces;
};

bool InsertAt(TetraComplex& complex, const std::vector<std::int32_t>& seeds, const Vec3& x)
{
  Cavity cavity(complex, seeds, x);
  const double after = cavity.Optimize();
  double before = std::numeric_limits<double>::infinity();
  for (const std::int32_t t : cavity.Tetrahedra())
  {
    before = std::min(before, complex.Quality(t));
  }
  return after > before + LeastRise && cavity.Apply(complex);
}
}

bool InsertVertex(TetraComplex& complex, Index t)
{
  const TetraCorners corners = complex.Corners(t);
  const auto square = [&](const std::array<int, 2>& edge)
  { return (complex.Point(corners[edge[0]]) - complex.Point(corners[edge[1]])).squaredNorm(); };
  auto edges = TetraEdges;
  std::stable_sort(edges.begin(), edges.end(),
    [&square](const std::array<int, 2>& a, const std::array<int, 2>& b) { return square(a) > square(b); });
  TetraComplex::Ring ring;
  for (const auto& [i, j] : edges)
  {
    complex.EdgeRing(t, i, j, ring);
    if (ring.Closed &&
      InsertAt(complex, ring.Tetrahedra, 0.5 * (complex.Point(corners[i]) + complex.Point(corners[j]))))
    {
      return true;
    }
  }
  const Vec3 centre = 0.25 *
    (complex.Point(corners[0]) + complex.Point(corners[1]) + complex.Point(corners[2]) + complex.Point(corners[3]));
  return InsertAt(complex, { std::int32_t(t) }, centre);
}
}
