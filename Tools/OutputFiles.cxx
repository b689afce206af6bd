// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFiles.h"

#include "Messages.h"

#include <vtkAbaqusLabelMeshWriter.h>
#include <vtkGmshLabelMeshWriter.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLWriterBase.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace
{
namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::runtime_error(sentence);
}

fs::path FolderOf(const std::string& file)
{
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// Writers are set to binary data within the elements: VTK 9.1 and 9.2 cannot read appended data back with the Expat
/// that Debian 12 has since its security updates. Zlib at its fastest: the default level takes almost three times as
/// long for 3 % smaller meshes, and fewer programs than VTK know its other compressors.
void SetFormat(vtkXMLWriterBase* writer)
{
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
}

/// What the file of an XML writer holds. VTK's writers crash when they meet a full disk, so they write into memory.
template <typename Writer>
std::string BytesOf(vtkDataObject* mesh, const std::string& file)
{
  vtkNew<Writer> writer;
  SetFormat(writer);
  Messages messages(writer);
  writer->SetInputData(mesh);
  writer->WriteToOutputStringOn();
  const int written = writer->Write();
  std::string bytes = writer->GetOutputString();
  if (!written || writer->GetErrorCode() != 0 || !messages.FirstError().empty() || bytes.empty())
  {
    Fail("cannot write '" + file + "'" + (messages.FirstError().empty() ? "" : ": " + messages.FirstError()));
  }
  return bytes;
}

/// Writes a file whole, or fails; `file` is what the user calls it.
void WriteBytes(const fs::path& path, const std::string& bytes, const std::string& file)
{
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream)
  {
    Fail("cannot write '" + file + "': " + std::strerror(errno));
  }
}

/// A block's file as the collection's writer calls it, in a folder with the collection's name.
fs::path BlockFile(const fs::path& folder, unsigned block)
{
  return folder / (folder.filename().string() + "_" + std::to_string(block) + "_0.vtp");
}

/// The collection with a point in the place of each mesh.
vtkSmartPointer<vtkPartitionedDataSetCollection> Placeholders(vtkPartitionedDataSetCollection* surfaces)
{
  auto places = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  places->ShallowCopy(surfaces);
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  for (unsigned block = 0; block < places->GetNumberOfPartitionedDataSets(); ++block)
  {
    vtkNew<vtkPolyData> place;
    place->SetPoints(points);
    vtkNew<vtkPartitionedDataSet> partitions;
    partitions->SetPartition(0, place);
    vtkNew<vtkInformation> names;
    if (surfaces->HasMetaData(block))
    {
      names->Copy(surfaces->GetMetaData(block), 1);
    }
    places->SetPartitionedDataSet(block, partitions);
    places->GetMetaData(block)->Copy(names, 1);
  }
  return places;
}

void Move(const fs::path& from, const fs::path& to, const std::string& file)
{
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
  {
    Fail("cannot write '" + file + "': " + error.message());
  }
}

/// True for the files that the writer of collections puts beside "name.vtpc": name_0_0.vtp, ...
bool IsBlockOf(const std::string& name, const fs::path& path)
{
  const std::string file = path.filename().string();
  return path.extension() == ".vtp" && file.compare(0, name.size() + 1, name + "_") == 0 &&
    path.stem().string().find_first_not_of("0123456789_", name.size()) == std::string::npos;
}

/// Brings the blocks of a collection to their folder, which may hold other files that are none of our business.
void MoveBlocks(const fs::path& from, const fs::path& to, const std::string& file)
{
  std::error_code error;
  fs::create_directory(to, error);
  if (!fs::is_directory(to))
  {
    Fail("cannot make the folder '" + to.string() + "' for the blocks of '" + file + "'");
  }
  for (const auto& old : fs::directory_iterator(to))
  {
    if (IsBlockOf(to.filename().string(), old.path()) && !fs::exists(from / old.path().filename()))
    {
      fs::remove(old.path(), error); // a block of an earlier run with more materials
    }
  }
  for (const auto& block : fs::directory_iterator(from))
  {
    Move(block.path(), to / block.path().filename(), file);
  }
}
}

OutputFiles::~OutputFiles()
{
  for (const Place& place : this->Places)
  {
    std::error_code ignored;
    if (!place.Folder.empty())
    {
      fs::remove_all(place.Folder, ignored);
    }
  }
}

void OutputFiles::Expect(const std::string& file)
{
  const fs::path folder = FolderOf(file);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
  {
    Fail("there is no folder '" + folder.string() + "' to write '" + file + "' into");
  }
  if (fs::is_directory(file, ignored))
  {
    Fail("'" + file + "' is a folder; give the name of a file");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    Fail("cannot write into the folder '" + folder.string() + "': " + std::strerror(errno));
  }
  this->Places.push_back({ file, "" });
}

