# SPDX-License-Identifier: BSD-3-Clause
"""Every figure of Examples/Figures at small size against its baseline.

    test_images.py REPRODUCE              with the environment of the ctest Figures.images
    test_images.py REPRODUCE --accept     makes the baselines anew: look at them before you commit them

A picture that differs stays in the output folder, with its difference beside it.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "Examples" / "Figures")]
from compare_images import THRESHOLD, difference  # noqa: E402
from pictures import for_screen  # noqa: E402

BASELINES = HERE / "Baseline"
VOLUMES = ("two_spheres_small", "thin_plate")  # together they have all figures
EXPECTED = {"two_spheres_small": {"figure_2_junctions", "figure_3_indicator_functions", "figure_7_shared_boundary",
                                  "figure_8_grid_and_particles", "figure_9_tetrahedra", "maps", "histograms"},
            "thin_plate": {"figure_1_surfaces", "figure_4_thin_wall", "figure_5_materials", "figure_8_grid_and_particles",
                           "figure_9_tetrahedra", "maps", "histograms"}}


def check_texts(output, name):
    """The page holds all that it shows; the tables have their rows."""
    page = (output / name / "index.html").read_text()
    assert page.count("data:image/png;base64,") == len(EXPECTED[name]), "a picture is missing in the page"
    assert "src=\"data:" in page and "http" not in page, "the page needs something outside"
    tools = (output / name / "tools.csv").read_text().splitlines()
    assert len(tools) == 7, tools
    particles = tools[1].split(",")
    assert particles[0] == "particles (LabelMesh)" and particles[-7:-2] == ["0"] * 5, particles
    caption = (output / name / "tools.md").read_text()
    for line in tools[1:]:  # a tool that is not here is named, with the reason
        title = line.split(",")[0]
        assert ",-,-," not in line or f"Not made: {title} (" in caption, line


def main(reproduce, accept):
    output = Path(os.environ["LABELMESH_OUTPUT"]) / "comparison"
    shutil.rmtree(output, ignore_errors=True)
    volumes = [str(Path(os.environ["LABELMESH_VOLUMES"]) / f"{name}.mha") for name in VOLUMES]
    missing = str(output / "nowhere.mha")
    turned = str(Path(os.environ["LABELMESH_VOLUMES"]) / "two_spheres_mirrored.mha")
    result = subprocess.run([reproduce, *volumes, turned, missing, "-o", str(output), "--size", "small", "--no-cgal"],
                            capture_output=True, text=True)
    print(result.stdout, result.stderr)
    assert result.returncode == 0, "reproduce failed"
    assert f"{missing} is not there: left out." in result.stdout
    assert "two_spheres_mirrored\n  left out: its axes are not the world's" in result.stdout
    wrong = []
    for name in VOLUMES:
        made = {path.stem: path for path in (output / name).glob("*.png")}
        assert set(made) == EXPECTED[name], sorted(made)
        check_texts(output, name)
        for stem, path in sorted(made.items()):
            baseline = BASELINES / f"{name}.{stem}.png"
            if accept:
                BASELINES.mkdir(exist_ok=True)
                baseline.write_bytes(for_screen(path))
            error = difference(path, baseline, output / f"{name}.{stem}.difference.png")
            print(f"{name} {stem}: {error:.2f}")
            if error > THRESHOLD:
                wrong.append(f"{name}.{stem}")
    for number in (1, 2, 3):
        assert (output / f"table_{number}.md").stat().st_size > 0
        assert (output / f"table_{number}.csv").stat().st_size > 0
    assert not wrong, f"differ from their baselines: {', '.join(wrong)}"


if __name__ == "__main__":
    main(sys.argv[1], "--accept" in sys.argv)
