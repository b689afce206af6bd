# SPDX-License-Identifier: BSD-3-Clause
"""The triangles, coloured by their radius ratio: pvpython quality.py VOLUME [FOLDER]

Writes quality.png and quality.pvsm, which is a state to load in ParaView, into the folder.
"""
import sys

import labelmesh_views

volume, folder = (sys.argv[1:] + ["."])[:2]
mesher = labelmesh_views.open_volume(volume)
labelmesh_views.show_quality(mesher)
labelmesh_views.save("quality", folder)
