// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExplodeLabels.h"

#include "FilterSupport.h"
#include "MaterialGrids.h"
#include "MeshAdapter.h"

#include <vtkBoundingBox.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkExplodeLabels);

namespace
{
using namespace LabelMesh;

/// The input as blocks, one per material.
void TakeApart(vtkDataObject* input, vtkPartitionedDataSetCollection* blocks)
{
  if (vtkPolyData* mesh = vtkPolyData::SafeDownCast(input))
  {
    SurfacesOfMaterials(mesh, blocks);
  }
  else if (vtkUnstructuredGrid* grid = vtkUnstructuredGrid::SafeDownCast(input))
  {
    GridsOfMaterials(grid, blocks);
  }
  else
  {
    blocks->ShallowCopy(input);
  }
}

vtkPointSet* PointsOf(vtkPartitionedDataSet* block, unsigned int n)
{
  vtkDataObject* piece = block->GetPartitionAsDataObject(n);
  vtkPointSet* points = vtkPointSet::SafeDownCast(piece);
  if (piece && !points)
  {
    throw std::invalid_argument(std::string("A block is of type ") + piece->GetClassName() +
      ", which has no points to move. Connect the surfaces of Label Mesher or Delaunay Label Mesh.");
  }
  return points;
}

void AddBounds(vtkPointSet* points, vtkBoundingBox& box)
{
  if (points && points->GetNumberOfPoints() > 0)
  {
    box.AddBounds(points->GetBounds());
  }
}

vtkBoundingBox BoxOf(vtkPartitionedDataSet* block)
{
  vtkBoundingBox box;
  for (unsigned int n = 0; n < block->GetNumberOfPartitions(); ++n)
  {
    AddBounds(PointsOf(block, n), box);
  }
  return box;
}

Vec3 CenterOf(const vtkBoundingBox& box)
{
  Vec3 center = Vec3::Zero();
  if (box.IsValid())
  {
    box.GetCenter(center.data());
  }
  return center;
}

/// A copy of a piece that shares all but its points.
vtkSmartPointer<vtkPointSet> Moved(vtkPointSet* piece, const Vec3& by)
{
  auto moved = vtkSmartPointer<vtkPointSet>::Take(piece->NewInstance());
  moved->ShallowCopy(piece);
  if (!piece->GetPoints())
  {
    return moved;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(piece->GetPoints()->GetDataType());
  points->SetNumberOfPoints(piece->GetNumberOfPoints());
  for (vtkIdType p = 0; p < piece->GetNumberOfPoints(); ++p)
  {
    Vec3 x;
    piece->GetPoint(p, x.data());
    x += by;
    points->SetPoint(p, x.data());
  }
  moved->SetPoints(points);
  return moved;
}
}

int vtkExplodeLabels::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

int vtkExplodeLabels::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputVector, 0);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      monitor.Step(0.0, "Taking materials apart");
      vtkNew<vtkPartitionedDataSetCollection> blocks;
      TakeApart(input, blocks);
      output->ShallowCopy(blocks); // names, assembly and field data; the pieces are replaced
      const unsigned int count = blocks->GetNumberOfPartitionedDataSets();
      vtkBoundingBox all;
      for (unsigned int b = 0; b < count; ++b)
      {
        all.AddBox(BoxOf(blocks->GetPartitionedDataSet(b)));
      }
      for (unsigned int b = 0; b < count; ++b)
      {
        monitor.Step(double(b) / count, "Moving materials");
        vtkPartitionedDataSet* block = blocks->GetPartitionedDataSet(b);
        const Vec3 by = this->Factor * (CenterOf(BoxOf(block)) - CenterOf(all));
        vtkNew<vtkPartitionedDataSet> pieces;
        pieces->ShallowCopy(block);
        for (unsigned int n = 0; n < block->GetNumberOfPartitions(); ++n)
        {
          if (vtkPointSet* piece = PointsOf(block, n))
          {
            pieces->SetPartition(n, Moved(piece, by));
          }
        }
        output->SetPartitionedDataSet(b, pieces);
      }
      monitor.Step(1.0);
    });
}

void vtkExplodeLabels::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Factor: " << this->Factor << "\n";
}
