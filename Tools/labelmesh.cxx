// SPDX-License-Identifier: BSD-3-Clause
// labelmesh: meshes all material interfaces of a label volume. A plain VTK application.
#include "CommandLine.h"
#include "JsonReport.h"
#include "Messages.h"
#include "OutputFiles.h"
#include "ReadVolume.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDelaunayLabelMesh.h>
#include <vtkGridLabelMesh.h>
#include <vtkImageData.h>
#include <vtkLabelMeshReport.h>
#include <vtkLabelMesher.h>
#include <vtkLabelSplit.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkTighten.h>
#include <vtkUnstructuredGrid.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>

namespace
{
[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::runtime_error(sentence);
}

volatile std::sig_atomic_t StopRequested = 0; // set by a signal; nothing else can be reached from there

/// A first signal stops the filter that runs, so that nothing half done stays behind; a second one kills.
void StopOnSignals()
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    std::signal(signal,
      [](int number)
      {
        StopRequested = 1;
        std::signal(number, SIG_DFL);
      });
  }
}

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The array of labels: the active scalars, or else the first array with one component.
struct LabelArray
{
  vtkDataArray* Array = nullptr;
  int Association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
};

LabelArray FindLabels(vtkImageData* image)
{
  const std::pair<vtkDataSetAttributes*, int> places[] = { { image->GetPointData(),
                                                             vtkDataObject::FIELD_ASSOCIATION_POINTS },
    { image->GetCellData(), vtkDataObject::FIELD_ASSOCIATION_CELLS } };
  for (const auto& place : places)
  {
    if (vtkDataArray* scalars = place.first->GetScalars())
    {
      return { scalars, place.second };
    }
  }
  for (const auto& place : places)
  {
    for (int a = 0; a < place.first->GetNumberOfArrays(); ++a)
    {
      vtkDataArray* array = place.first->GetArray(a);
      if (array && array->GetNumberOfComponents() == 1 && array->GetName())
      {
        return { array, place.second };
      }
    }
  }
  return {};
}

/// The labels that occur. What the filters would refuse is refused here, before any work is done.
std::set<long long> LabelsOf(vtkImageData* image, const LabelArray& labels)
{
  int dims[3];
  image->GetDimensions(dims);
  if (std::min({ dims[0], dims[1], dims[2] }) < 2)
  {
    Fail("it has " + std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " + std::to_string(dims[2]) +
      " samples, expected a three-dimensional volume");
  }
  if (!labels.Array)
  {
    Fail("it has no array of labels");
  }
  if (labels.Array->GetNumberOfComponents() != 1)
  {
    Fail("it has " + std::to_string(labels.Array->GetNumberOfComponents()) +
      " numbers per voxel, expected one label per voxel");
  }
  std::set<long long> found;
  double last = std::nan("");
  for (vtkIdType i = 0; i < labels.Array->GetNumberOfTuples(); ++i)
  {
    const double value = labels.Array->GetComponent(i, 0);
    if (value == last)
    {
      continue;
    }
    if (!(std::abs(value) < 9.2e18) || value != std::floor(value))
    {
      Fail("it holds " + std::to_string(value) + " where an integer label is expected");
    }
    found.insert(static_cast<long long>(value));
    last = value;
  }
  return found;
}

std::string Join(const std::set<long long>& labels)
{
  constexpr std::size_t most = 20;
  std::string text;
  std::size_t n = 0;
  for (const long long label : labels)
  {
    if (n++ == most)
    {
      return text + ", ...";
    }
    text += (text.empty() ? "" : ", ") + std::to_string(label);
  }
  return text;
}

