// SPDX-License-Identifier: BSD-3-Clause
// Label volumes in NRRD files (teem's format), also as 3D Slicer writes segmentations (.seg.nrrd).
#ifndef ReadNrrd_h
#define ReadNrrd_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <optional>
#include <string>

/// What a file says of a label: 3D Slicer's Segment<n>_Name and Segment<n>_Color beside Segment<n>_LabelValue.
struct LabelStyle
{
  std::string Name;                           ///< empty: none
  std::optional<std::array<double, 3>> Color; ///< 0 to 1
};

/// An image with point scalars "Labels", where `space directions` and `space origin` put it, in the file's own space.
/// Data attached or in one file of their own, raw, gzip or text. vtkNrrdReader is not used: at broken files it crashes
/// or does not come back. Throws std::runtime_error with the rest of a sentence that begins with the file's name.
vtkSmartPointer<vtkImageData> ReadNrrd(const std::string& file, std::map<long long, LabelStyle>& styles);

#endif
