// SPDX-License-Identifier: BSD-3-Clause
#include "pqMaterialsTable.h"

#include "EditableTable.h"
#include "InterfacesModel.h"
#include "LabelColorMaps.h"
#include "LabelSurveyQuery.h"
#include "MaterialsModel.h"

#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqPipelineSource.h>
#include <pqProxy.h>
#include <pqSMAdaptor.h>
#include <pqServerManagerModel.h>
#include <pqView.h>
#include <pqWaitCursor.h>
#include <vtkCommand.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyGroup.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMUncheckedPropertyHelper.h>

#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <iterator>

namespace
{
/// The label arrays of our own outputs.
const char* const OwnArrays[] = { "BoundaryLabels", "Label" };

/// Numbers are looked at in columns as wide as they need; what is left belongs to the names.
EditableTableView* MakeView(EditableTableModel* model, const char* name, const QVector<int>& elastic)
{
  auto* view = new EditableTableView(model);
  view->setObjectName(name);
  view->horizontalHeader()->setMinimumSectionSize(view->fontMetrics().averageCharWidth() * 3);
  view->setElastic(elastic, 9);
  return view;
}
}

pqMaterialsTable::pqMaterialsTable(vtkSMProxy* smProxy, vtkSMPropertyGroup* group, QWidget* parentWidget)
  : Superclass(smProxy, group, parentWidget)
  , Owner(LabelSurveyQuery::findOwner(smProxy))
  , Materials(new MaterialsModel(this))
  , Interfaces(new InterfacesModel(this->Materials, this))
  , MaterialsView(MakeView(this->Materials, "Materials", { MaterialsModel::NameColumn }))
  , Summary(new QLabel)
  , Timer(new QTimer(this))
{
  this->setChangeAvailableAsChangeFinished(true);
  auto* search = new QLineEdit;
  search->setObjectName("Search");
  search->setPlaceholderText("Search by label or name");
  search->setClearButtonEnabled(true);
  this->Summary->setObjectName("Summary");
  this->Summary->setWordWrap(true);

  auto* layout = new QVBoxLayout(this);
  layout->setMargin(0);
  layout->addWidget(search);
  QObject::connect(search, &QLineEdit::textChanged, this,
    [this](const QString& text)
    {
      for (EditableTableView* view : { this->MaterialsView, this->InterfacesView })
      {
        if (view)
        {
          view->proxy()->setFilterRegExp(QRegExp(text, Qt::CaseInsensitive, QRegExp::FixedString));
        }
      }
    });
  if (group->GetProperty("InterfaceMaximumLengths"))
  {
    this->InterfacesView =
      MakeView(this->Interfaces, "Interfaces", { InterfacesModel::FirstColumn, InterfacesModel::SecondColumn });
    auto* tabs = new QTabWidget;
    tabs->setObjectName("Tabs");
    tabs->addTab(this->MaterialsView, "Materials");
    tabs->addTab(this->InterfacesView, "Interfaces");
    this->setShowLabel(false); // the tabs say it
    layout->addWidget(tabs);
  }
  else
  {
    layout->addWidget(this->MaterialsView);
  }
  layout->addWidget(this->Summary);

  this->link(this->Materials, "labels", SIGNAL(labelsChanged()), "Labels");
  this->link(this->Materials, "names", SIGNAL(namesChanged()), "MaterialNames");
  this->link(this->Materials, "colors", SIGNAL(colorsChanged()), "MaterialColors");
  this->link(this->Materials, "radii", SIGNAL(radiiChanged()), "MaterialRadii");
  this->link(this->Materials, "lengths", SIGNAL(lengthsChanged()), "MaterialMaximumLengths");
  this->link(this->Interfaces, "lengths", SIGNAL(lengthsChanged()), "InterfaceMaximumLengths");
  const std::pair<const char*, int> columns[] = { { "Labels", MaterialsModel::LabelColumn },
    { "MaterialNames", MaterialsModel::NameColumn }, { "MaterialColors", MaterialsModel::ColorColumn },
    { "MaterialRadii", MaterialsModel::RadiusColumn }, { "MaterialMaximumLengths", MaterialsModel::LengthColumn } };
  QSet<int> readOnly;
  for (const auto& [function, column] : columns)
  {
    if (!group->GetProperty(function))
    {
      readOnly.insert(column);
      // Labels, names and colours tell what a row is; numbers that cannot be changed here would only be in the way.
      this->MaterialsView->setColumnHidden(
        column, column == MaterialsModel::RadiusColumn || column == MaterialsModel::LengthColumn);
    }
  }
  this->Materials->setReadOnly(readOnly);

  this->Timer->setSingleShot(true);
  this->Timer->setInterval(0);
  QObject::connect(this->Timer, &QTimer::timeout, this, &pqMaterialsTable::ask);
  QObject::connect(this->Materials, &MaterialsModel::changed, this, &pqMaterialsTable::updateSummary);
  for (const char* name : { "Radius", "MaximumLength" })
  {
    this->watch(smProxy, name, SLOT(updateDefaults()));
  }
  for (const char* name : { "Input", "LabelArray", "BackgroundLabel" })
  {
    this->watch(this->Owner, name, SLOT(askLater()));
  }
  if (this->Owner != smProxy)
  {
    for (const char* name : { "Labels", "MaterialNames", "MaterialColors" })
    {
      this->watch(this->Owner, name, SLOT(askLater()));
    }
  }
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(), &pqServerManagerModel::dataUpdated, this,
    &pqMaterialsTable::onDataUpdated);
  this->updateDefaults();
  this->updateSummary();
}

