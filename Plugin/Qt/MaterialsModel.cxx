// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialsModel.h"

#include <QBrush>
#include <QLocale>

#include <algorithm>
#include <iterator>

namespace
{
QVariantList ToList(const std::map<qint64, double>& values)
{
  QVariantList list;
  for (const auto& [label, value] : values)
  {
    list << double(label) << value;
  }
  return list;
}

std::map<qint64, double> FromList(const QVariantList& list)
{
  std::map<qint64, double> values;
  for (int n = 0; n + 1 < list.size(); n += 2)
  {
    values[qint64(list[n].toDouble())] = list[n + 1].toDouble();
  }
  return values;
}

template <typename Map>
void EraseAll(Map& map, const QVector<qint64>& labels)
{
  for (const qint64 label : labels)
  {
    map.erase(label);
  }
}
}

void MaterialsModel::rebuild()
{
  std::set<qint64> all(this->Meshed);
  const auto add = [&all](const auto& map)
  {
    for (const auto& entry : map)
    {
      all.insert(entry.first);
    }
  };
  add(this->InVolume);
  add(this->Names);
  add(this->Colors);
  add(this->Radii);
  add(this->Lengths);
  QVector<qint64> rows;
  std::copy(all.begin(), all.end(), std::back_inserter(rows));
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
  Q_EMIT this->changed();
}

void MaterialsModel::setFound(const QVector<Found>& found)
{
  this->InVolume.clear();
  for (const Found& material : found)
  {
    this->InVolume[material.Label] = material;
  }
  this->rebuild();
}

void MaterialsModel::setBackground(qint64 label)
{
  this->Background = label;
  this->rebuild();
}

void MaterialsModel::setDefaults(double radius, double length)
{
  this->DefaultRadius = radius;
  this->DefaultLength = length;
  this->rebuild();
}

void MaterialsModel::setReadOnly(const QSet<int>& columns)
{
  this->ReadOnly = columns;
  this->rebuild();
}

QVariantList MaterialsModel::labels() const
{
  QVariantList list;
  for (const qint64 label : this->Meshed)
  {
    list << label;
  }
  return list;
}

void MaterialsModel::setLabels(const QVariantList& values)
{
  this->Meshed.clear();
  for (const QVariant& value : values)
  {
    this->Meshed.insert(value.toLongLong());
  }
  this->rebuild();
}

QVariantList MaterialsModel::names() const
{
  QVariantList list;
  for (const auto& [label, name] : this->Names)
  {
    list << QString::number(label) << name;
  }
  return list;
}

void MaterialsModel::setNames(const QVariantList& values)
{
  this->Names.clear();
  for (int n = 0; n + 1 < values.size(); n += 2)
  {
    this->Names[values[n].toLongLong()] = values[n + 1].toString();
  }
  this->rebuild();
}

QVariantList MaterialsModel::colors() const
{
  QVariantList list;
  for (const auto& [label, color] : this->Colors)
  {
    list << double(label) << color.redF() << color.greenF() << color.blueF();
  }
  return list;
}

void MaterialsModel::setColors(const QVariantList& values)
{
  const auto part = [&values](int n) { return std::min(1.0, std::max(0.0, values[n].toDouble())); };
  this->Colors.clear();
  for (int n = 0; n + 3 < values.size(); n += 4)
  {
    this->Colors[qint64(values[n].toDouble())] = QColor::fromRgbF(part(n + 1), part(n + 2), part(n + 3));
  }
  this->rebuild();
}

QVariantList MaterialsModel::radii() const
{
  return ToList(this->Radii);
}

void MaterialsModel::setRadii(const QVariantList& values)
{
  this->Radii = FromList(values);
  this->rebuild();
}

QVariantList MaterialsModel::lengths() const
{
  return ToList(this->Lengths);
}

void MaterialsModel::setLengths(const QVariantList& values)
{
  this->Lengths = FromList(values);
  this->rebuild();
}

void MaterialsModel::takeAppearance(const std::map<qint64, QString>& names, const std::map<qint64, QColor>& colors)
{
  bool renamed = false, recolored = false;
  for (const auto& found : this->InVolume)
  {
    const qint64 label = found.first;
    const auto name = names.find(label);
    if (name != names.end() && !name->second.isEmpty() && name->second != this->nameOf(label))
    {
      this->Names[label] = name->second;
      renamed = true;
    }
    const auto color = colors.find(label);
    // Colours are compared as they are shown: a map's are doubles.
    if (color != colors.end() && color->second.rgb() != this->colorOf(label).rgb())
    {
      this->Colors[label] = color->second;
      recolored = true;
    }
  }
  if (renamed)
  {
    this->emitChanged(NameColumn);
  }
  if (recolored)
  {
    this->emitChanged(ColorColumn);
  }
}

bool MaterialsModel::isMeshed(qint64 label) const
{
  return label != this->Background && (this->Meshed.empty() || this->Meshed.count(label) > 0);
}

