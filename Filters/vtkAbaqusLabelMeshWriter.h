// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAbaqusLabelMeshWriter
 * @brief   Labelled tetrahedra as an Abaqus input file (.inp), for Abaqus and CalculiX.
 *
 * Input, names and errors: vtkTetrahedraWriter. The file is a mesh alone, to be taken into a model by
 * "*INCLUDE, INPUT=...":
 *  - *NODE, NSET=NALL: coordinates with 20 characters, which is what the format reads: all digits, but for numbers as
 *    small as -0.00012345678901234567, whose last are rounded off;
 *  - *ELEMENT, TYPE=C3D4, ELSET=<material>, a block per material, positively oriented; *ELSET, ELSET=EALL;
 *  - *SURFACE, NAME=<faces>, TYPE=ELEMENT: the faces of the first material's elements (S1 to S4), for loads and ties;
 *  - *NSET, NSET=<faces>: their nodes, for boundary conditions.
 * Names have 80 characters at most, letters, digits and underscores, a letter first; they differ also when capitals
 * count as small. A comment at the top says which set is which material.
 */
#ifndef vtkAbaqusLabelMeshWriter_h
#define vtkAbaqusLabelMeshWriter_h

#include "vtkTetrahedraWriter.h"

class VTKLABELMESHFILTERS_EXPORT vtkAbaqusLabelMeshWriter : public vtkTetrahedraWriter
{
public:
  static vtkAbaqusLabelMeshWriter* New();
  vtkTypeMacro(vtkAbaqusLabelMeshWriter, vtkTetrahedraWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkAbaqusLabelMeshWriter() = default;
  ~vtkAbaqusLabelMeshWriter() override = default;

  LabelMesh::NameRules Rules() const override;
  void WriteSets(
    const LabelMesh::TetraData& data, const LabelMesh::MeshSets& sets, LabelMesh::WholeFile& file) override;

private:
  vtkAbaqusLabelMeshWriter(const vtkAbaqusLabelMeshWriter&) = delete;
  void operator=(const vtkAbaqusLabelMeshWriter&) = delete;
};

#endif
