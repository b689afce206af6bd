# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the application: Label Mesher gets long work, and its starts and ends are written down. The playback chooses
it in the menu and presses Apply, TestAbort.py presses the Escape key."""
import os
import time

from paraview import simple

output = os.environ["LABELMESH_OUTPUT"]


def note(what):
    with open(os.path.join(output, "abort.txt"), "a") as file:
        file.write(f"{what} {time.time():.3f}\n")


class Watch:
    """The longest time between two looks at the window's events is what the user feels."""
    last = None
    aborted = False

    def start(self, _caller, _event):
        self.last = time.time()
        note("start")

    def progress(self, caller, _event):
        now = time.time()
        if self.last and now - self.last > 0.2:
            note(f"gap:{now - self.last:.2f}:{(caller.GetProgressText() or '').replace(' ', '_')}")
        self.last = now

    def end(self, caller, _event):
        self.aborted = self.aborted or caller.GetAbortExecute()
        note(f"end:{caller.GetAbortExecute()}:{caller.GetOutputDataObject(0).GetNumberOfPoints()}")


def prepare(_caller, _event):
    """Called now and then by a timer: makes the work of the filter that the playback creates long."""
    for source in simple.GetSources().values():
        if source.GetXMLName() == "LabelMesher" and watch.aborted:
            watch.aborted = False
            source.ResamplingFactor = 1.0
        elif source.GetXMLName() == "LabelMesher" and watch.last is None:
            watch.last = 0
            source.ResamplingFactor = 3.0
            algorithm = source.GetClientSideObject()
            algorithm.AddObserver("StartEvent", watch.start)
            algorithm.AddObserver("ProgressEvent", watch.progress)
            algorithm.AddObserver("EndEvent", watch.end)


watch = Watch()
volume = simple.OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], "grains.mha"))
simple.Show(volume)
simple.SetActiveSource(volume)
interactor = simple.GetActiveViewOrCreate("RenderView").GetInteractor()
interactor.AddObserver("TimerEvent", prepare)
interactor.CreateRepeatingTimer(300)
