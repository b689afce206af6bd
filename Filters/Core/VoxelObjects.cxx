// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelObjects.h"

#include "DisjointSets.h"

#include <algorithm>
#include <map>
#include <utility>

namespace LabelMesh
{
namespace
{
using Ids = std::vector<MaterialId>;

/// Runs of equal voxels along x, and the parts that they make up across y and z. Item 0 of the sets is the outside.
class PartFinder
{
public:
  PartFinder(const std::array<int, 3>& dims, const Ids& ids, MaterialId background)
    : Dims(dims)
    , Voxels(ids)
    , Background(background)
    , Sets(1)
  {
  }

  void Find(VoxelObjects& result)
  {
    const Index rows = Index(this->Dims[1]) * this->Dims[2];
    this->RowStarts.reserve(static_cast<std::size_t>(rows) + 1);
    this->RowStarts.push_back(0);
    for (Index row = 0; row < rows; ++row)
    {
      this->AddRow(row);
      this->RowStarts.push_back(Index(this->Runs.size()));
      const Index y = row % this->Dims[1], z = row / this->Dims[1];
      for (Index dz = z > 0 ? -1 : 0; dz <= 0; ++dz)
      {
        for (Index dy = y > 0 ? -1 : 0; dy <= (dz == 0 ? -1 : y + 1 < this->Dims[1] ? 1 : 0); ++dy)
        {
          this->UniteRows(row + dy + dz * this->Dims[1], row);
        }
      }
    }
    this->NumberParts(result);
    result.Runs = std::move(this->Runs);
  }

private:
  void AddRow(Index row)
  {
    const Index begin = row * this->Dims[0], end = begin + this->Dims[0];
    const Index y = row % this->Dims[1], z = row / this->Dims[1];
    const bool border = y == 0 || y + 1 == this->Dims[1] || z == 0 || z + 1 == this->Dims[2];
    for (Index first = begin, last = begin; first < end; first = last)
    {
      while (last < end && this->Voxels[last] == this->Voxels[first])
      {
        ++last;
      }
      const Index item = this->Sets.Add();
      this->Runs.push_back({ first, last, item });
      if (this->Voxels[first] == this->Background && (border || first == begin || last == end))
      {
        this->Sets.Unite(0, item);
      }
    }
  }

  /// Unites runs that overlap along x, or meet there at an edge or a corner.
  void UniteRows(Index a, Index b)
  {
    const Index shift = (b - a) * this->Dims[0];
    const Index endOfA = this->RowStarts[a + 1], endOfB = this->RowStarts[b + 1];
    for (Index i = this->RowStarts[a], j = this->RowStarts[b]; i < endOfA && j < endOfB;)
    {
      const Index lower = this->Runs[i].Last + shift, upper = this->Runs[j].Last;
      this->UniteIfSame(i, j);
      if (lower == upper && i + 1 < endOfA && j + 1 < endOfB)
      {
        // Four runs meet at one corner.
        this->UniteIfSame(i + 1, j);
        this->UniteIfSame(i, j + 1);
      }
      i += lower <= upper ? 1 : 0;
      j += upper <= lower ? 1 : 0;
    }
  }

  void UniteIfSame(Index a, Index b)
  {
    if (this->Voxels[this->Runs[a].First] == this->Voxels[this->Runs[b].First])
    {
      this->Sets.Unite(this->Runs[a].Part, this->Runs[b].Part);
    }
  }

  void NumberParts(VoxelObjects& result)
  {
    std::vector<Index> numbers(static_cast<std::size_t>(this->Sets.Size()), -1);
    numbers[0] = 0;
    result.Parts.push_back({ this->Background, 0, -1 });
    for (VoxelRun& run : this->Runs)
    {
      Index& number = numbers[this->Sets.Find(run.Part)];
      if (number < 0)
      {
        number = Index(result.Parts.size());
        result.Parts.push_back({ this->Voxels[run.First], 0, run.First });
      }
      run.Part = number;
      result.Parts[number].Voxels += run.Last - run.First;
    }
    for (const VoxelPart& part : result.Parts)
    {
      result.Objects[part.Id].Voxels += part.Voxels;
      ++result.Objects[part.Id].Parts;
    }
  }

