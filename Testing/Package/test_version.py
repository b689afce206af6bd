#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One version everywhere: test_version.py SOURCES VERSION. CMakeLists.txt says which; the rest of the programs take it from
there, and what is written by hand has to agree."""
import os
import re
import subprocess
import sys

import labelmesh

sources, version = sys.argv[1:3]


def found(pattern, *path):
    with open(os.path.join(sources, *path)) as file:
        return re.search(pattern, file.read(), re.MULTILINE).group(1)


said = subprocess.run([os.environ["LABELMESH_EXECUTABLE"], "--version"], capture_output=True, text=True, check=True).stdout
versions = {
    "labelmesh --version": re.search(r"(\d+\.\d+\.\d+)", said).group(1),
    "labelmesh.__version__": labelmesh.__version__,
    "CITATION.cff": found(r"^version: (.*)$", "CITATION.cff"),
    "CHANGELOG.md": found(r"^## (\S+)", "CHANGELOG.md"),
    "Examples/Cxx": found(r"find_package\(LabelMesh (\S+) REQUIRED\)", "Examples", "Cxx", "CMakeLists.txt"),
    "Examples/Conditioning": found(r"find_package\(LabelMesh (\S+) REQUIRED\)", "Examples", "Conditioning", "CMakeLists.txt"),
}
print(versions)
for where, said in versions.items():
    asked = version.rsplit(".", 1)[0] if where.startswith("Examples") else version
    assert said == asked, f"{where} says {said}, CMakeLists.txt {version}"
