#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures labelmesh: quality, defects, time and memory, and how they grow.

    benchmark.py [VOLUME...] [options]

VOLUME is a file that labelmesh reads, or a volume of Data/make_volumes.py (two_spheres, two_spheres@256); two_spheres
when none is given. Four tables come out, and all of it as JSON:

  cases      every volume: particles, triangles, minimum, 1st percentile and mean of 2 r_in / r_circ, defects (wrong
             faces, and open edges, non-manifold edges and non-manifold vertices of the surface of every material, the
             background among them), seconds, the ratio to one Delaunay tetrahedralisation of the same points in the
             same run, peak memory
  threads    the first volume with 1 and 2 threads
  sizes      two_spheres with 64, 128, 256 and 512 voxels along each side
  particles  the first volume with half and twice the particles

The last column of sizes and particles, power, is p in seconds ~ n^p from the row before: n log n is a little over 1.
"""
import argparse
import importlib.util
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLES = ("cases", "threads", "sizes", "particles")
DEFECTS = ("open_edges", "nonmanifold_edges", "nonmanifold_vertices")


class Problem(Exception):
    pass


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volumes", nargs="*", metavar="VOLUME", default=["two_spheres"])
    parser.add_argument("--labelmesh", type=Path, default=ROOT / "build" / "bin" / "labelmesh",
                        help="the executable (default: build/bin/labelmesh)")
    parser.add_argument("--delaunay", type=Path,
                        help="labelmesh-delaunay (default: beside labelmesh, where ./setup.sh test leaves it)")
    parser.add_argument("--repeat", type=int, default=1, help="runs of each case; the median of their times counts")
    parser.add_argument("--tables", default=",".join(TABLES), help="which tables (default: %(default)s)")
    parser.add_argument("--sizes", type=int, nargs="+", default=[64, 128, 256, 512])
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--factors", type=float, nargs="+", default=[0.5, 1, 2], help="of particles")
    parser.add_argument("--options", default="", help="more options for every run of labelmesh, in one word")
    parser.add_argument("--json", type=Path, default=Path("benchmark.json"), help="(default: %(default)s)")
    options = parser.parse_args(arguments)
    options.tables = options.tables.split(",")
    unknown = set(options.tables) - set(TABLES)
    if unknown:
        parser.error(f"no table '{min(unknown)}'; there are {', '.join(TABLES)}")
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    # Runs take place in a temporary folder.
    options.labelmesh = options.labelmesh.absolute()
    options.delaunay = (options.delaunay or options.labelmesh.with_name("labelmesh-delaunay")).absolute()
    return options


def run(command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if result.returncode != 0:
        raise Problem(result.stderr.strip() or f"{command[0]} ended with {result.returncode}")
    return result.stdout


class Bench:
    """Runs cases in a temporary folder."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = Path(folder)

    def volume(self, name):
        """The file of a volume; made when it is one of make_volumes.py."""
        if Path(name).is_file():
            return Path(name).absolute()
        path = self.folder / f"{name}.mha"
        if not path.exists():
            if importlib.util.find_spec("numpy") is None:
                raise Problem(f"no file '{name}', and making a volume needs numpy, which {sys.executable} has not")
            run([sys.executable, ROOT / "Data" / "make_volumes.py", self.folder, name])
        return path

    def delaunay(self, particles):
        if not self.options.delaunay.exists():
            return None
        return json.loads(run([self.options.delaunay, particles]))["seconds"]

    def measure(self, name, *arguments):
        """Runs a case as often as asked for; the figures of the first run, the medians of the times."""
        report, particles = self.folder / "report.json", self.folder / "particles.vtp"
        files = ["-o", self.folder / "mesh.vtp", "--particles", particles, "--report", report, "--quiet"]
        reports, delaunay = [], []
        for _ in range(self.options.repeat):
            run([self.options.labelmesh, self.volume(name), *files, *self.options.options.split(), *arguments])
            reports.append(json.loads(report.read_text()))
            delaunay.append(self.delaunay(particles))
        return summary(Path(name).stem if Path(name).is_file() else name, reports, delaunay)


def summary(case, reports, delaunay):
    first = reports[0]
    surfaces = first["materials"] + [first["background"]]
    defects = {kind: sum(surface[kind] for surface in surfaces) for kind in DEFECTS}
    defects["wrong_faces"] = first["wrong_faces"]
    seconds = {stage: statistics.median(report["seconds"][stage] for report in reports) for stage in first["seconds"]}
    alone = None if None in delaunay else statistics.median(delaunay)
    return {
        "case": case,
        "voxels": math.prod(first["dimensions"]),
        "materials": len(first["materials"]),
        "particles": sum(first["cells"].values()),
        "triangles": first["triangles"],
        "min_radius_ratio": first["min_radius_ratio"],
        "p1_radius_ratio": first["p1_radius_ratio"],
        "mean_radius_ratio": first["mean_radius_ratio"],
        "defects": sum(defects.values()),
        "defects_by_kind": defects,
        "duplicate_triangles": first["duplicate_triangles"],
        "lost": len(first["lost"]),
        "seconds": seconds,
        "delaunay_seconds": alone,
        "ratio_to_delaunay": seconds["total"] / alone if alone else None,
        "peak_memory_bytes": max(report["peak_memory_bytes"] for report in reports),
        "threads": first["threads"],
    }


