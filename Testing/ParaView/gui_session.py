# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the application before the playback: opens a volume, and watches for the mesh that the playback makes."""
import os
import traceback

from paraview import simple

output = os.environ["LABELMESH_OUTPUT"]
verdict = os.path.join(output, "verdict.txt")


def say(text):
    with open(verdict, "w") as file:
        file.write(text)


def mesher():
    for (name, _), source in simple.GetSources().items():
        if source.GetXMLName() == "LabelMesher":
            return source
    return None


def look(_caller, _event):
    """Called now and then by a timer: the script must return before the playback starts."""
    if os.path.exists(verdict):
        return
    try:
        source = mesher()
        # Only what the application shows by itself: simple.GetRepresentation() would make what it does not find.
        if source is None or not any(r.Visibility and r.Input == source for r in view.Representations if hasattr(r, "Input")):
            return
        triangles = source.GetDataInformation(0).GetNumberOfCells()
        if triangles == 0:
            return
        picture = os.path.join(output, "gui.png")
        simple.ResetCamera()
        simple.SaveScreenshot(picture, simple.GetActiveView(), ImageResolution=[800, 600])
        assert triangles > 500, triangles
        assert os.path.getsize(picture) > 5000, "the picture is empty"
        say(f"passed: {triangles} triangles")
    except Exception:
        say("failed: " + traceback.format_exc())


volume = simple.OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha"))
simple.Show(volume)
simple.SetActiveSource(volume)
view = simple.GetActiveViewOrCreate("RenderView")
interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", look)
interactor.CreateRepeatingTimer(300)
