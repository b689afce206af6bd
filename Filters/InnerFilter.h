// SPDX-License-Identifier: BSD-3-Clause
// Running a VTK filter inside another one.
#ifndef InnerFilter_h
#define InnerFilter_h

#include "Core/Monitor.h"
#include "ServerPieces.h"

#include <string>
#include <vector>

class vtkAlgorithm;

namespace LabelMesh
{
/// A filter inside another one.
struct InnerStage
{
  vtkAlgorithm* Filter = nullptr;
  std::string Name;    ///< for progress texts
  double Weight = 1.0; ///< its share of the time, in any unit
};

/// Updates a piece of the last filter of a chain (all its ports) within a filter's RequestData, and so those before it
/// whose output it needs and does not have: their progress goes to the monitor under their names, a stop asked of the
/// monitor stops them and throws Aborted, their warnings become `outer`'s, and the first error becomes a
/// std::runtime_error with the words alone. After a stop or an error the whole chain is marked as modified, so that the
/// next update runs it again.
void UpdateInner(const std::vector<InnerStage>& chain, vtkAlgorithm* outer, const Piece& piece, const Monitor& monitor);

/// The sentence in what VTK hands to observers of its errors ("ERROR: In file, line 1\nvtkClass (0x1): the sentence").
std::string SentenceOf(const char* vtkMessage);
}

#endif
