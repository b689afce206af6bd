#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes for simulation as others read them: Gmsh the .msh files, CalculiX the .inp files. Three materials whose volumes,
areas and counts are known: a box of 4 x 3 x 5, the label 1 in its lowest two layers, 2 above, and a cube of the label 9
in one corner of the top; the cubes of the grid are cut into six tetrahedra each."""
import json
import math
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from labelmesh import vtkAbaqusLabelMeshWriter, vtkGmshLabelMeshWriter

from tetra_boxes import as_grid, box

HERE = Path(__file__).resolve().parent
SIZE = (4, 3, 5)
ORIGIN = np.array([0.1, -1 / 3, 1e-7])
MATERIALS = {0: "outside", 1: "lower layer", 2: "upper", 9: "corner"}
VOLUMES = {"lower layer": 24.0, "upper": 35.0, "corner": 1.0}
# The sum of the vectors of the areas, the area, the nodes.
FACES = {
    "lower layer_upper": ((0, 0, 12), 12, 20),
    "lower layer_outside": ((0, 0, -12), 12 + 28, 20 + 14 * 2),
    "upper_corner": ((1, 1, 1), 3, 7),
    "upper_outside": ((-1, -1, 11), 11 + 2 * 21 - 2, 19 + 14 * 3),
    "corner_outside": ((1, 1, 1), 3, 7),
    "border_x_min": ((-15, 0, 0), 15, 24), "border_x_max": ((15, 0, 0), 15, 24),
    "border_y_min": ((0, -20, 0), 20, 30), "border_y_max": ((0, 20, 0), 20, 30),
    "border_z_min": ((0, 0, -12), 12, 20), "border_z_max": ((0, 0, 12), 12, 20),
}


def label_of(i, j, k):
    return 1 if k < 2 else 9 if (i, j, k) == (3, 2, 4) else 2


def three_materials():
    return box(SIZE, ORIGIN, label_of)


def write(writer, grid, name):
    writer.SetInputData(grid)
    writer.SetFileName(name)
    assert writer.Write() == 1
    return name


def positive(points, corners):
    a, b, c, d = np.moveaxis(points[corners], 1, 0)
    turned = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
    corners = corners.copy()
    corners[turned] = corners[turned][:, [0, 1, 3, 2]]
    return corners


class TestGmsh(unittest.TestCase):
    def read(self, name):
        result = subprocess.run([sys.executable, HERE / "read_msh.py", name], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def check(self, binary):
        points, corners, labels = three_materials()
        writer = vtkGmshLabelMeshWriter()
        writer.SetBinary(binary)
        found = self.read(write(writer, as_grid(points, corners, labels, MATERIALS), f"box{binary}.msh"))
        self.assertEqual(found["complaints"], [])
        self.assertEqual(found["coordinates"], [float(x).hex() for x in points.ravel()], "to the last bit")
        self.assertEqual([found["corners"][str(n + 1)] for n in range(len(corners))],
                         (positive(points, corners) + 1).tolist())
        volumes = {group["name"]: group for group in found["groups"] if group["dimension"] == 3}
        faces = {group["name"]: group for group in found["groups"] if group["dimension"] == 2}
        self.assertEqual({group["tag"]: name for name, group in volumes.items()}, {1: "lower layer", 2: "upper", 9: "corner"})
        for name, volume in VOLUMES.items():
            self.assertAlmostEqual(volumes[name]["volume"], volume, places=9)
            self.assertGreater(volumes[name]["least"], 0.1)
            self.assertEqual(volumes[name]["elements"], 6 * volume)
        self.assertEqual(set(faces), set(FACES))
        for name, (vector, area, nodes) in FACES.items():
            self.assertLess(np.abs(np.subtract(faces[name]["vector"], vector)).max(), 1e-9, name)
            self.assertAlmostEqual(faces[name]["area"], area, places=9, msg=name)
            self.assertEqual(faces[name]["elements"], 2 * area, name)
            self.assertEqual(faces[name]["nodes"], nodes, name)
        # Inside the box are 3 x 2 x 4 nodes, of which the interface of the layers has 3 x 2 and the corner one.
        self.assertEqual(found["classified"]["3"], 3 * 2 * 4 - 3 * 2 - 1)
        self.assertEqual(sum(found["classified"].values()), len(points))
        for volume, surfaces in found["boundaries"]:
            self.assertGreater(len(surfaces), 1, volume)

    def test_text(self):
        self.check(0)

    def test_binary(self):
        self.check(1)

    def test_gmsh_writes_what_it_read(self):
        """The program itself, with its own check, and the whole way round through its own writer."""
        name = write(vtkGmshLabelMeshWriter(), as_grid(*three_materials(), MATERIALS), "again.msh")
        result = subprocess.run(["gmsh", name, "-save", "-format", "msh2", "-o", "again2.msh", "-v", "3"],
                                capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotRegex(result.stdout + result.stderr, "Warning|Error")
        again = self.read("again2.msh")
        self.assertEqual({group["name"]: group["elements"] for group in again["groups"] if group["dimension"] == 3},
                         {name: 6 * volume for name, volume in VOLUMES.items()})

    def test_names_and_labels_of_every_kind(self):
        points, corners, labels = three_materials()
        labels = np.where(labels == 1, -5, np.where(labels == 2, 2**40, 7))
        names = {-5: 'a "quoted" name', 0: "", 7: "ä" * 100, 2**40: "x\ny"}
        found = self.read(write(vtkGmshLabelMeshWriter(), as_grid(points, corners, labels, names), "names.msh"))
        self.assertEqual(found["complaints"], [])
        self.assertEqual([(g["tag"], g["name"], g["elements"]) for g in found["groups"] if g["dimension"] == 3],
                         [(1, "a _quoted_ name", 144), (2, "ä" * 60, 6), (3, "x_y", 210)])


class TestCalculix(unittest.TestCase):
    def solve(self, model, name):
        Path(f"{name}.inp").write_text(model, encoding="ascii")
        self.assertIsNotNone(shutil.which("ccx"), "CalculiX (calculix-ccx) is not installed")
        result = subprocess.run(["ccx", "-i", name], capture_output=True, text=True, timeout=120)
        output = result.stdout + result.stderr
        self.assertEqual(result.returncode, 0, output)
        self.assertNotRegex(output, r"\*(ERROR|WARNING)", output)
        return Path(f"{name}.dat").read_text()

    def test_sets(self):
        """Squeezed by its side z max, all other sides held: volumes of the element sets, areas and normals of the
        surfaces, counts of the node sets, as CalculiX prints them."""
        mesh = write(vtkAbaqusLabelMeshWriter(), as_grid(*three_materials(), MATERIALS), "mesh.inp")
        names = {name: name.replace(" ", "_") for name in [*VOLUMES, *FACES]}
        model = f"*INCLUDE, INPUT={mesh}\n*MATERIAL, NAME=M\n*ELASTIC\n1000, 0.25\n"
        for name in VOLUMES:
            model += f"*SOLID SECTION, ELSET={names[name]}, MATERIAL=M\n"
        for axis, side in enumerate("xyz"):
            model += f"*BOUNDARY\nborder_{side}_min, {axis + 1}\n"
        model += "*BOUNDARY\nborder_x_max, 1\nborder_y_max, 2\n"
        model += "*STEP\n*STATIC\n*BOUNDARY\nborder_z_max, 3, 3, -0.5\n"
        for name in [*VOLUMES, "EALL"]:
            model += f"*EL PRINT, ELSET={names.get(name, name)}, TOTALS=ONLY\nEVOL\n"
        for name in FACES:
            model += f"*NODE PRINT, NSET={names[name]}\nU\n*SECTION PRINT, SURFACE={names[name]}, NAME=S\nSOF\n"
        dat = self.solve(model + "*END STEP\n", "sets")

        volumes = dict(re.findall(r"total volume.*for set (\S+) and time.*\n\n\s+(\S+)", dat))
        for name, volume in VOLUMES.items():
            self.assertAlmostEqual(float(volumes[names[name].upper()]), volume, delta=1e-5 * volume)
        self.assertAlmostEqual(float(volumes["EALL"]), math.prod(SIZE), delta=1e-3)

        printed = {}
        for found in re.finditer(r"displacements .*for set (\S+) and time.*\n\n((?:\s+\d+(?:\s+\S+){3}\n)+)", dat):
            printed[found.group(1)] = [line.split() for line in found.group(2).strip().splitlines()]
        for name, (_, _, nodes) in FACES.items():
            rows = printed[names[name].upper()]
            self.assertEqual(len({row[0] for row in rows}), len(rows))
            self.assertEqual(len(rows), nodes, name)
        for row in printed["BORDER_Z_MAX"]:
            self.assertAlmostEqual(float(row[3]), -0.5)
        # One material, held all around: the strain is the same everywhere.
        for row in printed["LOWER_LAYER_UPPER"]:
            self.assertAlmostEqual(float(row[3]), -0.2, places=6)
        sections = re.findall(
            r"statistics for surface set (\S+)\s.*?center of gravity.*?\n\n(.*?)\n.*?area.*?\n\n(.*?)\n", dat, re.S)
        self.assertEqual(len(sections), len(FACES), dat[:3000])
        for name, first, second in sections:
            key = next(key for key in FACES if names[key].upper() == name)
            vector, area, _ = FACES[key]
            self.assertAlmostEqual(float(second.split()[0]), area, delta=1e-5 * area, msg=name)
            mean_normal = np.array(first.split()[3:6], float)
            self.assertLess(np.abs(mean_normal - np.divide(vector, area)).max(), 1e-5, name)


if __name__ == "__main__":
    unittest.main()
