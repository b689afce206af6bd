// SPDX-License-Identifier: BSD-3-Clause
// The materials table as a user works with it: rows, edits of one and of many, keys, sorting, and the lists that the
// properties get.
#include "InterfacesModel.h"
#include "MaterialsModel.h"

#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>

#include <gtest/gtest.h>

#include <memory>

namespace
{
/// Background 0, and materials 1, 2, -7 and 300.
QVector<MaterialsModel::Found> FourMaterials()
{
  return { { -7, 40, "Label_-7", Qt::red }, { 0, 1000, "Label_0", Qt::gray }, { 1, 500, "Label_1", Qt::blue },
    { 2, 20, "Label_2", Qt::green }, { 300, 100, "Label_300", Qt::yellow } };
}

void Press(QWidget* widget, int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
  QKeyEvent press(QEvent::KeyPress, key, modifiers), release(QEvent::KeyRelease, key, modifiers);
  QApplication::sendEvent(widget, &press);
  QApplication::sendEvent(widget, &release);
}

QString TextAt(const QAbstractItemModel* model, int row, int column)
{
  return model->index(row, column).data().toString();
}

/// A table on the screen, as in the panel.
struct Table
{
  MaterialsModel Model;
  EditableTableView View{ &Model };

  Table()
  {
    this->Model.setDefaults(0.7, 0);
    this->Model.setFound(FourMaterials());
    this->View.resize(400, 300);
    this->View.show();
  }
  void select(int first, int last, int column)
  {
    this->View.setCurrentIndex(this->View.model()->index(first, column));
    for (int row = first; row < last; ++row)
    {
      Press(&this->View, Qt::Key_Down, Qt::ShiftModifier);
    }
  }
  /// F2, a text, Return.
  void type(const QString& text)
  {
    Press(&this->View, Qt::Key_F2);
    auto* editor = this->View.findChild<QLineEdit*>("Editor");
    ASSERT_TRUE(editor);
    editor->setText(text);
    Press(editor, Qt::Key_Return);
    QApplication::processEvents();                                   // the editor hands its text on later
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete); // and is gone later still
  }
};

/// How often an object emits a signal.
template <typename Object, typename Signal>
std::shared_ptr<int> Count(Object* object, Signal signal)
{
  auto count = std::make_shared<int>(0);
  QObject::connect(object, signal, [count] { ++*count; });
  return count;
}
}

TEST(MaterialsModel, HasARowPerLabelFoundOrNamed)
{
  MaterialsModel model;
  EXPECT_EQ(model.rowCount(), 0);
  model.setFound(FourMaterials());
  EXPECT_EQ(model.rows(), (QVector<qint64>{ -7, 0, 1, 2, 300 }));
  EXPECT_EQ(model.numberOfMaterials(), 4);
  EXPECT_EQ(model.numberOfMeshed(), 4);
  model.setRadii({ 9.0, 1.5 });
  EXPECT_EQ(model.rows(), (QVector<qint64>{ -7, 0, 1, 2, 9, 300 })) << "a label that the volume does not have";
  EXPECT_EQ(TextAt(&model, 4, MaterialsModel::VoxelsColumn), "none");
  EXPECT_EQ(TextAt(&model, 4, MaterialsModel::RadiusColumn), "1.5");
  model.setFound({});
  EXPECT_EQ(model.rows(), (QVector<qint64>{ 9 })) << "what the user set stays";
  EXPECT_EQ(model.radii(), (QVariantList{ 9.0, 1.5 }));
}

TEST(MaterialsModel, ShowsDefaultsApartFromTheUsersOwn)
{
  MaterialsModel model;
  model.setDefaults(0.7, 3.5);
  model.setFound(FourMaterials());
  const QModelIndex radius = model.index(2, MaterialsModel::RadiusColumn);
  EXPECT_EQ(radius.data().toString(), "0.7");
  EXPECT_TRUE(radius.data(Qt::ForegroundRole).isValid());
  EXPECT_EQ(TextAt(&model, 2, MaterialsModel::LengthColumn), "3.5");
  model.setDefaults(0.8, 0);
  EXPECT_EQ(radius.data().toString(), "0.8");
  EXPECT_EQ(TextAt(&model, 2, MaterialsModel::LengthColumn), "auto");
  EXPECT_TRUE(model.setData(radius, "1.25"));
  EXPECT_EQ(radius.data().toString(), "1.25");
  EXPECT_FALSE(radius.data(Qt::ForegroundRole).isValid());
}

