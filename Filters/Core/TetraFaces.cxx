// SPDX-License-Identifier: BSD-3-Clause
#include "TetraFaces.h"

#include "Parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace LabelMesh
{
namespace
{
/// Four times the tetrahedron, plus the corner that the face does not have.
using FaceCode = Index;

using FaceVertices = std::array<std::int32_t, 3>;

FaceVertices SortedVertices(const TetraMesh& mesh, FaceCode face)
{
  const auto& corners = mesh.Corners[face / 4];
  const int* order = FaceCorners[face % 4];
  FaceVertices v = { corners[order[0]], corners[order[1]], corners[order[2]] };
  std::sort(v.begin(), v.end());
  return v;
}

/// All faces, by their least vertex: those of vertex v stand at First[v] to First[v + 1].
struct FaceBuckets
{
  std::vector<Index> First;
  std::vector<FaceCode> Faces;
};

FaceBuckets SortFaces(const TetraMesh& mesh)
{
  const Index count = 4 * Index(mesh.Corners.size());
  FaceBuckets buckets;
  buckets.First.assign(mesh.Points.size() + 2, 0);
  for (FaceCode face = 0; face < count; ++face)
  {
    ++buckets.First[SortedVertices(mesh, face)[0] + 2];
  }
  for (std::size_t v = 2; v < buckets.First.size(); ++v)
  {
    buckets.First[v] += buckets.First[v - 1];
  }
  // One place further on, the sums are the positions to fill, and the starts once all are filled.
  buckets.Faces.resize(static_cast<std::size_t>(count));
  for (FaceCode face = 0; face < count; ++face)
  {
    buckets.Faces[buckets.First[SortedVertices(mesh, face)[0] + 1]++] = face;
  }
  return buckets;
}

/// Instead of the materials of a face that more than two tetrahedra have: nothing may be thrown while threads run.
constexpr std::array<MaterialId, 2> Overused = { NoMaterial, NoMaterial };

struct PatchFace
{
  std::array<MaterialId, 2> Materials;
  int Side;
  FaceCode Face;

  bool operator<(const PatchFace& other) const
  {
    return std::tie(this->Materials, this->Side, this->Face) < std::tie(other.Materials, other.Side, other.Face);
  }
};

/// The box of the tetrahedra's corners, along axes that may be turned; other points do not count.
class BoxSides
{
public:
  BoxSides(const TetraMesh& mesh, const Mat3& axes)
    : Mesh(mesh)
    , Axes((axes.array() == 0.0).count() == 6 ? Mat3(Mat3::Identity()) : axes)
  {
    if (!mesh.Corners.empty())
    {
      this->Low = this->High = this->Position(mesh.Corners[0][0]);
    }
    for (const auto& corners : mesh.Corners)
    {
      for (const std::int32_t v : corners)
      {
        this->Low = this->Low.cwiseMin(this->Position(v));
        this->High = this->High.cwiseMax(this->Position(v));
      }
    }
    this->Tolerance = this->Axes.isIdentity(0.0) ? 0.0 : Rounding * (this->High - this->Low).maxCoeff();
  }

  int Of(const FaceVertices& vertices) const
  {
    for (int side = 0; side < 6; ++side)
    {
      const int axis = side / 2;
      const double plane = side % 2 == 0 ? this->Low[axis] : this->High[axis];
      if (std::all_of(vertices.begin(), vertices.end(),
            [&](std::int32_t v) { return std::abs(this->Position(v)[axis] - plane) <= this->Tolerance; }))
      {
        return side;
      }
    }
    return NoSide;
  }

private:
  static constexpr double Rounding = 1e-9; // of the longest side

  Vec3 Position(std::int32_t v) const { return this->Axes.transpose() * this->Mesh.Points[v]; }

  const TetraMesh& Mesh;
  Mat3 Axes;
  Vec3 Low = Vec3::Zero(), High = Vec3::Zero();
  double Tolerance = 0.0; // world length
};

class PatchFinder
{
public:
  PatchFinder(const TetraMesh& mesh, MaterialId background, const Mat3& axes)
    : Mesh(mesh)
    , Background(background)
    , Buckets(SortFaces(mesh))
    , Sides(mesh, axes)
  {
  }

  std::vector<PatchFace> Find() const
  {
    constexpr Index block = 4096; // vertices
    const Index count = Index(this->Mesh.Points.size());
    return ParallelCollect<PatchFace>((count + block - 1) / block,
      [this, count](Index n, std::vector<PatchFace>& found)
      {
        std::vector<std::pair<FaceVertices, FaceCode>> faces;
        for (Index v = n * block; v < std::min(count, (n + 1) * block); ++v)
        {
          this->FindAround(v, faces, found);
        }
      });
  }

private:
  void FindAround(Index v, std::vector<std::pair<FaceVertices, FaceCode>>& faces, std::vector<PatchFace>& found) const
  {
    faces.clear();
    for (Index i = this->Buckets.First[v]; i < this->Buckets.First[v + 1]; ++i)
    {
      faces.emplace_back(SortedVertices(this->Mesh, this->Buckets.Faces[i]), this->Buckets.Faces[i]);
    }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 0; i < faces.size();)
    {
      std::size_t end = i + 1;
      while (end < faces.size() && faces[end].first == faces[i].first)
      {
        ++end;
      }
      if (end - i > 2)
      {
        found.push_back({ Overused, NoSide, faces[i].second });
      }
      this->Add(faces[i].first, faces[i].second, end - i == 2 ? faces[i + 1].second : -1, found);
      i = end;
    }
  }

  void Add(const FaceVertices& vertices, FaceCode one, FaceCode other, std::vector<PatchFace>& found) const
  {
    const MaterialId mine = this->Mesh.Materials[one / 4];
    if (other < 0)
    {
      found.push_back({ { mine, this->Background }, this->Sides.Of(vertices), one });
      return;
    }
    const MaterialId theirs = this->Mesh.Materials[other / 4];
    if (mine == theirs)
    {
      return;
    }
    if (theirs == this->Background || (mine != this->Background && mine < theirs))
    {
      found.push_back({ { mine, theirs }, NoSide, one });
    }
    else
    {
      found.push_back({ { theirs, mine }, NoSide, other });
    }
  }

  const TetraMesh& Mesh;
  MaterialId Background;
  FaceBuckets Buckets;
  BoxSides Sides;
};
}

