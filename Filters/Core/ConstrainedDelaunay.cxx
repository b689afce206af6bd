// SPDX-License-Identifier: BSD-3-Clause
#include "ConstrainedDelaunay.h"

#include "NeighborGrid.h"
#include "Parallel.h"
#include "TetGenRun.h"
#include "TetraLabeling.h"
#include "TriangleDistance.h"

#define TETLIBRARY
#include <tetgen.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
using Tetra = std::array<std::int32_t, 4>;

/// The face opposite each corner, its normal outward where the tetrahedron is positively oriented.
constexpr int FaceCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

/// The interface triangles by their corners: which of them a face of a tetrahedron is.
class TriangleLookup
{
public:
  TriangleLookup(const std::vector<TriangleCorners>& triangles, Index points)
    : Triangles(triangles)
    , Starts(points + 1, 0)
  {
    for (const TriangleCorners& t : triangles)
    {
      ++this->Starts[*std::min_element(t.begin(), t.end()) + 1];
    }
    for (Index p = 0; p < points; ++p)
    {
      this->Starts[p + 1] += this->Starts[p];
    }
    this->Ids.resize(triangles.size());
    std::vector<Index> next(this->Starts.begin(), this->Starts.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      this->Ids[next[*std::min_element(triangles[t].begin(), triangles[t].end())]++] = Index(t);
    }
  }

  /// The triangle with these corners, -1: none; `same` tells whether it goes around the same way.
  Index Find(std::array<Index, 3> face, bool& same) const
  {
    const auto smallest = std::min_element(face.begin(), face.end());
    const Index points = Index(this->Starts.size()) - 1;
    if (*std::max_element(face.begin(), face.end()) >= points)
    {
      return -1;
    }
    std::rotate(face.begin(), smallest, face.end());
    for (Index n = this->Starts[face[0]]; n < this->Starts[face[0] + 1]; ++n)
    {
      TriangleCorners t = this->Triangles[this->Ids[n]];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      same = t[1] == face[1] && t[2] == face[2];
      if (same || (t[1] == face[2] && t[2] == face[1]))
      {
        return this->Ids[n];
      }
    }
    return -1;
  }

private:
  const std::vector<TriangleCorners>& Triangles;
  std::vector<Index> Starts; // by the smallest corner
  std::vector<Index> Ids;
};

/// All that TetGen made, the outside included.
struct Filling
{
  std::vector<Vec3> Points;
  std::vector<Tetra> Corners;   ///< positively oriented
  std::vector<Tetra> Neighbors; ///< opposite each corner, -1: none
  std::vector<MaterialId> Materials;
};

/// The numbers of vertices among those that a triangle has, -1: none has it.
std::vector<Index> NumbersOfUsed(const InterfaceMesh& mesh)
{
  std::vector<Index> numbers(mesh.Vertices.size(), -1);
  for (const InterfaceTriangle& triangle : mesh.Triangles)
  {
    for (const Index v : triangle.Vertices)
    {
      numbers[v] = 0;
    }
  }
  Index used = 0;
  for (Index& number : numbers)
  {
    number = number == 0 ? used++ : -1;
  }
  return numbers;
}

/// The interface as TetGen and the checks see it: only the points that a triangle has.
struct Boundary
{
  std::vector<Vec3> Points;
  std::vector<TriangleCorners> Triangles;
  std::vector<std::array<MaterialId, 2>> Materials;

  explicit Boundary(const InterfaceMesh& mesh)
  {
    const std::vector<Index> numbers = NumbersOfUsed(mesh);
    for (std::size_t v = 0; v < numbers.size(); ++v)
    {
      if (numbers[v] >= 0)
      {
        this->Points.push_back(mesh.Vertices[v].Position);
      }
    }
    for (const InterfaceTriangle& triangle : mesh.Triangles)
    {
      const auto& v = triangle.Vertices;
      this->Triangles.push_back({ numbers[v[0]], numbers[v[1]], numbers[v[2]] });
      this->Materials.push_back(triangle.Materials);
    }
  }
};

