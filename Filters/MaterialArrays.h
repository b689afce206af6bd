// SPDX-License-Identifier: BSD-3-Clause
// What reading labelled meshes of any kind needs: arrays of the right shape, and the materials of their labels.
#ifndef MaterialArrays_h
#define MaterialArrays_h

#include "IndicatorCollection.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkFieldData;

namespace LabelMesh
{
/// A numeric array as the type that we need; a copy where it has another type.
template <typename Array>
vtkSmartPointer<Array> As(vtkDataArray* array)
{
  if (Array* same = Array::SafeDownCast(array))
  {
    return same;
  }
  auto copy = vtkSmartPointer<Array>::New();
  copy->DeepCopy(array);
  return copy;
}

/// The array `name`. Throws std::invalid_argument with a sentence when it is missing or has other components; `kind` is
/// "point" or "cell", `origin` the filter whose output is expected.
vtkDataArray* RequiredArray(vtkFieldData* data, const char* kind, const char* name, int components, const char* origin);

/// Position of a label among materials that ascend by label; NoMaterial when it is not there.
MaterialId FindMaterial(const std::vector<Material>& materials, Label label);

/// Adds the labels to the materials that the field data names, in their places. Throws std::invalid_argument when there
/// are more than ids for them.
void AddMissingMaterials(const std::vector<Label>& labels, std::vector<Material>& materials);

/// Field data BackgroundLabel; 0 without it.
Label ReadBackground(vtkFieldData* fieldData);
}

#endif
