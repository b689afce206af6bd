# SPDX-License-Identifier: BSD-3-Clause
"""Views of the meshes of Label Mesher, for pvpython, pvbatch and ParaView's Python shell.

    mesher = labelmesh_views.open_volume("grains.mha")
    labelmesh_views.show_quality(mesher)

Each show_ function works on the active view, or on the one that it is given, and returns what it made, to go on with.
The plugin is found by PV_PLUGIN_PATH. The scripts beside this file use one function each.
"""
import os
import re

from paraview import simple
from paraview.simple import (Clip, ColorBy, CreateView, GetActiveViewOrCreate, GetColorTransferFunction, GetLayout,
                             GetScalarBar, LoadDistributedPlugin, OpenDataFile, OutputPort, Render, ResetCamera,
                             SaveScreenshot, SaveState, Show, Threshold)

INTERFACES, SURFACES, PARTICLES, CURVES, TETRAHEDRA = range(5)  # output ports of Label Mesher
LOOK_FROM = [0.7, -1.0, 0.6]  # from the mesh to the camera


def open_volume(path, **properties):
    """Label Mesher on a volume, with its properties by keyword, up to date."""
    volume = OpenDataFile(path)
    volume.UpdatePipeline()  # the list of arrays is empty before
    LoadDistributedPlugin("LabelMesh")  # its filters are in paraview.simple from here on
    mesher = simple.LabelMesher(Input=volume, **properties)
    mesher.UpdatePipeline()
    return mesher


def _view(view):
    view = view or GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 0
    return view


def look(view=None):
    """The camera on all that is shown, from above and in front."""
    view = _view(view)
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = LOOK_FROM
    view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)
    Render(view)


def color_by_quality(shown, view, lowest=0.5):
    """Colours cells by RadiusRatio, from 1 (light: equilateral) down to a fixed one (dark), so that meshes compare."""
    ColorBy(shown, ("CELLS", "RadiusRatio"))
    colors = GetColorTransferFunction("RadiusRatio")
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.RescaleTransferFunction(lowest, 1.0)
    shown.Representation = "Surface With Edges"
    shown.EdgeColor = [0.3, 0.3, 0.3]
    shown.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle = "Radius ratio", ""
    bar.WindowLocation = "Upper Right Corner"


def color_plainly(shown, color):
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = color


def show_quality(mesher, view=None):
    """The interface triangles, coloured by their shape."""
    view = _view(view)
    shown = Show(OutputPort(mesher, INTERFACES), view)
    color_by_quality(shown, view)
    look(view)
    return shown


def show_cells(mesher, view=None):
    """The curves where three materials meet as tubes, the points where four meet as spheres, in the transparent mesh."""
    view = _view(view)
    surface = Show(OutputPort(mesher, INTERFACES), view)
    color_plainly(surface, [0.7, 0.7, 0.7])
    surface.Opacity = 0.15
    curves = Show(OutputPort(mesher, CURVES), view)
    color_plainly(curves, [0.85, 0.35, 0.10])
    curves.LineWidth = 5.0
    curves.RenderLinesAsTubes = 1
    points = Threshold(Input=OutputPort(mesher, PARTICLES), Scalars=["POINTS", "CellDimension"])
    points.ThresholdMethod = "Below Lower Threshold"
    points.LowerThreshold = 0.5  # set after the array, which sets both to its range
    spheres = Show(points, view)
    color_plainly(spheres, [0.10, 0.30, 0.70])
    spheres.Representation = "Points"
    spheres.PointSize = 14.0
    spheres.RenderPointsAsSpheres = 1
    look(view)
    return surface, curves, spheres


def show_exploded(mesher, factor=0.5, view=None):
    """The materials' surfaces, moved apart; the factor is a slider in the panel of Explode Labels."""
    view = _view(view)
    exploded = simple.ExplodeLabels(Input=OutputPort(mesher, SURFACES), Factor=factor)
    shown = Show(exploded, view)
    ColorBy(shown, ("FIELD", "vtkBlockColors"))
    shown.Representation = "Surface With Edges"
    shown.EdgeColor = [0.3, 0.3, 0.3]
    shown.SetScalarBarVisibility(view, False)
    look(view)
    return exploded


def show_tetrahedra(mesher, view=None):
    """Half of the tetrahedra, whole, coloured by their shape. The plane can be dragged in the view."""
    view = _view(view)
    if mesher.Tetrahedra == "Off":
        mesher.Tetrahedra = "Packed"
    clip = Clip(Input=OutputPort(mesher, TETRAHEDRA), ClipType="Plane", Crinkleclip=1, Invert=0)
    clip.ClipType.Normal = [0.0, 1.0, 0.0]
    shown = Show(clip, view)
    color_by_quality(shown, view, lowest=0.0)
    look(view)
    return clip


def show_report(mesher, view=None):
    """The report: the table of materials, and the histogram of radius ratios, in views of their own beside this one."""
    view = _view(view)
    report = simple.LabelMeshReport(Input=OutputPort(mesher, INTERFACES))
    layout = GetLayout(view)
    chart, table = CreateView("XYBarChartView"), CreateView("SpreadSheetView")
    right = layout.SplitHorizontal(layout.GetViewLocation(view), 0.5) + 1
    layout.AssignView(right, chart)
    layout.AssignView(layout.SplitVertical(right, 0.5) + 1, table)
    Show(OutputPort(report, 0), table)
    Show(OutputPort(report, 6), chart)
    chart.LeftAxisTitle, chart.BottomAxisTitle = "Triangles", "Radius ratio"
    return report


def _make_portable(state):
    """Leaves files without their folders in a state, and leaves out the domains, which nobody reads back."""
    with open(state) as file:
        text = file.read()
    text = re.sub(r'value="[^"]*/([^"/]+\.(?:mha|mhd|nrrd|nii|vti))"', r'value="\1"', text)
    text = re.sub(r"\s*<Domain [^>]*/>|\s*<Domain [^>]*[^/]>.*?</Domain>", "", text, flags=re.DOTALL)
    with open(state, "w") as file:
        file.write(re.sub(r"^ +", "", text, flags=re.MULTILINE))


def save(name, folder=".", shown=None):
    """A picture, NAME.png, of a view (the active one) or a layout, and the state, NAME.pvsm.

    The state names the volume without its folder: choose the folder as Data Directory when loading it.
    """
    SaveScreenshot(os.path.join(folder, name + ".png"), shown or GetActiveViewOrCreate("RenderView"),
                   ImageResolution=[800, 600], OverrideColorPalette="WhiteBackground")
    state = os.path.join(folder, name + ".pvsm")
    SaveState(state)
    _make_portable(state)
