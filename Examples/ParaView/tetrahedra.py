# SPDX-License-Identifier: BSD-3-Clause
"""A cut through whole tetrahedra, coloured by their radius ratio: pvpython tetrahedra.py VOLUME [FOLDER]

Writes tetrahedra.png and tetrahedra.pvsm, which is a state to load in ParaView, into the folder.
"""
import sys

import labelmesh_views

volume, folder = (sys.argv[1:] + ["."])[:2]
mesher = labelmesh_views.open_volume(volume, Tetrahedra="Packed")
labelmesh_views.show_tetrahedra(mesher)
labelmesh_views.save("tetrahedra", folder)
