// SPDX-License-Identifier: BSD-3-Clause
// How the faces of the volume's box travel in particles' point data: the array BorderFaces.
#ifndef BorderFaces_h
#define BorderFaces_h

#include "Core/VolumeBorder.h"

#include <vector>

class vtkDataArray;
class vtkPointData;

namespace LabelMesh
{
/// The particles with the space beyond the faces of the volume's box as `background`; adds BorderFaces to the point
/// data if any is on a face.
std::vector<Particle> WithoutBorders(
  const std::vector<Particle>& particles, MaterialId background, vtkPointData* pointData);
/// The other way round: puts that space into the sets again, and takes out the background where it stood for it alone.
void AddBorders(vtkDataArray* faces, MaterialId background, std::vector<MaterialSet>& sets);
}

#endif
