#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small synthetic label volumes as compressed MetaImage files (.mha).

    make_volumes.py OUTDIR [NAME...]      all of them when no NAME is given
    make_volumes.py --list

two_spheres@SIZE is two_spheres with SIZE voxels along each side, in two_spheres@SIZE.mha.
Label 0 is the background. Samples lie at the integer coordinates unless a volume says otherwise.
"""
import sys
import zlib
from pathlib import Path

import numpy as np

METAIMAGE_TYPES = {"uint8": "MET_UCHAR", "uint16": "MET_USHORT", "int16": "MET_SHORT", "int32": "MET_INT"}


def write_mha(path, labels, spacing=(1, 1, 1), origin=(0, 0, 0), direction=np.eye(3)):
    """Writes labels[z, y, x]. The columns of `direction` are the axes of the image in the world."""
    data = zlib.compress(np.ascontiguousarray(labels).tobytes(), 6)

    def numbers(values):
        return " ".join(f"{value:.17g}" for value in values)

    header = "\n".join([
        "ObjectType = Image",
        "NDims = 3",
        "BinaryData = True",
        "BinaryDataByteOrderMSB = False",
        "CompressedData = True",
        f"CompressedDataSize = {len(data)}",
        # MetaImage lists the axes one after the other: the columns of the direction matrix.
        f"TransformMatrix = {numbers(np.asarray(direction, float).T.ravel())}",
        f"Offset = {numbers(origin)}",
        "CenterOfRotation = 0 0 0",
        f"ElementSpacing = {numbers(spacing)}",
        f"DimSize = {numbers(labels.shape[::-1])}",
        f"ElementType = {METAIMAGE_TYPES[str(labels.dtype)]}",
        "ElementDataFile = LOCAL",
    ])
    Path(path).write_bytes(header.encode() + b"\n" + data)


def coordinates(size):
    """x, y, z of the samples of a cube, ready to broadcast as [z, y, x]."""
    line = np.arange(size, dtype=float)
    return line[None, None, :], line[None, :, None], line[:, None, None]


def ball(size, centre, radius):
    x, y, z = coordinates(size)
    disc = (x - centre[0]) ** 2 + (y - centre[1]) ** 2
    return disc <= radius ** 2 - (z - centre[2]) ** 2  # no volume of floats: 512 voxels a side are to fit


def two_spheres(size=128):
    """The paper's synthetic example: a ball, and what a second ball adds to it."""
    scale = size / 128
    labels = np.zeros((size,) * 3, np.uint8)
    labels[ball(size, np.array([64.1, 63.4, 46.2]) * scale, 30 * scale)] = 2
    labels[ball(size, np.array([63.3, 64.2, 78.1]) * scale, 34 * scale)] = 1
    return labels


def four_quarters():
    """Four boxes around a line: four materials meet in every one of its points, which is not general position."""
    labels = np.zeros((32, 32, 32), np.uint8)
    for label, (y, x) in enumerate([(4, 4), (4, 16), (16, 4), (16, 16)], start=1):
        labels[4:28, y:y + 12, x:x + 12] = label
    return labels


def eight_octants():
    """Eight boxes around a point."""
    labels = np.zeros((32, 32, 32), np.uint8)
    corners = [(z, y, x) for z in (4, 16) for y in (4, 16) for x in (4, 16)]
    for label, (z, y, x) in enumerate(corners, start=1):
        labels[z:z + 12, y:y + 12, x:x + 12] = label
    return labels


def nested_shells():
    """Three balls in one another: surfaces with cavities and no junction."""
    labels = np.zeros((48, 48, 48), np.uint8)
    for label, radius in enumerate((20.2, 14.1, 7.3), start=1):
        labels[ball(48, (23.6, 23.9, 23.3), radius)] = label
    return labels


def thin_plate():
    """A plate two voxels thick (label 2) between two blocks, and one that stands free (label 3)."""
    labels = np.zeros((40, 48, 48), np.uint8)
    labels[6:34, 6:42, 6:22] = 1
    labels[6:34, 6:42, 24:30] = 4
    labels[6:34, 6:42, 22:24] = 2
    labels[6:34, 6:42, 36:38] = 3
    return labels


def two_layers():
    """A full box in two layers: label 1 below, 2 above. For meshes with a flat border."""
    labels = np.full((16, 20, 24), 2, np.uint8)
    labels[:6] = 1
    return labels


def grains():
    """Twelve Voronoi grains that fill the whole volume: no background between them or around."""
    random = np.random.default_rng(7)
    size = 48
    sites = random.uniform(0, size, (12, 3))
    x, y, z = coordinates(size)
    distances = [(x - s[0]) ** 2 + (y - s[1]) ** 2 + (z - s[2]) ** 2 for s in sites]
    return (np.argmin(distances, axis=0) + 1).astype(np.uint8)


def oriented_frame():
    """Unequal spacings, an origin and a turned and mirrored direction matrix."""
    angle = np.radians(25)
    turned = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    return {"spacing": (1.0, 0.8, 1.25), "origin": (-12.5, 40.0, 7.25), "direction": turned @ np.diag([1, 1, -1])}


# name: (labels, frame of the image)
VOLUMES = {
    "two_spheres": (two_spheres, dict),
    "two_spheres_small": (lambda: two_spheres(48), dict),
    "two_spheres_mirrored": (lambda: two_spheres(48), oriented_frame),
    "four_quarters": (four_quarters, dict),
    "eight_octants": (eight_octants, dict),
    "nested_shells": (nested_shells, dict),
    "thin_plate": (thin_plate, dict),
    "two_layers": (two_layers, dict),
    "grains": (grains, dict),
}


def find(name):
    """The two functions of a name, or None."""
    base, at, size = name.partition("@")
    if not at:
        return VOLUMES.get(name)
    if base == "two_spheres" and size.isdecimal() and 16 <= int(size) <= 2048:
        return lambda: two_spheres(int(size)), dict
    return None


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join(VOLUMES))
        return 0
    if not arguments or arguments[0].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 1
    names = arguments[1:] or list(VOLUMES)
    unknown = [name for name in names if not find(name)]
    if unknown:
        print(f"make_volumes.py: no volume '{unknown[0]}'; there are {', '.join(VOLUMES)}, and two_spheres@SIZE with "
              "a SIZE of 16 to 2048", file=sys.stderr)
        return 1
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        make, frame = find(name)
        write_mha(folder / f"{name}.mha", make(), **frame())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
