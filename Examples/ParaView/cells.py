# SPDX-License-Identifier: BSD-3-Clause
"""Curves of three materials as tubes, points of four as spheres: pvpython cells.py VOLUME [FOLDER]

Writes cells.png and cells.pvsm, which is a state to load in ParaView, into the folder.
"""
import sys

import labelmesh_views

volume, folder = (sys.argv[1:] + ["."])[:2]
mesher = labelmesh_views.open_volume(volume)
labelmesh_views.show_cells(mesher)
labelmesh_views.save("cells", folder)
