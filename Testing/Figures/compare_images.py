# SPDX-License-Identifier: BSD-3-Clause
"""Pictures against their baselines, with VTK's measure of difference."""
from pathlib import Path

from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkImagingCore import vtkImageExtractComponents

# Of vtkImageDifference: pixels are compared with their neighbours too. Fonts and the rounding of colours may differ from
# one system to another; a part of a picture that is wrong gives hundreds.
THRESHOLD = 15.0


def colours(path):
    """Red, green and blue of a PNG, as a source."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    channels = vtkImageExtractComponents()
    channels.SetInputConnection(reader.GetOutputPort())
    channels.SetComponents(0, 1, 2)
    channels.Update()
    return channels


def difference(made, baseline, output):
    """The error of a picture: 0 for the same. Above THRESHOLD the difference is written to `output`."""
    first, second = colours(made), colours(baseline)
    if first.GetOutput().GetDimensions() != second.GetOutput().GetDimensions():
        Path(output).write_bytes(Path(made).read_bytes())
        return float("inf")
    compared = vtkImageDifference()
    compared.SetInputConnection(first.GetOutputPort())
    compared.SetImageConnection(second.GetOutputPort())
    compared.Update()
    error = compared.GetThresholdedError()
    if error > THRESHOLD:
        writer = vtkPNGWriter()
        writer.SetInputConnection(compared.GetOutputPort())
        writer.SetFileName(str(output))
        writer.Write()
    return error
