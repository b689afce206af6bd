// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraWriter
 * @brief   What the writers of tetrahedra for simulation have in common.
 *
 * Input (vtkUnstructuredGrid): tetrahedra with the cell array "Label" (whole numbers). Field data Labels, MaterialNames
 * and BackgroundLabel are used where they are there; without them materials are called "Label_<label>", and the
 * background is 0. Tetrahedra of any origin will do.
 *
 * The files have named sets:
 *  - the tetrahedra of each material, under the material's name;
 *  - the faces between each two materials, and the outer faces, beyond which is the background, under the two names
 *    joined by "_" ("Label_1_Label_2", "upper_Label_0"): the background second, else ascending by label;
 *  - where the mesh has faces in a side of its box (a flat border: vtkLabelSplit), those faces as "border_x_min",
 *    "border_x_max", "border_y_min" ... besides. The box is along the world's axes; for an image that is turned
 *    otherwise (field data SourceDirection, as vtkDelaunayLabelMesh writes it) along the image's own x, y and z.
 * Names are made fit for the format, and different ones by "_2", "_3" ...
 *
 * Node n is the n-th point that a tetrahedron has, element n the n-th cell, from 1 on. Tetrahedra of negative volume
 * are turned over; ones of no volume are written, with a warning. A file is written whole or not at all.
 *
 * Errors: cells that are no tetrahedra, no Label, a face that more than two tetrahedra have, coordinates that are not
 * finite, no tetrahedra at all, a file that cannot be written.
 */
#ifndef vtkTetrahedraWriter_h
#define vtkTetrahedraWriter_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkWriter.h"

namespace LabelMesh
{
struct MeshSets;
struct NameRules;
struct TetraData;
class WholeFile;
}

class VTKLABELMESHFILTERS_EXPORT vtkTetrahedraWriter : public vtkWriter
{
public:
  vtkAbstractTypeMacro(vtkTetrahedraWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file to write; there is no default.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

protected:
  vtkTetrahedraWriter() = default;
  ~vtkTetrahedraWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  virtual LabelMesh::NameRules Rules() const = 0;
  virtual void WriteSets(
    const LabelMesh::TetraData& data, const LabelMesh::MeshSets& sets, LabelMesh::WholeFile& file) = 0;

private:
  char* FileName = nullptr;

  vtkTetrahedraWriter(const vtkTetrahedraWriter&) = delete;
  void operator=(const vtkTetrahedraWriter&) = delete;
};

#endif
