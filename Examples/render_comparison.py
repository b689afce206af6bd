# SPDX-License-Identifier: BSD-3-Clause
"""Two interface meshes side by side, with their edges: pvbatch render_comparison.py LEFT.vtp RIGHT.vtp PICTURE.png"""
import os
import sys

from paraview.simple import ColorBy, CreateLayout, CreateView, Render, SaveScreenshot, Show, Text, XMLPolyDataReader

left, right, picture = sys.argv[1:4]
SIZE = [1800, 900]


def show(path, view):
    mesh = XMLPolyDataReader(FileName=[path])
    mesh.UpdatePipeline()
    shown = Show(mesh, view)
    shown.Representation = "Surface With Edges"
    shown.EdgeColor = [0.1, 0.1, 0.1]
    shown.LineWidth = 1.0
    # BoundaryLabels names the material on either side; its first component colours the surface by the material in front.
    ColorBy(shown, ("CELLS", "BoundaryLabels", "X"))
    shown.SetScalarBarVisibility(view, False)

    text = Text(Text=f"{os.path.basename(path)}: {mesh.GetDataInformation().GetNumberOfCells():,} triangles")
    label = Show(text, view)
    label.Color = [0, 0, 0]
    label.FontSize = 20
    return mesh


views = []
layout = CreateLayout("Comparison")
for number, path in enumerate([left, right]):
    view = CreateView("RenderView")
    layout.AssignView(0 if number == 0 else layout.SplitHorizontal(0, 0.5) + 1, view)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    show(path, view)
    views.append(view)
layout.SetSize(*SIZE)

# The same camera for both, from the side and a little above.
views[0].CameraViewUp = [0, 0, 1]
views[0].CameraPosition = [1.0, -1.6, 0.7]
views[0].CameraFocalPoint = [0, 0, 0]
views[0].ResetCamera()
for view in views[1:]:
    view.CameraViewUp = views[0].CameraViewUp
    view.CameraPosition = views[0].CameraPosition
    view.CameraFocalPoint = views[0].CameraFocalPoint
for view in views:
    Render(view)
SaveScreenshot(picture, layout, ImageResolution=SIZE)
