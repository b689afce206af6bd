// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraWriter.h"

#include "Core/Parallel.h"
#include "MeshSets.h"
#include "WholeFile.h"

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkUnstructuredGrid.h>

#include <exception>

vtkTetrahedraWriter::~vtkTetrahedraWriter()
{
  this->SetFileName(nullptr);
}

int vtkTetrahedraWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

void vtkTetrahedraWriter::WriteData()
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(this->GetInput());
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("There is no name of a file. Set FileName.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return;
  }
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    vtkErrorMacro("There are no tetrahedra to write to '" << this->FileName << "'.");
    this->SetErrorCode(vtkErrorCode::UserError);
    return;
  }
  try
  {
    const LabelMesh::TetraData data = LabelMesh::ReadTetrahedra(grid);
    if (data.FlatTetrahedra > 0)
    {
      vtkWarningMacro(<< data.FlatTetrahedra << " of " << data.Mesh.Corners.size()
                      << " tetrahedra have no volume; solvers will refuse them.");
    }
    LabelMesh::MeshSets sets;
    LabelMesh::WithThreads([this, &data, &sets]() { sets = LabelMesh::FindSets(data, this->Rules()); });
    LabelMesh::WholeFile file(this->FileName);
    this->WriteSets(data, sets, file);
    file.Commit();
  }
  catch (const LabelMesh::CannotWrite& problem)
  {
    vtkErrorMacro(<< problem.what());
    this->SetErrorCode(problem.code() == std::errc::no_space_on_device ? vtkErrorCode::OutOfDiskSpaceError
                                                                       : vtkErrorCode::CannotOpenFileError);
  }
  catch (const std::exception& problem)
  {
    vtkErrorMacro(<< problem.what());
    this->SetErrorCode(vtkErrorCode::UserError);
  }
}

void vtkTetrahedraWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
