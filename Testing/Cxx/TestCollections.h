// SPDX-License-Identifier: BSD-3-Clause
// Material collections from analytic functions, and a listener for the errors and warnings of filters.
#ifndef TestCollections_h
#define TestCollections_h

#include "IndicatorCollection.h"
#include "LabelMeshNames.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace TestCollections
{
using namespace LabelMesh;

/// A field of the position in the local frame.
using Field = std::function<double(const Vec3&)>;

inline vtkSmartPointer<vtkFloatArray> FloatArray(const char* name, const std::vector<float>& values)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

inline vtkSmartPointer<vtkUnsignedCharArray> MaskArray(const GridFrame& frame, std::uint8_t value)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(Names::Mask);
  array->SetNumberOfValues(frame.Samples().Size());
  array->FillValue(value);
  return array;
}

/// A collection with one block per label, which covers the working grid; label 0 is the background.
inline vtkSmartPointer<vtkPartitionedDataSetCollection> MakeCollection(
  const GridFrame& source, int padding, const std::map<Label, Field>& fields, const char* arrayName)
{
  vtkNew<vtkPartitionedDataSetCollection> collection;
  CollectionHeader header;
  header.Source = source;
  header.Padding = padding;
  for (const auto& field : fields)
  {
    header.Materials.push_back(DefaultMaterial(field.first));
  }
  WriteHeader(collection, header);
  const GridFrame working = header.WorkingFrame();
  const Lattice lattice = working.Samples();
  for (std::size_t m = 0; m < header.Materials.size(); ++m)
  {
    std::vector<float> values(lattice.Size());
    const Field& field = fields.at(header.Materials[m].Label);
    for (Index at = 0; at < lattice.Size(); ++at)
    {
      const auto c = lattice.Coordinates(at);
      values[at] = float(field(lattice.Position(c[0], c[1], c[2])));
    }
    AppendBlock(collection, header.Materials[m], working, FloatArray(arrayName, values));
  }
  return collection;
}

/// Material 7, a ball in the background.
inline std::map<Label, Field> BallFields(const Vec3& centre, double radius)
{
  const Field ball = [=](const Vec3& x) { return radius - (x - centre).norm(); };
  return { { 0, [=](const Vec3& x) { return -ball(x); } }, { 7, ball } };
}

/// A rotation about an oblique axis; mirrored if asked.
inline Mat3 ObliqueDirection(bool mirrored)
{
  Mat3 direction = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  if (mirrored)
  {
    direction.col(1) *= -1;
  }
  return direction;
}

/// Collects what a filter and its executive say.
class Listener
{
public:
  explicit Listener(vtkObject* object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long event, void* self, void* text)
      {
        auto* listener = static_cast<Listener*>(self);
        (event == vtkCommand::ErrorEvent ? listener->Errors : listener->Warnings) += static_cast<const char*>(text);
      });
    object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  std::string Errors, Warnings;

private:
  vtkNew<vtkCallbackCommand> Command;
};
}

#endif
