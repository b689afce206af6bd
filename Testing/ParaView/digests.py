# SPDX-License-Identifier: BSD-3-Clause
"""Digests of all that the filters give, to compare servers: digests.py FILE [HOST PORT]

Runs in pvpython, with a server if there is one, or in pvbatch. The data come to the client as users' data do: fetched, or
written to files by the server.
"""
import hashlib
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from common import arrays, blocks, open_volume  # noqa: E402

from paraview import servermanager  # noqa: E402
from paraview.simple import Connect, LoadPlugin, OpenDataFile, OutputPort, SaveData  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader  # noqa: E402

LABELS = ["POINTS", "MetaImage"]


def digest(parts):
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def leaf_content(leaf):
    """All that makes a dataset: its bytes. What the parts of several processes are appended with sorts the arrays."""
    parts = [leaf.GetClassName(), leaf.GetNumberOfPoints(), sorted(arrays(leaf.GetPointData()).items()),
             sorted(arrays(leaf.GetCellData()).items())]
    if leaf.IsA("vtkImageData"):
        parts += [leaf.GetExtent(), leaf.GetOrigin(), leaf.GetSpacing()]
    elif leaf.GetNumberOfPoints():
        parts.append(vtk_to_numpy(leaf.GetPoints().GetData()).tobytes())
    groups = [leaf.GetCells()] if leaf.IsA("vtkUnstructuredGrid") else \
        [leaf.GetVerts(), leaf.GetLines(), leaf.GetPolys()] if leaf.IsA("vtkPolyData") else []
    for group in groups:
        parts.append(vtk_to_numpy(group.GetConnectivityArray()).tobytes() if group.GetNumberOfCells() else b"")
    return parts


def table_content(table):
    """The columns; on its way from a server a table without rows loses them."""
    return table.GetNumberOfRows() and [(table.GetColumnName(n), [table.GetColumn(n).GetVariantValue(row).ToString()
                                      for row in range(table.GetNumberOfRows())])
            for n in range(table.GetNumberOfColumns())]


def fetched(proxy, port=0):
    proxy.UpdatePipeline()
    data = servermanager.Fetch(proxy, idx=port)
    return digest(table_content(data) if data.IsA("vtkTable") else leaf_content(data))


def written(proxy, port, name):
    """A collection, written by the server and read here."""
    path = os.path.abspath(name + ".vtpc")
    SaveData(path, proxy=OutputPort(proxy, port), DataMode="Binary")
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(path)
    reader.Update()
    found = blocks(reader.GetOutput())
    assert [block for block, _ in found] == ["upper", "lower"], [block for block, _ in found]
    assert all(leaf is not None and leaf.GetNumberOfPoints() > 100 for _, leaf in found)
    names = reader.GetOutput().GetFieldData().GetAbstractArray("MaterialNames")
    assert names.GetValue(1) == "upper", names.GetValue(1)
    return digest([(block, leaf_content(leaf)) for block, leaf in found])


def all_digests(volume, name):
    mesher = LabelMesher(Input=volume, LabelArray=LABELS, MaximumLength=4.0, Tetrahedra="Packed",
                         MaterialNames=["1", "upper", "2", "lower"])
    split = LabelSplit(Input=volume, LabelArray=LABELS, MaterialNames=["1", "upper", "2", "lower"])
    tighten = Tighten(Input=split)
    indicators = IndicatorReconstruct(Input=tighten)
    sizing = SizingField(Input=indicators, MaximumLength=4.0)
    particles = ParticleSampleCells(Input=indicators, Sizing=sizing, SampleVolume=1)
    mesh = DelaunayLabelMesh(Input=particles, Indicators=indicators, Tetrahedra="Packed")
    grid = GridLabelMesh(Input=volume, LabelArray=LABELS, TargetTriangles=2000)
    report = LabelMeshReport(Input=mesh, LabelImage=volume, LabelArray=LABELS, Distances=tighten, ErrorMap=1,
                             RebuiltLabels=OutputPort(indicators, 1), Particles=OutputPort(particles, 0),
                             Tetrahedra=OutputPort(mesh, 2))
    result = {
        "interfaces": fetched(mesher), "particles": fetched(mesher, 2), "curves": fetched(mesher, 3),
        "tetrahedra": fetched(mesher, 4), "surfaces": written(mesher, 1, name + "-surfaces"),
        "surfaces by stages": written(mesh, 1, name + "-stages"),
        "interfaces by stages": fetched(mesh), "tetrahedra by stages": fetched(mesh, 2),
        "sizing": fetched(sizing), "rebuilt labels": fetched(indicators, 1),
        "grid": fetched(grid), "materials": fetched(report), "contacts": fetched(report, 1),
        "losses": fetched(report, 2), "error map": fetched(report, 3), "tetrahedra's table": fetched(report, 4),
        "dihedral angles": fetched(report, 5),
    }
    assert result["interfaces"] == result["interfaces by stages"]
    assert result["surfaces"] == result["surfaces by stages"]
    sizing.UpdatePropertyInformation()
    result["predicted"] = sizing.GetPropertyValue("PredictedParticles")
    mesher.UpdatePropertyInformation()
    information = mesher.GetDataInformation(0)
    result["counted"] = information.GetNumberOfPoints(), information.GetNumberOfCells()
    return result


def other_formats():
    """The volume as .vti, which readers divide among processes, and as .nrrd: written here, read by the server."""
    from vtkmodules.vtkIOImage import vtkMetaImageReader
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
    reader = vtkMetaImageReader()
    reader.SetFileName(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha"))
    reader.Update()
    image = reader.GetOutput()
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(image)
    writer.SetFileName("volume.vti")
    writer.SetDataModeToBinary()
    writer.Write()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    with open("volume.nrrd", "wb") as file:
        kind = {1: "uint8", 2: "uint16"}[scalars.itemsize]
        file.write(f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {' '.join(map(str, image.GetDimensions()))}\n"
                   f"spacings: {' '.join(map(str, image.GetSpacing()))}\nendian: little\nencoding: raw\n\n".encode())
        file.write(scalars.tobytes())
    return ["volume.vti", "volume.nrrd"]


def main():
    if len(sys.argv) > 2:
        Connect(sys.argv[2], int(sys.argv[3]))  # tries again until the server listens
        LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=True, ns=globals())
    LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=False, ns=globals())
    name = os.path.splitext(sys.argv[1])[0]
    result = all_digests(open_volume("two_spheres_small"), name)
    for path in other_formats():
        volume = OpenDataFile(os.path.abspath(path))
        volume.UpdatePipeline()
        mesher = LabelMesher(Input=volume, MaximumLength=4.0)
        result[path] = fetched(mesher)
    with open(sys.argv[1], "w") as file:
        json.dump(result, file, indent=1)


main()
