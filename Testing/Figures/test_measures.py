# SPDX-License-Identifier: BSD-3-Clause
"""What Examples/Figures counts on meshes, against analytic truth and against labelmesh's own report."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Figures"))
import tables  # noqa: E402
from fields import image_of  # noqa: E402
from judge import judge  # noqa: E402
from mesh import (Mesh, bends, dihedral_angles, inside, minimum_angles, overlaps_and_gaps, radius_ratios, read_mesh,  # noqa: E402
                  read_tetrahedra, read_volume, volume_of)
from thin_wall import box_sums  # noqa: E402


def box(low, high, label=1):
    """A box of twelve triangles, outward."""
    points = np.array([[(low, high)[(n >> axis) & 1][axis] for axis in range(3)] for n in range(8)], float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    return Mesh(points, triangles, np.tile([label, 0], (12, 1)))


class Measures(unittest.TestCase):
    def test_shapes_of_known_triangles(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0.5, 0.75 ** 0.5, 0], [4, 0, 0], [0, 3, 0], [2, 0, 0]])
        mesh = Mesh(points, np.array([[0, 1, 2], [0, 3, 4], [0, 1, 5]]), np.tile([1, 0], (3, 1)))
        np.testing.assert_allclose(radius_ratios(mesh), [1, 2 * 1 / 2.5, 0], atol=1e-12)  # 3-4-5: r = 1, R = 2.5
        np.testing.assert_allclose(minimum_angles(mesh), [60, np.degrees(np.arctan(3 / 4)), 0], atol=1e-5)

    def test_bends_are_those_across_edges_of_one_interface(self):
        cube = box((0, 0, 0), (1, 1, 1))
        np.testing.assert_allclose(bends(cube), 90)
        cube.sides[:] = [[n // 2 + 1, 0] for n in range(12)]  # each face an interface of its own
        np.testing.assert_allclose(bends(cube), 0, atol=1e-6)

    def test_angles_of_a_regular_tetrahedron(self):
        points = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
        np.testing.assert_allclose(dihedral_angles(points, np.array([[0, 1, 2, 3]])), np.degrees(np.arccos(1 / 3)))

    def test_voxels_inside_a_box(self):
        labels = np.zeros((12, 10, 9), np.uint8)
        labels[3:7, 2:8, 4:6] = 1
        volume = volume_of(image_of(labels, spacing=(2, 1, 0.5), origin=(10, -3, 1)))
        low = volume.origin + volume.spacing * (3.5, 1.5, 2.5)
        high = volume.origin + volume.spacing * (5.5, 7.5, 6.5)
        np.testing.assert_array_equal(inside(box(low, high), volume), labels == 1)

    def test_overlaps_and_gaps_are_counted(self):
        labels = np.zeros((12, 12, 24), np.uint8)
        labels[2:10, 2:10, 2:12] = 1
        labels[2:10, 2:10, 12:22] = 2
        volume = volume_of(image_of(labels))
        left = box((1.5, 1.5, 1.5), (11.5, 9.5, 9.5))
        self.assertEqual(overlaps_and_gaps([left, box((11.5, 1.5, 1.5), (21.5, 9.5, 9.5), 2)], volume), (0, 0))
        self.assertEqual(overlaps_and_gaps([left, box((9.5, 1.5, 1.5), (21.5, 9.5, 9.5), 2)], volume), (2 * 8 * 8, 0))
        # A gap one voxel wide; its rim is beside the background and does not count.
        self.assertEqual(overlaps_and_gaps([left, box((12.5, 1.5, 1.5), (21.5, 9.5, 9.5), 2)], volume), (0, 6 * 6))

    def test_box_sums(self):
        field = np.random.default_rng(3).integers(0, 5, (7, 6, 5))
        sums = box_sums(field, 3)
        self.assertEqual(sums.shape, (5, 4, 3))
        self.assertEqual(sums[2, 1, 2], field[2:5, 1:4, 2:5].sum())

    def test_numbers_are_those_of_the_report(self):
        output, name = Path(os.environ["LABELMESH_OUTPUT"]), "two_spheres_small"
        path = Path(os.environ["LABELMESH_VOLUMES"]) / f"{name}.mha"
        mesh, tetrahedra, report = (output / f"{name}.{ending}" for ending in ("vtp", "vtu", "json"))
        subprocess.run([os.environ["LABELMESH_EXECUTABLE"], path, "-o", mesh, "--tets", tetrahedra, "--report", report,
                        "--quiet"], check=True)
        told, made = json.loads(report.read_text()), read_mesh(mesh)
        self.assertAlmostEqual(radius_ratios(made).min(), told["min_radius_ratio"], 6)
        self.assertAlmostEqual(radius_ratios(made).mean(), told["mean_radius_ratio"], 6)
        points, corners, _ = read_tetrahedra(tetrahedra)
        counts = np.histogram(dihedral_angles(points, corners), bins=18, range=(0, 180))[0]
        self.assertEqual(counts.tolist(), told["tetrahedra"]["histogram"])
        judged = judge(made.polydata(), read_volume(path), "again")
        for key in ("points", "triangles", "self_intersecting_pairs", "misclassified_voxels"):
            self.assertEqual(judged[key], told[key], key)
        for mine, its in zip(judged["materials"], told["materials"]):
            self.assertEqual(mine["label"], its["label"])
            self.assertEqual(mine["open_edges"], its["open_edges"])
            self.assertAlmostEqual(mine["mean_radius_ratio"], its["mean_radius_ratio"], 6)
            self.assertAlmostEqual(mine["volume"] / its["volume"], 1, 5)

    def test_tables_are_the_same_in_every_format(self):
        table = tables.Table("t", "A < B", ["volume", "a, b"], [["x", "1,234"], ["y", "5"]])
        self.assertIn("| x | 1,234 |", table.markdown())
        self.assertEqual(table.csv().splitlines(), ['volume,"a, b"', 'x,"1,234"', "y,5"])
        self.assertIn("A &lt; B", table.html())
        self.assertEqual(table.of("y").rows, [["y", "5"]])

    def test_small_ratios_are_not_shown_as_zero(self):
        self.assertEqual([tables.ratio(number) for number in (0.514, 0.0259, 0.0001, 0)], ["0.51", "0.03", "0.0001", "0.00"])


if __name__ == "__main__":
    unittest.main()