  std::array<int, 3> Dims;
  const Ids& Voxels;
  MaterialId Background;
  DisjointSets Sets;
  std::vector<VoxelRun> Runs;
  std::vector<Index> RowStarts;
};

/// What the 2 x 2 x 2 voxels around a corner of the grid add to eight times the Euler number of a label's solid, by the
/// set of them that belong to it: the corner, six edges of which two blocks have a half each, twelve faces that four
/// share, eight voxels that eight share. A corner, edge or face is there when any voxel at it is.
std::array<int, 256> EulerOfBlocks()
{
  std::array<int, 256> table{};
  for (int mask = 0; mask < 256; ++mask)
  {
    const auto any = [mask](auto&& chosen)
    {
      int voxels = 0;
      for (int n = 0; n < 8; ++n)
      {
        voxels |= chosen(n) ? 1 << n : 0;
      }
      return (mask & voxels) != 0 ? 1 : 0;
    };
    int eightfold = 8 * any([](int) { return true; });
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      for (int side = 0; side < 4; ++side)
      {
        const auto at = [](int n, int axis) { return n >> axis & 1; };
        eightfold -= side < 2 ? 4 * any([&](int n) { return at(n, a) == side; }) : 0;
        eightfold += 2 * any([&](int n) { return at(n, a) == (side & 1) && at(n, b) == side >> 1; });
      }
    }
    for (int n = 0; n < 8; ++n)
    {
      eightfold -= mask >> n & 1;
    }
    table[mask] = eightfold;
  }
  return table;
}

/// Walks through the volume with a layer of background around it, slice by slice. Each face between two labels has two
/// sides, one of each label's surface; around each edge of the grid the sides go together that other labels' adjacent
/// voxels lie between.
class SurfaceScan
{
public:
  SurfaceScan(const std::array<int, 3>& dims, const Ids& ids, MaterialId background, int numberOfIds)
    : Dims(dims)
    , Voxels(ids)
    , Background(background)
    , Eightfold(static_cast<std::size_t>(numberOfIds), 0)
    , Width(dims[0] + 2)
  {
    const Index slice = this->Width * (dims[1] + 2);
    for (int s = 0; s < 2; ++s)
    {
      this->Slices[s].assign(static_cast<std::size_t>(slice), background);
      for (auto& faces : this->Faces[s])
      {
        faces.assign(static_cast<std::size_t>(slice), -1);
      }
    }
  }

  void Scan(VoxelObjects& result)
  {
    for (Index z = 0; z <= this->Dims[2]; ++z)
    {
      std::swap(this->Slices[0], this->Slices[1]);
      std::swap(this->Faces[0], this->Faces[1]);
      this->FillSlice(z);
      for (Index y = 1; y < this->Dims[1] + 2; ++y)
      {
        for (Index x = 1; x < this->Width; ++x)
        {
          this->Visit(x + this->Width * y);
        }
      }
    }
    for (Index side = 0; side < this->Sides.Size(); ++side)
    {
      result.Objects[this->SideIds[side]].Shells += this->Sides.Find(side) == side ? 1 : 0;
    }
    for (std::size_t id = 0; id < this->Eightfold.size(); ++id)
    {
      VoxelObject& object = result.Objects[id];
      object.Euler = this->Eightfold[id] / 4;
      object.Cavities = object.Shells - object.Parts + (id == this->Background ? 1 : 0);
    }
    for (const auto& contact : this->Contacts)
    {
      result.Contacts.push_back({ contact.first, contact.second });
    }
  }

private:
  void FillSlice(Index z)
  {
    for (Index y = 0; y < this->Dims[1]; ++y)
    {
      const auto row = this->Slices[0].begin() + (y + 1) * this->Width + 1;
      if (z == this->Dims[2])
      {
        std::fill(row, row + this->Dims[0], this->Background);
      }
      else
      {
        const auto source = this->Voxels.begin() + Index(this->Dims[0]) * (y + Index(this->Dims[1]) * z);
        std::copy(source, source + this->Dims[0], row);
      }
    }
  }

  /// The block of voxels of which the one at `at` is the last in every direction: its faces, edges and Euler number.
  void Visit(Index at)
  {
    const Ids &now = this->Slices[0], &before = this->Slices[1];
    const Index left = at - 1, below = at - this->Width, corner = below - 1;
    const std::array<MaterialId, 8> block{ before[corner], before[below], before[left], before[at], now[corner],
      now[below], now[left], now[at] };
    if (std::all_of(block.begin(), block.end(), [&](MaterialId id) { return id == block[7]; }))
    {
      return;
    }
    this->AddFace(at, 0, block[6], block[7]);
    this->AddFace(at, 1, block[5], block[7]);
    this->AddFace(at, 2, block[3], block[7]);
    const auto& faces = this->Faces;
    // Around an edge along z, y and x: voxels in turn, and the faces between them.
    this->JoinSides({ block[4], block[5], block[7], block[6] },
      { faces[0][0][below], faces[0][1][at], faces[0][0][at], faces[0][1][left] });
    this->JoinSides({ block[2], block[3], block[7], block[6] },
      { faces[1][0][at], faces[0][2][at], faces[0][0][at], faces[0][2][left] });
    this->JoinSides({ block[1], block[3], block[7], block[5] },
      { faces[1][1][at], faces[0][2][at], faces[0][1][at], faces[0][2][below] });
    for (int n = 0; n < 4; ++n)
    {
      this->JoinAcrossCorner(block, n, at);
    }
    this->AddEuler(block);
  }

