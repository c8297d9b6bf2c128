"""J 5.3, 5.6 and 5.7 and Z 3 on a sample city: each chain to the letter (METHOD=paper) and as it is by default.

The algorithms run as a user runs them, through `scripts/urbanmap`; their results are measured against the truth of the
city by the checks of the demo.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path

from scripts.bench_table import Table
from scripts.demo.stages import OUTLINES, Stage, stages

LAUNCHER = Path(__file__).resolve().parents[1] / "urbanmap"
BUILDINGS = ("Buildings from unclassified ALS", "Buildings from classified ALS")
BUILDING_WAYS = (("J to the letter", {"METHOD": "paper"}), ("level roofs", {"ROOFS": "levels"}), ("sloped roofs", {}))
LINE_WAYS = (("Z to the letter", {"METHOD": "paper"}), ("by default", {}))
WALLS = "Walls adjusted by GNSS reflections"


def building_tables(city: Path) -> list[Table]:
    """J 5.3: models against true roofs and outlines."""
    with _folder(city) as folder:
        _run(_stage("Load GSI buildings"), folder)
        return [_table(f"J 5.3: {title.lower()}", title, BUILDING_WAYS, folder) for title in BUILDINGS]


def line_tables(city: Path) -> list[Table]:
    """Z 3: the rectified trajectory of the line scanners."""
    with _folder(city) as folder:
        _run(_stage("Surface and ground from ALS"), folder)
        return [_table("Z 3: rectified trajectory", "Rectified trajectory of the line scanners", LINE_WAYS, folder)]


def wall_tables(city: Path) -> list[Table]:
    """J 5.6: walls moved by GNSS reflections. J gives no equation for it: there is one way."""
    with _folder(city) as folder:
        return [_table("J 5.6: walls", WALLS, (("this program", {}),), folder)]


def _table(heading: str, title: str, ways: tuple[tuple[str, Mapping[str, str]], ...], folder: Path) -> Table:
    """A row a way, a column a figure of the demo's check."""
    header, rows = ("way",), []
    for name, options in ways:
        stage = _stage(title)
        problem = _run(stage, folder, options)
        figures = [] if problem else stage.check(folder)
        header = max(header, ("way", *(figure.what for figure in figures)), key=len)
        rows.append((name, *(figure.text for figure in figures)) if figures else (name, problem))
    return Table(heading, header, [(*row, *[""] * (len(header) - len(row))) for row in rows])


def _stage(title: str) -> Stage:
    return next(stage for stage in stages(0, 0) if stage.title == title)


@contextmanager
def _folder(city: Path):
    """A scratch folder with the city in it, as the demo has it."""
    if not (city / "footprints").is_dir() or not (city / "truth").is_dir():
        raise SystemExit(f"{city} is no sample city: make one with scripts/urbanmap samplecity.")
    with tempfile.TemporaryDirectory() as name:
        os.symlink(city.resolve(), Path(name) / "city")
        yield Path(name)


def _run(stage: Stage, folder: Path, options: Mapping[str, str] | None = None) -> str:
    """Run a stage; what it said if it failed, "" if it did not."""
    given = {**stage.parameters_in(folder), **(options or {})}
    words = [f"{name}={item}" for name, value in given.items()
             for item in (value if isinstance(value, list) else [value])]
    done = subprocess.run([LAUNCHER, stage.algorithm.partition(":")[2], *words], capture_output=True, text=True,
                          check=False)
    if done.returncode == 0:
        return ""
    if stage.parameters.get("OUTPUT_BUILDINGS") == OUTLINES:
        raise SystemExit(done.stderr)
    return next((line for line in reversed(done.stderr.splitlines()) if line.strip()), "failed")
