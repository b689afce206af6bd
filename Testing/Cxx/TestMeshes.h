// SPDX-License-Identifier: BSD-3-Clause
// Handmade meshes and label images for the tests of the filters.
#ifndef TestMeshes_h
#define TestMeshes_h

#include "IndicatorCollection.h"
#include "Core/InterfaceMesh.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>

namespace TestMeshes
{
using namespace LabelMesh;

/// An image of `size` samples per axis with the label of each index.
inline vtkSmartPointer<vtkImageData> LabelVolume(
  const std::array<int, 6>& extent, const std::function<int(int, int, int)>& label)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  vtkNew<vtkShortArray> labels;
  labels->SetName("Segments");
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        labels->InsertNextValue(static_cast<short>(label(i, j, k)));
      }
    }
  }
  image->GetPointData()->SetScalars(labels);
  return image;
}

/// The paper's two balls on a cube of `size` samples.
inline vtkSmartPointer<vtkImageData> TwoSpheres(int size)
{
  const double scale = size / 128.0;
  const auto inside = [scale](const Vec3& x, const Vec3& centre, double radius)
  { return (x - scale * centre).norm() <= scale * radius; };
  return LabelVolume({ 0, size - 1, 0, size - 1, 0, size - 1 },
    [&](int i, int j, int k)
    {
      const Vec3 x(i, j, k);
      return inside(x, Vec3(63.3, 64.2, 78.1), 34) ? 1 : inside(x, Vec3(64.1, 63.4, 46.2), 30) ? 2 : 0;
    });
}

/// A frame with offset extent, unequal spacing and a turned axis; mirrored on request.
inline GridFrame OrientedFrame(const std::array<int, 6>& extent, bool mirrored)
{
  Mat3 direction;
  direction << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, mirrored ? -1 : 1;
  return GridFrame(extent, Vec3(10, -20, 30), Vec3(0.5, 0.7, 1.1), direction);
}

inline CollectionHeader HeaderWith(const GridFrame& frame, const std::vector<Label>& labels, Label background)
{
  CollectionHeader header;
  header.Source = frame;
  header.Background = background;
  for (const Label label : labels)
  {
    header.Materials.push_back(DefaultMaterial(label));
  }
  return header;
}

/// Two boxes of the sizes (1, 1, 1) and (2, 1, 1), side by side along x: materials `left` and `right`, `around` them.
inline InterfaceMesh TwoBoxes(MaterialId left, MaterialId right, MaterialId around)
{
  InterfaceMesh mesh;
  const double xs[3] = { 0, 1, 3 };
  for (int n = 0; n < 12; ++n)
  {
    Particle particle;
    particle.Position = Vec3(xs[n % 3], n / 3 % 2, n / 6);
    particle.CellDimension = n % 3 == 1 ? 1 : 2;
    particle.TargetLength = 1.0;
    for (const MaterialId m : { around, left, right })
    {
      if (m == around || (m == left && n % 3 < 2) || (m == right && n % 3 > 0))
      {
        particle.Materials.Insert(m);
      }
    }
    mesh.Vertices.push_back(particle);
  }
  const auto quad = [&](Index a, Index b, Index c, Index d, MaterialId inside, MaterialId outside)
  {
    mesh.Triangles.push_back({ { a, b, c }, { inside, outside } });
    mesh.Triangles.push_back({ { a, c, d }, { inside, outside } });
  };
  for (int box = 0; box < 2; ++box)
  {
    const Index o = box;
    const MaterialId m = box == 0 ? left : right;
    quad(o, o + 3, o + 4, o + 1, m, around);      // z = 0, facing down
    quad(o + 6, o + 7, o + 10, o + 9, m, around); // z = 1
    quad(o, o + 1, o + 7, o + 6, m, around);      // y = 0
    quad(o + 3, o + 9, o + 10, o + 4, m, around); // y = 1
  }
  quad(0, 6, 9, 3, left, around);
  quad(2, 5, 11, 8, right, around);
  quad(1, 4, 10, 7, left, right);
  return mesh;
}

/// Keeps the errors and warnings of a filter instead of printing them.
class Complaints
{
public:
  explicit Complaints(vtkAlgorithm* filter)
  {
    filter->AddObserver(vtkCommand::ErrorEvent, this, &Complaints::Note);
    filter->AddObserver(vtkCommand::WarningEvent, this, &Complaints::Note);
    // The executive only says that the filter failed.
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Complaints::Ignore);
  }
  void Ignore(vtkObject*, unsigned long, void*) {}
  void Note(vtkObject*, unsigned long, void* message)
  {
    this->Text += static_cast<const char*>(message);
    ++this->Count;
  }
  bool Say(const std::string& words) const { return this->Text.find(words) != std::string::npos; }

  std::string Text;
  int Count = 0;
};
}

#endif
