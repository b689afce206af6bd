// SPDX-License-Identifier: BSD-3-Clause
// What the server says of a label volume, without meshing it.
#ifndef LabelSurveyQuery_h
#define LabelSurveyQuery_h

#include "InterfacesModel.h"
#include "MaterialsModel.h"

#include <QString>

class vtkSMProxy;

struct LabelSurveyAnswer
{
  QVector<MaterialsModel::Found> Materials;
  QVector<InterfacesModel::Contact> Contacts;
  QString Trouble; ///< a sentence, when the volume holds no labels
};

namespace LabelSurveyQuery
{
/// The proxy of Label Split, Label Mesher or Grid Label Mesh whose label volume `proxy` works on: `proxy` itself, or
/// what is before it in the pipeline. Null when there is none.
vtkSMProxy* findOwner(vtkSMProxy* proxy);

/// Runs the filter Label Survey on the server, with the input, array and background that the panel of `owner` shows.
/// Only its small tables come to this process. `time`: that of the data.
LabelSurveyAnswer ask(vtkSMProxy* owner, double time);
}

#endif
