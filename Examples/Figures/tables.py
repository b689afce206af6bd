# SPDX-License-Identifier: BSD-3-Clause
"""The tables, as rows of texts: Markdown, CSV and HTML are written of the same rows."""
import csv
import html
import io
from dataclasses import dataclass

import paper
from runs import TETRAHEDRA, TITLES


@dataclass
class Table:
    name: str     # of its files
    caption: str
    head: list
    rows: list

    def markdown(self):
        lines = [self.head, ["---"] * len(self.head), *self.rows]
        return f"**{self.caption}**\n\n" + "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"

    def csv(self):
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows([self.head, *self.rows])
        return text.getvalue()

    def html(self):
        def line(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"
        return (f"<table><caption>{html.escape(self.caption)}</caption>" + line(self.head, "th")
                + "".join(line(row, "td") for row in self.rows) + "</table>")

    def of(self, volume):
        """The rows of one volume."""
        return Table(self.name, self.caption, self.head, [row for row in self.rows if row[0] == volume])

    def write(self, folder):
        (folder / f"{self.name}.md").write_text(self.markdown())
        (folder / f"{self.name}.csv").write_text(self.csv())


def count(number):
    return f"{number:,}"


def ratio(number):
    """Two digits, and more where these would be 0."""
    return f"{number:.2f}" if number >= 0.005 or number == 0 else f"{number:.1g}"


def ratios(least, mean):
    return f"{ratio(least)} / {mean:.2f}"


def percent(part, whole):
    return f"{100 * part / max(whole, 1):.2g}"


def seconds(number):
    return f"{number:.1f}" if number < 100 else f"{number:.0f}"


def defects(report):
    """What keeps a mesh from its certificate, in words."""
    keys = {"open_edges": "open edges", "nonmanifold_edges": "non-manifold edges",
            "nonmanifold_vertices": "non-manifold vertices", "self_intersections": "self-intersections"}
    sums = {words: sum(material[key] for material in report["materials"]) for key, words in keys.items()}
    found = [f"{count(number)} {words}" for words, number in sums.items() if number]
    return ", ".join(found) or "none"


def materials_of(report):
    """How the paper counts: the background is one."""
    return len(report["materials"]) + 1


def table_1(all_runs):
    rows = []
    for subject, runs in all_runs:
        report = runs.get("particle").report
        theirs = paper.TABLE_1.get(subject.title)
        stages = sum(report["cells"][dimension] for dimension in "012")
        rows.append([subject.title,
                     f"{theirs[0]}; {theirs[1]}" if theirs else "-", count(theirs[2]) if theirs else "-",
                     theirs[3] if theirs else "-",
                     f"{materials_of(report)}; " + " x ".join(map(str, report["dimensions"])), count(stages),
                     seconds(report["seconds"]["total"]), defects(report)])
    return Table("table_1", "Table 1. Volumes, particles on junctions, time. The paper's volumes are others, but for the "
                 "spheres.", ["volume", "paper: materials; size", "paper: particles", "paper: sampling alone",
                              "materials; size", "particles", "seconds, everything", "defects"], rows)


def table_2(all_runs):
    kinds = ["particle", "paper", "grid", "labels", "nets", "cgal"]
    rows, absent = [], {}
    for subject, runs in all_runs:
        theirs = paper.TABLE_2.get(subject.title, {})
        columns = {kind: runs.get(kind) for kind in kinds}
        absent.update(runs.reasons)
        for material in columns["particle"].report["materials"]:
            name = subject.name(material["label"])
            row = [subject.title, name]
            row += [count(theirs[name][0]), ratios(*theirs[name][1:])] if name in theirs else ["-", "-"]
            for kind in kinds:
                same = [m for m in columns[kind].report["materials"]
                        if m["label"] == material["label"]] if columns[kind] else []
                row += [f"{count(m['triangles'])}; {ratios(m['min_radius_ratio'], m['mean_radius_ratio'])}" for m in same] or ["-"]
            rows.append(row)
    head = ["volume", "material", "paper: triangles", "paper: least / mean"] + [TITLES[kind] for kind in kinds]
    return Table("table_2", "Table 2. Triangles of each material; least / mean radius ratio 2 r_in / r_circ." + why(absent), head, rows)


def why(reasons):
    return "".join(f" Not made: {TITLES[kind]} ({text})." for kind, text in reasons.items())


def tools_table(subject, runs):
    """All tools on one volume, and what is wrong with their meshes."""
    rows = []
    for kind in TITLES:
        run = runs.get(kind)
        if run is None:
            rows.append([TITLES[kind]] + ["-"] * 12)
            continue
        report, faults = run.report, runs.faults(kind)
        foreground = sum(material["voxels"] for material in report["materials"])
        rows.append([TITLES[kind], count(report["points"]), count(report["triangles"]),
                     ratio(report["min_radius_ratio"]), f"{report['mean_radius_ratio']:.3f}", count(faults["slivers"]),
                     count(run.count("open_edges")), count(run.count("nonmanifold_edges")),
                     count(report["self_intersecting_pairs"]), count(faults["overlaps"]), count(faults["gaps"]),
                     percent(report["misclassified_voxels"], foreground), seconds(run.seconds)])
    grid = paper.GRID.get(subject.title)
    cited = f" The paper's grid method had {ratios(*grid)}." if grid else ""
    return Table("tools", f"The tools on the {subject.title}, at about as many triangles. Open and non-manifold edges of the "
                 "materials' surfaces; pairs of triangles that cut each other; voxel centres in two materials, and in none "
                 "though amid materials; voxels in the wrong material in % of the foreground's." + cited + why(runs.reasons),
                 ["tool", "vertices", "triangles", "least 2r/R", "mean 2r/R", "below 0.1", "open edges",
                  "non-manifold edges", "self-intersections", "overlaps", "gaps", "wrong voxels, %", "seconds"], rows)


def table_3(all_runs):
    rows = []
    for subject, runs in all_runs:
        theirs = paper.TABLE_3.get(subject.title, {})
        for method in TETRAHEDRA:
            report = runs.tetrahedra(method)
            ours = report["tetrahedra"]
            row = [subject.title, method]
            if method in theirs:
                row += [count(theirs[method][0]), ratios(*theirs[method][1:3]), f"{theirs[method][3]:.2f}"]
            else:
                row += ["-"] * 3
            rows.append(row + [count(ours["count"]), ratios(ours["min_radius_ratio"], ours["mean_radius_ratio"]),
                               count(ours["slivers"]), percent(ours["slivers"], ours["count"]),
                               f"{ours['min_dihedral_degrees']:.1f} to {ours['max_dihedral_degrees']:.1f}",
                               count(ours["turned_over"]), seconds(report["seconds"]["total"])])
    return Table("table_3", "Table 3. Tetrahedra by sphere packing (SP), with one and two rounds of refinement (SP-1R, "
                 "SP-2R) and with TetGen's own points (TG); radius ratio 3 r_in / r_circ, slivers below 0.1. Ours are "
                 "improved after that (--tet-improve 10).",
                 ["volume", "method", "paper: tetrahedra", "paper: least / mean", "paper: slivers, %", "tetrahedra",
                  "least / mean", "slivers", "slivers, %", "dihedral angles, degrees", "turned over", "seconds"], rows)