/// TetGen crashes where triangles cut each other, or have no area.
void RequireNoCuts(const Boundary& boundary)
{
  const SelfIntersections cuts = FindSelfIntersections(boundary.Points, boundary.Triangles);
  if (!cuts.Pairs.empty() || cuts.WithoutArea > 0)
  {
    throw std::runtime_error("The interface cannot be filled with tetrahedra: " + std::to_string(cuts.Pairs.size()) +
      " pairs of its triangles cut each other, and " + std::to_string(cuts.WithoutArea) +
      " have no area. A smaller Epsilon, FeatureSizeFloor or MinimumLength may help; the mesh without tetrahedra is of "
      "use all the same.");
  }
}

void SetPoints(const std::vector<Vec3>& points, tetgenio& io)
{
  io.numberofpoints = int(points.size());
  io.pointlist = new REAL[3 * points.size()];
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    std::copy(points[n].data(), points[n].data() + 3, io.pointlist + 3 * n);
  }
}

void SetFacets(const std::vector<TriangleCorners>& triangles, tetgenio& io)
{
  io.numberoffacets = int(triangles.size());
  io.facetlist = new tetgenio::facet[triangles.size()];
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    tetgenio::facet& facet = io.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    std::copy(triangles[t].begin(), triangles[t].end(), facet.polygonlist->vertexlist);
  }
}

double SignedVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

Filling Tetrahedralize(const Boundary& boundary, const std::vector<Vec3>& inside, const TetraOptions& options)
{
  std::vector<Vec3> points = boundary.Points;
  points.insert(points.end(), inside.begin(), inside.end());
  if (std::max(points.size(), boundary.Triangles.size()) > std::size_t(std::numeric_limits<int>::max() / 16))
  {
    throw std::runtime_error("too many points for TetGen: " + std::to_string(points.size()));
  }
  // p the triangles as constraints, Y none of them divided, M none merged with others in its plane, J no point dropped,
  // c the space around kept (what is outside is found out by ourselves), n neighbours, N F no copies, Q quiet.
  std::string switches = "pYMJcnFQ";
  if (options.Refine)
  {
    switches += "q" + std::to_string(options.RadiusEdgeRatio) + "/" + std::to_string(options.MinimumDihedral);
  }
  tetgenio input, output;
  SetPoints(points, input);
  SetFacets(boundary.Triangles, input);
  RunTetGen(switches, input, output,
    "fill " + std::to_string(boundary.Triangles.size()) + " interface triangles with tetrahedra");
  Filling filling;
  filling.Points = std::move(points);
  for (int p = int(filling.Points.size()); p < output.numberofpoints; ++p)
  {
    filling.Points.emplace_back(output.pointlist[3 * p], output.pointlist[3 * p + 1], output.pointlist[3 * p + 2]);
  }
  filling.Corners.resize(output.numberoftetrahedra);
  filling.Neighbors.resize(output.numberoftetrahedra);
  for (int t = 0; t < output.numberoftetrahedra; ++t)
  {
    std::copy_n(output.tetrahedronlist + Index(t) * output.numberofcorners, 4, filling.Corners[t].begin());
    std::copy_n(output.neighborlist + 4 * Index(t), 4, filling.Neighbors[t].begin());
  }
  return filling;
}

