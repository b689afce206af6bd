#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What Gmsh finds in a .msh file, as JSON: for each physical group its name, elements, volume (area, and the sum of the
vectors of the areas) and nodes; and what Gmsh complains of. In a process of its own: Gmsh brings other libraries."""
import json
import sys

import gmsh
import numpy as np

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.open(sys.argv[1])

tags, coordinates, _ = gmsh.model.mesh.getNodes()
points = np.zeros((int(tags.max()) + 1, 3))
points[tags.astype(int)] = coordinates.reshape(-1, 3)
groups = []
for dimension, tag in gmsh.model.getPhysicalGroups():
    group = {"dimension": dimension, "tag": tag, "name": gmsh.model.getPhysicalName(dimension, tag)}
    corners = []
    for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
        kinds, _, nodes = gmsh.model.mesh.getElements(dimension, entity)
        assert list(kinds) == [4 if dimension == 3 else 2], kinds
        corners.append(nodes[0].astype(int).reshape(-1, dimension + 1))
    a, *others = np.moveaxis(points[np.concatenate(corners)], 1, 0)
    if dimension == 3:
        volumes = np.einsum("ij,ij->i", np.cross(others[0] - a, others[1] - a), others[2] - a) / 6
        group.update(volume=volumes.sum(), least=volumes.min(), elements=len(volumes))
    else:
        areas = np.cross(others[0] - a, others[1] - a) / 2
        group.update(area=np.linalg.norm(areas, axis=1).sum(), vector=areas.sum(axis=0).tolist(), elements=len(areas))
    group["nodes"] = len(gmsh.model.mesh.getNodesForPhysicalGroup(dimension, tag)[0])
    groups.append(group)
elements = gmsh.model.mesh.getElements(3)
inner = {dimension: sum(len(gmsh.model.mesh.getNodes(dimension, entity)[0])
                        for _, entity in gmsh.model.getEntities(dimension)) for dimension in (2, 3)}
print(json.dumps({
    "groups": groups, "nodes": len(tags), "coordinates": [float(x).hex() for x in points[1:].ravel()],
    "corners": {str(int(tag)): list(map(int, corners)) for kind, tags, nodes in zip(*elements)
                for tag, corners in zip(tags, nodes.reshape(-1, 4))},
    "classified": inner,
    "boundaries": [[volume, sorted(map(int, gmsh.model.getAdjacencies(3, volume)[1]))]
                   for _, volume in gmsh.model.getEntities(3)],
    "complaints": [line for line in gmsh.logger.get() if not line.startswith(("Info:", "Debug:", "Progress:"))]}))
gmsh.finalize()
