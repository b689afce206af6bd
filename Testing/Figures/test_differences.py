# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of pictures itself: what is the same passes, what differs is caught and leaves its difference."""
import os
import sys
import unittest
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parent))
from compare_images import THRESHOLD, difference  # noqa: E402

BASELINE = Path(__file__).resolve().parent / "Baseline" / "two_spheres_small.figure_7_shared_boundary.png"


class Differences(unittest.TestCase):
    def setUp(self):
        self.folder = Path(os.environ["LABELMESH_OUTPUT"])
        self.output = self.folder / "difference.png"
        self.output.unlink(missing_ok=True)
        self.picture = plt.imread(BASELINE)[:, :, :3].copy()

    def error(self):
        made = self.folder / "made.png"
        plt.imsave(made, self.picture)
        return difference(made, BASELINE, self.output)

    def test_the_same_picture_has_no_error(self):
        self.assertEqual(self.error(), 0)
        self.assertFalse(self.output.exists())

    def test_a_little_noise_passes(self):
        self.picture[:, :, 0] = (self.picture[:, :, 0] * 253 / 255).clip(0, 1)
        self.assertLess(self.error(), THRESHOLD)

    def test_another_colour_of_a_part_is_caught(self):
        high, wide = self.picture.shape[:2]
        part = self.picture[high // 3:high // 2, :wide // 3]
        part[:] = part[:, :, ::-1]
        self.assertGreater(self.error(), THRESHOLD)
        self.assertGreater(self.output.stat().st_size, 0)

    def test_a_missing_panel_is_caught(self):
        self.picture[:, self.picture.shape[1] * 2 // 3:] = 1
        self.assertGreater(self.error(), THRESHOLD)
        self.assertTrue(self.output.exists())

    def test_another_size_is_caught(self):
        self.picture = self.picture[:-5]
        self.assertEqual(self.error(), float("inf"))
        self.assertTrue(self.output.exists())


if __name__ == "__main__":
    unittest.main()
