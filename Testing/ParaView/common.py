# SPDX-License-Identifier: BSD-3-Clause
"""What the ParaView tests share."""
import os

from paraview.simple import OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy


def open_volume(name):
    """A reader of one of the small volumes, updated: array domains are empty before."""
    reader = OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], name + ".mha"))
    reader.UpdatePipeline()
    return reader


def output(proxy, port=0):
    """The data itself, in this process: servermanager.Fetch() does not take collections, and makes copies."""
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def blocks(data):
    """(name, leaf) of a collection; (None, data) of anything else."""
    if not data.IsA("vtkPartitionedDataSetCollection"):
        return [(None, data)]
    result = []
    for n in range(data.GetNumberOfPartitionedDataSets()):
        name = data.GetMetaData(n).Get(data.NAME()) if data.HasMetaData(n) else None
        leaf = data.GetPartition(n, 0)
        result.append((name, leaf))
    return result


def arrays(attributes):
    return {attributes.GetArrayName(n): vtk_to_numpy(attributes.GetArray(n)).tobytes()
            for n in range(attributes.GetNumberOfArrays()) if attributes.GetArray(n) is not None}


def content(data):
    """All that makes a mesh: its bytes, ready to compare."""
    result = []
    for name, leaf in blocks(data):
        points = vtk_to_numpy(leaf.GetPoints().GetData()).tobytes() if leaf.GetNumberOfPoints() else b""
        cells = [vtk_to_numpy(group.GetConnectivityArray()).tobytes() if group.GetNumberOfCells() else b""
                 for group in (leaf.GetVerts(), leaf.GetLines(), leaf.GetPolys())]
        result.append((name, points, cells, arrays(leaf.GetPointData()), arrays(leaf.GetCellData())))
    return result
