// SPDX-License-Identifier: BSD-3-Clause
// What the shape of tetrahedra does to a linear system: conditioning MESH.vtu|SURFACE.vtp...
//
// Assembles the stiffness matrix of Laplace's equation with linear elements (coefficient 1 in all materials, the values
// on the outer faces given) and prints its extreme eigenvalues and condition number, as it is and scaled by its
// diagonal, as the simplest preconditioner does. Iterations of the conjugate gradient method grow as the root of that
// number.
//
// A .vtu is taken as it is. A .vtp of interface triangles is filled with tetrahedra by TetGen, which keeps the
// triangles and bounds the radius-edge ratio by 1.414 where it can; when TetGen refuses them its reason is printed, and
// the outer faces alone are tried, those that have the background's label.
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#define TETLIBRARY // without it tetgen.h declares the program, not the library
#include <tetgen.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using Vec3 = Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

struct Mesh
{
  std::vector<Vec3> Points;
  std::vector<std::array<int, 4>> Tetrahedra;
};

struct Surface
{
  std::vector<Vec3> Points;
  std::vector<std::array<int, 3>> Triangles;
  std::vector<bool> Outer; ///< of each triangle: the background is on one side
};

std::vector<Vec3> PointsOf(vtkPointSet* data)
{
  std::vector<Vec3> points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    data->GetPoint(vtkIdType(n), points[n].data());
  }
  return points;
}

template <std::size_t Corners>
std::vector<std::array<int, Corners>> CellsOf(vtkCellArray* cells)
{
  std::vector<std::array<int, Corners>> result;
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(size, points);)
  {
    if (size != vtkIdType(Corners))
    {
      throw std::runtime_error("a cell has " + std::to_string(size) + " corners, expected " + std::to_string(Corners));
    }
    result.emplace_back();
    std::copy_n(points, Corners, result.back().begin());
  }
  return result;
}

Mesh ReadMesh(const std::string& file)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    throw std::runtime_error("there are no tetrahedra");
  }
  return { PointsOf(grid), CellsOf<4>(grid->GetCells()) };
}

Surface ReadSurface(const std::string& file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* sides = data ? data->GetCellData()->GetArray("BoundaryLabels") : nullptr;
  if (!sides)
  {
    throw std::runtime_error("there are no triangles with the array BoundaryLabels");
  }
  vtkDataArray* field = data->GetFieldData()->GetArray("BackgroundLabel");
  const double background = field ? field->GetTuple1(0) : 0.0;
  Surface surface{ PointsOf(data), CellsOf<3>(data->GetPolys()), {} };
  for (vtkIdType t = 0; t < data->GetNumberOfPolys(); ++t)
  {
    surface.Outer.push_back(sides->GetComponent(t, 0) == background || sides->GetComponent(t, 1) == background);
  }
  return surface;
}

std::string ReasonOf(int code)
{
  switch (code)
  {
    case 3:
      return "the triangles cut each other";
    case 4:
      return "a part is too small for its precision";
    case 5:
      return "two faces are too close to each other";
    default:
      return "error " + std::to_string(code);
  }
}

/// TetGen crashes on some triangles that cut each other, so it is tried in a process of its own first.
void TryFirst(const std::function<void()>& work)
{
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    try
    {
      work();
      _exit(0);
    }
    catch (int code)
    {
      _exit(code);
    }
    catch (...)
    {
      _exit(2);
    }
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child)
  {
    throw std::runtime_error("there is no process to try TetGen in");
  }
  if (WIFSIGNALED(status))
  {
    throw std::runtime_error("it crashed");
  }
  if (WEXITSTATUS(status) != 0)
  {
    throw std::runtime_error(ReasonOf(WEXITSTATUS(status)));
  }
}

