// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGridLabelMesh.h"

#include "FilterSupport.h"
#include "GridMesh.h"
#include "LabelImage.h"
#include "MeshAdapter.h"
#include "ServerPieces.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <set>
#include <stdexcept>

vtkStandardNewMacro(vtkGridLabelMesh);

namespace
{
using namespace LabelMesh;

/// The collection's header as the particle method would have it: every asked label, and the background.
CollectionHeader HeaderOf(const LabelImage& image, const std::vector<vtkIdType>& asked, Label background)
{
  std::set<Label> labels(image.Labels.begin(), image.Labels.end());
  labels.insert(asked.begin(), asked.end());
  labels.insert(background);
  CollectionHeader header;
  header.Source = image.Frame;
  header.Background = background;
  for (const Label label : labels)
  {
    header.Materials.push_back(DefaultMaterial(label));
  }
  return header;
}

/// Ids become positions in the header's materials.
void UseIdsOf(const CollectionHeader& header, LabelImage& image)
{
  std::vector<Label> labels;
  for (const Material& material : header.Materials)
  {
    labels.push_back(material.Label);
  }
  std::vector<MaterialId> renumbered;
  for (const Label label : image.Labels)
  {
    renumbered.push_back(MaterialId(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin()));
  }
  for (MaterialId& id : image.Ids)
  {
    id = renumbered[id];
  }
  image.Labels = labels;
}

LabelImage LabelsToMesh(
  vtkImageData* input, vtkDataArray* array, bool cellData, const std::vector<vtkIdType>& asked, Label background)
{
  LabelImage image = ReadLabelImage(input, array, cellData);
  if (!asked.empty())
  {
    std::vector<Label> kept(asked.begin(), asked.end());
    std::sort(kept.begin(), kept.end());
    MergeIntoBackground(image, kept, background);
  }
  if (image.Labels.size() == 1 && image.Labels[0] == background)
  {
    throw std::invalid_argument("There is nothing to mesh: every voxel has the background label " +
      std::to_string(background) + (asked.empty() ? "." : " or a label that is not asked for."));
  }
  return image;
}
}

vtkGridLabelMesh::vtkGridLabelMesh()
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

void vtkGridLabelMesh::AddLabel(vtkIdType label)
{
  this->Labels.push_back(label);
  this->Modified();
}

void vtkGridLabelMesh::ClearLabels()
{
  if (!this->Labels.empty())
  {
    this->Labels.clear();
    this->Modified();
  }
}

vtkPartitionedDataSetCollection* vtkGridLabelMesh::GetSurfaces()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkGridLabelMesh::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkGridLabelMesh::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkGridLabelMesh::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAll(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkGridLabelMesh::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkPartitionedDataSetCollection* surfaces = vtkPartitionedDataSetCollection::GetData(outputVector, 1);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      RequireWhole(inputVector[0]->GetInformationObject(0), input);
      monitor.Step(0.0, "Reading labels");
      CollectionHeader header;
      header.Background = this->BackgroundLabel;
      InterfaceMesh mesh;
      if (input->GetNumberOfPoints() > 0)
      {
        int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
        vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector, association);
        LabelImage image = LabelsToMesh(
          input, array, association == vtkDataObject::FIELD_ASSOCIATION_CELLS, this->Labels, this->BackgroundLabel);
        header = HeaderOf(image, this->Labels, this->BackgroundLabel);
        UseIdsOf(header, image);
        const auto background = std::find_if(header.Materials.begin(), header.Materials.end(),
          [&](const Material& m) { return m.Label == header.Background; });
        if (RequestedPiece(request, outputVector).IsFirst())
        {
          mesh = MeshGrid(image, MaterialId(background - header.Materials.begin()),
            { this->SmoothingIterations, this->PassBand, this->TargetTriangles }, this, monitor.Part(0.05, 0.95));
        }
      }
      InterfaceToPolyData(mesh, header, output);
      SurfacesOfMaterials(output, surfaces);
      monitor.Step(1.0);
    });
}

void vtkGridLabelMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Labels:";
  for (const vtkIdType label : this->Labels)
  {
    os << " " << label;
  }
  os << (this->Labels.empty() ? " (all)\n" : "\n");
  os << indent << "BackgroundLabel: " << this->BackgroundLabel << "\n";
  os << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "PassBand: " << this->PassBand << "\n";
  os << indent << "TargetTriangles: " << this->TargetTriangles << "\n";
}
