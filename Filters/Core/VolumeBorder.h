// SPDX-License-Identifier: BSD-3-Clause
// The space beyond the six faces of the volume's box, as materials of their own (mode Flat of the volume's border).
#ifndef LabelMesh_Core_VolumeBorder_h
#define LabelMesh_Core_VolumeBorder_h

#include "Particles.h"

namespace LabelMesh
{
/// The ids of the space beyond the faces -x, +x, -y, +y, -z, +z. They are no labels of the user's: the mesh that is
/// handed on calls that space background. They come after all others, so that the first of an ascending set that has
/// any other is not one of them.
inline constexpr MaterialId FirstBorder = NoMaterial - 6;
inline constexpr int NumberOfBorders = 6;

inline bool IsBorder(MaterialId m)
{
  return m >= FirstBorder && m != NoMaterial;
}
inline int BorderAxis(MaterialId m)
{
  return (m - FirstBorder) / 2;
}
/// -1 on the faces of lower coordinates, 1 on the others.
inline double BorderSide(MaterialId m)
{
  return (m - FirstBorder) % 2 == 0 ? -1.0 : 1.0;
}
/// The outward unit normal of the face.
inline Vec3 BorderNormal(MaterialId m)
{
  Vec3 normal = Vec3::Zero();
  normal[BorderAxis(m)] = BorderSide(m);
  return normal;
}

/// The box of the volume's voxels, half a voxel beyond the centres of the outermost, in the local frame.
struct VolumeBox
{
  Vec3 Low = Vec3::Zero(), High = Vec3::Zero();

  double Plane(MaterialId border) const
  {
    return BorderSide(border) < 0 ? this->Low[BorderAxis(border)] : this->High[BorderAxis(border)];
  }
  /// The signed distance of x beyond the face.
  double Beyond(MaterialId border, const Vec3& x) const
  {
    return BorderSide(border) * (x[BorderAxis(border)] - this->Plane(border));
  }
  Vec3 Clamped(const Vec3& x) const { return x.cwiseMax(this->Low).cwiseMin(this->High); }
  /// Puts x on the faces that the set names, exactly.
  void Snap(const MaterialId* materials, int count, Vec3& x) const
  {
    for (int n = 0; n < count; ++n)
    {
      if (IsBorder(materials[n]))
      {
        x[BorderAxis(materials[n])] = this->Plane(materials[n]);
      }
    }
  }
};
}

#endif
