# SPDX-License-Identifier: BSD-3-Clause
"""A mesh made on a remote server: TestClientServer.py PVSERVER"""
import os
import socket
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from common import open_volume  # noqa: E402

from paraview import servermanager  # noqa: E402
from paraview.simple import Connect, Disconnect, LoadPlugin  # noqa: E402

with socket.socket() as probe:  # a port that is free now
    probe.bind(("127.0.0.1", 0))
    port = probe.getsockname()[1]
server = subprocess.Popen([sys.argv[1], f"--server-port={port}"])
try:
    Connect("127.0.0.1", port)  # tries again until the server listens
    plugin = os.environ["LABELMESH_PLUGIN"]
    LoadPlugin(plugin, remote=True, ns=globals())
    LoadPlugin(plugin, remote=False, ns=globals())

    mesher = LabelMesher(Input=open_volume("two_spheres_small"), MaximumLength=4.0)
    mesher.UpdatePipeline()
    mesh = servermanager.Fetch(mesher)
    assert mesh.GetNumberOfPolys() > 500, mesh.GetNumberOfPolys()
    print(f"{mesh.GetNumberOfPolys()} triangles from the server")
    Disconnect()
finally:
    server.terminate()
    server.wait()
