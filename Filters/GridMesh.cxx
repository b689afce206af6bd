// SPDX-License-Identifier: BSD-3-Clause
// Stages: pad -> vtkDiscreteMarchingCubes, a surface per label, points merged -> give each triangle its two labels ->
// vtkWindowedSincPolyDataFilter -> vtkQuadricDecimation.
#include "GridMesh.h"

#include "InnerFilter.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDiscreteMarchingCubes.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedShortArray.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace LabelMesh
{
namespace
{
using Triangles = std::vector<InterfaceTriangle>;
using Edge = std::pair<Index, Index>;

/// Ids on a grid of unit spacing whose index is the source's, so that coordinates are exact halves of integers.
vtkSmartPointer<vtkImageData> PaddedIds(const LabelImage& image, MaterialId background)
{
  const std::array<int, 6>& extent = image.Frame.Extent();
  const Lattice inner = image.Frame.Samples();
  const Lattice outer = image.Frame.Grown(1).Samples();
  vtkNew<vtkUnsignedShortArray> ids;
  ids->SetName("Ids");
  ids->SetNumberOfValues(outer.Size());
  std::fill_n(ids->GetPointer(0), outer.Size(), background);
  for (Index k = 0; k < inner.Dims[2]; ++k)
  {
    for (Index j = 0; j < inner.Dims[1]; ++j)
    {
      std::copy_n(image.Ids.begin() + inner.At(0, j, k), inner.Dims[0], ids->GetPointer(outer.At(1, j + 1, k + 1)));
    }
  }
  auto padded = vtkSmartPointer<vtkImageData>::New();
  padded->SetDimensions(outer.Dims.data());
  padded->SetOrigin(extent[0] - 1, extent[2] - 1, extent[4] - 1);
  padded->GetPointData()->SetScalars(ids);
  return padded;
}

/// Each label's own surface against the rest: triangles (label, background).
vtkSmartPointer<vtkPolyData> LabelSurfaces(
  vtkImageData* ids, MaterialId background, int materials, vtkAlgorithm* filter, const Monitor& monitor)
{
  vtkNew<vtkDiscreteMarchingCubes> cubes;
  cubes->SetInputData(ids);
  cubes->ComputeScalarsOn();
  cubes->ComputeNormalsOff();
  cubes->ComputeGradientsOff();
  int value = 0;
  for (int m = 0; m < materials; ++m)
  {
    if (m != background)
    {
      cubes->SetValue(value++, m);
    }
  }
  UpdateInner({ { cubes, "Marching cubes", 1.0 } }, filter, {}, monitor);
  return cubes->GetOutput();
}

std::vector<Vec3> PointsOf(vtkPolyData* mesh)
{
  std::vector<Vec3> points(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh->GetPoint(vtkIdType(i), points[i].data());
  }
  return points;
}

std::vector<std::array<Index, 3>> CellsOf(vtkPolyData* mesh)
{
  std::vector<std::array<Index, 3>> cells;
  vtkIdType size = 0;
  const vtkIdType* v = nullptr;
  vtkCellArray* polys = mesh->GetPolys();
  for (polys->InitTraversal(); polys->GetNextCell(size, v);)
  {
    cells.push_back({ v[0], v[1], v[2] });
  }
  return cells;
}

Triangles OneSidedTriangles(vtkPolyData* surfaces, const std::vector<Vec3>& points, MaterialId background)
{
  Triangles triangles;
  vtkDataArray* ids = surfaces->GetCellData()->GetScalars();
  double volume = 0.0;
  for (const std::array<Index, 3>& v : CellsOf(surfaces))
  {
    const MaterialId inside = MaterialId(ids->GetComponent(Index(triangles.size()), 0));
    triangles.push_back({ v, { inside, background } });
    volume += points[v[0]].dot(points[v[1]].cross(points[v[2]]));
  }
  if (volume < 0) // closed surfaces that face inwards
  {
    for (InterfaceTriangle& t : triangles)
    {
      std::swap(t.Vertices[1], t.Vertices[2]);
    }
  }
  return triangles;
}

/// Connected triangles of one label within one cell of the grid.
struct Patch
{
  MaterialId Inside;
  std::vector<Index> Members;
  std::vector<Edge> Border; ///< sorted; edges that one member has
};

std::vector<Edge> EdgesOf(const InterfaceTriangle& t)
{
  std::vector<Edge> edges;
  for (int c = 0; c < 3; ++c)
  {
    edges.push_back(std::minmax(t.Vertices[c], t.Vertices[(c + 1) % 3]));
  }
  return edges;
}

std::vector<Edge> BorderOf(const std::vector<Index>& members, const Triangles& triangles)
{
  std::map<Edge, int> uses;
  for (const Index t : members)
  {
    for (const Edge& edge : EdgesOf(triangles[t]))
    {
      ++uses[edge];
    }
  }
  std::vector<Edge> border;
  for (const auto& use : uses)
  {
    if (use.second == 1)
    {
      border.push_back(use.first);
    }
  }
  return border;
}

bool ShareAnEdge(const InterfaceTriangle& a, const InterfaceTriangle& b)
{
  return std::count_if(a.Vertices.begin(), a.Vertices.end(),
           [&](Index v) { return std::find(b.Vertices.begin(), b.Vertices.end(), v) != b.Vertices.end(); }) >= 2;
}

/// The patches of the triangles [first, last) of `order`, which lie in one cell.
std::vector<Patch> PatchesOf(const Index* first, const Index* last, const Triangles& triangles)
{
  std::vector<Index> left(first, last);
  std::vector<Patch> patches;
  while (!left.empty())
  {
    Patch patch{ triangles[left.front()].Materials[0], { left.front() }, {} };
    left.erase(left.begin());
    for (std::size_t m = 0; m < patch.Members.size(); ++m)
    {
      for (auto at = left.begin(); at != left.end();)
      {
        const bool joins =
          triangles[*at].Materials[0] == patch.Inside && ShareAnEdge(triangles[*at], triangles[patch.Members[m]]);
        if (joins)
        {
          patch.Members.push_back(*at);
        }
        at = joins ? left.erase(at) : at + 1;
      }
    }
    patch.Border = BorderOf(patch.Members, triangles);
    patches.push_back(patch);
  }
  return patches;
}

/// Where two labels' patches in a cell have the same border they are the same piece of interface, perhaps cut into
/// triangles along another diagonal: one of them is kept, with both labels.
Triangles MatchPatches(const Triangles& triangles, const std::vector<Vec3>& points)
{
  std::vector<std::pair<std::array<Index, 3>, Index>> byCell;
  byCell.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto& v = triangles[t].Vertices;
    const Vec3 centre = (points[v[0]] + points[v[1]] + points[v[2]]) / 3.0;
    byCell.push_back(
      { { Index(std::floor(centre[2])), Index(std::floor(centre[1])), Index(std::floor(centre[0])) }, Index(t) });
  }
  std::sort(byCell.begin(), byCell.end());
  Triangles matched;
  matched.reserve(triangles.size());
  std::vector<Index> members;
  for (std::size_t first = 0, last = 0; first < byCell.size(); first = last)
  {
    members.clear();
    for (last = first; last < byCell.size() && byCell[last].first == byCell[first].first; ++last)
    {
      members.push_back(byCell[last].second);
    }
    std::vector<Patch> patches = PatchesOf(members.data(), members.data() + members.size(), triangles);
    for (std::size_t p = 0; p < patches.size(); ++p)
    {
      const auto twin = std::find_if(patches.begin() + p + 1, patches.end(),
        [&](const Patch& q) { return q.Inside != patches[p].Inside && q.Border == patches[p].Border; });
      for (const Index t : patches[p].Members)
      {
        matched.push_back(triangles[t]);
        if (twin != patches.end())
        {
          matched.back().Materials[1] = twin->Inside;
        }
      }
      if (twin != patches.end())
      {
        patches.erase(twin);
      }
    }
  }
  return matched;
}

/// Replaces triangles on the same three points by their sum: (a, background) and, turned, (b, background) are (a, b),
/// and a triangle and the same one turned are nothing. What does not sum up to one triangle stays.
Triangles MergeCoincident(const Triangles& triangles)
{
  std::vector<std::pair<std::array<Index, 3>, Index>> byPoints;
  byPoints.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    std::array<Index, 3> v = triangles[t].Vertices;
    std::sort(v.begin(), v.end());
    byPoints.emplace_back(v, Index(t));
  }
  std::sort(byPoints.begin(), byPoints.end());
  Triangles merged;
  merged.reserve(triangles.size());
  for (std::size_t first = 0, last = 0; first < byPoints.size(); first = last)
  {
    const std::array<Index, 3>& v = byPoints[first].first;
    std::map<MaterialId, int> sides; // +1: behind the triangle v, -1: before it
    for (last = first; last < byPoints.size() && byPoints[last].first == v; ++last)
    {
      const InterfaceTriangle& t = triangles[byPoints[last].second];
      const auto at = std::find(v.begin(), v.end(), t.Vertices[0]) - v.begin();
      const int way = t.Vertices[1] == v[(at + 1) % 3] ? 1 : -1;
      sides[t.Materials[0]] += way;
      sides[t.Materials[1]] -= way;
    }
    InterfaceTriangle sum{ v, { NoMaterial, NoMaterial } };
    int others = 0;
    for (const auto& side : sides)
    {
      others += side.second != 0 && std::abs(side.second) != 1 ? 1 : 0;
      MaterialId& material = sum.Materials[side.second > 0 ? 0 : 1];
      others += side.second != 0 && material != NoMaterial ? 1 : 0;
      material = side.second != 0 ? side.first : material;
    }
    if (last - first == 1 || others > 0)
    {
      std::for_each(byPoints.begin() + first, byPoints.begin() + last,
        [&](const auto& entry) { merged.push_back(triangles[entry.second]); });
    }
    else if (sum.Materials[0] != NoMaterial)
    {
      merged.push_back(sum);
    }
  }
  return merged;
}