std::string OutputFiles::StagedPath(const std::string& file)
{
  const auto place =
    std::find_if(this->Places.begin(), this->Places.end(), [&](const Place& p) { return p.File == file; });
  if (place == this->Places.end())
  {
    throw std::logic_error("'" + file + "' was not expected");
  }
  std::string hidden = (FolderOf(file) / ".labelmesh-XXXXXX").string();
  if (!mkdtemp(hidden.data()))
  {
    Fail("cannot write into the folder '" + FolderOf(file).string() + "': " + std::strerror(errno));
  }
  place->Folder = hidden;
  return (fs::path(place->Folder) / fs::path(file).filename()).string();
}

void OutputFiles::WriteMesh(const std::string& file, vtkPolyData* mesh)
{
  WriteBytes(this->StagedPath(file), BytesOf<vtkXMLPolyDataWriter>(mesh, file), file);
}

void OutputFiles::WriteTetrahedra(const std::string& file, vtkUnstructuredGrid* grid)
{
  const std::string extension = fs::path(file).extension().string();
  if (extension == ".msh" || extension == ".inp")
  {
    const vtkSmartPointer<vtkTetrahedraWriter> writer = extension == ".msh"
      ? vtkSmartPointer<vtkTetrahedraWriter>(vtkSmartPointer<vtkGmshLabelMeshWriter>::New())
      : vtkSmartPointer<vtkTetrahedraWriter>(vtkSmartPointer<vtkAbaqusLabelMeshWriter>::New());
    Messages messages(writer);
    writer->SetInputData(grid);
    writer->SetFileName(this->StagedPath(file).c_str());
    if (!writer->Write() || !messages.FirstError().empty())
    {
      Fail("cannot write '" + file + "'" + (messages.FirstError().empty() ? "" : ": " + messages.FirstError()));
    }
    return;
  }
  WriteBytes(this->StagedPath(file), BytesOf<vtkXMLUnstructuredGridWriter>(grid, file), file);
}

/// The blocks are written first, by ourselves (see BytesOf). Then the collection's writer gets placeholders, where it
/// is known that there is room for them, and the blocks take their places.
void OutputFiles::WriteSurfaces(const std::string& file, vtkPartitionedDataSetCollection* surfaces)
{
  const std::string path = this->StagedPath(file);
  const fs::path folder = fs::path(path).parent_path() / fs::path(path).stem();
  const fs::path written = fs::path(path).parent_path() / ".blocks" / folder.filename();
  fs::create_directories(written);
  const unsigned blocks = surfaces->GetNumberOfPartitionedDataSets();
  for (unsigned block = 0; block < blocks; ++block)
  {
    WriteBytes(BlockFile(written, block), BytesOf<vtkXMLPolyDataWriter>(surfaces->GetPartition(block, 0), file), file);
  }
  const fs::path room = written / "room";
  WriteBytes(room, std::string((1 << 16) + (std::size_t(blocks) << 13), ' '), file);
  fs::remove(room);
  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> writer;
  SetFormat(writer);
  Messages messages(writer);
  writer->SetInputDataObject(Placeholders(surfaces));
  writer->SetFileName(path.c_str());
  if (!writer->Write() || !messages.FirstError().empty())
  {
    Fail("cannot write '" + file + "'" + (messages.FirstError().empty() ? "" : ": " + messages.FirstError()));
  }
  for (unsigned block = 0; block < blocks; ++block)
  {
    if (!fs::exists(BlockFile(folder, block)))
    {
      throw std::logic_error("the writer of collections has other names for its blocks");
    }
    Move(BlockFile(written, block), BlockFile(folder, block), file);
  }
}

void OutputFiles::WriteText(const std::string& file, const std::string& text)
{
  WriteBytes(this->StagedPath(file), text, file);
}

void OutputFiles::Forget(const std::string& file)
{
  this->Places.erase(std::remove_if(this->Places.begin(), this->Places.end(),
                       [&file](const Place& place) { return place.File == file && place.Folder.empty(); }),
    this->Places.end());
}

void OutputFiles::Commit()
{
  for (const Place& place : this->Places)
  {
    if (place.Folder.empty())
    {
      throw std::logic_error("'" + place.File + "' was not written");
    }
    const fs::path target(place.File);
    const fs::path blocks = fs::path(place.Folder) / target.stem();
    if (fs::is_directory(blocks))
    {
      MoveBlocks(blocks, target.parent_path() / target.stem(), place.File);
    }
    Move(fs::path(place.Folder) / target.filename(), target, place.File);
  }
}
