# SPDX-License-Identifier: BSD-3-Clause
"""Makes the comparison's figures, tables and pages from label volumes. Run by `reproduce`, under pvpython.

    reproduce VOLUME...                    everything
    reproduce --table 3 VOLUME...          one table (1, 2 or 3; may be given several times), and nothing else
    reproduce --figure 8 VOLUME...         one figure (2 to 9, 1, maps, histograms), and nothing else

What is made where stands in OUTPUT/README.md. Meshes stay in OUTPUT/VOLUME/meshes and are used again.
"""
import argparse
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))  # pvpython does not do it

import diagrams  # noqa: E402
import figures  # noqa: E402
import plots  # noqa: E402
import tables  # noqa: E402
from mesh import read_volume  # noqa: E402
from page import page  # noqa: E402
from runs import TETRAHEDRA, Runs, Unavailable, say  # noqa: E402
from scene import PRINT, SMALL, save  # noqa: E402
from subjects import subject_of  # noqa: E402

# number in the paper: function and name of the file
MESH_FIGURES = {1: (figures.surfaces, "surfaces"), 4: (figures.thin, "thin_wall"), 5: (figures.materials_apart, "materials"),
                6: (figures.surfaces, "surfaces"), 7: (figures.shared_boundary, "shared_boundary"),
                8: (figures.grid_against_particles, "grid_and_particles"), 9: (figures.tetrahedra_cut, "tetrahedra")}
DIAGRAMS = {2: (diagrams.junctions, "junctions"), 3: (diagrams.indicator_functions, "indicator_functions")}
EXTRA = {"maps": figures.maps, "histograms": plots.histograms}


def parse(arguments):
    parser = argparse.ArgumentParser(prog="reproduce", description=__doc__.split("\n\n")[0],
                                     epilog="\n\n".join(__doc__.split("\n\n")[1:]),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volumes", nargs="+", type=Path, metavar="VOLUME", help=".mha, .mhd or .vti")
    parser.add_argument("-o", "--output", type=Path, default=Path("comparison"), help="folder to write in (comparison)")
    parser.add_argument("--size", choices=["print", "small"], default="print", help=f"{PRINT} or {SMALL} dots per inch")
    parser.add_argument("--table", type=int, choices=[1, 2, 3], action="append", default=[])
    parser.add_argument("--figure", action="append", default=[], choices=[*map(str, range(1, 10)), *EXTRA])
    parser.add_argument("--tets", choices=["some", "all"], default="some",
                        help="table 3 for the volumes of the paper's table 3, or for all (some)")
    parser.add_argument("--no-cgal", dest="cgal", action="store_false", help="leave the column CGAL out")
    parser.add_argument("--vtk-python", help="a Python whose VTK has vtkSurfaceNets3D, where this one has not")
    parser.add_argument("--labelmesh", type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def wants_tetrahedra(subject, options):
    return options.tets == "all" or options.table == [3] or subject.title in ("two spheres", "frog")


def heading(figure):
    return f"Counterpart of the paper's figure {figure}" if isinstance(figure, int) else figure.capitalize()


def wanted_figures(subject, options):
    if options.table and not options.figure:
        return []
    if options.figure:
        return [figure for figure in [*range(1, 10), *EXTRA] if str(figure) in options.figure]
    return [*subject.figures, *EXTRA]


def make_figure(figure, subject, runs, folder, dpi, options):
    """Writes a picture; (heading, path, caption)."""
    if figure in DIAGRAMS:
        function, name = DIAGRAMS[figure]
        sheet, caption = function(dpi)
    elif figure in MESH_FIGURES:
        function, name = MESH_FIGURES[figure]
        sheet, caption = function(subject, runs, dpi)
    elif figure == "histograms":
        name = figure
        methods = list(TETRAHEDRA) if wants_tetrahedra(subject, options) else []
        sheet, caption = plots.histograms(subject, runs, dpi, methods)
    else:
        name = figure
        sheet, caption = EXTRA[figure](subject, runs, dpi)
    path = folder / (f"figure_{figure}_{name}.png" if isinstance(figure, int) else f"{name}.png")
    sheet.save(path, dpi) if hasattr(sheet, "rows") else save(sheet, path, dpi)
    return heading(figure), path, caption


def figures_of(subject, runs, folder, dpi, options):
    made = []
    for figure in wanted_figures(subject, options):
        start = time.time()
        try:
            made.append(make_figure(figure, subject, runs, folder, dpi, options))
            say(f"  {made[-1][1].name}: {time.time() - start:.0f} s")
        except Unavailable as error:
            say(f"  {heading(figure)}: left out, {error}")
    (folder / "captions.md").write_text("".join(f"- `{path.name}`: {title}. {caption}\n" for title, path, caption in made))
    return made


def tables_of(all_runs, options):
    """The paper's tables, of all volumes together."""
    if options.figure and not options.table:
        return []
    asked = options.table or [1, 2, 3]
    made = [tables.table_1(all_runs)] if 1 in asked else []
    made += [tables.table_2(all_runs)] if 2 in asked else []
    filled = [(subject, runs) for subject, runs in all_runs if wants_tetrahedra(subject, options)]
    return made + ([tables.table_3(filled)] if 3 in asked and filled else [])


def existing(paths):
    found = []
    for path in paths:
        if path.is_file():
            found.append(path)
        else:
            say(f"{path} is not there: left out.")
    return found


def main(arguments):
    options = parse(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    dpi = PRINT if options.size == "print" else SMALL
    all_runs, results, start = [], {}, time.time()
    for path in existing(options.volumes):
        name = path.name.split(".")[0]
        say(f"{name}")
        subject, folder = subject_of(name), options.output / name
        folder.mkdir(exist_ok=True)
        try:
            runs = Runs(options.labelmesh, path.resolve(), read_volume(path), folder / "meshes", options)
            runs.get("particle")
        except (ValueError, RuntimeError) as error:
            say(f"  left out: {error}")
            continue
        made = figures_of(subject, runs, folder, dpi, options)
        results[name] = (subject, runs, made)
        all_runs.append((subject, runs))
    if not all_runs:
        say("There is no volume to work on.")
        return 1
    shared = tables_of(all_runs, options)
    for table in shared:
        table.write(options.output)
        say("\n" + table.markdown())
    for name, (subject, runs, made) in results.items():
        if options.table or options.figure:
            continue
        tools = tables.tools_table(subject, runs)
        tools.write(options.output / name)
        own = [table.of(subject.title) for table in shared]
        lead = (f"{runs.path.name}: meshed by LabelMesh and by other tools. Numbers of meshes are those of labelmesh's "
                "report; the paper is Meyer, Whitaker, Kirby, Ledergerber and Pfister (2008), whose own volumes, but for the "
                "spheres, are not public.")
        (options.output / name / "index.html").write_text(page(f"LabelMesh: {subject.title}", lead, made,
                                                                [*[table for table in own if table.rows], tools]))
    (options.output / "README.md").write_text(contents(results, shared))
    say(f"{options.output}: {time.time() - start:.0f} s")
    return 0


def contents(results, shared):
    lines = ["# Comparison", ""] + [table.markdown() for table in shared]
    for name, (subject, _, made) in results.items():
        lines += [f"## {subject.title}", "", *[f"![{title}]({name}/{path.name})\n\n{title}. {caption}\n"
                                               for title, path, caption in made]]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