QString MaterialsModel::nameOf(qint64 label) const
{
  const auto own = this->Names.find(label);
  if (own != this->Names.end() && !own->second.isEmpty())
  {
    return own->second;
  }
  const auto found = this->InVolume.find(label);
  return found != this->InVolume.end() ? found->second.Name : QStringLiteral("Label_%1").arg(label);
}

QColor MaterialsModel::colorOf(qint64 label) const
{
  const auto own = this->Colors.find(label);
  if (own != this->Colors.end())
  {
    return own->second;
  }
  const auto found = this->InVolume.find(label);
  return found != this->InVolume.end() ? found->second.Color : QColor(Qt::gray);
}

qint64 MaterialsModel::voxelsOf(qint64 label) const
{
  const auto found = this->InVolume.find(label);
  return found != this->InVolume.end() ? found->second.Voxels : 0;
}

int MaterialsModel::numberOfMaterials() const
{
  return int(this->InVolume.size()) - int(this->InVolume.count(this->Background));
}

int MaterialsModel::numberOfMeshed() const
{
  return int(std::count_if(this->InVolume.begin(), this->InVolume.end(),
    [this](const auto& material) { return this->isMeshed(material.first); }));
}

int MaterialsModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : int(this->Rows.size());
}

int MaterialsModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : NumberOfColumns;
}

bool MaterialsModel::isOwn(qint64 label, int column) const
{
  switch (column)
  {
    case NameColumn:
      return this->Names.count(label) > 0;
    case ColorColumn:
      return this->Colors.count(label) > 0;
    case RadiusColumn:
      return this->Radii.count(label) > 0;
    case LengthColumn:
      return this->Lengths.count(label) > 0;
    default:
      return true;
  }
}

QVariant MaterialsModel::text(qint64 label, int column) const
{
  switch (column)
  {
    case LabelColumn:
      return QString::number(label);
    case NameColumn:
      return this->nameOf(label);
    case VoxelsColumn:
      return this->InVolume.count(label) ? QLocale().toString(this->voxelsOf(label)) : QStringLiteral("none");
    case RadiusColumn:
    {
      const auto own = this->Radii.find(label);
      return QString::number(own != this->Radii.end() ? own->second : this->DefaultRadius);
    }
    case LengthColumn:
    {
      const auto own = this->Lengths.find(label);
      const double length = own != this->Lengths.end() ? own->second : this->DefaultLength;
      return length > 0 ? QString::number(length) : QStringLiteral("auto");
    }
    default:
      return QVariant();
  }
}

QVariant MaterialsModel::sortValue(qint64 label, int column) const
{
  switch (column)
  {
    case LabelColumn:
      return label;
    case ColorColumn:
      return this->colorOf(label).hue();
    case VoxelsColumn:
      return this->voxelsOf(label);
    case RadiusColumn:
    case LengthColumn:
      return this->text(label, column).toDouble();
    default:
      return this->text(label, column);
  }
}

QString MaterialsModel::toolTip(qint64 label, int column) const
{
  if (label == this->Background && column == LabelColumn)
  {
    return "The background: the space around the materials, and the labels that are not meshed";
  }
  if (!this->InVolume.count(label))
  {
    return QStringLiteral("No voxel of the volume has the label %1").arg(label);
  }
  switch (column)
  {
    case LabelColumn:
      return "Checked: the material is meshed. Space toggles all selected rows";
    case ColorColumn:
      return this->colorOf(label).name() + ": double-click for a dialog, F2 to type";
    case VoxelsColumn:
      return QString();
    default:
      return this->isOwn(label, column) ? "Delete gives the default back"
                                        : "The default; F2 or a double click edits it";
  }
}

QVariant MaterialsModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid())
  {
    return QVariant();
  }
  const qint64 label = this->Rows[index.row()];
  const int column = index.column();
  switch (role)
  {
    case Qt::DisplayRole:
      // What nobody named is told apart by what it is.
      return column == NameColumn && label == this->Background && !this->isOwn(label, column)
        ? QVariant(QStringLiteral("background"))
        : this->text(label, column);
    case Qt::EditRole:
      return column == ColorColumn ? QVariant(this->colorOf(label).name()) : this->text(label, column);
    case SortRole:
      return this->sortValue(label, column);
    case ColorRole:
      return column == ColorColumn && !this->ReadOnly.contains(column) ? QVariant(this->colorOf(label)) : QVariant();
    case Qt::DecorationRole:
      return column == ColorColumn ? QVariant(this->colorOf(label)) : QVariant();
    case Qt::CheckStateRole:
      return column == LabelColumn && label != this->Background && !this->ReadOnly.contains(column)
        ? QVariant(this->isMeshed(label) ? Qt::Checked : Qt::Unchecked)
        : QVariant();
    case Qt::TextAlignmentRole:
      return column >= RadiusColumn ? QVariant(int(Qt::AlignRight | Qt::AlignVCenter)) : QVariant();
    case Qt::ForegroundRole:
    {
      const bool faint = !this->isOwn(label, column) || (label != this->Background && !this->isMeshed(label)) ||
        !this->InVolume.count(label);
      return faint ? QVariant(EditableTableModel::faint()) : QVariant();
    }
    case Qt::ToolTipRole:
      return this->toolTip(label, column);
    default:
      return QVariant();
  }
}

