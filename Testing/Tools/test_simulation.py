#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Simulation: the block of two layers, solved by CalculiX, against the exact solution."""
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

from labelmesh import vtkAbaqusLabelMeshWriter

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "Testing" / "Python"))
sys.path.insert(0, str(ROOT / "Data"))
import make_volumes  # noqa: E402
from tetra_boxes import as_grid, box  # noqa: E402

LABELMESH = os.environ["LABELMESH_EXECUTABLE"]

EXAMPLE = ROOT / "Examples" / "Simulation" / "two_layers.py"


def solve(mesh):
    return subprocess.run([sys.executable, EXAMPLE, mesh], capture_output=True, text=True, timeout=120)


def write_box(name, size, layer):
    grid = as_grid(*box(size, (-1, 2, 0.5), lambda i, j, k: 1 if k < layer else 2), {0: "out", 1: "soft", 2: "stiff"})
    writer = vtkAbaqusLabelMeshWriter()
    writer.SetInputData(grid)
    writer.SetFileName(name)
    assert writer.Write() == 1


class TestSimulation(unittest.TestCase):
    def test_box(self):
        """M = 1000 (1 - .3) / (1.3 x .4) below and 5000 (1 - .2) / (1.2 x .6) above."""
        for layer, stress in ((1, 0.04 / (1 / 1346.153846 + 3 / 5555.555556)), (3, 0.04 / (3 / 1346.153846 + 1 / 5555.555556))):
            write_box("mesh.inp", (6, 5, 4), layer)
            result = solve("mesh.inp")
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            moved = re.search(r"goes down by ([\d.]+), exactly ([\d.]+)", result.stdout)
            force = re.search(r"force on the top +([\d.]+), exactly ([\d.]+)", result.stdout)
            for found in moved.groups():
                self.assertAlmostEqual(float(found), stress * layer / 1346.153846, places=5)
            for found in force.groups():
                self.assertAlmostEqual(float(found), stress * 30, places=2)

    def test_our_own_mesh(self):
        """The volume two_layers, through the whole chain."""
        make_volumes.main([".", "two_layers"])
        command = [LABELMESH, "two_layers.mha", "--border", "flat", "--background", "9", "--quiet"]
        names = ["--material", "1:name=soft", "--material", "2:name=stiff"]
        subprocess.run([*command, *names, "--tets", "mesh.inp", "-o", "surface.vtp"], check=True, timeout=60)
        result = solve("mesh.inp")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        error = re.search(r"largest error ([\d.e-]+) of the push", result.stdout)
        self.assertLess(float(error.group(1)), 1e-4)
        subprocess.run([*command, *names, "--tets", "mesh.msh", "-o", "surface.vtp"], check=True, timeout=60)
        read = subprocess.run(["gmsh", "-check", "mesh.msh"], capture_output=True, text=True, timeout=60)
        self.assertEqual(read.returncode, 0, read.stdout + read.stderr)
        self.assertNotRegex(read.stdout + read.stderr, "Error|Warning")
        text = Path("mesh.msh").read_text(encoding="utf-8")
        for name in ("soft", "stiff", "soft_stiff", "border_z_max"):
            self.assertIn(f'"{name}"', text)

    def test_an_ending_of_no_format(self):
        result = subprocess.run([LABELMESH, "x.mha", "--tets", "mesh.foo"], capture_output=True, text=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr),
                         (1, "labelmesh: --tets writes a .vtu, .msh or .inp file, found 'mesh.foo'\n"))

    def test_a_model_that_cannot_be_solved(self):
        Path("empty.inp").write_text("*NODE, NSET=NALL\n1,0,0,0\n2,1,1,1\n*NSET, NSET=soft_stiff\n1\n")
        result = solve("empty.inp")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("ccx could not solve", result.stderr)


if __name__ == "__main__":
    unittest.main()
