"""How many satellites are in line of sight among buildings: along a trajectory, or over an area (J figure 3-20)."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timezone

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...geometry.grid import Grid
from ...mobile.trajectory import Trajectory, body_to_map
from ...progress import SILENT, Progress
from ...wording import say
from ..orbits.earth_fixed import MapFrame, directions
from ..orbits.ephemeris import Navigation, sky_at
from ..rinex.gnss_time import calendar_seconds, calendar_text, spans_text, to_gps
from ..signals.observations import trajectory_shift, within_trajectory
from ..signals.tables import SYSTEM_NAMES
from .tracing import WallObstacles
from .wall_faces import WallPieces

SKY_STEP = 10.0
"""Satellites are placed anew after so many seconds, in which they move by less than 0.1 degree."""

_RAYS = 25_000
_LARGEST_GRID = 1_000_000
_WORST_PDOP = 999.0


@dataclass(frozen=True)
class SkySettings:
    """Which satellites are counted.

    Parameters
    ----------
    systems : letters of the systems.
    elevation_mask : degrees.
    max_gap : of a trajectory, s; places in longer ones are left out.
    """

    systems: str = "GRECJ"
    elevation_mask: float = 10.0
    max_gap: float = 5.0


@dataclass(frozen=True)
class Visibility:
    """Satellites in line of sight of n places.

    Attributes
    ----------
    satellites : (n,) number in line of sight; NaN where the place is inside a building.
    by_system : the same for each system by its letter.
    above : (n,) number above the elevation mask, with and without line of sight.
    pdop : (n,) dilution of precision of the position, a clock for each system; NaN where the satellites in line of
        sight do not fix a position.
    names : all satellites that were above the mask somewhere.
    """

    satellites: np.ndarray
    by_system: dict[str, np.ndarray]
    above: np.ndarray
    pdop: np.ndarray
    names: tuple[str, ...]


def visible_satellites(obstacles: WallObstacles, navigation: Navigation, place: np.ndarray, gps_time: np.ndarray,
                       crs_wkt: str, systems: str = "GRECJ", elevation_mask: float = 10.0,
                       progress: Progress = SILENT) -> Visibility:
    """Count the satellites in line of sight.

    Parameters
    ----------
    place : (n, 3) antennas, east, north, height in the CRS and heights of the buildings, m.
    gps_time : (n,) seconds since 1980-01-06 in GPS time, or one time for all.
    systems : letters of the systems to count.
    elevation_mask : degrees.

    Raises
    ------
    InsufficientDataError : at some time no satellite has an ephemeris.
    """
    place = np.asarray(place, float)
    step = np.round(np.broadcast_to(np.asarray(gps_time, float), len(place)) / SKY_STEP).astype(np.int64)
    names = [name for name in systems if name in SYSTEM_NAMES]
    table = np.full((len(place), len(names) + 2), np.nan)
    above = np.zeros(len(place), int)
    seen: set[str] = set()
    frame = MapFrame(crs_wkt)
    order = np.argsort(step, kind="stable")
    times, first = np.unique(step[order], return_index=True)
    done = 0
    for time, rows in zip(times, np.split(order, first[1:])):
        satellites, direction = satellites_above(navigation, frame, place[rows[len(rows) // 2]], time * SKY_STEP,
                                                 systems, elevation_mask)
        seen.update(satellites.tolist())
        above[rows] = len(satellites)
        width = max(_RAYS // max(len(satellites), 3), 1)
        for low in range(0, len(rows), width):
            some = rows[low:low + width]
            table[some] = _counted(obstacles, place[some], satellites.astype("U1"), direction, names)
            done += len(some)
            progress.step(done / len(place))
    by_system = {name: table[:, k + 2] for k, name in enumerate(names)}
    return Visibility(table[:, 0], by_system, above, table[:, 1], tuple(sorted(seen)))


def _counted(obstacles: WallObstacles, place: np.ndarray, system: np.ndarray, direction: np.ndarray,
             names: list[str]) -> np.ndarray:
    """(n, 2 + systems) number of satellites in line of sight, PDOP, and the number of each system; NaN inside."""
    table = np.full((len(place), 2 + len(names)), np.nan)
    outside = np.flatnonzero(~obstacles.inside(place))
    start = np.repeat(place[outside], len(system), axis=0)
    free = obstacles.free(start, np.tile(direction, (len(outside), 1))).reshape(len(outside), len(system))
    table[outside, 0] = free.sum(axis=1)
    table[outside, 1] = position_dilution(direction, system, free)
    for k, name in enumerate(names):
        table[outside, k + 2] = free[:, system == name].sum(axis=1)
    return table


def visibility_along(obstacles: WallObstacles, navigation: Navigation, trajectory: Trajectory, crs_wkt: str,
                     settings: SkySettings, lever_arm: tuple[float, float, float] = (0.0, 0.0, 0.0),
                     every: float = 1.0, progress: Progress = SILENT) -> tuple[np.ndarray, np.ndarray, Visibility]:
    """Satellites in line of sight along a drive.

    Parameters
    ----------
    lever_arm : antenna in the body, (forward, right, down) m.
    every : seconds between the places.

    Returns
    -------
    time (n,) in the trajectory's own time, place (n, 3) of the antenna, and what is seen from there.

    Raises
    ------
    InputError : trajectory and navigation are not of one time.
    """
    shift = trajectory_shift(trajectory, navigation.spans(), "navigation files")
    time = np.arange(trajectory.time[0], trajectory.time[-1] + 1e-6, every)
    time = time[within_trajectory(trajectory, time, settings.max_gap)]
    place = body_to_map(trajectory, np.minimum(time, trajectory.time[-1]), np.asarray(lever_arm, float))
    return time, place, visible_satellites(obstacles, navigation, place, time + shift, crs_wkt, settings.systems,
                                           settings.elevation_mask, progress)


def visibility_over(obstacles: WallObstacles, navigation: Navigation, grid: Grid, antenna: np.ndarray, gps_time: float,
                    crs_wkt: str, settings: SkySettings,
                    progress: Progress = SILENT) -> tuple[np.ndarray, np.ndarray, Visibility]:
    """Satellites in line of sight over an area at one time.

    `antenna` : (rows, columns) heights of the antenna, m, NaN where there is none.

    Returns
    -------
    cells (n, 2) row and column of the cells outside buildings, place (n, 3), and what is seen from there.

    Raises
    ------
    InsufficientDataError : no cell has a height outside buildings.
    """
    row, column = np.nonzero(np.isfinite(antenna))
    x, y = grid.centres()
    place = np.column_stack([x[column], y[row], antenna[row, column]])
    if not len(place):
        raise InsufficientDataError(say("No cell of the area has a ground height: give a ground that covers it."))
    seen = visible_satellites(obstacles, navigation, place, np.array(gps_time), crs_wkt, settings.systems,
                              settings.elevation_mask, progress)
    outside = np.isfinite(seen.satellites)
    if not outside.any():
        raise InsufficientDataError(say("The whole area lies inside buildings: choose a larger area or finer cells."))
    visibility = Visibility(seen.satellites[outside], {name: free[outside] for name, free in seen.by_system.items()},
                            seen.above[outside], seen.pdop[outside], seen.names)
    return np.column_stack([row, column])[outside], place[outside], visibility


def level_ground(walls: WallPieces) -> float:
    """Height of the ground, m, where only the buildings tell it: the median of the feet of their walls.

    Raises
    ------
    InputError : the walls have no feet.
    """
    low = walls.low[np.isfinite(walls.low)]
    if not len(low):
        raise InputError(say("The buildings do not tell the height of the ground: give a ground raster."))
    return float(np.median(low))


def satellites_above(navigation: Navigation, frame: MapFrame, place: np.ndarray, time: float, systems: str,
                     elevation_mask: float) -> tuple[np.ndarray, np.ndarray]:
    """Names (s,) and directions (s, 3) in the map's axes of the satellites above the mask at a place (3,).

    Raises
    ------
    InsufficientDataError : no satellite has an ephemeris then.
    """
    location = frame.places(place[None])
    names, vectors = sky_at(navigation, time, location.earth_fixed[0], systems)
    if not len(names):
        chosen = ", ".join(SYSTEM_NAMES[name] for name in systems if name in SYSTEM_NAMES) or "none"
        raise InsufficientDataError(say("No satellite of the chosen systems ({chosen}) can be placed at "
                                        "{calendar_text} GPS time; the navigation files are good for {spans_text}: "
                                        "give those of the day.", chosen=chosen, calendar_text=calendar_text(time),
                                        spans_text=spans_text(navigation.spans())))
    direction = directions(np.broadcast_to(location.axes, (len(names), 3, 3)), vectors)
    up = np.degrees(np.arcsin(direction[:, 2].copy())) >= elevation_mask
    return names[up], direction[up]


def position_dilution(direction: np.ndarray, system: np.ndarray, free: np.ndarray) -> np.ndarray:
    """(n,) PDOP of places that see satellites (n, s) bool at directions (s, 3), with a clock for each system (s,);
    QZSS keeps the time of GPS.

    NaN where fewer than three satellites more than systems are seen, or where they lie such that the position is
    not fixed.
    """
    letters, number = np.unique(np.where(system == "J", "G", system), return_inverse=True)
    design = np.hstack([-direction, np.eye(len(letters))[number.ravel()]])
    normal = np.einsum("ns,si,sj->nij", free.astype(float), design, design, optimize=True)
    clocks = np.arange(3, design.shape[1])
    seen = normal[:, clocks, clocks]
    enough = free.sum(axis=1) >= 3 + (seen > 0).sum(axis=1)
    # A system that is not seen has no clock to find.
    normal[:, clocks, clocks] += seen == 0
    pdop = np.full(len(free), np.nan)
    good = np.flatnonzero(enough)
    good = good[np.linalg.cond(normal[good]) < 1e10]
    if len(good):
        inverse = np.linalg.inv(normal[good])
        pdop[good] = np.sqrt(np.trace(inverse[:, :3, :3], axis1=1, axis2=2))
    pdop[pdop > _WORST_PDOP] = np.nan
    return pdop


def area_grid(bounds: tuple[float, float, float, float], resolution: float) -> Grid:
    """Grid over an area (x_min, y_min, x_max, y_max), m.

    Raises
    ------
    InputError : more than a million cells.
    """
    cells = (bounds[2] - bounds[0]) * (bounds[3] - bounds[1]) / resolution ** 2
    if cells > _LARGEST_GRID:
        raise InputError(say("The area has {cells:.1f} million cells of {resolution:g} m: choose a coarser "
                             "resolution or a smaller area.", cells=cells / 1000000.0, resolution=resolution))
    return Grid.covering(*bounds, resolution)


def gps_time_of(text: str) -> float:
    """GPS seconds of a time in UTC, written as "2024-04-18 02:30:00" or in another form of ISO 8601.

    Raises
    ------
    InputError : it is none.
    """
    try:
        moment = datetime.fromisoformat(text.strip().replace("Z", "+00:00"))
    except ValueError:
        raise InputError(say("\"{text}\" is no time: write it as 2024-04-18 02:30:00, in UTC.", text=text)) from None
    if moment.tzinfo is not None:
        moment = moment.astimezone(timezone.utc)
    seconds = calendar_seconds(moment.year, moment.month, moment.day, moment.hour, moment.minute,
                               moment.second + moment.microsecond / 1e6)
    return float(to_gps(seconds, "UTC"))
