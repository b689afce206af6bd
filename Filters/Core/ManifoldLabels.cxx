// SPDX-License-Identifier: BSD-3-Clause
#include "ManifoldLabels.h"

#include "Parallel.h"

#include <limits>
#include <numeric>
#include <tuple>

namespace LabelMesh
{
namespace
{
constexpr int MostRounds = 8; // mending one fault may make the next

/// A face's use by one material at a vertex: the other two vertices of the triangle.
struct FanPiece
{
  MaterialId Material;
  Index A, B;
};

/// True when the pieces are those of two materials, face by face, and go once around the vertex: what nearly all
/// vertices have, and quickly told.
bool IsPlain(const std::vector<FanPiece>& pieces)
{
  constexpr std::size_t most = 24; // triangles around a vertex
  const std::size_t count = pieces.size() / 2;
  std::array<Index, most> passed;
  if (count < 3 || count > most)
  {
    return false;
  }
  for (std::size_t n = 2; n < pieces.size(); ++n)
  {
    const MaterialId m = pieces[n].Material;
    if ((m != pieces[0].Material && m != pieces[1].Material) || m == pieces[n ^ 1].Material)
    {
      return false;
    }
  }
  Index at = pieces[0].A;
  std::size_t piece = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    if (std::find(passed.begin(), passed.begin() + n, at) != passed.begin() + n)
    {
      return false;
    }
    passed[n] = at;
    at = pieces[piece].A == at ? pieces[piece].B : pieces[piece].A;
    std::size_t next = 0;
    while (next < pieces.size() && (next == piece || (pieces[next].A != at && pieces[next].B != at)))
    {
      next += 2;
    }
    if (next >= pieces.size())
    {
      return false;
    }
    piece = next;
  }
  return at == pieces[0].A;
}

/// The number of fans beyond one that the pieces of each material form: pieces that share a vertex are joined.
int ExtraFans(std::vector<FanPiece>& pieces)
{
  if (IsPlain(pieces))
  {
    return 0;
  }
  std::sort(pieces.begin(), pieces.end(),
    [](const FanPiece& p, const FanPiece& q)
    { return std::tie(p.Material, p.A, p.B) < std::tie(q.Material, q.A, q.B); });
  int extra = 0;
  std::vector<std::size_t> fan;
  for (std::size_t first = 0; first < pieces.size();)
  {
    std::size_t last = first;
    while (last < pieces.size() && pieces[last].Material == pieces[first].Material)
    {
      ++last;
    }
    // The smallest number of a fan spreads until nothing changes: fans have a handful of pieces.
    fan.resize(last - first);
    std::iota(fan.begin(), fan.end(), std::size_t(0));
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t p = first; p < last; ++p)
      {
        for (std::size_t q = p + 1; q < last; ++q)
        {
          const bool touch = pieces[p].A == pieces[q].A || pieces[p].A == pieces[q].B || pieces[p].B == pieces[q].A ||
            pieces[p].B == pieces[q].B;
          if (touch && fan[p - first] != fan[q - first])
          {
            fan[p - first] = fan[q - first] = std::min(fan[p - first], fan[q - first]);
            changed = true;
          }
        }
      }
    }
    std::sort(fan.begin(), fan.end());
    extra += int(std::unique(fan.begin(), fan.end()) - fan.begin()) - 1;
    first = last;
  }
  return extra;
}

/// Calls visit(other end) for each edge from a vertex that some material's pieces use other than twice, once per
/// material.
template <typename Visit>
void ForTiedEdges(const std::vector<FanPiece>& pieces, Visit&& visit)
{
  if (IsPlain(pieces))
  {
    return;
  }
  std::vector<std::pair<MaterialId, Index>> uses;
  for (const FanPiece& p : pieces)
  {
    uses.emplace_back(p.Material, p.A);
    uses.emplace_back(p.Material, p.B);
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t first = 0; first < uses.size();)
  {
    std::size_t last = first;
    while (last < uses.size() && uses[last] == uses[first])
    {
      ++last;
    }
    if (last - first != 2)
    {
      visit(uses[first].second);
    }
    first = last;
  }
}

int TiedEdges(const std::vector<FanPiece>& pieces)
{
  int tied = 0;
  ForTiedEdges(pieces, [&](Index) { ++tied; });
  return tied;
}

