# SPDX-License-Identifier: BSD-3-Clause
"""Counterparts of the paper's figures 1 and 4 to 9, and colour maps of the mesh.

Each function takes (subject, runs, dpi) and returns a Sheet and its caption; the numbers in captions come from reports.
"""
import numpy as np
from matplotlib.colors import to_rgb

import thin_wall
from mesh import bends, read_point_array
from scene import PAGE, Sheet, actor, camera_for, colour_bar, framed, mapped, render, smooth, veiled

GAP = 0.06   # between panels, inches
VEIL = 0.25  # how much of a veil is seen


def panel(columns, aspect=1.0):
    """Width and height of one of so many panels that fill the page."""
    width = (PAGE - GAP * (columns - 1)) / columns
    return width, width / aspect


def shown_labels(subject, mesh):
    labels = [int(label) for label in np.unique(mesh.sides) if label != 0]
    return [label for label in labels if label in subject.shown] if subject.shown else labels


def material_actors(subject, mesh, labels, dpi, edges=False):
    """Opaque surfaces, each in its colour. Where materials meet the one that comes first is drawn."""
    result, drawn = [], np.zeros(len(mesh.triangles), bool)
    for label in labels:
        mine = (mesh.sides == label).any(axis=1) & ~drawn
        drawn |= mine
        data = mesh.only(mine).surface(label).polydata()
        result.append(actor(data if edges else smooth(data), subject.colour(label), edges=edges, dpi=dpi))
    return result


def veils(subject, mesh, dpi):
    return [actor(smooth(mesh.surface(label).polydata()), subject.colour(label), dpi=dpi)
            for label in subject.veiled if (mesh.sides == label).any()]


def counts(report):
    return (f"{report['triangles']:,} triangles; radius ratio 2r/R at least {report['min_radius_ratio']:.2f}, "
            f"{report['mean_radius_ratio']:.2f} on average")


def letter(number):
    return f"({'abcdefghijkl'[number]})"


def surfaces(subject, runs, dpi):
    """Figures 1 and 6: everything inside a veil, and close-ups with edges."""
    run = runs.get("particle")
    mesh, labels = run.mesh, shown_labels(subject, run.mesh)
    aspect = subject.aspect
    camera = camera_for(mesh.used(), subject.view, subject.up, aspect)
    closeups = [camera.zoomed(*closeup) for closeup in subject.closeups]
    height = (PAGE - GAP) / (aspect + 1 / len(closeups))
    size = (height * aspect, height)
    picture = render(material_actors(subject, mesh, labels, dpi), camera, size, dpi)
    if subject.veiled:
        picture = veiled(picture, render(veils(subject, mesh, dpi), camera, size, dpi), VEIL)
    for closeup in closeups:
        framed(picture, camera, closeup, dpi)
    small = (height - GAP * (len(closeups) - 1)) / len(closeups)
    parts = [render(material_actors(subject, mesh, labels, dpi, edges=True), closeup, (small, small), dpi)
             for closeup in closeups]
    stack = np.full((picture.shape[0], parts[0].shape[1], 3), 255, np.uint8)
    for number, part in enumerate(parts):  # the first at the top, the last at the bottom
        top = round(number * (len(stack) - len(part)) / max(len(parts) - 1, 1))
        stack[top:top + len(part)] = part
    names = ", ".join(subject.name(label) for label in labels)
    veil = " behind the " + ", ".join(subject.name(label) for label in subject.veiled) if subject.veiled else ""
    caption = (f"Surfaces of the {subject.title}: {names}{veil}; close-ups of the framed parts with their edges. "
               f"{counts(run.report)}.")
    return Sheet([[(picture, ""), (stack, "")]], caption_height=0.0), caption


def materials_apart(subject, runs, dpi):
    """Figure 5: two materials, each by itself, with a close-up of each."""
    run = runs.get("particle")
    labels = list(subject.apart) or shown_labels(subject, run.mesh)[:2]
    top, bottom, parts = [], [], []
    for number, label in enumerate(labels):
        mesh = run.mesh.surface(label)
        camera = camera_for(mesh.used(), subject.view, subject.up, 1.25)
        closeup = camera.zoomed(*subject.closeups[0])
        size = panel(len(labels), 1.25)
        picture = render([actor(smooth(mesh.polydata()), subject.colour(label), dpi=dpi)], camera, size, dpi)
        material = next(m for m in run.report["materials"] if m["label"] == label)
        closeup_size = (size[0], size[0] / 1.8)
        top.append((framed(picture, camera, closeup, dpi, aspect=1.8),
                    f"{letter(number)} {subject.name(label)}: {material['triangles']:,} triangles"))
        parts.append(f"{subject.name(label)} {counts(material)}")
        bottom.append((render([actor(mesh.polydata(), subject.colour(label), edges=True, dpi=dpi)], closeup, closeup_size,
                              dpi), ""))
    caption = f"Two materials of the {subject.title}: {'; '.join(parts)}. Below, the framed parts with their edges."
    return Sheet([top, bottom], caption_height=0.19), caption


