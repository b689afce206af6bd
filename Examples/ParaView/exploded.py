# SPDX-License-Identifier: BSD-3-Clause
"""The materials, moved apart: pvpython exploded.py VOLUME [FOLDER]

Writes exploded.png and exploded.pvsm, which is a state to load in ParaView, into the folder.
"""
import sys

import labelmesh_views

volume, folder = (sys.argv[1:] + ["."])[:2]
mesher = labelmesh_views.open_volume(volume)
labelmesh_views.show_exploded(mesher, factor=0.6)
labelmesh_views.save("exploded", folder)
