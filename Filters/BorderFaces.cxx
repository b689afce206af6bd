// SPDX-License-Identifier: BSD-3-Clause
#include "BorderFaces.h"

#include "LabelMeshNames.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

namespace LabelMesh
{
namespace
{
// In BorderFaces: a bit for each face of the volume's box, in the order of VolumeBorder.h, and one where the background
// itself is in the particle's set, not only the space beyond a face.
constexpr unsigned char BackgroundBit = 1 << NumberOfBorders;
}

std::vector<Particle> WithoutBorders(
  const std::vector<Particle>& particles, MaterialId background, vtkPointData* pointData)
{
  std::vector<Particle> plain = particles;
  vtkNew<vtkUnsignedCharArray> faces;
  faces->SetName(Names::BorderFaces);
  faces->SetNumberOfValues(Index(particles.size()));
  bool any = false;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    plain[i].Materials = MaterialSet();
    unsigned char bits = particles[i].Materials.Contains(background) ? BackgroundBit : 0;
    for (const MaterialId m : particles[i].Materials)
    {
      bits |= IsBorder(m) ? 1 << (m - FirstBorder) : 0;
      plain[i].Materials.Insert(IsBorder(m) ? background : m);
    }
    const bool onFace = (bits & ~BackgroundBit) != 0;
    any = any || onFace;
    faces->SetValue(Index(i), onFace ? bits : 0);
  }
  if (any)
  {
    pointData->AddArray(faces);
  }
  return plain;
}

void AddBorders(vtkDataArray* faces, MaterialId background, std::vector<MaterialSet>& sets)
{
  for (std::size_t i = 0; i < sets.size(); ++i)
  {
    const int bits = int(faces->GetTuple1(Index(i)));
    if (bits == 0)
    {
      continue;
    }
    MaterialSet set;
    for (const MaterialId m : sets[i])
    {
      if (m != background || (bits & BackgroundBit) != 0)
      {
        set.Insert(m);
      }
    }
    for (int n = 0; n < NumberOfBorders; ++n)
    {
      if ((bits & (1 << n)) != 0)
      {
        set.Insert(MaterialId(FirstBorder + n));
      }
    }
    sets[i] = set;
  }
}
}
