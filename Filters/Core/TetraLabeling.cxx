// SPDX-License-Identifier: BSD-3-Clause
#include "TetraLabeling.h"

#include "Parallel.h"

#include <Eigen/Dense>

#include <limits>

namespace LabelMesh
{
namespace
{
constexpr double Certain = std::numeric_limits<double>::max();

MaterialSet SharedMaterials(const std::vector<Particle>& particles, const std::array<std::int32_t, 4>& corners)
{
  MaterialSet shared;
  for (const MaterialId m : particles[corners[0]].Materials)
  {
    if (particles[corners[1]].Materials.Contains(m) && particles[corners[2]].Materials.Contains(m) &&
      particles[corners[3]].Materials.Contains(m))
    {
      shared.Insert(m);
    }
  }
  return shared;
}

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

/// Tetrahedra by the edges of a list: those around each edge.
class EdgeRings
{
public:
  explicit EdgeRings(const Tetrahedralization& tetrahedra, std::size_t points)
    : Starts(points + 1, 0)
  {
    for (const auto& corners : tetrahedra.Corners)
    {
      for (const std::int32_t c : corners)
      {
        ++this->Starts[c + 1];
      }
    }
    for (std::size_t n = 0; n < points; ++n)
    {
      this->Starts[n + 1] += this->Starts[n];
    }
    this->Tetrahedra.resize(this->Starts.back());
    std::vector<Index> at(this->Starts.begin(), this->Starts.end() - 1);
    for (Index t = 0; t < tetrahedra.Size(); ++t)
    {
      for (const std::int32_t c : tetrahedra.Corners[t])
      {
        this->Tetrahedra[at[c]++] = std::int32_t(t);
      }
    }
  }

