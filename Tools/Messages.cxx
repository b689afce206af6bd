// SPDX-License-Identifier: BSD-3-Clause
#include "Messages.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <iostream>
#include <sstream>

namespace
{
class SilentWindow : public vtkOutputWindow
{
public:
  static SilentWindow* New();
  vtkTypeMacro(SilentWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}
};
vtkStandardNewMacro(SilentWindow);

/// The words behind "ERROR: In file, line 1\nvtkClass (0x1234): ".
std::string WordsOf(void* message)
{
  std::string text = message ? static_cast<const char*>(message) : "";
  const std::size_t object = text.find("): ");
  if (text.find(": In ") != std::string::npos && object != std::string::npos)
  {
    text = text.substr(object + 3);
  }
  return OneLine(text);
}
}

Messages::Messages(vtkAlgorithm* filter, bool printWarnings)
  : PrintWarnings(printWarnings)
{
  for (vtkObject* speaker : { static_cast<vtkObject*>(filter), static_cast<vtkObject*>(filter->GetExecutive()) })
  {
    this->Tags.emplace_back(speaker, speaker->AddObserver(vtkCommand::ErrorEvent, this, &Messages::OnError));
    this->Tags.emplace_back(speaker, speaker->AddObserver(vtkCommand::WarningEvent, this, &Messages::OnWarning));
  }
}

Messages::~Messages()
{
  for (const auto& tag : this->Tags)
  {
    tag.first->RemoveObserver(tag.second);
  }
}

void Messages::OnError(vtkObject*, unsigned long, void* message)
{
  if (this->Error.empty())
  {
    this->Error = WordsOf(message);
  }
}

void Messages::OnWarning(vtkObject*, unsigned long, void* message)
{
  if (this->PrintWarnings)
  {
    std::cerr << "labelmesh: warning: " << WordsOf(message) << "\n";
  }
}

void SilenceVtk()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<SilentWindow> window;
  vtkOutputWindow::SetInstance(window);
}

std::string OneLine(const std::string& text)
{
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;)
  {
    line += (line.empty() ? "" : " ") + word;
  }
  return line;
}
