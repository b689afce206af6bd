// SPDX-License-Identifier: BSD-3-Clause
// What filters give to a server of several processes, each of which asks for one piece.
#include "ServerPieces.h"

#include "LabelMeshNames.h"
#include "TestMeshes.h"
#include "vtkDelaunayLabelMesh.h"
#include "vtkGridLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelMeshReport.h"
#include "vtkLabelMesher.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace TestMeshes;

namespace
{
/// How often a filter has run.
class RunCounter
{
public:
  explicit RunCounter(vtkAlgorithm* filter) { filter->AddObserver(vtkCommand::EndEvent, this, &RunCounter::Count); }
  void Count(vtkObject*, unsigned long, void*) { ++this->Runs; }
  int Runs = 0;
};

/// The filters one after the other.
struct Chain
{
  explicit Chain(vtkImageData* volume)
  {
    this->Split->SetInputDataObject(volume);
    this->Split->SetMaterialName(1, "upper");
    this->Tighten->SetInputConnection(this->Split->GetOutputPort());
    this->Reconstruct->SetInputConnection(this->Tighten->GetOutputPort());
    this->Sizing->SetInputConnection(this->Reconstruct->GetOutputPort());
    this->Sample->SetInputConnection(0, this->Reconstruct->GetOutputPort());
    this->Sample->SetInputConnection(1, this->Sizing->GetOutputPort());
    this->Mesh->SetInputConnection(0, this->Sample->GetOutputPort());
    this->Mesh->SetInputConnection(1, this->Reconstruct->GetOutputPort());
    this->Report->SetInputConnection(0, this->Mesh->GetOutputPort());
  }
  vtkNew<vtkLabelSplit> Split;
  vtkNew<vtkTighten> Tighten;
  vtkNew<vtkIndicatorReconstruct> Reconstruct;
  vtkNew<vtkSizingField> Sizing;
  vtkNew<vtkParticleSampleCells> Sample;
  vtkNew<vtkDelaunayLabelMesh> Mesh;
  vtkNew<vtkLabelMeshReport> Report;
};

std::vector<std::string> BlockNames(vtkDataObject* data)
{
  auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(data);
  std::vector<std::string> names;
  for (unsigned int n = 0; n < collection->GetNumberOfPartitionedDataSets(); ++n)
  {
    names.emplace_back(collection->GetMetaData(n)->Get(vtkCompositeDataSet::NAME()));
  }
  return names;
}

vtkIdType PointsOf(vtkDataObject* data)
{
  return data->GetNumberOfElements(vtkDataObject::POINT);
}

using StringList = std::vector<std::string>;
}

TEST(ServerPieces, AnotherPieceHasTheSameStructureAndNothingInIt)
{
  const Chain chain(TwoSpheres(32));
  chain.Report->UpdatePiece(1, 2, 0);
  for (vtkAlgorithm* stage : { static_cast<vtkAlgorithm*>(chain.Split), static_cast<vtkAlgorithm*>(chain.Tighten),
         static_cast<vtkAlgorithm*>(chain.Reconstruct) })
  {
    EXPECT_EQ(BlockNames(stage->GetOutputDataObject(0)), (StringList{ "Label_0", "upper", "Label_2" }));
    EXPECT_EQ(PointsOf(stage->GetOutputDataObject(0)), 0);
  }
  EXPECT_EQ(PointsOf(chain.Sizing->GetOutput()), 0);
  EXPECT_EQ(PointsOf(chain.Sample->GetOutput()), 0);
  EXPECT_EQ(PointsOf(chain.Mesh->GetOutput()), 0);
  EXPECT_TRUE(chain.Mesh->GetOutput()->GetFieldData()->HasArray(Names::MaterialNames));
  EXPECT_EQ(BlockNames(chain.Mesh->GetOutputDataObject(1)), (StringList{ "upper", "Label_2" }));
  vtkTable* const table = vtkTable::SafeDownCast(chain.Report->GetOutputDataObject(0));
  EXPECT_EQ(table->GetNumberOfRows(), 0);
  EXPECT_NE(table->GetColumnByName("Volume"), nullptr);

  vtkNew<vtkGridLabelMesh> grid;
  grid->SetInputDataObject(TwoSpheres(32));
  grid->UpdatePiece(1, 2, 0);
  EXPECT_EQ(PointsOf(grid->GetOutput()), 0);
  EXPECT_EQ(BlockNames(grid->GetOutputDataObject(1)), (StringList{ "Label_1", "Label_2" }));
}

TEST(ServerPieces, TheFirstPieceIsEverything)
{
  vtkNew<vtkLabelMesher> whole, first, second;
  for (vtkLabelMesher* mesher : { whole.Get(), first.Get(), second.Get() })
  {
    mesher->SetInputDataObject(TwoSpheres(32));
  }
  whole->Update();
  first->UpdatePiece(0, 2, 0);
  second->UpdatePiece(1, 2, 0);
  EXPECT_GT(PointsOf(whole->GetOutput()), 100);
  for (int port = 0; port < 4; ++port)
  {
    EXPECT_EQ(PointsOf(first->GetOutputDataObject(port)), PointsOf(whole->GetOutputDataObject(port)));
    EXPECT_EQ(PointsOf(second->GetOutputDataObject(port)), 0);
  }
  EXPECT_EQ(BlockNames(second->GetSurfaces()), BlockNames(whole->GetSurfaces()));
  first->UpdatePiece(0, 3, 0);
  EXPECT_EQ(first->GetStageRuns("LabelSplit"), 1) << "the first of three pieces is the first of two";
}

TEST(ServerPieces, StagesRunOnceForAllWhoAskForThem)
{
  const Chain chain(TwoSpheres(32));
  const RunCounter splits(chain.Split), tightenings(chain.Tighten);
  for (vtkAlgorithm* stage : { static_cast<vtkAlgorithm*>(chain.Split), static_cast<vtkAlgorithm*>(chain.Mesh),
         static_cast<vtkAlgorithm*>(chain.Tighten), static_cast<vtkAlgorithm*>(chain.Report) })
  {
    stage->UpdatePiece(0, 2, 0);
  }
  EXPECT_EQ(splits.Runs, 1);
  EXPECT_EQ(tightenings.Runs, 1);
}

TEST(ServerPieces, PartOfAnImageIsAnError)
{
  vtkNew<vtkTrivialProducer> source; // gives what it has, whatever is asked for
  source->SetOutput(TwoSpheres(32));
  source->SetWholeExtent(0, 31, 0, 31, 0, 63);
  vtkNew<vtkLabelMesher> mesher;
  vtkNew<vtkLabelSplit> split;
  vtkNew<vtkGridLabelMesh> grid;
  for (vtkAlgorithm* filter :
    { static_cast<vtkAlgorithm*>(mesher), static_cast<vtkAlgorithm*>(split), static_cast<vtkAlgorithm*>(grid) })
  {
    Complaints complaints(filter);
    filter->SetInputConnection(source->GetOutputPort());
    filter->UpdatePiece(0, 2, 0);
    EXPECT_TRUE(complaints.Say("samples 0 to 31, 0 to 31, 0 to 31 of 0 to 31, 0 to 31, 0 to 63")) << complaints.Text;
    EXPECT_EQ(PointsOf(filter->GetOutputDataObject(0)), 0);
  }
}
