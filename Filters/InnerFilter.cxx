// SPDX-License-Identifier: BSD-3-Clause
#include "InnerFilter.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkSetGet.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace LabelMesh
{
namespace
{
/// Listens to a filter and its executive for as long as it lives.
class Listener
{
public:
  Listener(vtkAlgorithm* inner, vtkAlgorithm* outer, const Monitor& monitor, const std::string& stage)
    : Inner(inner)
    , Outer(outer)
    , Progress(monitor)
    , Stage(stage)
  {
    this->Observe(inner, vtkCommand::ProgressEvent, &Listener::OnProgress);
    for (vtkObject* speaker : { static_cast<vtkObject*>(inner), static_cast<vtkObject*>(inner->GetExecutive()) })
    {
      this->Observe(speaker, vtkCommand::ErrorEvent, &Listener::OnError);
      this->Observe(speaker, vtkCommand::WarningEvent, &Listener::OnWarning);
    }
  }
  ~Listener()
  {
    for (const auto& tag : this->Tags)
    {
      tag.first->RemoveObserver(tag.second);
    }
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  bool Stopped = false;
  std::string Error;

private:
  using Handler = void (Listener::*)(vtkObject*, unsigned long, void*);

  void Observe(vtkObject* speaker, unsigned long event, Handler handler)
  {
    this->Tags.emplace_back(speaker, speaker->AddObserver(event, this, handler));
  }
  void OnProgress(vtkObject*, unsigned long, void*)
  {
    const char* text = this->Inner->GetProgressText();
    try
    {
      this->Progress.Step(this->Inner->GetProgress(), text && *text ? this->Stage + ": " + text : this->Stage);
    }
    catch (const Aborted&)
    {
      // An exception must not pass through VTK's own code, which would leave the pipeline half updated.
      this->Stopped = true;
      this->Inner->SetAbortExecute(1);
    }
  }
  void OnError(vtkObject*, unsigned long, void* message)
  {
    if (this->Error.empty())
    {
      this->Error = SentenceOf(static_cast<const char*>(message)); // what follows is a consequence
    }
  }
  void OnWarning(vtkObject*, unsigned long, void* message)
  {
    vtkWarningWithObjectMacro(this->Outer, << SentenceOf(static_cast<const char*>(message)));
  }

  vtkAlgorithm* Inner;
  vtkAlgorithm* Outer;
  Monitor Progress;
  std::string Stage;
  std::vector<std::pair<vtkObject*, unsigned long>> Tags;
};
}

void UpdateInner(vtkAlgorithm* inner, vtkAlgorithm* outer, const Monitor& monitor, const std::string& stage)
{
  monitor.Step(0.0, stage);
  Listener listener(inner, outer, monitor, stage);
  inner->SetAbortExecute(0);
  inner->Update();
  if (listener.Stopped || !listener.Error.empty())
  {
    inner->Modified();
  }
  if (listener.Stopped)
  {
    throw Aborted();
  }
  if (!listener.Error.empty())
  {
    throw std::runtime_error(listener.Error);
  }
  monitor.Step(1.0);
}

std::string SentenceOf(const char* vtkMessage)
{
  std::string text = vtkMessage ? vtkMessage : "";
  const std::size_t object = text.find("): ");
  if (text.find(": In ") != std::string::npos && object != std::string::npos)
  {
    text = text.substr(object + 3);
  }
  const std::size_t first = text.find_first_not_of(" \n\r\t");
  const std::size_t last = text.find_last_not_of(" \n\r\t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}
}
