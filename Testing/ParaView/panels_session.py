# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the application before the playback, which does the checks: opens a volume."""
import os

from paraview import simple

volume = simple.OpenDataFile(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha"))
simple.Show(volume)
simple.SetActiveSource(volume)
with open(os.path.join(os.environ["LABELMESH_OUTPUT"], "verdict.txt"), "w") as file:
    file.write("passed, if the playback did")
