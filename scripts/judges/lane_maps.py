"""Lane maps before programs of others: a line for each folder with map.osm (dialect lanelet2) and map.xodr.

Lanelet2 itself and simple-lanelet2 load the file; Autoware's rules are those of `checkmodel`; ASAM's checker and
SUMO read the OpenDRIVE file. The other programs are installed by `make judges`.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from scripts.bench_table import print_table
from tests.core import lane_map_judges as programs
from tests.core.opendrive_reader import read_roads, widest_gap
from urbanmap_qgis.io.osm import read_osm
from urbanmap_qgis.roadmap.checks.map_check import check_map

HEADER = ("map", "lanelets", "rules", "Lanelet2 errors", "simple-lanelet2 errors", "Autoware's rules, errors",
          "ASAM errors", "SUMO errors", "widest gap, mm", "steepest, %")

STEP = 1.0
"""Grades are taken between heights so far apart, m."""


def lanelet2_row(path: Path) -> list:
    """Numbers of lanelets and rules, and of the errors of two libraries and of Autoware's rules."""
    content = read_osm(path)
    places = np.array([(node.latitude, node.longitude) for node in content.nodes.values()])
    found = [programs.loaded_by(python, path, np.nanmean(places, axis=0))
             for python in (programs.judge("python"), programs.here())]
    faults = sum(fault.severity == "error" for fault in check_map(content))
    return [*found[0][:2], *(len(errors) + len(invalid) for _, _, errors, invalid in found), faults]


def opendrive_row(path: Path, folder: Path) -> list:
    """Numbers of errors of ASAM's checker and of SUMO, the widest gap, mm, and the steepest grade, %."""
    done = subprocess.run([programs.judge("netconvert"), "--opendrive-files", str(path), "-o", str(folder / "net.xml")],
                          capture_output=True, text=True, check=False)
    errors = done.stderr.count("Error") + (done.returncode != 0)
    root, roads = read_roads(path)
    issues = programs.opendrive_issues(path, folder)
    return [len(issues), errors, round(1000 * widest_gap(root, roads), 1), steepest(roads)]


def steepest(roads: dict) -> float:
    """The steepest grade of all roads, %."""
    worst = 0.0
    for road in roads.values():
        at = np.linspace(0.0, road.length, max(int(road.length / STEP), 1) + 1)
        worst = max(worst, float(np.abs(np.diff([road.height(s) for s in at]) / np.diff(at)).max()))
    return round(100 * worst, 1)


def judge(folders: tuple[Path, ...]) -> None:
    """Print the table."""
    rows = []
    for folder in folders:
        with tempfile.TemporaryDirectory() as work:
            rows.append([folder.name, *lanelet2_row(folder / "map.osm"),
                         *opendrive_row(folder / "map.xodr", Path(work))])
    print_table("Lane maps before other programs", HEADER, rows)
