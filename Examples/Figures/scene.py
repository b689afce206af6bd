# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes, rendered off screen as arrays, and their arrangement in a figure.

Lengths on paper are in inches; only the resolution (dots per inch) differs between print and tests.
"""
from dataclasses import dataclass

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401  the factories
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from matplotlib.colors import to_rgb
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)

from pictures import FRAME_COLOUR

COLUMN, PAGE = 3.4, 7.0  # inches: one column of a journal, and both
PRINT, SMALL = 300, 60   # dots per inch
SUPERSAMPLING = 2
EDGE_COLOUR = (0.13, 0.13, 0.15)
plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 7, "axes.linewidth": 0.5, "lines.linewidth": 0.8,
                     "axes.spines.top": False, "axes.spines.right": False, "xtick.major.width": 0.5,
                     "ytick.major.width": 0.5, "legend.frameon": False})


@dataclass
class Camera:
    """Parallel projection; `height` is what the picture shows from bottom to top, in world units."""
    centre: np.ndarray
    view: tuple
    up: tuple
    height: float

    def axes(self):
        """Unit vectors to the right, up, and to the camera."""
        towards = np.asarray(self.view, float) / np.linalg.norm(self.view)
        right = np.cross(self.up, towards)
        right /= np.linalg.norm(right)
        return right, np.cross(towards, right), towards

    def zoomed(self, place, width):
        """A close-up: its centre to the right and up, and its width, as parts of this picture's height."""
        right, upward, _ = self.axes()
        return Camera(self.centre + self.height * (place[0] * right + place[1] * upward), self.view, self.up,
                      width * self.height)


def camera_for(points, view, up, aspect=1.0, margin=1.04):
    """Shows all points; `aspect` is the picture's width over its height."""
    camera = Camera(np.zeros(3), view, up, 1.0)
    frame = np.stack(camera.axes())
    placed = points @ frame.T
    low, high = placed.min(axis=0), placed.max(axis=0)
    width, height, _ = high - low
    camera.centre = (low + high) / 2 @ frame
    camera.height = margin * max(height, width / aspect)
    return camera


def smooth(data, feature_angle=40):
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetFeatureAngle(feature_angle)
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def mapped(data, colours):
    """`data` with a colour (n x 3, 0 to 1) for every cell or every point."""
    values = numpy_to_vtk(np.ascontiguousarray(np.clip(colours, 0, 1) * 255 + 0.5, np.uint8), deep=True)
    values.SetName("Colours")
    cells = len(colours) == data.GetNumberOfCells()
    (data.GetCellData() if cells else data.GetPointData()).SetScalars(values)
    return data


