// SPDX-License-Identifier: BSD-3-Clause
// The materials of a label volume in the panel: a table of them, and one of the interfaces between them.
#ifndef pqMaterialsTable_h
#define pqMaterialsTable_h

#include <pqPropertyGroupWidget.h>

#include <vtkWeakPointer.h>

#include <vector>

class EditableTableView;
class InterfacesModel;
class MaterialsModel;
class QLabel;
class QLineEdit;
class QTimer;
class pqPipelineSource;
class vtkObject;

/// Stands for the properties Labels, MaterialNames, MaterialColors, MaterialRadii, MaterialMaximumLengths and
/// InterfaceMaximumLengths of a property group, as many of them as there are; a property that is not there has no
/// column. Their `function` is their name.
///
/// The rows come from the server: LabelSurveyQuery asks when the table is shown first, and after a change of the input,
/// its data, the label array or the background. For filters further on, such as Tighten, labels, names and colours are
/// those of the Label Split before them, to look at.
class pqMaterialsTable : public pqPropertyGroupWidget
{
  Q_OBJECT
  typedef pqPropertyGroupWidget Superclass;

public:
  pqMaterialsTable(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqMaterialsTable() override;

  /// The colours go to the colour maps of the labels too.
  void apply() override;

protected:
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void askLater();
  void ask();
  void onDataUpdated(pqPipelineSource* source);
  void updateDefaults();
  void updateSummary();
  void takeColors(vtkObject* colorMap);

private:
  void link(QObject* model, const char* name, const char* changed, const char* function);
  void watch(vtkSMProxy* proxy, const char* property, const char* slot);
  void watchColorMap(vtkSMProxy* colorMap);
  void fillFromOwner();
  void takeColorsBeforeFirstApply();
  void shareColors();
  QString labelArray() const;

  vtkSMProxy* Owner; ///< of the label volume
  MaterialsModel* Materials;
  InterfacesModel* Interfaces;
  EditableTableView* MaterialsView;
  EditableTableView* InterfacesView = nullptr;
  QLabel* Summary;
  QTimer* Timer;
  QString Trouble;
  std::vector<vtkWeakPointer<vtkSMProxy>> ColorMaps; ///< that are watched
  bool Outdated = true;
  bool Busy = false;
};

#endif
