// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAbaqusLabelMeshWriter.h"

#include "MeshSets.h"
#include "WholeFile.h"

#include <vtkObjectFactory.h>

#include <cctype>

vtkStandardNewMacro(vtkAbaqusLabelMeshWriter);

namespace
{
using namespace LabelMesh;

/// "Floating-point numbers may occupy 20 characters"; CalculiX cuts off what is longer, and then refuses half an
/// exponent.
constexpr int NumberWidth = 20;
constexpr int IdsPerLine = 16;

/// The format's number of the face opposite to a corner: S1 is 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
constexpr Index FaceNumbers[4] = { 3, 4, 2, 1 };

/// In a comment no name may begin a new line.
std::string OneLine(std::string name)
{
  for (char& c : name)
  {
    c = std::iscntrl(static_cast<unsigned char>(c)) ? ' ' : c;
  }
  return name;
}

void WriteComments(const TetraData& data, const MeshSets& sets, WholeFile& file)
{
  file << "** LabelMesh " << LABELMESH_VERSION << ": " << Index(data.Mesh.Points.size()) << " nodes, "
       << Index(data.Mesh.Corners.size()) << " tetrahedra\n";
  for (const ElementSet& set : sets.Elements)
  {
    const Material& material = data.Materials[set.Material];
    file << "** element set " << set.Name << ": label " << material.Label << ", ";
    file << OneLine(material.Name).substr(0, 80) << '\n';
  }
}

void WriteNodes(const TetraMesh& mesh, WholeFile& file)
{
  file << "*NODE, NSET=NALL\n";
  for (std::size_t n = 0; n < mesh.Points.size(); ++n)
  {
    file << Index(n + 1);
    for (int axis = 0; axis < 3; ++axis)
    {
      file << ',';
      file.Narrow(mesh.Points[n][axis], NumberWidth);
    }
    file << '\n';
  }
}

void WriteElements(const TetraMesh& mesh, const MeshSets& sets, WholeFile& file)
{
  for (const ElementSet& set : sets.Elements)
  {
    file << "*ELEMENT, TYPE=C3D4, ELSET=" << set.Name << '\n';
    for (const std::int32_t tetra : set.Tetrahedra)
    {
      file << Index(tetra) + 1;
      for (const std::int32_t corner : mesh.Corners[tetra])
      {
        file << ',' << Index(corner) + 1;
      }
      file << '\n';
    }
  }
  file << "*ELSET, ELSET=EALL\n";
  for (const ElementSet& set : sets.Elements)
  {
    file << set.Name << '\n';
  }
}

void WriteFaces(const TetraMesh& mesh, const MeshSets& sets, WholeFile& file)
{
  for (const FaceSet& set : sets.Faces)
  {
    file << "*SURFACE, NAME=" << set.Name << ", TYPE=ELEMENT\n";
    for (const std::size_t p : set.Patches)
    {
      for (const TetraFace& face : sets.Patches[p].Faces)
      {
        file << Index(face.Tetra) + 1 << ",S" << FaceNumbers[face.Opposite] << '\n';
      }
    }
    file << "*NSET, NSET=" << set.Name;
    int onLine = IdsPerLine;
    for (const std::int32_t point : PointsOf(sets, set, mesh))
    {
      file << (onLine == IdsPerLine ? '\n' : ',') << Index(point) + 1;
      onLine = onLine == IdsPerLine ? 1 : onLine + 1;
    }
    file << '\n';
  }
}
}

LabelMesh::NameRules vtkAbaqusLabelMeshWriter::Rules() const
{
  return { 80, true, { "NALL", "EALL" } };
}

void vtkAbaqusLabelMeshWriter::WriteSets(const TetraData& data, const MeshSets& sets, WholeFile& file)
{
  WriteComments(data, sets, file);
  WriteNodes(data.Mesh, file);
  WriteElements(data.Mesh, sets, file);
  WriteFaces(data.Mesh, sets, file);
}

void vtkAbaqusLabelMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
