// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelSurvey.h"

#include "Core/LabelSurvey.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "ServerPieces.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkLabelSurvey);

namespace
{
using namespace LabelMesh;

constexpr char NameColumn[] = "Name", VoxelsColumn[] = "Voxels";
constexpr char LabelAColumn[] = "LabelA", LabelBColumn[] = "LabelB", FacesColumn[] = "VoxelFaces";

/// A typed column, empty.
template <typename Array>
Array* AddColumn(vtkTable* table, const char* name, int components = 1)
{
  vtkNew<Array> column;
  column->SetName(name);
  column->SetNumberOfComponents(components);
  table->AddColumn(column);
  return column; // the table keeps it
}

/// The background has an id of its own, also where no voxel has its label.
MaterialId WithBackground(LabelImage& image, Label background)
{
  const auto at = std::lower_bound(image.Labels.begin(), image.Labels.end(), background);
  const MaterialId id = MaterialId(at - image.Labels.begin());
  if (at == image.Labels.end() || *at != background)
  {
    image.Labels.insert(at, background);
    for (MaterialId& voxel : image.Ids)
    {
      voxel += voxel >= id ? 1 : 0;
    }
  }
  return id;
}

void FillTables(const LabelImage& image, const LabelSurvey& survey, vtkTable* labels, vtkTable* pairs)
{
  auto* label = AddColumn<vtkTypeInt64Array>(labels, Names::Label);
  auto* name = AddColumn<vtkStringArray>(labels, NameColumn);
  auto* voxels = AddColumn<vtkTypeInt64Array>(labels, VoxelsColumn);
  auto* color = AddColumn<vtkDoubleArray>(labels, Names::Color, 3);
  for (std::size_t id = 0; id < image.Labels.size(); ++id)
  {
    if (survey.Voxels[id] > 0)
    {
      const Material material = DefaultMaterial(image.Labels[id]);
      label->InsertNextValue(material.Label);
      name->InsertNextValue(material.Name);
      voxels->InsertNextValue(survey.Voxels[id]);
      color->InsertNextTuple(material.Color.data());
    }
  }
  auto* labelA = AddColumn<vtkTypeInt64Array>(pairs, LabelAColumn);
  auto* labelB = AddColumn<vtkTypeInt64Array>(pairs, LabelBColumn);
  auto* faces = AddColumn<vtkTypeInt64Array>(pairs, FacesColumn);
  for (const VoxelContact& contact : survey.Contacts)
  {
    labelA->InsertNextValue(image.Labels[contact.Ids[0]]);
    labelB->InsertNextValue(image.Labels[contact.Ids[1]]);
    faces->InsertNextValue(contact.Faces);
  }
}
}

vtkLabelSurvey::vtkLabelSurvey()
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

int vtkLabelSurvey::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkLabelSurvey::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkLabelSurvey::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAll(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkLabelSurvey::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool first = RequestedPiece(request, outputVector).IsFirst();
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  vtkTable* labels = vtkTable::GetData(outputVector, 0);
  vtkTable* pairs = vtkTable::GetData(outputVector, 1);
  const int result = RunStage(this,
    [&](const Monitor& monitor)
    {
      this->Trouble.clear();
      if (input->GetNumberOfPoints() == 0 || !first)
      {
        FillTables(LabelImage(), LabelSurvey(), labels, pairs);
        return;
      }
      RequireWhole(inputVector[0]->GetInformationObject(0), input);
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector, association);
      monitor.Step(0.0, "Reading labels");
      LabelImage image;
      try
      {
        image = ReadLabelImage(input, array, association == vtkDataObject::FIELD_ASSOCIATION_CELLS);
      }
      catch (const std::invalid_argument& error)
      {
        this->Trouble = error.what();
        if (!this->Quiet)
        {
          throw;
        }
        FillTables(LabelImage(), LabelSurvey(), labels, pairs);
        return;
      }
      const MaterialId background = WithBackground(image, this->BackgroundLabel);
      const LabelSurvey survey = SurveyLabels(
        image.Frame.Samples().Dims, image.Ids, background, int(image.Labels.size()), monitor.Part(0.5, 1.0));
      FillTables(image, survey, labels, pairs);
    });
  this->KeepColumns();
  return result;
}

void vtkLabelSurvey::KeepColumns()
{
  this->Columns.clear();
  for (int port = 0; port < 2; ++port)
  {
    vtkTable* table = vtkTable::SafeDownCast(this->GetOutputDataObject(port));
    for (vtkIdType n = 0; n < table->GetNumberOfColumns(); ++n)
    {
      vtkSmartPointer<vtkAbstractArray> column = table->GetColumn(n);
      if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(column))
      {
        column = vtkSmartPointer<vtkDoubleArray>::New();
        column->DeepCopy(numbers);
      }
      this->Columns[table->GetColumnName(n)] = column;
    }
  }
}

vtkAbstractArray* vtkLabelSurvey::Column(const char* name) const
{
  const auto found = this->Columns.find(name);
  return found != this->Columns.end() ? found->second.Get() : nullptr;
}

vtkAbstractArray* vtkLabelSurvey::GetLabels()
{
  return this->Column(Names::Label);
}

vtkAbstractArray* vtkLabelSurvey::GetNames()
{
  return this->Column(NameColumn);
}

vtkAbstractArray* vtkLabelSurvey::GetVoxels()
{
  return this->Column(VoxelsColumn);
}

vtkAbstractArray* vtkLabelSurvey::GetColors()
{
  return this->Column(Names::Color);
}

vtkAbstractArray* vtkLabelSurvey::GetPairLabelsA()
{
  return this->Column(LabelAColumn);
}

vtkAbstractArray* vtkLabelSurvey::GetPairLabelsB()
{
  return this->Column(LabelBColumn);
}

vtkAbstractArray* vtkLabelSurvey::GetPairVoxelFaces()
{
  return this->Column(FacesColumn);
}

void vtkLabelSurvey::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BackgroundLabel: " << this->BackgroundLabel << "\n";
  os << indent << "Quiet: " << this->Quiet << "\n";
  os << indent << "Trouble: " << this->Trouble << "\n";
}
