// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialArrays.h"

#include "LabelMeshNames.h"

#include <vtkFieldData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
vtkDataArray* RequiredArray(vtkFieldData* data, const char* kind, const char* name, int components, const char* origin)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array)
  {
    throw std::invalid_argument(
      std::string("The input has no ") + kind + " array '" + name + "'. Connect the output of " + origin + ".");
  }
  if (array->GetNumberOfComponents() != components)
  {
    throw std::invalid_argument(std::string("The ") + kind + " array '" + name + "' has " +
      std::to_string(array->GetNumberOfComponents()) + " components, expected " + std::to_string(components) +
      ". Connect the output of " + origin + ".");
  }
  return array;
}

MaterialId FindMaterial(const std::vector<Material>& materials, Label label)
{
  const auto at =
    std::lower_bound(materials.begin(), materials.end(), label, [](const Material& m, Label l) { return m.Label < l; });
  return at != materials.end() && at->Label == label ? MaterialId(at - materials.begin()) : NoMaterial;
}

void AddMissingMaterials(const std::vector<Label>& all, std::vector<Material>& materials)
{
  std::vector<Label> labels = all;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const std::size_t known = materials.size();
  for (const Label label : labels)
  {
    if (std::none_of(
          materials.begin(), materials.begin() + known, [label](const Material& m) { return m.Label == label; }))
    {
      materials.push_back(DefaultMaterial(label));
    }
  }
  std::sort(materials.begin(), materials.end(), [](const Material& a, const Material& b) { return a.Label < b.Label; });
  if (materials.size() >= NoMaterial)
  {
    throw std::invalid_argument("The mesh has " + std::to_string(materials.size()) + " labels, at most " +
      std::to_string(NoMaterial - 1) + " are possible.");
  }
}

Label ReadBackground(vtkFieldData* fieldData)
{
  vtkDataArray* background = fieldData->GetArray(Names::BackgroundLabel);
  return background && background->GetNumberOfValues() > 0 ? As<vtkTypeInt64Array>(background)->GetValue(0) : 0;
}
}
