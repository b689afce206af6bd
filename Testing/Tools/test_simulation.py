#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Simulation: the block of two layers, solved by CalculiX, against the exact solution."""
import re
import subprocess
import sys
import unittest
from pathlib import Path

from labelmesh import vtkAbaqusLabelMeshWriter

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "Testing" / "Python"))
from tetra_boxes import as_grid, box  # noqa: E402

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

    def test_a_model_that_cannot_be_solved(self):
        Path("empty.inp").write_text("*NODE, NSET=NALL\n1,0,0,0\n2,1,1,1\n*NSET, NSET=soft_stiff\n1\n")
        result = solve("empty.inp")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("ccx could not solve", result.stderr)


if __name__ == "__main__":
    unittest.main()