def shared_boundary(subject, runs, dpi):
    """Figure 7: two materials drawn apart; the boundary that they share has the same triangles on both."""
    run = runs.get("particle")
    labels = shown_labels(subject, run.mesh)[:2]
    view, up = (1.0, -0.25, 0.12), (0, 0, 1)
    together = material_actors(subject, run.mesh, labels, dpi, edges=True)
    size = panel(3, 0.72)
    whole = camera_for(run.mesh.used(), view, up, 0.72)
    pictures = [(render(together, whole, size, dpi), "(a) both")]
    shared = (run.mesh.sides == labels[0]).any(axis=1) & (run.mesh.sides == labels[1]).any(axis=1)
    colour = "#c9463d"
    for number, label in enumerate(labels):
        own = (run.mesh.sides == label).any(axis=1)
        centre = np.mean(run.mesh.only(shared).bounds(), axis=0)
        outwards = centre - np.mean(run.mesh.only(own).bounds(), axis=0)
        tilted = np.array(view) + 1.1 * outwards / np.linalg.norm(outwards)  # from where the boundary is seen
        actors = [actor(run.mesh.only(own & ~shared).surface(label).polydata(), subject.colour(label), edges=True, dpi=dpi),
                  actor(run.mesh.only(shared).surface(label).polydata(), colour, edges=True, dpi=dpi)]
        camera = camera_for(run.mesh.only(own).used(), tilted, up, 0.72)
        camera.height = whole.height
        pictures.append((render(actors, camera, size, dpi), f"{letter(number + 1)} {subject.name(label)} alone"))
    caption = (f"The {subject.title}, together and one by one, at the same scale. The {int(shared.sum()):,} triangles of their "
               f"common boundary (red) are the same in both surfaces. {counts(run.report)}.")
    return Sheet([pictures]), caption


def cut_open(mesh, subject):
    """Without the quarter nearest to the camera; triangles stay whole."""
    low, high = mesh.bounds()
    centre, middle = (low + high) / 2, mesh.centres()
    axes = np.argsort(-np.abs(subject.view))[:2]
    away = np.ones(len(middle), bool)
    for axis in axes:
        away &= (middle[:, axis] - centre[axis]) * np.sign(subject.view[axis]) > 0
    return mesh.only(~away)


def grid_against_particles(subject, runs, dpi):
    """Figure 8: the grid method above, particles below, as many triangles; close-ups with edges."""
    rows = []
    both = [runs.get("grid"), runs.get("particle")]
    aspect = subject.aspect
    camera = camera_for(both[1].mesh.used(), subject.view, subject.up, aspect)
    closeup = camera.zoomed(*subject.closeups[0])
    height = (PAGE - GAP) / (1 + aspect)
    for number, run in enumerate(both):
        mesh = cut_open(run.mesh, subject) if subject.cut else run.mesh
        labels = shown_labels(subject, mesh)
        dense = run.report["triangles"] > 30_000  # then edges would be a black mass
        picture = render(material_actors(subject, mesh, labels, dpi, edges=not dense), camera, (height * aspect, height), dpi)
        detail = render(material_actors(subject, mesh, labels, dpi, edges=True), closeup, (height, height), dpi)
        name = ("grid", "particles")[number]
        rows.append([(framed(picture, camera, closeup, dpi), f"({'ac'[number]}) {name}: {run.report['triangles']:,} triangles"),
                     (detail, f"({'bd'[number]}) radius ratio at least {run.report['min_radius_ratio']:.2g}, on average "
                              f"{run.report['mean_radius_ratio']:.2f}")])
    faults = runs.faults("grid")
    grid = both[0]
    caption = (f"The {subject.title} by the grid method (above) and by particles (below) with about as many triangles. Of the "
               f"grid's {faults['slivers']:,} have a radius ratio below 0.1; its surfaces have "
               f"{grid.count('open_edges'):,} open edges (cracks) and {grid.count('nonmanifold_edges'):,} non-manifold ones, "
               f"and {grid.report['self_intersecting_pairs']:,} pairs of triangles cut each other.")
    return Sheet(rows, caption_height=0.19), caption


