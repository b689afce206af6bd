// SPDX-License-Identifier: BSD-3-Clause
// What every filter of LabelMesh does around its computation.
#ifndef FilterSupport_h
#define FilterSupport_h

#include "Core/Monitor.h"

#include <functional>

class vtkAlgorithm;

namespace LabelMesh
{
/// Progress and abort of a filter as a monitor.
Monitor MonitorOf(vtkAlgorithm* filter);

/// Runs the work of a RequestData with threads switched on (see WithThreads).
/// An exception becomes the filter's error (its what() is the sentence for the user); an abort or an error leaves every
/// output initialised (empty). Returns what RequestData returns: 1, also after an abort, or 0 after an error.
int RunStage(vtkAlgorithm* filter, const std::function<void(const Monitor&)>& work);
}

#endif