  std::vector<std::int32_t> Around(const Tetrahedralization& tetrahedra, const Edge& edge) const
  {
    std::vector<std::int32_t> around;
    for (Index n = this->Starts[edge.first]; n < this->Starts[edge.first + 1]; ++n)
    {
      const auto& corners = tetrahedra.Corners[this->Tetrahedra[n]];
      if (std::find(corners.begin(), corners.end(), std::int32_t(edge.second)) != corners.end())
      {
        around.push_back(this->Tetrahedra[n]);
      }
    }
    return around;
  }

private:
  std::vector<Index> Starts;
  std::vector<std::int32_t> Tetrahedra;
};

/// A run of equally labelled tetrahedra around an edge.
struct Arc
{
  MaterialId Label = NoMaterial;
  std::vector<std::int32_t> Tetrahedra;
  std::vector<MaterialId> NeighborLabels;
  bool OnHull = false;
};

std::vector<Arc> ArcsAround(const Tetrahedralization& tetrahedra, const std::vector<MaterialId>& labels,
  const std::vector<std::int32_t>& ring, MaterialId outside)
{
  std::vector<Arc> arcs;
  std::vector<char> done(ring.size(), 0);
  for (std::size_t first = 0; first < ring.size(); ++first)
  {
    if (done[first])
    {
      continue;
    }
    Arc arc;
    arc.Label = labels[ring[first]];
    arc.Tetrahedra.push_back(ring[first]);
    done[first] = 1;
    for (std::size_t n = 0; n < arc.Tetrahedra.size(); ++n)
    {
      for (const std::int32_t neighbor : tetrahedra.Neighbors[arc.Tetrahedra[n]])
      {
        const auto at = std::find(ring.begin(), ring.end(), neighbor);
        if (neighbor >= 0 && at != ring.end())
        {
          if (labels[neighbor] != arc.Label)
          {
            arc.NeighborLabels.push_back(labels[neighbor]);
          }
          else if (!done[at - ring.begin()])
          {
            done[at - ring.begin()] = 1;
            arc.Tetrahedra.push_back(neighbor);
          }
        }
        else if (neighbor < 0)
        {
          arc.OnHull = true;
          if (arc.Label != outside)
          {
            arc.NeighborLabels.push_back(outside);
          }
        }
      }
    }
    arcs.push_back(std::move(arc));
  }
  return arcs;
}

/// True when some material has more than one arc around the edge. The space beyond the hull is an arc of `outside`, joined
/// to those that touch it.
bool Tied(const std::vector<Arc>& arcs, MaterialId outside)
{
  bool beyond = false;
  for (const Arc& arc : arcs)
  {
    beyond = beyond || arc.OnHull;
  }
  for (std::size_t a = 0; a < arcs.size(); ++a)
  {
    const bool reachesBeyond = arcs[a].OnHull && arcs[a].Label == outside;
    if (beyond && arcs[a].Label == outside && !reachesBeyond)
    {
      return true;
    }
    for (std::size_t b = a + 1; b < arcs.size(); ++b)
    {
      const bool joined = reachesBeyond && arcs[b].OnHull;
      if (arcs[a].Label == arcs[b].Label && !joined)
      {
        return true;
      }
    }
  }
  return false;
}

/// The cheapest allowed relabelling of one arc that unties the edge; none where there is none.
void UntieEdge(const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra, MaterialId outside,
  const std::vector<std::int32_t>& ring, TetraLabels& labels)
{
  const std::vector<Arc> arcs = ArcsAround(tetrahedra, labels.Labels, ring, outside);
  if (!Tied(arcs, outside))
  {
    return;
  }
  double cheapest = Certain;
  const Arc* flip = nullptr;
  MaterialId to = NoMaterial;
  for (const Arc& arc : arcs)
  {
    for (const MaterialId label : arc.NeighborLabels)
    {
      double cost = 0.0;
      for (const std::int32_t t : arc.Tetrahedra)
      {
        const bool allowed = SharedMaterials(particles, tetrahedra.Corners[t]).Contains(label);
        cost = allowed && cost < Certain ? cost + std::min(labels.Certainty[t], 1e100) : Certain;
      }
      if (cost >= cheapest)
      {
        continue;
      }
      std::vector<MaterialId> tried;
      for (const std::int32_t t : ring)
      {
        const bool flipped = std::find(arc.Tetrahedra.begin(), arc.Tetrahedra.end(), t) != arc.Tetrahedra.end();
        tried.push_back(labels.Labels[t]);
        labels.Labels[t] = flipped ? label : labels.Labels[t];
      }
      const bool unties = !Tied(ArcsAround(tetrahedra, labels.Labels, ring, outside), outside);
      for (std::size_t n = 0; n < ring.size(); ++n)
      {
        labels.Labels[ring[n]] = tried[n];
      }
      if (unties)
      {
        cheapest = cost;
        flip = &arc;
        to = label;
      }
    }
  }
  if (flip)
  {
    for (const std::int32_t t : flip->Tetrahedra)
    {
      labels.Labels[t] = to;
    }
  }
}
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
        const Vec3 index = working.ToIndex(x);
        const bool inside = (index.array() >= 0).all() && index[0] <= working.Dims[0] - 1 &&
          index[1] <= working.Dims[1] - 1 && index[2] <= working.Dims[2] - 1;
        if (shared.Size() == 0)
        {
          empty[t] = 1;
          result.Labels[t] = indicators.LargestMaterial(0.25 * (a + b + c + d));
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

std::vector<Edge> NonManifoldEdges(const std::vector<InterfaceTriangle>& faces)
{
  struct Use
  {
    Index A, B;
    MaterialId Material;
    bool operator<(const Use& o) const { return std::tie(A, B, Material) < std::tie(o.A, o.B, o.Material); }
    bool operator==(const Use& o) const { return A == o.A && B == o.B && Material == o.Material; }
  };
  std::vector<Use> uses;
  uses.reserve(6 * faces.size());
  for (const InterfaceTriangle& face : faces)
  {
    for (int e = 0; e < 3; ++e)
    {
      const auto [a, b] = std::minmax(face.Vertices[e], face.Vertices[(e + 1) % 3]);
      for (const MaterialId m : face.Materials)
      {
        uses.push_back({ a, b, m });
      }
    }
  }
  std::sort(uses.begin(), uses.end());
  std::vector<Edge> tied;
  for (std::size_t n = 0; n < uses.size();)
  {
    std::size_t end = n;
    while (end < uses.size() && uses[end] == uses[n])
    {
      ++end;
    }
    const Edge edge(uses[n].A, uses[n].B);
    if (end - n != 2 && (tied.empty() || tied.back() != edge))
    {
      tied.push_back(edge);
    }
    n = end;
  }
  return tied;
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

void UntieEdges(const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra, MaterialId outside,
  TetraLabels& labels)
{
  constexpr int rounds = 8; // untying one edge may tie the next
  std::vector<Edge> tied = NonManifoldEdges(InterfaceFaces(particles, tetrahedra, labels, outside));
  if (tied.empty())
  {
    return;
  }
  const EdgeRings rings(tetrahedra, particles.size());
  for (int round = 0; round < rounds && !tied.empty(); ++round)
  {
    for (const Edge& edge : tied)
    {
      UntieEdge(particles, tetrahedra, outside, rings.Around(tetrahedra, edge), labels);
    }
    tied = NonManifoldEdges(InterfaceFaces(particles, tetrahedra, labels, outside));
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
          const Vec3& a = particles[face.Vertices[0]].Position;
          const Vec3 normal = (particles[face.Vertices[1]].Position - a).cross(particles[face.Vertices[2]].Position - a);
          if (normal.dot(particles[corners[j]].Position - a) > 0)
          {
            std::swap(face.Vertices[1], face.Vertices[2]);
          }
          found.push_back(face);
        }
      }
    });
}

InterfaceComplex BuildInterface(const IndicatorSet& indicators, const std::vector<Particle>& particles)
{
  std::vector<Vec3> points;
  points.reserve(particles.size());
  for (const Particle& p : particles)
  {
    points.push_back(p.Position);
  }
  InterfaceComplex complex;
  complex.Tetrahedra = DelaunayTetrahedra(points);
  complex.Labels = LabelTetrahedra(indicators, particles, complex.Tetrahedra);
  const MaterialId outside = indicators.Background() != NoMaterial ? indicators.Background() : MaterialId(0);
  UntieEdges(particles, complex.Tetrahedra, outside, complex.Labels);
  complex.Faces = InterfaceFaces(particles, complex.Tetrahedra, complex.Labels, outside);
  return complex;
}
}