/// TetGen's tetrahedra inside the triangles; throws a sentence when it refuses them.
Mesh Fill(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles)
{
  tetgenio input, output;
  input.numberofpoints = int(points.size());
  input.pointlist = new REAL[3 * points.size()];
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    std::copy_n(points[n].data(), 3, input.pointlist + 3 * n);
  }
  input.numberoffacets = int(triangles.size());
  input.facetlist = new tetgenio::facet[triangles.size()];
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    tetgenio::facet& facet = input.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy_n(triangles[t].begin(), 3, facet.polygonlist[0].vertexlist);
  }
  // p: inside the triangles, Y: which stay as they are, q: radius-edge ratio, Q: quiet.
  char switches[] = "pYq1.414Q";
  TryFirst(
    [&switches, &input]()
    {
      tetgenio tried;
      tetrahedralize(switches, &input, &tried);
    });
  tetrahedralize(switches, &input, &output);
  Mesh mesh;
  for (int n = 0; n < output.numberofpoints; ++n)
  {
    mesh.Points.push_back(Eigen::Map<const Vec3>(output.pointlist + 3 * n));
  }
  for (int t = 0; t < output.numberoftetrahedra; ++t)
  {
    mesh.Tetrahedra.emplace_back();
    std::copy_n(output.tetrahedronlist + output.numberofcorners * t, 4, mesh.Tetrahedra.back().begin());
  }
  if (mesh.Tetrahedra.empty())
  {
    throw std::runtime_error("it left no tetrahedra");
  }
  return mesh;
}

Mesh FillOrOuter(const Surface& surface)
{
  try
  {
    const Mesh mesh = Fill(surface.Points, surface.Triangles);
    std::printf("  TetGen inside all %zu triangles\n", surface.Triangles.size());
    return mesh;
  }
  catch (const std::runtime_error& problem)
  {
    std::printf("  TetGen cannot fill all %zu triangles: %s\n", surface.Triangles.size(), problem.what());
  }
  std::vector<std::array<int, 3>> outer;
  for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
  {
    if (surface.Outer[t])
    {
      outer.push_back(surface.Triangles[t]);
    }
  }
  try
  {
    const Mesh mesh = Fill(surface.Points, outer);
    std::printf("  TetGen inside the %zu outer triangles alone: one material, not all\n", outer.size());
    return mesh;
  }
  catch (const std::runtime_error& problem)
  {
    throw std::runtime_error(std::string("TetGen cannot fill the outer triangles alone either: ") + problem.what());
  }
}

/// Points on faces that only one tetrahedron has; points of none count too, so that they leave the matrix.
std::vector<bool> GivenPoints(const Mesh& mesh)
{
  std::vector<std::array<int, 3>> faces;
  std::vector<bool> given(mesh.Points.size(), true);
  for (const auto& tetra : mesh.Tetrahedra)
  {
    for (int c = 0; c < 4; ++c)
    {
      std::array<int, 3> face = { tetra[(c + 1) % 4], tetra[(c + 2) % 4], tetra[(c + 3) % 4] };
      std::sort(face.begin(), face.end());
      faces.push_back(face);
      given[tetra[c]] = false;
    }
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    if ((i == 0 || faces[i - 1] != faces[i]) && (i + 1 == faces.size() || faces[i + 1] != faces[i]))
    {
      for (const int point : faces[i])
      {
        given[point] = true;
      }
    }
  }
  return given;
}

/// The integrals of the products of gradients, for all points that are not given.
Matrix Stiffness(const Mesh& mesh, const std::vector<bool>& given)
{
  std::vector<int> rows(mesh.Points.size(), -1);
  int count = 0;
  for (std::size_t n = 0; n < rows.size(); ++n)
  {
    rows[n] = given[n] ? -1 : count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& tetra : mesh.Tetrahedra)
  {
    Eigen::Matrix3d edges;
    for (int c = 0; c < 3; ++c)
    {
      edges.row(c) = mesh.Points[tetra[c + 1]] - mesh.Points[tetra[0]];
    }
    const double volume = std::abs(edges.determinant()) / 6;
    // Column c + 1: the gradient of the function that is 1 in corner c + 1 and 0 in the others.
    Eigen::Matrix<double, 3, 4> gradients;
    gradients.rightCols<3>() = edges.inverse();
    gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
    const Eigen::Matrix4d products = volume * gradients.transpose() * gradients;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        if (rows[tetra[i]] >= 0 && rows[tetra[j]] >= 0)
        {
          entries.emplace_back(rows[tetra[i]], rows[tetra[j]], products(i, j));
        }
      }
    }
  }
  Matrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The largest eigenvalue of a symmetric operator, by Lanczos' method with full orthogonalisation.