QVariant MaterialsModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || section < 0 || section >= NumberOfColumns)
  {
    return QVariant();
  }
  static const char* const titles[] = { "Label", "", "Name", "Radius\n(voxels)", "Length\n(world)", "Voxels" };
  static const char* const tips[] = { "The label; checked: mesh it",
    "The color, shared with the color maps of the labels", "The name that blocks and files carry",
    "Least radius of curvature of the smoothed surface, in voxels",
    "Longest edge on the material's surface, in the length unit of the image; auto: as the sizing says",
    "How many voxels have the label" };
  if (role == Qt::DisplayRole)
  {
    return QString(titles[section]);
  }
  return role == Qt::ToolTipRole ? QVariant(QString(tips[section])) : QVariant();
}

Qt::ItemFlags MaterialsModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = Qt::ItemIsSelectable | Qt::ItemIsEnabled | Qt::ItemNeverHasChildren;
  if (!index.isValid() || this->ReadOnly.contains(index.column()))
  {
    return flags;
  }
  if (index.column() == LabelColumn)
  {
    return this->Rows[index.row()] != this->Background ? flags | Qt::ItemIsUserCheckable : flags;
  }
  return index.column() != VoxelsColumn ? flags | Qt::ItemIsEditable : flags;
}

void MaterialsModel::setMeshed(const QVector<int>& rows, bool meshed)
{
  std::set<qint64> wanted;
  for (const qint64 label : this->Rows)
  {
    if (this->isMeshed(label))
    {
      wanted.insert(label);
    }
  }
  for (const int row : rows)
  {
    const qint64 label = this->Rows[row];
    if (meshed && label != this->Background)
    {
      wanted.insert(label);
    }
    else
    {
      wanted.erase(label);
    }
  }
  const bool all = std::all_of(this->InVolume.begin(), this->InVolume.end(),
    [&](const auto& found) { return found.first == this->Background || wanted.count(found.first) > 0; });
  if (all)
  {
    wanted.clear(); // an empty list means all
  }
  else if (wanted.empty())
  {
    wanted.insert(this->Background); // nothing but that
  }
  this->Meshed = wanted;
}

bool MaterialsModel::setCells(const QVector<int>& rows, int column, const QVariant& value, int role)
{
  if (rows.isEmpty() || this->ReadOnly.contains(column))
  {
    return false;
  }
  if (column == LabelColumn && role == Qt::CheckStateRole)
  {
    this->setMeshed(rows, value.toInt() == Qt::Checked);
    this->emitChanged(column);
    return true;
  }
  const QString text = value.toString().trimmed();
  if (role != Qt::EditRole)
  {
    return false;
  }
  if (text.isEmpty())
  {
    this->resetCells(rows, column);
    return true;
  }
  double number = 0;
  const QColor color(text);
  const bool isNumber = EditableTableModel::toNumber(text, number);
  for (const int row : rows)
  {
    const qint64 label = this->Rows[row];
    if (column == NameColumn)
    {
      this->Names[label] = text;
    }
    else if (column == ColorColumn && color.isValid())
    {
      this->Colors[label] = color;
    }
    else if (column == RadiusColumn && isNumber)
    {
      this->Radii[label] = number;
    }
    else if (column == LengthColumn && isNumber && number > 0)
    {
      this->Lengths[label] = number;
    }
    else
    {
      return false;
    }
  }
  this->emitChanged(column);
  return true;
}

void MaterialsModel::resetCells(const QVector<int>& rows, int column)
{
  if (this->ReadOnly.contains(column))
  {
    return;
  }
  QVector<qint64> labels;
  for (const int row : rows)
  {
    labels.push_back(this->Rows[row]);
  }
  switch (column)
  {
    case LabelColumn:
      this->setMeshed(rows, true);
      break;
    case NameColumn:
      EraseAll(this->Names, labels);
      break;
    case ColorColumn:
      EraseAll(this->Colors, labels);
      break;
    case RadiusColumn:
      EraseAll(this->Radii, labels);
      break;
    case LengthColumn:
      EraseAll(this->Lengths, labels);
      break;
    default:
      return;
  }
  this->emitChanged(column);
}

void MaterialsModel::emitChanged(int column)
{
  switch (column)
  {
    case LabelColumn:
      Q_EMIT this->labelsChanged();
      break;
    case NameColumn:
      Q_EMIT this->namesChanged();
      break;
    case ColorColumn:
      Q_EMIT this->colorsChanged();
      break;
    case RadiusColumn:
      Q_EMIT this->radiiChanged();
      break;
    case LengthColumn:
      Q_EMIT this->lengthsChanged();
      break;
    default:
      break;
  }
  // The default may have brought a row into being that nothing holds any more, or the other way round.
  this->rebuild();
}
