"""Profiles at all stations of the courses, tile by tile: passes fitted apart and combined by their sigma."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .edge_points import EdgeTile
from .edge_records import Course
from .profile import FAR_REACH, HALF_LENGTH, Profile, fit_edge_profile

_CHANCE = 3.0  # misfit of a degree of freedom that may be chance
_LOPSIDED = 0.1  # share of the points; with less on one side of it along, a station lies beyond the edge's end


@dataclass
class Stations:
    """What was measured at the stations of all courses, in arrays; NaN where nothing was.

    Attributes
    ----------
    course : (n,) number of the course.
    place, normal : (n, 2).
    seen : (n,).
    foot, top : (n,) m across from the station.
    z_foot, z_top, sigma, sigma_z : (n,) m.
    points, passes : (n,).
    """

    course: np.ndarray
    place: np.ndarray
    normal: np.ndarray
    seen: np.ndarray
    foot: np.ndarray
    top: np.ndarray
    z_foot: np.ndarray
    z_top: np.ndarray
    sigma: np.ndarray
    sigma_z: np.ndarray
    points: np.ndarray
    passes: np.ndarray

    @classmethod
    def of(cls, courses: list[Course]) -> Stations:
        """Stations of the courses, nothing measured."""
        number = sum(len(course.seen) for course in courses)
        empty = [np.full(number, np.nan) for _ in range(6)]
        return cls(np.repeat(np.arange(len(courses)), [len(course.seen) for course in courses]),
                   np.concatenate([np.zeros((0, 2)), *(course.place for course in courses)]),
                   np.concatenate([np.zeros((0, 2)), *(course.normal for course in courses)]),
                   np.concatenate([np.zeros(0, bool), *(course.seen for course in courses)]),
                   *empty, np.zeros(number, np.int64), np.zeros(number, np.int64))

    @property
    def height(self) -> np.ndarray:
        """(n,) m, of the step."""
        return self.z_top - self.z_foot


def measure_stations(stations: Stations, tile: EdgeTile, near_ground: np.ndarray) -> None:
    """Fit the profiles of the stations that belong to a tile and put them into `stations`.

    Parameters
    ----------
    near_ground : (n,) which of the tile's points lie at the ground or a kerb's height above it.
    """
    mine = np.flatnonzero(tile.owns(stations.place))
    if not len(mine):
        return
    points = tile.points[near_ground]
    place = np.column_stack([points["x"], points["y"]])
    if not len(place):
        return
    around = cKDTree(place).query_ball_point(stations.place[mine], FAR_REACH + HALF_LENGTH)
    for row, rows in zip(mine.tolist(), around):
        rows = np.array(rows, int)
        offset = place[rows] - stations.place[row]
        normal = stations.normal[row]
        along = offset @ np.array([-normal[1], normal[0]])
        close = np.abs(along) <= HALF_LENGTH
        rows, across = rows[close], (offset @ normal)[close]
        ahead = float(np.mean(along[close] > 0)) if len(rows) else 0.0
        if not _LOPSIDED < ahead < 1.0 - _LOPSIDED:
            continue
        fits = []
        for drive in np.unique(points["drive"][rows]).tolist():
            of_drive = points["drive"][rows] == drive
            fits.append(fit_edge_profile(across[of_drive], points["z"][rows][of_drive]))
        _put(stations, row, [fit for fit in fits if fit is not None])


def _put(stations: Stations, row: int, fits: list[Profile]) -> None:
    """Store the profiles of several passes at one station as one."""
    if not fits:
        return
    placed = [fit for fit in fits if np.isfinite(fit.sigma)] or fits
    weight = np.array([1.0 / fit.sigma**2 if np.isfinite(fit.sigma) else 1.0 for fit in placed])
    weight_z = np.array([1.0 / fit.sigma_z**2 for fit in placed])
    for name in ("foot", "top"):
        getattr(stations, name)[row] = np.average([getattr(fit, name) for fit in placed], weights=weight)
    for name in ("z_foot", "z_top"):
        getattr(stations, name)[row] = np.average([getattr(fit, name) for fit in placed], weights=weight_z)
    middles = np.array([0.5 * (fit.foot + fit.top) for fit in placed])
    tops = np.array([fit.z_top for fit in placed])
    if np.isfinite(placed[0].sigma):
        stations.sigma[row] = _combined(middles, weight)
    stations.sigma_z[row] = _combined(tops, weight_z)
    stations.points[row] = sum(fit.points for fit in placed)
    stations.passes[row] = len(placed)


def _combined(values: np.ndarray, weight: np.ndarray) -> float:
    """Standard deviation of a weighted mean, larger where the values contradict each other."""
    mean = np.average(values, weights=weight)
    misfit = float((weight * (values - mean)**2).sum()) / max(len(values) - 1, 1)
    return float(np.sqrt(max(misfit / _CHANCE, 1.0) / weight.sum()))
