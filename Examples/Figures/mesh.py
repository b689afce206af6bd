# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and label volumes as numpy arrays, and what is counted on them."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

IMAGE_READERS = {".mha": vtkMetaImageReader, ".mhd": vtkMetaImageReader, ".vti": vtkXMLImageDataReader}


@dataclass
class Mesh:
    """Triangles with the labels of their two sides; the normal points from the first to the second."""
    points: np.ndarray     # n x 3
    triangles: np.ndarray  # m x 3
    sides: np.ndarray      # m x 2

    def only(self, chosen):
        """The triangles of a mask."""
        return Mesh(self.points, self.triangles[chosen], self.sides[chosen])

    def surface(self, label):
        """All triangles around a material, their normals outward."""
        first, second = self.sides[:, 0] == label, self.sides[:, 1] == label
        triangles = np.concatenate([self.triangles[first], self.triangles[second][:, ::-1]])
        return Mesh(self.points, triangles, np.concatenate([self.sides[first], self.sides[second][:, ::-1]]))

    def centres(self):
        return self.points[self.triangles].mean(axis=1)

    def used(self):
        """The points that have a triangle."""
        return self.points[np.unique(self.triangles)]

    def bounds(self):
        used = self.used()
        return used.min(axis=0), used.max(axis=0)

    def polydata(self):
        """With the cell array BoundaryLabels, as labelmesh writes it."""
        data = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(self.points, np.float32), deep=True))
        data.SetPoints(points)
        cells = vtkCellArray()
        offsets = np.arange(0, 3 * len(self.triangles) + 1, 3, dtype=np.int64)
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(np.ascontiguousarray(self.triangles, np.int64).ravel(), deep=True))
        data.SetPolys(cells)
        sides = numpy_to_vtk(np.ascontiguousarray(self.sides, np.int64), deep=True)
        sides.SetName("BoundaryLabels")
        data.GetCellData().AddArray(sides)
        return data


@dataclass
class Volume:
    """Labels [z, y, x] of a volume whose axes are the world's."""
    image: object  # vtkImageData
    labels: np.ndarray
    spacing: np.ndarray
    origin: np.ndarray

    def voxel(self):
        """Voxels as a unit of length: the geometric mean of the spacings."""
        return float(np.prod(self.spacing) ** (1 / 3))


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def is_turned(path):
    """Whether a MetaImage has other axes than the world's, which VTK's reader does not say."""
    header = Path(path).read_bytes()[:4096].split(b"ElementDataFile")[0].decode("latin-1")
    for line in header.splitlines():
        key, _, value = line.partition("=")
        if key.strip() in ("TransformMatrix", "Rotation", "Orientation"):
            return not np.array_equal(np.array(value.split(), float), np.eye(3).ravel())
    return False


def read_volume(path):
    """ValueError says why a volume cannot be compared."""
    path = Path(path)
    if path.suffix not in IMAGE_READERS:
        raise ValueError(f"its name has none of the endings {', '.join(IMAGE_READERS)}")
    image = read(IMAGE_READERS[path.suffix](), path)
    if image.GetPointData().GetScalars() is None:
        raise ValueError("it holds no labels at its points that can be read")
    if not image.GetDirectionMatrix().IsIdentity() or (path.suffix != ".vti" and is_turned(path)):
        raise ValueError("its axes are not the world's, which the counts of overlaps and gaps take for granted")
    return volume_of(image)


def volume_of(image):
    labels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
    return Volume(image, labels, np.array(image.GetSpacing()), np.array(image.GetOrigin()))


def mesh_of(polydata):
    count = polydata.GetNumberOfPolys()
    if count == 0:
        return Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros((0, 2), np.int64))
    return Mesh(vtk_to_numpy(polydata.GetPoints().GetData()).astype(float),
                vtk_to_numpy(polydata.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64),
                vtk_to_numpy(polydata.GetCellData().GetArray("BoundaryLabels")).astype(np.int64))


def read_mesh(path):
    return mesh_of(read(vtkXMLPolyDataReader(), path))


def read_point_array(path, name):
    return vtk_to_numpy(read(vtkXMLPolyDataReader(), path).GetPointData().GetArray(name))


def read_tetrahedra(path):
    """Points, corners (n x 4) and labels."""
    grid = read(vtkXMLUnstructuredGridReader(), path)
    return (vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
            vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).astype(np.int64),
            vtk_to_numpy(grid.GetCellData().GetArray("Label")).astype(np.int64))


def edge_lengths(mesh):
    """m x 3: of the edges opposite to each corner."""
    corners = mesh.points[mesh.triangles]
    return np.linalg.norm(np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1), axis=2)


