// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleDistance.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
std::vector<Box> BoxesOf(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles)
{
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (const Index v : triangles[t])
    {
      boxes[t].Add(points[v]);
    }
  }
  return boxes;
}

double SquaredDistance(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double length = edge.squaredNorm();
  const double t = length > 0.0 ? std::clamp(edge.dot(x - a) / length, 0.0, 1.0) : 0.0;
  return (a + t * edge - x).squaredNorm();
}
}

double SquaredDistance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const bool inside = normal.dot((b - a).cross(x - a)) > 0.0 && normal.dot((c - b).cross(x - b)) > 0.0 &&
    normal.dot((a - c).cross(x - c)) > 0.0;
  if (inside)
  {
    const double height = normal.dot(x - a);
    return height * height / normal.squaredNorm();
  }
  return std::min({ SquaredDistance(x, a, b), SquaredDistance(x, b, c), SquaredDistance(x, c, a) });
}

TriangleDistance::TriangleDistance(const std::vector<Vec3>& points, const std::vector<TriangleCorners>& triangles)
  : Points(points)
  , Triangles(triangles)
  , Tree(BoxesOf(points, triangles))
{
}

bool TriangleDistance::IsNearer(const Vec3& x, double distance) const
{
  Box query;
  query.Add(x - Vec3::Constant(distance));
  query.Add(x + Vec3::Constant(distance));
  bool nearer = false;
  this->Tree.VisitOverlaps(query, 0,
    [&](Index position)
    {
      const TriangleCorners& t = this->Triangles[this->Tree.Number(position)];
      nearer =
        nearer || SquaredDistance(x, this->Points[t[0]], this->Points[t[1]], this->Points[t[2]]) < distance * distance;
    });
  return nearer;
}
}
