// SPDX-License-Identifier: BSD-3-Clause
#include "WorkingImage.h"

#include "IndicatorCollection.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace LabelMesh
{
bool FindFrame(vtkAlgorithm* filter, vtkInformation* inInfo, GridFrame& source, int& padding)
{
  if (PublishedFrame(inInfo, source, padding))
  {
    return true;
  }
  int port = 0;
  vtkAlgorithm* producer = filter->GetInputAlgorithm(0, 0, port);
  if (producer)
  {
    producer->Update(port);
  }
  return PublishedFrame(inInfo, source, padding);
}

void PublishImage(vtkInformation* outInfo, const GridFrame* frame)
{
  static constexpr int nothing[6] = { 0, -1, 0, -1, 0, -1 };
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), frame ? frame->Extent().data() : nothing, 6);
  if (frame)
  {
    outInfo->Set(vtkDataObject::ORIGIN(), frame->Origin().data(), 3);
    outInfo->Set(vtkDataObject::SPACING(), frame->Spacing().data(), 3);
    double direction[9];
    for (int i = 0; i < 9; ++i)
    {
      direction[i] = frame->Direction()(i / 3, i % 3);
    }
    outInfo->Set(vtkDataObject::DIRECTION(), direction, 9);
  }
}

void AddImageArray(vtkImageData* image, const char* name, const std::vector<float>& values)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  image->GetPointData()->AddArray(array);
}
}
