// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel.h"

#include <cstdlib>
#include <mutex>
#include <string>

namespace LabelMesh
{
namespace
{
/// Switches VTK's backend for as long as any filter of ours runs. vtkSMPTools keeps its backend per process and
/// vtkSMPTools::LocalScope is not safe when two threads enter it, so entries are counted.
class ThreadedBackend
{
public:
  ThreadedBackend()
  {
    const std::lock_guard<std::mutex> lock(Guard());
    if (Users()++ == 0)
    {
      Previous() = vtkSMPTools::GetBackend();
      if (Previous() == "Sequential" && !std::getenv("VTK_SMP_BACKEND_IN_USE"))
      {
        vtkSMPTools::SetBackend("STDThread");
      }
    }
  }
  ~ThreadedBackend()
  {
    const std::lock_guard<std::mutex> lock(Guard());
    if (--Users() == 0 && Previous() != vtkSMPTools::GetBackend())
    {
      vtkSMPTools::SetBackend(Previous().c_str());
    }
  }
  ThreadedBackend(const ThreadedBackend&) = delete;
  ThreadedBackend& operator=(const ThreadedBackend&) = delete;

private:
  static std::mutex& Guard()
  {
    static std::mutex guard;
    return guard;
  }
  static int& Users()
  {
    static int users = 0;
    return users;
  }
  static std::string& Previous()
  {
    static std::string previous;
    return previous;
  }
};
}

void WithThreads(const std::function<void()>& work)
{
  const ThreadedBackend threads;
  work();
}
}
