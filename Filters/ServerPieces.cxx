// SPDX-License-Identifier: BSD-3-Clause
#include "ServerPieces.h"

#include <vtkAlgorithm.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkInformationIntegerKey* AllInFirstPieceKey()
{
  static vtkInformationIntegerKey* const key = new vtkInformationIntegerKey("ALL_IN_FIRST_PIECE", "LabelMesh");
  return key;
}

bool IsAllInFirstPiece(vtkInformation* inInfo)
{
  vtkInformation* const info = BehindPostFilters(inInfo);
  vtkExecutive* const producer = vtkExecutive::PRODUCER()->GetExecutive(info);
  return producer &&
    producer->GetAlgorithm()
      ->GetOutputPortInformation(vtkExecutive::PRODUCER()->GetPort(info))
      ->Has(AllInFirstPieceKey());
}

void RequestWholeExtent(vtkInformation* inInfo)
{
  if (inInfo->Has(Pipeline::WHOLE_EXTENT()))
  {
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
}

std::string WordsOf(const int extent[6])
{
  std::string words;
  for (int a = 0; a < 3; ++a)
  {
    words += (a > 0 ? ", " : "") + std::to_string(extent[2 * a]) + " to " + std::to_string(extent[2 * a + 1]);
  }
  return words;
}
}

Piece RequestedPiece(vtkInformation* request, vtkInformationVector* outputVector)
{
  const int port = request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : 0;
  vtkInformation* const info = outputVector->GetInformationObject(std::max(port, 0));
  Piece piece;
  if (info && info->Has(Pipeline::UPDATE_PIECE_NUMBER()) && info->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    piece.Number = info->Get(Pipeline::UPDATE_PIECE_NUMBER());
    piece.Count = info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  }
  return piece;
}

void PromiseFirstPiece(vtkInformation* portInfo)
{
  portInfo->Set(AllInFirstPieceKey(), 1);
}

vtkInformation* BehindPostFilters(vtkInformation* inInfo)
{
  vtkExecutive* producer = vtkExecutive::PRODUCER()->GetExecutive(inInfo);
  while (producer && producer->GetAlgorithm()->IsA("vtkPVPostFilter") &&
    producer->GetAlgorithm()->GetNumberOfInputConnections(0) > 0)
  {
    inInfo = producer->GetInputInformation(0, 0);
    producer = vtkExecutive::PRODUCER()->GetExecutive(inInfo);
  }
  return inInfo;
}

void RequestAll(vtkInformation* inInfo)
{
  RequestWholeExtent(inInfo);
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

void RequestAllPromised(vtkInformationVector** inputVector, int ports)
{
  for (int port = 0; port < ports; ++port)
  {
    for (int n = 0; n < inputVector[port]->GetNumberOfInformationObjects(); ++n)
    {
      vtkInformation* const inInfo = inputVector[port]->GetInformationObject(n);
      if (IsAllInFirstPiece(inInfo))
      {
        RequestWholeExtent(inInfo);
        inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      }
      else
      {
        RequestAll(inInfo);
      }
    }
  }
}

void RequireWhole(vtkInformation* inInfo, vtkImageData* image)
{
  if (!inInfo->Has(Pipeline::WHOLE_EXTENT()))
  {
    return;
  }
  const int* const whole = inInfo->Get(Pipeline::WHOLE_EXTENT());
  const int* const extent = image->GetExtent();
  for (int a = 0; a < 3; ++a)
  {
    if (extent[2 * a] > whole[2 * a] || extent[2 * a + 1] < whole[2 * a + 1])
    {
      throw std::invalid_argument("The image is only there in part (samples " + WordsOf(extent) + " of " +
        WordsOf(whole) +
        "): its source gives each process of the server a part, also when asked for the whole. Write "
        "it to one file and open that, or use a server of one process.");
    }
  }
}
}
