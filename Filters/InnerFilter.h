// SPDX-License-Identifier: BSD-3-Clause
// Running a VTK filter inside another one.
#ifndef InnerFilter_h
#define InnerFilter_h

#include "Core/Monitor.h"

#include <string>

class vtkAlgorithm;

namespace LabelMesh
{
/// Updates `inner` (all its ports) within a filter's RequestData: its progress goes to the monitor under the name
/// `stage`, a stop asked of the monitor stops it and throws Aborted, its warnings become `outer`'s, and its errors
/// become one std::runtime_error with the words alone. A stopped or failed filter is marked as modified, so that the
/// next update runs it again.
void UpdateInner(vtkAlgorithm* inner, vtkAlgorithm* outer, const Monitor& monitor, const std::string& stage);

/// The sentence in what VTK hands to observers of its errors ("ERROR: In file, line 1\nvtkClass (0x1): the sentence").
std::string SentenceOf(const char* vtkMessage);
}

#endif
