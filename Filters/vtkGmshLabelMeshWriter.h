// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGmshLabelMeshWriter
 * @brief   Labelled tetrahedra as a Gmsh mesh (.msh, version 4.1).
 *
 * Input, names and errors: vtkTetrahedraWriter. The file has
 *  - a physical volume per material. Its tag is the label, where all labels of tetrahedra lie within 1 and 2^31 - 1,
 * else its place among the materials, from 1 on;
 *  - a physical surface per pair of materials and per side of the box, tags from 1 on, with triangles whose normals
 * point from the first material to the second (outwards on the outer faces);
 *  - an entity per material, and per pair of materials and side. Nodes of several surfaces belong to the first of them:
 *    curves and corners are not written as entities;
 *  - elements: the tetrahedra as in vtkTetrahedraWriter, then the triangles.
 * Names have 120 bytes at most; double quotes and control characters become underscores.
 */
#ifndef vtkGmshLabelMeshWriter_h
#define vtkGmshLabelMeshWriter_h

#include "vtkTetrahedraWriter.h"

class VTKLABELMESHFILTERS_EXPORT vtkGmshLabelMeshWriter : public vtkTetrahedraWriter
{
public:
  static vtkGmshLabelMeshWriter* New();
  vtkTypeMacro(vtkGmshLabelMeshWriter, vtkTetrahedraWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether to write binary data instead of text, which reads back as the same numbers too (off).
  vtkSetMacro(Binary, vtkTypeBool);
  vtkGetMacro(Binary, vtkTypeBool);
  vtkBooleanMacro(Binary, vtkTypeBool);
  ///@}

protected:
  vtkGmshLabelMeshWriter() = default;
  ~vtkGmshLabelMeshWriter() override = default;

  LabelMesh::NameRules Rules() const override;
  void WriteSets(
    const LabelMesh::TetraData& data, const LabelMesh::MeshSets& sets, LabelMesh::WholeFile& file) override;

private:
  vtkTypeBool Binary = 0;

  vtkGmshLabelMeshWriter(const vtkGmshLabelMeshWriter&) = delete;
  void operator=(const vtkGmshLabelMeshWriter&) = delete;
};

#endif