pqMaterialsTable::~pqMaterialsTable() = default;

void pqMaterialsTable::link(QObject* model, const char* name, const char* changed, const char* function)
{
  if (vtkSMProperty* smProperty = this->propertyGroup()->GetProperty(function))
  {
    this->addPropertyLink(model, name, changed, smProperty);
  }
}

void pqMaterialsTable::watch(vtkSMProxy* watched, const char* name, const char* slot)
{
  vtkSMProperty* smProperty = watched ? watched->GetProperty(name) : nullptr;
  if (smProperty)
  {
    pqCoreUtilities::connect(smProperty, vtkCommand::ModifiedEvent, this, slot);
    pqCoreUtilities::connect(smProperty, vtkCommand::UncheckedPropertyModifiedEvent, this, slot);
  }
}

void pqMaterialsTable::updateDefaults()
{
  const auto shown = [this](const char* name)
  { return this->proxy()->GetProperty(name) ? vtkSMUncheckedPropertyHelper(this->proxy(), name).GetAsDouble() : 0.0; };
  this->Materials->setDefaults(shown("Radius"), shown("MaximumLength"));
}

void pqMaterialsTable::showEvent(QShowEvent* event)
{
  this->Superclass::showEvent(event);
  if (this->Outdated)
  {
    this->askLater();
  }
}

void pqMaterialsTable::askLater()
{
  this->Outdated = true;
  if (this->isVisible())
  {
    this->Timer->start(); // once for many changes, and after the panel has been drawn
  }
}

void pqMaterialsTable::onDataUpdated(pqPipelineSource* source)
{
  if (this->Owner && !this->Busy && source->getProxy() == vtkSMPropertyHelper(this->Owner, "Input").GetAsProxy())
  {
    this->askLater();
  }
}

void pqMaterialsTable::ask()
{
  if (this->Busy)
  {
    return;
  }
  this->Busy = true;
  this->Outdated = false;
  LabelSurveyAnswer answer;
  if (this->Owner)
  {
    const pqWaitCursor cursor;
    const double time =
      this->view() ? vtkSMPropertyHelper(this->view()->getProxy(), "ViewTime", true).GetAsDouble() : 0;
    answer = LabelSurveyQuery::ask(this->Owner, time);
    this->fillFromOwner();
  }
  this->Trouble = answer.Trouble;
  this->Materials->setFound(answer.Materials);
  this->Interfaces->setFound(answer.Contacts);
  this->takeColorsBeforeFirstApply();
  this->updateSummary();
  this->updateGeometry();
  this->Busy = false;
}

