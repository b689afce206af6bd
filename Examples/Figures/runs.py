# SPDX-License-Identifier: BSD-3-Clause
"""The meshes that are compared, and their reports.

particle   labelmesh as it is
paper      labelmesh with the paper's smoothing (--smoothing tighten --radius 1)
grid       all labels in one mesh: marching cubes, smoothing, decimation to as many triangles (the paper's section 6)
labels     the same label by label, as VTK's users do it: each material's surface is made without the others
nets       vtkSurfaceNets3D with its own smoothing, where a VTK has it (9.3 and later)
cgal       CGAL's Mesh_3 on the labels, with about as many triangles, where its headers are installed
"""
import json
import math
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import surface_nets
from judge import judge
from mesh import Mesh, edge_lengths, minimum_angles, overlaps_and_gaps, radius_ratios, read_mesh, read_tetrahedra

HERE = Path(__file__).resolve().parent
TITLES = {"particle": "particles (LabelMesh)", "paper": "particles, the paper's smoothing", "grid": "grid, all labels in one",
          "labels": "grid, label by label", "nets": "vtkSurfaceNets3D", "cgal": "CGAL Mesh_3"}
TETRAHEDRA = {"SP": [], "SP-1R": ["--tet-refine", "1"], "SP-2R": ["--tet-refine", "2"], "TG": ["--tet-method", "tetgen"]}


class Unavailable(Exception):
    """A column that cannot be made here; its text says why."""


@dataclass
class Run:
    """A mesh and what is known of it."""
    kind: str
    mesh: Mesh
    report: dict  # as labelmesh's report.json
    seconds: float

    def count(self, key):
        """Sum over the materials."""
        return sum(material[key] for material in self.report["materials"])


def say(text):
    print(text, flush=True)


def labelmesh(executable, volume, folder, name, arguments):
    """Runs labelmesh once for the same command and executable, and returns its report."""
    folder.mkdir(parents=True, exist_ok=True)
    report, stamp = folder / f"{name}.json", folder / f"{name}.command"
    command = [str(executable), str(volume), *map(str, arguments), "--report", str(report), "--quiet"]
    identity = " ".join(command) + "".join(f" {Path(path).stat().st_mtime_ns}" for path in (executable, volume))
    if not (report.exists() and stamp.exists() and stamp.read_text() == identity):
        stamp.unlink(missing_ok=True)
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode:
            raise RuntimeError(f"labelmesh failed: {result.stderr.strip()}\n  {' '.join(command)}")
        stamp.write_text(identity)
    return json.loads(report.read_text())


