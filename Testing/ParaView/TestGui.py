# SPDX-License-Identifier: BSD-3-Clause
"""Opens a volume in the application, chooses Label Mesher in the menu, presses Apply: TestGui.py PARAVIEW SESSION

SESSION_session.py runs in the application first, then SESSION_playback.xml is played.

The application's own exit code says only whether the playback found its widgets, so the session leaves a file that says
whether the mesh was there and was seen.
"""
import os
import subprocess
import sys

paraview, name = sys.argv[1:]
here = os.path.dirname(os.path.abspath(__file__))
output = os.environ["LABELMESH_OUTPUT"]
verdict = os.path.join(output, "verdict.txt")
if os.path.exists(verdict):
    os.remove(verdict)

# Settings of the user's own, e.g. auto-apply, must not reach the test; nor the test's them.
environment = dict(os.environ, HOME=output, XDG_CONFIG_HOME=os.path.join(output, "config"))
try:
    code = subprocess.run([paraview, "--dr", "--script=" + os.path.join(here, name + "_session.py"),
                           "--test-directory=" + output, "--test-script=" + os.path.join(here, name + "_playback.xml"),
                           "--exit"], env=environment, timeout=240).returncode
except subprocess.TimeoutExpired:
    code = "no exit code after 240 s"
said = open(verdict).read() if os.path.exists(verdict) else "the session saw no mesh"
print(f"paraview: {code}; {said}")
sys.exit(0 if code == 0 and said.startswith("passed") else 1)
