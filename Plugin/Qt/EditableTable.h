// SPDX-License-Identifier: BSD-3-Clause
// A table whose cells are edited for all selected rows at once: what the tables of materials and of interfaces share.
#ifndef EditableTable_h
#define EditableTable_h

#include <QAbstractTableModel>
#include <QPointer>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QVector>

class QItemSelectionModel;

/// A table of values that are either the user's own or a default.
class EditableTableModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  using QAbstractTableModel::QAbstractTableModel;

  enum Role
  {
    SortRole = Qt::UserRole, ///< a number or a text to sort by
    ColorRole,               ///< the QColor of a cell that a colour dialog edits
  };

  /// Edits one column of several rows; false where the column cannot be edited or the value has no meaning.
  virtual bool setCells(const QVector<int>& rows, int column, const QVariant& value, int role = Qt::EditRole) = 0;
  /// Gives cells their defaults back.
  virtual void resetCells(const QVector<int>& rows, int column) = 0;

  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;

protected:
  /// A number of 0 or more as the user wrote it; false where it is none.
  static bool toNumber(const QString& text, double& number);
  /// What is a default is written in this: half-way between the text and what is behind it.
  static QBrush faint();
};

/// Sorts and filters by what the rows say; an edit of a selected row is an edit of all selected rows.
class SelectionProxy : public QSortFilterProxyModel
{
  Q_OBJECT
public:
  explicit SelectionProxy(EditableTableModel* source, QObject* parent = nullptr);

  void setSelection(QItemSelectionModel* selection) { this->Selection = selection; }

  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;
  void reset(const QModelIndex& index);

protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

private:
  /// The rows of the source that an edit at `index` means.
  QVector<int> editedRows(const QModelIndex& index) const;

  EditableTableModel* Source;
  QPointer<QItemSelectionModel> Selection;
};

/// Keys: Space checks and unchecks, F2 and Return edit, Ctrl+A selects all, Delete gives the default back. A double
/// click on a colour opens a dialog.
class EditableTableView : public QTableView
{
  Q_OBJECT
public:
  explicit EditableTableView(EditableTableModel* model, QWidget* parent = nullptr);

  SelectionProxy* proxy() const { return this->Proxy; }
  /// Columns are as wide as they need; these share the width that is left, but get `least` characters each.
  void setElastic(const QVector<int>& columns, int least);

  /// As high as its rows, up to ten.
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  bool edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  QItemSelectionModel::SelectionFlags selectionCommand(const QModelIndex& index, const QEvent* event) const override;

private:
  void fitColumns();
  void toggle();
  bool chooseColor(const QModelIndex& index);
  bool isCheckBox(const QModelIndex& index, const QPoint& position) const;
  /// The cell of the current row that can be checked; invalid where there is none.
  QModelIndex checkable() const;

  SelectionProxy* Proxy;
  QVector<int> Elastic;
  int LeastWidth = 0;
};

#endif
