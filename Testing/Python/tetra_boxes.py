# SPDX-License-Identifier: BSD-3-Clause
"""Labelled tetrahedra of which everything is known."""
import itertools

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid


def box(size, origin, label_of):
    """Unit cubes with a label each, cut into six tetrahedra that conform: points, corners, labels. Every other
    tetrahedron is turned inside out."""
    def index(at):
        return at[0] + (size[0] + 1) * (at[1] + (size[1] + 1) * at[2])

    points = [(i, j, k) for k in range(size[2] + 1) for j in range(size[1] + 1) for i in range(size[0] + 1)]
    corners, labels = [], []
    for cube in itertools.product(*map(range, size)):
        for order in itertools.permutations(range(3)):
            at, tetra = list(cube), [index(cube)]
            for axis in order:
                at[axis] += 1
                tetra.append(index(at))
            corners.append(tetra)
            labels.append(label_of(*cube))
    return np.array(points) + origin, np.array(corners), np.array(labels)


def as_grid(points, corners, labels, names):
    """A vtkUnstructuredGrid as LabelMesh makes it; `names` by label, the background 0."""
    grid = vtkUnstructuredGrid()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    grid.SetPoints(vtk_points)
    grid.Allocate(len(corners))
    for tetra in corners.tolist():
        grid.InsertNextCell(VTK_TETRA, 4, tetra)

    def add(data, name, values):
        array = numpy_to_vtk(np.array(values, dtype=np.int64), deep=True)
        array.SetName(name)
        data.AddArray(array)

    add(grid.GetCellData(), "Label", labels)
    add(grid.GetFieldData(), "Labels", list(names))
    add(grid.GetFieldData(), "BackgroundLabel", [0])
    strings = vtkStringArray()
    strings.SetName("MaterialNames")
    for name in names.values():
        strings.InsertNextValue(name)
    grid.GetFieldData().AddArray(strings)
    return grid