vtkSmartPointer<vtkPolyData> ToPolyData(const std::vector<Vec3>& points, const std::vector<std::array<Index, 3>>& cells)
{
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  positions->SetNumberOfPoints(vtkIdType(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    positions->SetPoint(vtkIdType(i), points[i].data());
  }
  vtkNew<vtkCellArray> polys;
  for (const std::array<Index, 3>& cell : cells)
  {
    const vtkIdType ids[3] = { cell[0], cell[1], cell[2] };
    polys->InsertNextCell(3, ids);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(positions);
  mesh->SetPolys(polys);
  return mesh;
}

std::vector<std::array<Index, 3>> VerticesOf(const Triangles& triangles)
{
  std::vector<std::array<Index, 3>> cells;
  cells.reserve(triangles.size());
  std::transform(triangles.begin(), triangles.end(), std::back_inserter(cells),
    [](const InterfaceTriangle& t) { return t.Vertices; });
  return cells;
}

std::vector<Vec3> Smoothed(const std::vector<Vec3>& points, const Triangles& triangles, const GridMeshOptions& options,
  vtkAlgorithm* filter, const Monitor& monitor)
{
  if (options.SmoothingIterations <= 0 || triangles.empty())
  {
    return points;
  }
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(ToPolyData(points, VerticesOf(triangles)));
  smooth->SetNumberOfIterations(options.SmoothingIterations);
  smooth->SetPassBand(options.PassBand);
  smooth->BoundarySmoothingOff();
  smooth->FeatureEdgeSmoothingOff();
  smooth->NonManifoldSmoothingOn(); // the curves where three materials meet
  smooth->NormalizeCoordinatesOn();
  UpdateInner({ { smooth, "Smoothing", 1.0 } }, filter, {}, monitor);
  if (smooth->GetOutput()->GetNumberOfPoints() != vtkIdType(points.size()))
  {
    throw std::runtime_error("vtkWindowedSincPolyDataFilter changed the number of points.");
  }
  return PointsOf(smooth->GetOutput());
}

/// vtkQuadricDecimation forgets cell data, but keeps the order of the cells that it leaves. So the triangles go in
/// sorted by their pair, with a marker between any two pairs: a huge triangle far away, which is never collapsed.
class MarkedDecimation
{
public:
  MarkedDecimation(std::vector<Vec3> points, Triangles triangles)
    : Points(std::move(points))
    , All(std::move(triangles))
  {
    std::stable_sort(this->All.begin(), this->All.end(),
      [](const InterfaceTriangle& a, const InterfaceTriangle& b) { return a.Materials < b.Materials; });
  }

  void Run(Index target, vtkAlgorithm* filter, const Monitor& monitor)
  {
    vtkNew<vtkQuadricDecimation> decimate;
    decimate->SetInputData(this->MarkedInput());
    const double markers = double(this->Pairs.size() - 1);
    decimate->SetTargetReduction(
      std::clamp(1.0 - (double(target) + markers) / (double(this->All.size()) + markers), 0.0, 1.0));
    UpdateInner({ { decimate, "Decimation", 1.0 } }, filter, {}, monitor);
    this->ReadBack(decimate->GetOutput());
  }

  std::vector<Vec3> Points;
  Triangles All;

private:
  vtkSmartPointer<vtkPolyData> MarkedInput()
  {
    Vec3 low = this->Points.front(), high = low;
    for (const Vec3& p : this->Points)
    {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double size = (high - low).norm();
    this->Border = high[0] + 4 * size;
    std::vector<Vec3> points = this->Points;
    std::vector<std::array<Index, 3>> cells;
    for (const InterfaceTriangle& t : this->All)
    {
      if (this->Pairs.empty() || this->Pairs.back() != t.Materials)
      {
        if (!this->Pairs.empty())
        {
          const Index at = Index(points.size());
          const Vec3 corner(high[0] + 5 * size, low[1] + 2 * size * double(this->Pairs.size()), low[2]);
          points.insert(points.end(), { corner, corner + Vec3(size, 0, 0), corner + Vec3(0, size, 0) });
          cells.push_back({ at, at + 1, at + 2 });
        }
        this->Pairs.push_back(t.Materials);
      }
      cells.push_back(t.Vertices);
    }
    return ToPolyData(points, cells);
  }

  void ReadBack(vtkPolyData* output)
  {
    this->Points = PointsOf(output);
    this->All.clear();
    std::size_t pair = 0;
    for (const std::array<Index, 3>& v : CellsOf(output))
    {
      if (this->Points[v[0]][0] > this->Border)
      {
        ++pair;
      }
      else if (pair < this->Pairs.size())
      {
        this->All.push_back({ v, this->Pairs[pair] });
      }
    }
    if (pair + 1 != this->Pairs.size())
    {
      throw std::runtime_error("vtkQuadricDecimation did not keep the order of the triangles.");
    }
  }

  double Border = 0.0;
  std::vector<std::array<MaterialId, 2>> Pairs;
};

/// Vertices with the materials of their triangles.
InterfaceMesh WithMaterialSets(const std::vector<Vec3>& points, const Triangles& triangles)
{
  InterfaceMesh mesh;
  mesh.Triangles = triangles;
  mesh.Vertices.resize(points.size());
  for (const InterfaceTriangle& t : triangles)
  {
    for (const Index v : t.Vertices)
    {
      mesh.Vertices[v].Materials.Insert(t.Materials[0]);
      mesh.Vertices[v].Materials.Insert(t.Materials[1]);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.Vertices[i].Position = points[i];
    mesh.Vertices[i].CellDimension = static_cast<std::uint8_t>(std::clamp(4 - mesh.Vertices[i].Materials.Size(), 0, 2));
  }
  return mesh;
}
}

InterfaceMesh MeshGrid(const LabelImage& image, MaterialId background, const GridMeshOptions& options,
  vtkAlgorithm* filter, const Monitor& monitor)
{
  const auto surfaces =
    LabelSurfaces(PaddedIds(image, background), background, int(image.Labels.size()), filter, monitor.Part(0.0, 0.3));
  std::vector<Vec3> points = PointsOf(surfaces);
  Triangles triangles = OneSidedTriangles(surfaces, points, background);
  triangles = MergeCoincident(MatchPatches(triangles, points));
  monitor.Step(0.4, "Smoothing");
  for (Vec3& p : points)
  {
    p = image.Frame.Spacing().cwiseProduct(p); // from indices to the local frame
  }
  points = Smoothed(points, triangles, options, filter, monitor.Part(0.4, 0.6));
  if (options.TargetTriangles > 0 && options.TargetTriangles < Index(triangles.size()))
  {
    MarkedDecimation decimation(std::move(points), std::move(triangles));
    decimation.Run(options.TargetTriangles, filter, monitor.Part(0.6, 0.95));
    points = std::move(decimation.Points);
    triangles = MergeCoincident(decimation.All);
  }
  monitor.Step(0.95, "Interfaces");
  return WithMaterialSets(points, triangles);
}
}
