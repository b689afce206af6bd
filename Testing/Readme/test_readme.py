#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs what the README tells its readers to run.

usage: test_readme.py README SECTION [PYTHON]

Takes the code blocks below the heading SECTION. A shell block is run line by line, with the built labelmesh; a Python
block by PYTHON (python3 or pvpython). The volumes that the blocks name lie in LABELMESH_VOLUMES.
"""
import os
import re
import shutil
import subprocess
import sys


def blocks(readme, heading):
    section = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", readme, re.S | re.M)
    assert section, f"the README has no section '{heading}'"
    return re.findall(r"^```(\w+)\n(.*?)^```", section.group(1), re.S | re.M)


def main():
    readme, heading = sys.argv[1], sys.argv[2]
    with open(readme, encoding="utf-8") as file:
        found = blocks(file.read(), heading)
    assert found, f"no code under '{heading}'"
    shutil.copy(os.path.join(os.environ["LABELMESH_VOLUMES"], "two_spheres.mha"), ".")
    ran = 0
    for language, code in found:
        if language == "sh":
            folder = os.path.dirname(os.environ["LABELMESH_EXECUTABLE"])
            environment = {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"]}
            for line in code.strip().splitlines():
                print("+", line, flush=True)
                subprocess.run(line, shell=True, check=True, env=environment)
                ran += 1
                for name in re.findall(r"\S+\.(?:vtp|vtpc|json)\b", line):
                    assert os.path.getsize(name) > 0, f"{line} left no {name}"
        elif language == "python":
            with open("block.py", "w", encoding="utf-8") as file:
                file.write(code)
            subprocess.run([*sys.argv[3:], "block.py"], check=True)
            ran += 1
            for name in re.findall(r'SaveData\("([^"]+)"', code):
                assert os.path.getsize(name) > 0, f"the block left no {name}"
    assert ran, f"nothing under '{heading}' was run"


if __name__ == "__main__":
    main()
