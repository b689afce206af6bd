// SPDX-License-Identifier: BSD-3-Clause
// Progress, abort and warnings of the long computations.
#ifndef LabelMesh_Core_Monitor_h
#define LabelMesh_Core_Monitor_h

#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace LabelMesh
{
/// Thrown out of a computation when its monitor was told to stop.
struct Aborted : std::exception
{
  const char* what() const noexcept override { return "stopped on request"; }
};

/// What a computation tells its caller while it runs. Used by the calling thread only, between parallel loops.
class Monitor
{
public:
  /// Gets the fraction done and the name of the step, returns true to stop.
  using Callback = std::function<bool(double fraction, const std::string& text)>;

  Monitor() = default;
  explicit Monitor(Callback callback)
    : Report(std::move(callback))
  {
  }

  /// Reports progress within this monitor's share; throws Aborted when the caller wants to stop.
  void Step(double fraction, const std::string& text = {}) const
  {
    if (this->Report && this->Report(this->First + (this->Last - this->First) * fraction, text))
    {
      throw Aborted();
    }
  }
  /// A monitor for the part [first, last] of this one's work.
  Monitor Part(double first, double last) const
  {
    Monitor part = *this;
    part.First = this->First + (this->Last - this->First) * first;
    part.Last = this->First + (this->Last - this->First) * last;
    return part;
  }

private:
  Callback Report;
  double First = 0.0;
  double Last = 1.0;
};
}

#endif