double LargestEigenvalue(int size, const std::function<Vector(const Vector&)>& apply)
{
  const int steps = std::min(size, 200);
  Eigen::MatrixXd basis(size, steps);
  Vector diagonal(steps), beside(steps);
  // Any start that is not orthogonal to the eigenvector will do; this one is the same every time.
  basis.col(0) = Vector::NullaryExpr(size, [](Eigen::Index n) { return 1 + std::sin(12.9898 * double(n + 1)); });
  basis.col(0).normalize();
  double largest = 0;
  for (int n = 0; n < steps; ++n)
  {
    Vector next = apply(basis.col(n));
    diagonal[n] = basis.col(n).dot(next);
    for (int twice = 0; twice < 2; ++twice)
    {
      next -= basis.leftCols(n + 1) * (basis.leftCols(n + 1).transpose() * next);
    }
    beside[n] = next.norm();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
    small.computeFromTridiagonal(diagonal.head(n + 1), beside.head(n));
    const double before = largest;
    largest = small.eigenvalues()[n];
    // The last component of the eigenvector tells how far off the eigenvalue can be.
    const double off = beside[n] * std::abs(small.eigenvectors()(n, n));
    if (n + 1 == steps || off < 1e-6 * largest || (n > 0 && beside[n] < 1e-14 * before))
    {
      break;
    }
    basis.col(n + 1) = next / beside[n];
  }
  return largest;
}

void PrintCondition(const char* what, const Matrix& matrix)
{
  const Eigen::SimplicialLDLT<Matrix> factors(matrix);
  if (factors.info() != Eigen::Success)
  {
    throw std::runtime_error("the matrix could not be factored");
  }
  const int size = int(matrix.rows());
  const double most = LargestEigenvalue(size, [&matrix](const Vector& x) { return Vector(matrix * x); });
  const double least = 1 / LargestEigenvalue(size, [&factors](const Vector& x) { return Vector(factors.solve(x)); });
  std::printf("  %s eigenvalues %.6g to %.6g, condition number %.6g\n", what, least, most, most / least);
}

void Examine(const std::string& file)
{
  std::printf("%s\n", file.c_str());
  const bool filled = file.size() > 4 && file.substr(file.size() - 4) == ".vtu";
  const Mesh mesh = filled ? ReadMesh(file) : FillOrOuter(ReadSurface(file));
  const Matrix matrix = Stiffness(mesh, GivenPoints(mesh));
  std::printf(
    "  %zu tetrahedra, %zu points, %d unknowns\n", mesh.Tetrahedra.size(), mesh.Points.size(), int(matrix.rows()));
  if (matrix.rows() == 0)
  {
    throw std::runtime_error("all points are on outer faces: there is nothing to solve");
  }
  const Vector roots = matrix.diagonal().cwiseSqrt().cwiseInverse();
  PrintCondition("as it is:           ", matrix);
  PrintCondition("scaled by diagonal: ", roots.asDiagonal() * matrix * roots.asDiagonal());
}
}

int main(int argc, char** argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: conditioning MESH.vtu|SURFACE.vtp...\n");
    return 2;
  }
  int failed = 0;
  for (int n = 1; n < argc; ++n)
  {
    try
    {
      Examine(argv[n]);
    }
    catch (const std::exception& problem)
    {
      std::fprintf(stderr, "conditioning: %s: %s\n", argv[n], problem.what());
      failed = 1;
    }
  }
  return failed;
}
