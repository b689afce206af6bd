# SPDX-License-Identifier: BSD-3-Clause
"""Work that is written down and done again gives the same mesh: TestStates.py PVSERVER

A Python trace; saved states, .pvsm and .py, loaded by the built-in server and by a remote one; and meshes written to
files and read back, with their names, colours and arrays.
"""
import os
import socket
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, here)
from common import arrays, blocks, content, open_volume, output  # noqa: E402

from paraview import servermanager, simple, smstate, smtrace  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

plugin = os.environ["LABELMESH_PLUGIN"]
PREAMBLE = f"import paraview.simple\nparaview.simple.LoadPlugin({plugin!r}, remote=False, ns=globals())\n"
FETCH = """
import sys
sys.path.insert(0, {here!r})
from common import content
from paraview import servermanager, simple
(mesher,) = [source for source in simple.GetSources().values() if source.GetXMLName() == "LabelMesher"]
mesher.UpdatePipeline()
open({result!r}, "wb").write(repr(content(servermanager.Fetch(mesher))).encode())
"""


def pvpython(name, text):
    """Runs a script; what it fetched."""
    with open(name + "-run.py", "w") as file:
        file.write(text + FETCH.format(here=here, result=name + ".txt"))
    subprocess.run(["pvpython", name + "-run.py"], check=True, timeout=120)
    return open(name + ".txt", "rb").read()


simple.LoadPlugin(plugin, remote=False, ns=globals())

# What a user does, traced.
smtrace.start_trace()
volume = open_volume("two_spheres_small")
# All at once: what scripts set later is not traced, only what the application sets.
mesher = LabelMesher(registrationName="Mesher", Input=volume, MaximumLength=4.0, Tetrahedra="Packed",
                     MaterialNames=["1", "upper", "2", "lower"],
                     MaterialColors=[1, 0.9, 0.2, 0.1, 2, 0.1, 0.2, 0.9], MaterialRadii=[2, 0.8])
mesher.UpdatePipeline()
trace = smtrace.stop_trace()
expected = repr(content(servermanager.Fetch(mesher))).encode()
assert len(expected) > 100000
assert "LabelMesher(" in trace and "MaximumLength = 4.0" in trace, trace
assert pvpython("trace", PREAMBLE + trace) == expected, "the trace's mesh differs"

# States.
simple.SaveState("state.pvsm")
LOAD = {"pvsm": "from paraview import simple\nsimple.LoadState('state.pvsm')\n", "py": smstate.get_state()}
for kind, text in LOAD.items():
    assert pvpython("state-" + kind, PREAMBLE + text) == expected, f"the state's mesh differs: {kind}"
for kind, text in LOAD.items():
    with socket.socket() as probe:  # a port that is free now
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    server = subprocess.Popen([sys.argv[1], f"--server-port={port}"])
    try:
        connect = ("from paraview import simple\n" + f"simple.Connect('127.0.0.1', {port})\n" +
                   "".join(f"simple.LoadPlugin({plugin!r}, remote={remote}, ns=globals())\n" for remote in (True, False)))
        assert pvpython("remote-" + kind, connect + text) == expected, f"the remote state's mesh differs: {kind}"
    finally:
        server.terminate()
        server.wait()


# Files. Binary data: see the README.
def read_back(port, name, reader):
    path = os.path.abspath(name)
    simple.SaveData(path, proxy=simple.OutputPort(mesher, port), DataMode="Binary")
    return output(reader(FileName=[path])), output(mesher, port)


def fields(data):
    """Field data but for what readers and writers add."""
    found = {}
    for n in range(data.GetFieldData().GetNumberOfArrays()):
        array = data.GetFieldData().GetAbstractArray(n)
        found[array.GetName()] = [array.GetVariantValue(i).ToString() for i in range(array.GetNumberOfValues())]
    return found


def require_fields(read, made):
    assert "MaterialNames" in fields(made) and "MaterialColors" in fields(made)
    for name, values in fields(made).items():
        assert fields(read).get(name) == values, f"{name}: {fields(read).get(name)}, written as {values}"


read, made = read_back(0, "mesh.vtp", simple.XMLPolyDataReader)
assert content(read) == content(made)
require_fields(read, made)
assert fields(read)["MaterialNames"][1:] == ["upper", "lower"]

read, made = read_back(1, "surfaces.vtpc", simple.XMLPartitionedDatasetCollectionReader)
assert [name for name, _ in blocks(read)] == ["upper", "lower"] and content(read) == content(made)
require_fields(read, made)
assert read.GetDataAssembly().GetRootNodeName() == made.GetDataAssembly().GetRootNodeName()
for (_, block), color in zip(blocks(read), ((0.9, 0.2, 0.1), (0.1, 0.2, 0.9))):
    assert block.GetFieldData().GetArray("Color").GetTuple3(0) == color

read, made = read_back(4, "tetrahedra.vtu", simple.XMLUnstructuredGridReader)
assert arrays(read.GetCellData()) == arrays(made.GetCellData()) and "Label" in arrays(read.GetCellData())
assert vtk_to_numpy(read.GetPoints().GetData()).tobytes() == vtk_to_numpy(made.GetPoints().GetData()).tobytes()
require_fields(read, made)
print("a trace, four states and three files")
