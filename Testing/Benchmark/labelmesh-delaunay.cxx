// SPDX-License-Identifier: BSD-3-Clause
// What one Delaunay tetrahedralisation of the points of a file costs, and nothing else: labelmesh-delaunay POINTS.vtp
// prints {"points": ..., "tetrahedra": ..., "seconds": ...}. The benchmark compares the whole chain with it.
#include "Delaunay.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <chrono>
#include <exception>
#include <iostream>
#include <vector>

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: labelmesh-delaunay POINTS.vtp\n";
    return 1;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || data->GetNumberOfPoints() == 0)
  {
    std::cerr << "labelmesh-delaunay: no points in '" << argv[1] << "'\n";
    return 1;
  }
  std::vector<LabelMesh::Vec3> points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    data->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  try
  {
    const auto start = std::chrono::steady_clock::now();
    const LabelMesh::Index tetrahedra = LabelMesh::DelaunayTetrahedra(points).Size();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << "{\"points\": " << points.size() << ", \"tetrahedra\": " << tetrahedra
              << ", \"seconds\": " << seconds.count() << "}\n";
  }
  catch (const std::exception& problem)
  {
    std::cerr << "labelmesh-delaunay: " << problem.what() << "\n";
    return 1;
  }
  return 0;
}