def radius_ratios(mesh):
    """2 r_in / r_circ of every triangle; 0 for one without area."""
    a, b, c = edge_lengths(mesh).T
    product = a * b * c
    ratio = (b + c - a) * (c + a - b) * (a + b - c)
    return np.clip(np.divide(ratio, product, out=np.zeros_like(ratio), where=product > 0), 0, 1)


def minimum_angles(mesh):
    """Degrees, of every triangle."""
    lengths = np.sort(edge_lengths(mesh), axis=1)
    short, middle, long = lengths.T
    scale = 2 * middle * long
    cosine = np.divide(middle ** 2 + long ** 2 - short ** 2, scale, out=np.ones_like(scale), where=scale > 0)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def bends(mesh):
    """Per triangle: the largest angle in degrees between its normal and those across its edges of the same interface."""
    corners = mesh.points[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    ends = np.concatenate([mesh.triangles[:, [1, 2]], mesh.triangles[:, [2, 0]], mesh.triangles[:, [0, 1]]])
    owner = np.tile(np.arange(len(mesh.triangles)), 3)
    pair = mesh.sides[owner]
    # Edges of one interface: neighbours in an order by ends and labels.
    order = np.lexsort((pair[:, 1], pair[:, 0], ends.max(axis=1), ends.min(axis=1)))
    key = np.column_stack([ends.min(axis=1), ends.max(axis=1), pair])[order]
    same = (key[1:] == key[:-1]).all(axis=1)
    left, right = owner[order[:-1][same]], owner[order[1:][same]]
    angle = np.degrees(np.arccos(np.clip((normals[left] * normals[right]).sum(axis=1), -1, 1)))
    result = np.zeros(len(mesh.triangles))
    np.maximum.at(result, left, angle)
    np.maximum.at(result, right, angle)
    return result


def dihedral_angles(points, tetrahedra):
    """Degrees, six of every tetrahedron."""
    corners = points[tetrahedra]
    faces = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]
    normals = [np.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]) for a, b, c in faces]
    normals = [n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300) for n in normals]
    angles = [180 - np.degrees(np.arccos(np.clip((normals[i] * normals[j]).sum(axis=1), -1, 1)))
              for i in range(4) for j in range(i)]
    return np.concatenate(angles)


def inside(surface, volume):
    """Which voxel centres lie in a closed surface, by parity along z, as labels[z, y, x] are.

    The centres are moved by a ten-thousandth of a voxel, so that their rays meet no vertex of a mesh on the grid.
    """
    nz, ny, nx = volume.labels.shape
    crossings = np.zeros((nz + 1, ny, nx), np.uint8)
    corners = (surface.points[surface.triangles] - volume.origin) / volume.spacing - (1.3e-4, 0.7e-4, 0)
    low = np.maximum(np.ceil(corners[:, :, :2].min(axis=1)), 0).astype(int)
    high = np.minimum(np.floor(corners[:, :, :2].max(axis=1)), (nx - 1, ny - 1)).astype(int)
    width = np.maximum(high - low + 1, 0)
    count = width[:, 0] * width[:, 1]
    owner = np.repeat(np.arange(len(corners)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    x = low[owner, 0] + number % np.maximum(width[owner, 0], 1)
    y = low[owner, 1] + number // np.maximum(width[owner, 0], 1)
    a, b, c = corners[owner].transpose(1, 0, 2)

    def cross(p, q):
        return (p[:, 0] - x) * (q[:, 1] - y) - (p[:, 1] - y) * (q[:, 0] - x)

    weights = np.column_stack([cross(b, c), cross(c, a), cross(a, b)])
    hit = (weights > 0).all(axis=1) | (weights < 0).all(axis=1)
    weights = weights[hit] / weights[hit].sum(axis=1, keepdims=True)
    z = (weights * np.column_stack([a[hit, 2], b[hit, 2], c[hit, 2]])).sum(axis=1)
    below = np.clip(np.ceil(z), 0, nz).astype(int)  # the ray is inside from this sample on
    np.add.at(crossings, (below, y[hit], x[hit]), 1)
    return (np.cumsum(crossings[:-1], axis=0, dtype=np.uint8) & 1).astype(bool)


def overlaps_and_gaps(surfaces, volume, background=0):
    """Voxel centres in two materials or more; and in none though all voxels around are of materials."""
    claims = np.zeros(volume.labels.shape, np.uint8)
    for surface in surfaces:
        claims += inside(surface, volume)
    inner = volume.labels != background
    for axis in range(3):  # eroded by one voxel along every axis: the 26 around
        inner = inner & np.roll(inner, 1, axis) & np.roll(inner, -1, axis)
    return int((claims > 1).sum()), int(((claims == 0) & inner).sum())
