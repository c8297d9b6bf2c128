"""What the GNSS part makes of the sample city stays as it is (see tests/figures.py)."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.figures import stays
from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation
from urbanmap_qgis.gnss.rays.ray_lines import ray_columns, ray_lines, ray_statistics, thinned
from urbanmap_qgis.gnss.rays.tracing import WallObstacles
from urbanmap_qgis.gnss.rays.visibility import SkySettings, area_grid, gps_time_of, visibility_along, visibility_over
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.gnss.reports.report import write_adjustment_report, write_reflection_report
from urbanmap_qgis.gnss.signals.passes import load_passes
from urbanmap_qgis.gnss.walls.adjustment import adjust_walls
from urbanmap_qgis.gnss.walls.columns import adjusted_wall_columns, building_columns, wall_lines
from urbanmap_qgis.gnss.walls.residuals import trace_residuals
from urbanmap_qgis.mobile.trajectory import joined_trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.gnss import AdjustmentSettings, TraceSettings

WKT = CRS.from_epsg(6677).to_wkt()


@pytest.fixture(scope="module")
def models(small_city):
    """Outlines of the delivered models, the building of each, and the heights of their tops and feet."""
    features = json.loads((small_city / "models" / "buildings.geojson").read_text(encoding="utf-8"))["features"]
    shapes = np.array([shapely.from_geojson(json.dumps(item["geometry"])) for item in features], dtype=object)
    facts = [item["properties"] for item in features]
    return (shapes, np.array([one["building"] for one in facts]) - 1, np.array([one["z_top"] for one in facts]),
            np.array([one["z_base"] for one in facts]))


@pytest.fixture(scope="module")
def drives(small_city):
    """Files of the passes and their trajectories."""
    files = sorted((small_city / "gnss").glob("pass_*.obs"))
    places = [path.with_name(f"{path.stem}_trajectory.csv") for path in files]
    return files, [read_trajectory(path).trajectory for path in places]


@pytest.fixture(scope="module")
def signals(small_city, drives):
    files, trajectories = drives
    return load_passes(files, [small_city / "gnss" / "satellites.nav"], trajectories, [path.name for path in files],
                       WKT)


def page(path) -> str:
    return path.read_text(encoding="utf-8")


@pytest.mark.slow
def test_signals_stay(signals):
    stays("gnss_signals", signals)


def test_reflections_stay(signals, models, tmp_path):
    walls = building_walls(*models)
    paths, corrected = trace_residuals(walls, signals, TraceSettings())
    figures = ray_statistics(signals, paths, corrected)
    rows = thinned(signals, 30.0)
    write_reflection_report(tmp_path / "report.html", signals, paths, corrected, figures)
    names = np.array([str(number) for number in range(models[1].max() + 1)], object)
    stays("gnss_reflections", {
        "walls": walls, "figures": figures, "paths": paths, "residuals": corrected,
        "report": page(tmp_path / "report.html"),
        "columns": ray_columns(walls, names, signals, paths, corrected, rows),
        "lines": list(ray_lines(signals, paths, rows, 50.0))})


@pytest.mark.slow
def test_adjusted_walls_stay(signals, models, tmp_path):
    shapes, building, top, base = models
    made = adjust_walls(shapes, building, signals, top, base, AdjustmentSettings())
    names = np.array([str(number) for number in range(building.max() + 1)], object)
    write_adjustment_report(tmp_path / "report.html", signals, made, names, shapes)
    stays("gnss_adjusted_walls", {
        "walls": made.walls, "shapes": list(made.shapes), "columns": adjusted_wall_columns(made, names),
        "buildings": building_columns(made, building), "lines": list(wall_lines(made, signals)),
        "report": page(tmp_path / "report.html")})


@pytest.mark.slow
def test_visible_satellites_stay(small_city, models, drives):
    walls = building_walls(*models)
    obstacles, sky = WallObstacles.of(walls), SkySettings()
    navigation = read_navigation([small_city / "gnss" / "satellites.nav"])
    trajectory = joined_trajectory(drives[1], [path.name for path in drives[0]])
    along = visibility_along(obstacles, navigation, trajectory, WKT, sky, (0.0, 0.0, -1.8), 10.0)
    grid = area_grid(tuple(shapely.total_bounds(models[0])), 5.0)
    time = gps_time_of("2024-04-18T03:00:00")
    over = visibility_over(obstacles, navigation, grid, np.full(grid.shape, 1.5), time, WKT, sky)
    stays("gnss_visibility", {"along": along, "over": over})
