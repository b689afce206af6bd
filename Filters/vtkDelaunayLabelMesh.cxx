// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayLabelMesh.h"

#include "Core/MeshInterfaces.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>

vtkStandardNewMacro(vtkDelaunayLabelMesh);

namespace
{
constexpr double PoorRatio = 0.3; // a mesh with a worse triangle gets a warning
constexpr double ManyKept = 0.01; // of the vertices; so does one that could not be improved at more
}

vtkDelaunayLabelMesh::vtkDelaunayLabelMesh()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkPartitionedDataSetCollection* vtkDelaunayLabelMesh::GetSurfaces()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkDelaunayLabelMesh::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkDelaunayLabelMesh::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkDelaunayLabelMesh::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace LabelMesh;
  vtkPolyData* particles = vtkPolyData::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputVector[1], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkPartitionedDataSetCollection* surfaces = vtkPartitionedDataSetCollection::GetData(outputVector, 1);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(collection);
      MeshResult result;
      if (particles->GetNumberOfPoints() > 0)
      {
        monitor.Step(0.0, "Reading the particles");
        const std::vector<Particle> sites = ParticlesFromPolyData(particles, header);
        const IndicatorSet indicators = MakeIndicatorSet(collection, header);
        MeshOptions options;
        options.RepairRounds = this->RepairRounds;
        options.ImprovePasses = this->ImprovePasses;
        options.RepairBelow = this->RepairBelow;
        result = MeshInterfaces(indicators, sites, options, monitor.Part(0.05, 0.9));
      }
      this->NumberOfTetrahedra = result.Tetrahedra;
      this->RoundsDone = result.Rounds;
      this->WrongFaces = result.WrongFaces;
      this->NonManifoldEdges = result.NonManifoldEdges;
      this->NonManifoldVertices = result.NonManifoldVertices;
      this->WorstRadiusRatio = result.WorstRatio;
      this->KeptFromCutting = result.KeptFromCutting;
      if (result.WrongFaces + result.NonManifoldEdges + result.NonManifoldVertices > 0 ||
        result.WorstRatio < PoorRatio || result.KeptFromCutting > ManyKept * double(result.Mesh.Vertices.size()))
      {
        vtkWarningMacro(
          "After " << result.Rounds << " rounds of repair the mesh has " << result.WrongFaces
                   << " faces between materials that are not at all their vertices, " << result.NonManifoldEdges
                   << " non-manifold edges, " << result.NonManifoldVertices
                   << " non-manifold vertices, and its worst triangle has a radius ratio of " << result.WorstRatio
                   << "; " << result.KeptFromCutting
                   << " of its vertices were left as they were, since improved triangles there cut others. A smaller "
                      "Epsilon, FeatureSizeFloor or MinimumLength, or more RepairRounds may help.");
      }
      InterfaceToPolyData(result.Mesh, header, output);
      vtkNew<vtkTypeInt64Array> kept;
      kept->SetName(Names::KeptFromCutting);
      kept->InsertNextValue(result.KeptFromCutting);
      output->GetFieldData()->AddArray(kept);
      SurfacesOfMaterials(output, surfaces);
      monitor.Step(1.0);
    });
}

void vtkDelaunayLabelMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RepairRounds: " << this->RepairRounds << "\n";
  os << indent << "ImprovePasses: " << this->ImprovePasses << "\n";
  os << indent << "RepairBelow: " << this->RepairBelow << "\n";
  os << indent << "NumberOfTetrahedra: " << this->NumberOfTetrahedra << "\n";
  os << indent << "RoundsDone: " << this->RoundsDone << "\n";
  os << indent << "WrongFaces: " << this->WrongFaces << "\n";
  os << indent << "NonManifoldEdges: " << this->NonManifoldEdges << "\n";
  os << indent << "NonManifoldVertices: " << this->NonManifoldVertices << "\n";
  os << indent << "WorstRadiusRatio: " << this->WorstRadiusRatio << "\n";
  os << indent << "KeptFromCutting: " << this->KeptFromCutting << "\n";
}