class Untying
{
public:
  Untying(const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra, MaterialId outside,
    TetraLabels& labels)
    : Particles(particles)
    , Tetrahedra(tetrahedra)
    , Outside(outside)
    , Labels(labels)
    , Starts(particles.size() + 1, 0)
  {
    for (const auto& corners : tetrahedra.Corners)
    {
      for (const std::int32_t c : corners)
      {
        ++this->Starts[c + 1];
      }
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Stars.resize(this->Starts.back());
    std::vector<Index> at(this->Starts.begin(), this->Starts.end() - 1);
    for (Index t = 0; t < tetrahedra.Size(); ++t)
    {
      for (const std::int32_t c : tetrahedra.Corners[t])
      {
        this->Stars[at[c]++] = std::int32_t(t);
      }
    }
  }

  /// Changes labels around a vertex if it is faulty: those around its tangled edges first, then any of its star.
  void Mend(Index vertex)
  {
    std::vector<FanPiece> pieces;
    this->Pieces(vertex, pieces);
    std::vector<Index> others;
    ForTiedEdges(pieces, [&](Index other) { others.push_back(other); });
    for (const Index other : others)
    {
      std::vector<std::int32_t> around;
      for (const std::int32_t t : this->Star(vertex))
      {
        const auto& corners = this->Tetrahedra.Corners[t];
        if (std::find(corners.begin(), corners.end(), std::int32_t(other)) != corners.end())
        {
          around.push_back(t);
        }
      }
      this->Mend(around);
    }
    if (this->Faults(vertex) > 0)
    {
      this->Mend(this->Star(vertex));
    }
  }

  /// The faulty ones among the vertices and their neighbours, ascending.
  std::vector<Index> FaultyNear(const std::vector<Index>& vertices) const
  {
    std::vector<Index> near;
    for (const Index vertex : vertices)
    {
      for (const std::int32_t t : this->Star(vertex))
      {
        near.insert(near.end(), this->Tetrahedra.Corners[t].begin(), this->Tetrahedra.Corners[t].end());
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    near.erase(std::remove_if(near.begin(), near.end(), [this](Index v) { return this->Faults(v) == 0; }), near.end());
    return near;
  }

private:
  struct Group
  {
    std::vector<std::int32_t> Tetrahedra;
    std::vector<MaterialId> Neighbors;
  };

  std::vector<std::int32_t> Star(Index vertex) const
  {
    return { this->Stars.begin() + this->Starts[vertex], this->Stars.begin() + this->Starts[vertex + 1] };
  }

  void Pieces(Index vertex, std::vector<FanPiece>& pieces) const
  {
    pieces.clear();
    for (Index n = this->Starts[vertex]; n < this->Starts[vertex + 1]; ++n)
    {
      const std::int32_t t = this->Stars[n];
      const auto& corners = this->Tetrahedra.Corners[t];
      for (int j = 0; j < 4; ++j)
      {
        const std::int32_t neighbor = this->Tetrahedra.Neighbors[t][j];
        const MaterialId own = this->Labels.Labels[t];
        const MaterialId other = neighbor < 0 ? this->Outside : this->Labels.Labels[neighbor];
        if (corners[j] == vertex || other == own || (neighbor >= 0 && neighbor < t))
        {
          continue;
        }
        Index others[2] = { -1, -1 };
        for (int c = 0, found = 0; c < 4; ++c)
        {
          if (c != j && corners[c] != vertex)
          {
            others[found++] = corners[c];
          }
        }
        pieces.push_back({ own, others[0], others[1] });
        pieces.push_back({ other, others[0], others[1] });
      }
    }
  }

  /// What is wrong at a vertex: extra fans, and edges in tangles.
  int Faults(Index vertex) const
  {
    std::vector<FanPiece> pieces;
    this->Pieces(vertex, pieces);
    const int tied = TiedEdges(pieces);
    return ExtraFans(pieces) + 2 * tied;
  }

  int FaultsAt(const std::vector<std::int32_t>& tetrahedra) const
  {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t t : tetrahedra)
    {
      vertices.insert(vertices.end(), this->Tetrahedra.Corners[t].begin(), this->Tetrahedra.Corners[t].end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    int faults = 0;
    for (const std::int32_t v : vertices)
    {
      faults += this->Faults(v);
    }
    return faults;
  }

  /// Face-connected runs of equal labels among the tetrahedra.
  std::vector<Group> GroupsOf(const std::vector<std::int32_t>& around) const
  {
    std::vector<Group> groups;
    std::vector<char> done(around.size(), 0);
    for (std::size_t first = 0; first < around.size(); ++first)
    {
      if (done[first])
      {
        continue;
      }
      Group group;
      const MaterialId label = this->Labels.Labels[around[first]];
      group.Tetrahedra.push_back(around[first]);
      done[first] = 1;
      for (std::size_t n = 0; n < group.Tetrahedra.size(); ++n)
      {
        for (const std::int32_t neighbor : this->Tetrahedra.Neighbors[group.Tetrahedra[n]])
        {
          const MaterialId other = neighbor < 0 ? this->Outside : this->Labels.Labels[neighbor];
          const auto at = std::find(around.begin(), around.end(), neighbor);
          if (other != label)
          {
            group.Neighbors.push_back(other);
          }
          else if (at != around.end() && !done[at - around.begin()])
          {
            done[at - around.begin()] = 1;
            group.Tetrahedra.push_back(neighbor);
          }
        }
      }
      std::sort(group.Neighbors.begin(), group.Neighbors.end());
      group.Neighbors.erase(std::unique(group.Neighbors.begin(), group.Neighbors.end()), group.Neighbors.end());
      groups.push_back(std::move(group));
    }
    return groups;
  }

  double CostOf(const Group& group, MaterialId label) const
  {
    double cost = 0.0;
    for (const std::int32_t t : group.Tetrahedra)
    {
      if (!SharedMaterials(this->Particles, this->Tetrahedra.Corners[t]).Contains(label))
      {
        return std::numeric_limits<double>::infinity();
      }
      cost += std::min(this->Labels.Certainty[t], 1e100);
    }
    return cost;
  }

  void Relabel(const Group& group, MaterialId label)
  {
    for (const std::int32_t t : group.Tetrahedra)
    {
      this->Labels.Labels[t] = label;
    }
  }

  void Mend(const std::vector<std::int32_t>& around)
  {
    std::vector<Group> groups = this->GroupsOf(around);
    // Single tetrahedra too: a group may hold more than need change.
    for (const std::int32_t t : around)
    {
      groups.push_back({ { t }, {} });
      for (const std::int32_t neighbor : this->Tetrahedra.Neighbors[t])
      {
        groups.back().Neighbors.push_back(neighbor < 0 ? this->Outside : this->Labels.Labels[neighbor]);
      }
    }
    int bestGain = 0;
    double bestCost = std::numeric_limits<double>::infinity();
    const Group* bestGroup = nullptr;
    MaterialId bestLabel = NoMaterial;
    for (const Group& group : groups)
    {
      const MaterialId own = this->Labels.Labels[group.Tetrahedra.front()];
      const int before = this->FaultsAt(group.Tetrahedra);
      for (const MaterialId label : group.Neighbors)
      {
        const double cost = label == own ? std::numeric_limits<double>::infinity() : this->CostOf(group, label);
        if (!(cost < std::numeric_limits<double>::infinity()))
        {
          continue;
        }
        this->Relabel(group, label);
        const int gain = before - this->FaultsAt(group.Tetrahedra);
        this->Relabel(group, own);
        if (gain > bestGain || (gain == bestGain && gain > 0 && cost < bestCost))
        {
          bestGain = gain;
          bestCost = cost;
          bestGroup = &group;
          bestLabel = label;
        }
      }
    }
    if (bestGroup)
    {
      this->Relabel(*bestGroup, bestLabel);
    }
  }

  const std::vector<Particle>& Particles;
  const Tetrahedralization& Tetrahedra;
  MaterialId Outside;
  TetraLabels& Labels;
  std::vector<Index> Starts; // tetrahedra at vertex v: Stars[Starts[v] .. Starts[v + 1])
  std::vector<std::int32_t> Stars;
};

/// The faces at every vertex.
struct VertexFaces
{
  std::vector<Index> Starts, Faces;
  MaterialId Outside; ///< what the space beyond the faces of the volume's box belongs to

  VertexFaces(const std::vector<InterfaceTriangle>& faces, MaterialId outside)
    : Outside(outside)
  {
    Index points = 0;
    for (const InterfaceTriangle& face : faces)
    {
      points = std::max({ points, face.Vertices[0] + 1, face.Vertices[1] + 1, face.Vertices[2] + 1 });
    }
    this->Starts.assign(points + 1, 0);
    for (const InterfaceTriangle& face : faces)
    {
      for (const Index v : face.Vertices)
      {
        ++this->Starts[v + 1];
      }
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Faces.resize(3 * faces.size());
    std::vector<Index> at(this->Starts.begin(), this->Starts.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      for (const Index v : faces[f].Vertices)
      {
        this->Faces[at[v]++] = Index(f);
      }
    }
  }

  Index Vertices() const { return Index(this->Starts.size()) - 1; }

  void Pieces(const std::vector<InterfaceTriangle>& faces, Index v, std::vector<FanPiece>& pieces) const
  {
    pieces.clear();
    for (Index n = this->Starts[v]; n < this->Starts[v + 1]; ++n)
    {
      const InterfaceTriangle& face = faces[this->Faces[n]];
      const int own = face.Vertices[0] == v ? 0 : face.Vertices[1] == v ? 1 : 2;
      for (const MaterialId m : face.Materials)
      {
        pieces.push_back(
          { IsBorder(m) ? this->Outside : m, face.Vertices[(own + 1) % 3], face.Vertices[(own + 2) % 3] });
      }
    }
  }

  /// Calls body(v, pieces, found) for every vertex; returns what it found, in the order of the vertices.
  template <typename T, typename Body>
  std::vector<T> Collect(const std::vector<InterfaceTriangle>& faces, Body&& body) const
  {
    constexpr Index chunk = 2048;
    return ParallelCollect<T>((this->Vertices() + chunk - 1) / chunk,
      [&](Index c, std::vector<T>& found)
      {
        std::vector<FanPiece> pieces;
        for (Index v = c * chunk; v < std::min(this->Vertices(), (c + 1) * chunk); ++v)
        {
          this->Pieces(faces, v, pieces);
          body(v, pieces, found);
        }
      });
  }
};
}

std::vector<Edge> NonManifoldEdges(const std::vector<InterfaceTriangle>& faces, MaterialId outside)
{
  return VertexFaces(faces, outside)
    .Collect<Edge>(faces,
      [](Index v, const std::vector<FanPiece>& pieces, std::vector<Edge>& found)
      {
        const std::size_t before = found.size();
        ForTiedEdges(pieces,
          [&](Index other)
          {
            if (other > v && std::find(found.begin() + before, found.end(), Edge(v, other)) == found.end())
            {
              found.emplace_back(v, other);
            }
          });
        std::sort(found.begin() + before, found.end());
      });
}

std::vector<Index> NonManifoldVertices(const std::vector<InterfaceTriangle>& faces, MaterialId outside)
{
  return VertexFaces(faces, outside)
    .Collect<Index>(faces,
      [](Index v, std::vector<FanPiece>& pieces, std::vector<Index>& found)
      {
        if (ExtraFans(pieces) > 0)
        {
          found.push_back(v);
        }
      });
}

void MakeManifold(const std::vector<Particle>& particles, const Tetrahedralization& tetrahedra, MaterialId outside,
  const std::vector<char>& core, TetraLabels& labels)
{
  const std::vector<InterfaceTriangle> faces = InterfaceFaces(particles, tetrahedra, labels, outside);
  std::vector<Index> faulty = VertexFaces(faces, outside)
                                .Collect<Index>(faces,
                                  [&core](Index v, std::vector<FanPiece>& pieces, std::vector<Index>& found)
                                  {
                                    if ((core.empty() || core[v]) && ExtraFans(pieces) + TiedEdges(pieces) > 0)
                                    {
                                      found.push_back(v);
                                    }
                                  });
  if (faulty.empty())
  {
    return;
  }
  Untying untying(particles, tetrahedra, outside, labels);
  for (int round = 0; round < MostRounds && !faulty.empty(); ++round)
  {
    for (const Index vertex : faulty)
    {
      untying.Mend(vertex);
    }
    faulty = untying.FaultyNear(faulty);
  }
}
}
