# SPDX-License-Identifier: BSD-3-Clause
"""Figure 4: what tightening does to a thin wall.

The wall is found, not chosen: in the box of a given size in which tightening with r = 1 takes the most voxels away.
"""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkPolyDataNormals

from fields import block, image_of, samples, split, tighten
from mesh import Mesh
from scene import PAGE, Camera, Sheet, actor, render

BOX = 28     # voxels along each side of what is shown
MARGIN = 10  # voxels around it that are tightened too, so that the cut does not count


def box_sums(field, size):
    """Sums over all boxes of size^3 that lie inside, by their first corner."""
    table = np.pad(field.astype(np.int64), ((1, 0),) * 3).cumsum(0).cumsum(1).cumsum(2)
    for axis in range(3):
        count = table.shape[axis]
        table = np.take(table, range(size, count), axis) - np.take(table, range(count - size), axis)
    return table


def find_wall(volume):
    """(label, first corner [x, y, z] as index, size) of the box with the largest loss."""
    best = (-1, None, None)
    size = min(BOX, *volume.labels.shape)
    for label in np.unique(volume.labels):
        if label == 0:
            continue
        mask = volume.labels == label
        distances = tighten(split(image_of(mask.astype(np.uint8), volume.spacing, volume.origin)), radius=1.0)
        kept = kept_samples(block(distances, 1), volume)
        losses = box_sums(mask & ~kept, size)
        loss = losses.max()
        if loss > best[0]:
            corner = np.unravel_index(losses.argmax(), losses.shape)[::-1]
            best = (loss, int(label), np.array(corner))
    return best[1], best[2], size


def kept_samples(image, volume):
    """Which samples of the volume are inside the tightened surface."""
    distance, first = samples(image, "TightDistance")
    result = np.zeros(volume.labels.shape, bool)
    offset = np.round((first - volume.origin) / volume.spacing).astype(int)
    low = np.maximum(offset, 0)
    high = np.minimum(offset + distance.shape[::-1], volume.labels.shape[::-1])
    inner = tuple(slice(a, b) for a, b in zip(low[::-1], high[::-1]))
    own = tuple(slice(a, b) for a, b in zip((low - offset)[::-1], (high - offset)[::-1]))
    result[inner] = distance[own] > 0
    return result


def isosurface(image, name, value):
    image.GetPointData().SetActiveScalars(name)
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, value)
    contour.ComputeNormalsOff()
    contour.Update()
    data = contour.GetOutput()
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return Mesh(vtk_to_numpy(data.GetPoints().GetData()).astype(float), triangles, np.ones((len(triangles), 2), int))


def inner_part(surface, low, high):
    """The triangles in a box."""
    centres = surface.centres()
    return surface.only(((centres >= low) & (centres <= high)).all(axis=1))


def enclosed(distance_image, name, level, low, high):
    """The volume inside, in the box: samples times their size."""
    values, first = samples(distance_image, name)
    spacing = np.array(distance_image.GetSpacing())
    inside = values > level
    for axis in range(3):
        place = first[axis] + spacing[axis] * np.arange(values.shape[2 - axis])
        shape = [1, 1, 1]
        shape[2 - axis] = -1
        inside = inside & ((place >= low[axis]) & (place <= high[axis])).reshape(shape)
    return inside.sum() * spacing.prod()


def figure(subject, runs, dpi):
    volume = runs.volume
    label, corner, size = find_wall(volume)
    low = volume.origin + (corner - 0.5) * volume.spacing
    high = low + size * volume.spacing
    start = np.maximum(corner - MARGIN, 0)
    end = np.minimum(corner + size + MARGIN, volume.labels.shape[::-1])
    part = volume.labels[tuple(slice(a, b) for a, b in zip(start[::-1], end[::-1]))]
    image = image_of((part == label).astype(np.uint8), volume.spacing, volume.origin + start * volume.spacing)
    fine = split(image, resampling=2.0)
    masks = split(image)
    masks.Update()
    cases = [("(a) the voxels", block(masks, 1), "Mask", 0.5),
             ("(b) r = 1", block(tighten(split(image), 1.0), 1), "TightDistance", 0.0),
             ("(c) r = 0.6, finer grid", block(tighten(fine, 0.6), 1), "TightDistance", 0.0),
             ("(d) our default", block(tighten(split(image)), 1), "TightDistance", 0.0)]
    width = (PAGE - 3 * 0.06) / 4
    camera = Camera((low + high) / 2, subject.wall_view, subject.up, 1.35 * float((high - low).max()))
    full = enclosed(cases[0][1], "Mask", 0.5, low, high)
    row, shares = [], []
    for title, field, name, level in cases:
        surface = inner_part(isosurface(field, name, level), low, high)
        normals = vtkPolyDataNormals()
        normals.SetInputData(surface.polydata())
        normals.SplittingOff()
        normals.Update()
        shares.append(enclosed(field, name, level, low, high) / full)
        row.append((render([actor(surface.polydata() if name == "Mask" else normals.GetOutput(), subject.colour(label), dpi=dpi)],
                           camera, (width, width), dpi), f"{title}: {100 * shares[-1]:.0f} % kept"))
    caption = (f"A thin wall of the {subject.title} ({subject.name(label)}), where tightening takes the most away: the volume that "
               f"stays in the box is {100 * shares[1]:.0f} % with r = 1, {100 * shares[2]:.0f} % with r = 0.6 on a grid of twice "
               f"the resolution, and {100 * shares[3]:.0f} % with our default, which keeps volumes and thin parts.")
    return Sheet([row]), caption
