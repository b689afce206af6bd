// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkExplodeLabels
 * @brief   Move the materials of a mesh apart, to look between them.
 *
 * Each material is moved as it is, along the line from the centre of all materials to its own (the centres of their
 * bounding boxes): by Factor times that distance. Sizes do not change. Materials whose centres fall together, such as
 * nested shells, stay where they are: clip them, or leave the outer one out.
 *
 * Input port 0, one of:
 *  - vtkPartitionedDataSetCollection of one vtkPointSet per material, such as output port 1 of vtkLabelMesher;
 *  - vtkPolyData with the cell array "BoundaryLabels", such as output port 0 of vtkLabelMesher: it is taken apart into
 * a closed surface per material;
 *  - vtkUnstructuredGrid with the cell array "Label" (1 component), such as output port 4 of vtkLabelMesher: it is
 * taken apart into a grid per label.
 *
 * Output port 0 (vtkPartitionedDataSetCollection): a block per material, ascending by label where it was taken apart,
 * with its name, field data and all arrays of its points and cells.
 *
 * Errors: a mesh without its array of labels, blocks without points. An empty input gives no blocks.
 */
#ifndef vtkExplodeLabels_h
#define vtkExplodeLabels_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

class VTKLABELMESHFILTERS_EXPORT vtkExplodeLabels : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkExplodeLabels* New();
  vtkTypeMacro(vtkExplodeLabels, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// How far materials move, as a multiple of the distance of their centre from that of all (0.5). 0: not at all.
  vtkSetClampMacro(Factor, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Factor, double);
  ///@}

protected:
  vtkExplodeLabels() = default;
  ~vtkExplodeLabels() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  double Factor = 0.5;

  vtkExplodeLabels(const vtkExplodeLabels&) = delete;
  void operator=(const vtkExplodeLabels&) = delete;
};

#endif
