// SPDX-License-Identifier: BSD-3-Clause
#include "RebuiltVoxels.h"

#include "Core/Parallel.h"
#include "LabelMeshNames.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>
#include <vtkVariant.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
/// Rebuilt labels, asked for at the samples of another grid.
class Rebuilt
{
public:
  Rebuilt(vtkImageData* image, const GridFrame& frame, Label outside)
    : Frame(frame)
    , Outside(outside)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(Names::Label);
    if (!array)
    {
      throw std::invalid_argument(std::string("The rebuilt labels have no point array '") + Names::Label +
        "'. Connect port 1 of Indicator Reconstruct.");
    }
    this->Labels = ReadLabelImage(image, array, false);
  }

  /// The labels at a row of samples along x.
  void Row(Index row, Label* to) const
  {
    const Lattice source = this->Labels.Frame.Samples(), target = this->Frame.Samples();
    const std::array<int, 6>&extent = this->Labels.Frame.Extent(), &own = this->Frame.Extent();
    const int y = own[2] + int(row % target.Dims[1]), z = own[4] + int(row / target.Dims[1]);
    for (int x = 0; x < target.Dims[0]; ++x)
    {
      const Vec3 index = this->Labels.Frame.ToIndex(this->Frame.ToWorld(own[0] + x, y, z));
      std::array<Index, 3> at{};
      bool inside = true;
      for (int a = 0; a < 3; ++a)
      {
        at[a] = Index(std::lround(index[a])) - extent[2 * a];
        inside = inside && at[a] >= 0 && at[a] < source.Dims[a];
      }
      to[x] = inside ? this->Labels.Labels[this->Labels.Ids[source.At(at[0], at[1], at[2])]] : this->Outside;
    }
  }

private:
  const GridFrame& Frame;
  Label Outside;
  LabelImage Labels;
};

struct Difference
{
  Index Voxel = 0;
  Label After = 0;
};
}

std::vector<Label> RebuiltLabelsAt(vtkImageData* rebuilt, const GridFrame& frame, Label outside)
{
  const Rebuilt labels(rebuilt, frame, outside);
  const Lattice target = frame.Samples();
  std::vector<Label> result(static_cast<std::size_t>(target.Size()));
  ParallelFor(0, Index(target.Dims[1]) * target.Dims[2], 0,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        labels.Row(row, result.data() + row * target.Dims[0]);
      }
    });
  return result;
}

void WriteRebuiltVoxels(vtkFieldData* fieldData, const LabelImage& volume, vtkImageData* rebuilt, Label background)
{
  const Rebuilt labels(rebuilt, volume.Frame, background);
  const auto& dims = volume.Frame.Samples().Dims;
  const std::vector<Difference> differences = ParallelCollect<Difference>(dims[2],
    [&](Index slice, std::vector<Difference>& found)
    {
      std::vector<Label> after(static_cast<std::size_t>(dims[0]));
      for (Index row = slice * dims[1]; row < (slice + 1) * dims[1]; ++row)
      {
        labels.Row(row, after.data());
        for (Index x = 0; x < dims[0]; ++x)
        {
          const Index voxel = row * dims[0] + x;
          if (after[x] != volume.Labels[volume.Ids[voxel]])
          {
            found.push_back({ voxel, after[x] });
          }
        }
      }
    });
  vtkNew<vtkTypeInt64Array> voxels, after;
  voxels->SetName(Names::RebuiltVoxels);
  after->SetName(Names::RebuiltLabels);
  for (const Difference& difference : differences)
  {
    voxels->InsertNextValue(difference.Voxel);
    after->InsertNextValue(difference.After);
  }
  fieldData->AddArray(voxels);
  fieldData->AddArray(after);
}

std::vector<Label> ReadRebuiltVoxels(vtkFieldData* fieldData, const LabelImage& volume)
{
  vtkDataArray* voxels = fieldData ? fieldData->GetArray(Names::RebuiltVoxels) : nullptr;
  vtkDataArray* labels = fieldData ? fieldData->GetArray(Names::RebuiltLabels) : nullptr;
  std::vector<Label> rebuilt;
  if (!voxels || !labels || voxels->GetNumberOfValues() != labels->GetNumberOfValues())
  {
    return rebuilt;
  }
  rebuilt.reserve(volume.Ids.size());
  for (const MaterialId id : volume.Ids)
  {
    rebuilt.push_back(volume.Labels[id]);
  }
  for (vtkIdType n = 0; n < voxels->GetNumberOfValues(); ++n)
  {
    const Index v = voxels->GetVariantValue(n).ToTypeInt64(); // doubles would round large labels
    if (v < 0 || v >= Index(rebuilt.size()))
    {
      throw std::invalid_argument("The rebuilt voxels are those of another volume: voxel " + std::to_string(v) +
        " of " + std::to_string(rebuilt.size()) + ". Connect the label volume that was meshed.");
    }
    rebuilt[v] = labels->GetVariantValue(n).ToTypeInt64();
  }
  return rebuilt;
}
}
