"""Places along roads, along a drive or over an area, with the direction of travel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.grid import Grid
from ...geometry.tolerances import SAME_PLACE
from ...wording import say

MOST_PLACES = 2_000_000

_NO = {"", "no", "none", "null", "0", "0.0", "false", "f", "n"}


@dataclass(frozen=True)
class RoadPlaces:
    """n places on the road.

    Attributes
    ----------
    place : (n, 3) m; the height is that of the road, NaN where nothing tells it.
    heading : (n,) radians clockwise from grid north.
    street : (n,) row of the road or number of the drive.
    way : (n,) m from its beginning.
    step : (n,) m of road that the place stands for.
    tunnel : (n,) whether the road says that it runs in a tunnel.
    time : (n,) of a drive, s; NaN on roads.
    ground : (n,) m, height of a ground raster; NaN where not known.
    """

    place: np.ndarray
    heading: np.ndarray
    street: np.ndarray
    way: np.ndarray
    step: np.ndarray
    tunnel: np.ndarray
    time: np.ndarray
    ground: np.ndarray

    def __len__(self) -> int:
        return len(self.heading)

    @property
    def of_an_area(self) -> bool:
        """Whether the places fill an area: they lie along no road."""
        return len(self) > 1 and not self.way.any() and not self.street.any()

    def select(self, rows: np.ndarray | slice) -> RoadPlaces:
        """Some of them."""
        return RoadPlaces(*(getattr(self, name)[rows] for name in RoadPlaces.__dataclass_fields__))

    def with_heights(self, heights: np.ndarray) -> RoadPlaces:
        """The same places at heights (n,), m, of the road."""
        return replace(self, place=np.column_stack([self.place[:, :2], heights]))


def places_on_roads(lines: Sequence[shapely.Geometry | None], spacing: float,
                    tunnel: np.ndarray | None = None) -> RoadPlaces:
    """Places every `spacing` m along lines (LineString or MultiLineString), in the direction in which they are drawn.

    Raises
    ------
    InputError : no line has a length, or there would be too many places.
    """
    parts = []
    for row, line in enumerate(lines):
        if line is None or line.is_empty:
            continue
        within = bool(tunnel[row]) if tunnel is not None else False
        done = 0.0
        for part in shapely.get_parts(shapely.line_merge(line)):
            points = shapely.get_coordinates(part, include_z=True)
            road = _on_path(points, spacing, row, within, done)
            done += road.step.sum()
            parts.append(road)
        if sum(map(len, parts)) > MOST_PLACES:
            raise InputError(say("More than {most_places:,} places: choose a larger spacing or fewer roads.",
                                 most_places=MOST_PLACES))
    parts = [part for part in parts if len(part)]
    if not parts:
        raise InputError(say("The roads have no length: give lines along which vehicles drive."))
    return _joined_places(parts)


def places_on_drive(place: np.ndarray, time: np.ndarray, spacing: float, street: int = 0) -> RoadPlaces:
    """Places every `spacing` m along a drive (m, 3) at times (m,); standing adds none."""
    places = _on_path(place, spacing, street, False, 0.0)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(place[:, :2], axis=0).T))])
    return replace(places, time=np.interp(places.way, way, time))


def places_on_grid(grid: Grid, heights: np.ndarray | None = None) -> RoadPlaces:
    """The centres of a grid's cells, row by row, heading north; `heights` (rows, columns), m, of the ground."""
    x, y = (values.ravel() for values in np.meshgrid(*grid.centres()))
    z = np.full(len(x), np.nan) if heights is None else heights.ravel()
    zero = np.zeros(len(x))
    return RoadPlaces(np.column_stack([x, y, z]), zero, zero.astype(np.int64), zero, np.full(len(x), grid.cell),
                      zero > 0, np.full(len(x), np.nan), np.full(len(x), np.nan))


def joined_places(parts: Sequence[RoadPlaces]) -> RoadPlaces:
    """Several drives as one list of places.

    Raises
    ------
    InputError : none of them has a place.
    """
    if not sum(map(len, parts)):
        raise InputError(say("The trajectory does not move: give that of a drive."))
    return _joined_places(parts)


def _joined_places(parts: Sequence[RoadPlaces]) -> RoadPlaces:
    return RoadPlaces(*(np.concatenate([getattr(part, name) for part in parts])
                        for name in RoadPlaces.__dataclass_fields__))


def _on_path(points: np.ndarray, spacing: float, street: int, tunnel: bool, begin: float) -> RoadPlaces:
    """Places on one path (m, 2 or 3) at the middles of equal steps of about `spacing` m."""
    edge = np.diff(points[:, :2], axis=0)
    length = np.hypot(edge[:, 0], edge[:, 1])
    distinct = length > SAME_PLACE
    nodes = points[np.concatenate([[True], distinct])]
    way = np.concatenate([[0.0], np.cumsum(length[distinct])])
    total = way[-1]
    count = max(round(total / spacing), 1) if total > 0 else 0
    step = total / max(count, 1)
    at = (np.arange(count) + 0.5) * step
    place = np.column_stack([np.interp(at, way, nodes[:, axis]) for axis in range(3)]) if count else np.zeros((0, 3))
    # The direction over a step, so that a noisy path does not turn the vehicle.
    before, after = ([np.interp(np.clip(at + half, 0, total), way, nodes[:, axis]) for axis in range(2)]
                     for half in (-max(step, 1.0) / 2, max(step, 1.0) / 2)) if count else ([[], []], [[], []])
    heading = np.arctan2(np.subtract(after[0], before[0]), np.subtract(after[1], before[1]))
    return RoadPlaces(place, heading, np.full(count, street, np.int64), begin + at, np.full(count, step),
                      np.full(count, tunnel), np.full(count, np.nan), np.full(count, np.nan))


def tunnels(columns: Mapping[str, Sequence], count: int) -> np.ndarray:
    """(count,) whether roads run in a tunnel, by a field `tunnel` of their columns, as OpenStreetMap has it."""
    field = next((values for name, values in columns.items() if name.lower() == "tunnel"), None)
    if field is None:
        return np.zeros(count, bool)
    return np.array([str(value).strip().lower() not in _NO for value in field])
