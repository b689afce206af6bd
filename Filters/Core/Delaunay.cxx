// SPDX-License-Identifier: BSD-3-Clause
#include "Delaunay.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace LabelMesh
{
namespace
{
constexpr std::size_t PointsPerStep = 4096; // a few milliseconds: how long an abort may wait

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Cells = CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>,
  CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Cells>;

using NumberedPoint = std::pair<Point, std::int32_t>;

/// Random rounds, each along a space-filling curve.
void OrderForInsertion(std::vector<NumberedPoint>& points)
{
  using Positions = CGAL::First_of_pair_property_map<NumberedPoint>;
  CGAL::spatial_sort(points.begin(), points.end(), CGAL::Spatial_sort_traits_adapter_3<Kernel, Positions>(Positions()));
}

void Insert(std::vector<NumberedPoint> points, const Monitor& monitor, Triangulation& triangulation)
{
  OrderForInsertion(points);
  Triangulation::Cell_handle near; // the last point's: the walk to the next one starts there
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    if (n % PointsPerStep == 0)
    {
      monitor.Step(double(n) / double(points.size()));
    }
    const auto before = triangulation.number_of_vertices();
    const Triangulation::Vertex_handle vertex = triangulation.insert(points[n].first, near);
    if (triangulation.number_of_vertices() > before) // otherwise it coincides with another one
    {
      vertex->info() = points[n].second;
    }
    near = vertex->cell();
  }
}
}

Tetrahedralization DelaunayTetrahedra(const std::vector<Vec3>& points, const Monitor& monitor)
{
  // A point has about 6.8 tetrahedra, which have numbers of 32 bits.
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 16;
  if (points.size() > most)
  {
    throw std::runtime_error("cannot tetrahedralise " + std::to_string(points.size()) + " points: the most are " +
      std::to_string(most) + "; make the target lengths larger");
  }
  std::vector<NumberedPoint> numbered;
  numbered.reserve(points.size());
  for (const Vec3& x : points)
  {
    numbered.emplace_back(Point(x[0], x[1], x[2]), std::int32_t(numbered.size()));
  }
  Triangulation triangulation;
  Insert(std::move(numbered), monitor, triangulation);
  Tetrahedralization result;
  if (triangulation.dimension() < 3)
  {
    return result;
  }
  for (const Triangulation::Cell_handle cell : triangulation.all_cell_handles())
  {
    cell->info() = triangulation.is_infinite(cell) ? -1 : std::int32_t(result.Corners.size());
    if (cell->info() >= 0)
    {
      result.Corners.push_back(
        { cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info() });
    }
  }
  result.Neighbors.reserve(result.Corners.size());
  for (const Triangulation::Cell_handle cell : triangulation.finite_cell_handles())
  {
    result.Neighbors.push_back(
      { cell->neighbor(0)->info(), cell->neighbor(1)->info(), cell->neighbor(2)->info(), cell->neighbor(3)->info() });
  }
  return result;
}
}
