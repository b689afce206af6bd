// SPDX-License-Identifier: BSD-3-Clause
// What is said of a mesh: report.json (what was made, how good it is, what was lost, how long it took), and the last
// words on standard error.
#ifndef JsonReport_h
#define JsonReport_h

#include <vtkSmartPointer.h>

#include <string>
#include <utility>
#include <vector>

class vtkImageData;
class vtkLabelMeshReport;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

struct ReportInput
{
  std::string Input;  ///< file name
  std::string Method; ///< particle or grid
  vtkImageData* Volume = nullptr;
  int LabelAssociation = 0; ///< of the labels: vtkDataObject::FIELD_ASSOCIATION_POINTS or _CELLS
  std::string LabelArray;
  std::vector<long long> Labels; ///< that were to be meshed, ascending
  vtkPolyData* Mesh = nullptr;
  vtkPolyData* Particles = nullptr;  ///< none with the grid method
  vtkImageData* Tightened = nullptr; ///< labels rebuilt from the indicators; none with the grid method
  vtkPartitionedDataSetCollection* Surfaces = nullptr; ///< with field data MaskVolumes, TightVolumes
  std::vector<std::pair<std::string, double>> Seconds; ///< of each stage, in order, "total", "Report"
  vtkUnstructuredGrid* Tetrahedra = nullptr;           ///< none unless asked for
  bool ErrorMap = false;                               ///< measure the distance of every point to the voxels
  int Threads = 1;
};

/// Checks the mesh. Throws std::runtime_error with a sentence.
vtkSmartPointer<vtkLabelMeshReport> CheckMesh(const ReportInput& input);

/// Sentences for the user: the certificate, and for each stage that lost something how much, and what to do.
std::vector<std::string> Verdict(const ReportInput& input, vtkLabelMeshReport* report);

/// One JSON object:
///  input, dimensions, spacing, method, certified, certificate (a sentence), points, triangles, min_radius_ratio,
///  p1_radius_ratio, mean_radius_ratio, worst_triangle {triangle, position}, duplicate_triangles,
///  degenerate_triangles, wrong_faces, kept_from_cutting (particle method), self_intersecting_pairs,
///  self_intersecting_triangles, misclassified_voxels,
///  distance_to_voxels {mean, max, far_points} (with an error map),
///  materials [{label, name, triangles, vertices, min_radius_ratio, mean_radius_ratio, worst_triangle, certified,
///    closed, manifold, edge_manifold, vertex_manifold, oriented, open_edges, nonmanifold_edges, nonmanifold_vertices,
///    misoriented_edges, self_intersections, components, euler, genus, parts, cavities, voxels, voxel_components,
///    voxel_euler, voxel_genus, voxel_parts, voxel_cavities, lost_parts, misclassified_voxels, area, volume,
///    voxel_volume, mask_volume, tight_volume}] without the background; manifold: every edge has two triangles and
///    every vertex one fan; genus: null where the surface is not closed and manifold; the rest as in
///    vtkLabelMeshReport.h,
///  background: the same of the background; its volume is negative: the space that the materials take,
///  interfaces [{labels, triangles, area, min_radius_ratio, mean_radius_ratio, voxel_faces}],
///  upsampling {factor, reason} (where --upsample allows it): samples per voxel along each axis, and a sentence,
///  cells {"0", "1", "2"}: particles on 0-, 1- and 2-cells (particle method),
///  tetrahedra (when asked for) {count, turned_over, slivers, min_radius_ratio, p1_radius_ratio, mean_radius_ratio,
///    min_dihedral_degrees, max_dihedral_degrees, volume, worst_tetrahedron, histogram: of the dihedral angles by 10
///    degrees, materials: [the same of each, with label and name]},
///  lost [{label or labels, stage, what, advice; of a label and of its parts also parts, voxels, position}]: labels
///    without a triangle, connected parts of a label without a voxel in the mesh, labels that touch no more;
///    with on_request: true components that --min-component dropped, which no other figure counts any more,
///  seconds {stage: s, total; then Report: this check, not in the total}, peak_memory_bytes, threads, version.
/// The stage of a loss is the first after which it can be seen.
std::string JsonReport(const ReportInput& input, vtkLabelMeshReport* report);

#endif
