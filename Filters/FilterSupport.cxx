// SPDX-License-Identifier: BSD-3-Clause
#include "FilterSupport.h"

#include "Core/Parallel.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkSetGet.h>
#include <vtkVersionMacros.h>

#include <exception>
#include <new>

namespace LabelMesh
{
namespace
{
bool WantsToStop(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220901)
  return filter->CheckAbort(); // also hears of an abort of the filters before it
#else
  return filter->GetAbortExecute() != 0;
#endif
}

void InitializeOutputs(vtkAlgorithm* filter)
{
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    if (vtkDataObject* output = filter->GetOutputDataObject(port))
    {
      output->Initialize();
    }
  }
}
}

Monitor MonitorOf(vtkAlgorithm* filter)
{
  return Monitor(
    [filter](double fraction, const std::string& text)
    {
      if (!text.empty())
      {
        filter->SetProgressText(text.c_str());
      }
      filter->UpdateProgress(fraction);
      return WantsToStop(filter);
    });
}

int RunStage(vtkAlgorithm* filter, const std::function<void(const Monitor&)>& work)
{
  try
  {
    const Monitor monitor = MonitorOf(filter);
    WithThreads([&]() { work(monitor); });
    return 1;
  }
  catch (const Aborted&)
  {
    InitializeOutputs(filter);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorWithObjectMacro(filter,
      "There is not enough memory for this volume. Crop it, mesh fewer labels, or lower the resampling factor.");
  }
  catch (const std::exception& problem)
  {
    vtkErrorWithObjectMacro(filter, << problem.what());
  }
  InitializeOutputs(filter);
  return 0;
}
}