TEST(MaterialsModel, TakesListsOfPropertiesAndGivesThemBack)
{
  MaterialsModel model;
  model.setFound(FourMaterials());
  const auto changes = Count(&model, &MaterialsModel::namesChanged);
  const QVariantList names{ "1", "liver", "300", "left kidney" }, colors{ 2.0, 1.0, 0.0, 0.5 };
  model.setNames(names);
  model.setColors(colors);
  model.setLengths({ 1.0, 2.5 });
  model.setLabels({ 1, 300 });
  EXPECT_EQ(*changes, 0) << "only edits are told";
  EXPECT_EQ(model.names(), names);
  EXPECT_EQ(model.lengths(), (QVariantList{ 1.0, 2.5 }));
  EXPECT_EQ(model.labels(), (QVariantList{ qint64(1), qint64(300) }));
  const QVariantList back = model.colors();
  ASSERT_EQ(back.size(), 4);
  for (int n = 0; n < 4; ++n)
  {
    EXPECT_NEAR(back[n].toDouble(), colors[n].toDouble(), 1e-4);
  }
  EXPECT_EQ(TextAt(&model, 2, MaterialsModel::NameColumn), "liver");
  EXPECT_EQ(model.colorOf(2).name(), "#ff0080");
  EXPECT_TRUE(model.isMeshed(1) && model.isMeshed(300));
  EXPECT_FALSE(model.isMeshed(2) || model.isMeshed(0));
}

TEST(MaterialsModel, AnEmptyListOfLabelsMeansAll)
{
  MaterialsModel model;
  model.setFound(FourMaterials());
  const auto changes = Count(&model, &MaterialsModel::labelsChanged);
  const auto check = [&](const QVector<int>& rows, bool on)
  { return model.setCells(rows, MaterialsModel::LabelColumn, on ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole); };
  EXPECT_TRUE(check({ 3 }, false));
  EXPECT_EQ(model.labels(), (QVariantList{ qint64(-7), qint64(1), qint64(300) }));
  EXPECT_TRUE(check({ 0, 2, 4 }, false));
  EXPECT_EQ(model.labels(), (QVariantList{ qint64(0) })) << "none: the background alone, since no label would be all";
  EXPECT_EQ(model.numberOfMeshed(), 0);
  EXPECT_TRUE(check({ 0, 1, 2, 3, 4 }, true));
  EXPECT_EQ(model.labels(), QVariantList());
  EXPECT_EQ(*changes, 3) << "one change for many rows";
  EXPECT_FALSE(model.index(1, 0).data(Qt::CheckStateRole).isValid()) << "the background has no check box";
}

TEST(MaterialsModel, RefusesWhatHasNoMeaning)
{
  MaterialsModel model;
  model.setFound(FourMaterials());
  const auto index = [&](int column) { return model.index(2, column); };
  for (const char* text : { "big", "-1", "nan", "inf" })
  {
    EXPECT_FALSE(model.setData(index(MaterialsModel::RadiusColumn), text)) << text;
  }
  EXPECT_TRUE(model.setData(index(MaterialsModel::RadiusColumn), "0")) << "no smoothing";
  EXPECT_FALSE(model.setData(index(MaterialsModel::LengthColumn), "0")) << "no bound is the default";
  EXPECT_FALSE(model.setData(index(MaterialsModel::ColorColumn), "no colour"));
  EXPECT_FALSE(model.setData(index(MaterialsModel::VoxelsColumn), "7"));
  EXPECT_TRUE(model.setData(index(MaterialsModel::RadiusColumn), "")) << "nothing: the default";
  EXPECT_EQ(model.radii(), QVariantList());
  model.setReadOnly({ MaterialsModel::NameColumn, MaterialsModel::LabelColumn });
  EXPECT_FALSE(model.setData(index(MaterialsModel::NameColumn), "liver"));
  EXPECT_FALSE(index(MaterialsModel::LabelColumn).data(Qt::CheckStateRole).isValid());
}

