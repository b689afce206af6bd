// SPDX-License-Identifier: BSD-3-Clause
// The materials of a label volume: what was found in it, and what the user wants of them.
#ifndef MaterialsModel_h
#define MaterialsModel_h

#include "EditableTable.h"

#include <QColor>
#include <QVariantList>

#include <map>
#include <set>

/// A row per label that was found or that a property names, ascending. What the user did not set is shown in grey.
///
/// The Qt properties are the lists of the server-manager properties of the same kind: labels, (label, name) pairs,
/// (label, red, green, blue), (label, value). Setting one emits nothing; an edit by the user emits the signal of its
/// property, once for all rows.
class MaterialsModel : public EditableTableModel
{
  Q_OBJECT
  Q_PROPERTY(QVariantList labels READ labels WRITE setLabels NOTIFY labelsChanged)
  Q_PROPERTY(QVariantList names READ names WRITE setNames NOTIFY namesChanged)
  Q_PROPERTY(QVariantList colors READ colors WRITE setColors NOTIFY colorsChanged)
  Q_PROPERTY(QVariantList radii READ radii WRITE setRadii NOTIFY radiiChanged)
  Q_PROPERTY(QVariantList lengths READ lengths WRITE setLengths NOTIFY lengthsChanged)

public:
  enum Column
  {
    LabelColumn, ///< with the check box: mesh it
    ColorColumn,
    NameColumn,
    RadiusColumn,
    LengthColumn,
    VoxelsColumn,
    NumberOfColumns
  };

  /// What is known of a label that occurs.
  struct Found
  {
    qint64 Label = 0;
    qint64 Voxels = 0;
    QString Name; ///< by default
    QColor Color; ///< by default
  };

  using EditableTableModel::EditableTableModel;

  /// What the volume holds, ascending by label; what the user set stays.
  void setFound(const QVector<Found>& found);
  /// The background cannot be switched off, and labels that are not meshed belong to it.
  void setBackground(qint64 label);
  qint64 background() const { return this->Background; }
  /// What materials without a radius of their own get, voxels; and without a length (0: no bound).
  void setDefaults(double radius, double length);
  /// Columns that the user may not edit here, since another filter has the property.
  void setReadOnly(const QSet<int>& columns);

  QVariantList labels() const;
  void setLabels(const QVariantList& values);
  QVariantList names() const;
  void setNames(const QVariantList& values);
  QVariantList colors() const;
  void setColors(const QVariantList& values);
  QVariantList radii() const;
  void setRadii(const QVariantList& values);
  QVariantList lengths() const;
  void setLengths(const QVariantList& values);

  /// What another place says of names (empty: nothing) and colours; an edit, of the labels that occur.
  void takeAppearance(const std::map<qint64, QString>& names, const std::map<qint64, QColor>& colors);

  bool isMeshed(qint64 label) const;
  QString nameOf(qint64 label) const;
  QColor colorOf(qint64 label) const;
  /// The labels of the rows, ascending.
  const QVector<qint64>& rows() const { return this->Rows; }
  /// How many labels but the background occur in the volume, and how many of those are meshed.
  int numberOfMaterials() const;
  int numberOfMeshed() const;

  int rowCount(const QModelIndex& parent = QModelIndex()) const override;
  int columnCount(const QModelIndex& parent = QModelIndex()) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

  bool setCells(const QVector<int>& rows, int column, const QVariant& value, int role = Qt::EditRole) override;
  void resetCells(const QVector<int>& rows, int column) override;

Q_SIGNALS:
  void labelsChanged();
  void namesChanged();
  void colorsChanged();
  void radiiChanged();
  void lengthsChanged();
  /// After every change, by whomever.
  void changed();

private:
  void rebuild();
  void emitChanged(int column);
  void setMeshed(const QVector<int>& rows, bool meshed);
  bool isOwn(qint64 label, int column) const;
  QVariant text(qint64 label, int column) const;
  QVariant sortValue(qint64 label, int column) const;
  QString toolTip(qint64 label, int column) const;
  qint64 voxelsOf(qint64 label) const;

  QVector<qint64> Rows;
  std::map<qint64, Found> InVolume;
  qint64 Background = 0;
  double DefaultRadius = 0;
  double DefaultLength = 0;
  QSet<int> ReadOnly;

  std::set<qint64> Meshed; ///< empty: all
  std::map<qint64, QString> Names;
  std::map<qint64, QColor> Colors;
  std::map<qint64, double> Radii;
  std::map<qint64, double> Lengths;
};

#endif
