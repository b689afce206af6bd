# SPDX-License-Identifier: BSD-3-Clause
"""Two interface meshes side by side, with their edges: pvbatch render_comparison.py LEFT.vtp RIGHT.vtp PICTURE.png

The quarter nearest to the camera is left away, so that the interfaces inside can be seen too; triangles stay whole.
"""
import os
import sys

from paraview.simple import (Clip, ColorBy, CreateLayout, CreateView, GetColorTransferFunction, Render, SaveScreenshot, Show, Text,
                             XMLPolyDataReader)

left, right, picture = sys.argv[1:4]
SIZE = [2000, 1000]
VIEW_FROM = [0.85, -0.46, 0.26]  # from the meshes to the camera; the quarter cut away is x > centre, y < centre
PALETTE = [0.93, 0.69, 0.30, 0.42, 0.64, 0.84, 0.60, 0.78, 0.45, 0.85, 0.48, 0.45,
           0.66, 0.56, 0.78, 0.55, 0.75, 0.73, 0.90, 0.62, 0.76, 0.72, 0.66, 0.52]


def open_mesh(path):
    mesh = XMLPolyDataReader(FileName=[path])
    mesh.UpdatePipeline()
    return mesh


def cut_open(mesh, centre, size):
    clip = Clip(Input=mesh, ClipType="Box", Invert=0, Crinkleclip=1)
    clip.ClipType.Position = [centre[0], centre[1] - 2 * size, centre[2] - 2 * size]
    clip.ClipType.Length = [2 * size, 2 * size, 4 * size]
    return clip


meshes = [open_mesh(left), open_mesh(right)]
bounds = meshes[0].GetDataInformation().GetBounds()
centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
size = max(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))

# BoundaryLabels names the material on either side; its first component is never the background.
labels = GetColorTransferFunction("BoundaryLabels")
lowest, highest = meshes[0].CellData["BoundaryLabels"].GetRange(0)
labels.InterpretValuesAsCategories = 1
labels.Annotations = [text for label in range(int(lowest), int(highest) + 1) for text in (str(label), str(label))]
labels.IndexedColors = PALETTE

layout = CreateLayout("Comparison")
views = []
for number, (path, mesh) in enumerate(zip([left, right], meshes)):
    view = CreateView("RenderView")
    layout.AssignView(0 if number == 0 else layout.SplitHorizontal(0, 0.5) + 1, view)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = Show(cut_open(mesh, centre, size), view)
    shown.Representation = "Surface With Edges"
    shown.EdgeColor = [0.15, 0.15, 0.15]
    shown.Ambient = 0.25
    ColorBy(shown, ("CELLS", "BoundaryLabels", "X"))
    shown.SetScalarBarVisibility(view, False)

    caption = Show(Text(Text=f"{os.path.basename(path)}: {mesh.GetDataInformation().GetNumberOfCells():,} triangles"), view)
    caption.Color = [0, 0, 0]
    caption.FontSize = 20
    views.append(view)

layout.SetSize(*SIZE)

for view in views:
    Render(view)  # the first picture of a view resets its camera
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.54 * size
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[axis] + 3 * size * VIEW_FROM[axis] for axis in range(3)]
SaveScreenshot(picture, layout, ImageResolution=SIZE)
