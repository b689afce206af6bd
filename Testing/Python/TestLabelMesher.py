#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The filters from VTK Python: numpy in, numpy out, and the same mesh as the command line's."""
import os
import runpy
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from labelmesh import vtkGridLabelMesh, vtkLabelMesher, vtkLabelMeshReport, vtkLabelSplit
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

EXAMPLE = runpy.run_path(str(Path(__file__).resolve().parents[2] / "Examples" / "Python" / "numpy_to_meshes.py"))
image_of, arrays_of = EXAMPLE["image_of"], EXAMPLE["arrays_of"]


def two_boxes(dtype):
    labels = np.zeros((20, 20, 24), dtype)
    labels[5:15, 5:15, 4:12] = 1
    labels[5:15, 5:15, 12:20] = 3
    return labels


class TestLabelMesher(unittest.TestCase):
    def test_numpy_in_numpy_out(self):
        mesher = vtkLabelMesher()
        mesher.SetInputData(image_of(two_boxes(np.int16)))
        mesher.Update()
        vertices, triangles = arrays_of(mesher.GetOutput())
        self.assertEqual(vertices.dtype, np.float64)
        sides = vtk_to_numpy(mesher.GetOutput().GetCellData().GetArray("BoundaryLabels"))
        self.assertEqual({tuple(pair) for pair in sides}, {(1, 0), (3, 0), (1, 3)})
        middle = vertices[triangles[(sides == (1, 3)).all(axis=1)]]
        self.assertLess(np.abs(middle[..., 0] - 11.5).max(), 0.5)
        surfaces = mesher.GetSurfaces()
        self.assertEqual(surfaces.GetNumberOfPartitionedDataSets(), 2)
        for n in range(2):
            vertices, triangles = arrays_of(surfaces.GetPartition(n, 0))
            a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
            volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
            self.assertAlmostEqual(volume / 800, 1, delta=0.25)  # smoothing rounds edges off
            edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
            self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())

    def test_every_type_gives_the_same_bytes(self):
        points = []
        for dtype in (np.uint8, np.int8, np.uint16, np.int32, np.int64, np.uint64, np.float32, np.float64):
            mesher = vtkLabelMesher()
            mesher.SetInputData(image_of(two_boxes(dtype)))
            mesher.Update()
            points.append(arrays_of(mesher.GetOutput())[0].tobytes())
        self.assertEqual(len(set(points)), 1)

    def test_same_mesh_as_the_command_line(self):
        volume = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")
        reader = vtkMetaImageReader()
        reader.SetFileName(volume)
        mesher = vtkLabelMesher()
        mesher.SetInputConnection(reader.GetOutputPort())
        mesher.SetEpsilon(0.6)
        mesher.SetMaterialRadius(2, 0.8)
        mesher.Update()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.vtp")
            subprocess.run([os.environ["LABELMESH_EXECUTABLE"], volume, "-o", path, "--epsilon", "0.6", "--material",
                            "2:radius=0.8", "--quiet"], check=True)
            file = vtkXMLPolyDataReader()
            file.SetFileName(path)
            file.Update()
            for ours, theirs in zip(arrays_of(mesher.GetOutput()), arrays_of(file.GetOutput())):
                self.assertEqual(ours.tobytes(), theirs.tobytes())

    def test_report(self):
        mesher = vtkLabelMesher()
        mesher.SetInputData(image_of(two_boxes(np.uint8)))
        for source, port in ((mesher, 0), (vtkGridLabelMesh(), 0)):
            source.SetInputData(image_of(two_boxes(np.uint8)))
            report = vtkLabelMeshReport()
            report.SetInputConnection(0, source.GetOutputPort(port))
            report.SetInputData(1, image_of(two_boxes(np.uint8)))
            report.Update()
            table = report.GetOutput(0)
            self.assertEqual([table.GetValueByName(row, "Label").ToInt() for row in range(3)], [0, 1, 3])
            for row in range(3):
                self.assertEqual(table.GetValueByName(row, "Closed").ToInt(), 1)
                self.assertEqual(table.GetValueByName(row, "Lost").ToInt(), 0)
            self.assertEqual(table.GetValueByName(1, "VoxelVolume").ToDouble(), 800)

    def test_properties_and_stages(self):
        mesher = vtkLabelMesher()
        mesher.AddLabel(3)
        mesher.SetMaterialName(3, "right")
        self.assertEqual(mesher.GetMaterialName(3), "right")
        self.assertEqual((mesher.GetEpsilon(), mesher.GetRadius(), mesher.GetPadding()), (0.65, 0.7, 6))
        mesher.SetInputData(image_of(two_boxes(np.uint8)))
        mesher.Update()
        self.assertEqual(mesher.GetSurfaces().GetNumberOfPartitionedDataSets(), 1)
        self.assertGreater(mesher.GetStageSeconds("Tighten"), 0)
        mesher.SetEpsilon(0.9)
        mesher.Update()
        self.assertEqual((mesher.GetStageRuns("Tighten"), mesher.GetStageRuns("SizingField")), (1, 2))

    def test_errors_are_words(self):
        said = []
        mesher = vtkLabelMesher()

        def note(caller, event, message):
            said.append(message)
        note.CallDataType = "string0"
        mesher.AddObserver(vtkCommand.ErrorEvent, note)
        mesher.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda *_: None)
        mesher.SetInputData(image_of(two_boxes(np.float32) + np.float32(0.5)))
        mesher.Update()
        self.assertEqual(len(said), 1)
        self.assertIn("0.5", said[0])
        self.assertEqual(mesher.GetOutput().GetNumberOfCells(), 0)

    def test_stages_are_filters_too(self):
        split = vtkLabelSplit()
        split.SetInputDataObject(image_of(two_boxes(np.uint8)))
        split.Update()
        self.assertEqual(split.GetOutput().GetNumberOfPartitionedDataSets(), 3)

    def test_example(self):
        EXAMPLE["main"]()


if __name__ == "__main__":
    unittest.main()