  /// The face of a voxel towards the one before it along an axis; its sides are 2 n (the voxel's) and 2 n + 1.
  void AddFace(Index at, int axis, MaterialId lower, MaterialId upper)
  {
    if (lower == upper)
    {
      return;
    }
    this->Faces[0][axis][at] = this->Sides.Size() / 2;
    for (const MaterialId id : { upper, lower })
    {
      this->Sides.Add();
      this->SideIds.push_back(id);
    }
    const std::array<MaterialId, 2> pair{ std::min(lower, upper), std::max(lower, upper) };
    if (pair != this->LastPair || !this->LastCount)
    {
      this->LastPair = pair;
      this->LastCount = &this->Contacts[pair];
    }
    ++*this->LastCount;
  }

  /// Face n lies between voxel n and the next, which is the upper one where n < 2.
  void JoinSides(const std::array<MaterialId, 4>& ring, const std::array<Index, 4>& faces)
  {
    for (int entry = 0; entry < 4; ++entry)
    {
      int exit = (entry + 1) % 4;
      if (ring[exit] == ring[entry])
      {
        continue;
      }
      while (ring[(exit + 1) % 4] != ring[entry])
      {
        exit = (exit + 1) % 4;
      }
      this->Sides.Unite(2 * faces[entry] + (entry < 2 ? 1 : 0), 2 * faces[exit] + (exit < 2 ? 0 : 1));
    }
  }

  /// Where two voxels of a label meet at a corner of the grid, and none of the six others there is of the label, its
  /// surface runs from the one to the other.
  void JoinAcrossCorner(const std::array<MaterialId, 8>& block, int first, Index at)
  {
    const int last = 7 - first;
    for (int n = 0; n < 8; ++n)
    {
      if ((block[n] == block[first]) != (n == first || n == last))
      {
        return;
      }
    }
    const auto side = [&](int n) // of voxel n, towards the one beside it along x
    {
      const Index face = this->Faces[n & 4 ? 0 : 1][0][n & 2 ? at : at - this->Width];
      return 2 * face + (n & 1 ? 0 : 1);
    };
    this->Sides.Unite(side(first), side(last));
  }

  void AddEuler(const std::array<MaterialId, 8>& block)
  {
    static const std::array<int, 256> table = EulerOfBlocks();
    for (int n = 0, seen = 0; n < 8; ++n)
    {
      if (seen & 1 << n)
      {
        continue;
      }
      int mask = 0;
      for (int m = n; m < 8; ++m)
      {
        mask |= block[m] == block[n] ? 1 << m : 0;
      }
      seen |= mask;
      this->Eightfold[block[n]] += table[mask];
    }
  }

  std::array<int, 3> Dims;
  const Ids& Voxels;
  MaterialId Background;
  std::vector<Index> Eightfold;
  Index Width;
  std::array<Ids, 2> Slices;                              ///< this one and the one before
  std::array<std::array<std::vector<Index>, 3>, 2> Faces; ///< of the voxels of these slices, by axis
  DisjointSets Sides;
  std::vector<MaterialId> SideIds;
  std::map<std::array<MaterialId, 2>, Index> Contacts;
  std::array<MaterialId, 2> LastPair{ NoMaterial, NoMaterial };
  Index* LastCount = nullptr;
};
}

VoxelObjects FindVoxelParts(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background, int numberOfIds)
{
  VoxelObjects result;
  result.Objects.resize(static_cast<std::size_t>(numberOfIds));
  PartFinder(dims, ids, background).Find(result);
  return result;
}

VoxelObjects FindVoxelObjects(
  const std::array<int, 3>& dims, const std::vector<MaterialId>& ids, MaterialId background, int numberOfIds)
{
  VoxelObjects result = FindVoxelParts(dims, ids, background, numberOfIds);
  SurfaceScan(dims, ids, background, numberOfIds).Scan(result);
  return result;
}
}
