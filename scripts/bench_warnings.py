"""How often runs on sound data warn: a part of `make bench`, where QGIS is installed.

All stages of the demo and some more runs are made on sample cities without faults, as a user runs them. Nothing is
wrong with their data, so that every warning (and every refusal) is a false alarm.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections import Counter, defaultdict
from collections.abc import Sequence
from pathlib import Path

from scripts.bench_table import print_table
from scripts.demo.stages import CITY, OUTLINES, Stage, stages

LAUNCHER = Path(__file__).with_name("urbanmap")
SURVEYS = [CITY / f"mms/survey_0{number}.laz" for number in (1, 2)]
DRIVES = [CITY / f"mms/survey_0{number}_trajectory.csv" for number in (1, 2)]
MORE = (
    Stage("Road markings from the orthophoto", "urbanmap:roadmarkingsfromorthophoto",
          {"INPUT": CITY / "aerial/ortho.tif", "BUILDINGS": OUTLINES, "OUTPUT": Path("painted.tif")}, list),
    Stage("Ground of a mobile survey", "urbanmap:groundfrommms",
          {"POINTS": SURVEYS[0], "OUTPUT": Path("mobile_ground.laz")}, list),
    Stage("Adjusted drives", "urbanmap:adjustsurveys",
          {"POINTS": SURVEYS, "TRAJECTORY": DRIVES, "CALIBRATION": CITY / "mms/calibration.json",
           "MARKINGS": Path("markings.tif"), "GROUND": Path("ground.tif"), "OUTPUT": Path("drives")}, list))
"""Runs that the demo has not."""

SIZE, SEEDS = 80.0, (11, 12, 13, 14, 15, 16)
ALLOWED = 0.05
"""Share of runs that may warn of sound data."""


def said_by(stage: Stage, folder: Path) -> list[str]:
    """Warnings of a stage's run in a folder, each once, numbers as #; of a run that failed, its error."""
    words = [f"{name}={item}" for name, value in stage.parameters_in(folder).items()
             for item in (value if isinstance(value, list) else [value])]
    done = subprocess.run([LAUNCHER, stage.algorithm.partition(":")[2], *words], capture_output=True, text=True,
                          check=False)
    lines = re.findall(r"^\.*WARNING:\t(.*)", done.stdout, re.MULTILINE)
    if done.returncode:
        lines.append(f"failed: {(done.stderr.strip().splitlines() or ['?'])[-1]}")
    return list(dict.fromkeys(re.sub(r"\d[\d.,]*", "#", line) for line in lines))


def warnings_table(size: float = SIZE, seeds: Sequence[int] = SEEDS) -> None:
    """Print how many runs of each stage warned of sound data, and of what."""
    warned: Counter[str] = Counter()
    said: dict[str, Counter[str]] = defaultdict(Counter)
    for seed in seeds:
        with tempfile.TemporaryDirectory() as folder:
            for stage in (*stages(size, seed), *MORE):
                lines = said_by(stage, Path(folder))
                warned[stage.title] += bool(lines)
                said[stage.title].update(lines)
    runs = len(said) * len(seeds)
    print_table(f"False alarms, {len(seeds)} sample cities of {size:g} m: {sum(warned.values())} of {runs} runs, "
                f"{ALLOWED:.0%} allowed", ("stage", "runs that warn", "of what (runs)"),
                [(title, warned[title], " / ".join(f"{line} ({count})" for line, count in lines.items()))
                 for title, lines in said.items()])
