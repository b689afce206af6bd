// SPDX-License-Identifier: BSD-3-Clause
#include "TetraFaults.h"

#include "Core/TetraFaces.h"
#include "Core/TetraQuality.h"
#include "MeshAdapter.h"
#include "TetraReader.h"

#include <Eigen/Geometry>

#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{
using namespace LabelMesh;

/// A triangle from its smallest corner on, with the labels behind it and before it.
using Side = std::array<Index, 5>;

void AddSides(std::array<Index, 3> corners, Label from, Label to, std::vector<Side>& sides)
{
  for (const auto& [first, second] : { std::pair(from, to), std::pair(to, from) })
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    sides.push_back({ corners[0], corners[1], corners[2], first, second });
    std::reverse(corners.begin(), corners.end());
  }
}

std::vector<Side> SidesOf(const TetraData& data)
{
  std::vector<Side> sides;
  for (const FacePatch& patch : FindPatches(data.Mesh, data.Background))
  {
    for (const TetraFace& face : patch.Faces)
    {
      const auto& corners = data.Mesh.Corners[face.Tetra];
      const auto& order = FaceCorners[face.Opposite];
      AddSides({ corners[order[0]], corners[order[1]], corners[order[2]] }, data.Materials[patch.Materials[0]].Label,
        data.Materials[patch.Materials[1]].Label, sides);
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::vector<Side> SidesOf(const InterfaceData& data)
{
  std::vector<Side> sides;
  for (const InterfaceTriangle& triangle : data.Triangles)
  {
    AddSides(triangle.Vertices, data.Materials[triangle.Materials[0]].Label,
      data.Materials[triangle.Materials[1]].Label, sides);
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::map<Label, double> VolumesOf(const TetraData& data)
{
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < data.Mesh.Corners.size(); ++t)
  {
    const auto& c = data.Mesh.Corners[t];
    const auto& x = data.Mesh.Points;
    volumes[data.Materials[data.Mesh.Materials[t]].Label] += SignedVolume(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
  }
  return volumes;
}

/// What the triangles enclose, counted from one of their corners so that far origins cost no digits.
std::map<Label, double> VolumesOf(const InterfaceData& data)
{
  std::map<Label, double> volumes;
  for (const InterfaceTriangle& triangle : data.Triangles)
  {
    const auto x = [&](int i) -> Vec3 { return data.Points[triangle.Vertices[i]] - data.Points[0]; };
    const double volume = x(0).dot(x(1).cross(x(2))) / 6.0;
    volumes[data.Materials[triangle.Materials[0]].Label] += volume;
    volumes[data.Materials[triangle.Materials[1]].Label] -= volume;
  }
  volumes.erase(data.Background);
  return volumes;
}
}

std::string FaultsOfTetrahedra(vtkUnstructuredGrid* grid, vtkPolyData* interface)
{
  const InterfaceData surface = ReadInterface(interface);
  const TetraData filled = ReadTetrahedra(grid);
  if (filled.Mesh.Points.size() < surface.Points.size() ||
    !std::equal(surface.Points.begin(), surface.Points.end(), filled.Mesh.Points.begin()))
  {
    return "the tetrahedra have other points than the interface";
  }
  if (filled.FlatTetrahedra > 0)
  {
    return std::to_string(filled.FlatTetrahedra) + " tetrahedra have no volume";
  }
  if (SidesOf(filled) != SidesOf(surface))
  {
    return "the faces of the tetrahedra are not the interface's triangles";
  }
  const std::map<Label, double> volumes = VolumesOf(filled), enclosed = VolumesOf(surface);
  for (const auto& [label, volume] : enclosed)
  {
    const auto own = volumes.find(label);
    if (own == volumes.end() || !(std::abs(own->second - volume) <= 1e-9 * volume))
    {
      return "the tetrahedra of label " + std::to_string(label) + " do not add up to the volume in its surface";
    }
  }
  return "";
}