Index OrientTetrahedra(TetraMesh& mesh)
{
  Index flat = 0;
  for (auto& corners : mesh.Corners)
  {
    const Vec3& origin = mesh.Points[corners[0]];
    const Vec3 a = mesh.Points[corners[1]] - origin;
    const Vec3 b = mesh.Points[corners[2]] - origin;
    const double volume = a.cross(b).dot(mesh.Points[corners[3]] - origin);
    if (volume < 0)
    {
      std::swap(corners[2], corners[3]);
    }
    flat += volume == 0 ? 1 : 0;
  }
  return flat;
}

std::vector<FacePatch> FindPatches(const TetraMesh& mesh, MaterialId background, const Mat3& axes)
{
  std::vector<PatchFace> faces = PatchFinder(mesh, background, axes).Find();
  std::sort(faces.begin(), faces.end());
  if (!faces.empty() && faces.back().Materials == Overused)
  {
    const FaceVertices v = SortedVertices(mesh, faces.back().Face);
    throw std::invalid_argument("More than two tetrahedra have the face of the points " + std::to_string(v[0]) + ", " +
      std::to_string(v[1]) + " and " + std::to_string(v[2]) + "; in a mesh two may.");
  }
  std::vector<FacePatch> patches;
  for (const PatchFace& face : faces)
  {
    if (patches.empty() || patches.back().Materials != face.Materials || patches.back().Side != face.Side)
    {
      patches.push_back({ face.Materials, face.Side, {} });
    }
    patches.back().Faces.push_back({ std::int32_t(face.Face / 4), std::uint8_t(face.Face % 4) });
  }
  return patches;
}
}
