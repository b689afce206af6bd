#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What every mesh of the whole chain keeps, with default settings: on the volumes of Data/make_volumes.py, as they are
and in a turned, mirrored and anisotropic frame. Topology, volumes and ratios are counted here anew from the written
mesh, and compared with the report."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader, vtkXMLPolyDataReader

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Data"))
import make_volumes  # noqa: E402

LABELMESH = os.environ["LABELMESH_EXECUTABLE"]
NAMES = ("two_spheres", "four_quarters", "eight_octants", "nested_shells", "thin_plate", "grains")
# Bounds: the least radius ratio of a triangle, and the share of its volume that a material may win or lose.
LEAST_RATIO = {"grains": 0.55}
VOLUME_SHARE = {"thin_plate": 0.08}


def triangles_of(mesh):
    assert mesh.GetNumberOfPolys() == mesh.GetNumberOfCells(), "polygons only"
    offsets = vtk_to_numpy(mesh.GetPolys().GetOffsetsArray())
    assert (np.diff(offsets) == 3).all(), "triangles only"
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def radius_ratios(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    sides = [np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    # 2 r_in / r_circ = 16 area^2 / (perimeter * product of the sides)
    return 16 * area ** 2 / (sum(sides) * sides[0] * sides[1] * sides[2])


def enclosed_volume(points, triangles):
    a, b, c = (points[triangles[:, i]] - points.mean(axis=0) for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def edge_faults(triangles):
    """Edges of a surface that not exactly two triangles use, in opposite directions."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    forward = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    _, edge, uses = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    balance = np.bincount(edge.ravel(), weights=forward)
    return int(((uses != 2) | (balance != 0)).sum())


def fans(triangles):
    """Fans of triangles around vertices, in a surface without edge faults: as many as vertices where it is manifold."""
    parent = list(range(triangles.size))

    def root(corner):
        while parent[corner] != corner:
            parent[corner] = parent[parent[corner]]
            corner = parent[corner]
        return corner

    seen = {}
    for t, triangle in enumerate(triangles.tolist()):
        for i, j in ((0, 1), (1, 2), (2, 0)):
            a, b = triangle[i], triangle[j]
            here = {a: 3 * t + i, b: 3 * t + j}
            there = seen.setdefault((min(a, b), max(a, b)), here)
            for vertex in (a, b):
                parent[root(here[vertex])] = root(there[vertex])
    return sum(parent[corner] == corner for corner in range(triangles.size))


class TestChain(unittest.TestCase):
    def run_chain(self, volume, stem, threads):
        files = {"mesh": f"{stem}.{threads}.vtp", "particles": f"{stem}.particles.{threads}.vtp"}
        result = subprocess.run(
            [LABELMESH, volume, "-o", files["mesh"], "--particles", files["particles"], "--report", f"{stem}.json",
             "--surfaces", f"{stem}.vtpc", "--threads", str(threads), "--quiet"],
            capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [Path(file).read_bytes() for file in files.values()]

    def check(self, name, frame):
        stem = f"{name}_mirrored" if frame else name
        volume = f"{stem}.mha"
        labels = make_volumes.VOLUMES[name][0]()
        make_volumes.write_mha(volume, labels, **frame)
        self.assertEqual(self.run_chain(volume, stem, 1), self.run_chain(volume, stem, 2), "other bytes by threads")

        report = json.loads(Path(f"{stem}.json").read_text())
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(f"{stem}.2.vtp")
        reader.Update()
        mesh = reader.GetOutput()
        points, triangles = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float), triangles_of(mesh)
        sides = vtk_to_numpy(mesh.GetCellData().GetArray("BoundaryLabels"))
        self.check_triangles(name, report, mesh, points, triangles, sides)
        voxel = np.prod(frame.get("spacing", (1, 1, 1)))
        found = np.unique(labels)
        self.assertEqual([m["label"] for m in report["materials"]], [label for label in found if label != 0])
        for row in report["materials"] + [report["background"]]:
            label = row["label"]
            with self.subTest(volume=stem, label=label):
                own, other = triangles[sides[:, 0] == label], triangles[sides[:, 1] == label]
                surface = np.concatenate([own, other[:, ::-1]])  # seen from the material: normals point out
                self.check_surface(row, points, surface)
                if label == 0:
                    filled = voxel * (labels != 0).sum()
                    self.assertAlmostEqual(-row["volume"] / filled, 1, delta=0.02)
                else:
                    filled = voxel * (labels == label).sum()
                    self.assertAlmostEqual(row["voxel_volume"] / filled, 1, places=9)
                    self.assertAlmostEqual(row["volume"] / filled, 1, delta=VOLUME_SHARE.get(name, 0.02))
                    self.assertAlmostEqual(row["volume"] / row["tight_volume"], 1, delta=0.001)
        self.check_blocks(stem, report, points)
        return report

    def check_triangles(self, name, report, mesh, points, triangles, sides):
        self.assertEqual(report["triangles"], len(triangles))
        self.assertEqual(report["points"], len(points))
        self.assertEqual(len(np.unique(triangles)), len(points), "points that no triangle uses")
        self.assertEqual(len(np.unique(points, axis=0)), len(points), "a point twice")
        self.assertEqual(len(np.unique(np.sort(triangles, axis=1), axis=0)), len(triangles), "a triangle twice")
        self.assertEqual((report["wrong_faces"], report["duplicate_triangles"], report["lost"]), (0, 0, []))
        self.assertTrue(report["certified"])
        ratios = radius_ratios(points, triangles)
        self.assertGreaterEqual(ratios.min(), LEAST_RATIO.get(name, 0.65))
        self.assertGreaterEqual(ratios.mean(), 0.965)
        np.testing.assert_allclose(vtk_to_numpy(mesh.GetCellData().GetArray("RadiusRatio")), ratios, rtol=0, atol=1e-4)
        self.assertAlmostEqual(report["min_radius_ratio"], ratios.min(), places=4)
        self.assertAlmostEqual(report["p1_radius_ratio"], np.sort(ratios)[len(ratios) // 100], places=4)
        # The background is second, else the lower label is first.
        first, second = sides.T
        self.assertTrue(((first != 0) & ((second == 0) | (first < second))).all())
        # Both labels of a triangle are labels of all its points.
        materials = vtk_to_numpy(mesh.GetPointData().GetArray("Materials"))[triangles]
        for side in (first, second):
            self.assertTrue((materials == side[:, None, None]).any(axis=2).all())

    def check_surface(self, row, points, surface):
        self.assertEqual(row["triangles"], len(surface))
        self.assertTrue(row["closed"] and row["manifold"] and row["oriented"], row)
        self.assertEqual(edge_faults(surface), 0)
        self.assertEqual(fans(surface), len(np.unique(surface)), "a vertex where the surface touches itself")
        volume = enclosed_volume(points, surface)
        self.assertAlmostEqual(row["volume"] / volume, 1, places=4)

    def check_blocks(self, stem, report, points):
        """The closed surfaces on their own: the same triangles, turned outwards."""
        reader = vtkXMLPartitionedDataSetCollectionReader()
        reader.SetFileName(f"{stem}.vtpc")
        reader.Update()
        blocks = reader.GetOutput()
        self.assertEqual(blocks.GetNumberOfPartitionedDataSets(), len(report["materials"]))
        for n, row in enumerate(report["materials"]):
            block = blocks.GetPartition(n, 0)
            own = vtk_to_numpy(block.GetPoints().GetData()).astype(float)
            surface = triangles_of(block)
            self.assertEqual((len(surface), edge_faults(surface)), (row["triangles"], 0))
            self.assertAlmostEqual(enclosed_volume(own, surface) / row["volume"], 1, places=4)
            together = np.unique(np.concatenate([points, own]), axis=0)
            self.assertEqual(len(together), len(points), "a surface has points of its own")


class TestTwoSpheres(unittest.TestCase):
    """About as many particles as the paper has on its two spheres, against the spheres themselves."""

    # Centre and radius in voxels; where they overlap, label 1 wins: its surface is the first sphere's.
    SPHERES = {1: (np.array([63.3, 64.2, 78.1]), 34.0), 2: (np.array([64.1, 63.4, 46.2]), 30.0)}

    def test_two_spheres(self):
        make_volumes.write_mha("analytic.mha", make_volumes.two_spheres())
        result = subprocess.run([LABELMESH, "analytic.mha", "-o", "analytic.vtp", "--triangles", "2400", "--deviation", "0.05",
                                 "--quiet"], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName("analytic.vtp")
        reader.Update()
        mesh = reader.GetOutput()
        points, triangles = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float), triangles_of(mesh)
        self.assertLess(abs(len(points) - 1200), 150)
        ratios = radius_ratios(points, triangles)
        self.assertGreaterEqual(ratios.min(), 0.65)
        self.assertGreaterEqual(ratios.mean(), 0.965)
        mean, normals = self.distances(points, triangles, vtk_to_numpy(mesh.GetCellData().GetArray("BoundaryLabels")))
        self.assertLessEqual(mean, 0.10)
        self.assertLessEqual(normals, 3.6)

    def distances(self, points, triangles, sides):
        """Mean distance to the spheres in voxels, over the area, and mean angle of the triangles to them in degrees."""
        corners = points[triangles]
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(cross, axis=1) / 2
        first = np.where((sides == 1).any(axis=1), 1, 2)
        distance, angle, total = 0.0, 0.0, 0.0
        steps = 6
        for label, (centre, radius) in self.SPHERES.items():
            own = first == label
            samples = [(u, v, steps - u - v) for u in range(steps + 1) for v in range(steps + 1 - u)]
            for weights in samples:
                x = np.einsum("i,tix->tx", np.array(weights) / steps, corners[own]) - centre
                distance += (area[own] * abs(np.linalg.norm(x, axis=1) - radius)).sum() / len(samples)
            x = corners[own].mean(axis=1) - centre
            cosine = abs(np.einsum("tx,tx->t", cross[own], x)) / (2 * area[own] * np.linalg.norm(x, axis=1))
            angle += (area[own] * np.degrees(np.arccos(np.clip(cosine, -1, 1)))).sum()
            total += area[own].sum()
        return distance / total, angle / total


def add_tests(name):
    def as_it_is(self):
        report = self.check(name, {})
        if name == "two_spheres":
            self.assertLess(report["seconds"]["total"], 5)

    def mirrored(self):
        self.check(name, make_volumes.oriented_frame())

    setattr(TestChain, f"test_{name}", as_it_is)
    setattr(TestChain, f"test_{name}_mirrored", mirrored)


for volume_name in NAMES:
    add_tests(volume_name)

if __name__ == "__main__":
    unittest.main()