/// The labels to mesh, ascending, without the background.
std::vector<long long> LabelsToMesh(const CommandLine& line, const std::set<long long>& found)
{
  const auto require = [&](long long label, const char* option)
  {
    if (found.count(label) == 0)
    {
      Fail(std::string(option) + " names label " + std::to_string(label) + ", which '" + line.Input +
        "' does not have; it has " + Join(found));
    }
  };
  std::set<long long> labels = found;
  if (!line.Labels.empty())
  {
    std::for_each(line.Labels.begin(), line.Labels.end(), [&](long long label) { require(label, "--labels"); });
    labels = std::set<long long>(line.Labels.begin(), line.Labels.end());
  }
  for (const auto& material : line.Materials)
  {
    require(material.first, "--material");
  }
  for (const auto& own : line.InterfaceLengths)
  {
    for (const long long label : own.first)
    {
      if (label != line.Background)
      {
        require(label, "--interface");
      }
    }
  }
  labels.erase(line.Background);
  if (labels.empty())
  {
    Fail("there is nothing to mesh in '" + line.Input + "': every voxel has the background label " +
      std::to_string(line.Background));
  }
  return std::vector<long long>(labels.begin(), labels.end());
}

/// Shows how far a filter is, on standard error, and stops it when the user wants to.
class Progress
{
public:
  Progress(vtkAlgorithm* filter, bool quiet)
    : Quiet(quiet)
    , Terminal(isatty(STDERR_FILENO) != 0)
  {
    filter->AddObserver(vtkCommand::ProgressEvent, this, &Progress::Show);
  }
  ~Progress()
  {
    if (this->Shown)
    {
      std::fputs("\r\033[K", stderr);
    }
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

private:
  void Show(vtkObject* caller, unsigned long, void*)
  {
    auto* filter = static_cast<vtkAlgorithm*>(caller);
    if (StopRequested)
    {
      filter->SetAbortExecute(1);
    }
    const std::string text = filter->GetProgressText() ? filter->GetProgressText() : "";
    const std::string stage = text.substr(0, text.find(':'));
    const int percent = static_cast<int>(100 * filter->GetProgress());
    if (this->Quiet || stage.empty())
    {
      return;
    }
    if (this->Terminal)
    {
      std::fprintf(stderr, "\r%3d %% %.60s\033[K", percent, text.c_str());
      std::fflush(stderr);
      this->Shown = true;
    }
    else if (stage != this->Stage)
    {
      std::fprintf(stderr, "%3d %% %s\n", percent, stage.c_str());
    }
    this->Stage = stage;
  }

  bool Quiet;
  bool Terminal;
  bool Shown = false;
  std::string Stage;
};

void Apply(const CommandLine& line, const std::map<long long, LabelStyle>& styles, vtkLabelMesher* mesher)
{
  for (const auto& [label, style] : styles)
  {
    mesher->SetMaterialName(label, style.Name.c_str());
    if (style.Color)
    {
      mesher->SetMaterialColor(label, (*style.Color)[0], (*style.Color)[1], (*style.Color)[2]);
    }
  }
  const auto set = [mesher](const std::optional<double>& value, void (vtkLabelMesher::*setter)(double))
  {
    if (value)
    {
      (mesher->*setter)(*value);
    }
  };
  mesher->SetBorder(line.FlatBorder ? vtkLabelSplit::Flat : vtkLabelSplit::Closed);
  mesher->SetSmoothing(line.Tightening ? vtkTighten::Tightening : vtkTighten::VolumeKeeping);
  set(line.Radius, &vtkLabelMesher::SetRadius);
  set(line.Epsilon, &vtkLabelMesher::SetEpsilon);
  set(line.MinimumLength, &vtkLabelMesher::SetMinimumLength);
  set(line.MaximumLength, &vtkLabelMesher::SetMaximumLength);
  set(line.MaximumDeviation, &vtkLabelMesher::SetMaximumDeviation);
  set(line.Gradation, &vtkLabelMesher::SetGradation);
  set(line.MemoryLimit, &vtkLabelMesher::SetMemoryLimit);
  mesher->SetMinimumComponentSize(line.MinimumComponent);
  mesher->SetMaximumUpsampling(line.MaximumUpsampling);
  mesher->SetTargetTriangles(line.Triangles);
  if (!line.Tets.empty())
  {
    mesher->SetTetrahedra(line.TetsByTetGen ? vtkDelaunayLabelMesh::TetGen : vtkDelaunayLabelMesh::Packed);
    mesher->SetRefinementRounds(line.TetRefinementRounds);
    mesher->SetSlideSurface(line.TetSlide);
    mesher->SetTetraImprovePasses(line.TetImprovePasses.value_or(mesher->GetTetraImprovePasses()));
    set(line.VolumeGradation, &vtkLabelMesher::SetVolumeGradation);
    set(line.VolumeMaximumLength, &vtkLabelMesher::SetVolumeMaximumLength);
  }
  for (const auto& [labels, length] : line.InterfaceLengths)
  {
    mesher->SetInterfaceMaximumLength(labels[0], labels[1], length);
  }
  for (const auto& [label, material] : line.Materials)
  {
    const auto setOwn = [&, label = label](
                          const std::optional<double>& value, void (vtkLabelMesher::*setter)(vtkIdType, double))
    {
      if (value)
      {
        (mesher->*setter)(label, *value);
      }
    };
    setOwn(material.Radius, &vtkLabelMesher::SetMaterialRadius);
    setOwn(material.OpeningRadius, &vtkLabelMesher::SetMaterialOpeningRadius);
    setOwn(material.ClosingRadius, &vtkLabelMesher::SetMaterialClosingRadius);
    setOwn(material.MaximumLength, &vtkLabelMesher::SetMaterialMaximumLength);
    if (material.Name)
    {
      mesher->SetMaterialName(label, material.Name->c_str());
    }
    if (material.Color)
    {
      mesher->SetMaterialColor(label, (*material.Color)[0], (*material.Color)[1], (*material.Color)[2]);
    }
  }
}

/// Runs one filter over the volume; what it makes is in its output ports.
template <typename Filter>
void Run(Filter* filter, const CommandLine& line, vtkImageData* volume, const LabelArray& labels)
{
  for (const long long label : line.Labels)
  {
    filter->AddLabel(label);
  }
  filter->SetBackgroundLabel(line.Background);
  filter->SetInputData(volume);
  filter->SetInputArrayToProcess(0, 0, 0, labels.Association, labels.Array->GetName());
  Messages messages(filter, !line.Quiet);
  {
    const Progress progress(filter, line.Quiet);
    filter->Update();
  }
  if (StopRequested)
  {
    Fail("stopped; nothing was written");
  }
  if (!messages.FirstError().empty())
  {
    Fail(messages.FirstError());
  }
  if (filter->GetOutput()->GetNumberOfCells() == 0)
  {
    Fail("no triangle is left: smoothing took every material away; try a smaller --radius, or check the labels");
  }
}

/// Threads that the filters may use.
int UseThreads(int asked)
{
  // ParaView's VTK starts with one thread only.
  if (std::string(vtkSMPTools::GetBackend()) == "Sequential" && !std::getenv("VTK_SMP_BACKEND_IN_USE"))
  {
    vtkSMPTools::SetBackend("STDThread");
  }
  vtkSMPTools::Initialize(asked);
  return vtkSMPTools::GetEstimatedNumberOfThreads();
}

/// Checks the mesh, when anybody wants to know, and writes what was asked for; returns the last words for the user.
std::vector<std::string> Report(const CommandLine& line, ReportInput& input, OutputFiles& files)
{
  if (line.Quiet && line.Report.empty() && line.ErrorMap.empty())
  {
    return {};
  }
  const double begin = Now();
  input.ErrorMap = !line.ErrorMap.empty();
  const vtkSmartPointer<vtkLabelMeshReport> report = CheckMesh(input);
  input.Seconds.emplace_back("Report", Now() - begin);
  if (!line.ErrorMap.empty())
  {
    files.WriteMesh(line.ErrorMap, report->GetErrorMapOutput());
  }
  if (!line.Report.empty())
  {
    files.WriteText(line.Report, JsonReport(input, report));
  }
  return line.Quiet ? std::vector<std::string>() : Verdict(input, report);
}

void MeshVolume(const CommandLine& line)
{
  const double start = Now();
  OutputFiles files;
  for (const std::string& file : { line.Mesh, line.Surfaces, line.Particles, line.Tets, line.Report, line.ErrorMap })
  {
    if (!file.empty())
    {
      files.Expect(file);
    }
  }
  ReportInput report;
  report.Threads = UseThreads(line.Threads);
  std::map<long long, LabelStyle> styles; // --material comes before them
  const vtkSmartPointer<vtkImageData> volume = ReadVolume(line.Input, styles);
  const LabelArray labels = FindLabels(volume);
  if (labels.Array && !labels.Array->GetName())
  {
    labels.Array->SetName("Labels");
  }
  try
  {
    report.Labels = LabelsToMesh(line, LabelsOf(volume, labels));
  }
  catch (const std::runtime_error& problem)
  {
    const std::string sentence = problem.what();
    Fail(sentence.compare(0, 3, "it ") == 0 ? "cannot mesh '" + line.Input + "': " + sentence : sentence);
  }
  report.Seconds.emplace_back("Read", Now() - start);
  StopOnSignals();

  vtkNew<vtkLabelMesher> mesher;
  vtkNew<vtkGridLabelMesh> grid;
  std::string unfilled; // why there are no tetrahedra
  if (line.Grid)
  {
    const double begin = Now();
    grid->SetTargetTriangles(line.Triangles);
    Run(grid.Get(), line, volume, labels);
    report.Seconds.emplace_back("GridLabelMesh", Now() - begin);
  }
  else
  {
    Apply(line, styles, mesher);
    Run(mesher.Get(), line, volume, labels);
    for (int s = 0; s < mesher->GetNumberOfStages(); ++s)
    {
      report.Seconds.emplace_back(mesher->GetStageName(s), mesher->GetStageSeconds(mesher->GetStageName(s)));
    }
    report.Particles = mesher->GetParticles();
    report.Tightened = mesher->GetLabelImage();
    unfilled = line.Tets.empty() ? "" : mesher->GetTetrahedraFailure();
    report.Tetrahedra = line.Tets.empty() || !unfilled.empty() ? nullptr : mesher->GetTetrahedraOutput();
  }
  report.Mesh = line.Grid ? grid->GetOutput() : mesher->GetOutput();
  report.Surfaces = line.Grid ? grid->GetSurfaces() : mesher->GetSurfaces();

  const double writing = Now();
  if (!line.Mesh.empty())
  {
    files.WriteMesh(line.Mesh, report.Mesh);
  }
  if (!line.Surfaces.empty())
  {
    files.WriteSurfaces(line.Surfaces, report.Surfaces);
  }
  if (!unfilled.empty())
  {
    files.Forget(line.Tets);
  }
  else if (!line.Tets.empty())
  {
    files.WriteTetrahedra(line.Tets, mesher->GetTetrahedraOutput());
  }
  if (!line.Particles.empty())
  {
    files.WriteMesh(line.Particles, report.Particles);
  }
  report.Seconds.emplace_back("Write", Now() - writing);
  report.Seconds.emplace_back("total", Now() - start);
  report.Input = line.Input;
  report.Method = line.Grid ? "grid" : "particle";
  report.Volume = volume;
  report.LabelAssociation = labels.Association;
  report.LabelArray = labels.Array->GetName();
  const std::vector<std::string> verdict = Report(line, report, files);
  if (StopRequested)
  {
    Fail("stopped; nothing was written");
  }
  files.Commit();
  for (const std::string& sentence : verdict)
  {
    std::cerr << "labelmesh: " << sentence << "\n";
  }
  if (!unfilled.empty())
  {
    Fail("'" + line.Tets + "' was not written, all other files were: " + unfilled);
  }
}
}

int main(int argc, char** argv)
{
  try
  {
    const CommandLine line = ParseCommandLine(argc, argv);
    if (line.Help)
    {
      std::cout << HelpText();
      return 0;
    }
    if (line.Version)
    {
      std::cout << "labelmesh " << LABELMESH_VERSION << "\n";
      return 0;
    }
    SilenceVtk();
    MeshVolume(line);
    return 0;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "labelmesh: there is not enough memory for this volume\n";
  }
  catch (const std::exception& problem)
  {
    std::cerr << "labelmesh: " << OneLine(problem.what()) << "\n";
  }
  return 1;
}
