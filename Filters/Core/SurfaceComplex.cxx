// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceComplex.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace LabelMesh
{
namespace
{
bool Has(const InterfaceTriangle& triangle, Index v)
{
  return triangle.Vertices[0] == v || triangle.Vertices[1] == v || triangle.Vertices[2] == v;
}

/// The vertex of a triangle that is neither a nor b.
Index Opposite(const InterfaceTriangle& triangle, Index a, Index b)
{
  for (const Index v : triangle.Vertices)
  {
    if (v != a && v != b)
    {
      return v;
    }
  }
  return -1;
}

/// Whether the triangle runs from a to b.
bool RunsFrom(const InterfaceTriangle& triangle, Index a, Index b)
{
  for (int i = 0; i < 3; ++i)
  {
    if (triangle.Vertices[i] == a)
    {
      return triangle.Vertices[(i + 1) % 3] == b;
    }
  }
  return false;
}

/// Whether a vertex may move to where `kept` is along an edge with `triangles` triangles, on a 1-cell or not.
bool MayJoin(const Particle& gone, const Particle& kept, std::size_t triangles, bool isOnCurve)
{
  const bool onSurface = gone.CellDimension == 2 && gone.Materials.Size() == 2 && triangles == 2;
  const bool onCurve = gone.CellDimension == 1 && gone.Materials.Size() == 3 && isOnCurve;
  return (onSurface || onCurve) && kept.CellDimension <= gone.CellDimension &&
    std::all_of(gone.Materials.begin(), gone.Materials.end(), [&](MaterialId m) { return kept.Materials.Contains(m); });
}

/// The sides of a triangle between vertices outside the core, as seen from the smaller material.
void AppendRim(
  const InterfaceTriangle& triangle, const std::vector<Index>& core, std::vector<std::array<Index, 4>>& rim)
{
  const bool turned = triangle.Materials[0] > triangle.Materials[1];
  for (int i = 0; i < 3; ++i)
  {
    const Index a = triangle.Vertices[i], b = triangle.Vertices[(i + 1) % 3];
    if (!std::binary_search(core.begin(), core.end(), a) && !std::binary_search(core.begin(), core.end(), b))
    {
      rim.push_back(
        { turned ? b : a, turned ? a : b, Index(triangle.Materials[turned]), Index(triangle.Materials[!turned]) });
    }
  }
}
}

SurfaceComplex::SurfaceComplex(InterfaceMesh mesh)
  : Vertices(std::move(mesh.Vertices))
  , Triangles(std::move(mesh.Triangles))
  , Stars(this->Vertices.size())
  , Frozen(this->Vertices.size(), 0)
{
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    for (const Index v : this->Triangles[t].Vertices)
    {
      this->Stars[v].push_back(std::int32_t(t));
    }
  }
}

std::vector<std::int32_t> SurfaceComplex::EdgeStar(Index a, Index b) const
{
  std::vector<std::int32_t> star;
  std::copy_if(this->Stars[a].begin(), this->Stars[a].end(), std::back_inserter(star),
    [&](std::int32_t t) { return Has(this->Triangles[t], b); });
  return star;
}

bool SurfaceComplex::IsOnCurve(const std::vector<std::int32_t>& edge) const
{
  if (edge.size() != 2)
  {
    return edge.size() > 2;
  }
  const std::array<MaterialId, 2>&first = this->Triangles[edge[0]].Materials,
                               &second = this->Triangles[edge[1]].Materials;
  return std::minmax(first[0], first[1]) != std::minmax(second[0], second[1]);
}

bool SurfaceComplex::AreJoined(Index a, Index b) const
{
  return std::any_of(
    this->Stars[a].begin(), this->Stars[a].end(), [&](std::int32_t t) { return Has(this->Triangles[t], b); });
}