/// Gives each tetrahedron its material: what its interface faces say, spread across all other faces. Throws where faces
/// contradict each other or a triangle is missing.
void FindMaterials(const Boundary& boundary, MaterialId background, Filling& filling)
{
  const TriangleLookup lookup(boundary.Triangles, Index(boundary.Points.size()));
  const Index count = Index(filling.Corners.size());
  std::vector<std::array<std::int32_t, 4>> triangleOf(count, { -1, -1, -1, -1 });
  filling.Materials.assign(count, NoMaterial);
  std::vector<char> contradicts(count, 0);
  ParallelFor(0, count, 4096,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        for (int f = 0; f < 4; ++f)
        {
          const Tetra& c = filling.Corners[t];
          bool same = false;
          const auto& face = FaceCorners[f];
          const Index triangle = lookup.Find({ c[face[0]], c[face[1]], c[face[2]] }, same);
          triangleOf[t][f] = std::int32_t(triangle);
          if (triangle >= 0)
          {
            // Outward from the tetrahedron and from the first material into the second: it lies in the first.
            const MaterialId m = boundary.Materials[triangle][same ? 0 : 1];
            contradicts[t] |= filling.Materials[t] != NoMaterial && filling.Materials[t] != m;
            filling.Materials[t] = m;
          }
        }
      }
    });
  std::vector<char> seen(boundary.Triangles.size(), 0);
  std::vector<Index> queue;
  Index contradictions = std::count(contradicts.begin(), contradicts.end(), 1);
  for (Index t = 0; t < count; ++t)
  {
    for (const std::int32_t triangle : triangleOf[t])
    {
      if (triangle >= 0)
      {
        seen[triangle] = 1;
      }
    }
    if (filling.Materials[t] != NoMaterial)
    {
      queue.push_back(t);
    }
  }
  for (std::size_t n = 0; n < queue.size(); ++n)
  {
    const Index t = queue[n];
    for (int f = 0; f < 4; ++f)
    {
      const std::int32_t next = filling.Neighbors[t][f];
      if (next < 0 || triangleOf[t][f] >= 0)
      {
        continue;
      }
      if (filling.Materials[next] == NoMaterial)
      {
        filling.Materials[next] = filling.Materials[t];
        queue.push_back(next);
      }
      contradictions += filling.Materials[next] != filling.Materials[t];
    }
  }
  const Index missing = std::count(seen.begin(), seen.end(), 0);
  if (missing > 0 || contradictions > 0)
  {
    throw std::runtime_error("The tetrahedra do not conform to the interface: " + std::to_string(missing) +
      " of its triangles are no faces of theirs, and " + std::to_string(contradictions) +
      " tetrahedra lie in two materials. Label Mesh Report tells what is wrong with the mesh without tetrahedra.");
  }
  std::replace(filling.Materials.begin(), filling.Materials.end(), background, NoMaterial);
}

/// Whether x can be seen from tetrahedron t without leaving its material: a walk through the faces on the way.
bool InSameMaterial(const Filling& filling, Index t, const Vec3& x)
{
  constexpr int longest = 100;
  for (int step = 0; step < longest; ++step)
  {
    const Tetra& c = filling.Corners[t];
    int leaves = -1;
    double farthest = 0.0;
    for (int f = 0; f < 4; ++f)
    {
      const auto& face = FaceCorners[f];
      const Vec3 &p = filling.Points[c[face[0]]], &q = filling.Points[c[face[1]]], &r = filling.Points[c[face[2]]];
      const double beyond = (q - p).cross(r - p).normalized().dot(x - p);
      if (beyond > farthest)
      {
        farthest = beyond;
        leaves = f;
      }
    }
    if (leaves < 0)
    {
      return true;
    }
    const Index next = filling.Neighbors[t][leaves];
    if (next < 0 || filling.Materials[next] != filling.Materials[t])
    {
      return false;
    }
    t = next;
  }
  return false;
}

/// The circumcentres of the slivers, those inside their material and away from its boundary and from each other.
std::vector<InnerPoint> SliverCentres(
  const Filling& filling, const TriangleDistance& boundary, const TetraOptions& options)
{
  std::vector<InnerPoint> centres;
  NeighborGrid found;
  for (Index t = 0; t < Index(filling.Corners.size()); ++t)
  {
    if (filling.Materials[t] == NoMaterial)
    {
      continue;
    }
    std::array<Vec3, 4> x;
    for (int n = 0; n < 4; ++n)
    {
      x[n] = filling.Points[filling.Corners[t][n]];
    }
    if (TetraRadiusRatio(x[0], x[1], x[2], x[3]) >= SliverRatio)
    {
      continue;
    }
    InnerPoint centre;
    centre.Position = Circumcentre(x[0], x[1], x[2], x[3]);
    centre.TargetLength = (centre.Position - x[0]).norm();
    if (InSameMaterial(filling, t, centre.Position) &&
      !boundary.IsNearer(centre.Position, options.LeastDistance * centre.TargetLength) &&
      !found.AnyScaled(centre.Position, centre.TargetLength, options.LeastDistance, [](Index, double) { return true; }))
    {
      centres.push_back(centre);
      found.Insert(centre.Position, centre.TargetLength);
    }
  }
  return centres;
}

