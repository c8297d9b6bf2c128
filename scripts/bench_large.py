"""Table of large made roofs (halls with sheds, a stadium, a patchwork of planes): part of `make bench`."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import shapely
from scipy.spatial import cKDTree

from scripts.bench_table import print_table
from urbanmap_qgis.buildings.building_model import FitPoints, RoofInput, model_building
from urbanmap_qgis.buildings.planes.plane_segmentation import segment_planes
from urbanmap_qgis.buildings.roof_polygons.building_polygons import roof_polygons_of
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import RoofedBuilding
from urbanmap_qgis.settings.buildings import PLANES, PlaneParameters, PolygonParameters

SEED = 2029
GROUND = 2.0
HEADER = ("roof", "area (m2)", "points", "planes", "roof polygons", "status", "RMSE z 95 % (m)", "CPU s")


def sheds(x: np.ndarray, y: np.ndarray, _rng: np.random.Generator, _side: float) -> np.ndarray:
    """Sheds of 6 m, turned by 17 degrees."""
    return 10.0 + (np.cos(0.3) * x + np.sin(0.3) * y) % 6.0 * 0.4


def stadium(x: np.ndarray, y: np.ndarray, _rng: np.random.Generator, side: float) -> np.ndarray:
    """A bowl of 24 fields, every other one 0.8 m higher."""
    x, y = x - side / 2, y - side / 2
    return 12.0 + 0.15 * np.hypot(x, y) + 0.8 * (np.round(np.arctan2(y, x) * 12 / np.pi) % 2)


def patchwork(x: np.ndarray, y: np.ndarray, rng: np.random.Generator, side: float) -> np.ndarray:
    """A plane of its own slope for every 25 m2."""
    count = int(side**2 / 25)
    centre, slope = rng.uniform(0, side, (count, 2)), rng.uniform(-0.6, 0.6, (count, 2))
    own = cKDTree(centre).query(np.column_stack([x, y]))[1]
    away = np.column_stack([x, y]) - centre[own]
    return rng.uniform(20, 26, count)[own] + (away * slope[own]).sum(axis=1)


def large_roofs_table() -> None:
    """Time, faces and fit of each shape at three sizes."""
    rows = [_row(shape, area, density) for shape in (sheds, stadium, patchwork)
            for area, density in ((1_000.0, 10.0), (6_000.0, 10.0), (16_000.0, 10.0))]
    print_table(f"Large made roofs, seed {SEED}", HEADER, [*rows, _row(sheds, 16_000.0, 62.0)])


def _row(shape: Callable, area: float, density: float) -> tuple:
    """Figures of one roof, as `HEADER` has them."""
    rng, side = np.random.default_rng(SEED), area**0.5
    xy = rng.uniform(0, side, (int(area * density), 2))
    points = np.column_stack([xy, shape(*xy.T, rng, side) + rng.normal(0, 0.03, len(xy))])
    outline = shapely.box(0, 0, side, side)
    start = time.process_time()
    found = segment_planes(*points.T, outline, GROUND, density, PlaneParameters(), 2.0)
    roof = found.roof_of_point.astype(np.int64)
    table = roof_polygons_of(RoofedBuilding(1, outline, points, roof), PolygonParameters(roofs=PLANES))
    roofs = RoofInput(np.array(table.polygon, object), np.array(table.building_id), np.array(table.roof_id),
                      np.array(table.height), np.array(table.status, object))
    model = model_building(1, outline, "", roofs, GROUND, FitPoints(points, roof), True)
    seconds = time.process_time() - start
    return (shape.__name__, area, len(points), len(found.rows), len(table.polygon), model.status,
            model.fit.rmse_z95 if model.fit else float("nan"), seconds)


if __name__ == "__main__":
    large_roofs_table()
