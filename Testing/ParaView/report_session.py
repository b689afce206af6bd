# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the application before the playback, which chooses Label Mesh Report and presses Apply: makes a mesh, and
watches for the table and the histogram."""
import os
import traceback

from paraview import simple

output = os.environ["LABELMESH_OUTPUT"]
verdict = os.path.join(output, "verdict.txt")


def say(text):
    with open(verdict, "w") as file:
        file.write(text)


def shown(kind):
    """The port of the report that a view of a kind shows by itself, or None."""
    for shown_in in simple.GetViews(kind):
        for representation in shown_in.Representations:
            if representation.Visibility and representation.Input.GetXMLName() == "LabelMeshReport":
                return representation.Input.Port
    return None


def look(_caller, _event):
    if os.path.exists(verdict):
        return
    try:
        ports = shown("SpreadSheetView"), shown("XYBarChartView")
        if None in ports:
            return
        assert ports == (0, 6), ports
        chart = [r for r in simple.GetViews("XYBarChartView")[0].Representations][0]
        assert chart.XArrayName == "bin_extents" and not chart.UseIndexForXAxis, chart.XArrayName
        assert list(chart.SeriesVisibility) == ["Triangles"], chart.SeriesVisibility
        say("passed: a table and a histogram")
    except Exception:
        say("failed: " + traceback.format_exc())


volume = simple.OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha"))
volume.UpdatePipeline()
mesher = simple.LabelMesher(Input=volume)
simple.Show(mesher)
simple.SetActiveSource(mesher)
interactor = simple.GetActiveViewOrCreate("RenderView").GetInteractor()
interactor.AddObserver("TimerEvent", look)
interactor.CreateRepeatingTimer(300)
