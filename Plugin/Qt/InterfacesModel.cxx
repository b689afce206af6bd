// SPDX-License-Identifier: BSD-3-Clause
#include "InterfacesModel.h"

#include "MaterialsModel.h"

#include <QBrush>
#include <QLocale>

#include <algorithm>
#include <cmath>

namespace
{
InterfacesModel::Pair Ascending(qint64 a, qint64 b)
{
  return { std::min(a, b), std::max(a, b) };
}
}

InterfacesModel::InterfacesModel(MaterialsModel* materials, QObject* parent)
  : EditableTableModel(parent)
  , Materials(materials)
{
  QObject::connect(materials, &MaterialsModel::changed, this, &InterfacesModel::rebuild);
}

void InterfacesModel::setFound(const QVector<Contact>& contacts)
{
  this->Contacts = contacts;
  this->rebuild();
}

void InterfacesModel::rebuild()
{
  std::map<Pair, qint64> faces;
  for (const Contact& contact : this->Contacts)
  {
    Pair labels = contact.Labels;
    for (qint64& label : labels)
    {
      label = this->Materials->isMeshed(label) ? label : this->Materials->background();
    }
    if (labels[0] != labels[1])
    {
      faces[Ascending(labels[0], labels[1])] += contact.Faces;
    }
  }
  for (const auto& own : this->Lengths)
  {
    faces.emplace(own.first, 0);
  }
  QVector<Row> rows;
  for (const auto& [labels, count] : faces)
  {
    rows.push_back({ labels, count });
  }
  if (rows != this->Rows)
  {
    this->beginResetModel();
    this->Rows = rows;
    this->endResetModel();
  }
  else if (!rows.isEmpty())
  {
    Q_EMIT this->dataChanged(this->index(0, 0), this->index(int(rows.size()) - 1, NumberOfColumns - 1));
  }
}

QVariantList InterfacesModel::lengths() const
{
  QVariantList list;
  for (const auto& [labels, length] : this->Lengths)
  {
    list << double(labels[0]) << double(labels[1]) << length;
  }
  return list;
}

void InterfacesModel::setLengths(const QVariantList& values)
{
  this->Lengths.clear();
  for (int n = 0; n + 2 < values.size(); n += 3)
  {
    this->Lengths[Ascending(qint64(values[n].toDouble()), qint64(values[n + 1].toDouble()))] = values[n + 2].toDouble();
  }
  this->rebuild();
}

int InterfacesModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : int(this->Rows.size());
}

int InterfacesModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : NumberOfColumns;
}

QVariant InterfacesModel::text(const Row& row, int column) const
{
  switch (column)
  {
    case FirstColumn:
    case SecondColumn:
    {
      const qint64 label = row.Labels[column];
      const QString name = this->Materials->nameOf(label);
      return label == this->Materials->background() ? QStringLiteral("%1 background").arg(label)
                                                    : QStringLiteral("%1 %2").arg(label).arg(name);
    }
    case FacesColumn:
      return row.Faces > 0 ? QLocale().toString(row.Faces) : QStringLiteral("none");
    default:
    {
      const auto own = this->Lengths.find(row.Labels);
      return own != this->Lengths.end() ? QString::number(own->second) : QStringLiteral("auto");
    }
  }
}

QVariant InterfacesModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid())
  {
    return QVariant();
  }
  const Row& row = this->Rows[index.row()];
  const int column = index.column();
  const bool isLabel = column <= SecondColumn;
  switch (role)
  {
    case Qt::DisplayRole:
    case Qt::EditRole:
      return this->text(row, column);
    case SortRole:
      return isLabel            ? QVariant(row.Labels[column])
        : column == FacesColumn ? QVariant(row.Faces)
                                : QVariant(this->Lengths.count(row.Labels) ? this->Lengths.at(row.Labels) : 0.0);
    case Qt::DecorationRole:
      return isLabel ? QVariant(this->Materials->colorOf(row.Labels[column])) : QVariant();
    case Qt::TextAlignmentRole:
      return isLabel ? QVariant() : QVariant(int(Qt::AlignRight | Qt::AlignVCenter));
    case Qt::ForegroundRole:
    {
      const bool faint = row.Faces == 0 || (column == LengthColumn && !this->Lengths.count(row.Labels));
      return faint ? QVariant(EditableTableModel::faint()) : QVariant();
    }
    case Qt::ToolTipRole:
      return row.Faces == 0 ? QVariant(QStringLiteral("The two do not touch in this volume"))
        : column == LengthColumn
        ? QVariant(QStringLiteral("F2 or a double click edits it, Delete gives the default back"))
        : QVariant();
    default:
      return QVariant();
  }
}

QVariant InterfacesModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || section < 0 || section >= NumberOfColumns)
  {
    return QVariant();
  }
  static const char* const titles[] = { "Between", "and", "Voxel\nfaces", "Length\n(world)" };
  static const char* const tips[] = { "One material", "The material that it touches",
    "How many faces of voxels lie between",
    "Longest edge on this interface, in the length unit of the image; auto: as the materials and the sizing say" };
  if (role == Qt::DisplayRole)
  {
    return QString(titles[section]);
  }
  return role == Qt::ToolTipRole ? QVariant(QString(tips[section])) : QVariant();
}

Qt::ItemFlags InterfacesModel::flags(const QModelIndex& index) const
{
  const Qt::ItemFlags flags = Qt::ItemIsSelectable | Qt::ItemIsEnabled | Qt::ItemNeverHasChildren;
  return index.column() == LengthColumn ? flags | Qt::ItemIsEditable : flags;
}

bool InterfacesModel::setCells(const QVector<int>& rows, int column, const QVariant& value, int role)
{
  if (column != LengthColumn || role != Qt::EditRole)
  {
    return false;
  }
  const QString text = value.toString().trimmed();
  double length = 0;
  if (!text.isEmpty() && !(EditableTableModel::toNumber(text, length) && length > 0))
  {
    return false;
  }
  for (const int row : rows)
  {
    if (text.isEmpty())
    {
      this->Lengths.erase(this->Rows[row].Labels);
    }
    else
    {
      this->Lengths[this->Rows[row].Labels] = length;
    }
  }
  Q_EMIT this->lengthsChanged();
  this->rebuild();
  return true;
}

void InterfacesModel::resetCells(const QVector<int>& rows, int)
{
  this->setCells(rows, LengthColumn, QString());
}