void pqMaterialsTable::fillFromOwner()
{
  this->Materials->setBackground(qint64(vtkSMUncheckedPropertyHelper(this->Owner, "BackgroundLabel").GetAsDouble()));
  if (this->Owner == this->proxy())
  {
    return;
  }
  const auto values = [this](const char* name)
  {
    vtkSMProperty* smProperty = this->Owner->GetProperty(name);
    return smProperty ? pqSMAdaptor::getMultipleElementProperty(smProperty) : QVariantList();
  };
  this->Materials->setLabels(values("Labels"));
  this->Materials->setNames(values("MaterialNames"));
  this->Materials->setColors(values("MaterialColors"));
}

QString pqMaterialsTable::labelArray() const
{
  constexpr unsigned int nameElement = 4; // of SetInputArrayToProcess: port, connection, ..., association, name
  const vtkSMUncheckedPropertyHelper array(this->Owner, "LabelArray");
  return array.GetNumberOfElements() > nameElement ? array.GetAsString(nameElement) : "";
}

void pqMaterialsTable::takeColorsBeforeFirstApply()
{
  vtkSMProperty* own = this->propertyGroup()->GetProperty("MaterialColors");
  if (!own || !this->Owner)
  {
    return;
  }
  vtkSMProxy* colorMap = LabelColorMaps::findCategorical(this->proxy()->GetSessionProxyManager(), this->labelArray());
  if (!colorMap)
  {
    return;
  }
  this->watchColorMap(colorMap);
  const auto* item = pqApplicationCore::instance()->getServerManagerModel()->findItem<pqProxy*>(this->proxy());
  if (item && item->modifiedState() == pqProxy::UNINITIALIZED && this->Materials->colors().isEmpty())
  {
    const LabelColorMaps::Entries entries = LabelColorMaps::read(colorMap);
    this->Materials->takeAppearance(entries.Names, entries.Colors);
  }
}

void pqMaterialsTable::watchColorMap(vtkSMProxy* colorMap)
{
  if (std::find(this->ColorMaps.begin(), this->ColorMaps.end(), colorMap) == this->ColorMaps.end())
  {
    this->ColorMaps.emplace_back(colorMap);
    pqCoreUtilities::connect(colorMap, vtkCommand::PropertyModifiedEvent, this, SLOT(takeColors(vtkObject*)));
  }
}

void pqMaterialsTable::takeColors(vtkObject* colorMap)
{
  // Other panels of other volumes share the map too; only the one that the user looks at follows it.
  if (!this->Busy && this->isVisible())
  {
    this->Materials->takeAppearance({}, LabelColorMaps::read(vtkSMProxy::SafeDownCast(colorMap)).Colors);
  }
}

void pqMaterialsTable::shareColors()
{
  LabelColorMaps::Entries entries;
  for (const qint64 label : this->Materials->rows())
  {
    entries.Names[label] = this->Materials->nameOf(label);
    entries.Colors[label] = this->Materials->colorOf(label);
  }
  vtkSMSessionProxyManager* manager = this->proxy()->GetSessionProxyManager();
  QStringList arrays(std::begin(OwnArrays), std::end(OwnArrays));
  if (LabelColorMaps::findCategorical(manager, this->labelArray()))
  {
    arrays << this->labelArray();
  }
  this->Busy = true;
  for (const QString& array : arrays)
  {
    if (vtkSMProxy* colorMap = LabelColorMaps::write(manager, array, entries))
    {
      this->watchColorMap(colorMap);
    }
  }
  this->Busy = false;
}

void pqMaterialsTable::apply()
{
  this->Superclass::apply();
  if (this->propertyGroup()->GetProperty("MaterialColors") && this->Materials->numberOfMaterials() > 0)
  {
    this->shareColors();
  }
}

void pqMaterialsTable::updateSummary()
{
  if (!this->Trouble.isEmpty())
  {
    this->Summary->setText(this->Trouble);
    return;
  }
  const int all = this->Materials->numberOfMaterials(), meshed = this->Materials->numberOfMeshed();
  QString text = QStringLiteral("%1 of %2 materials are meshed").arg(meshed).arg(all);
  if (this->InterfacesView)
  {
    const int interfaces = this->Interfaces->rowCount();
    text += QString(interfaces == 1 ? ", %1 interface" : ", %1 interfaces").arg(interfaces);
  }
  this->Summary->setText(text);
}
