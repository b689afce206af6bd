# SPDX-License-Identifier: BSD-3-Clause
"""The report of meshes that labelmesh has not made, with the names of its report.json.

The same filter measures: vtkLabelMeshReport.
"""
from labelmesh import vtkLabelMeshReport

MATERIAL = {"label": "Label", "triangles": "Triangles", "vertices": "Vertices", "min_radius_ratio": "MinRadiusRatio",
            "mean_radius_ratio": "MeanRadiusRatio", "closed": "Closed", "open_edges": "OpenEdges",
            "nonmanifold_edges": "NonManifoldEdges", "nonmanifold_vertices": "NonManifoldVertices",
            "self_intersections": "SelfIntersections", "volume": "Volume", "voxel_volume": "VoxelVolume",
            "voxels": "Voxels", "misclassified_voxels": "MisclassifiedVoxels", "certified": "Certified"}


TOTALS = {"points": "Points", "triangles": "Triangles", "min_radius_ratio": "MinRadiusRatio",
          "mean_radius_ratio": "MeanRadiusRatio", "self_intersecting_pairs": "SelfIntersectingPairs",
          "misclassified_voxels": "MisclassifiedVoxels", "certified": "Certified"}
REAL = {"MinRadiusRatio", "MeanRadiusRatio", "Volume", "VoxelVolume"}


def value(name, variant):
    return variant.ToDouble() if name in REAL else variant.ToLongLong()


def judge(polydata, volume, method, background=0):
    """As labelmesh's report.json, as far as the tables and pictures here use it."""
    report = vtkLabelMeshReport()
    report.SetInputData(0, polydata)
    report.SetInputData(1, volume.image)
    report.Update()
    table = report.GetOutputDataObject(0)
    totals = {key: value(name, table.GetFieldData().GetAbstractArray(name).GetVariantValue(0))
              for key, name in TOTALS.items()}
    materials = [{key: value(name, table.GetValueByName(row, name)) for key, name in MATERIAL.items()}
                 for row in range(table.GetNumberOfRows())]
    return {"method": method, **totals, "materials": [row for row in materials if row["label"] != background]}
