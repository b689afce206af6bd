# SPDX-License-Identifier: BSD-3-Clause
"""The package labelmesh and the command line make the same mesh, bit by bit, with one thread and with two."""
import os
import subprocess

import labelmesh
from labelmesh import vtkLabelMesher
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

volume = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")


def content(mesh):
    data = [mesh.GetPointData(), mesh.GetCellData()]
    arrays = {a.GetArrayName(n): vtk_to_numpy(a.GetArray(n)).tobytes() for a in data for n in range(a.GetNumberOfArrays())}
    return [vtk_to_numpy(mesh.GetPoints().GetData()).tobytes(), vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).tobytes(),
            arrays]


def by_command_line(threads):
    path = os.path.join(os.environ["LABELMESH_OUTPUT"], f"threads{threads}.vtp")
    subprocess.run([os.environ["LABELMESH_EXECUTABLE"], volume, "-o", path, "--threads", str(threads), "--quiet"], check=True)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


reader = vtkMetaImageReader()
reader.SetFileName(volume)
mesher = vtkLabelMesher()
mesher.SetInputConnection(reader.GetOutputPort())
mesher.Update()
mesh = mesher.GetOutput()

assert mesh.GetNumberOfPolys() > 500, mesh.GetNumberOfPolys()
one, two = content(by_command_line(1)), content(by_command_line(2))
assert one == two, "one thread and two threads differ"
assert content(mesh) == one, "Python and the command line differ"
print(f"labelmesh {labelmesh.__version__}: {mesh.GetNumberOfPolys()} triangles, the same from Python and the command line")