def add_powers(rows, count):
    """p of seconds ~ count^p, from each row to the next."""
    for before, row in zip(rows, rows[1:]):
        growth = math.log(row[count] / before[count]) if row[count] != before[count] else None
        row["power"] = math.log(row["seconds"]["total"] / before["seconds"]["total"]) / growth if growth else None


def cases(bench):
    for volume in bench.options.volumes:
        yield bench.measure(volume)


def threads(bench):
    first = None
    for count in bench.options.threads:
        row = bench.measure(bench.options.volumes[0], "--threads", count)
        first = first or row
        row["speed_up"] = {s: first["seconds"][s] / t for s, t in row["seconds"].items() if t > 0}
        # One Delaunay, which has one thread only, taken from both.
        row["speed_up_without_delaunay"] = None
        if row["delaunay_seconds"] is not None:
            rest = [r["seconds"]["total"] - r["delaunay_seconds"] for r in (first, row)]
            row["speed_up_without_delaunay"] = rest[0] / rest[1]
        yield row


def sizes(bench):
    for size in bench.options.sizes:
        yield bench.measure(f"two_spheres@{size}")


def particles(bench):
    volume = bench.options.volumes[0]
    triangles = bench.measure(volume)["triangles"]
    for factor in bench.options.factors:
        row = bench.measure(volume, *([] if factor == 1 else ["--triangles", round(factor * triangles)]))
        row["factor"] = factor
        yield row


def text(value, digits):
    if value is None:
        return "-"
    return f"{value:.{digits}f}" if isinstance(value, float) else str(value)


def print_table(title, columns, rows):
    """columns: (heading, digits, function of a row)."""
    print(f"\n{title}")
    lines = [[heading for heading, _, _ in columns]]
    lines += [[text(get(row), digits) for _, digits, get in columns] for row in rows]
    widths = [max(len(line[c]) for line in lines) for c in range(len(columns))]
    for line in lines:
        print("  ".join([line[0].ljust(widths[0])] + [word.rjust(n) for word, n in zip(line[1:], widths[1:])]))
    sys.stdout.flush()


def field(key):
    return lambda row: row.get(key)


def main_columns():
    return [("case", 0, field("case")), ("voxels", 0, field("voxels")), ("materials", 0, field("materials")),
            ("particles", 0, field("particles")), ("triangles", 0, field("triangles")),
            ("min", 3, field("min_radius_ratio")), ("1 %", 3, field("p1_radius_ratio")),
            ("mean", 3, field("mean_radius_ratio")), ("defects", 0, field("defects")), ("lost", 0, field("lost")),
            ("seconds", 2, lambda row: row["seconds"]["total"]), ("Delaunay", 2, field("delaunay_seconds")),
            ("ratio", 1, field("ratio_to_delaunay")), ("MiB", 0, lambda row: row["peak_memory_bytes"] >> 20)]


def stage_columns(head, rows):
    return [head] + [(stage, 2, lambda row, stage=stage: row["seconds"].get(stage)) for stage in rows[0]["seconds"]]


def show(table, rows):
    case = ("case", 0, field("case"))
    count = ("threads", 0, field("threads"))
    power = ("power", 2, field("power"))
    if table == "cases":
        print_table("Cases", main_columns(), rows)
        print_table("Seconds per stage", stage_columns(case, rows), rows)
    elif table == "threads":
        print_table(f"Threads: {rows[0]['case']}, seconds per stage", stage_columns(count, rows), rows)
        speed = [(stage, 2, lambda row, stage=stage: row["speed_up"].get(stage)) for stage in rows[0]["seconds"]]
        print_table("Times as fast", [count] + speed + [("without Delaunay", 2, field("speed_up_without_delaunay"))],
                    rows)
    else:
        against = {"sizes": "voxels", "particles": "particles"}[table]
        print_table(f"Seconds against {against}", main_columns() + [power], rows)
        print_table("Seconds per stage", stage_columns((against, 0, field(against)), rows), rows)


def main(arguments):
    options = parse(arguments)
    result = {"machine": platform.processor() or platform.machine(), "cores": os.cpu_count(),
              "load": os.getloadavg()[0], "repeat": options.repeat, "options": options.options}
    if result["load"] > 0.3:
        print(f"Others use this machine: {result['load']:.1f} programs ran in the last minute, on {result['cores']} "
              "cores. Their work shows in the times.")
    try:
        if not options.labelmesh.is_file():
            raise Problem(f"no executable '{options.labelmesh}'; ./setup.sh build makes it, --labelmesh names another")
        result["version"] = run([options.labelmesh, "--version"]).split()[-1]
        if not options.delaunay.is_file():
            print(f"No '{options.delaunay}' (built where LABELMESH_TESTING is on): no ratio to one Delaunay.")
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(options, folder)
            for table in options.tables:
                rows = list(globals()[table](bench))
                if table in ("sizes", "particles"):
                    add_powers(rows, "voxels" if table == "sizes" else "particles")
                result[table] = rows
                options.json.write_text(json.dumps(result, indent=1) + "\n")
                show(table, rows)
    except Problem as problem:
        print(f"benchmark.py: {problem}", file=sys.stderr)
        return 1
    print(f"\nAll of it: {options.json}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
