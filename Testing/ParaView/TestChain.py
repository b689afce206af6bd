# SPDX-License-Identifier: BSD-3-Clause
"""The filters one after the other give what Label Mesher gives, byte by byte; and the baseline and the report run."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from common import arrays, blocks, content, open_volume, output  # noqa: E402

from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

from paraview.simple import Calculator, LoadPlugin, OutputPort, XMLPolyDataReader  # noqa: E402

LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=False, ns=globals())



def grid_content(grid):
    """All that makes a grid of tetrahedra: its bytes."""
    return (vtk_to_numpy(grid.GetPoints().GetData()).tobytes(), arrays(grid.GetCellData()),
            vtk_to_numpy(grid.GetCells().GetConnectivityArray()).tobytes())


volume = open_volume("two_spheres_small")
# Said, not left to the default: with an input given by keyword, pvpython takes the default from the active source.
LABELS = ["POINTS", "MetaImage"]

split = LabelSplit(Input=volume, LabelArray=LABELS)
split.MaterialNames = ["1", "upper", "2", "lower"]
split.MaterialColors = [1, 0.9, 0.2, 0.1, 2, 0.1, 0.2, 0.9]
tighten = Tighten(Input=split)
tighten.MaterialRadii = [2, 0.8]
indicators = IndicatorReconstruct(Input=tighten)
sizing = SizingField(Input=indicators)
sizing.MaximumLength = 4.0
particles = ParticleSampleCells(Input=indicators, Sizing=sizing)
mesh = DelaunayLabelMesh(Input=particles, Indicators=indicators)

whole = LabelMesher(Input=volume, LabelArray=LABELS)
whole.MaterialNames = split.MaterialNames
whole.MaterialColors = split.MaterialColors
whole.MaterialRadii = tighten.MaterialRadii
whole.MaximumLength = sizing.MaximumLength

names = [name for name, _ in blocks(output(split))]
assert {"upper", "lower"} <= set(names), names
colour = dict(blocks(output(split)))["upper"].GetFieldData().GetArray("Color").GetTuple3(0)
assert colour == (0.9, 0.2, 0.1), colour

interfaces = output(mesh)
assert interfaces.GetNumberOfPolys() > 500, interfaces.GetNumberOfPolys()
assert interfaces.GetCellData().GetArray("BoundaryLabels") is not None
for port, (stage, stage_port) in enumerate([(mesh, 0), (mesh, 1), (particles, 0), (particles, 1)]):
    assert content(output(whole, port)) == content(output(stage, stage_port)), f"port {port} of Label Mesher differs"
assert [name for name, _ in blocks(output(mesh, 1))] == ["upper", "lower"]

particles.SampleVolume = 1
mesh.Tetrahedra = "Packed"
whole.Tetrahedra = "Packed"
tetrahedra = output(mesh, 2)
assert tetrahedra.GetNumberOfCells() > 1000, tetrahedra.GetNumberOfCells()
assert grid_content(output(whole, 4)) == grid_content(tetrahedra), "port 4 of Label Mesher differs"
assert content(output(mesh)) == content(interfaces), "tetrahedra changed the surface"
whole.Tetrahedra = "Off"

# The chain is live: other sizing, other mesh; the same again, the same mesh.
before = content(interfaces)
whole.MaximumLength = 2.0
assert content(output(whole)) != before
whole.MaximumLength = 4.0
assert content(output(whole)) == before

# A change runs the stages that it concerns, and no others; what the panel says of them is known.
counted = LabelMesher(Input=volume, LabelArray=LABELS, MaximumLength=4.0)
for change, value, runs in (("Epsilon", 0.6, [1, 1, 1, 1, 1, 1]), ("Epsilon", 0.7, [1, 1, 1, 2, 2, 2]),
                            ("Seed", 2, [1, 1, 1, 2, 3, 3]), ("ImprovePasses", 2, [1, 1, 1, 2, 3, 4]),
                            ("Radius", 0.8, [2, 2, 2, 3, 4, 5])):
    counted.SetPropertyWithName(change, value)
    counted.UpdatePipeline()
    counted.UpdatePropertyInformation()
    assert list(counted.GetPropertyValue("StageRuns")) == runs, (change, list(counted.GetPropertyValue("StageRuns")))
assert counted.GetPropertyValue("NumberOfTriangles") == output(counted).GetNumberOfPolys() > 500
assert counted.GetPropertyValue("NumberOfParticles") == output(counted, 2).GetNumberOfPoints()
assert abs(counted.GetPropertyValue("PredictedParticles") / counted.GetPropertyValue("NumberOfParticles") - 1) < 0.3
assert all(seconds > 0 for seconds in counted.GetPropertyValue("StageSeconds"))

sizing.UpdatePropertyInformation()
assert sizing.GetPropertyValue("PredictedParticles") > 100

rebuilt = output(indicators, 1)
assert rebuilt.GetPointData().GetArray("Label") is not None and rebuilt.GetPointData().GetArray("Margin") is not None

grid = GridLabelMesh(Input=volume, LabelArray=LABELS)
grid.TargetTriangles = 2000
assert 0 < output(grid).GetNumberOfPolys() <= 2100, output(grid).GetNumberOfPolys()

# A further bound of the lengths, by an image: the field of a first run, halved.
half = Calculator(Input=sizing, ResultArrayName="Half", Function="0.5*TargetLength")
half.UpdatePipeline()
before = output(mesh).GetNumberOfPolys()
whole.LengthBound = half
whole.LengthArray = ["POINTS", "Half"]
sizing2 = SizingField(Input=indicators, LengthBound=half, LengthArray=["POINTS", "Half"], MaximumLength=4.0)
finer = DelaunayLabelMesh(Input=ParticleSampleCells(Input=indicators, Sizing=sizing2), Indicators=indicators)
assert output(finer).GetNumberOfPolys() > 2 * before, output(finer).GetNumberOfPolys()
assert content(output(whole)) == content(output(finer))

report = LabelMeshReport(Input=mesh, LabelImage=volume, LabelArray=LABELS, Distances=tighten)
table = output(report)
assert table.GetNumberOfRows() == 3, table.GetNumberOfRows()  # with the background
closed = table.GetColumnByName("Closed")
assert all(closed.GetValue(row) == 1 for row in range(3))
volumes = [table.GetColumnByName(name) for name in ("Volume", "VoxelVolume", "TightVolume")]
for row in (1, 2):
    volume_of_mesh, of_voxels, of_tight = (column.GetValue(row) for column in volumes)
    assert abs(volume_of_mesh / of_voxels - 1) < 0.12, (row, volume_of_mesh, of_voxels)
    assert abs(volume_of_mesh / of_tight - 1) < 0.03, (row, volume_of_mesh, of_tight)
assert output(report, 1).GetNumberOfRows() == 3, output(report, 1).GetNumberOfRows()
assert output(report, 2).GetNumberOfRows() == 0, output(report, 2).GetNumberOfRows()
assert output(report, 3).GetNumberOfPoints() == 0
assert table.GetFieldData().GetAbstractArray("Certificate").GetValue(0).startswith("certified: ")
everything = LabelMeshReport(Input=mesh, LabelImage=volume, LabelArray=LABELS, Distances=tighten, ErrorMap=1,
                             RebuiltLabels=OutputPort(indicators, 1),
                             Particles=OutputPort(particles, 0))
assert output(everything, 2).GetNumberOfRows() == 0
distances = output(everything, 3).GetPointData().GetArray("DistanceToVoxels")
assert 0 <= distances.GetRange()[0] and distances.GetRange()[1] < 1.5, distances.GetRange()
assert output(LabelMeshReport(Input=grid)).GetNumberOfRows() == 3

# The command line makes the same mesh as Label Mesher with its defaults.
path = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")
subprocess.run([os.environ["LABELMESH_EXECUTABLE"], path, "-o", "command_line.vtp", "--quiet"], check=True)
written = XMLPolyDataReader(FileName="command_line.vtp")
default = LabelMesher(Input=volume, LabelArray=LABELS)
mine, theirs = content(output(default))[0], content(output(written))[0]
assert mine[1] == theirs[1] and mine[2] == theirs[2], "the command line's points or triangles differ"
assert mine[4]["BoundaryLabels"] == theirs[4]["BoundaryLabels"], "the command line's labels differ"

print(f"{interfaces.GetNumberOfPolys()} triangles, the same by stages and in one")
