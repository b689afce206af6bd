// SPDX-License-Identifier: BSD-3-Clause
// What has to hold for the tetrahedra of any volume.
#ifndef TetraFaults_h
#define TetraFaults_h

#include <string>

class vtkPolyData;
class vtkUnstructuredGrid;

/// Tetrahedra have volume, their first points are the interface's to the bit, the faces between two materials and to
/// the background are the interface's triangles and no others, from the same sides, and each material's tetrahedra add
/// up to the volume in its surface. Empty when all of it holds, else a sentence.
std::string FaultsOfTetrahedra(vtkUnstructuredGrid* grid, vtkPolyData* interface);

#endif
