# SPDX-License-Identifier: BSD-3-Clause
"""The stages of the method that the explaining figures look into: masks, tightened distances, indicator functions."""
import numpy as np
from labelmesh import vtkIndicatorReconstruct, vtkLabelSplit, vtkTighten
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData


def image_of(labels, spacing=(1, 1, 1), origin=(0, 0, 0)):
    """A vtkImageData of labels[z, y, x]."""
    image = vtkImageData()
    image.SetDimensions(labels.shape[::-1])
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    scalars = numpy_to_vtk(np.ascontiguousarray(labels).ravel(), deep=True)
    scalars.SetName("Labels")
    image.GetPointData().SetScalars(scalars)
    return image


def split(image, labels=(), resampling=1.0):
    stage = vtkLabelSplit()
    stage.SetInputData(image)
    for label in labels:
        stage.AddLabel(int(label))
    stage.SetResamplingFactor(resampling)
    return stage


def tighten(masks, radius=None):
    """With a radius the paper's smoothing, else the default."""
    stage = vtkTighten()
    stage.SetInputConnection(masks.GetOutputPort())
    if radius is not None:
        stage.SetSmoothingToTightening()
        stage.SetRadius(radius)
        stage.AddObserver("WarningEvent", lambda *_: None)  # that material is lost, which figure 4 is about
    stage.Update()
    return stage


def indicators(distances, resolution=1.0, inspected=(), perturbation=None):
    stage = vtkIndicatorReconstruct()
    stage.SetInputConnection(distances.GetOutputPort())
    stage.SetImageResolution(resolution)
    for label in inspected:
        stage.AddInspectedLabel(int(label))
    if perturbation is not None:
        stage.SetPerturbation(perturbation)
    stage.Update()
    return stage


def block(stage, label):
    """The image of a material in the stage's collection."""
    collection = stage.GetOutputDataObject(0)
    for number in range(collection.GetNumberOfPartitionedDataSets()):
        image = collection.GetPartition(number, 0)
        if image and image.GetFieldData().GetArray("Label").GetValue(0) == label:
            return image
    raise KeyError(f"there is no material {label}")


def samples(image, name):
    """The array [z, y, x], and the position of its first sample."""
    array = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(image.GetDimensions()[::-1])
    low = image.GetExtent()[::2]
    return array, np.array(image.GetOrigin()) + np.array(low) * image.GetSpacing()
