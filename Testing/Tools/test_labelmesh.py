#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command line: what it writes, and what it says when it cannot."""
import gzip
import json
import os
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import (vtkXMLImageDataWriter, vtkXMLPartitionedDataSetCollectionReader,
                                 vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader)

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Data"))
import make_volumes  # noqa: E402

LABELMESH = os.environ["LABELMESH_EXECUTABLE"]
SPHERES = make_volumes.two_spheres(32)


def read_mesh(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def read_grid(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def points_of(path):
    return vtk_to_numpy(read_mesh(path).GetPoints().GetData())


def write_nifti(path, labels, sform, qfac=1.0, cut=0):
    """A minimal NIfTI-1 file."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *labels.shape[::-1], 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    spacing = np.linalg.norm(np.array(sform, float)[:, :3], axis=0)
    struct.pack_into("<8f", header, 76, qfac, *spacing, 1, 1, 1, 1)
    struct.pack_into("<2f", header, 108, 352, 1)
    struct.pack_into("<2h", header, 252, 0, 1)
    struct.pack_into("<12f", header, 280, *np.ravel(sform))
    header[344:348] = b"n+1\0"
    data = bytes(header) + labels.tobytes()
    data = gzip.compress(data) if str(path).endswith(".gz") else data
    Path(path).write_bytes(data[:len(data) - cut])


def write_nrrd(path, labels, fields, encoding="gzip", cut=0):
    data = labels.tobytes()
    data = gzip.compress(data) if encoding == "gzip" else data
    sizes = " ".join(str(n) for n in labels.shape[::-1])
    header = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {sizes}\n{fields}encoding: {encoding}\n\n"
    Path(path).write_bytes((header.encode() + data)[:len(header) + len(data) - cut])


def write_vti(path, array, name="Labels"):
    image = vtkImageData()
    image.SetDimensions(*array.shape[2::-1])
    scalars = numpy_to_vtk(array.reshape(-1, *array.shape[3:]), deep=True)
    scalars.SetName(name)
    image.GetPointData().AddArray(scalars)
    writer = vtkXMLImageDataWriter()
    writer.SetDataModeToBinary()  # appended data cannot be read back with the Expat of an up-to-date Debian 12
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()


class CommandLineTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(dir=os.environ.get("LABELMESH_OUTPUT")))
        self.addCleanup(shutil.rmtree, self.folder)
        self.spheres = self.folder / "spheres.mha"
        make_volumes.write_mha(self.spheres, SPHERES)

    def run_tool(self, *arguments):
        return subprocess.run([LABELMESH, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120)

    def mesh(self, *arguments):
        """Runs it and expects success without a word on standard output."""
        result = self.run_tool(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "")
        return result

    def refuse(self, words, *arguments):
        """Expects one line on standard error, exit status 1, and no new file."""
        before = sorted(self.folder.rglob("*"))
        result = self.run_tool(*arguments)
        self.assertEqual(result.returncode, 1, f"{arguments}: {result.stderr}")
        self.assertEqual(len(result.stderr.splitlines()), 1, f"{arguments}: {result.stderr}")
        self.assertTrue(result.stderr.startswith("labelmesh: "), result.stderr)
        self.assertIn(words, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(sorted(self.folder.rglob("*")), before, arguments)


class TestOutput(CommandLineTest):
    def test_all_files(self):
        self.mesh(self.spheres, "-o", "mesh.vtp", "--surfaces", "parts.vtpc", "--particles", "particles.vtp",
                  "--report", "report.json", "--material", "1:name=upper,color=#ff8000,radius=0.8", "--quiet")
        mesh = read_mesh(self.folder / "mesh.vtp")
        labels = vtk_to_numpy(mesh.GetCellData().GetArray("BoundaryLabels"))
        self.assertEqual({tuple(pair) for pair in labels}, {(1, 0), (2, 0), (1, 2)})
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["triangles"], mesh.GetNumberOfCells())
        self.assertEqual(report["points"], mesh.GetNumberOfPoints())
        self.assertEqual(report["dimensions"], [32, 32, 32])
        self.assertEqual(report["method"], "particle")
        self.assertGreater(report["min_radius_ratio"], 0.3)
        self.assertEqual([m["label"] for m in report["materials"]], [1, 2])
        self.assertEqual(report["materials"][0]["name"], "upper")
        for material in report["materials"]:
            self.assertTrue(material["closed"] and material["manifold"])
            self.assertEqual((material["components"], material["euler"]), (1, 2))
            self.assertAlmostEqual(material["volume"] / material["voxel_volume"], 1, delta=0.15)
        particles = read_mesh(self.folder / "particles.vtp")
        dimensions = vtk_to_numpy(particles.GetPointData().GetArray("CellDimension"))
        self.assertEqual([report["cells"][str(d)] for d in range(3)], [int((dimensions == d).sum()) for d in range(3)])
        self.assertEqual(report["lost"], [])
        self.assertIn("Tighten", report["seconds"])
        self.assertGreater(report["seconds"]["total"], report["seconds"]["Tighten"])
        self.assertGreater(report["peak_memory_bytes"], 1 << 20)
        reader = vtkXMLPartitionedDataSetCollectionReader()
        reader.SetFileName(str(self.folder / "parts.vtpc"))
        reader.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfPartitionedDataSets(), 2)
        self.assertEqual(reader.GetOutput().GetPartition(0, 0).GetNumberOfCells(), report["materials"][0]["triangles"])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["mesh.vtp", "particles.vtp", "parts", "parts.vtpc", "report.json", "spheres.mha"])

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.mesh(self.spheres, "-o", f"{threads}.vtp", "--threads", threads, "--quiet")
        self.assertEqual((self.folder / "1.vtp").read_bytes(), (self.folder / "2.vtp").read_bytes())

    def test_tetrahedra(self):
        self.mesh(self.spheres, "-o", "m.vtp", "--tets", "t.vtu", "--report", "r.json", "--quiet", "--tet-refine", "1",
                  "--volume-gradation", "0.3", "--volume-max-length", "6", "--threads", "1")
        grid = read_grid(self.folder / "t.vtu")
        cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        labels = vtk_to_numpy(grid.GetCellData().GetArray("Label"))
        surface = points_of(self.folder / "m.vtp")
        np.testing.assert_array_equal(points[:len(surface)], surface)
        a, b, c, d = (points[cells[:, n]] for n in range(4))
        volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
        self.assertGreater(volumes.min(), 0)
        report = json.loads((self.folder / "r.json").read_text())
        for material in report["materials"]:
            np.testing.assert_allclose(volumes[labels == material["label"]].sum(), material["volume"], rtol=1e-9)
        self.assertGreater(report["cells"]["3"], 100)
        tetrahedra = report["tetrahedra"]
        self.assertEqual((tetrahedra["count"], tetrahedra["slivers"]), (len(cells), 0))
        self.assertEqual(sum(tetrahedra["histogram"]), 6 * len(cells))
        self.assertGreater(tetrahedra["min_dihedral_degrees"], 12)
        self.assertLess(tetrahedra["max_dihedral_degrees"], 155)
        self.assertEqual(sum(material["count"] for material in tetrahedra["materials"]), len(cells))
        self.mesh(self.spheres, "--tets", "g.vtu", "--tet-method", "tetgen", "--quiet")
        self.assertGreater(read_grid(self.folder / "g.vtu").GetNumberOfCells(), 1000)

    def test_a_length_per_interface(self):
        def triangles(*options):
            self.mesh(self.spheres, "-o", "m.vtp", "--quiet", *options)
            labels = vtk_to_numpy(read_mesh(self.folder / "m.vtp").GetCellData().GetArray("BoundaryLabels"))
            return (int((labels.sum(axis=1) == 3).sum()), len(labels))
        coarse, all_coarse = triangles()
        fine, all_fine = triangles("--interface", "2,1:length=0.6")
        self.assertGreater(fine, 2 * coarse)
        self.assertLess(all_fine, 2 * all_coarse + fine)
        self.assertEqual(triangles("--interface", "1,2:length=0"), (coarse, all_coarse))

    def test_grid_method(self):
        self.mesh(self.spheres, "-o", "grid.vtp", "--method", "grid", "--triangles", 800, "--report", "grid.json")
        report = json.loads((self.folder / "grid.json").read_text())
        self.assertEqual(report["method"], "grid")
        self.assertAlmostEqual(report["triangles"], 800, delta=20)
        self.assertNotIn("cells", report)
        self.assertTrue(all(entry["stage"] == "GridLabelMesh" for entry in report["lost"]))

    def test_files_of_earlier_runs_are_replaced_and_others_kept(self):
        (self.folder / "s").mkdir()
        (self.folder / "s" / "notes.txt").write_text("mine")
        (self.folder / "s" / "s_7_0.vtp").write_text("of an earlier run")
        (self.folder / "s.vtpc").write_text("of an earlier run")
        self.mesh(self.spheres, "--surfaces", "s.vtpc", "--quiet")
        self.assertEqual(sorted(p.name for p in (self.folder / "s").iterdir()),
                         ["notes.txt", "s_0_0.vtp", "s_1_0.vtp"])
        self.assertIn("s/s_1_0.vtp", (self.folder / "s.vtpc").read_text())

    def test_labels_background_and_losses(self):
        labels = SPHERES.copy()
        labels[2, 2, 2] = 9
        make_volumes.write_mha(self.folder / "speck.mha", labels)
        self.mesh("speck.mha", "-o", "m.vtp", "--report", "r.json", "--quiet")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["lost"], [])
        self.mesh("speck.mha", "-o", "m.vtp", "--report", "r.json", "--smoothing", "tighten", "--quiet")
        lost = json.loads((self.folder / "r.json").read_text())["lost"]
        self.assertEqual([entry["label"] for entry in lost if "label" in entry], [9])
        self.assertEqual(lost[0]["stage"], "Tighten")
        self.mesh("speck.mha", "-o", "m.vtp", "--report", "r.json", "--labels", "2", "--quiet")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual([m["label"] for m in report["materials"]], [2])
        self.assertEqual(report["lost"], [])

    def test_min_component(self):
        labels = SPHERES.copy()
        labels[2, 2, 2] = 9
        labels[2, 2, 28] = labels[3, 2, 28] = 2
        make_volumes.write_mha(self.folder / "specks.mha", labels)
        result = self.mesh("specks.mha", "-o", "m.vtp", "--report", "r.json", "--min-component", "3")
        self.assertRegex(result.stderr, "2 components that were dropped on request")
        report = json.loads((self.folder / "r.json").read_text())
        dropped = [(entry["label"], entry["stage"], entry["on_request"], entry["voxels"], entry["position"])
                   for entry in report["lost"]]
        self.assertEqual(sorted(dropped), [(2, "LabelSplit", True, 2, [28, 2, 2]), (9, "LabelSplit", True, 1, [2, 2, 2])])
        for material in report["materials"]:
            self.assertEqual(material["voxels"], int((SPHERES == material["label"]).sum()))

    def test_certificate(self):
        """What is said at the end, and the same in the report."""
        result = self.mesh(self.spheres, "-o", "m.vtp", "--report", "r.json", "--error-map", "e.vtp")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["certified"])
        last = result.stderr.splitlines()[-1]
        self.assertEqual(last, "labelmesh: " + report["certificate"])
        self.assertRegex(last, rf"certified: {report['triangles']} triangles, .*worst radius ratio 0\.\d+ at \(")
        self.assertEqual((report["self_intersecting_pairs"], report["degenerate_triangles"]), (0, 0))
        mesh = read_mesh(self.folder / "m.vtp")
        worst = mesh.GetCellData().GetArray("RadiusRatio").GetValue(report["worst_triangle"]["triangle"])
        self.assertAlmostEqual(worst, report["min_radius_ratio"], places=4)
        for material in report["materials"]:
            self.assertTrue(material["certified"])
            for key, value in (("genus", 0), ("parts", 1), ("cavities", 0), ("euler", 2), ("components", 1)):
                self.assertEqual((material[key], material["voxel_" + key]), (value, value), key)
            self.assertEqual(material["voxels"], int((SPHERES == material["label"]).sum()))
        self.assertEqual([pair["labels"] for pair in report["interfaces"]], [[1, 0], [1, 2], [2, 0]])
        self.assertEqual(report["misclassified_voxels"], sum(
            material["misclassified_voxels"] for material in report["materials"] + [report["background"]]))
        self.assertLess(report["misclassified_voxels"], 0.01 * SPHERES.size)
        # The same triangles, no point farther from the voxels' own interface than a voxel.
        error_map = read_mesh(self.folder / "e.vtp")
        self.assertEqual(error_map.GetNumberOfCells(), report["triangles"])
        distances = vtk_to_numpy(error_map.GetPointData().GetArray("DistanceToVoxels"))
        self.assertTrue(np.all(distances >= 0) and distances.max() < 1, distances.max())
        self.assertAlmostEqual(report["distance_to_voxels"]["max"], distances.max(), places=6)
        self.assertEqual(report["distance_to_voxels"]["far_points"], 0)
        self.assertGreater(report["seconds"]["Report"], 0)
        self.assertEqual(self.mesh(self.spheres, "-o", "m.vtp", "--quiet").stderr, "")

    def test_ledger(self):
        labels = SPHERES.copy()
        labels[2, 2, 2] = 9
        labels[2, 2, 28] = labels[28, 3, 3] = 2
        make_volumes.write_mha(self.folder / "specks.mha", labels)
        result = self.mesh("specks.mha", "-o", "m.vtp", "--report", "r.json", "--smoothing", "tighten")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["certified"], "what is there is sound")
        lost = {(str(entry.get("label", entry.get("labels"))), entry["stage"]): entry for entry in report["lost"]}
        self.assertEqual(set(lost), {("9", "Tighten"), ("2", "Tighten"), ("[9, 0]", "Tighten")})
        self.assertEqual((lost["2", "Tighten"]["parts"], lost["2", "Tighten"]["voxels"]), (2, 2))
        self.assertEqual(lost["2", "Tighten"]["position"], [28, 2, 2])
        material = report["materials"][1]
        self.assertEqual((material["parts"], material["voxel_parts"], material["lost_parts"]), (1, 3, 2))
        for entry in report["lost"]:
            self.assertIn("finer voxels", entry["advice"])
        self.assertRegex(result.stderr, r"lost by Tighten: 1 label \(9\), 2 parts of labels and 1 pair of labels")
        # And the advice helps.
        finer = np.kron(labels, np.ones((3, 3, 3), labels.dtype))
        make_volumes.write_mha(self.folder / "finer.mha", finer, spacing=(1 / 3, 1 / 3, 1 / 3))
        self.mesh("finer.mha", "-o", "m.vtp", "--report", "r.json", "--quiet")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["lost"], [])

    def test_smoothing(self):
        """A plate of two voxels keeps its volume by default, and wears down when it is tightened by itself."""
        plate = np.zeros((24, 40, 40), np.uint8)
        plate[11:13, 5:35, 5:35] = 1
        make_volumes.write_mha(self.folder / "plate.mha", plate)
        kept = {}
        for smoothing in ((), ("--smoothing", "volume"), ("--smoothing", "tighten")):
            self.mesh("plate.mha", "-o", "m.vtp", "--report", "r.json", "--quiet", *smoothing)
            material = json.loads((self.folder / "r.json").read_text())["materials"][0]
            kept[smoothing[-1:]] = material["volume"] / material["voxel_volume"]
        self.assertEqual(kept[()], kept[("volume",)])
        self.assertAlmostEqual(kept[()], 1, delta=0.1)
        self.assertLess(kept[("tighten",)], kept[()] - 0.02)

    def test_flat_border(self):
        """A volume full of labels comes out as its box of voxels."""
        labels = np.ones((20, 24, 28), np.uint8)
        labels[:, :, 11:] = 2
        make_volumes.write_mha(self.folder / "full.mha", labels)
        self.mesh("full.mha", "-o", "m.vtp", "--report", "r.json", "--quiet", "--border", "flat")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertAlmostEqual(sum(m["volume"] for m in report["materials"] if m["label"] > 0), 20 * 24 * 28, places=8)
        self.assertEqual(report["lost"], [])

    def test_one_foreground_label_that_fills_the_volume(self):
        make_volumes.write_mha(self.folder / "full.mha", np.full((20, 20, 20), 3, np.uint8))
        self.mesh("full.mha", "-o", "m.vtp", "--report", "r.json", "--quiet")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["materials"][0]["closed"])
        self.assertAlmostEqual(report["materials"][0]["volume"] / 8000, 1, delta=0.1)

    def test_progress_and_help(self):
        result = self.mesh(self.spheres, "-o", "m.vtp")
        for stage in ("LabelSplit", "Tighten", "DelaunayLabelMesh"):
            self.assertIn(stage, result.stderr)
        result = self.run_tool("--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("--epsilon", result.stdout)
        self.assertRegex(self.run_tool("--version").stdout, r"^labelmesh \d+\.\d+\.\d+\n$")


class TestInput(CommandLineTest):
    def test_orientation_of_every_format(self):
        """The same volume, turned and scaled in the same way, in three formats: the same mesh in the world."""
        turned = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
        spacing, origin = np.array([1.0, 1.5, 0.75]), np.array([10.0, 20, 30])
        make_volumes.write_mha(self.folder / "a.mha", SPHERES, spacing, origin, turned)
        axes = (turned * spacing).T
        rows = " ".join("(" + ",".join(str(x) for x in axis) + ")" for axis in axes)
        fields = f"space: left-posterior-superior\nspace directions: {rows}\nspace origin: (10,20,30)\n"
        write_nrrd(self.folder / "b.nrrd", SPHERES, fields)
        write_nrrd(self.folder / "c.nrrd", SPHERES, fields, "raw")
        sform = np.column_stack([turned * spacing, origin])
        write_nifti(self.folder / "d.nii", SPHERES, sform)
        write_nifti(self.folder / "e.nii.gz", SPHERES, sform)
        meshes = []
        for name in ("a.mha", "b.nrrd", "c.nrrd", "d.nii", "e.nii.gz"):
            self.mesh(name, "-o", name + ".vtp", "--report", name + ".json", "--quiet")
            meshes.append(points_of(self.folder / (name + ".vtp")))
            volume = json.loads((self.folder / (name + ".json")).read_text())["materials"][0]["volume"]
            self.assertGreater(volume, 0)
        for points in meshes[1:]:
            np.testing.assert_allclose(points, meshes[0], atol=1e-4)
        centre = origin + turned @ (spacing * np.array([63.3, 64.2, 78.1]) / 4)
        low, high = meshes[0].min(axis=0), meshes[0].max(axis=0)
        self.assertTrue(np.all(low < centre) and np.all(centre < high))

    def test_full_disk(self):
        """A file that cannot be written whole leaves the old one as it was, and nothing beside it."""
        self.mesh(self.spheres, "-o", "m.vtp", "--surfaces", "s.vtpc", "--report", "r.json", "--quiet")
        old = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        whole = (self.folder / "m.vtp").stat().st_size

        def limit(size):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writing then fails as it does on a full disk
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        for size in (0, 100, whole // 3, whole - 1):
            result = subprocess.run([LABELMESH, self.spheres, "-o", "m.vtp", "--surfaces", "s.vtpc", "--report",
                                     "r.json", "--epsilon", "0.5", "--quiet"], cwd=self.folder, capture_output=True,
                                    text=True, timeout=120, preexec_fn=lambda: limit(size))
            self.assertEqual(result.returncode, 1, size)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertIn("cannot write", result.stderr)
            self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}, old)

    def test_nrrd_of_every_kind(self):
        """Each type, both ends first, packed, raw and as text, attached and in a file of its own: the same mesh."""
        meshes = set()
        bodies = {"raw": bytes, "gzip": gzip.compress}
        for type_name, code in (("int8", "i1"), ("uchar", "u1"), ("short", "i2"), ("unsigned short", "u2"),
                                ("int", "i4"), ("uint32", "u4"), ("longlong", "i8"), ("uint64", "u8"),
                                ("float", "f4"), ("double", "f8")):
            for encoding, endian in (("gzip", "<"), ("raw", ">")):
                data = bodies[encoding](SPHERES.astype(endian + code).tobytes())
                head = (f"NRRD0004\ntype: {type_name}\ndimension: 3\nsizes: 32 32 32\nencoding: {encoding}\n"
                        f"endian: {'little' if endian == '<' else 'big'}\n")
                (self.folder / "v.nrrd").write_bytes(head.encode() + b"\n" + data)
                self.mesh("v.nrrd", "-o", "m.vtp", "--quiet")
                meshes.add((self.folder / "m.vtp").read_bytes())
        (self.folder / "v.nrrd").write_text(head.replace("raw", "text") + "data file: v.txt\n")
        (self.folder / "v.txt").write_text(" ".join(str(n) for n in SPHERES.ravel()))
        self.mesh("v.nrrd", "-o", "m.vtp", "--quiet")
        meshes.add((self.folder / "m.vtp").read_bytes())
        self.assertEqual(len(meshes), 1)
        (self.folder / "v.txt").unlink()
        self.refuse("'v.txt' cannot be opened", "v.nrrd", "-o", "n.vtp")

    def test_names_and_colours_of_segments(self):
        """As 3D Slicer writes them into .seg.nrrd files; --material comes before them."""
        fields = ("space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                  "Segment0_ID:=Segment_1\nSegment0_LabelValue:=1\nSegment0_Name:=left kidney\n"
                  "Segment0_Color:=0.5 0.25 1\nSegment1_LabelValue:=2\nSegment1_Name:=liver\n")
        write_nrrd(self.folder / "v.seg.nrrd", SPHERES, fields)
        self.mesh("v.seg.nrrd", "-o", "m.vtp", "--surfaces", "s.vtpc", "--material", "2:name=own", "--quiet")
        mesh = read_mesh(self.folder / "m.vtp").GetFieldData()
        names = mesh.GetAbstractArray("MaterialNames")
        self.assertEqual([names.GetValue(n) for n in range(names.GetNumberOfValues())][-2:], ["left kidney", "own"])
        colors = vtk_to_numpy(mesh.GetArray("MaterialColors"))
        np.testing.assert_allclose(colors[-2], (0.5, 0.25, 1.0))
        self.assertIn('"left kidney"', (self.folder / "s.vtpc").read_text())
        write_nrrd(self.folder / "four.nrrd", SPHERES, "")
        four = (self.folder / "four.nrrd").read_bytes().replace(b"dimension: 3", b"dimension: 4")
        (self.folder / "four.nrrd").write_bytes(four.replace(b"sizes:", b"sizes: 2"))
        self.refuse("segments that overlap", "four.nrrd", "-o", "n.vtp")

    def test_mirrored(self):
        make_volumes.write_mha(self.folder / "a.mha", SPHERES, direction=np.diag([1.0, 1, -1]))
        write_nifti(self.folder / "b.nii", SPHERES, [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])
        for name in ("a.mha", "b.nii"):
            self.mesh(name, "-o", "m.vtp", "--report", "r.json", "--quiet")
            materials = json.loads((self.folder / "r.json").read_text())["materials"]
            self.assertTrue(all(m["volume"] > 0 and m["oriented"] for m in materials), name)

    def test_vti_with_an_array_that_is_not_active(self):
        write_vti(self.folder / "a.vti", SPHERES.astype(np.int64))
        self.mesh("a.vti", "-o", "a.vtp", "--quiet")
        self.mesh(self.spheres, "-o", "b.vtp", "--quiet")
        np.testing.assert_array_equal(points_of(self.folder / "a.vtp"), points_of(self.folder / "b.vtp"))
        write_vti(self.folder / "f.vti", SPHERES.astype(np.float32))
        self.mesh("f.vti", "-o", "f.vtp", "--quiet")
        np.testing.assert_array_equal(points_of(self.folder / "f.vtp"), points_of(self.folder / "b.vtp"))


class TestRefusals(CommandLineTest):
    def test_command_lines(self):
        mesh = ("-o", "m.vtp")
        self.refuse("no input file")
        self.refuse("nothing to write", self.spheres)
        self.refuse("no file 'gone.mha'", "gone.mha", *mesh)
        self.refuse("no option --bogus", self.spheres, *mesh, "--bogus", "1")
        self.refuse("needs a value", self.spheres, "-o")
        self.refuse("needs a number", self.spheres, *mesh, "--radius", "wide")
        self.refuse("at least", self.spheres, *mesh, "--radius", "-1")
        self.refuse("closed or flat", self.spheres, *mesh, "--border", "round")
        self.refuse("belongs to --method particle", self.spheres, *mesh, "--method", "grid", "--border", "flat")
        self.refuse("volume or tighten", self.spheres, *mesh, "--smoothing", "none")
        self.refuse("particle or grid", self.spheres, *mesh, "--method", "magic")
        self.refuse("writes a .vtu, .msh or .inp file", self.spheres, *mesh, "--tets", "t.vtk")
        self.refuse("packed or tetgen", self.spheres, *mesh, "--tets", "t.vtu", "--tet-method", "magic")
        self.refuse("belongs to --tets", self.spheres, *mesh, "--tet-refine", "1")
        self.refuse("belongs to --tets", self.spheres, *mesh, "--tet-improve", "1")
        self.refuse("belongs to --tets", self.spheres, *mesh, "--tet-slide", "off")
        self.refuse("on or off", self.spheres, *mesh, "--tets", "t.vtu", "--tet-slide", "maybe")
        self.refuse("belongs to --method particle", self.spheres, *mesh, "--method", "grid", "--tets", "t.vtu")
        self.refuse("writes a .vtp file", self.spheres, "-o", "m.stl")
        self.refuse("no folder 'gone'", self.spheres, "-o", "gone/m.vtp")
        self.refuse("named twice", self.spheres, "-o", "m.vtp", "--particles", "m.vtp")
        self.refuse("two input files", self.spheres, self.spheres, *mesh)
        self.refuse("names label 7", self.spheres, *mesh, "--labels", "1,7")
        self.refuse("names label 7", self.spheres, *mesh, "--material", "7:radius=1")
        self.refuse("is none of", self.spheres, *mesh, "--material", "1:size=1")
        self.refuse("names label 7", self.spheres, *mesh, "--interface", "1,7:length=1")
        self.refuse("needs A,B:length=L", self.spheres, *mesh, "--interface", "1:length=1")
        self.refuse("between two labels", self.spheres, *mesh, "--interface", "1,1:length=1")
        self.refuse("belongs to --method particle", self.spheres, *mesh, "--method", "grid", "--epsilon", "0.4")
        self.refuse("belongs to --method particle", self.spheres, *mesh, "--method", "grid", "--smoothing", "volume")
        self.refuse("larger than", self.spheres, *mesh, "--min-length", "3", "--max-length", "2")

    def test_broken_files(self):
        mesh = ("-o", "m.vtp")
        whole = self.spheres.read_bytes()
        (self.folder / "cut.mha").write_bytes(whole[:-200])
        (self.folder / "headless.mhd").write_bytes(whole.split(b"LOCAL")[0] + b"gone.raw\n")
        (self.folder / "text.mha").write_text("hello\n")
        (self.folder / "empty.mha").write_bytes(b"")
        (self.folder / "text.vti").write_text("hello\n")
        (self.folder / "volume.txt").write_text("hello\n")
        sform = np.eye(4)[:3]
        write_nifti(self.folder / "cut.nii", SPHERES, sform, cut=1000)
        write_nifti(self.folder / "cut.nii.gz", SPHERES, sform, cut=100)
        write_nrrd(self.folder / "cut.nrrd", SPHERES, "spacings: 1 1 1\n", cut=100)
        write_nrrd(self.folder / "cutraw.nrrd", SPHERES, "spacings: 1 1 1\n", "raw", cut=100)
        for name in ("cut.mha", "headless.mhd", "text.mha", "empty.mha", "text.vti", "volume.txt", "cut.nii",
                     "cut.nii.gz", "cut.nrrd", "cutraw.nrrd"):
            self.refuse(f"'{name}'", name, *mesh)
        self.refuse("cannot be opened", self.folder, *mesh)

    def test_unsuitable_volumes(self):
        mesh = ("-o", "m.vtp", "--surfaces", "s.vtpc", "--report", "r.json")
        make_volumes.write_mha(self.folder / "flat.mha", SPHERES[16:17])
        self.refuse("32 x 32 x 1", "flat.mha", *mesh)
        write_vti(self.folder / "fractions.vti", SPHERES + 0.25)
        self.refuse("integer label is expected", "fractions.vti", *mesh)
        write_vti(self.folder / "vectors.vti", np.stack([SPHERES] * 3, axis=-1))
        self.refuse("no array of labels", "vectors.vti", *mesh)
        make_volumes.write_mha(self.folder / "blank.mha", np.zeros((16, 16, 16), np.uint8))
        self.refuse("nothing to mesh", "blank.mha", *mesh)
        self.refuse("nothing to mesh", self.spheres, *mesh, "--labels", "0")
        self.refuse("the limit is 0.01 GiB", self.spheres, *mesh, "--memory-limit", "0.01", "--quiet")
        image = vtkImageData()
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(str(self.folder / "none.vti"))
        writer.SetInputData(image)
        writer.Write()
        self.refuse("none.vti", "none.vti", *mesh)
        (self.folder / "skew.nrrd").write_bytes(b"")
        write_nrrd(self.folder / "skew.nrrd", SPHERES, "space dimension: 3\nspace directions: (1,0,0) (1,1,0) (0,0,1)\n")
        self.refuse("right angles", "skew.nrrd", *mesh)
        write_nrrd(self.folder / "needles.nrrd", SPHERES, "spacings: 1 1 1000\n")
        self.refuse("100 times as long as wide", "needles.nrrd", *mesh, "--quiet")
        write_nrrd(self.folder / "far.nrrd", SPHERES, "space origin: (1e20,0,0)\n")
        self.refuse("Move the origin", "far.nrrd", *mesh, "--quiet")

    def test_stopped(self):
        big = self.folder / "big.mha"
        make_volumes.write_mha(big, make_volumes.two_spheres(160))
        process = subprocess.Popen([LABELMESH, big, "-o", "m.vtp"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if "Tighten" in line:
                process.send_signal(signal.SIGINT)
                break
        start = time.monotonic()
        rest = process.stderr.read()
        self.assertEqual(process.wait(timeout=60), 1)
        self.assertLess(time.monotonic() - start, 10)
        self.assertIn("stopped", rest)
        process.stderr.close()
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["big.mha", "spheres.mha"])


if __name__ == "__main__":
    unittest.main()
