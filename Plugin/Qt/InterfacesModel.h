// SPDX-License-Identifier: BSD-3-Clause
// The interfaces between the materials of a label volume, and how long edges may be on each.
#ifndef InterfacesModel_h
#define InterfacesModel_h

#include "EditableTable.h"

#include <QVariantList>

#include <array>
#include <map>

class MaterialsModel;

/// A row per pair of materials that touch, and per pair that the property names. Labels that are not meshed belong to
/// the background, as they do in the mesh, so that their pairs become its.
///
/// The Qt property is the list of the server-manager property InterfaceMaximumLengths: (label, label, length).
class InterfacesModel : public EditableTableModel
{
  Q_OBJECT
  Q_PROPERTY(QVariantList lengths READ lengths WRITE setLengths NOTIFY lengthsChanged)

public:
  enum Column
  {
    FirstColumn,
    SecondColumn,
    FacesColumn,
    LengthColumn,
    NumberOfColumns
  };

  using Pair = std::array<qint64, 2>; ///< ascending
  struct Contact
  {
    Pair Labels;
    qint64 Faces = 0; ///< faces of voxels
  };

  /// The materials give names, colours, the background, and say what is meshed.
  explicit InterfacesModel(MaterialsModel* materials, QObject* parent = nullptr);

  void setFound(const QVector<Contact>& contacts);

  QVariantList lengths() const;
  void setLengths(const QVariantList& values);

  int rowCount(const QModelIndex& parent = QModelIndex()) const override;
  int columnCount(const QModelIndex& parent = QModelIndex()) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

  bool setCells(const QVector<int>& rows, int column, const QVariant& value, int role = Qt::EditRole) override;
  void resetCells(const QVector<int>& rows, int column) override;

Q_SIGNALS:
  void lengthsChanged();

private:
  struct Row
  {
    Pair Labels;
    qint64 Faces = 0;
    bool operator==(const Row& other) const { return this->Labels == other.Labels && this->Faces == other.Faces; }
  };

  void rebuild();
  QVariant text(const Row& row, int column) const;

  MaterialsModel* Materials;
  QVector<Contact> Contacts;
  QVector<Row> Rows;
  std::map<Pair, double> Lengths;
};

#endif
