# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of tables 1 to 3 of Meyer, Whitaker, Kirby, Ledergerber and Pfister (2008), as printed there.

Its volumes are not published. The spheres are remade from its description; a frog, a brain and a torso stand for its
own, so their numbers are neighbours, not the same measurement.
"""

# dataset: materials, dimensions, particles, how long sampling took
TABLE_1 = {
    "torso": (5, "260 x 121 x 169", 394_000, "12 hours"),
    "frog": (5, "260 x 245 x 150", 186_000, "5 hours"),
    "brain": (3, "149 x 188 x 148", 161_000, "3 hours"),
    "two spheres": (3, "128 x 128 x 128", 1_214, "4 minutes"),
}

# dataset: material: triangles, least and mean radius ratio
TABLE_2 = {
    "torso": {"tissue": (673_000, 0.39, 0.94), "bone": (460_000, 0.31, 0.94), "lung": (215_000, 0.32, 0.93),
              "heart": (140_000, 0.38, 0.93)},
    "frog": {"tissue": (367_000, 0.30, 0.94), "bone": (197_000, 0.37, 0.94), "guts": (46_000, 0.30, 0.94),
             "brain": (8_000, 0.52, 0.94)},
    "brain": {"white matter": (255_000, 0.39, 0.94), "CSF": (92_000, 0.42, 0.94)},
    "two spheres": {"top": (1544, 0.51, 0.92), "bottom": (1506, 0.52, 0.92)},
}

# dataset: least and mean radius ratio of the grid method with as many triangles (section 6)
GRID = {"two spheres": (0.014, 0.79), "frog": (0.0, 0.79)}

# dataset: method: tetrahedra, least and mean radius ratio, slivers in percent
TABLE_3 = {
    "two spheres": {"SP": (12_700, 0.02, 0.78, 0.24), "SP-1R": (12_800, 0.05, 0.78, 0.02),
                    "SP-2R": (12_800, 0.10, 0.78, 0.00), "TG": (30_200, 0.06, 0.59, 0.1)},
    "frog": {"SP": (443_000, 0.0001, 0.77, 0.30), "SP-1R": (452_000, 0.0001, 0.77, 0.06),
             "SP-2R": (453_000, 0.0001, 0.77, 0.06), "TG": (1_146_000, 0.0259, 0.60, 0.08)},
}
