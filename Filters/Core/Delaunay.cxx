// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay.h"

#include "TetGenRun.h"

#define TETLIBRARY
#include <tetgen.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
bool SpansSpace(const std::vector<Vec3>& points)
{
  // TetGen prints and throws on planar input; four points that span a volume are all that is asked for.
  std::size_t n = 1;
  const auto next = [&](auto&& independent)
  {
    while (n < points.size() && !independent(points[n] - points[0]))
    {
      ++n;
    }
    return n < points.size();
  };
  Vec3 first, normal;
  return points.size() >= 4 &&
    next(
      [&](const Vec3& v)
      {
        first = v;
        return v.squaredNorm() > 0;
      }) &&
    next(
      [&](const Vec3& v)
      {
        normal =
          Vec3(first[1] * v[2] - first[2] * v[1], first[2] * v[0] - first[0] * v[2], first[0] * v[1] - first[1] * v[0]);
        return normal.squaredNorm() > 1e-24 * first.squaredNorm() * v.squaredNorm();
      }) &&
    next([&](const Vec3& v) { return std::abs(normal.dot(v)) > 1e-12 * normal.norm() * v.norm(); });
}
}

Tetrahedralization DelaunayTetrahedra(const std::vector<Vec3>& points)
{
  Tetrahedralization result;
  if (!SpansSpace(points))
  {
    return result;
  }
  if (points.size() > std::size_t(std::numeric_limits<int>::max() / 16))
  {
    throw std::runtime_error("too many points for TetGen: " + std::to_string(points.size()));
  }
  tetgenio input, output;
  input.numberofpoints = int(points.size());
  input.pointlist = new REAL[3 * points.size()];
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    for (int a = 0; a < 3; ++a)
    {
      input.pointlist[3 * n + a] = points[n][a];
    }
  }
  // Q quiet, n neighbours, N F: no copies of points and faces.
  RunTetGen("QnNF", input, output, "tetrahedralise " + std::to_string(points.size()) + " points");
  result.Corners.resize(output.numberoftetrahedra);
  result.Neighbors.resize(output.numberoftetrahedra);
  for (int t = 0; t < output.numberoftetrahedra; ++t)
  {
    for (int c = 0; c < 4; ++c)
    {
      result.Corners[t][c] = output.tetrahedronlist[t * output.numberofcorners + c];
      result.Neighbors[t][c] = output.neighborlist[4 * t + c];
    }
  }
  return result;
}
}
