// SPDX-License-Identifier: BSD-3-Clause
// The grid-based baseline: VTK's discrete marching cubes, smoothing and decimation of all materials in one mesh.
#ifndef GridMesh_h
#define GridMesh_h

#include "Core/InterfaceMesh.h"
#include "Core/Monitor.h"
#include "LabelImage.h"

class vtkAlgorithm;

namespace LabelMesh
{
struct GridMeshOptions
{
  int SmoothingIterations = 20;
  double PassBand = 0.1;
  Index TargetTriangles = 0; ///< 0: no decimation
};

/// The interfaces of a label image, in the local frame of its GridFrame; material ids are positions in image.Labels.
/// The image is padded by one layer of the background so that every surface closes. Errors of VTK's filters are thrown
/// as std::runtime_error, their warnings become those of `filter`.
InterfaceMesh MeshGrid(const LabelImage& image, MaterialId background, const GridMeshOptions& options,
  vtkAlgorithm* filter, const Monitor& monitor);
}

#endif
