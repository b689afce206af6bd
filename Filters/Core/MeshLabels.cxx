// SPDX-License-Identifier: BSD-3-Clause
#include "MeshLabels.h"

#include "ExactPredicates.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace LabelMesh
{
namespace
{
constexpr Index ChunkSize = 4096; // triangles that a thread does at a time

/// Where the ray through the voxels (i, j, *) meets a triangle.
struct Crossing
{
  int Column = 0; ///< i
  Index Row = 0;  ///< j
  double Height = 0.0;
  std::array<MaterialId, 2> Materials{ NoMaterial, NoMaterial };

  bool operator<(const Crossing& other) const
  {
    return std::tie(this->Row, this->Column, this->Height, this->Materials) <
      std::tie(other.Row, other.Column, other.Height, other.Materials);
  }
};

/// On which side of the edge the ray passes, seen along z. Where it would meet the edge, it is moved by a little in x
/// and by much less in y: zero is left only for an edge along the ray.
int SideOfEdge(const Vec3& from, const Vec3& to, const Vec3& ray)
{
  if (const int side = Orientation(from, to, ray, 0, 1))
  {
    return side;
  }
  if (from[1] != to[1])
  {
    return from[1] > to[1] ? 1 : -1;
  }
  return from[0] == to[0] ? 0 : (to[0] > from[0] ? 1 : -1);
}

bool Crosses(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& ray)
{
  const int side = SideOfEdge(a, b, ray);
  return side != 0 && SideOfEdge(b, c, ray) == side && SideOfEdge(c, a, ray) == side;
}

/// The height of the triangle's plane over a point, kept within the triangle's own heights where it is steep.
double HeightAt(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y)
{
  const auto area = [x, y](const Vec3& p, const Vec3& q) { return (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x); };
  const double ofA = area(b, c), ofB = area(c, a), ofC = area(a, b);
  const double low = std::min({ a[2], b[2], c[2] }), high = std::max({ a[2], b[2], c[2] });
  const double sum = ofA + ofB + ofC;
  return sum == 0.0 ? low : std::clamp((ofA * a[2] + ofB * b[2] + ofC * c[2]) / sum, low, high);
}

/// The crossings of a triangle with the rays of the volume.
void Cross(const std::array<int, 3>& dims, const std::vector<Vec3>& points, const InterfaceTriangle& triangle,
  std::vector<Crossing>& found)
{
  const Vec3 &a = points[triangle.Vertices[0]], &b = points[triangle.Vertices[1]], &c = points[triangle.Vertices[2]];
  if (triangle.Materials[0] == triangle.Materials[1] || !(a.allFinite() && b.allFinite() && c.allFinite()))
  {
    return;
  }
  std::array<int, 2> first{}, last{};
  for (int axis = 0; axis < 2; ++axis)
  {
    const double low = std::min({ a[axis], b[axis], c[axis] }), high = std::max({ a[axis], b[axis], c[axis] });
    first[axis] = int(std::ceil(std::max(low, 0.0)));
    last[axis] = int(std::floor(std::min(high, double(dims[axis] - 1))));
    if (high < 0.0 || low > dims[axis] - 1)
    {
      return;
    }
  }
  for (int j = first[1]; j <= last[1]; ++j)
  {
    for (int i = first[0]; i <= last[0]; ++i)
    {
      if (Crosses(a, b, c, Vec3(i, j, 0)))
      {
        found.push_back({ i, j, HeightAt(a, b, c, i, j), triangle.Materials });
      }
    }
  }
}

/// The materials that are inside at some height: one in a sound mesh.
class InsideSet
{
public:
  explicit InsideSet(MaterialId background) { this->Ids.push_back(background); }

  void Toggle(MaterialId id)
  {
    const auto at = std::find(this->Ids.begin(), this->Ids.end(), id);
    if (at == this->Ids.end())
    {
      this->Ids.push_back(id);
    }
    else
    {
      this->Ids.erase(at);
    }
  }
  MaterialId Only() const { return this->Ids.size() == 1 ? this->Ids[0] : NoMaterial; }

private:
  std::vector<MaterialId> Ids;
};
}

std::vector<MaterialId> LabelsByMesh(const std::array<int, 3>& dims, const std::vector<Vec3>& points,
  const std::vector<InterfaceTriangle>& triangles, MaterialId background)
{
  std::vector<Crossing> crossings = ParallelCollect<Crossing>((Index(triangles.size()) + ChunkSize - 1) / ChunkSize,
    [&](Index chunk, std::vector<Crossing>& found)
    {
      for (Index t = chunk * ChunkSize; t < std::min(Index(triangles.size()), (chunk + 1) * ChunkSize); ++t)
      {
        Cross(dims, points, triangles[t], found);
      }
    });
  std::sort(crossings.begin(), crossings.end());
  const Index slice = Index(dims[0]) * dims[1];
  std::vector<MaterialId> ids(static_cast<std::size_t>(slice * dims[2]), background);
  ParallelFor(0, dims[1], 1,
    [&](Index firstRow, Index lastRow)
    {
      const auto startOf = [&](Index row)
      {
        return std::lower_bound(
          crossings.begin(), crossings.end(), row, [](const Crossing& crossing, Index r) { return crossing.Row < r; });
      };
      const auto end = startOf(lastRow);
      for (auto first = startOf(firstRow), last = first; first != end; first = last)
      {
        InsideSet inside(background);
        MaterialId* voxel = ids.data() + first->Column + Index(dims[0]) * first->Row;
        Index height = 0;
        const auto fill = [&](double to)
        {
          for (; height < dims[2] && double(height) < to; ++height)
          {
            voxel[height * slice] = inside.Only();
          }
        };
        for (; last != end && last->Row == first->Row && last->Column == first->Column; ++last)
        {
          fill(last->Height);
          inside.Toggle(last->Materials[0]);
          inside.Toggle(last->Materials[1]);
        }
        fill(std::numeric_limits<double>::infinity());
      }
    });
  return ids;
}

namespace
{
/// The search for the nearest face of voxels.
class FaceSearch
{
public:
  explicit FaceSearch(const LabelVoxels& voxels)
    : Voxels(voxels)
    , Step(voxels.Spacing.minCoeff())
    , Reach(VoxelSearchRadius * std::cbrt(voxels.Spacing.prod()))
  {
  }

  double Distance(const Vec3& x, const MaterialSet& materials) const
  {
    // A box of voxels around the point that holds every face nearer than `radius`.
    for (double radius = this->Step;; radius = std::min(2.0 * radius, this->Reach))
    {
      const double squared = this->NearestInBox(x, materials, radius);
      if (squared <= radius * radius)
      {
        return std::sqrt(squared);
      }
      if (radius >= this->Reach)
      {
        return std::numeric_limits<double>::quiet_NaN();
      }
    }
  }

private:
  MaterialId IdAt(const std::array<int, 3>& v) const
  {
    for (int a = 0; a < 3; ++a)
    {
      if (v[a] < 0 || v[a] >= this->Voxels.Dims[a])
      {
        return this->Voxels.Background;
      }
    }
    return this->Voxels.Ids[v[0] + Index(this->Voxels.Dims[0]) * (v[1] + Index(this->Voxels.Dims[1]) * v[2])];
  }

  double NearestInBox(const Vec3& x, const MaterialSet& materials, double radius) const
  {
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < 3; ++a)
    {
      // The faces of a voxel are half a voxel from its centre; one layer of outside is enough.
      const double reach = radius / this->Voxels.Spacing[a] + 0.5;
      low[a] = int(std::clamp(std::floor(x[a] - reach), -1.0, double(this->Voxels.Dims[a])));
      high[a] = int(std::clamp(std::ceil(x[a] + reach), -1.0, double(this->Voxels.Dims[a])));
    }
    double nearest = std::numeric_limits<double>::infinity();
    std::array<int, 3> v{};
    for (v[2] = low[2]; v[2] <= high[2]; ++v[2])
    {
      for (v[1] = low[1]; v[1] <= high[1]; ++v[1])
      {
        for (v[0] = low[0]; v[0] <= high[0]; ++v[0])
        {
          const MaterialId id = this->IdAt(v);
          if (materials.Contains(id))
          {
            nearest = std::min(nearest, this->NearestOfVoxel(x, materials, v, id, nearest));
          }
        }
      }
    }
    return nearest;
  }

  /// The squared distance to the faces between a voxel and the next ones along each axis.
  double NearestOfVoxel(
    const Vec3& x, const MaterialSet& materials, const std::array<int, 3>& v, MaterialId id, double nearest) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::array<int, 3> next = v;
      ++next[axis];
      const MaterialId other = this->IdAt(next);
      if (other == id || !materials.Contains(other))
      {
        continue;
      }
      double squared = 0.0;
      for (int a = 0; a < 3; ++a)
      {
        const double along = x[a] - v[a];
        const double beyond = a == axis ? along - 0.5 : std::max(std::abs(along) - 0.5, 0.0);
        squared += beyond * beyond * this->Voxels.Spacing[a] * this->Voxels.Spacing[a];
      }
      nearest = std::min(nearest, squared);
    }
    return nearest;
  }

  LabelVoxels Voxels;
  double Step, Reach; // world lengths
};
}

std::vector<double> DistancesToVoxels(
  const LabelVoxels& voxels, const std::vector<Vec3>& points, const std::vector<InterfaceTriangle>& triangles)
{
  std::vector<MaterialSet> sets(points.size());
  for (const InterfaceTriangle& triangle : triangles)
  {
    for (const Index v : triangle.Vertices)
    {
      sets[v].Insert(triangle.Materials[0]);
      sets[v].Insert(triangle.Materials[1]);
    }
  }
  const FaceSearch search(voxels);
  std::vector<double> distances(points.size(), std::numeric_limits<double>::quiet_NaN());
  ParallelFor(0, Index(points.size()), 0,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        if (sets[n].Size() > 1 && points[n].allFinite())
        {
          distances[n] = search.Distance(points[n], sets[n]);
        }
      }
    });
  return distances;
}
}
