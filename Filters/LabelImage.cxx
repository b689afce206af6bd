// SPDX-License-Identifier: BSD-3-Clause
#include "LabelImage.h"

#include "IndicatorCollection.h"

#include <vtkArrayDispatch.h>
#include <vtkDataArray.h>
#include <vtkDataArrayRange.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace LabelMesh
{
namespace
{
std::string IndexOf(Index at, const GridFrame& frame)
{
  const auto c = frame.Samples().Coordinates(at);
  const auto& extent = frame.Extent();
  return "(" + std::to_string(c[0] + extent[0]) + ", " + std::to_string(c[1] + extent[2]) + ", " +
    std::to_string(c[2] + extent[4]) + ")";
}

template <typename T>
Label ToLabel(T value, Index at, const GridFrame& frame)
{
  bool isLabel = true;
  if constexpr (std::is_floating_point_v<T>)
  {
    // 2^63 is the first double that does not fit.
    isLabel = std::abs(value) < T(9.2e18) && value == std::floor(value);
  }
  else if constexpr (std::is_unsigned_v<T> && sizeof(T) == sizeof(Label))
  {
    isLabel = value <= T(std::numeric_limits<Label>::max());
  }
  if (!isLabel)
  {
    throw std::invalid_argument(
      "holds " + std::to_string(value) + " at index " + IndexOf(at, frame) + ", which is not an integer label");
  }
  return static_cast<Label>(value);
}

/// Labels that occur, and the id of each sample. Runs of equal labels are long, so the last one is remembered.
struct IdWorker
{
  LabelImage* Image;

  template <typename Array>
  void operator()(Array* array)
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    std::set<Label> found;
    Label last = 0;
    Index at = 0;
    for (const auto value : values)
    {
      const Label label = ToLabel(static_cast<vtk::GetAPIType<Array>>(value), at, this->Image->Frame);
      if (at == 0 || label != last)
      {
        found.insert(label);
        last = label;
      }
      ++at;
    }
    if (found.size() >= NoMaterial)
    {
      throw std::invalid_argument(
        "has " + std::to_string(found.size()) + " labels, at most " + std::to_string(NoMaterial - 1) + " are possible");
    }
    std::vector<Label>& labels = this->Image->Labels;
    labels.assign(found.begin(), found.end());
    this->Image->Ids.resize(static_cast<std::size_t>(values.size()));
    MaterialId id = 0;
    at = 0;
    for (const auto value : values)
    {
      const Label label = static_cast<Label>(static_cast<vtk::GetAPIType<Array>>(value));
      if (labels[id] != label)
      {
        id = MaterialId(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
      }
      this->Image->Ids[at++] = id;
    }
  }
};

void RequireThreeDimensions(const GridFrame& frame)
{
  const std::array<int, 3> dims = frame.Samples().Dims;
  if (std::min({ dims[0], dims[1], dims[2] }) < 2)
  {
    throw std::invalid_argument("The label image has " + std::to_string(dims[0]) + " x " + std::to_string(dims[1]) +
      " x " + std::to_string(dims[2]) + " samples; expected a volume with two or more along each axis.");
  }
}

/// What no scan has and broken headers have: with such lengths the work does not end, or numbers have no room.
void RequireMeasurableVoxels(const GridFrame& frame)
{
  constexpr double longestVoxel = 100.0; // over its width
  constexpr double smallest = 1e-30, largest = 1e30;
  constexpr double farthest = 1e10; // voxels: the digits left to a vertex are a millionth of a voxel
  const auto text = [](double number)
  {
    std::ostringstream stream;
    stream << number;
    return stream.str();
  };
  const Vec3 spacing = frame.Spacing();
  const double least = spacing.minCoeff(), most = spacing.maxCoeff();
  if (least < smallest || most > largest || most > longestVoxel * least)
  {
    throw std::invalid_argument("The label image has the spacing " + text(spacing[0]) + " x " + text(spacing[1]) +
      " x " + text(spacing[2]) + "; expected voxels at most " + text(longestVoxel) +
      " times as long as wide, with sides between " + text(smallest) + " and " + text(largest) +
      ". Correct the spacing, or resample the volume.");
  }
  const double away = frame.Origin().cwiseAbs().maxCoeff();
  if (away > farthest * least)
  {
    throw std::invalid_argument("The label image has its origin " + text(away) + " away from zero, with voxels of " +
      text(least) + "; expected at most " + text(farthest) + " voxels. Move the origin.");
  }
}
}

GridFrame FrameOfCells(const GridFrame& points)
{
  std::array<int, 6> extent = points.Extent();
  for (int a = 0; a < 3; ++a)
  {
    --extent[2 * a + 1];
  }
  return GridFrame(extent, points.ToWorld(0.5, 0.5, 0.5), points.Spacing(), points.Direction());
}

LabelImage ReadLabelImage(vtkImageData* image, vtkDataArray* array, bool cellData)
{
  if (!image || image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("The label image is empty; expected a volume of labels.");
  }
  if (!array)
  {
    throw std::invalid_argument("The label image has no array of labels; choose a point or cell array of integers.");
  }
  const std::string name = array->GetName() ? array->GetName() : "labels";
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The array '" + name + "' has " + std::to_string(array->GetNumberOfComponents()) +
      " components; expected one label per voxel.");
  }
  LabelImage result;
  const GridFrame points = FrameOf(image);
  RequireThreeDimensions(points);
  RequireMeasurableVoxels(points);
  result.Frame = cellData ? FrameOfCells(points) : points;
  if (result.Frame.Samples().Size() != array->GetNumberOfTuples())
  {
    throw std::invalid_argument("The array '" + name + "' has " + std::to_string(array->GetNumberOfTuples()) +
      " values for " + std::to_string(result.Frame.Samples().Size()) + " voxels.");
  }
  IdWorker worker{ &result };
  try
  {
    if (!vtkArrayDispatch::Dispatch::Execute(array, worker))
    {
      worker(array);
    }
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument("The array '" + name + "' " + error.what() + ".");
  }
  return result;
}

