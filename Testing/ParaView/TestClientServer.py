# SPDX-License-Identifier: BSD-3-Clause
"""The same data from every kind of server: TestClientServer.py PVPYTHON PVSERVER PVBATCH MPIEXEC

The built-in server, pvserver with one and with two processes, and pvbatch with two.
"""
import json
import os
import socket
import subprocess
import sys

pvpython, pvserver, pvbatch, mpiexec = sys.argv[1:5]
digests = os.path.join(os.path.dirname(os.path.abspath(__file__)), "digests.py")
LIMIT = 120  # seconds: processes that wait for each other for ever are a fault, too


def processes(count):
    return [mpiexec, "-n", str(count), "--oversubscribe"]


def run(*command):
    print("+", *command, flush=True)
    subprocess.run(command, check=True, timeout=LIMIT)


def with_server(count, name):
    with socket.socket() as probe:  # a port that is free now
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    server = subprocess.Popen([*processes(count), pvserver, f"--server-port={port}"])
    try:
        run(pvpython, digests, name, "127.0.0.1", str(port))
        server.wait(timeout=LIMIT)  # it ends when its client leaves
    finally:
        server.terminate()
        server.wait()


run(pvpython, digests, "built-in.json")
expected = json.load(open("built-in.json"))
with_server(1, "one-process.json")
with_server(2, "two-processes.json")
run(*processes(2), pvbatch, digests, "batch.json")
for name in ("one-process.json", "two-processes.json", "batch.json"):
    found = json.load(open(name))
    wrong = [what for what in expected if found.get(what) != expected[what]]
    assert found.keys() == expected.keys() and not wrong, f"{name} differs from the built-in server in {wrong}"
print(f"{len(expected)} results, the same from all servers")