std::vector<Index> SurfaceComplex::Neighbors(Index v) const
{
  std::vector<Index> neighbors;
  for (const std::int32_t t : this->Stars[v])
  {
    for (const Index other : this->Triangles[t].Vertices)
    {
      if (other != v)
      {
        neighbors.push_back(other);
      }
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

double SurfaceComplex::Ratio(Index t) const
{
  const auto& v = this->Triangles[t].Vertices;
  return RadiusRatio(this->Vertices[v[0]].Position, this->Vertices[v[1]].Position, this->Vertices[v[2]].Position);
}

Vec3 SurfaceComplex::UnitNormal(Index t) const
{
  const auto& v = this->Triangles[t].Vertices;
  const Vec3& a = this->Vertices[v[0]].Position;
  return (this->Vertices[v[1]].Position - a).cross(this->Vertices[v[2]].Position - a).stableNormalized();
}

Index SurfaceComplex::NumberOfFrozen() const
{
  return Index(std::count(this->Frozen.begin(), this->Frozen.end(), char(1)));
}

void SurfaceComplex::SetVertex(Index v, const Particle& particle)
{
  this->Save(v);
  this->Vertices[v] = particle;
}

SurfaceComplex::Flippable SurfaceComplex::FlippableEdge(Index a, Index b) const
{
  Flippable found;
  int count = 0;
  for (const std::int32_t t : this->Stars[a])
  {
    const InterfaceTriangle& triangle = this->Triangles[t];
    if (Has(triangle, b))
    {
      ++count;
      (RunsFrom(triangle, a, b) ? found.First : found.Second) = t;
    }
  }
  if (count != 2 || found.First < 0 || found.Second < 0 || this->Frozen[a] || this->Frozen[b] ||
    this->Triangles[found.First].Materials != this->Triangles[found.Second].Materials)
  {
    return Flippable();
  }
  found.C = Opposite(this->Triangles[found.First], a, b);
  found.D = Opposite(this->Triangles[found.Second], a, b);
  const bool may =
    found.C != found.D && !this->Frozen[found.C] && !this->Frozen[found.D] && !this->AreJoined(found.C, found.D);
  return may ? found : Flippable();
}

bool SurfaceComplex::Flip(Index a, Index b)
{
  const Flippable edge = this->FlippableEdge(a, b);
  if (edge.First < 0)
  {
    return false;
  }
  for (const Index v : { a, b, edge.C, edge.D })
  {
    this->Save(v);
  }
  this->SaveTriangle(edge.First);
  this->SaveTriangle(edge.Second);
  this->Triangles[edge.First].Vertices = { edge.C, a, edge.D };
  this->Triangles[edge.Second].Vertices = { edge.C, edge.D, b };
  this->Leave(b, edge.First);
  this->Leave(a, edge.Second);
  this->Stars[edge.D].push_back(std::int32_t(edge.First));
  this->Stars[edge.C].push_back(std::int32_t(edge.Second));
  return true;
}

bool SurfaceComplex::Collapse(Index gone, Index kept)
{
  const std::vector<std::int32_t> edge = this->EdgeStar(gone, kept);
  if (this->Frozen[gone] || this->Frozen[kept] || edge.empty() ||
    !MayJoin(this->Vertices[gone], this->Vertices[kept], edge.size(), this->IsOnCurve(edge)))
  {
    return false;
  }
  std::vector<Index> opposite;
  for (const std::int32_t t : edge)
  {
    opposite.push_back(Opposite(this->Triangles[t], gone, kept));
  }
  const auto isOpposite = [&](Index v) { return std::find(opposite.begin(), opposite.end(), v) != opposite.end(); };
  for (const Index v : this->Neighbors(gone))
  {
    if (v != kept && !isOpposite(v) && this->AreJoined(v, kept))
    {
      return false;
    }
  }
  for (const Index v : opposite)
  {
    // Two edges of curves would become one.
    if (this->IsOnCurve(this->EdgeStar(gone, v)) && this->IsOnCurve(this->EdgeStar(kept, v)))
    {
      return false;
    }
  }
  for (const std::int32_t t : this->Stars[gone])
  {
    // With both ends opposite it would come to lie on a triangle of `kept`.
    const auto& v = this->Triangles[t].Vertices;
    if (std::count_if(v.begin(), v.end(), isOpposite) == 2)
    {
      return false;
    }
  }
  this->Save(gone);
  this->Save(kept);
  for (const Index v : opposite)
  {
    this->Save(v);
  }
  for (const std::int32_t t : edge)
  {
    this->SaveTriangle(t);
    const auto vertices = this->Triangles[t].Vertices;
    for (const Index v : vertices)
    {
      this->Leave(v, t);
    }
    this->Triangles[t].Vertices = { -1, -1, -1 };
  }
  for (const std::int32_t t : this->Stars[gone])
  {
    this->SaveTriangle(t);
    this->Replace(t, gone, kept);
    this->Stars[kept].push_back(t);
  }
  this->Stars[gone].clear();
  return true;
}

bool SurfaceComplex::Split(Index a, Index b, const Particle& particle)
{
  if (this->Frozen[a] || this->Frozen[b])
  {
    return false;
  }
  const std::vector<std::int32_t> edge = this->EdgeStar(a, b);
  const Index middle = this->AddVertex(particle);
  this->Save(b);
  for (const std::int32_t t : edge)
  {
    const Index c = Opposite(this->Triangles[t], a, b), added = Index(this->Triangles.size());
    this->Save(c);
    this->SaveTriangle(t);
    this->Triangles.push_back(this->Triangles[t]);
    this->Replace(t, b, middle);
    this->Replace(added, a, middle);
    this->Leave(b, t);
    this->Stars[b].push_back(std::int32_t(added));
    this->Stars[c].push_back(std::int32_t(added));
    this->Stars[middle].push_back(t);
    this->Stars[middle].push_back(std::int32_t(added));
  }
  return true;
}

Index SurfaceComplex::AddVertex(const Particle& particle)
{
  this->Vertices.push_back(particle);
  this->Stars.emplace_back();
  this->Frozen.push_back(0);
  return Index(this->Vertices.size()) - 1;
}

std::vector<std::int32_t> SurfaceComplex::TrianglesAt(const std::vector<Index>& vertices) const
{
  std::vector<std::int32_t> triangles;
  for (const Index v : vertices)
  {
    if (v < this->NumberOfVertices())
    {
      triangles.insert(triangles.end(), this->Stars[v].begin(), this->Stars[v].end());
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

bool SurfaceComplex::Fits(const std::vector<Index>& core, const std::vector<InterfaceTriangle>& inserted) const
{
  std::vector<std::array<Index, 4>> before, after;
  for (const std::int32_t t : this->TrianglesAt(core))
  {
    AppendRim(this->Triangles[t], core, before);
  }
  for (const InterfaceTriangle& triangle : inserted)
  {
    AppendRim(triangle, core, after);
  }
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  return before == after;
}

void SurfaceComplex::ReplaceStars(const std::vector<Index>& core, const std::vector<InterfaceTriangle>& inserted)
{
  for (const std::int32_t t : this->TrianglesAt(core))
  {
    this->SaveTriangle(t);
    for (const Index v : this->Triangles[t].Vertices)
    {
      this->Save(v);
      this->Leave(v, t);
    }
    this->Triangles[t].Vertices = { -1, -1, -1 };
  }
  for (const InterfaceTriangle& triangle : inserted)
  {
    for (const Index v : triangle.Vertices)
    {
      this->Save(v);
      this->Stars[v].push_back(std::int32_t(this->Triangles.size()));
    }
    this->Triangles.push_back(triangle);
  }
}

std::vector<InterfaceTriangle> SurfaceComplex::AliveTriangles() const
{
  std::vector<InterfaceTriangle> alive;
  alive.reserve(this->Triangles.size());
  std::copy_if(this->Triangles.begin(), this->Triangles.end(), std::back_inserter(alive),
    [](const InterfaceTriangle& triangle) { return triangle.Vertices[0] >= 0; });
  return alive;
}

void SurfaceComplex::Begin()
{
  this->Recording = true;
  this->VerticesBefore = this->Vertices.size();
  this->TrianglesBefore = this->Triangles.size();
}

void SurfaceComplex::Commit()
{
  this->Recording = false;
  this->SavedVertices.clear();
  this->SavedTriangles.clear();
}

void SurfaceComplex::Rollback()
{
  for (auto saved = this->SavedVertices.rbegin(); saved != this->SavedVertices.rend(); ++saved)
  {
    this->Vertices[saved->Number] = saved->Value;
    this->Stars[saved->Number].swap(saved->Star);
  }
  for (auto saved = this->SavedTriangles.rbegin(); saved != this->SavedTriangles.rend(); ++saved)
  {
    this->Triangles[saved->Number] = saved->Value;
  }
  this->Vertices.resize(this->VerticesBefore);
  this->Stars.resize(this->VerticesBefore);
  this->Frozen.resize(this->VerticesBefore);
  this->Triangles.resize(this->TrianglesBefore);
  this->Commit();
}

InterfaceMesh SurfaceComplex::Compacted() &&
{
  InterfaceMesh mesh;
  std::vector<Index> number(this->Vertices.size(), -1);
  for (std::size_t v = 0; v < this->Vertices.size(); ++v)
  {
    if (!this->Stars[v].empty())
    {
      number[v] = Index(mesh.Vertices.size());
      mesh.Vertices.push_back(this->Vertices[v]);
    }
  }
  for (const InterfaceTriangle& triangle : this->Triangles)
  {
    if (triangle.Vertices[0] >= 0)
    {
      mesh.Triangles.push_back(triangle);
      for (Index& v : mesh.Triangles.back().Vertices)
      {
        v = number[v];
      }
    }
  }
  return mesh;
}

void SurfaceComplex::Save(Index v)
{
  if (this->Recording)
  {
    this->SavedVertices.push_back({ v, this->Vertices[v], this->Stars[v] });
  }
}

void SurfaceComplex::SaveTriangle(Index t)
{
  if (this->Recording)
  {
    this->SavedTriangles.push_back({ t, this->Triangles[t] });
  }
}

void SurfaceComplex::Replace(Index t, Index before, Index after)
{
  auto& vertices = this->Triangles[t].Vertices;
  std::replace(vertices.begin(), vertices.end(), before, after);
}

void SurfaceComplex::Leave(Index v, Index t)
{
  auto& star = this->Stars[v];
  star.erase(std::remove(star.begin(), star.end(), std::int32_t(t)), star.end());
}
}
