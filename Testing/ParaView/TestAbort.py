# SPDX-License-Identifier: BSD-3-Clause
"""Stops Label Mesher from the application: TestAbort.py PARAVIEW XDOTOOL

The filter has to end soon after the key, with nothing in its output, must not work again by itself, and has to when
Apply is pressed once more.
"""
import os
import subprocess
import sys
import time

paraview, xdotool = sys.argv[1:]
here = os.path.dirname(os.path.abspath(__file__))
output = os.environ["LABELMESH_OUTPUT"]
log = os.path.join(output, "abort.txt")
if os.path.exists(log):
    os.remove(log)
LIMIT = 2.0  # seconds; on an idle machine it is a tenth of a second


def events():
    if not os.path.exists(log):
        return []
    with open(log) as file:
        return [line.split() for line in file.read().splitlines()]


def wait_for(what, seconds):
    until = time.time() + seconds
    while time.time() < until and session.poll() is None:
        found = [float(when) for name, when in events() if name.startswith(what)]
        if found:
            return found[0]
        time.sleep(0.05)
    return None


environment = dict(os.environ, HOME=output, XDG_CONFIG_HOME=os.path.join(output, "config"),
                   PYTHONPATH=os.environ.get("PYTHONPATH", ""))
session = subprocess.Popen([paraview, "--dr", "--script=" + os.path.join(here, "abort_session.py"),
                            "--test-directory=" + output, "--test-script=" + os.path.join(here, "abort_playback.xml"),
                            "--exit"], env=environment)
try:
    started = wait_for("start", 150)
    assert started, "the filter did not start"
    time.sleep(1.5)
    window = subprocess.run([xdotool, "search", "--onlyvisible", "--name", "ParaView"], capture_output=True, text=True,
                            check=True).stdout.split()[-1]
    subprocess.run([xdotool, "windowfocus", window], check=True)
    assert not [e for e in events() if e[0].startswith("end")], "the filter was done before it could be stopped"
    pressed = time.time()
    subprocess.run([xdotool, "key", "Escape"], check=True)
    ended = wait_for("end", 60)
    code = session.wait(timeout=120)
finally:
    session.kill()
    session.wait()
for event in events():
    print(*event)
assert ended, "the filter did not end"
print(f"stopped {ended - pressed:.2f} s after the key; paraview: {code}")
assert ended - pressed < LIMIT
runs = [(name, float(when)) for name, when in events() if name.startswith(("start", "end"))]
names = [name for name, _ in runs]
assert names[1] == "end:1:0", f"{names[1]}: expected an aborted filter with no points"
# Pictures ask for the filter again; it must not work for them.
last_aborted = max(n for n, name in enumerate(names) if name == "end:1:0")
assert all(runs[n][1] - runs[n - 1][1] < 0.5 for n in range(3, last_aborted + 1, 2)), "it started again by itself"
finished = [int(name.split(":")[2]) for name in names[last_aborted + 1:] if name.startswith("end:0:")]
assert finished and finished[-1] > 1000, f"{names[last_aborted:]}: expected a mesh after the second Apply"
assert code == 0
