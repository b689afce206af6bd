// SPDX-License-Identifier: BSD-3-Clause
// labelmesh-fuzz [options] FIRST COUNT: meshes the volumes of the seeds FIRST, FIRST + 1, ... by every method.
//   --limit SECONDS   time for one mesh, after which the program gives up (60)
//   --write FILE.vti  writes the volume of FIRST and stops
//   --tetrahedra N    fills the materials of every Nth seed with tetrahedra (5; 0: of none)
//   --verbose         a line per mesh
//
// What has to hold:
//  - no crash, and an end within the time;
//  - a mesh, empty only with a warning that says why, or an error in words; an error only where a volume has
//    fewer than two samples along an axis or nothing but background;
//  - particle method: the shared mesh is closed, edge-manifold and oriented without duplicate, degenerate or
//    self-intersecting triangles, and each triangle's two labels are in the sets of its three points. Vertices where
//    a surface touches itself are counted, not refused: they are no edge and no area, and a voxel volume has them too,
//    where voxels touch at a corner. The surfaces of the materials are taken apart there: they have to be closed,
//    oriented, and manifold at edges and vertices;
//  - tetrahedra, packed and by TetGen in turn: what TetraFaults.h says, or a warning that says why there are none,
//    which is counted;
//  - grid method: closed and oriented, which is all that it promises (see vtkGridLabelMesh).
// Exit 0 when all of it held; 1 after naming each seed where it did not, 2 at a crash or a hang.
#include "FuzzVolume.h"
#include "TetraFaults.h"

#include "Core/MeshChecks.h"
#include "LabelMeshNames.h"
#include "MeshAdapter.h"

#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDelaunayLabelMesh.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkGridLabelMesh.h>
#include <vtkLabelMeshReport.h>
#include <vtkLabelMesher.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkOutputWindow.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTighten.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace
{
using namespace LabelMesh;

struct Options
{
  std::uint64_t First = 0;
  std::uint64_t Count = 0;
  unsigned Limit = 60;
  std::uint64_t Tetrahedra = 5;
  bool Verbose = false;
  std::string Write;
};

const std::array<const char*, 3> Methods = { "particle", "particle, paper's smoothing", "grid" };

// What runs now: for a signal handler, which may only copy bytes.
std::array<char, 256> Running{};

[[noreturn]] void GiveUp(int signal)
{
  const char* what = signal == SIGALRM ? "labelmesh-fuzz: no end: " : "labelmesh-fuzz: crash: ";
  ssize_t ignored = write(STDERR_FILENO, what, std::strlen(what));
  ignored = write(STDERR_FILENO, Running.data(), std::strlen(Running.data()));
  ignored = write(STDERR_FILENO, "\n", 1);
  static_cast<void>(ignored);
  _exit(2);
}

void WatchSignals()
{
  std::signal(SIGALRM, GiveUp);
#ifndef LABELMESH_SANITIZED // a sanitizer says more
  for (const int signal : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
  {
    std::signal(signal, GiveUp);
  }
#endif
}

/// Errors and warnings of a filter.
class Listener
{
public:
  explicit Listener(vtkAlgorithm* filter)
  {
    filter->AddObserver(vtkCommand::ErrorEvent, this, &Listener::OnError);
    filter->AddObserver(vtkCommand::WarningEvent, this, &Listener::OnWarning);
    // The executive adds that the filter failed, and prints it where nobody listens.
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Listener::OnError);
  }
  std::string Error, Warnings;

private:
  void OnError(vtkObject*, unsigned long, void* words) { this->Error += static_cast<const char*>(words); }
  void OnWarning(vtkObject*, unsigned long, void* words) { this->Warnings += static_cast<const char*>(words); }
};

/// Whether any voxel has a label of its own.
bool HasForeground(const FuzzVolume& volume)
{
  vtkDataArray* labels = volume.Image->GetPointData()->GetScalars();
  labels = labels ? labels : volume.Image->GetCellData()->GetScalars();
  for (vtkIdType n = 0; n < labels->GetNumberOfTuples(); ++n)
  {
    if (labels->GetComponent(n, 0) != static_cast<double>(volume.Background))
    {
      return true;
    }
  }
  return false;
}

vtkIdType Fact(vtkTable* table, const char* name)
{
  return static_cast<vtkIdType>(table->GetFieldData()->GetArray(name)->GetComponent(0, 0));
}

/// The sum of a column of counts.
vtkIdType Sum(vtkTable* table, const char* name)
{
  vtkDataArray* column = vtkDataArray::SafeDownCast(table->GetColumnByName(name));
  vtkIdType sum = 0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    sum += static_cast<vtkIdType>(column->GetComponent(row, 0));
  }
  return sum;
}

