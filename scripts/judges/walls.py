"""Walls adjusted by GNSS reflections against the truth, by city and kind of day.

Days: `usual`, the ionosphere as the satellites broadcast it; `maximum`, a day of the solar maximum (2.5 times as much
as broadcast, larger towards the south, single satellites off by 0.6 m in the zenith) with a receiver of one band;
`two`, the same day with a receiver of two bands. Prints, for each city and all together: walls with observations,
adjusted, RMSE (m), adjusted or likely, RMSE, share within two sigma, largest error, CPU seconds.
"""

from __future__ import annotations

import csv
import json
import tempfile
import time
from pathlib import Path

import numpy as np
import shapely
from pyproj import CRS

from urbanmap_qgis.gnss.signals.passes import load_passes
from urbanmap_qgis.gnss.walls.adjustment import ADJUSTED, Adjustment, adjust_walls
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.samplecity.gnss.signals import Sky
from urbanmap_qgis.samplecity.gnss.stage import write_gnss
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.settings.gnss import AdjustmentSettings

WKT = CRS.from_epsg(6677).to_wkt()
DAYS = {"usual": Sky(), "maximum": Sky(False, 2.5, 0.3, 0.6), "two": Sky(True, 2.5, 0.3, 0.6)}
NEAR = 0.3  # m between the middles of a wall of the models and of the truth's row for it


def adjusted(folder: Path, passes: int) -> Adjustment:
    """The walls of a city, adjusted by its first passes."""
    features = json.loads((folder / "models" / "buildings.geojson").read_text(encoding="utf-8"))["features"]
    shapes = np.array([shapely.from_geojson(json.dumps(item["geometry"])) for item in features], dtype=object)
    facts = [item["properties"] for item in features]
    files = sorted((folder / "gnss").glob("pass_*.obs"))[:passes]
    trajectories = [read_trajectory(path.with_name(f"{path.stem}_trajectory.csv")).trajectory for path in files]
    signals = load_passes(files, [folder / "gnss" / "satellites.nav"], trajectories, [path.name for path in files], WKT)
    return adjust_walls(shapes, np.array([one["building"] for one in facts]) - 1, signals,
                        np.array([one["z_top"] for one in facts]), np.array([one["z_base"] for one in facts]),
                        AdjustmentSettings())


def errors(folder: Path, found: Adjustment) -> np.ndarray:
    """(k,) estimated less true offset of each wall, m; NaN where it has no observations or no true wall is near."""
    with open(folder / "truth" / "wall_offsets.csv") as file:
        rows = list(csv.DictReader(file))
    ends = np.array([[float(row[name]) for name in ("x0", "y0", "x1", "y1")] for row in rows])
    true = np.array([float(row["offset"]) for row in rows])
    middle = (ends[:, :2] + ends[:, 2:]) / 2
    table = found.walls.table
    own = (table.start + table.end) / 2
    away = np.hypot(*(own[:, None] - middle[None]).transpose(2, 0, 1))
    nearest = away.argmin(axis=1)
    return np.where(away.min(axis=1) < NEAR, found.walls.offset - true[nearest], np.nan)


def row(name: str, error: np.ndarray, sigma: np.ndarray, status: np.ndarray, moved: np.ndarray, cpu: float) -> str:
    """A line of the table."""
    known = np.isfinite(error)
    sure, all_moved = known & (status == ADJUSTED), known & moved
    rms = [float(np.sqrt(np.mean(error[rows] ** 2))) if rows.any() else float("nan") for rows in (sure, all_moved)]
    within = float(np.mean(np.abs(error[all_moved]) < 2 * sigma[all_moved])) if all_moved.any() else float("nan")
    largest = float(np.abs(error[all_moved]).max()) if all_moved.any() else float("nan")
    return (f"{name:24s} {known.sum():5d} {sure.sum():5d} {rms[0]:6.3f} {all_moved.sum():5d} {rms[1]:6.3f} "
            f"{100 * within:5.0f} % {largest:6.2f} {cpu:7.1f}")


def judge(seeds: tuple[int, ...] = (41, 45), days: tuple[str, ...] = tuple(DAYS), scene: str = "canyon",
          passes: int = 16, size: float = 200.0) -> None:
    """Print the table."""
    print(f"{'city':24s} walls  adj.   RMSE moved   RMSE  2 sigma largest  CPU s")
    for day in days:
        parts = []
        for seed in seeds:
            with tempfile.TemporaryDirectory() as work:
                folder = Path(work)
                write_gnss(make_scene(size, scene, seed), folder, np.random.SeedSequence(seed),
                           day=DAYS[day])
                start = time.process_time()
                found = adjusted(folder, passes)
                cpu = time.process_time() - start
                walls = found.walls
                parts.append((errors(folder, found), walls.sigma, walls.status, walls.is_moved, cpu))
            print(row(f"{scene} {seed} {day}", *parts[-1]), flush=True)
        together = [np.concatenate([np.atleast_1d(part[k]) for part in parts]) for k in range(4)]
        print(row(f"all {day}", *together, sum(part[4] for part in parts)), flush=True)
