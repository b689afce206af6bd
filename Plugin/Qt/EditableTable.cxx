// SPDX-License-Identifier: BSD-3-Clause
#include "EditableTable.h"

#include <QColorDialog>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLocale>
#include <QMenu>
#include <QPalette>
#include <QStyle>
#include <QStyledItemDelegate>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int LargestNumberOfRows = 10; // shown without scrolling
constexpr int SmallestNumberOfRows = 3;

/// The editor of a cell has a name, by which tests find it.
class CellDelegate : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override
  {
    QWidget* editor = QStyledItemDelegate::createEditor(parent, option, index);
    if (editor)
    {
      editor->setObjectName("Editor");
    }
    return editor;
  }
};
}

bool EditableTableModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  return index.isValid() && this->setCells({ index.row() }, index.column(), value, role);
}

bool EditableTableModel::toNumber(const QString& text, double& number)
{
  bool ok = false;
  number = text.toDouble(&ok);
  if (!ok)
  {
    number = QLocale().toDouble(text, &ok);
  }
  return ok && number >= 0 && std::isfinite(number);
}

QBrush EditableTableModel::faint()
{
  const QPalette palette = QGuiApplication::palette();
  const QColor text = palette.color(QPalette::Text), base = palette.color(QPalette::Base);
  return QColor((text.red() + base.red()) / 2, (text.green() + base.green()) / 2, (text.blue() + base.blue()) / 2);
}

SelectionProxy::SelectionProxy(EditableTableModel* source, QObject* parent)
  : QSortFilterProxyModel(parent)
  , Source(source)
{
  this->setSourceModel(source);
  this->setSortRole(EditableTableModel::SortRole);
  this->setSortCaseSensitivity(Qt::CaseInsensitive);
  // Rows that moved while their cells are being edited would be lost from sight.
  this->setDynamicSortFilter(false);
}

QVector<int> SelectionProxy::editedRows(const QModelIndex& index) const
{
  QVector<int> rows;
  const int row = this->mapToSource(index).row();
  if (this->Selection && this->Selection->isRowSelected(index.row(), QModelIndex()))
  {
    for (const QModelIndex& selected : this->Selection->selectedRows())
    {
      rows.push_back(this->mapToSource(selected).row());
    }
  }
  if (!rows.contains(row))
  {
    rows = { row };
  }
  return rows;
}

bool SelectionProxy::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (!index.isValid())
  {
    return false;
  }
  const QVector<int> rows = this->editedRows(index);
  if (role == Qt::EditRole && rows.size() == 1 && value == index.data(Qt::EditRole))
  {
    return true; // an editor that was opened and closed does not make a default the user's own
  }
  return this->Source->setCells(rows, this->mapToSource(index).column(), value, role);
}

void SelectionProxy::reset(const QModelIndex& index)
{
  if (index.isValid())
  {
    this->Source->resetCells(this->editedRows(index), this->mapToSource(index).column());
  }
}

bool SelectionProxy::filterAcceptsRow(int row, const QModelIndex& parent) const
{
  const QRegExp wanted = this->filterRegExp();
  for (int column = 0; column < this->Source->columnCount(); ++column)
  {
    const QModelIndex cell = this->Source->index(row, column, parent);
    // Numbers are not searched, but for the label.
    if ((column == 0 || cell.data(EditableTableModel::SortRole).type() == QVariant::String) &&
      cell.data().toString().contains(wanted))
    {
      return true;
    }
  }
  return false;
}

EditableTableView::EditableTableView(EditableTableModel* model, QWidget* parent)
  : QTableView(parent)
  , Proxy(new SelectionProxy(model, this))
{
  this->setModel(this->Proxy);
  this->Proxy->setSelection(this->selectionModel());
  this->setItemDelegate(new CellDelegate(this));
  this->setSelectionBehavior(SelectRows);
  this->setSelectionMode(ExtendedSelection);
  this->setEditTriggers(DoubleClicked | EditKeyPressed | AnyKeyPressed);
  this->setSortingEnabled(true);
  this->sortByColumn(0, Qt::AscendingOrder);
  this->setAlternatingRowColors(true);
  this->setShowGrid(false);
  this->setWordWrap(false);
  this->setTabKeyNavigation(false); // Tab leaves the table
  this->setHorizontalScrollMode(ScrollPerPixel);
  this->verticalHeader()->hide();
  this->verticalHeader()->setDefaultSectionSize(this->fontMetrics().height() + 6);
  this->horizontalHeader()->setHighlightSections(false);
  QObject::connect(this->Proxy, &QAbstractItemModel::modelReset, this, &QWidget::updateGeometry);
}

void EditableTableView::setElastic(const QVector<int>& columns, int least)
{
  this->Elastic = columns;
  this->LeastWidth = least * this->fontMetrics().averageCharWidth();
  for (int column = 0; column < this->Proxy->columnCount(); ++column)
  {
    const bool elastic = columns.contains(column);
    this->horizontalHeader()->setSectionResizeMode(
      column, elastic ? QHeaderView::Interactive : QHeaderView::ResizeToContents);
  }
  QObject::connect(
    this->Proxy, &QAbstractItemModel::modelReset, this, &EditableTableView::fitColumns, Qt::QueuedConnection);
  QObject::connect(
    this->Proxy, &QAbstractItemModel::dataChanged, this, &EditableTableView::fitColumns, Qt::QueuedConnection);
  this->fitColumns();
}

