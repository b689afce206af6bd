// SPDX-License-Identifier: BSD-3-Clause
// The histogram of radius ratios in vtkLabelMeshReport.
#ifndef RatioHistogram_h
#define RatioHistogram_h

#include "MeshAdapter.h"

class vtkTable;
class vtkUnstructuredGrid;

namespace LabelMesh
{
inline constexpr int RatioBins = 50; ///< of equal width, from 0 to 1

/// The columns are listed in vtkLabelMeshReport.h. Triangles with one label on both sides are left out. `tetrahedra`
/// may be null.
void FillRadiusRatios(vtkTable* table, const InterfaceData& mesh, vtkUnstructuredGrid* tetrahedra);
}

#endif
