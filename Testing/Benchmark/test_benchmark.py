#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark on a small volume: what it prints, what it writes, what it says when it cannot."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

BENCHMARK = Path(__file__).resolve().with_name("benchmark.py")
sys.path.insert(0, str(BENCHMARK.parent))
import benchmark  # noqa: E402

LABELMESH = os.environ["LABELMESH_EXECUTABLE"]
VOLUME = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")


def run(*arguments):
    return subprocess.run([sys.executable, str(BENCHMARK), *map(str, arguments)], capture_output=True, text=True)


class TestBenchmark(unittest.TestCase):
    def test_all_tables(self):
        result = run(VOLUME, "--labelmesh", LABELMESH, "--sizes", 32, 48, "--factors", 1, 2, "--repeat", 2,
                     "--json", "all.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("two_spheres_small", "two_spheres@48", "DelaunayLabelMesh", "Times as fast", "power"):
            self.assertIn(word, result.stdout)
        tables = json.loads(Path("all.json").read_text())
        (case,) = tables["cases"]
        self.assertEqual(case["voxels"], 48 ** 3)
        self.assertEqual(case["defects"], 0)
        self.assertGreater(case["particles"], 300)
        self.assertLess(case["min_radius_ratio"], case["p1_radius_ratio"])
        self.assertLess(case["p1_radius_ratio"], case["mean_radius_ratio"])
        self.assertLess(case["seconds"]["Tighten"], case["seconds"]["total"])
        self.assertGreater(case["delaunay_seconds"], 0)
        self.assertAlmostEqual(case["ratio_to_delaunay"], case["seconds"]["total"] / case["delaunay_seconds"])
        one, two = tables["threads"]
        self.assertEqual((one["threads"], two["threads"]), (1, 2))
        self.assertEqual(one["triangles"], two["triangles"])
        self.assertEqual([row["voxels"] for row in tables["sizes"]], [32 ** 3, 48 ** 3])
        once, twice = tables["particles"]
        self.assertEqual(once["triangles"], case["triangles"])
        self.assertAlmostEqual(twice["particles"] / once["particles"], 2, delta=0.4)

    def test_refusals(self):
        for words, arguments in (("no volume 'nothing'", ["nothing", "--labelmesh", LABELMESH]),
                                 ("no executable", [VOLUME, "--labelmesh", "gone"]),
                                 ("no table 'x'", ["--tables", "x"])):
            result = run(*arguments, "--json", "refused.json")
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(words, result.stderr)
            self.assertFalse(Path("refused.json").exists())

    def test_defects_and_medians(self):
        surface = {"open_edges": 1, "nonmanifold_edges": 2, "nonmanifold_vertices": 4}

        def report(total):
            return {"dimensions": [2, 3, 4], "materials": [surface], "background": surface, "wrong_faces": 8,
                    "cells": {"0": 1, "1": 2, "2": 3}, "triangles": 9, "min_radius_ratio": 0.5, "p1_radius_ratio": 0.6,
                    "mean_radius_ratio": 0.9, "duplicate_triangles": 0, "lost": [], "seconds": {"total": total},
                    "peak_memory_bytes": 1 << 20, "threads": 2}

        row = benchmark.summary("x", [report(t) for t in (3.0, 1.0, 8.0)], [0.5, 0.1, 0.9])
        self.assertEqual((row["defects"], row["voxels"], row["particles"]), (22, 24, 6))
        self.assertEqual(row["ratio_to_delaunay"], 6)
        self.assertIsNone(benchmark.summary("x", [report(1.0)], [None])["ratio_to_delaunay"])
        rows = [{"n": 10, "seconds": {"total": 2.0}}, {"n": 20, "seconds": {"total": 8.0}}]
        benchmark.add_powers(rows, "n")
        self.assertAlmostEqual(rows[1]["power"], 2)


if __name__ == "__main__":
    unittest.main()
