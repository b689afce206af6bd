# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the application before the playback of TestMaterialsTable.py, and looks at the mesh that comes of it."""
import os
import traceback

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
import numpy as np

verdict = os.environ["LABELMESH_VERDICT"]
state = os.environ["LABELMESH_STATE"]
session = os.environ["LABELMESH_SESSION"]


def say(text):
    with open(verdict, "w") as file:
        file.write(text)


def mesher():
    for source in simple.GetSources().values():
        if source.GetXMLName() == "LabelMesher":
            return source
    return None


def open_volume():
    volume = simple.OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha"))
    simple.Show(volume)
    simple.SetActiveSource(volume)


def categories(array):
    """{value: (name, colour)} of the colour map of an array."""
    colors = simple.GetColorTransferFunction(array)
    assert colors.InterpretValuesAsCategories, array
    texts, rgb = list(colors.Annotations), list(colors.IndexedColors)
    return {texts[2 * n]: (texts[2 * n + 1], rgb[3 * n:3 * n + 3]) for n in range(len(texts) // 2)}


def mean_edge(mesh, pair):
    labels = np.sort(vtk_to_numpy(mesh.GetCellData().GetArray("BoundaryLabels")), axis=1)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)[(labels == pair).all(axis=1)]
    points = vtk_to_numpy(mesh.GetPoints().GetData())[triangles]
    return np.linalg.norm(points - np.roll(points, 1, axis=1), axis=2).mean()


def check_edited(source, mesh):
    assert list(source.MaterialNames) == ["1", "upper"], source.MaterialNames
    assert list(source.MaterialColors) == [1, 1, 0, 0], source.MaterialColors
    assert list(source.MaterialRadii) == [1, 0.9, 2, 0.9], source.MaterialRadii
    assert list(source.MaterialMaximumLengths) == [], source.MaterialMaximumLengths
    assert list(source.InterfaceMaximumLengths) == [1, 2, 0.5], source.InterfaceMaximumLengths
    assert list(source.Labels) == [], source.Labels
    names = mesh.GetFieldData().GetAbstractArray("MaterialNames")
    assert "upper" in [names.GetValue(n) for n in range(names.GetNumberOfValues())]
    assert mean_edge(mesh, (1, 2)) < 0.7 < mean_edge(mesh, (0, 1)), (mean_edge(mesh, (1, 2)), mean_edge(mesh, (0, 1)))
    for array in ("BoundaryLabels", "Label"):
        assert categories(array)["1"] == ("upper", [1, 0, 0]), categories(array)
        assert categories(array)["2"][0] == "Label_2", categories(array)
    simple.SaveScreenshot(os.path.join(os.path.dirname(verdict), "edited.png"), simple.GetActiveView(),
                          ImageResolution=[800, 600])


def labels_of(mesh):
    array = mesh.GetCellData().GetArray("BoundaryLabels")
    return set(np.unique(vtk_to_numpy(array))) if array and mesh.GetNumberOfPolys() else set()


edited = False


def look(_caller, _event):
    """Called now and then by a timer: the script must return before the playback starts."""
    global edited
    if os.path.exists(verdict):
        return
    try:
        source = mesher()
        mesh = source.GetClientSideObject().GetOutputDataObject(0) if source else None
        if mesh is None:
            return
        labels = labels_of(mesh)
        if not edited and labels == {0, 1, 2}:
            check_edited(source, mesh)
            edited = True
        elif edited and labels == {0, 1}:
            assert list(source.Labels) == [1], source.Labels
            simple.SaveState(state)
            say("passed: edited, applied and saved")
    except Exception:
        say("failed: " + traceback.format_exc())


def look_at_the_servers_mesh(_caller, _event):
    source = mesher()
    if source and not os.path.exists(verdict) and source.GetDataInformation(0).GetNumberOfCells() > 0:
        names, triangles = list(source.MaterialNames), source.GetDataInformation(0).GetNumberOfCells()
        say(f"passed: {triangles} triangles on the server" if names == ["1", "upper"] and triangles > 500 else
            f"failed: {triangles} triangles, names {names}")


def watch(function):
    interactor = simple.GetActiveViewOrCreate("RenderView").GetInteractor()
    interactor.AddObserver("TimerEvent", function)
    interactor.CreateRepeatingTimer(300)


if session == "edit":
    open_volume()
    watch(look)
elif session == "reload":
    simple.LoadState(state)
    simple.SetActiveSource(mesher())
    say("passed: the state is there")  # the playback looks at the table
else:
    # Tries again until the server listens; both sides have the plugin by PV_PLUGIN_PATH.
    simple.Connect("127.0.0.1", int(os.environ["LABELMESH_PORT"]))
    open_volume()
    watch(look_at_the_servers_mesh)