/// The closed surface of each material.
std::string FaultsOfSurfaces(vtkPartitionedDataSetCollection* surfaces, bool grid)
{
  for (unsigned block = 0; block < surfaces->GetNumberOfPartitionedDataSets(); ++block)
  {
    vtkPolyData* surface = vtkPolyData::SafeDownCast(surfaces->GetPartition(block, 0));
    if (!surface || surface->GetNumberOfCells() == 0)
    {
      continue;
    }
    vtkNew<vtkPolyData> triangles; // the points' Materials name labels that a block need not know
    triangles->ShallowCopy(surface);
    triangles->GetPointData()->Initialize();
    const InterfaceData data = ReadInterface(triangles);
    const auto label = static_cast<Label>(surface->GetFieldData()->GetArray(Names::Label)->GetComponent(0, 0));
    const MeshCheck check = CheckMesh(data.Points, data.Triangles, int(data.Materials.size()));
    for (std::size_t m = 0; m < data.Materials.size(); ++m)
    {
      const MaterialCheck& found = check.Materials[m];
      if (data.Materials[m].Label == label && !(found.Oriented() && (grid ? found.Closed() : found.Manifold())))
      {
        return "the surface of label " + std::to_string(label) + " has " + std::to_string(found.OpenEdges) +
          " open edges, " + std::to_string(found.NonManifoldEdges) + " and " +
          std::to_string(found.NonManifoldVertices) + " non-manifold edges and vertices, " +
          std::to_string(found.MisorientedEdges) + " turned over";
      }
    }
  }
  return "";
}

struct Tally
{
  std::map<std::string, int> Counts;
  int Failures = 0;
};

/// What is wrong with a mesh; empty when nothing is.
std::string FaultsOf(
  const FuzzVolume& volume, vtkPolyData* mesh, vtkPartitionedDataSetCollection* surfaces, bool grid, Tally& tally)
{
  vtkNew<vtkLabelMeshReport> report;
  Listener said(report);
  report->SetInputData(0, mesh);
  report->SetInputData(1, volume.Image);
  report->Update();
  if (!said.Error.empty())
  {
    return "the report fails: " + said.Error;
  }
  vtkTable* table = report->GetOutput();
  std::vector<const char*> counts = { "OpenEdges", "MisorientedEdges" };
  std::vector<const char*> facts;
  if (!grid)
  {
    counts.push_back("NonManifoldEdges");
    counts.push_back("SelfIntersections");
    facts = { "DuplicateTriangles", "DegenerateTriangles", "SameLabelTriangles", "WrongFaces",
      "SelfIntersectingPairs" };
    tally.Counts["certified"] += static_cast<int>(Fact(table, "Certified"));
    tally.Counts["with pinched vertices in the shared mesh"] += Sum(table, "NonManifoldVertices") > 0;
  }
  std::string faults;
  for (const char* name : counts)
  {
    const vtkIdType count = Sum(table, name);
    faults += count ? std::to_string(count) + " " + name + " " : "";
  }
  for (const char* name : facts)
  {
    const vtkIdType count = Fact(table, name);
    faults += count ? std::to_string(count) + " " + name + " " : "";
  }
  return faults + FaultsOfSurfaces(surfaces, grid);
}

/// What is wrong with the tetrahedra in a mesh; empty when nothing is, and where a warning says why there are none.
std::string FaultsOfFilling(vtkGridLabelMesh*, Tally&)
{
  return "";
}
std::string FaultsOfFilling(vtkLabelMesher* filter, Tally& tally)
{
  if (filter->GetTetrahedra() == vtkDelaunayLabelMesh::Off)
  {
    return "";
  }
  const bool filled = std::string(filter->GetTetrahedraFailure()).empty();
  ++tally.Counts[filled ? "filled with tetrahedra" : "that cannot be filled"];
  return filled ? FaultsOfTetrahedra(filter->GetTetrahedraOutput(), filter->GetOutput()) : "";
}

