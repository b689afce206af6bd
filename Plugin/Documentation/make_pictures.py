# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the help pages, one per filter: pvpython make_pictures.py VOLUME [FOLDER]

VOLUME is two_spheres.mha of Data/make_volumes.py. PV_PLUGIN_PATH names the folder of the plugin. The pictures are written
into filters/ beside this file, or into FOLDER.
"""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "Examples", "ParaView"))

import labelmesh_views  # noqa: E402
from paraview import simple  # noqa: E402
from paraview.simple import (ColorBy, Contour, CreateView, GetColorTransferFunction, OutputPort, SaveScreenshot,  # noqa: E402
                             Show, Slice)

folder = sys.argv[2] if len(sys.argv) > 2 else os.path.join(HERE, "filters")


def new_view(kind="RenderView"):
    view = CreateView(kind)
    view.ViewSize = [400, 300]
    return view


def save(name, view):
    SaveScreenshot(os.path.join(folder, name + ".png"), view, ImageResolution=[400, 300],
                   OverrideColorPalette="WhiteBackground", CompressionLevel="9")


def surfaces(name, collection, array, value):
    view = new_view()
    # Without the background, whose surface is the others' once more.
    materials = simple.ExtractBlock(Input=collection, Selectors=["/Root/Label_1", "/Root/Label_2"])
    shown = Show(Contour(Input=materials, ContourBy=["POINTS", array], Isosurfaces=[value]), view)
    ColorBy(shown, ("FIELD", "vtkBlockColors"))
    shown.SetScalarBarVisibility(view, False)
    labelmesh_views.look(view)
    save(name, view)


def slice_of(name, image, array, preset):
    view = new_view()
    view.OrientationAxesVisibility = 0
    plane = Slice(Input=image)
    plane.SliceType.Normal = [0, 1, 0]
    plane.UpdatePipeline()
    shown = Show(plane, view)
    ColorBy(shown, ("POINTS", array))
    GetColorTransferFunction(array).ApplyPreset(preset, True)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1, 0], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    save(name, view)


def mesh(name, port):
    view = new_view()
    clip = simple.Clip(Input=port, ClipType="Plane", Crinkleclip=1, Invert=0)
    clip.ClipType.Normal = [-0.6, 0.8, 0.0]
    shown = Show(clip, view)
    shown.Representation, shown.EdgeColor = "Surface With Edges", [0.3, 0.3, 0.3]
    ColorBy(shown, ("CELLS", "BoundaryLabels", "X"))
    shown.SetScalarBarVisibility(view, False)
    labelmesh_views.look(view)
    save(name, view)


mesher = labelmesh_views.open_volume(sys.argv[1], Epsilon=1.2, MaximumDeviation=0.6, Tetrahedra="Packed")
volume = mesher.Input
LABELS = ["POINTS", "MetaImage"]  # pvpython would take the default from the active source
split = simple.LabelSplit(Input=volume, LabelArray=LABELS)
tighten = simple.Tighten(Input=split)
indicators = simple.IndicatorReconstruct(Input=tighten)
indicators.UpdatePipeline()  # for the bounds, when it is sliced
sizing = simple.SizingField(Input=indicators, Epsilon=1.2, MaximumDeviation=0.6)
particles = simple.ParticleSampleCells(Input=indicators, Sizing=sizing)
stages = simple.DelaunayLabelMesh(Input=particles, Indicators=indicators)
grid = simple.GridLabelMesh(Input=volume, LabelArray=LABELS, TargetTriangles=3000)

slice_of("LabelSurvey", volume, "MetaImage", "Viridis (matplotlib)")
surfaces("LabelSplit", split, "Mask", 0.5)
surfaces("Tighten", tighten, "TightDistance", 0.0)
slice_of("IndicatorReconstruct", OutputPort(indicators, 1), "Margin", "Viridis (matplotlib)")
slice_of("SizingField", sizing, "TargetLength", "Viridis (matplotlib)")
mesh("DelaunayLabelMesh", OutputPort(stages, 0))
mesh("GridLabelMesh", OutputPort(grid, 0))

view = new_view()
labelmesh_views.show_tetrahedra(mesher, view)
save("LabelMesher", view)

view = new_view()
points = Show(OutputPort(particles, 0), view)
points.Representation, points.PointSize = "Points", 4.0
ColorBy(points, ("POINTS", "TargetLength"))
labelmesh_views.look(view)
save("ParticleSampleCells", view)

view = new_view()
labelmesh_views.show_exploded(mesher, 0.6, view)
save("ExplodeLabels", view)

view = new_view("XYBarChartView")
report = simple.LabelMeshReport(Input=OutputPort(mesher, 0), Tetrahedra=OutputPort(mesher, 4))
Show(OutputPort(report, 6), view)
view.LeftAxisTitle, view.BottomAxisTitle = "Cells", "Radius ratio"
save("LabelMeshReport", view)
