// SPDX-License-Identifier: BSD-3-Clause
// Reading label volumes with their orientation.
#ifndef ReadVolume_h
#define ReadVolume_h

#include "ReadNrrd.h"

#include <vtkSmartPointer.h>

#include <map>
#include <string>

class vtkImageData;

/// Reads .mha, .mhd, .nrrd, .nii, .nii.gz or .vti: NRRD by ReadNrrd, all others by VTK's readers. `styles`: what the
/// file says of its labels.
///
/// Orientation: VTK's reader of MetaImage drops it, so TransformMatrix is read from the header here. A NIfTI file's
/// sform, or else its qform, is used where it is a rotation (perhaps mirrored); the coordinates are the file's own
/// (NIfTI's right-anterior-superior; MetaImage and NRRD mostly left-posterior-superior): they are not converted. Throws
/// std::runtime_error with a sentence: no such file, unknown suffix, broken or truncated, not a volume.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& file, std::map<long long, LabelStyle>& styles);

#endif
