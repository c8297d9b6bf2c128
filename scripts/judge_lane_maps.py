#!/usr/bin/env python3
"""Lane maps before programs of others: a line for each folder with map.osm (dialect lanelet2) and map.xodr.

    python3 scripts/judge_lane_maps.py CITY [CITY ...]

Lanelet2 itself and simple-lanelet2 load the file; Autoware's rules are those of `checkmodel`; ASAM's checker and
SUMO read the OpenDRIVE file. The judges are installed by `make judges`.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.core.lane_map_judges import here, judge, loaded_by, opendrive_issues  # noqa: E402
from tests.core.opendrive_reader import read_roads, widest_gap  # noqa: E402
from urbanmap_qgis.io.osm import read_osm  # noqa: E402
from urbanmap_qgis.roadmap.checks.map_check import check_map  # noqa: E402

HEADER = ("map", "lanelets", "rules", "Lanelet2 errors", "simple-lanelet2 errors", "Autoware's rules, errors",
          "ASAM errors", "SUMO errors", "widest gap, mm", "steepest, %")

STEP = 1.0
"""Grades are taken between heights so far apart, m."""


def lanelet2_row(path: Path) -> list:
    """Numbers of lanelets and rules, and of the errors of two libraries and of Autoware's rules."""
    content = read_osm(path)
    places = np.array([(node.latitude, node.longitude) for node in content.nodes.values()])
    found = [loaded_by(python, path, np.nanmean(places, axis=0)) for python in (judge("python"), here())]
    faults = sum(fault.severity == "error" for fault in check_map(content))
    return [*found[0][:2], *(len(errors) + len(invalid) for _, _, errors, invalid in found), faults]


def opendrive_row(path: Path, folder: Path) -> list:
    """Numbers of errors of ASAM's checker and of SUMO, the widest gap, mm, and the steepest grade, %."""
    done = subprocess.run([judge("netconvert"), "--opendrive-files", str(path), "-o", str(folder / "net.xml")],
                          capture_output=True, text=True, check=False)
    errors = done.stderr.count("Error") + (done.returncode != 0)
    root, roads = read_roads(path)
    return [len(opendrive_issues(path, folder)), errors, round(1000 * widest_gap(root, roads), 1), steepest(roads)]


def steepest(roads: dict) -> float:
    """The steepest grade of all roads, %."""
    worst = 0.0
    for road in roads.values():
        at = np.linspace(0.0, road.length, max(int(road.length / STEP), 1) + 1)
        worst = max(worst, float(np.abs(np.diff([road.height(s) for s in at]) / np.diff(at)).max()))
    return round(100 * worst, 1)


def main(folders: Sequence[str]) -> None:
    """Print the table."""
    if not folders:
        sys.exit(__doc__)
    print("| " + " | ".join(HEADER) + " |\n|" + "---|" * len(HEADER))
    for name in folders:
        with tempfile.TemporaryDirectory() as work:
            row = [Path(name).name, *lanelet2_row(Path(name) / "map.osm"),
                   *opendrive_row(Path(name) / "map.xodr", Path(work))]
        print("| " + " | ".join(map(str, row)) + " |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
