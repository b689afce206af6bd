// SPDX-License-Identifier: BSD-3-Clause
// Files that are written whole or not at all.
#ifndef OutputFiles_h
#define OutputFiles_h

#include <string>
#include <vector>

class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

/// Each file is written in a hidden folder of its own beside its place. Commit moves all of them to their places;
/// without it the folders vanish with this object, and nothing has changed. All functions throw std::runtime_error with
/// a sentence.
class OutputFiles
{
public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Announces a file, so that a missing folder is known before the work begins.
  void Expect(const std::string& file);

  void WriteMesh(const std::string& file, vtkPolyData* mesh);
  /// As .msh (Gmsh), .inp (Abaqus, CalculiX) or .vtu, by the file's extension.
  void WriteTetrahedra(const std::string& file, vtkUnstructuredGrid* grid);
  /// A .vtpc file has a folder of its name beside it with a .vtp file per block.
  void WriteSurfaces(const std::string& file, vtkPartitionedDataSetCollection* surfaces);
  void WriteText(const std::string& file, const std::string& text);

  /// The file is not to be written after all.
  void Forget(const std::string& file);

  void Commit();

private:
  struct Place
  {
    std::string File;   ///< where it shall be
    std::string Folder; ///< the hidden folder; empty until the file is written
  };
  std::string StagedPath(const std::string& file);

  std::vector<Place> Places;
};

#endif