void EditableTableView::fitColumns()
{
  const QHeaderView* header = this->horizontalHeader();
  int left = this->viewport()->width();
  for (int column = 0; column < this->Proxy->columnCount(); ++column)
  {
    left -= this->Elastic.contains(column) ? 0 : header->sectionSize(column);
  }
  for (const int column : this->Elastic)
  {
    this->setColumnWidth(column, std::max(this->LeastWidth, left / int(this->Elastic.size())));
  }
}

void EditableTableView::resizeEvent(QResizeEvent* event)
{
  QTableView::resizeEvent(event);
  this->fitColumns();
}

QSize EditableTableView::sizeHint() const
{
  const int rows =
    std::max(SmallestNumberOfRows, std::min(LargestNumberOfRows, this->Proxy->sourceModel()->rowCount()));
  const int height = this->horizontalHeader()->sizeHint().height() +
    rows * this->verticalHeader()->defaultSectionSize() + 2 * this->frameWidth() +
    this->style()->pixelMetric(QStyle::PM_ScrollBarExtent);
  return { QTableView::sizeHint().width(), height };
}

QSize EditableTableView::minimumSizeHint() const
{
  return { 100, this->sizeHint().height() };
}

QModelIndex EditableTableView::checkable() const
{
  const QModelIndex current = this->currentIndex();
  for (int column = 0; current.isValid() && column < this->Proxy->columnCount(); ++column)
  {
    const QModelIndex cell = current.sibling(current.row(), column);
    if (cell.data(Qt::CheckStateRole).isValid())
    {
      return cell;
    }
  }
  // The current row has none (the background); another selected one may.
  for (const QModelIndex& row : this->selectionModel()->selectedRows())
  {
    if (row.data(Qt::CheckStateRole).isValid())
    {
      return row;
    }
  }
  return QModelIndex();
}

void EditableTableView::toggle()
{
  const QModelIndex cell = this->checkable();
  if (cell.isValid())
  {
    const bool checked = cell.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    this->Proxy->setData(cell, checked ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
  }
}

void EditableTableView::keyPressEvent(QKeyEvent* event)
{
  const bool plain = event->modifiers() == Qt::NoModifier || event->modifiers() == Qt::KeypadModifier;
  if (plain && event->key() == Qt::Key_Space)
  {
    this->toggle();
  }
  else if (plain && (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace))
  {
    this->Proxy->reset(this->currentIndex());
  }
  else if (plain && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
  {
    // Where nothing can be edited the key must not reach the panel's Apply either.
    this->edit(this->currentIndex(), EditKeyPressed, event);
  }
  else
  {
    QTableView::keyPressEvent(event);
    return;
  }
  event->accept();
}

bool EditableTableView::edit(const QModelIndex& index, EditTrigger trigger, QEvent* event)
{
  if (trigger == DoubleClicked && this->chooseColor(index))
  {
    return false;
  }
  return QTableView::edit(index, trigger, event);
}

bool EditableTableView::chooseColor(const QModelIndex& index)
{
  const QVariant color = index.data(EditableTableModel::ColorRole);
  if (!color.isValid())
  {
    return false;
  }
  const QColor chosen = QColorDialog::getColor(
    color.value<QColor>(), this, QStringLiteral("Color of the material"), QColorDialog::DontUseNativeDialog);
  if (chosen.isValid())
  {
    this->Proxy->setData(index, chosen.name());
  }
  return true;
}

bool EditableTableView::isCheckBox(const QModelIndex& index, const QPoint& position) const
{
  if (!index.data(Qt::CheckStateRole).isValid())
  {
    return false;
  }
  QStyleOptionViewItem option = this->viewOptions();
  option.rect = this->visualRect(index);
  option.features |= QStyleOptionViewItem::HasCheckIndicator | QStyleOptionViewItem::HasDisplay;
  return this->style()->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, this).contains(position);
}

QItemSelectionModel::SelectionFlags EditableTableView::selectionCommand(
  const QModelIndex& index, const QEvent* event) const
{
  // A click on the check box of a selected row is meant for all selected rows.
  if (event &&
    (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonRelease ||
      event->type() == QEvent::MouseMove) &&
    this->selectionModel()->isSelected(index) && this->isCheckBox(index, static_cast<const QMouseEvent*>(event)->pos()))
  {
    return QItemSelectionModel::NoUpdate;
  }
  return QTableView::selectionCommand(index, event);
}

void EditableTableView::contextMenuEvent(QContextMenuEvent* event)
{
  const QModelIndex index = this->indexAt(event->pos());
  if (!index.isValid())
  {
    return;
  }
  const bool editable = index.flags().testFlag(Qt::ItemIsEditable);
  QMenu menu(this);
  if (this->checkable().isValid())
  {
    menu.addAction(
      "Mesh selected", [this] { this->Proxy->setData(this->checkable(), Qt::Checked, Qt::CheckStateRole); });
    menu.addAction(
      "Do not mesh selected", [this] { this->Proxy->setData(this->checkable(), Qt::Unchecked, Qt::CheckStateRole); });
    menu.addSeparator();
  }
  if (index.data(EditableTableModel::ColorRole).isValid())
  {
    menu.addAction("Choose color...", [this, index] { this->chooseColor(index); });
  }
  QAction* change = menu.addAction("Edit", [this, index] { QTableView::edit(index, AllEditTriggers, nullptr); });
  change->setEnabled(editable);
  QAction* reset = menu.addAction("Reset to default", [this, index] { this->Proxy->reset(index); });
  reset->setEnabled(editable);
  menu.addSeparator();
  menu.addAction("Select all", this, &QAbstractItemView::selectAll);
  menu.exec(event->globalPos());
}
