// SPDX-License-Identifier: BSD-3-Clause
// The interfaces of a label volume by CGAL's Mesh_3, as its users make them:
//   cgal_labels LABELS.inr MESH.vtp FACET_SIZE FACET_DISTANCE
// Delaunay refinement with facet angles of 30 degrees at least. The triangles carry BoundaryLabels.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <unordered_map>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

namespace
{
struct Interfaces
{
  std::vector<std::array<double, 3>> Points;
  std::vector<std::array<int, 3>> Triangles;
  std::vector<std::array<int, 2>> Labels; ///< the normal points from the first to the second
};

int LabelOf(const Complex& complex, Triangulation::Cell_handle cell)
{
  return complex.is_in_complex(cell) ? static_cast<int>(complex.subdomain_index(cell)) : 0;
}

Interfaces InterfacesOf(const Complex& complex)
{
  Interfaces result;
  std::unordered_map<const void*, int> numbers;
  const auto number = [&](Triangulation::Vertex_handle vertex)
  {
    const auto found = numbers.emplace(&*vertex, static_cast<int>(numbers.size()));
    if (found.second)
    {
      const auto& p = vertex->point();
      result.Points.push_back({ CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()) });
    }
    return found.first->second;
  };
  const int corners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } }; // outward
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end(); ++facet)
  {
    const auto cell = facet->first;
    const int* c = corners[facet->second];
    std::array<int, 3> triangle{ number(cell->vertex(c[0])), number(cell->vertex(c[1])), number(cell->vertex(c[2])) };
    std::array<int, 2> labels{ LabelOf(complex, cell), LabelOf(complex, cell->neighbor(facet->second)) };
    if (labels[0] == 0 || (labels[1] != 0 && labels[1] < labels[0])) // the background second, else ascending
    {
      std::swap(labels[0], labels[1]);
      std::swap(triangle[0], triangle[1]);
    }
    result.Triangles.push_back(triangle);
    result.Labels.push_back(labels);
  }
  return result;
}

template <class Rows>
void WriteArray(std::ostream& out, const char* attributes, const Rows& rows)
{
  out << "<DataArray " << attributes << " format=\"ascii\">\n";
  for (const auto& row : rows)
  {
    for (const auto value : row)
    {
      out << value << ' ';
    }
    out << '\n';
  }
  out << "</DataArray>\n";
}

void Write(const std::string& path, const Interfaces& mesh)
{
  std::ofstream out(path);
  out.precision(9);
  std::vector<std::array<std::size_t, 1>> ends;
  for (std::size_t n = 1; n <= mesh.Triangles.size(); ++n)
  {
    ends.push_back({ 3 * n });
  }
  out << "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n<Piece NumberOfPoints=\""
      << mesh.Points.size() << "\" NumberOfPolys=\"" << mesh.Triangles.size() << "\">\n<Points>\n";
  WriteArray(out, "type=\"Float64\" NumberOfComponents=\"3\"", mesh.Points);
  out << "</Points>\n<Polys>\n";
  WriteArray(out, "type=\"Int64\" Name=\"connectivity\"", mesh.Triangles);
  WriteArray(out, "type=\"Int64\" Name=\"offsets\"", ends);
  out << "</Polys>\n<CellData>\n";
  WriteArray(out, "type=\"Int64\" Name=\"BoundaryLabels\" NumberOfComponents=\"2\"", mesh.Labels);
  out << "</CellData>\n</Piece></PolyData></VTKFile>\n";
  if (!out.flush())
  {
    throw std::runtime_error("cgal_labels: " + path + " cannot be written");
  }
}

void Run(char** arguments)
{
  CGAL::Image_3 image;
  if (!image.read(arguments[1]))
  {
    throw std::runtime_error(std::string("cgal_labels: ") + arguments[1] + " cannot be read");
  }
  const Domain domain = Domain::create_labeled_image_mesh_domain(image, parameters::relative_error_bound = 1e-6);
  const Criteria criteria(parameters::facet_angle = 30, parameters::facet_size = std::atof(arguments[3]),
    parameters::facet_distance = std::atof(arguments[4]));
  const Complex complex = CGAL::make_mesh_3<Complex>(
    domain, criteria, parameters::no_lloyd(), parameters::no_odt(), parameters::no_perturb(), parameters::no_exude());
  Write(arguments[2], InterfacesOf(complex));
}
}

int main(int count, char** arguments)
{
  if (count != 5)
  {
    std::cerr << "usage: cgal_labels LABELS.inr MESH.vtp FACET_SIZE FACET_DISTANCE\n";
    return 1;
  }
  try
  {
    Run(arguments);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
