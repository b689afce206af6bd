#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Debian package, in a root of its own: test_debian.py CPACK BUILD VERSION PVPYTHON

It is made, installed by dpkg, used - by the application, by Python, and by a ParaView that lies in that root and is told
nothing of plugins - and removed, which leaves nothing. The libraries are the system's.
"""
import filecmp
import glob
import os
import shutil
import subprocess
import sys

cpack, build, version, pvpython = sys.argv[1:5]
volume = os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres_small.mha")
root = os.path.abspath("root")


def run(*command, **options):
    print("+", *command, flush=True)
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=200, **options).stdout


def dpkg(*arguments):
    """As an ordinary user may: what would run in the new root runs here, and there is no cache of libraries to renew."""
    environment = dict(os.environ, PATH=os.path.abspath("stubs") + ":/usr/sbin:/sbin:" + os.environ["PATH"])
    return run("dpkg", f"--root={root}", "--force-depends,not-root,script-chrootless,bad-path", *arguments, env=environment)


def files_in(folder):
    return sorted(os.path.relpath(os.path.join(path, name), folder)
                  for path, folders, names in os.walk(folder) for name in names + [f for f in folders
                  if os.path.islink(os.path.join(path, f))])


for folder in ("root", "stubs", "packages"):
    shutil.rmtree(folder, ignore_errors=True)
for folder in ("root/var/lib/dpkg/info", "root/var/lib/dpkg/updates", "root/var/lib/dpkg/triggers", "stubs"):
    os.makedirs(folder)
open("root/var/lib/dpkg/status", "w").close()
with open("stubs/ldconfig", "w") as stub:
    stub.write("#!/bin/sh\n")
os.chmod("stubs/ldconfig", 0o755)

run(cpack, "--config", os.path.join(build, "CPackConfig.cmake"), "-B", os.path.abspath("packages"))
(package,) = glob.glob("packages/*.deb")
assert run("dpkg-deb", "--field", package, "Version").strip() == version
depends = run("dpkg-deb", "--field", package, "Depends")
for needed in ("paraview (>= 5.11", "python3-paraview", "libtet1.5", "libc6"):
    assert needed in depends, f"{needed} is missing in: {depends}"
dpkg("--install", package)

# The application.
clean = {name: value for name, value in os.environ.items() if name not in ("PV_PLUGIN_PATH", "PYTHONPATH", "LD_LIBRARY_PATH")}
assert version in run(f"{root}/usr/bin/labelmesh", "--version", env=clean)
run(f"{root}/usr/bin/labelmesh", volume, "-o", "installed.vtp", "--quiet", env=clean)
run(os.environ["LABELMESH_EXECUTABLE"], volume, "-o", "built.vtp", "--quiet")
assert filecmp.cmp("installed.vtp", "built.vtp", shallow=False)

# Python, where Debian's Python looks.
there = dict(clean, PYTHONPATH=f"{root}/usr/lib/python3/dist-packages")
said = run("/usr/bin/python3", "-c", "import labelmesh; print(labelmesh.__version__, labelmesh.vtkLabelMesher().GetEpsilon(), "
           "labelmesh.__file__)", env=there)
assert said.split()[0] == version and said.split()[-1].startswith(root), said

# ParaView finds the plugin beside itself.
own = shutil.copy(os.path.realpath(pvpython), f"{root}/usr/bin/pvpython")
script = f"""
from paraview.simple import *
volume = OpenDataFile({volume!r})
volume.UpdatePipeline()
mesher = LabelMesher(Input=volume)
mesher.UpdatePipeline()
plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
print([(plugins.GetPluginFileName(n), plugins.GetPluginVersion(n)) for n in range(plugins.GetNumberOfPlugins())
       if plugins.GetPluginName(n) == "LabelMesh"])
print("triangles:", mesher.GetDataInformation(0).GetNumberOfCells())
"""
said = run(own, "-c", script, env=clean)
print(said)
assert f"{root}/usr/" in said and f"'{version}'" in said, said
assert int(said.split("triangles:")[1]) > 500, said
os.remove(own)

dpkg("--remove", "labelmesh")
assert not files_in(f"{root}/usr"), files_in(f"{root}/usr")
print("installed, used, and gone")