def outer_faces(tetrahedra, labels):
    """The faces with one tetrahedron, outward, and the label of that one."""
    faces = np.concatenate([tetrahedra[:, list(corners)] for corners in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))])
    owner = np.tile(np.arange(len(tetrahedra)), 4)
    key = np.sort(faces, axis=1)
    order = np.lexsort(key.T)
    key = key[order]
    same = (key[1:] == key[:-1]).all(axis=1)
    single = np.ones(len(key), bool)
    single[1:][same] = single[:-1][same] = False
    return faces[order[single]], labels[owner[order[single]]]


def tetrahedra_cut(subject, runs, dpi):
    """Figure 9: the tetrahedra behind a plane."""
    from mesh import Mesh
    points, tetrahedra, labels = runs.tetrahedral_mesh("SP")
    report = runs.tetrahedra("SP")["tetrahedra"]
    normal = np.zeros(3)
    axis = int(np.argmax(np.abs(subject.section)))
    normal[axis] = np.sign(subject.section[axis])
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    offset = (points[tetrahedra].mean(axis=1) - centre) @ normal
    behind = offset < 1e-3 * np.ptp(points)  # not quite in the middle, where symmetric volumes have a layer
    faces, owner = outer_faces(tetrahedra[behind], labels[behind])
    cut = Mesh(points, faces, np.column_stack([owner, np.zeros_like(owner)]))
    aspect = subject.section_aspect
    camera = camera_for(points, subject.section, subject.up, aspect)
    closeup = camera.zoomed(*subject.section_closeup)
    height = (PAGE - GAP) / (1 + aspect)
    colours = mapped(cut.polydata(), np.array([to_rgb(subject.colour(int(label))) for label in owner]))
    dense = len(faces) > 60_000
    picture = render([actor(colours, edges=True, edge_points=0.1 if dense else 0.3, ambient=0.55, dpi=dpi)], camera, (height * aspect, height), dpi)
    detail = render([actor(colours, edges=True, ambient=0.55, dpi=dpi)], closeup, (height, height), dpi)
    caption = (f"Tetrahedra of the {subject.title} behind a cutting plane (sphere packing): {report['count']:,}, radius ratio "
               f"3r/R at least {report['min_radius_ratio']:.2f}, on average {report['mean_radius_ratio']:.2f}; "
               f"{report['slivers']:,} slivers (below 0.1); dihedral angles {report['min_dihedral_degrees']:.0f} to "
               f"{report['max_dihedral_degrees']:.0f} degrees.")
    return Sheet([[(framed(picture, camera, closeup, dpi), ""), (detail, "")]], caption_height=0.0), caption


def thin(subject, runs, dpi):
    """Figure 4."""
    return thin_wall.figure(subject, runs, dpi)


def maps(subject, runs, dpi):
    """Bend of the mesh, and distance to the voxels' interface."""
    from matplotlib import colormaps
    run = runs.get("particle")
    mesh = run.mesh
    labels = shown_labels(subject, mesh)
    chosen = np.isin(mesh.sides, labels).any(axis=1)
    visible = mesh.only(chosen)
    camera = camera_for(mesh.used(), subject.view, subject.up, subject.aspect)
    size = panel(2, subject.aspect)
    voxel = runs.volume.voxel()
    angles = bends(mesh)[chosen]
    distance = np.nan_to_num(read_point_array(runs.folder / "distance.vtp", "DistanceToVoxels"), nan=np.inf) / voxel
    limit_angle, limit_distance = 40.0, 1.0
    bent = mapped(visible.polydata(), colormaps["viridis"](np.minimum(angles / limit_angle, 1))[:, :3])
    far = mapped(visible.polydata(), colormaps["magma_r"](np.minimum(distance / limit_distance, 1))[:, :3])
    entries = run.report["distance_to_voxels"]
    rows = [[(render([actor(bent, ambient=0.6, dpi=dpi)], camera, size, dpi), "(a) bend: largest angle to a neighbour, degrees"),
             (render([actor(far, ambient=0.6, dpi=dpi)], camera, size, dpi), "(b) distance to the voxels' interface, voxels")],
            [(colour_bar("viridis", limit_angle, size[0], dpi, "more"), ""),
             (colour_bar("magma_r", limit_distance, size[0], dpi, "more"), "")]]
    caption = (f"The mesh of the {subject.title}: how it bends (mean of the triangles shown {angles.mean():.1f} degrees), and how far "
               f"it is from the voxels' own interface: {entries['mean'] / voxel:.2f} voxels on average, "
               f"{entries['max'] / voxel:.2f} at most.")
    return Sheet(rows), caption
