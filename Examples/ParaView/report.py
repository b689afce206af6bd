# SPDX-License-Identifier: BSD-3-Clause
"""The table and the histogram of Label Mesh Report beside the mesh: pvpython report.py VOLUME [FOLDER]

Writes report.png and report.pvsm, which is a state to load in ParaView, into the folder.
"""
import sys

import labelmesh_views
from paraview.simple import GetActiveViewOrCreate, GetLayout

volume, folder = (sys.argv[1:] + ["."])[:2]
mesher = labelmesh_views.open_volume(volume)
view = GetActiveViewOrCreate("RenderView")
labelmesh_views.show_quality(mesher, view)
labelmesh_views.show_report(mesher, view)
labelmesh_views.save("report", folder, GetLayout(view))
