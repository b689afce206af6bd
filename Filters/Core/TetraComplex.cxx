// SPDX-License-Identifier: BSD-3-Clause
#include "TetraComplex.h"

#include "Parallel.h"
#include "TetraQuality.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
constexpr TetraCorners Dead = { -1, -1, -1, -1 };

FaceCorners Sorted(FaceCorners face)
{
  std::sort(face.begin(), face.end());
  return face;
}
}

TetraComplex::TetraComplex(TetraMesh mesh)
  : Mesh(std::move(mesh))
{
  this->Qualities.resize(this->Mesh.Corners.size());
  ParallelFor(0, this->Size(), 4096,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        this->Qualities[t] = this->QualityOf(this->Mesh.Corners[t]);
      }
    });
  this->Incident.assign(this->Mesh.Points.size(), -1);
  for (Index t = 0; t < this->Size(); ++t)
  {
    for (const std::int32_t v : this->Mesh.Corners[t])
    {
      this->Incident[v] = std::int32_t(t);
    }
  }
  this->LinkFaces();
}

void TetraComplex::LinkFaces()
{
  // Each face is kept with its first vertex, and looked for among that vertex's faces.
  std::vector<Index> begin(this->Mesh.Points.size() + 1, 0);
  const auto eachFace = [this](auto&& visit)
  {
    for (Index t = 0; t < this->Size(); ++t)
    {
      for (int j = 0; j < 4; ++j)
      {
        visit(Sorted(FaceOpposite(this->Mesh.Corners[t], j)), std::int32_t(4 * t + j));
      }
    }
  };
  eachFace([&](const FaceCorners& face, std::int32_t) { ++begin[face[0] + 1]; });
  for (std::size_t v = 1; v < begin.size(); ++v)
  {
    begin[v] += begin[v - 1];
  }
  std::vector<OpenFace> faces(std::size_t(begin.back()));
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  eachFace([&](const FaceCorners& face, std::int32_t link) { faces[end[face[0]]++] = { face, link }; });

  this->Links.assign(this->Mesh.Corners.size(), Dead);
  ParallelFor(0, this->NumberOfPoints(), 1024,
    [&](Index first, Index last)
    {
      for (Index v = first; v < last; ++v)
      {
        std::sort(faces.begin() + begin[v], faces.begin() + begin[v + 1]);
      }
    });
  for (std::size_t n = 0; n + 1 < faces.size(); ++n)
  {
    if (faces[n].Corners != faces[n + 1].Corners)
    {
      continue;
    }
    if (n + 2 < faces.size() && faces[n + 2].Corners == faces[n].Corners)
    {
      throw std::runtime_error("tetrahedra overlap: three share the face of vertices " +
        std::to_string(faces[n].Corners[0]) + ", " + std::to_string(faces[n].Corners[1]) + " and " +
        std::to_string(faces[n].Corners[2]));
    }
    this->Link(faces[n].Link, faces[n + 1].Link);
  }
}

void TetraComplex::Link(std::int32_t a, std::int32_t b)
{
  if (a >= 0)
  {
    this->Links[a / 4][a % 4] = b;
  }
  if (b >= 0)
  {
    this->Links[b / 4][b % 4] = a;
  }
}

TetraMesh TetraComplex::Compacted() const
{
  TetraMesh result;
  result.SurfacePoints = this->Mesh.SurfacePoints;
  std::vector<std::int32_t> number(this->Mesh.Points.size(), -1);
  for (Index v = 0; v < this->NumberOfPoints(); ++v)
  {
    if (v < this->Mesh.SurfacePoints || this->Incident[v] >= 0)
    {
      number[v] = std::int32_t(result.Points.size());
      result.Points.push_back(this->Mesh.Points[v]);
    }
  }
  for (Index t = 0; t < this->Size(); ++t)
  {
    if (this->IsAlive(t))
    {
      TetraCorners corners = this->Mesh.Corners[t];
      for (std::int32_t& v : corners)
      {
        v = number[v];
      }
      result.Corners.push_back(corners);
      result.Materials.push_back(this->Mesh.Materials[t]);
    }
  }
  return result;
}

