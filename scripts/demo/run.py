"""The demo: makes a sample city, runs every stage on it through qgis_process, and prints how well and how fast.

    scripts/demo/demo.sh            (or: make demo)

`demo.sh` prepares QGIS's environment and calls this script. It leaves in the demo's folder the city, the results, a
QGIS project and a page with pictures, summary.html.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from scripts.demo.checks import Figure  # noqa: E402
from scripts.demo.pictures import make_pictures  # noqa: E402
from scripts.demo.stages import Stage, stages  # noqa: E402
from urbanmap_qgis.io.pages.report import Report  # noqa: E402

HEADER = ("stage", "seconds", "against the truth", "value")
FILES = (
    ("summary.html", "table and pictures on one page"),
    ("urbanmap.qgz", "QGIS project: all layers in their styles, with a 3D view"),
    ("city/", "the sample city; city/README.txt says what is where"),
    ("models.gpkg", "building models, one feature a building; models.html is their report"),
    ("models.city.json", "the same as CityJSON 2.0"),
    ("survey_01.laz", "the mobile survey on the markings; survey_01.html is the report of its registration"),
    ("lanes.osm", "the lane map as Lanelet2; lanes.xodr as OpenDRIVE, lanes.html is its report"),
    ("merged.gpkg", "the models with walls that the survey measured"),
    ("textured/", "the models with facades from line images: glTF, OBJ and CityJSON"),
    ("citygml/", "the textured models as CityGML, laid out as PLATEAU has it"),
    ("tiles/", "the same as 3D Tiles, for Cesium and QGIS 3.34 or later"),
    ("adjusted.html", "report on the walls that GNSS reflections moved"),
)


@dataclass(frozen=True)
class Result:
    """A stage that ran: its wall time in seconds (with the start of QGIS) and its figures."""

    stage: Stage
    seconds: float
    figures: list[Figure]


def run_stage(process: str, stage: Stage, folder: Path) -> Result:
    """Run a stage as users do; ends the demo with what QGIS said if it fails."""
    parameters = [f"{name}={item}" for name, value in stage.parameters_in(folder).items()
                  for item in (value if isinstance(value, list) else [value])]
    start = time.monotonic()
    quietly(process, "run", stage.algorithm, "--", *parameters)
    return Result(stage, time.monotonic() - start, stage.check(folder))


def quietly(*command: str) -> None:
    """Run a command; show what it said only if it fails."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, encoding="utf-8", errors="replace", check=False)
    if done.returncode:
        sys.exit(f"{done.stdout}\ndemo: failed: {' '.join(command)}")


def rows(results: list[Result]) -> list[tuple[str, str, str, str]]:
    """The table: a row for each figure, stage and seconds only in the first of a stage."""
    lines = []
    for result in results:
        for number, figure in enumerate(result.figures):
            first = (result.stage.title, f"{result.seconds:.1f}") if number == 0 else ("", "")
            lines.append((*first, figure.what, figure.text))
    return lines


def print_table(lines: list[tuple[str, ...]]) -> None:
    """Columns as wide as they need, numbers to the right."""
    lines = [HEADER, tuple("-" * len(name) for name in HEADER), *lines]
    stage, seconds, what, value = (max(len(line[column]) for line in lines) for column in range(4))
    for line in lines:
        print(f"{line[0]:<{stage}}  {line[1]:>{seconds}}  {line[2]:<{what}}  {line[3]:>{value}}".rstrip())


def draw_models(folder: Path) -> tuple[Path, str] | None:
    """Picture of the models by QGIS's 3D engine; None where there is neither a screen nor a virtual one."""
    target = folder / "pictures" / "models.png"
    command = [sys.executable, str(ROOT / "scripts" / "render_models.py"), str(folder / "models_surfaces.gpkg"),
               str(target), "--size", "1400x900", "--pitch", "50"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        print(f"demo: no picture of the models ({(done.stderr or done.stdout).strip().splitlines()[-1]})")
        return None
    return target, ("The building models made from the unclassified points and the loaded outlines, in QGIS's 3D view: "
                    "roofs red, walls pale.")


def write_summary(path: Path, results: list[Result], pictures: list[tuple[Path, str]], seconds: float) -> None:
    """The page that shows the demo: the table, then the pictures."""
    report = Report("UrbanMap: all stages on a sample city")
    report.paragraph("The city is simulated by urbanmap:samplecity, so the truth is known. Each stage ran through "
                     "qgis_process with default settings; its result was then compared with the truth, independently "
                     f"of what the stage reports about itself. Everything together took {seconds:.0f} s.")
    report.table(HEADER, rows(results))
    report.paragraph("Seconds are wall time with the start of QGIS. Roofs are compared every 0.5 m, 0.5 m clear of "
                     "parapets and steps; lift houses and machines on the roofs are left out, being smaller than the "
                     "least roof area. The sample city is kinder than a real one: its roofs are exactly level, and "
                     "its noise is as stated.")
    report.section("Pictures")
    for picture, caption in pictures:
        report.picture(picture, caption)
    report.write(path)


def main() -> None:
    """Run the demo."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("process", help="qgis_process")
    parser.add_argument("folder", type=Path, help="new folder for everything")
    parser.add_argument("--size", type=float, default=120.0, help="side of the city in metres (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="which city (default: %(default)s)")
    options = parser.parse_args()
    start, folder = time.monotonic(), options.folder.resolve()
    folder.mkdir(parents=True)
    quietly(options.process, "plugins", "enable", "urbanmap_qgis")
    todo, results = stages(options.size, options.seed), []
    for number, stage in enumerate(todo, 1):
        print(f"{number}/{len(todo)}  {stage.title} ({stage.algorithm}) ...", end=" ", flush=True)
        results.append(run_stage(options.process, stage, folder))
        print(f"{results[-1].seconds:.0f} s", flush=True)
    print("Pictures and project ...", flush=True)
    pictures = list(make_pictures(folder))
    models = draw_models(folder)
    quietly(sys.executable, str(ROOT / "scripts" / "demo" / "project.py"), str(folder))
    seconds = time.monotonic() - start
    write_summary(folder / "summary.html", results, [models, *pictures] if models else pictures, seconds)
    print()
    print_table(rows(results))
    print(f"\nEverything took {seconds:.0f} s. Look at the results in {folder.name}/:")
    for name, text in FILES:
        print(f"  {name:<18}{text}")


if __name__ == "__main__":
    main()
