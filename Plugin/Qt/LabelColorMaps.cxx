// SPDX-License-Identifier: BSD-3-Clause
#include "LabelColorMaps.h"

#include <vtkNew.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMTransferFunctionManager.h>

#include <string>
#include <vector>

namespace
{
constexpr int ComponentMode = 1; // VectorMode of a colour map
}

vtkSMProxy* LabelColorMaps::findCategorical(vtkSMSessionProxyManager* manager, const QString& array)
{
  // The name under which vtkSMTransferFunctionManager registers it.
  vtkSMProxy* colorMap = manager->GetProxy("lookup_tables", (array + ".PVLookupTable").toUtf8().constData());
  return colorMap && vtkSMPropertyHelper(colorMap, "IndexedLookup", true).GetAsInt() ? colorMap : nullptr;
}

LabelColorMaps::Entries LabelColorMaps::read(vtkSMProxy* colorMap)
{
  Entries entries;
  const vtkSMPropertyHelper annotations(colorMap, "Annotations");
  const vtkSMPropertyHelper colors(colorMap, "IndexedColors");
  const unsigned int numberOfColors = colors.GetNumberOfElements() / 3;
  for (unsigned int n = 0; n < annotations.GetNumberOfElements() / 2 && n < numberOfColors; ++n)
  {
    const QString value = annotations.GetAsString(2 * n), name = annotations.GetAsString(2 * n + 1);
    bool isLabel = false;
    const qint64 label = value.toLongLong(&isLabel);
    if (isLabel)
    {
      entries.Colors[label] =
        QColor::fromRgbF(colors.GetAsDouble(3 * n), colors.GetAsDouble(3 * n + 1), colors.GetAsDouble(3 * n + 2));
      if (name != value)
      {
        entries.Names[label] = name;
      }
    }
  }
  return entries;
}

vtkSMProxy* LabelColorMaps::write(vtkSMSessionProxyManager* manager, const QString& array, const Entries& entries)
{
  vtkNew<vtkSMTransferFunctionManager> maps;
  vtkSMProxy* colorMap = maps->GetColorTransferFunction(array.toUtf8().constData(), manager);
  if (!colorMap)
  {
    return nullptr;
  }
  Entries all = entries;
  if (vtkSMPropertyHelper(colorMap, "IndexedLookup").GetAsInt())
  {
    const Entries before = read(colorMap);
    all.Names.insert(before.Names.begin(), before.Names.end());
    all.Colors.insert(before.Colors.begin(), before.Colors.end());
  }
  else
  {
    vtkSMPropertyHelper(colorMap, "IndexedLookup").Set(1);
    // Of the two sides of a triangle the first: its material, where the second is the background.
    vtkSMPropertyHelper(colorMap, "VectorMode").Set(ComponentMode);
    vtkSMPropertyHelper(colorMap, "VectorComponent").Set(0);
  }
  std::vector<std::string> annotations;
  std::vector<double> colors;
  for (const auto& [label, color] : all.Colors)
  {
    const std::string value = std::to_string(label);
    const auto name = all.Names.find(label);
    annotations.push_back(value);
    annotations.push_back(name == all.Names.end() ? value : name->second.toStdString());
    colors.insert(colors.end(), { color.redF(), color.greenF(), color.blueF() });
  }
  vtkSMPropertyHelper texts(colorMap, "Annotations");
  texts.SetNumberOfElements(static_cast<unsigned int>(annotations.size()));
  for (std::size_t n = 0; n < annotations.size(); ++n)
  {
    texts.Set(static_cast<unsigned int>(n), annotations[n].c_str());
  }
  vtkSMPropertyHelper(colorMap, "IndexedColors").Set(colors.data(), static_cast<unsigned int>(colors.size()));
  colorMap->UpdateVTKObjects();
  return colorMap;
}
