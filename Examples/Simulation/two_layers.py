#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Squeezes a block of two layers with CalculiX and compares with the exact solution: two_layers.py MESH.inp

MESH.inp is the mesh of the volume two_layers of Data/make_volumes.py, its materials called soft and stiff:

    labelmesh two_layers.mha --border flat --background 9 --material 1:name=soft --material 2:name=stiff \\
      --tets mesh.inp -o surface.vtp

The top is pushed down by a hundredth of the height; the other sides may not move outwards or inwards, but slide. Then
each layer's strain is the same everywhere, and the layers are springs in series: with the stiffness of a side-held
material M = E (1 - nu) / ((1 + nu) (1 - 2 nu)), the stress is s = push / (h1 / M1 + h2 / M2), and the interface goes down
by s h1 / M1. Linear tetrahedra can do exactly that, so all that is left is how flat the interface is."""
import re
import subprocess
import sys
from pathlib import Path

MODULI = {"soft": (1000.0, 0.3), "stiff": (5000.0, 0.2)}  # Young's modulus, Poisson's ratio

MODEL = """\
*INCLUDE, INPUT={mesh}
*MATERIAL, NAME=M_SOFT
*ELASTIC
{soft[0]}, {soft[1]}
*MATERIAL, NAME=M_STIFF
*ELASTIC
{stiff[0]}, {stiff[1]}
*SOLID SECTION, ELSET=soft, MATERIAL=M_SOFT
*SOLID SECTION, ELSET=stiff, MATERIAL=M_STIFF
*BOUNDARY
border_x_min, 1
border_x_max, 1
border_y_min, 2
border_y_max, 2
border_z_min, 3
*STEP
*STATIC
*BOUNDARY
border_z_max, 3, 3, {push!r}
*NODE PRINT, NSET=soft_stiff
U
*NODE PRINT, NSET=border_z_max, TOTALS=ONLY
RF
*EL PRINT, ELSET=soft, TOTALS=ONLY
EVOL
*EL PRINT, ELSET=stiff, TOTALS=ONLY
EVOL
*END STEP
"""


def read_mesh(path):
    """The coordinates of the nodes by number, and the nodes' numbers by set."""
    nodes, sets, keyword, name = {}, {}, "", ""
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            keyword, *options = (word.strip() for word in line.split(","))
            name = next((option.split("=")[1] for option in options if "=" in option), "")
        elif keyword == "*NODE":
            number, *position = line.split(",")
            nodes[int(number)] = tuple(map(float, position))
        elif keyword == "*NSET":
            sets.setdefault(name, []).extend(map(int, line.split(",")))
    return nodes, sets


def solve(model, name):
    Path(f"{name}.inp").write_text(model, encoding="ascii")
    result = subprocess.run(["ccx", "-i", name], capture_output=True, text=True)
    output = result.stdout + result.stderr
    if result.returncode != 0 or "*ERROR" in output:
        sys.exit(f"ccx could not solve {name}.inp:\n{output}")
    return Path(f"{name}.dat").read_text()


def table(dat, title):
    """The rows of numbers below a title of CalculiX's output."""
    rows = re.search(rf"{title}.*\n\n((?: +\S.*\n)+)", dat, re.I).group(1)
    return [list(map(float, row.split())) for row in rows.strip().splitlines()]


def side_held_modulus(young, poisson):
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def main(path):
    nodes, sets = read_mesh(Path(path))
    extent = [max(position[axis] for position in nodes.values()) - min(position[axis] for position in nodes.values())
              for axis in range(3)]
    bottom = min(position[2] for position in nodes.values())
    heights = [nodes[node][2] - bottom for node in sets["soft_stiff"]]
    push = extent[2] / 100
    dat = solve(MODEL.format(mesh=path, push=-push, **MODULI), "two_layers_model")

    area = extent[0] * extent[1]
    volume = table(dat, "total volume.*for set SOFT")[0][0]
    height = volume / area
    m_soft, m_stiff = (side_held_modulus(*moduli) for moduli in MODULI.values())
    stress = push / (height / m_soft + (extent[2] - height) / m_stiff)
    moved = [-row[3] for row in table(dat, "displacements.*for set SOFT_STIFF")]
    # Where the interface is not flat, a node is to go down as its own layer does at its height.
    expected = [stress * h / m_soft if h < height else push - stress * (extent[2] - h) / m_stiff for h in heights]
    force = -table(dat, "total force.*for set BORDER_Z_MAX")[0][2]

    rough = max(abs(h - height) for h in heights) / extent[2]
    wrong = max(abs(m - e) for m, e in zip(moved, expected)) / push
    off = abs(force / (stress * area) - 1)
    print(f"{len(nodes)} nodes, {len(heights)} on the interface, which is flat to {rough:.1e} of the height")
    print(f"interface goes down by {sum(moved) / len(moved):.6f}, exactly {stress * height / m_soft:.6f}; "
          f"largest error {wrong:.1e} of the push")
    print(f"force on the top       {force:.3f}, exactly {stress * area:.3f}; error {off:.1e}")
    # CalculiX prints seven digits.
    return 0 if wrong < 1e-5 + rough and off < 1e-5 + rough else 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    sys.exit(main(sys.argv[1]))
