# SPDX-License-Identifier: BSD-3-Clause
"""The examples of views run; their pictures show something; and the states, theirs and those stored, load again.

    TestViews.py PVPYTHON EXAMPLES NAME
"""
import os
import re
import subprocess
import sys

from paraview.simple import GetSources, GetViews, LoadDistributedPlugin, LoadState, Render, ResetSession, SaveScreenshot
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

pvpython, examples, name = sys.argv[1:]
output, volumes = os.environ["LABELMESH_OUTPUT"], os.environ["LABELMESH_VOLUMES"]
# What has to be in a state, and on which port something has to be.
FILTERS = {"quality": ("LabelMesher", 0), "cells": ("LabelMesher", 3), "exploded": ("ExplodeLabels", 0),
           "tetrahedra": ("LabelMesher", 4), "report": ("LabelMeshReport", 6)}


def colors_of(picture):
    """How many colours a picture has: one or two if nothing is on it."""
    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    return len({tuple(pixel) for pixel in (pixels // 16).tolist()})


def check_state(path):
    text = open(path).read()
    files = re.findall(r'value="([^"]*\.mha)"', text)
    assert files and all(os.path.basename(file) == file for file in files), files
    ResetSession()
    LoadDistributedPlugin("LabelMesh")
    LoadState(path, data_directory=volumes)
    kind, port = FILTERS[name]
    found = [source for source in GetSources().values() if source.GetXMLName() == kind]
    assert len(found) == 1, GetSources()
    found[0].UpdatePipeline()
    data = found[0].GetDataInformation(port)
    assert data.GetNumberOfCells() + data.GetNumberOfRows() >= 50, (kind, port)
    view = [view for view in GetViews() if view.GetXMLName() == "RenderView"][0]
    Render(view)
    picture = os.path.join(output, "state.png")
    SaveScreenshot(picture, view, ImageResolution=[400, 300])
    assert colors_of(picture) > 20, f"{path}: there is nothing to see"


subprocess.run([pvpython, os.path.join(examples, name + ".py"), os.path.join(volumes, "grains.mha"), output], check=True)
assert colors_of(os.path.join(output, name + ".png")) > 20
check_state(os.path.join(output, name + ".pvsm"))
check_state(os.path.join(examples, "states", name + ".pvsm"))
print(f"{name}: the example and its states are right")
