// SPDX-License-Identifier: BSD-3-Clause
// VTK's errors and warnings as plain sentences.
#ifndef Messages_h
#define Messages_h

#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkObject;

/// Keeps what a filter and its executive say, for as long as it lives, instead of printing it.
class Messages
{
public:
  /// Warnings go to standard error as lines of labelmesh when `printWarnings`.
  explicit Messages(vtkAlgorithm* filter, bool printWarnings = false);
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  /// What went wrong first; the rest is its consequence. Empty when nothing did.
  const std::string& FirstError() const { return this->Error; }

private:
  void OnError(vtkObject*, unsigned long, void* message);
  void OnWarning(vtkObject*, unsigned long, void* message);

  std::string Error;
  bool PrintWarnings;
  std::vector<std::pair<vtkObject*, unsigned long>> Tags;
};

/// VTK's own output goes nowhere from here on: what matters is caught by Messages.
void SilenceVtk();

/// Without line breaks and repeated blanks.
std::string OneLine(const std::string& text);

#endif
