// SPDX-License-Identifier: BSD-3-Clause
// The chain stage by stage: stages VOLUME.mha MESH.vtp
// vtkLabelMesher does the same in one filter. One by one, every stage's output can be looked at, written or changed on
// its way to the next one.
#include "vtkDelaunayLabelMesh.h"
#include "vtkIndicatorReconstruct.h"
#include "vtkLabelMeshReport.h"
#include "vtkLabelSplit.h"
#include "vtkParticleSampleCells.h"
#include "vtkSizingField.h"
#include "vtkTighten.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataWriter.h>

#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: stages VOLUME.mha MESH.vtp\n";
    return 2;
  }
  vtkNew<vtkMetaImageReader> reader;
  reader->SetFileName(argv[1]);

  // A mask per material.
  vtkNew<vtkLabelSplit> split;
  split->SetInputConnection(reader->GetOutputPort());

  // Each mask becomes a smooth distance, and keeps its volume.
  vtkNew<vtkTighten> tighten;
  tighten->SetInputConnection(split->GetOutputPort());

  // The distances become indicator functions: where a material's is the largest, there it is.
  vtkNew<vtkIndicatorReconstruct> indicators;
  indicators->SetInputConnection(tighten->GetOutputPort());

  // How long edges should be, everywhere.
  vtkNew<vtkSizingField> sizing;
  sizing->SetInputConnection(0, indicators->GetOutputPort());

  // Particles on the points, curves and surfaces where materials meet.
  vtkNew<vtkParticleSampleCells> particles;
  particles->SetInputConnection(0, indicators->GetOutputPort());
  particles->SetInputConnection(1, sizing->GetOutputPort());

  // Their Delaunay tetrahedra, labelled, give the triangles.
  vtkNew<vtkDelaunayLabelMesh> mesh;
  mesh->SetInputConnection(0, particles->GetOutputPort());
  mesh->SetInputConnection(1, indicators->GetOutputPort());

  // And the judge, which is told of the voxels too.
  vtkNew<vtkLabelMeshReport> report;
  report->SetInputConnection(0, mesh->GetOutputPort());
  report->SetInputConnection(1, reader->GetOutputPort());
  report->Update(); // runs all of them

  auto* materials = vtkPartitionedDataSetCollection::SafeDownCast(split->GetOutputDataObject(0));
  auto* table = vtkTable::SafeDownCast(report->GetOutputDataObject(0));
  auto* certificate = vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray("Certificate"));
  std::cout << materials->GetNumberOfPartitionedDataSets() << " materials, with the background\n"
            << sizing->GetPredictedParticles() << " particles predicted, "
            << particles->GetOutput()->GetNumberOfPoints() << " made\n"
            << mesh->GetOutput()->GetNumberOfPolys() << " triangles\n"
            << (certificate ? certificate->GetValue(0) : vtkStdString("no certificate")) << "\n";

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(mesh->GetOutputPort());
  writer->SetFileName(argv[2]);
  writer->SetDataModeToBinary();
  return writer->Write() && mesh->GetOutput()->GetNumberOfPolys() > 0 ? 0 : 1;
}