/// Only what is inside materials, and the points that it has.
TetraMesh WithoutOutside(const Filling& filling, Index surfacePoints)
{
  TetraMesh mesh;
  mesh.SurfacePoints = surfacePoints;
  std::vector<std::int32_t> numbers(filling.Points.size(), -1);
  for (std::size_t t = 0; t < filling.Corners.size(); ++t)
  {
    if (filling.Materials[t] != NoMaterial)
    {
      mesh.Corners.push_back(filling.Corners[t]);
      mesh.Materials.push_back(filling.Materials[t]);
      for (const std::int32_t c : filling.Corners[t])
      {
        numbers[c] = 0;
      }
    }
  }
  for (std::size_t p = 0; p < filling.Points.size(); ++p)
  {
    if (Index(p) < surfacePoints || numbers[p] == 0)
    {
      numbers[p] = std::int32_t(mesh.Points.size());
      mesh.Points.push_back(filling.Points[p]);
    }
  }
  for (Tetra& corners : mesh.Corners)
  {
    for (std::int32_t& c : corners)
    {
      c = numbers[c];
    }
  }
  return mesh;
}

void CheckVolumes(const TetraMesh& mesh)
{
  Index flat = 0;
  for (const Tetra& c : mesh.Corners)
  {
    flat += !(SignedVolume(mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]], mesh.Points[c[3]]) > 0.0);
  }
  if (flat > 0)
  {
    throw std::runtime_error(std::to_string(flat) + " tetrahedra have no volume.");
  }
}
}

TetraResult FillWithTetrahedra(const InterfaceMesh& surface, MaterialId background,
  const std::vector<InnerPoint>& inside, const TetraOptions& options, const Monitor& monitor)
{
  TetraResult result;
  const Boundary boundary(surface);
  if (boundary.Triangles.empty())
  {
    return result;
  }
  monitor.Step(0.0, "Filling with tetrahedra");
  RequireNoCuts(boundary);
  const TriangleDistance distance(boundary.Points, boundary.Triangles);
  std::vector<char> tooNear(inside.size(), 0);
  ParallelFor(0, Index(inside.size()), 256,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        tooNear[n] = distance.IsNearer(inside[n].Position, options.LeastDistance * inside[n].TargetLength);
      }
    });
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < inside.size(); ++n)
  {
    if (!tooNear[n])
    {
      points.push_back(inside[n].Position);
    }
  }
  result.LeftOut = Index(inside.size() - points.size());
  Filling filling;
  for (int round = 0; round <= options.RefinementRounds; ++round)
  {
    monitor.Step(0.1 + 0.9 * round / (options.RefinementRounds + 1), "Filling with tetrahedra");
    filling = Tetrahedralize(boundary, points, options);
    FindMaterials(boundary, background, filling);
    const std::vector<InnerPoint> centres =
      round < options.RefinementRounds ? SliverCentres(filling, distance, options) : std::vector<InnerPoint>();
    if (centres.empty())
    {
      break;
    }
    result.Inserted += Index(centres.size());
    for (const InnerPoint& centre : centres)
    {
      points.push_back(centre.Position);
    }
  }
  result.Added = Index(filling.Points.size() - boundary.Points.size() - points.size());
  result.Mesh = WithoutOutside(filling, Index(boundary.Points.size()));
  CheckVolumes(result.Mesh);
  monitor.Step(1.0);
  return result;
}

void TakePositions(const TetraMesh& tetrahedra, InterfaceMesh& surface)
{
  const std::vector<Index> numbers = NumbersOfUsed(surface);
  for (std::size_t v = 0; v < numbers.size(); ++v)
  {
    if (numbers[v] >= 0)
    {
      surface.Vertices[v].Position = tetrahedra.Points[numbers[v]];
    }
  }
}
}