double TetraComplex::QualityOf(const TetraCorners& c) const
{
  const auto& x = this->Mesh.Points;
  return TetraQuality(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
}

int TetraComplex::CornerOf(Index t, Index v) const
{
  const TetraCorners& c = this->Mesh.Corners[t];
  const auto at = std::find(c.begin(), c.end(), v);
  return at == c.end() ? -1 : int(at - c.begin());
}

void TetraComplex::Star(Index v, std::vector<std::int32_t>& star) const
{
  star.assign(1, this->Incident[v]);
  for (std::size_t n = 0; n < star.size(); ++n)
  {
    for (int j = 0; j < 4; ++j)
    {
      const std::int32_t next = this->Mesh.Corners[star[n]][j] == v ? -1 : this->Neighbor(star[n], j);
      if (next >= 0 && std::find(star.begin(), star.end(), next) == star.end())
      {
        star.push_back(next);
      }
    }
  }
}

void TetraComplex::EdgeRing(Index t, int i, int j, Ring& ring) const
{
  ring.Tetrahedra.clear();
  ring.Vertices.clear();
  ring.Closed = false;
  // The other two corners, so that (i, j, k, l) is an even permutation.
  constexpr int third[4][4] = { { -1, 2, 3, 1 }, { 3, -1, 0, 2 }, { 1, 3, -1, 0 }, { 2, 0, 1, -1 } };
  const int k = third[i][j];
  const std::int32_t first = this->Mesh.Corners[t][i], second = this->Mesh.Corners[t][j];
  const std::int32_t start = this->Mesh.Corners[t][k];
  std::int32_t back = start; // the vertex opposite the face to leave by
  for (std::int32_t at = std::int32_t(t);;)
  {
    const TetraCorners& c = this->Mesh.Corners[at];
    std::int32_t ahead = -1;
    for (const std::int32_t v : c)
    {
      ahead = v == first || v == second || v == back ? ahead : v;
    }
    ring.Tetrahedra.push_back(at);
    ring.Vertices.push_back(back);
    const std::int32_t next = this->Inside(at, this->CornerOf(at, back));
    if (next < 0)
    {
      return;
    }
    back = ahead;
    at = next;
    if (at == t)
    {
      ring.Closed = true;
      return;
    }
  }
}

std::int32_t TetraComplex::AddPoint(const Vec3& x)
{
  this->Mesh.Points.push_back(x);
  this->Incident.push_back(-1);
  return std::int32_t(this->Mesh.Points.size() - 1);
}

void TetraComplex::DropLastPoint()
{
  this->Mesh.Points.pop_back();
  this->Incident.pop_back();
}

void TetraComplex::MovePoint(Index v, const Vec3& x, const std::vector<std::int32_t>& star)
{
  this->Mesh.Points[v] = x;
  for (const std::int32_t t : star)
  {
    this->Qualities[t] = this->QualityOf(this->Mesh.Corners[t]);
  }
}

bool TetraComplex::MatchFaces(const std::vector<std::int32_t>& removed, const std::vector<TetraCorners>& added)
{
  auto& faces = this->OpenFaces;
  faces.clear();
  const std::int32_t base = std::int32_t(4 * this->Size());
  for (std::size_t n = 0; n < added.size(); ++n)
  {
    for (int j = 0; j < 4; ++j)
    {
      faces.push_back({ Sorted(FaceOpposite(added[n], j)), base + std::int32_t(4 * n) + j });
    }
  }
  for (const std::int32_t t : removed)
  {
    for (int j = 0; j < 4; ++j)
    {
      if (std::find(removed.begin(), removed.end(), this->Neighbor(t, j)) == removed.end())
      {
        faces.push_back({ Sorted(FaceOpposite(this->Mesh.Corners[t], j)), this->Links[t][j] });
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t n = 0; n < faces.size(); n += 2)
  {
    // Two of each, not both of the border.
    if (n + 1 == faces.size() || faces[n].Corners != faces[n + 1].Corners || faces[n + 1].Link < base ||
      (n + 2 < faces.size() && faces[n + 2].Corners == faces[n].Corners))
    {
      return false;
    }
  }
  return true;
}

bool TetraComplex::Replace(const std::vector<std::int32_t>& removed, const std::vector<TetraCorners>& added)
{
  if (!this->MatchFaces(removed, added))
  {
    return false;
  }
  const MaterialId material = this->Mesh.Materials[removed.front()];
  for (const std::int32_t t : removed)
  {
    for (const std::int32_t v : this->Mesh.Corners[t])
    {
      this->Incident[v] = -1;
    }
    this->Mesh.Corners[t] = Dead;
  }
  for (const TetraCorners& corners : added)
  {
    for (const std::int32_t v : corners)
    {
      this->Incident[v] = std::int32_t(this->Size());
    }
    this->Mesh.Corners.push_back(corners);
    this->Mesh.Materials.push_back(material);
    this->Qualities.push_back(this->QualityOf(corners));
    this->Links.push_back(Dead);
  }
  for (std::size_t n = 0; n < this->OpenFaces.size(); n += 2)
  {
    this->Link(this->OpenFaces[n].Link, this->OpenFaces[n + 1].Link);
  }
  return true;
}
}
