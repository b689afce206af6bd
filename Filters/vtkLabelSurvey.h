// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLabelSurvey
 * @brief   Which labels a volume holds, how many voxels each has, and which of them touch; nothing is meshed.
 *
 * Input port 0 (vtkImageData): labels, SetInputArrayToProcess(0, ...), by default the active point or cell scalars; see
 * vtkLabelSplit.
 *
 * Output port 0 (vtkTable), a row per label that occurs, ascending:
 *  - "Label" (int64), "Name" (string: the name that vtkLabelSplit gives it by default), "Voxels" (int64), "Color"
 *    (double x 3, 0 to 1: likewise)
 * Output port 1 (vtkTable), a row per pair of labels whose voxels share faces, ascending:
 *  - "LabelA", "LabelB" (int64, the smaller first), "VoxelFaces" (int64)
 * On a server of several processes the first one has the tables, the others empty ones.
 * Space outside the volume belongs to the background, which so touches all labels at the border.
 *
 * One pass over the voxels, in parallel, and two bytes of memory for each. What it finds is small, whatever the volume:
 * a user interface asks a server for it, by the methods that begin with Get; they are null before the filter has run.
 *
 * Errors: as vtkLabelSplit's for the label image, but see Quiet. An empty image gives empty tables.
 */
#ifndef vtkLabelSurvey_h
#define vtkLabelSurvey_h

#include "vtkLabelMeshFiltersModule.h"
#include "vtkTableAlgorithm.h"

#include <vtkSmartPointer.h> // for the columns

#include <map>    // for the columns
#include <string> // for what is wrong

class vtkAbstractArray;

class VTKLABELMESHFILTERS_EXPORT vtkLabelSurvey : public vtkTableAlgorithm
{
public:
  static vtkLabelSurvey* New();
  vtkTypeMacro(vtkLabelSurvey, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The label of the background, which space outside the volume has too. Default 0.
  vtkSetMacro(BackgroundLabel, vtkIdType);
  vtkGetMacro(BackgroundLabel, vtkIdType);
  ///@}

  ///@{
  /// Whether a volume without labels is no error: the tables are empty then, and GetTrouble() says why. For those who
  /// only look, such as a user interface. Default off.
  vtkSetMacro(Quiet, bool);
  vtkGetMacro(Quiet, bool);
  vtkBooleanMacro(Quiet, bool);
  /// What is wrong with the volume, in a sentence; empty when nothing is. Known after the filter has run.
  const char* GetTrouble() const { return this->Trouble.c_str(); }
  ///@}

  ///@{
  /// The columns of port 0; numbers as double, since ParaView's server hands on no 64-bit integers.
  vtkAbstractArray* GetLabels();
  vtkAbstractArray* GetNames();
  vtkAbstractArray* GetVoxels();
  vtkAbstractArray* GetColors();
  ///@}

  ///@{
  /// The columns of port 1, likewise.
  vtkAbstractArray* GetPairLabelsA();
  vtkAbstractArray* GetPairLabelsB();
  vtkAbstractArray* GetPairVoxelFaces();
  ///@}

protected:
  vtkLabelSurvey();
  ~vtkLabelSurvey() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkIdType BackgroundLabel = 0;
  bool Quiet = false;
  std::string Trouble;

private:
  vtkLabelSurvey(const vtkLabelSurvey&) = delete;
  void operator=(const vtkLabelSurvey&) = delete;

  void KeepColumns();
  vtkAbstractArray* Column(const char* name) const;

  std::map<std::string, vtkSmartPointer<vtkAbstractArray>> Columns; ///< of both ports, by name
};

#endif