TEST(MaterialsModel, TakesTheLookOfAnotherPlaceAsAnEdit)
{
  MaterialsModel model;
  model.setFound(FourMaterials());
  const auto colors = Count(&model, &MaterialsModel::colorsChanged),
             names = Count(&model, &MaterialsModel::namesChanged);
  model.takeAppearance({ { 1, "liver" }, { 2, "" } }, { { 1, Qt::blue }, { 2, Qt::black }, { 77, Qt::red } });
  EXPECT_EQ(*colors, 1);
  EXPECT_EQ(*names, 1);
  EXPECT_EQ(model.names(), (QVariantList{ "1", "liver" }));
  EXPECT_EQ(model.colors(), (QVariantList{ 2.0, 0.0, 0.0, 0.0 })) << "1 had it, 77 does not occur";
  model.takeAppearance({ { 1, "liver" } }, { { 2, Qt::black } });
  EXPECT_EQ(*colors + *names, 2) << "nothing new";
}

TEST(MaterialsTable, SortsEveryColumn)
{
  Table table;
  const auto order = [&](int column, Qt::SortOrder direction)
  {
    table.View.sortByColumn(column, direction);
    QStringList labels;
    for (int row = 0; row < table.View.model()->rowCount(); ++row)
    {
      labels << TextAt(table.View.model(), row, 0);
    }
    return labels;
  };
  table.Model.setRadii({ 2.0, 10.0, 1.0, 9.0 });
  table.Model.setNames({ "300", "aorta", "2", "Bone" });
  EXPECT_EQ(order(MaterialsModel::LabelColumn, Qt::AscendingOrder), (QStringList{ "-7", "0", "1", "2", "300" }));
  EXPECT_EQ(order(MaterialsModel::VoxelsColumn, Qt::DescendingOrder), (QStringList{ "0", "1", "300", "-7", "2" }));
  EXPECT_EQ(order(MaterialsModel::RadiusColumn, Qt::DescendingOrder).mid(0, 2), (QStringList{ "2", "1" }));
  EXPECT_EQ(order(MaterialsModel::NameColumn, Qt::AscendingOrder).mid(0, 2), (QStringList{ "300", "2" }));
}

TEST(MaterialsTable, AnEditOfASelectedRowIsAnEditOfAll)
{
  Table table;
  table.View.sortByColumn(MaterialsModel::VoxelsColumn, Qt::DescendingOrder); // 0, 1, 300, -7, 2
  const auto changes = Count(&table.Model, &MaterialsModel::radiiChanged);
  table.select(1, 2, MaterialsModel::RadiusColumn);
  table.type("1.5");
  EXPECT_EQ(table.Model.radii(), (QVariantList{ 1.0, 1.5, 300.0, 1.5 }));
  EXPECT_EQ(*changes, 1);
  table.select(4, 4, MaterialsModel::NameColumn);
  table.type("tooth");
  EXPECT_EQ(table.Model.names(), (QVariantList{ "2", "tooth" }));
  // An editor that is opened and closed changes nothing.
  table.select(3, 3, MaterialsModel::RadiusColumn);
  table.type("0.7");
  EXPECT_EQ(table.Model.radii().size(), 4);
}

TEST(MaterialsTable, Keys)
{
  Table table;
  table.select(2, 3, MaterialsModel::LengthColumn); // 1 and 2
  Press(&table.View, Qt::Key_Space);
  EXPECT_EQ(table.Model.labels(), (QVariantList{ qint64(-7), qint64(300) }));
  Press(&table.View, Qt::Key_Space);
  EXPECT_EQ(table.Model.labels(), QVariantList());
  table.type("4");
  EXPECT_EQ(table.Model.lengths(), (QVariantList{ 1.0, 4.0, 2.0, 4.0 }));
  table.select(2, 2, MaterialsModel::LengthColumn);
  Press(&table.View, Qt::Key_Delete);
  EXPECT_EQ(table.Model.lengths(), (QVariantList{ 2.0, 4.0 }));
  Press(&table.View, Qt::Key_A, Qt::ControlModifier);
  EXPECT_EQ(table.View.selectionModel()->selectedRows().size(), 5);
  Press(&table.View, Qt::Key_Space);
  EXPECT_EQ(table.Model.numberOfMeshed(), 0) << "with the background's row among them";
  table.select(1, 1, MaterialsModel::RadiusColumn);
  Press(&table.View, Qt::Key_Return);
  EXPECT_TRUE(table.View.findChild<QLineEdit*>("Editor")) << "Return edits";
}

