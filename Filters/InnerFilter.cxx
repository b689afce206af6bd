// SPDX-License-Identifier: BSD-3-Clause
#include "InnerFilter.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkSetGet.h>

#include <memory>
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
  Listener(const InnerStage& stage, vtkAlgorithm* outer, const Monitor& monitor)
    : Inner(stage.Filter)
    , Outer(outer)
    , Progress(monitor)
    , Stage(stage.Name)
  {
    vtkAlgorithm* const inner = this->Inner;
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

void UpdateInner(const std::vector<InnerStage>& chain, vtkAlgorithm* outer, const Piece& piece, const Monitor& monitor)
{
  double total = 0.0, done = 0.0;
  for (const InnerStage& stage : chain)
  {
    total += stage.Weight;
  }
  monitor.Step(0.0, chain.front().Name);
  std::vector<std::unique_ptr<Listener>> listeners;
  for (const InnerStage& stage : chain)
  {
    const Monitor part = monitor.Part(done / total, (done + stage.Weight) / total);
    listeners.push_back(std::make_unique<Listener>(stage, outer, part));
    stage.Filter->SetAbortExecute(0);
    done += stage.Weight;
  }
  chain.back().Filter->UpdatePiece(piece.Number, piece.Count, 0);
  // What a filter says that had to work on what a failed one left is of no interest.
  bool stopped = false;
  std::string error;
  for (const auto& listener : listeners)
  {
    stopped = stopped || listener->Stopped;
    error = error.empty() ? listener->Error : error;
  }
  for (const InnerStage& stage : chain)
  {
    if (stopped || !error.empty())
    {
      stage.Filter->Modified(); // all of them: one that failed may have taken over what those before it had made
    }
  }
  if (stopped)
  {
    throw Aborted();
  }
  if (!error.empty())
  {
    throw std::runtime_error(error);
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
