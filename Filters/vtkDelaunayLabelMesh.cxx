// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayLabelMesh.h"

#include "Core/ConstrainedDelaunay.h"
#include "Core/MeshInterfaces.h"
#include "Core/TetraImprovement.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"
#include "ServerPieces.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkDelaunayLabelMesh);

namespace
{
using namespace LabelMesh;

constexpr double PoorRatio = 0.3; // a mesh with a worse triangle gets a warning
constexpr double ManyKept = 0.01; // of the vertices; so does one that could not be improved at more

/// Takes the particles of 3-cells out.
std::vector<InnerPoint> TakeInside(std::vector<Particle>& particles)
{
  std::vector<InnerPoint> inside;
  for (const Particle& p : particles)
  {
    if (p.CellDimension == 3)
    {
      inside.push_back({ p.Position, p.TargetLength });
    }
  }
  particles.erase(
    std::remove_if(particles.begin(), particles.end(), [](const Particle& p) { return p.CellDimension == 3; }),
    particles.end());
  return inside;
}

/// Fills the mesh with tetrahedra and improves them. Vertices of the mesh that move for their sake move in it too.
TetraResult FillAndImprove(const std::vector<InnerPoint>& inside, MaterialId background, const TetraOptions& fill,
  const TetraImproveOptions& improve, InterfaceMesh& mesh, vtkIdType& interfaceMoves, const Monitor& monitor)
{
  TetraResult filled = FillWithTetrahedra(mesh, background, inside, fill, monitor.Part(0.0, 0.7));
  if (!filled.Mesh.Corners.empty() && improve.Passes > 0)
  {
    interfaceMoves = ImproveTetrahedra(filled.Mesh, improve, monitor.Part(0.7, 1.0)).Slides;
    TakePositions(filled.Mesh, mesh);
  }
  return filled;
}

/// TightVolumes, with the background's left open; empty where the collection does not say.
std::vector<double> WantedVolumes(vtkPartitionedDataSetCollection* collection, const CollectionHeader& header)
{
  vtkDataArray* const tight = collection->GetFieldData()->GetArray(Names::TightVolumes);
  if (!tight || std::size_t(tight->GetNumberOfTuples()) != header.Materials.size())
  {
    return {};
  }
  std::vector<double> wanted;
  for (std::size_t m = 0; m < header.Materials.size(); ++m)
  {
    wanted.push_back(header.Materials[m].Label == header.Background ? 0.0 : tight->GetComponent(vtkIdType(m), 0));
  }
  return wanted;
}
}

vtkDelaunayLabelMesh::vtkDelaunayLabelMesh()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkPartitionedDataSetCollection* vtkDelaunayLabelMesh::GetSurfaces()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

vtkUnstructuredGrid* vtkDelaunayLabelMesh::GetTetrahedraOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkDelaunayLabelMesh::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkDelaunayLabelMesh::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkUnstructuredGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  PromiseFirstPiece(info);
  return 1;
}

int vtkDelaunayLabelMesh::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAllPromised(inputVector, this->GetNumberOfInputPorts());
  return 1;
}

