// SPDX-License-Identifier: BSD-3-Clause
// Filters on a server of several processes, each of which is asked for one piece of every output. A mesh needs the
// whole volume, so the process that is asked for the first piece does all the work. The others give outputs of the same
// structure, with the same blocks, names and field data, and nothing in them. No process waits for another one.
#ifndef ServerPieces_h
#define ServerPieces_h

class vtkImageData;
class vtkInformation;
class vtkInformationVector;

namespace LabelMesh
{
struct Piece
{
  int Number = 0;
  int Count = 1;

  bool IsFirst() const { return this->Number <= 0; }
};

/// The piece that a filter is asked for, by any request: the only one, unless there are several processes.
Piece RequestedPiece(vtkInformation* request, vtkInformationVector* outputVector);

/// For FillOutputPortInformation: everything is in this port's first piece.
void PromiseFirstPiece(vtkInformation* portInfo);

/// For RequestUpdateExtent: asks an input for all that it has, in every process, since the others need its structure.
void RequestAll(vtkInformation* inInfo);
/// The same of every connection of every input port; except that what promises to have everything in its first piece is
/// asked for the pieces that the filter is asked for: it does not run again when others ask for them too.
void RequestAllPromised(vtkInformationVector** inputVector, int ports);

/// The input information of the first filter upstream that is not one which ParaView puts behind every filter: those do
/// not hand on what filters say about their outputs.
vtkInformation* BehindPostFilters(vtkInformation* inInfo);

/// Throws std::invalid_argument when the source of an image gave less than its whole extent, although asked for it.
void RequireWhole(vtkInformation* inInfo, vtkImageData* image);
}

#endif
