#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the reports of labelmesh side by side: compare_reports.py REPORT.json..."""
import json
import sys


def number(value):
    return f"{value:,}" if isinstance(value, int) else f"{value:.3f}"


def main(paths):
    reports = [json.load(open(path)) for path in paths]
    rows = [("", [report["method"] for report in reports])]
    for key, title in [("points", "points"), ("triangles", "triangles"),
                       ("min_radius_ratio", "min 2r/R"), ("mean_radius_ratio", "mean 2r/R")]:
        rows.append((title, [number(report[key]) for report in reports]))
    for material in reports[0]["materials"]:
        same = [next((m for m in report["materials"] if m["label"] == material["label"]), None) for report in reports]
        name = material["name"]
        for key, title in [("triangles", "triangles"), ("min_radius_ratio", "min 2r/R"),
                           ("mean_radius_ratio", "mean 2r/R")]:
            rows.append((f"{name}: {title}", [number(m[key]) if m else "-" for m in same]))
        rows.append((f"{name}: volume / voxels", [f"{m['volume'] / m['voxel_volume']:.4f}" if m else "-" for m in same]))
        sound = [("yes" if m["closed"] and m["manifold"] else "no") if m else "-" for m in same]
        rows.append((f"{name}: closed, manifold", sound))
    rows.append(("seconds", [f"{report['seconds']['total']:.2f}" for report in reports]))

    width = max(len(title) for title, _ in rows)
    for title, values in rows:
        print(f"{title:<{width}}" + "".join(f"{value:>14}" for value in values))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
