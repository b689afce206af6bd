// SPDX-License-Identifier: BSD-3-Clause
#include "LabelSurveyQuery.h"

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace
{
/// Gives `to` the label array that the panel shows for `from`, applied or not.
void CopyShownArray(vtkSMProxy* from, vtkSMProxy* to)
{
  const vtkSMUncheckedPropertyHelper shown(from, "LabelArray");
  vtkSMPropertyHelper copy(to, "LabelArray");
  copy.SetNumberOfElements(shown.GetNumberOfElements());
  for (unsigned int n = 0; n < shown.GetNumberOfElements(); ++n)
  {
    copy.Set(n, shown.GetAsString(n));
  }
}

LabelSurveyAnswer AnswerOf(vtkSMProxy* survey)
{
  LabelSurveyAnswer answer;
  const vtkSMPropertyHelper labels(survey, "Labels"), names(survey, "Names"), voxels(survey, "Voxels");
  const vtkSMPropertyHelper colors(survey, "Colors");
  for (unsigned int n = 0; n < labels.GetNumberOfElements(); ++n)
  {
    answer.Materials.push_back({ qint64(labels.GetAsDouble(n)), qint64(voxels.GetAsDouble(n)), names.GetAsString(n),
      QColor::fromRgbF(colors.GetAsDouble(3 * n), colors.GetAsDouble(3 * n + 1), colors.GetAsDouble(3 * n + 2)) });
  }
  const vtkSMPropertyHelper first(survey, "PairLabelsA"), second(survey, "PairLabelsB"),
    faces(survey, "PairVoxelFaces");
  for (unsigned int n = 0; n < first.GetNumberOfElements(); ++n)
  {
    answer.Contacts.push_back(
      { { qint64(first.GetAsDouble(n)), qint64(second.GetAsDouble(n)) }, qint64(faces.GetAsDouble(n)) });
  }
  const vtkSMPropertyHelper trouble(survey, "Trouble");
  answer.Trouble = trouble.GetNumberOfElements() > 0 ? trouble.GetAsString(0) : "";
  return answer;
}
}

vtkSMProxy* LabelSurveyQuery::findOwner(vtkSMProxy* proxy)
{
  while (proxy)
  {
    if (proxy->GetProperty("LabelArray") && proxy->GetProperty("BackgroundLabel"))
    {
      return proxy;
    }
    const char* const input = proxy->GetProperty("Indicators") ? "Indicators" : "Input";
    proxy = proxy->GetProperty(input) ? vtkSMPropertyHelper(proxy, input).GetAsProxy() : nullptr;
  }
  return nullptr;
}

LabelSurveyAnswer LabelSurveyQuery::ask(vtkSMProxy* owner, double time)
{
  LabelSurveyAnswer answer;
  const vtkSMUncheckedPropertyHelper input(owner, "Input");
  if (input.GetNumberOfElements() == 0 || !input.GetAsProxy())
  {
    answer.Trouble = "No label volume is connected.";
    return answer;
  }
  vtkSMSessionProxyManager* manager = owner->GetSessionProxyManager();
  const auto survey =
    vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("filters", "LabelSurvey")); // never registered: nobody sees it
  vtkSMSourceProxy* source = vtkSMSourceProxy::SafeDownCast(survey);
  if (!source)
  {
    answer.Trouble = "The server does not have the plugin LabelMesh: load it there (Tools, Manage Plugins).";
    return answer;
  }
  vtkSMPropertyHelper(survey, "Input").Set(input.GetAsProxy(), input.GetOutputPort());
  CopyShownArray(owner, survey);
  vtkSMPropertyHelper(survey, "BackgroundLabel").Set(vtkSMUncheckedPropertyHelper(owner, "BackgroundLabel").GetAsInt());
  vtkSMPropertyHelper(survey, "Quiet").Set(1);
  survey->UpdateVTKObjects();
  source->UpdatePipeline(time);
  survey->UpdatePropertyInformation();
  return AnswerOf(survey);
}
