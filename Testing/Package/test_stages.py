#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Cxx: test_stages.py PROGRAM. The chain stage by stage makes the mesh of the command line, to the last bit."""
import os
import subprocess
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def mesh_of(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    return (vtk_to_numpy(mesh.GetPoints().GetData()).tobytes(),
            vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).tobytes())


volume = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")
said = subprocess.run([sys.argv[1], volume, "stages.vtp"], check=True, capture_output=True, text=True, timeout=120).stdout
print(said)
assert "3 materials" in said and "particles predicted" in said and "\ncertified: " in said, said
subprocess.run([os.environ["LABELMESH_EXECUTABLE"], volume, "-o", "whole.vtp", "--quiet"], check=True)
stages, whole = mesh_of("stages.vtp"), mesh_of("whole.vtp")
assert len(stages[0]) > 10000
assert stages == whole, "the stages' mesh differs from the command line's"
