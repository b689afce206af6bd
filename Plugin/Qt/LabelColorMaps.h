// SPDX-License-Identifier: BSD-3-Clause
// The colours of materials and ParaView's categorical colour maps: the same colours in both.
#ifndef LabelColorMaps_h
#define LabelColorMaps_h

#include <QColor>
#include <QString>

#include <map>

class vtkSMProxy;
class vtkSMSessionProxyManager;

namespace LabelColorMaps
{
struct Entries
{
  std::map<qint64, QString> Names; ///< by label
  std::map<qint64, QColor> Colors;
};

/// The colour map of arrays of this name; null when there is none, or it is not categorical.
vtkSMProxy* findCategorical(vtkSMSessionProxyManager* manager, const QString& array);

/// The annotated integers of a categorical colour map. There is no name where the annotation is the number alone.
Entries read(vtkSMProxy* colorMap);

/// Makes the colour map of arrays of this name categorical, with these entries beside those of other labels; creates it
/// where there is none. Returns it.
vtkSMProxy* write(vtkSMSessionProxyManager* manager, const QString& array, const Entries& entries);
}

#endif