int vtkDelaunayLabelMesh::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* particles = vtkPolyData::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputVector[1], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkPartitionedDataSetCollection* surfaces = vtkPartitionedDataSetCollection::GetData(outputVector, 1);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      const CollectionHeader header = ReadHeader(collection);
      MeshResult result;
      std::vector<InnerPoint> inside;
      MaterialId background = NoMaterial;
      TetraImproveOptions improve;
      if (particles->GetNumberOfPoints() > 0 && RequestedPiece(request, outputVector).IsFirst())
      {
        monitor.Step(0.0, "Reading the particles");
        std::vector<Particle> sites = ParticlesFromPolyData(particles, header);
        inside = TakeInside(sites);
        const IndicatorSet indicators = MakeIndicatorSet(collection, header);
        background = indicators.Background();
        improve.Slide.Box = indicators.Border();
        MeshOptions options;
        options.RepairRounds = this->RepairRounds;
        options.ImprovePasses = this->ImprovePasses;
        options.RepairBelow = this->RepairBelow;
        options.CorrectChords = this->ChordCorrection;
        options.WantedVolumes = this->VolumeCorrection ? WantedVolumes(collection, header) : std::vector<double>();
        result = MeshInterfaces(
          indicators, std::move(sites), options, monitor.Part(0.05, this->Tetrahedra == Off ? 0.9 : 0.5));
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
      TetraResult filled;
      this->TetrahedraFailure.clear();
      this->InterfaceMoves = 0;
      if (this->Tetrahedra != Off)
      {
        TetraOptions fill;
        fill.RefinementRounds = this->Tetrahedra == Packed ? this->RefinementRounds : 0;
        fill.Refine = this->Tetrahedra == TetGen;
        fill.RadiusEdgeRatio = this->RadiusEdgeRatio;
        fill.MinimumDihedral = this->MinimumDihedral;
        inside.resize(fill.Refine ? 0 : inside.size());
        improve.Passes = this->TetraImprovePasses;
        improve.Slide.Rounds = this->SlideSurface ? improve.Slide.Rounds : 0;
        improve.Slide.LeastRatio = std::max(improve.Slide.LeastRatio, result.WorstRatio);
        try
        {
          filled = FillAndImprove(
            inside, background, fill, improve, result.Mesh, this->InterfaceMoves, monitor.Part(0.55, 0.95));
        }
        catch (const std::runtime_error& problem)
        {
          this->TetrahedraFailure = problem.what();
          vtkWarningMacro(<< this->TetrahedraFailure);
        }
      }
      InterfaceToPolyData(result.Mesh, header, output);
      vtkNew<vtkTypeInt64Array> kept;
      kept->SetName(Names::KeptFromCutting);
      kept->InsertNextValue(result.KeptFromCutting);
      output->GetFieldData()->AddArray(kept);
      SurfacesOfMaterials(output, surfaces);
      this->InnerPointsLeftOut = filled.LeftOut;
      this->InnerPointsAdded = filled.Added;
      this->CircumcentresInserted = filled.Inserted;
      TetrahedraToGrid(filled.Mesh, header, vtkUnstructuredGrid::GetData(outputVector, 2));
      monitor.Step(1.0);
    });
}

void vtkDelaunayLabelMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RepairRounds: " << this->RepairRounds << "\n";
  os << indent << "ImprovePasses: " << this->ImprovePasses << "\n";
  os << indent << "RepairBelow: " << this->RepairBelow << "\n";
  os << indent << "ChordCorrection: " << this->ChordCorrection << "\n";
  os << indent << "VolumeCorrection: " << this->VolumeCorrection << "\n";
  os << indent << "Tetrahedra: " << this->Tetrahedra << "\n";
  os << indent << "RefinementRounds: " << this->RefinementRounds << "\n";
  os << indent << "RadiusEdgeRatio: " << this->RadiusEdgeRatio << "\n";
  os << indent << "MinimumDihedral: " << this->MinimumDihedral << "\n";
  os << indent << "TetraImprovePasses: " << this->TetraImprovePasses << "\n";
  os << indent << "SlideSurface: " << this->SlideSurface << "\n";
  os << indent << "InnerPointsLeftOut: " << this->InnerPointsLeftOut << "\n";
  os << indent << "InnerPointsAdded: " << this->InnerPointsAdded << "\n";
  os << indent << "CircumcentresInserted: " << this->CircumcentresInserted << "\n";
  os << indent << "InterfaceMoves: " << this->InterfaceMoves << "\n";
  os << indent << "TetrahedraFailure: " << this->TetrahedraFailure << "\n";
  os << indent << "NumberOfTetrahedra: " << this->NumberOfTetrahedra << "\n";
  os << indent << "RoundsDone: " << this->RoundsDone << "\n";
  os << indent << "WrongFaces: " << this->WrongFaces << "\n";
  os << indent << "NonManifoldEdges: " << this->NonManifoldEdges << "\n";
  os << indent << "NonManifoldVertices: " << this->NonManifoldVertices << "\n";
  os << indent << "WorstRadiusRatio: " << this->WorstRadiusRatio << "\n";
  os << indent << "KeptFromCutting: " << this->KeptFromCutting << "\n";
}
