# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 and 3, drawn from real indicator functions: junctions in the plane, and the functions along a line."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from vtkmodules.util.numpy_support import vtk_to_numpy

from fields import block, image_of, indicators, samples, split, tighten
from scene import COLUMN, PAGE
from subjects import PALETTE

SIZE = 16        # voxels along x and y
DEPTH = 9        # and along z, of which the middle is shown
RESOLUTION = 6   # samples per voxel of what is shown


def wedges(angles, centre):
    """Labels 1, 2, ... in the sectors between rays at these angles (degrees, ascending) from a point [x, y]."""
    y, x = np.mgrid[:SIZE, :SIZE]
    angle = np.degrees(np.arctan2(y - centre[1], x - centre[0])) % 360
    plane = (np.searchsorted(angles, angle, side="right") - 1) % len(angles) + 1
    return np.repeat(plane[None].astype(np.uint8), DEPTH, axis=0)


def rebuilt(labels, inspected):
    """The last stage, and its labels and inspection fields at RESOLUTION; nothing is added to the indicators."""
    stage = indicators(tighten(split(image_of(labels)), radius=1.0), RESOLUTION, inspected, perturbation=0.0)
    return stage, stage.GetOutputDataObject(1)


def middle(image, name):
    array = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(image.GetDimensions()[::-1])
    return array[array.shape[0] // 2]


def positions(image):
    """Of the samples along x, and along y as well."""
    return image.GetOrigin()[0] + image.GetSpacing()[0] * (image.GetExtent()[0] + np.arange(image.GetDimensions()[0]))


def draw_junction(axes, labels, title):
    present = [int(label) for label in np.unique(labels)]
    _, image = rebuilt(labels, present)
    place = positions(image)
    extent = (place[0] - 0.5 / RESOLUTION, place[-1] + 0.5 / RESOLUTION) * 2
    axes.imshow(middle(image, "Label"), origin="lower", extent=extent, cmap=ListedColormap(PALETTE[:4]), vmin=1, vmax=4,
                interpolation="nearest")
    for label in present:  # the interfaces are the zero sets of the inside/outside functions
        axes.contour(place, place, middle(image, f"InsideOutside_{label}"), levels=[0.0], colors="black", linewidths=0.8)
    centre = SIZE / 2 - 0.5
    axes.set_xlim(centre - 4.5, centre + 4.5)
    axes.set_ylim(centre - 4.5, centre + 4.5)
    axes.set_xticks([])
    axes.set_yticks([])
    for side in axes.spines.values():
        side.set_visible(True)
    axes.set_xlabel(title)


def junctions(dpi):
    """Figure 2."""
    half = SIZE / 2 - 0.5  # between samples: the four quarters are alike
    three, shifted = wedges([30, 150, 270], (half, half)), wedges([38, 156, 266], (half + 0.6, half - 0.4))
    four, moved = wedges([0, 90, 180, 270], (half, half)), wedges([0, 90, 180, 270], (half, half))
    moved[:, :SIZE // 2] = np.roll(moved[:, :SIZE // 2], 2, axis=2)
    moved[:, :SIZE // 2, :2] = 3
    figure, panels = plt.subplots(1, 4, figsize=(PAGE, PAGE / 4 + 0.1), dpi=dpi)
    for axes, labels, title in zip(panels, (three, shifted, four, moved),
                                   ("(a) three materials meet", "(b) moved a little", "(c) four meet", "(d) moved a little")):
        draw_junction(axes, labels, title)
    figure.subplots_adjust(left=0.005, right=0.995, top=0.99, bottom=0.12, wspace=0.04)
    caption = (f"Junctions in the plane, from the labels rebuilt from indicator functions at {RESOLUTION} samples per voxel. Three "
               "materials meet in a point (a), and still do when the labels move a little (b). Four meet in a point only by "
               "symmetry (c): with the lower half two voxels farther they meet in two points, three in each (d).")
    return figure, caption


def catmull_rom(values, per_sample):
    """Between the samples of a line, as the indicators are interpolated."""
    t = np.arange(per_sample) / per_sample
    padded = np.concatenate([[2 * values[0] - values[1]], values, [2 * values[-1] - values[-2]]])
    a, b, c, d = (padded[k:len(values) - 1 + k, None] for k in range(4))
    curve = b + t * ((c - a) / 2 + t * (a - 2.5 * b + 2 * c - d / 2 + t * ((d - a) / 2 + 1.5 * (b - c))))
    return np.append(curve.ravel(), values[-1])


def indicator_functions(dpi):
    """Figure 3."""
    labels = np.full((DEPTH, SIZE, SIZE), 1, np.uint8)
    labels[:, :, 6:] = 2
    labels[:, :, 10:] = 3
    stage, image = rebuilt(labels, inspected=(1, 2))
    row = middle(image, "Label").shape[0] // 2
    x = positions(image)
    colours = PALETTE[:3]
    figure, (top, centre, bottom) = plt.subplots(3, 1, figsize=(COLUMN, 3.3), dpi=dpi, sharex=True)
    for label in (1, 2, 3):
        field, first = samples(block(stage, label), "Indicator")
        along = field[field.shape[0] // 2, field.shape[1] // 2]
        curve = catmull_rom(along, RESOLUTION)
        top.plot(first[0] + np.arange(len(curve)) / RESOLUTION, curve, color=colours[label - 1], label=f"$f_{label}$", linewidth=1.2)
    for label in (1, 2):
        centre.plot(x, middle(image, f"InsideOutside_{label}")[row], color=colours[label - 1], label=rf"$\tilde f_{label}$", linewidth=1.2)
    bottom.plot(x, middle(image, "CellIndicator")[row], color="#444444", label="$J_{12}$", linewidth=1.2)
    plane = middle(image, "Label")[row]
    changes = x[1:][plane[1:] != plane[:-1]] - 0.5 / RESOLUTION
    for axes in (top, centre, bottom):
        axes.axhline(0, color="#999999", linewidth=0.5)
        for place in changes:
            axes.axvline(place, color="#c03028", linestyle="--", linewidth=0.7)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.2)
        axes.set_xlim(3, 12)
    top.set_ylim(-4.5, 4.5)
    centre.set_ylim(-7, 7)
    bottom.set_ylim(-2, 40)
    top.set_ylabel("indicator")
    centre.set_ylabel("inside/outside")
    bottom.set_ylabel("cell indicator")
    bottom.set_xlabel("along a line through three materials, voxels")
    figure.align_ylabels()
    figure.subplots_adjust(left=0.15, right=0.84, top=0.99, bottom=0.12, hspace=0.12)
    caption = ("Indicator functions f of three materials along a line; inside/outside functions of the first two (equation 1); "
               "the cell indicator of their interface (equation 2), which is zero there alone. Dashed: where the label changes.")
    return figure, caption
