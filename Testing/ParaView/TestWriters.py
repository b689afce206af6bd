# SPDX-License-Identifier: BSD-3-Clause
"""Save Data writes .msh and .inp: what the writers write in C++, byte by byte; only tetrahedra with labels are offered."""
import os
import sys
from pathlib import Path

from paraview import servermanager
from paraview.simple import LoadPlugin, SaveData, Sphere, TrivialProducer
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray, vtkTypeInt64Array
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid

import labelmesh

LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=False, ns=globals())


def integers(name, values):
    array = vtkTypeInt64Array()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array


def two_tetrahedra():
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)):
        points.InsertNextPoint(point)
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_TETRA, 4, (0, 1, 2, 3))
    grid.InsertNextCell(VTK_TETRA, 4, (4, 1, 2, 3))
    names = vtkStringArray()
    names.SetName("MaterialNames")
    for name in ("outside", "near", "far"):
        names.InsertNextValue(name)
    grid.GetCellData().AddArray(integers("Label", (1, 2)))
    for array in (integers("Labels", (0, 1, 2)), integers("BackgroundLabel", (0,)), names):
        grid.GetFieldData().AddArray(array)
    return grid


def written(writer, name):
    writer.SetInputData(grid)
    writer.SetFileName(name)
    assert writer.Write() == 1
    return Path(name).read_bytes()


grid = two_tetrahedra()
source = TrivialProducer()
source.GetClientSideObject().SetOutput(grid)
source.UpdatePipeline()

gmsh = labelmesh.vtkGmshLabelMeshWriter()
text = written(gmsh, "cxx.msh")
assert b'"near_far"' in text, text
SaveData("text.msh", proxy=source)
assert Path("text.msh").read_bytes() == text
gmsh.BinaryOn()
SaveData("binary.msh", proxy=source, Binary=1)
assert Path("binary.msh").read_bytes() == written(gmsh, "cxx.msh") != text
SaveData("mesh.inp", proxy=source)
mesh = Path("mesh.inp").read_bytes()
assert mesh == written(labelmesh.vtkAbaqusLabelMeshWriter(), "cxx.inp")
assert b"*NSET, NSET=near_far\n" in mesh, mesh

manager = servermanager.ProxyManager().SMProxyManager
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
offered = factory.GetSupportedFileTypes(source.SMProxy, 0)
assert "msh" in offered and "inp" in offered, offered
surface = Sphere()
surface.UpdatePipeline()
offered = factory.GetSupportedFileTypes(surface.SMProxy, 0)
assert "msh" not in offered and "inp" not in offered, offered

failures = []
for name in ("GmshLabelMeshWriter", "AbaqusLabelMeshWriter"):
    proxy = manager.NewProxy("writers", name)
    if len(proxy.GetDocumentation().GetDescription().strip()) < 100 or not proxy.GetDocumentation().GetShortHelp():
        failures.append(f"{name} is not documented")
    core = manager.NewProxy("internal_writers", name + "Core")
    algorithm = getattr(labelmesh, "vtk" + name)()
    if core.GetVTKClassName() != "vtk" + name:
        failures.append(f"{name} writes with a {core.GetVTKClassName()}")
    if name.startswith("Gmsh") and core.GetProperty("Binary").GetElement(0) != algorithm.GetBinary():
        failures.append("Binary has another default than in C++")
print("\n".join(failures) or "Save Data writes both")
sys.exit(1 if failures else 0)