TEST(MaterialsTable, SearchesLabelsAndNames)
{
  Table table;
  table.Model.setNames({ "1", "Left kidney" });
  table.View.proxy()->setFilterRegExp(QRegExp("kidney", Qt::CaseInsensitive, QRegExp::FixedString));
  EXPECT_EQ(table.View.model()->rowCount(), 1);
  EXPECT_EQ(TextAt(table.View.model(), 0, 0), "1");
  table.View.proxy()->setFilterRegExp(QRegExp("30", Qt::CaseInsensitive, QRegExp::FixedString));
  EXPECT_EQ(table.View.model()->rowCount(), 1);
  table.View.proxy()->setFilterRegExp(QRegExp());
  EXPECT_EQ(table.View.model()->rowCount(), 5);
}

TEST(MaterialsTable, ThousandsOfLabels)
{
  Table table;
  QVector<MaterialsModel::Found> many;
  for (int n = 0; n < 20000; ++n)
  {
    many.push_back({ n, 20000 - n, QString("Label_%1").arg(n), Qt::blue });
  }
  table.Model.setFound(many);
  const auto changes = Count(&table.Model, &MaterialsModel::radiiChanged);
  table.View.sortByColumn(MaterialsModel::VoxelsColumn, Qt::AscendingOrder);
  table.View.setCurrentIndex(table.View.model()->index(0, MaterialsModel::RadiusColumn));
  Press(&table.View, Qt::Key_A, Qt::ControlModifier);
  table.type("1");
  EXPECT_EQ(table.Model.radii().size(), 40000);
  EXPECT_EQ(*changes, 1);
}

TEST(InterfacesModel, PairsOfLabelsThatAreNotMeshedAreTheBackgrounds)
{
  MaterialsModel materials;
  materials.setFound(FourMaterials());
  InterfacesModel model(&materials);
  model.setFound({ { { 0, 1 }, 10 }, { { 0, 2 }, 20 }, { { 1, 2 }, 5 }, { { 2, 300 }, 7 } });
  ASSERT_EQ(model.rowCount(), 4);
  EXPECT_EQ(TextAt(&model, 0, 0), "0 background");
  EXPECT_EQ(TextAt(&model, 2, 1), "2 Label_2");
  materials.setLabels({ 1, 300 });
  ASSERT_EQ(model.rowCount(), 2) << "2 has become background";
  EXPECT_EQ(TextAt(&model, 0, InterfacesModel::FacesColumn), "15"); // 0|1 and 1|2
  EXPECT_EQ(TextAt(&model, 1, InterfacesModel::FacesColumn), "7");
}

TEST(InterfacesModel, EditsLengths)
{
  MaterialsModel materials;
  materials.setFound(FourMaterials());
  InterfacesModel model(&materials);
  model.setFound({ { { 0, 1 }, 10 }, { { 0, 2 }, 20 }, { { 1, 2 }, 5 } });
  const auto changes = Count(&model, &InterfacesModel::lengthsChanged);
  EXPECT_TRUE(model.setCells({ 0, 2 }, InterfacesModel::LengthColumn, "1.5"));
  EXPECT_EQ(*changes, 1);
  EXPECT_EQ(model.lengths(), (QVariantList{ 0.0, 1.0, 1.5, 1.0, 2.0, 1.5 }));
  EXPECT_FALSE(model.setCells({ 0 }, InterfacesModel::LengthColumn, "0"));
  EXPECT_FALSE(model.setCells({ 0 }, InterfacesModel::FacesColumn, "3"));
  model.resetCells({ 0 }, InterfacesModel::LengthColumn);
  EXPECT_EQ(model.lengths(), (QVariantList{ 1.0, 2.0, 1.5 }));
  // In any order, and of pairs that do not touch.
  model.setLengths({ 300.0, 1.0, 2.5 });
  EXPECT_EQ(model.lengths(), (QVariantList{ 1.0, 300.0, 2.5 }));
  EXPECT_EQ(model.rowCount(), 4);
  EXPECT_EQ(TextAt(&model, 3, InterfacesModel::FacesColumn), "none");
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  qputenv("QT_QPA_PLATFORM", "offscreen"); // no display is needed
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
