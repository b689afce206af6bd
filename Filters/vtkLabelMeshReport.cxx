// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelMeshReport.h"

#include "FilterSupport.h"
#include "LabelMeshNames.h"
#include "RatioHistogram.h"
#include "ReportFacts.h"
#include "ReportTables.h"
#include "ServerPieces.h"
#include "TetraReport.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkLabelMeshReport);

namespace
{
using namespace LabelMesh;

/// The mesh with the distance of its points to the interfaces of the voxels.
void FillErrorMap(vtkPolyData* mesh, const std::vector<double>& distances, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(Names::DistanceToVoxels);
  array->SetNumberOfValues(mesh->GetNumberOfPoints());
  std::copy(distances.begin(), distances.end(), array->GetPointer(0));
  output->ShallowCopy(mesh);
  output->GetPointData()->SetScalars(array);
}
}

vtkLabelMeshReport::vtkLabelMeshReport()
{
  this->SetNumberOfInputPorts(6);
  this->SetNumberOfOutputPorts(7);
  this->SetInputArrayToProcess(
    0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

int vtkLabelMeshReport::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkPolyData", "vtkImageData", "vtkDataObject", "vtkImageData", "vtkPolyData",
    "vtkUnstructuredGrid" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkLabelMeshReport::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 3 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkLabelMeshReport::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkLabelMeshReport::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      void (*const fill[])(vtkTable*, const ReportFacts&) = { FillMaterials, FillInterfaces, FillLosses };
      if (!RequestedPiece(request, outputVector).IsFirst())
      {
        for (int port = 0; port < 3; ++port)
        {
          fill[port](vtkTable::GetData(outputVector, port), ReportFacts()); // the columns, and no rows
        }
        return;
      }
      ReportInputs inputs;
      inputs.Mesh = vtkPolyData::GetData(inputVector[0], 0);
      inputs.Volume = vtkImageData::GetData(inputVector[1], 0);
      inputs.Stages = vtkDataObject::GetData(inputVector[2], 0);
      inputs.Tightened = vtkImageData::GetData(inputVector[3], 0);
      inputs.Particles = vtkPolyData::GetData(inputVector[4], 0);
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      inputs.VolumeLabels = inputs.Volume ? this->GetInputArrayToProcess(0, inputVector, association) : nullptr;
      inputs.LabelsOfCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
      if (this->ErrorMap && !inputs.Volume)
      {
        throw std::invalid_argument("The error map needs the label volume. Connect it to input port 1.");
      }
      const ReportFacts facts = FindFacts(inputs, monitor.Part(0.0, 0.9));
      for (int port = 0; port < 3; ++port)
      {
        vtkTable* table = vtkTable::GetData(outputVector, port);
        fill[port](table, facts);
        AddTotals(table->GetFieldData(), facts);
      }
      if (vtkUnstructuredGrid* tetrahedra = vtkUnstructuredGrid::GetData(inputVector[5], 0))
      {
        const TetraReport report = ReportOfTetrahedra(tetrahedra);
        FillTetrahedra(vtkTable::GetData(outputVector, 4), report);
        FillDihedrals(vtkTable::GetData(outputVector, 5), report);
      }
      FillRadiusRatios(vtkTable::GetData(outputVector, 6), facts.Mesh, vtkUnstructuredGrid::GetData(inputVector[5], 0));
      if (this->ErrorMap)
      {
        monitor.Step(0.9, "Measuring distances");
        const std::vector<double> distances = DistancesOf(facts);
        FillErrorMap(inputs.Mesh, distances, vtkPolyData::GetData(outputVector, 3));
        for (int port = 0; port < 3; ++port)
        {
          AddDistances(vtkTable::GetData(outputVector, port)->GetFieldData(), distances);
        }
      }
      monitor.Step(1.0);
    });
}

vtkPolyData* vtkLabelMeshReport::GetErrorMapOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(3));
}

vtkTable* vtkLabelMeshReport::GetTetrahedraOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(4));
}

vtkTable* vtkLabelMeshReport::GetDihedralsOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(5));
}

vtkTable* vtkLabelMeshReport::GetRadiusRatiosOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(6));
}

void vtkLabelMeshReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorMap: " << this->ErrorMap << "\n";
}