def actor(data, colour=None, edges=False, dpi=PRINT, edge_points=0.35, ambient=0.3):
    """`edge_points`: width of the edges in points of the printed figure."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(colour is None)
    result = vtkActor()
    result.SetMapper(mapper)
    style = result.GetProperty()
    if colour is not None:
        style.SetColor(to_rgb(colour))
    style.SetAmbient(ambient)
    style.SetDiffuse(1 - 0.8 * ambient)
    if edges:
        style.SetInterpolationToFlat()
        style.EdgeVisibilityOn()
        style.SetEdgeColor(EDGE_COLOUR)
        style.SetLineWidth(max(0.6, edge_points / 72 * dpi * SUPERSAMPLING))
    return result


def render(actors, camera, size, dpi):
    """An array of colours [row, column, 3] of width x height inches on white."""
    pixels = [int(round(length * dpi)) for length in size]
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for each in actors:
        renderer.AddActor(each)
    vtkLightKit().AddLightsToRenderer(renderer)
    eye = renderer.GetActiveCamera()
    eye.ParallelProjectionOn()
    eye.SetParallelScale(camera.height / 2)
    eye.SetFocalPoint(camera.centre)
    eye.SetPosition(camera.centre + 10 * camera.height * camera.axes()[2])
    eye.SetViewUp(camera.up)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(SUPERSAMPLING * number for number in pixels))
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    picture = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3]
    window.Finalize()
    blocks = picture.reshape(height // SUPERSAMPLING, SUPERSAMPLING, width // SUPERSAMPLING, SUPERSAMPLING, 3)
    return (blocks.mean(axis=(1, 3)) + 0.5).astype(np.uint8)


def veiled(picture, veil, share):
    """A picture behind a veil: both have the same camera. Cheaper than transparent surfaces, and without their inside."""
    return (picture * (1 - share) + veil * share + 0.5).astype(np.uint8)


def framed(picture, camera, closeup, dpi, aspect=1.0, points=1.0, colour=FRAME_COLOUR):
    """Draws the border of a close-up's part into a picture, in place, and returns it."""
    high, wide = picture.shape[:2]
    right, upward, _ = camera.axes()
    offset = closeup.centre - camera.centre
    middle = np.array([wide / 2 + offset @ right * high / camera.height, high / 2 - offset @ upward * high / camera.height])
    half = closeup.height * high / camera.height / 2 * np.array([aspect, 1.0])
    thick = max(1, round(points / 72 * dpi))
    left, top = np.round(middle - half).astype(int)
    end_x, end_y = np.round(middle + half).astype(int)
    ink = (np.array(to_rgb(colour)) * 255).astype(np.uint8)
    for rows, columns in (((top, top + thick), (left, end_x)), ((end_y - thick, end_y), (left, end_x)),
                          ((top, end_y), (left, left + thick)), ((top, end_y), (end_x - thick, end_x))):
        picture[max(rows[0], 0):max(rows[1], 0), max(columns[0], 0):max(columns[1], 0)] = ink
    return picture


class Sheet:
    """A figure of panels in rows; under each panel its caption."""

    def __init__(self, rows, caption_height=0.17, gap=0.06):
        """rows: lists of (picture, caption); pictures of a row are equally high."""
        self.rows, self.caption_height, self.gap = rows, caption_height, gap

    def save(self, path, dpi):
        width = max(sum(picture.shape[1] for picture, _ in row) / dpi + self.gap * (len(row) - 1) for row in self.rows)
        heights = [row[0][0].shape[0] / dpi + self.caption_height * (1 + max(text.count("\n") for _, text in row))
                   for row in self.rows]
        pixels = np.ceil(np.array([width, sum(heights)]) * dpi)
        sheet = plt.figure(figsize=pixels / dpi, dpi=dpi, facecolor="white")
        top = 0.0
        for row, height in zip(self.rows, heights):
            left = (width - sum(picture.shape[1] for picture, _ in row) / dpi - self.gap * (len(row) - 1)) / 2
            for picture, text in row:
                high, wide = picture.shape[:2]
                # Whole dots, so that no picture is sampled anew.
                sheet.figimage(picture, round(left * dpi), int(pixels[1]) - round(top * dpi) - high, origin="upper")
                sheet.text((left + wide / dpi / 2) / (pixels[0] / dpi), 1 - (top + high / dpi + 0.03) / (pixels[1] / dpi),
                           text, ha="center", va="top")
                left += wide / dpi + self.gap
            top += height
        save(sheet, path, dpi)


def save(figure, path, dpi):
    figure.savefig(path, dpi=dpi, facecolor="white", metadata={"Software": None})
    plt.close(figure)


def colour_bar(name, limit, width, dpi, above):
    """A horizontal colour bar from 0 to a limit, as a picture; what is above has the last colour."""
    figure = plt.figure(figsize=(width, 0.3), dpi=dpi, facecolor="white")
    axes = figure.add_axes([0.2, 0.6, 0.6, 0.35])
    axes.imshow(np.linspace(0, 1, 256)[None, :], cmap=name, aspect="auto", extent=(0, limit, 0, 1))
    axes.set_yticks([])
    axes.set_xticks(np.linspace(0, limit, 5))
    axes.set_xticklabels([f"{tick:g}" for tick in np.linspace(0, limit, 5)[:-1]] + [f"{limit:g} or {above}"])
    figure.canvas.draw()
    picture = np.asarray(figure.canvas.buffer_rgba())[:, :, :3].copy()
    plt.close(figure)
    return picture
