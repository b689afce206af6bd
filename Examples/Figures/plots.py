# SPDX-License-Identifier: BSD-3-Clause
"""Histograms of the shape of triangles and tetrahedra."""
import matplotlib.pyplot as plt
import numpy as np

from mesh import minimum_angles, radius_ratios
from runs import TITLES
from scene import PAGE

COLOURS = {"particle": "#1f6fb4", "grid": "#c03028", "labels": "#e0a94a", "nets": "#7a5aa8", "cgal": "#3a8f4a"}
METHOD_COLOURS = {"SP": "#1f6fb4", "SP-1R": "#3a8f4a", "SP-2R": "#e0a94a", "TG": "#c03028"}


def share(axes, values, edges, kind):
    counts = np.histogram(values, bins=edges)[0]
    axes.stairs(100 * counts / max(len(values), 1), edges, color=COLOURS[kind], label=TITLES[kind], linewidth=1.1,
                fill=kind == "particle", alpha=0.85 if kind == "particle" else 1.0)


def histograms(subject, runs, dpi, methods=()):
    """Radius ratio and least angle of triangles; dihedral angles of the tetrahedra, of their reports."""
    figure, panels = plt.subplots(1, 3 if methods else 2, figsize=(PAGE, 2.1), dpi=dpi)
    for kind in COLOURS:
        run = runs.get(kind)
        if run is not None:
            share(panels[0], radius_ratios(run.mesh), np.linspace(0, 1, 41), kind)
            share(panels[1], minimum_angles(run.mesh), np.linspace(0, 60, 41), kind)
    edges = np.linspace(0, 180, 19)
    for method in methods:
        counts = np.array(runs.tetrahedra(method)["tetrahedra"]["histogram"])
        panels[2].stairs(100 * counts / counts.sum(), edges, color=METHOD_COLOURS[method], label=method, linewidth=1.1)
    for axes, title in zip(panels, ("radius ratio 2 r_in / r_circ", "least angle of a triangle, degrees",
                                    "dihedral angles of tetrahedra, degrees")):
        axes.set_xlabel(title)
        axes.set_ylim(bottom=0)
    panels[0].set_xlim(0, 1)
    panels[1].set_xlim(0, 60)
    panels[0].set_ylabel("share, %")
    panels[0].legend(loc="upper left")
    if methods:
        panels[2].legend(loc="upper right")
        panels[2].set_xlim(0, 180)
        panels[2].set_xticks(range(0, 181, 30))
    figure.subplots_adjust(left=0.06, right=0.98, top=0.97, bottom=0.19, wspace=0.16)
    inside = f", and dihedral angles of its tetrahedra ({', '.join(methods)})" if methods else ""
    caption = f"Shape of the triangles of the {subject.title} by tool, at about as many triangles{inside}."
    return figure, caption
