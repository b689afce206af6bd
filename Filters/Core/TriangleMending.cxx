// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleMending.h"

#include "ParticlePlacement.h"
#include "VertexSmoothing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>

namespace LabelMesh
{
namespace
{
constexpr std::size_t TrianglesPerStep = 64; // some milliseconds each: how long an abort may wait

constexpr int MostRounds = 4;      // an edit may make way for the next
constexpr int SmoothingSweeps = 3; // after an edit
constexpr double LeastTurn = 0.5;  // cosine between a triangle's normals before and after an edit

/// Ascending, each once.
void MakeUnique(std::vector<Index>& numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

class TriangleMender
{
public:
  TriangleMender(const IndicatorSet& indicators, SurfaceComplex& complex, double wantedRatio)
    : Indicators(indicators)
    , Complex(complex)
    , WantedRatio(wantedRatio)
  {
  }

  std::vector<Index> BadTriangles() const
  {
    std::vector<Index> bad;
    for (Index t = 0; t < this->Complex.NumberOfTriangles(); ++t)
    {
      if (this->Complex.IsAlive(t) && this->Complex.Ratio(t) < this->WantedRatio)
      {
        bad.push_back(t);
      }
    }
    return bad;
  }

  /// True when an edit made the surroundings of the triangle better.
  bool Mend(Index triangle)
  {
    const std::array<Index, 3> corners = this->Complex.Triangle(triangle).Vertices;
    const std::vector<Index> ring = this->Around({ corners.begin(), corners.end() });
    const std::vector<Index> near = this->Around(ring);
    const double before = this->Faults(near);
    double best = before;
    int chosen = -1;
    const std::vector<Edit> edits = this->Edits(corners);
    for (int n = 0; n < int(edits.size()); ++n)
    {
      this->Complex.Begin();
      const double after = edits[n]() ? this->Settle(ring, near) : before;
      if (after == 0.0)
      {
        // Nothing is better, and what comes later has to be.
        this->Complex.Commit();
        return true;
      }
      this->Complex.Rollback();
      if (after < best)
      {
        best = after;
        chosen = n;
      }
    }
    if (chosen < 0)
    {
      return false;
    }
    this->Complex.Begin();
    edits[chosen]();
    this->Settle(ring, near);
    this->Complex.Commit();
    return true;
  }

private:
  /// Returns false, with nothing changed, where it cannot be done.
  using Edit = std::function<bool()>;

  std::vector<Index> Around(const std::vector<Index>& vertices) const
  {
    std::vector<Index> near = vertices;
    for (const Index v : vertices)
    {
      const std::vector<Index> neighbors = this->Complex.Neighbors(v);
      near.insert(near.end(), neighbors.begin(), neighbors.end());
    }
    MakeUnique(near);
    return near;
  }
  std::vector<Index> TrianglesAt(const std::vector<Index>& vertices) const
  {
    std::vector<Index> triangles;
    for (const Index v : vertices)
    {
      triangles.insert(triangles.end(), this->Complex.Star(v).begin(), this->Complex.Star(v).end());
    }
    MakeUnique(triangles);
    return triangles;
  }

  double Faults(const std::vector<Index>& vertices) const
  {
    double faults = 0.0;
    for (const Index t : this->TrianglesAt(vertices))
    {
      faults += TriangleFault(this->Complex.Ratio(t), this->WantedRatio);
    }
    return faults;
  }

  /// Smooths the ring of an edit and the vertices that it added; returns the faults that are left near it.
  double Settle(std::vector<Index> ring, std::vector<Index> near)
  {
    for (Index v = this->Added; v < this->Complex.NumberOfVertices(); ++v)
    {
      ring.push_back(v);
      near.push_back(v);
    }
    for (int sweep = 0; sweep < SmoothingSweeps; ++sweep)
    {
      for (const Index v : ring)
      {
        SmoothVertex(this->Indicators, this->Complex, v);
      }
    }
    return this->Faults(near);
  }

  std::vector<Edit> Edits(const std::array<Index, 3>& corners)
  {
    this->Added = this->Complex.NumberOfVertices();
    std::vector<Edit> edits{ []() { return true; } }; // smoothing alone
    for (int i = 0; i < 3; ++i)
    {
      const Index a = corners[i], b = corners[(i + 1) % 3];
      edits.push_back([this, a, b]() { return this->Collapse(a, b); });
      edits.push_back([this, a, b]() { return this->Collapse(b, a); });
      edits.push_back([this, a, b]() { return this->Flip(a, b); });
      edits.push_back([this, a, b]() { return this->Split(a, b); });
    }
    return edits;
  }

  /// The triangles of a vertex with their normals.
  std::vector<std::pair<Index, Vec3>> Normals(const std::vector<Index>& vertices) const
  {
    std::vector<std::pair<Index, Vec3>> normals;
    for (const Index t : this->TrianglesAt(vertices))
    {
      normals.emplace_back(t, this->Complex.UnitNormal(t));
    }
    return normals;
  }
  bool KeepTheirSide(const std::vector<std::pair<Index, Vec3>>& normals) const
  {
    return std::all_of(normals.begin(), normals.end(),
      [this](const auto& entry) {
        return !this->Complex.IsAlive(entry.first) ||
          this->Complex.UnitNormal(entry.first).dot(entry.second) > LeastTurn;
      });
  }

  bool Collapse(Index gone, Index kept)
  {
    const auto normals = this->Normals({ gone });
    return this->Complex.Collapse(gone, kept) && this->KeepTheirSide(normals);
  }

  bool Flip(Index a, Index b)
  {
    Vec3 mean = Vec3::Zero();
    const std::vector<std::int32_t> star = this->Complex.EdgeStar(a, b);
    for (const std::int32_t t : star)
    {
      mean += this->Complex.UnitNormal(t);
    }
    return star.size() == 2 && this->Complex.Flip(a, b) &&
      std::all_of(star.begin(), star.end(),
        [&](std::int32_t t) { return this->Complex.UnitNormal(t).dot(mean.stableNormalized()) > LeastTurn; });
  }

  bool Split(Index a, Index b)
  {
    const Particle &p = this->Complex.Vertex(a), &q = this->Complex.Vertex(b);
    MaterialSet materials;
    const std::vector<std::int32_t> star = this->Complex.EdgeStar(a, b);
    for (const std::int32_t t : star)
    {
      for (const MaterialId m : this->Complex.Triangle(t).Materials)
      {
        materials.Insert(m);
      }
    }
    Particle middle;
    const double length = std::min(p.TargetLength, q.TargetLength);
    if ((materials.Size() != 2 && materials.Size() != 3) || star.size() != this->Interfaces(materials) ||
      !PlaceOnJunction(this->Indicators, materials, 0.5 * (p.Position + q.Position), length, middle))
    {
      return false;
    }
    const auto normals = this->Normals({ a, b });
    return this->Complex.Split(a, b, middle) && this->KeepTheirSide(normals);
  }

  /// How many triangles an edge inside the junction of two or three materials has.
  std::size_t Interfaces(const MaterialSet& materials) const
  {
    if (materials.Size() == 2)
    {
      return 2;
    }
    const MaterialId a = materials[0], b = materials[1], c = materials[2];
    return std::size_t(this->Indicators.HaveInterface(a, b)) + std::size_t(this->Indicators.HaveInterface(a, c)) +
      std::size_t(this->Indicators.HaveInterface(b, c));
  }

  const IndicatorSet& Indicators;
  SurfaceComplex& Complex;
  double WantedRatio;
  Index Added = 0; ///< the first vertex that an edit adds
};
}

MendResult MendTriangles(
  const IndicatorSet& indicators, SurfaceComplex& complex, double wantedRatio, const Monitor& monitor)
{
  MendResult result;
  TriangleMender mender(indicators, complex, wantedRatio);
  std::vector<Index> bad = mender.BadTriangles();
  for (int round = 0; round < MostRounds && !bad.empty(); ++round)
  {
    const Index before = result.Mended;
    for (std::size_t n = 0; n < bad.size(); ++n)
    {
      if (n % TrianglesPerStep == 0)
      {
        monitor.Step((round + double(n) / double(bad.size())) / MostRounds, "Mending triangles");
      }
      const Index t = bad[n];
      const bool stillBad = complex.IsAlive(t) && complex.Ratio(t) < wantedRatio;
      result.Mended += stillBad && mender.Mend(t);
    }
    bad = mender.BadTriangles();
    if (result.Mended == before)
    {
      break;
    }
  }
  result.Left = Index(bad.size());
  return result;
}
}
