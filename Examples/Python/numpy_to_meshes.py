#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a numpy array of labels to numpy arrays of vertices and triangles, one mesh per material.

    PYTHONPATH=build/lib/python3.11/site-packages python3 numpy_to_meshes.py
"""
import numpy as np
from labelmesh import vtkLabelMesher
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkImageData


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


def arrays_of(mesh):
    """Vertices (n x 3, float64) and triangles (m x 3, indices) of a vtkPolyData."""
    vertices = vtk_to_numpy(mesh.GetPoints().GetData())
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vertices, triangles


def main():
    # Two balls, the second one without what belongs to the first.
    z, y, x = np.mgrid[:64, :64, :64]
    labels = np.zeros((64, 64, 64), np.uint8)
    labels[(x - 32) ** 2 + (y - 32) ** 2 + (z - 23) ** 2 < 15 ** 2] = 2
    labels[(x - 32) ** 2 + (y - 32) ** 2 + (z - 39) ** 2 < 17 ** 2] = 1

    mesher = vtkLabelMesher()
    mesher.SetInputData(image_of(labels, spacing=(0.5, 0.5, 0.5)))
    mesher.SetMaterialName(1, "upper")
    mesher.SetMaterialName(2, "lower")
    mesher.SetEpsilon(0.6)
    mesher.Update()

    # All interfaces in one mesh, each triangle once, with the labels of its two sides.
    vertices, triangles = arrays_of(mesher.GetOutput())
    sides = vtk_to_numpy(mesher.GetOutput().GetCellData().GetArray("BoundaryLabels"))
    between = triangles[(sides == (1, 2)).all(axis=1)]
    print(f"{len(vertices)} vertices, {len(triangles)} triangles, {len(between)} of them between 1 and 2")

    # And a closed surface per material.
    surfaces = mesher.GetSurfaces()
    for n in range(surfaces.GetNumberOfPartitionedDataSets()):
        name = surfaces.GetMetaData(n).Get(vtkCompositeDataSet.NAME())
        vertices, triangles = arrays_of(surfaces.GetPartition(n, 0))
        a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        print(f"{name}: {len(vertices)} vertices, {len(triangles)} triangles, volume {volume:.1f}")


if __name__ == "__main__":
    main()
