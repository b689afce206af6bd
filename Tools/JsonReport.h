// SPDX-License-Identifier: BSD-3-Clause
// report.json: what was made, how good it is, what was lost, how long it took.
#ifndef JsonReport_h
#define JsonReport_h

#include <string>
#include <utility>
#include <vector>

class vtkImageData;
class vtkPartitionedDataSetCollection;
class vtkPolyData;

struct ReportInput
{
  std::string Input;  ///< file name
  std::string Method; ///< particle or grid
  vtkImageData* Volume = nullptr;
  int LabelAssociation = 0; ///< of the labels: vtkDataObject::FIELD_ASSOCIATION_POINTS or _CELLS
  std::string LabelArray;
  std::vector<long long> Labels; ///< that were to be meshed, ascending
  vtkPolyData* Mesh = nullptr;
  vtkPolyData* Particles = nullptr;                    ///< none with the grid method
  vtkPartitionedDataSetCollection* Surfaces = nullptr; ///< with field data MaskVolumes, TightVolumes
  std::vector<std::pair<std::string, double>> Seconds; ///< of each stage, in order, and "total"
  int Threads = 1;
};

/// One JSON object:
///  input, dimensions, spacing, method, points, triangles, min_radius_ratio, p1_radius_ratio, mean_radius_ratio,
///  duplicate_triangles, wrong_faces,
///  materials [{label, name, triangles, vertices, min_radius_ratio, mean_radius_ratio, closed, manifold, oriented,
///    open_edges, nonmanifold_edges, nonmanifold_vertices, components, euler, area, volume, voxel_volume, mask_volume,
///    tight_volume}] without the background; manifold: every edge has two triangles and every vertex one fan,
///  background: the same of the background; its volume is negative: the space that the materials take,
///  cells {"0", "1", "2"}: particles on 0-, 1- and 2-cells (particle method),
///  lost [{label or labels, stage, what}], seconds {stage: s, total}, peak_memory_bytes, threads, version.
/// The stage of a loss is the first after which it can be seen.
/// Throws std::runtime_error with a sentence.
std::string JsonReport(const ReportInput& input);

#endif