class Runs:
    """All meshes of one volume, each made when it is first asked for."""

    def __init__(self, executable, path, volume, folder, options):
        self.executable, self.path, self.volume, self.folder, self.options = executable, path, volume, folder, options
        self.made, self.reasons, self.tetrahedral, self.measured = {}, {}, {}, {}

    def get(self, kind):
        """The run, or None; then reasons[kind] is a sentence."""
        if kind not in self.made and kind not in self.reasons:
            say(f"  mesh: {TITLES[kind]}")
            try:
                self.made[kind] = getattr(self, kind)()
            except Unavailable as error:
                say(f"    left out: {error}")
                self.reasons[kind] = str(error)
        return self.made.get(kind)

    def surfaces(self, kind, arguments, name=None):
        name = name or kind
        mesh = self.folder / f"{name}.vtp"
        report = labelmesh(self.executable, self.path, self.folder, name, [*arguments, "-o", mesh])
        return Run(kind, read_mesh(mesh), report, report["seconds"]["total"])

    def particle(self):
        return self.surfaces("particle", ["--error-map", self.folder / "distance.vtp"])

    def paper(self):
        return self.surfaces("paper", ["--smoothing", "tighten", "--radius", "1"])

    def grid(self):
        return self.surfaces("grid", ["--method", "grid", "--triangles", self.get("particle").report["triangles"]])

    def labels(self):
        """Each material by itself, with as many triangles as the particles give it; then all put together."""
        parts, reports = [], []
        for material in self.get("particle").report["materials"]:
            if material["triangles"] == 0:
                continue
            run = self.surfaces("labels", ["--method", "grid", "--labels", material["label"], "--triangles",
                                           material["triangles"]], f"label_{material['label']}")
            parts.append(run.mesh)
            reports.append(run.report)
        first = np.cumsum([0] + [len(part.points) for part in parts])
        together = Mesh(np.concatenate([part.points for part in parts]),
                        np.concatenate([part.triangles + start for part, start in zip(parts, first)]),
                        np.concatenate([part.sides for part in parts]))
        report = judge(together.polydata(), self.volume, "labels")
        return Run("labels", together, report, sum(one["seconds"]["total"] for one in reports))

    def outside_mesh(self, kind, command, output):
        """A mesh that another program writes, judged."""
        start = time.time()
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        seconds = time.time() - start
        if result.returncode:
            raise Unavailable((result.stderr.strip() or result.stdout.strip()).splitlines()[-1])
        mesh = read_mesh(output)
        return Run(kind, mesh, judge(mesh.polydata(), self.volume, kind), seconds)

    def nets(self):
        if self.options.vtk_python:
            output = self.folder / "nets.vtp"
            return self.outside_mesh("nets", [self.options.vtk_python, HERE / "surface_nets.py", self.path, output], output)
        if surface_nets.why_not():
            raise Unavailable(surface_nets.why_not())
        start = time.time()
        mesh = surface_nets.surface_nets(self.volume)
        return Run("nets", mesh, judge(mesh.polydata(), self.volume, "nets"), time.time() - start)

    def cgal(self):
        program = cgal_program(self.options)
        wanted = self.get("particle").report["triangles"]
        labels, output = self.folder / "labels.inr", self.folder / "cgal.vtp"
        write_inrimage(self.volume, labels)
        size = 1.1 * float(np.mean(edge_lengths(self.get("particle").mesh)))
        for attempt in range(3):  # the number of triangles goes with the inverse square of their size
            run = self.outside_mesh("cgal", [program, labels, output, f"{size:.6g}", f"{self.volume.voxel():.6g}"], output)
            if abs(run.report["triangles"] / wanted - 1) < 0.03:
                break
            size *= math.sqrt(run.report["triangles"] / wanted)
        return run

    def tetrahedra(self, method):
        """The report with its entry "tetrahedra"; the mesh lies beside it."""
        if method not in self.tetrahedral:
            say(f"  tetrahedra: {method}")
            name = f"tetrahedra_{method}"
            self.tetrahedral[method] = labelmesh(self.executable, self.path, self.folder, name,
                                                 [*TETRAHEDRA[method], "--tets", self.folder / f"{name}.vtu"])
        return self.tetrahedral[method]

    def tetrahedral_mesh(self, method):
        self.tetrahedra(method)
        return read_tetrahedra(self.folder / f"tetrahedra_{method}.vtu")

    def faults(self, kind):
        """What a report does not hold: triangles below 0.1, sizes of angles, overlaps and gaps."""
        if kind not in self.measured:
            run = self.get(kind)
            labels = [material["label"] for material in run.report["materials"]]
            overlaps, gaps = overlaps_and_gaps([run.mesh.surface(label) for label in labels], self.volume)
            self.measured[kind] = {"slivers": int((radius_ratios(run.mesh) < 0.1).sum()), "overlaps": overlaps, "gaps": gaps,
                                   "min_angle": float(minimum_angles(run.mesh).min())}
        return self.measured[kind]


def write_inrimage(volume, path):
    """The format that CGAL's images are read from."""
    if volume.labels.min() < 0 or volume.labels.max() > 255:
        raise Unavailable("CGAL's images hold labels from 0 to 255, this volume has others")
    nz, ny, nx = volume.labels.shape
    header = (f"#INRIMAGE-4#{{\nXDIM={nx}\nYDIM={ny}\nZDIM={nz}\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nSCALE=2**0\n"
              "CPU=decm\n" + "".join(f"V{axis}={step:.9g}\n" for axis, step in zip("XYZ", volume.spacing))
              + "".join(f"T{axis}={start:.9g}\n" for axis, start in zip("XYZ", volume.origin)))
    Path(path).write_bytes((header + "\n" * (252 - len(header)) + "##}\n").encode() + volume.labels.astype(np.uint8).tobytes())


def cgal_program(options):
    """Builds cgal_labels once; Unavailable where its headers are missing."""
    if not options.cgal:
        raise Unavailable("not asked for (--no-cgal)")
    folder = options.output / "cgal_build"
    program = folder / "cgal_labels"
    if not program.exists():
        if not shutil.which("cmake"):
            raise Unavailable("there is no cmake to build cgal_labels with")
        say("    building cgal_labels (about a minute, once)")
        for command in (["cmake", "-S", HERE, "-B", folder, "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", folder]):
            result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
            if result.returncode:
                (options.output / "cgal_build.log").write_text(result.stdout + result.stderr)
                raise Unavailable("cgal_labels was not built (CGAL's headers, GMP and zlib are needed); see cgal_build.log")
    return program