/// Meshes a volume and judges the result; empty when it is as it should be.
template <typename Filter>
std::string Mesh(Filter* filter, const FuzzVolume& volume, bool grid, Tally& tally)
{
  Listener said(filter);
  filter->SetBackgroundLabel(volume.Background);
  filter->SetInputData(volume.Image);
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  if (!said.Error.empty())
  {
    ++tally.Counts["refused"];
    if (mesh->GetNumberOfCells() > 0)
    {
      return "a mesh in spite of an error: " + said.Error;
    }
    const bool allowed = !volume.Solid || !HasForeground(volume);
    return allowed ? "" : "refused: " + said.Error;
  }
  if (mesh->GetNumberOfCells() == 0)
  {
    ++tally.Counts["empty"];
    return said.Warnings.empty() ? "an empty mesh without a word" : "";
  }
  ++tally.Counts["meshes"];
  return FaultsOf(volume, mesh, filter->GetSurfaces(), grid, tally) + FaultsOfFilling(filter, tally);
}

void Try(std::uint64_t seed, const FuzzVolume& volume, int method, const Options& options, Tally& tally)
{
  std::snprintf(Running.data(), Running.size(), "seed %llu, %s: %s", static_cast<unsigned long long>(seed),
    Methods[method], volume.Words.c_str());
  const auto begin = std::chrono::steady_clock::now();
  alarm(options.Limit);
  std::string fault;
  if (method == 2)
  {
    vtkNew<vtkGridLabelMesh> filter;
    fault = Mesh(filter.Get(), volume, true, tally);
  }
  else
  {
    vtkNew<vtkLabelMesher> filter;
    filter->SetSmoothing(method == 0 ? vtkTighten::VolumeKeeping : vtkTighten::Tightening);
    if (method == 0 && options.Tetrahedra > 0 && seed % options.Tetrahedra == 0)
    {
      const bool packed = seed / options.Tetrahedra % 2 == 0;
      filter->SetTetrahedra(packed ? vtkDelaunayLabelMesh::Packed : vtkDelaunayLabelMesh::TetGen);
    }
    fault = Mesh(filter.Get(), volume, false, tally);
  }
  alarm(0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (options.Verbose || !fault.empty())
  {
    std::printf("%s: %.2f s: %s\n", Running.data(), seconds, fault.empty() ? "right" : fault.c_str());
    std::fflush(stdout);
  }
  tally.Failures += !fault.empty();
}

int WriteVolume(const Options& options)
{
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetFileName(options.Write.c_str());
  writer->SetDataModeToBinary();
  const FuzzVolume volume = MakeFuzzVolume(options.First);
  writer->SetInputData(volume.Image);
  std::printf("%s\n", volume.Words.c_str());
  return writer->Write() ? 0 : 1;
}

bool Parse(int argc, char** argv, Options& options)
{
  std::vector<std::uint64_t> numbers;
  for (int n = 1; n < argc; ++n)
  {
    const std::string word = argv[n];
    if (word == "--verbose")
    {
      options.Verbose = true;
    }
    else if (word == "--limit" && n + 1 < argc)
    {
      options.Limit = static_cast<unsigned>(std::strtoul(argv[++n], nullptr, 10));
    }
    else if (word == "--tetrahedra" && n + 1 < argc)
    {
      options.Tetrahedra = std::strtoull(argv[++n], nullptr, 10);
    }
    else if (word == "--write" && n + 1 < argc)
    {
      options.Write = argv[++n];
    }
    else
    {
      numbers.push_back(std::strtoull(word.c_str(), nullptr, 10));
    }
  }
  if (numbers.size() != 2)
  {
    return false;
  }
  options.First = numbers[0];
  options.Count = numbers[1];
  return true;
}
}

int main(int argc, char** argv)
{
  Options options;
  if (!Parse(argc, argv, options))
  {
    std::fprintf(
      stderr, "labelmesh-fuzz [--limit SECONDS] [--tetrahedra N] [--verbose] [--write FILE.vti] FIRST COUNT\n");
    return 1;
  }
  if (!options.Write.empty())
  {
    return WriteVolume(options);
  }
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever(); // Listener hears it all the same
  WatchSignals();
  Tally tally;
  for (std::uint64_t seed = options.First; seed < options.First + options.Count; ++seed)
  {
    const FuzzVolume volume = MakeFuzzVolume(seed);
    for (int method = 0; method < int(Methods.size()); ++method)
    {
      Try(seed, volume, method, options, tally);
    }
  }
  std::printf("%llu volumes:", static_cast<unsigned long long>(options.Count));
  for (const auto& [what, count] : tally.Counts)
  {
    std::printf(" %d %s,", count, what.c_str());
  }
  std::printf(" %d failures\n", tally.Failures);
  return tally.Failures ? 1 : 0;
}
