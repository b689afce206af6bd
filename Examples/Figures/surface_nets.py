# SPDX-License-Identifier: BSD-3-Clause
"""All interfaces by vtkSurfaceNets3D with its own smoothing: surface_nets.py LABELS.mha MESH.vtp

Needs VTK 9.3 or later. As a program it runs with another Python and VTK than LabelMesh's.
"""
import sys

import numpy as np
from vtkmodules import vtkFiltersCore
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from mesh import Mesh, read_volume


def why_not():
    """Why this VTK cannot, or None."""
    if hasattr(vtkFiltersCore, "vtkSurfaceNets3D"):
        return None
    return (f"VTK {vtkVersion.GetVTKVersion()} has no vtkSurfaceNets3D, which came with 9.3; "
            "--vtk-python names a Python that has it")


def surface_nets(volume, background=0):
    nets = vtkFiltersCore.vtkSurfaceNets3D()
    nets.SetInputData(volume.image)
    labels = [int(label) for label in np.unique(volume.labels) if label != background]
    nets.SetNumberOfLabels(len(labels))
    for number, label in enumerate(labels):
        nets.SetLabel(number, label)
    nets.SetBackgroundLabel(background)
    nets.SetOutputMeshTypeToTriangles()
    nets.Update()
    surface = nets.GetOutput()
    return Mesh(vtk_to_numpy(surface.GetPoints().GetData()),
                vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3),
                vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels")).astype(int))


def main(volume, output):
    if why_not():
        print(why_not(), file=sys.stderr)
        return 1
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface_nets(read_volume(volume)).polydata())
    writer.SetDataModeToBinary()  # Debian's VTK cannot read the others
    writer.SetFileName(str(output))
    return 0 if writer.Write() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
