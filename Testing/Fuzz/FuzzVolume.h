// SPDX-License-Identifier: BSD-3-Clause
// Small label volumes of every awkward kind, each from a number.
#ifndef FuzzVolume_h
#define FuzzVolume_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>

struct FuzzVolume
{
  vtkSmartPointer<vtkImageData> Image; ///< active scalars of its points or its cells
  vtkIdType Background = 0;            ///< need not occur
  bool Solid = false;                  ///< two samples at least along each axis: a volume that has to be meshed
  std::string Words;                   ///< what it is, for a person
};

/// The same volume for the same seed, everywhere.
FuzzVolume MakeFuzzVolume(std::uint64_t seed);

#endif
