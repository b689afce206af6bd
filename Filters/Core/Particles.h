// SPDX-License-Identifier: BSD-3-Clause
// What the sampling hands to the meshing: particles on the cells of the CW-complex.
#ifndef LabelMesh_Core_Particles_h
#define LabelMesh_Core_Particles_h

#include "Types.h"

#include <vector>

namespace LabelMesh
{
/// The materials that meet at a particle, ascending. Two on a 2-cell, three on a 1-cell, four at a 0-cell; more where
/// junctions closer than the target length were merged.
class MaterialSet
{
public:
  static constexpr int Capacity = 8;

  int Size() const { return this->Count; }
  MaterialId operator[](int i) const { return this->Ids[i]; }
  const MaterialId* begin() const { return this->Ids.data(); }
  const MaterialId* end() const { return this->Ids.data() + this->Count; }
  bool Contains(MaterialId m) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      if (this->Ids[i] == m)
      {
        return true;
      }
    }
    return false;
  }
  /// Adds m in its order; false when it was there or the set is full.
  bool Insert(MaterialId m)
  {
    if (this->Count == Capacity || this->Contains(m))
    {
      return false;
    }
    int at = this->Count++;
    for (; at > 0 && this->Ids[at - 1] > m; --at)
    {
      this->Ids[at] = this->Ids[at - 1];
    }
    this->Ids[at] = m;
    return true;
  }
  bool operator==(const MaterialSet& other) const
  {
    if (this->Count != other.Count)
    {
      return false;
    }
    for (int i = 0; i < this->Count; ++i)
    {
      if (this->Ids[i] != other.Ids[i])
      {
        return false;
      }
    }
    return true;
  }

private:
  std::array<MaterialId, Capacity> Ids{};
  int Count = 0;
};

struct Particle
{
  Vec3 Position = Vec3::Zero();
  Vec3 Normal = Vec3::Zero(); ///< on 2-cells: unit, from the first material of the set into the second
  double TargetLength = 0.0;  ///< world length
  double Residual = 0.0;      ///< world distance to the junction
  MaterialSet Materials;
  std::uint8_t CellDimension = 2; ///< of the lowest cell that it lies on
};

/// A 1-cell: indices of its particles in order; first and last are the same for a closed loop.
struct Curve
{
  std::vector<Index> Particles;
  std::array<MaterialId, 3> Materials{ NoMaterial, NoMaterial, NoMaterial };
};
}

#endif
