"""The map of localisation accuracy as columns of a layer and as a raster."""

from __future__ import annotations

import numpy as np

from ...geometry.grid import Grid
from ...gnss.orbits.ephemeris import Navigation
from ...io.raster import RasterSampler
from ..accuracy_records import SOURCES, AccuracyMap
from ..places.place_status import GOOD, NONE, POOR, USABLE
from ..places.road_places import RoadPlaces

CLASS_NUMBERS = {GOOD: 1.0, USABLE: 2.0, POOR: 3.0, NONE: 4.0}
"""The classes in order, with numbers."""

_TIMES = 6


def accuracy_columns(accuracy: AccuracyMap) -> dict[str, np.ndarray]:
    """Columns of the layer of places, by name."""
    columns = {"street": accuracy.places.street, "way": accuracy.places.way, "class": accuracy.kind,
               "status": accuracy.status, "heading": np.degrees(accuracy.places.heading) % 360.0}
    for name in SOURCES:
        for number, part in enumerate(("along", "across", "heading")):
            columns[_field(part, name)] = accuracy.sigma[name][:, number]
    return columns | {
        "major": accuracy.ellipse.major, "minor": accuracy.ellipse.minor, "weakest": accuracy.ellipse.bearing,
        "undetermined": accuracy.undetermined, "elsewhere": accuracy.elsewhere,
        "alias_share": accuracy.alias_share, "alias_distance": np.hypot(*accuracy.alias_shift.T),
        "alias_bearing": np.degrees(np.arctan2(*accuracy.alias_shift.T)) % 360.0, "points": accuracy.points,
        "n_walls": accuracy.walls, "horizon": accuracy.covered, "sky": accuracy.sky_covered,
        "cell_rms": accuracy.cell_rms, "two_surfaces": accuracy.two_surfaces,
        "satellites": accuracy.satellites, "pdop": accuracy.dilution}


def _field(part: str, source: str) -> str:
    return f"sigma_{part}" if source == "together" else f"{part}_{source}"


def accuracy_raster(accuracy: AccuracyMap, cell: float) -> tuple[np.ndarray, Grid]:
    """Sigma of the weakest direction (rows, columns), m, in cells of `cell` m: the worst place of each; NaN without."""
    x, y = accuracy.places.place[:, 0], accuracy.places.place[:, 1]
    grid = Grid.covering(x.min(), y.min(), x.max(), y.max(), cell)
    raster = np.full(grid.shape, -np.inf, np.float32)
    row, column, _ = grid.cells(x, y)
    known = np.isfinite(accuracy.ellipse.major)
    np.maximum.at(raster, (row[known], column[known]), accuracy.ellipse.major[known].astype(np.float32))
    return np.where(np.isfinite(raster), raster, np.nan).astype(np.float32), grid


def lengths_by_class(accuracy: AccuracyMap) -> dict[str, float]:
    """Length of road of each class, m."""
    return {name: float(accuracy.places.step[accuracy.kind == name].sum()) for name in CLASS_NUMBERS}


def ground_under_places(ground: RasterSampler, places: RoadPlaces) -> np.ndarray:
    """(n,) heights of the ground at places, m, NaN beside the raster."""
    return ground.sample(places.place[:, 0], places.place[:, 1])


def times_of_day(navigation: Navigation) -> np.ndarray:
    """Six times spread over the hours of navigation files, GPS seconds."""
    first, last = navigation.spans()[0]
    return first + (np.arange(_TIMES) + 0.5) / _TIMES * (last - first)
