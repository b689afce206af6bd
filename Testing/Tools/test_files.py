#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damages files by chance and hands them to labelmesh: test_files.py [FIRST COUNT] takes that many seeds per format.

Each run ends in time, and either writes a mesh (the damage may have left a volume: another spacing, another label) and
exits with 0, or says one line, exits with 1 and writes nothing.
"""
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Data"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import make_volumes  # noqa: E402
from test_labelmesh import LABELMESH, write_nifti, write_nrrd, write_vti  # noqa: E402

LABELS = make_volumes.two_spheres(12)
SECONDS = 30  # one run takes a tenth of one
MEMORY = 8 << 30  # a header may ask for any size: of address space, so that a refusal need not come from the kernel


def write_mhd(path, labels):
    make_volumes.write_mha(path.with_suffix(".mha"), labels)
    header, data = path.with_suffix(".mha").read_bytes().split(b"LOCAL\n")
    path.with_suffix(".mha").unlink()
    path.write_bytes(header + b"labels.zraw\n")
    (path.parent / "labels.zraw").write_bytes(data)


SFORM = np.array([[0.0, -1, 0, 3], [1, 0, 0, 4], [0, 0, 2, 5]])
FORMATS = {
    "volume.mha": make_volumes.write_mha,
    "volume.mhd": write_mhd,
    "volume.nrrd": lambda path, labels: write_nrrd(path, labels, "spacings: 1 1 2\n"),
    "raw.nrrd": lambda path, labels: write_nrrd(path, labels, "spacings: 1 1 2\n", "raw"),
    "volume.nii": lambda path, labels: write_nifti(path, labels, SFORM),
    "volume.nii.gz": lambda path, labels: write_nifti(path, labels, SFORM),
    "volume.vti": write_vti,
}


def head_of(data):
    """How many bytes are worth damaging more than others: all before the voxels."""
    for end in (b"ElementDataFile", b"\n\n", b"<DataArray"):
        if end in data[:2000]:
            return data.index(end) + 40
    return min(len(data), 352)


def damage(data, chance):
    """The same for the same chance: shorter, longer, or with other bytes."""
    data = bytearray(data)
    kind = chance.choice(("cut", "flip", "flip", "digit", "digit", "remove", "insert", "repeat"))
    at = chance.randrange(chance.choice((head_of(data), len(data))))
    if kind == "cut":
        del data[at:]
    elif kind == "remove":
        del data[at:at + chance.randint(1, 40)]
    elif kind == "insert":
        data[at:at] = chance.randbytes(chance.randint(1, 40))
    elif kind == "repeat":
        data[at:at] = data[at:at + chance.randint(1, 200)]
    elif kind == "digit":
        digits = [n for n in range(min(head_of(data), len(data))) if 48 <= data[n] <= 57] or [at % len(data)]
        at = chance.choice(digits)
        data[at:at + 1] = chance.choice((b"0", b"-1", b"9", b"99999999", b"1e9", b"nan", b""))
    else:
        for _ in range(chance.choice((1, 1, 4, 50))):
            data[chance.randrange(chance.choice((head_of(data), len(data))))] = chance.randrange(256)
    return kind, bytes(data)


def run(folder, name):
    return subprocess.run([LABELMESH, name, "-o", "mesh.vtp", "--surfaces", "parts.vtpc", "--quiet"], cwd=folder,
                          capture_output=True, timeout=SECONDS,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))


def fault_of(folder, name):
    """What is wrong with how labelmesh takes a file; empty when nothing is."""
    before = sorted(folder.rglob("*"))
    try:
        result = run(folder, name)
    except subprocess.TimeoutExpired:
        return "no end"
    new = sorted(path.name for path in set(folder.rglob("*")) - set(before))
    words = result.stderr.decode(errors="replace")
    if result.returncode == 0:
        return "" if "mesh.vtp" in new and "parts.vtpc" in new and not words else f"exit 0 with {new}, {words!r}"
    one_line = len(words.splitlines()) == 1 and words.startswith("labelmesh: ")
    return "" if result.returncode == 1 and one_line and not new else f"exit {result.returncode}, {new}, {words!r}"


def run_seed(name, write, seed):
    """Returns what was done, what was wrong with the result, whether the file was refused. Seed 0 damages nothing."""
    with tempfile.TemporaryDirectory(dir=os.environ.get("LABELMESH_OUTPUT")) as text:
        folder = Path(text)
        write(folder / name, LABELS)
        what = "nothing"
        if seed:
            chance = random.Random(f"{name} {seed}")
            victim = chance.choice(sorted(folder.iterdir()))
            kind, data = damage(victim.read_bytes(), chance)
            victim.write_bytes(data)
            what = f"{kind} in {victim.name}"
        fault = fault_of(folder, name)
        return what, fault, not (folder / "mesh.vtp").exists()


def main(first=1, count=40):
    failures = refusals = 0
    for name, write in FORMATS.items():
        for seed in [0, *range(first, first + count)]:
            what, fault, refused = run_seed(name, write, seed)
            refusals += refused
            if fault or (refused and seed == 0):
                failures += 1
                print(f"{name}, seed {seed}, {what}: {fault or 'refused'}", flush=True)
    print(f"{len(FORMATS) * count} damaged files, {refusals} refused, {failures} failures")
    return 1 if failures or not 0 < refusals < len(FORMATS) * count else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