MaterialId IdOf(const LabelImage& image, Label label)
{
  return MaterialId(std::lower_bound(image.Labels.begin(), image.Labels.end(), label) - image.Labels.begin());
}

void MergeIntoBackground(LabelImage& image, const std::vector<Label>& kept, Label background)
{
  std::set<Label> labels = { background };
  for (const Label label : image.Labels)
  {
    if (std::binary_search(kept.begin(), kept.end(), label))
    {
      labels.insert(label);
    }
  }
  const std::vector<Label> merged(labels.begin(), labels.end());
  std::vector<MaterialId> renumbered;
  for (const Label label : image.Labels)
  {
    const auto at = std::lower_bound(merged.begin(), merged.end(), labels.count(label) ? label : background);
    renumbered.push_back(MaterialId(at - merged.begin()));
  }
  for (MaterialId& id : image.Ids)
  {
    id = renumbered[id];
  }
  image.Labels = merged;
}

bool PromisedFrame(vtkInformation* inInfo, bool cellData, GridFrame& frame)
{
  if (!inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    return false;
  }
  std::array<int, 6> extent;
  std::copy_n(inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6, extent.begin());
  Vec3 origin = Vec3::Zero(), spacing = Vec3::Ones();
  Mat3 direction = Mat3::Identity();
  if (inInfo->Has(vtkDataObject::ORIGIN()))
  {
    origin = Eigen::Map<const Vec3>(inInfo->Get(vtkDataObject::ORIGIN()));
  }
  if (inInfo->Has(vtkDataObject::SPACING()))
  {
    spacing = Eigen::Map<const Vec3>(inInfo->Get(vtkDataObject::SPACING()));
  }
  if (inInfo->Has(vtkDataObject::DIRECTION()))
  {
    direction = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(inInfo->Get(vtkDataObject::DIRECTION()));
  }
  try
  {
    frame = GridFrame(extent, origin, spacing, direction);
    frame = cellData ? FrameOfCells(frame) : frame;
  }
  catch (const std::invalid_argument&)
  {
    return false; // an empty image, or one that RequestData will refuse
  }
  return true;
}

bool PromisesCellData(vtkInformation* arrayInfo, vtkInformation* inInfo)
{
  const int association = arrayInfo->Get(vtkDataObject::FIELD_ASSOCIATION());
  const char* name = arrayInfo->Get(vtkDataObject::FIELD_NAME());
  // Images announce point scalars also when they have none, so the data tell, where there are any.
  vtkImageData* image = vtkImageData::SafeDownCast(inInfo->Get(vtkDataObject::DATA_OBJECT()));
  const bool hasData = image && image->GetNumberOfPoints() > 0;
  const auto present = [&](int where) -> bool
  {
    if (hasData)
    {
      vtkDataSetAttributes* attributes = image->GetAttributes(where);
      return name ? attributes->HasArray(name) != 0 : attributes->GetScalars() != nullptr;
    }
    return name ? vtkDataObject::GetNamedFieldInformation(inInfo, where, name) != nullptr
                : vtkDataObject::GetActiveFieldInformation(inInfo, where, vtkDataSetAttributes::SCALARS) != nullptr;
  };
  return association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    (association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS &&
      !present(vtkDataObject::FIELD_ASSOCIATION_POINTS) && present(vtkDataObject::FIELD_ASSOCIATION_CELLS));
}
}
