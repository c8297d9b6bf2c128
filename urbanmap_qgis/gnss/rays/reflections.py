"""Which path each observed signal takes among the building models (J 5.6).

A signal is in line of sight, or blocked by a wall; a blocked one that is received all the same has been reflected,
and where exactly one wall can have done it the excess path is known: 2 D cos(elevation) cos(difference of
azimuth), D the distance to the wall. What the model says near an edge is not certain, as its walls may stand a metre
off: `SignalPaths.sure` tells signals whose class survives rotating the ray by some degrees.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...errors import InsufficientDataError
from ...progress import SILENT, Progress
from ...settings.gnss import TraceSettings
from ...wording import say
from ..signals.tables import Signals
from .tracing import WallObstacles, WallReflections, legs_in_line_of_sight, mirror_reflections, rotated_directions
from .wall_faces import WallPieces

LOS, NLOS, REFLECTED = "LOS", "NLOS", "reflected"
"""In line of sight; blocked, with no single wall to reflect it; blocked and reflected by one wall."""


@dataclass(frozen=True)
class SignalPaths:
    """The path of each signal; arrays of n rows.

    Attributes
    ----------
    kind : (n,) LOS, NLOS or REFLECTED.
    sure : (n,) whether the ray's class holds near by too (see `TraceSettings`); False where it was not tried.
    obstacle_distance : (n,) m to the wall that blocks it, NaN in line of sight.
    blocking_piece : (n,) number of the piece of wall that blocks it, -1 in line of sight.
    reflecting_walls : (n,) number of walls that can reflect it.
    reflection : (n,) row in `reflections` of the only reflection, -1 without.
    reflections : free reflections of blocked signals, `ray` being rows of the signals.
    indoors : (e,) epochs whose antenna lies within a building: their signals have no path (NLOS, not sure).
    """

    kind: np.ndarray
    sure: np.ndarray
    obstacle_distance: np.ndarray
    blocking_piece: np.ndarray
    reflecting_walls: np.ndarray
    reflection: np.ndarray
    reflections: WallReflections
    indoors: np.ndarray

    def excess(self) -> np.ndarray:
        """(n,) excess path of the signals with one reflection, m; 0 in line of sight, NaN where not known."""
        excess = np.where(self.kind == LOS, 0.0, np.nan)
        one = self.reflection >= 0
        excess[one] = self.reflections.excess[self.reflection[one]]
        return excess


def trace(walls: WallPieces, signals: Signals, settings: TraceSettings, progress: Progress = SILENT,
          obstacles: WallObstacles | None = None) -> SignalPaths:
    """The path of each signal among walls.

    Raises
    ------
    InsufficientDataError : there is no signal, or all antennas lie within buildings.
    """
    if not len(signals):
        raise InsufficientDataError(say("There is no observation to trace: check that observations, ephemerides and "
                                        "trajectory belong to the same time and place."))
    obstacles = obstacles or WallObstacles.of(walls)
    indoors = obstacles.inside(signals.epochs.place)
    if indoors.all():
        raise InsufficientDataError(say("All places of the antenna lie within buildings: check the coordinate "
                                        "systems and heights of the trajectory and of the buildings."))
    if indoors.any():
        progress.warn(say("At {sum} of {indoors_count} epochs the antenna lies within a building: their signals are "
                          "left out.", sum=indoors.sum(), indoors_count=len(indoors)))
    progress.step(0.05)
    blocking_piece, obstacle_distance = obstacles.first_hit(signals.place, signals.direction, progress=progress)
    outdoors = ~indoors[signals.epoch]
    blocked = (blocking_piece >= 0) & outdoors
    progress.step(0.2)
    sure = _sure(obstacles, signals, blocked, settings, progress) & outdoors
    progress.step(0.4)
    found = _reflected(walls, obstacles, signals, np.flatnonzero(blocked), settings, progress.part(0.4, 1.0))
    count, reflection = _only(walls, found, len(signals))
    kind = np.where(blocked | ~outdoors, np.where(reflection >= 0, REFLECTED, NLOS), LOS)
    return SignalPaths(kind, sure, np.where(blocking_piece >= 0, obstacle_distance, np.nan), blocking_piece, count,
                       reflection, found, indoors)


def _sure(obstacles: WallObstacles, signals: Signals, blocked: np.ndarray, settings: TraceSettings,
          progress: Progress) -> np.ndarray:
    """(n,) whether rays rotated to the sides, and lower (in line of sight) or higher (blocked), fare alike."""
    sure = np.ones(len(signals), bool)
    for is_blocked, size, rise in ((False, settings.edge_angle, -1.0), (True, settings.diffraction, 1.0)):
        rows = np.flatnonzero(blocked == is_blocked)
        for azimuth, elevation in ((0.0, rise * size), (size, 0.0), (-size, 0.0)):
            rows = rows[sure[rows]]
            free = obstacles.free(signals.place[rows], rotated_directions(signals.direction[rows], azimuth, elevation),
                                  progress=progress)
            sure[rows] = free != is_blocked
    return sure


def _reflected(walls: WallPieces, obstacles: WallObstacles, signals: Signals, rows: np.ndarray, settings: TraceSettings,
               progress: Progress) -> WallReflections:
    """Free reflections of the signals of some rows, `ray` being rows of the signals."""
    found = mirror_reflections(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows],
                               settings.max_range, progress=progress)
    found = replace(found, ray=rows[found.ray])
    return found.select(np.flatnonzero(legs_in_line_of_sight(obstacles, signals.place, signals.direction, found,
                                                             progress)))


def _only(walls: WallPieces, found: WallReflections, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(n,) number of different walls that reflect each signal, and (n,) row of the only reflection, or -1."""
    pairs, first = np.unique(np.column_stack([found.ray, walls.wall[found.piece]]), axis=0, return_index=True)
    number = np.bincount(pairs[:, 0], minlength=count)
    reflection = np.full(count, -1)
    reflection[pairs[:, 0]] = first
    reflection[number != 1] = -1
    return number, reflection


def possible_walls(walls: WallPieces, obstacles: WallObstacles, signals: Signals, rows: np.ndarray,
                   settings: TraceSettings, progress: Progress = SILENT) -> np.ndarray:
    """(r,) number of walls that might reflect the signals of some rows if walls stood up to the margin elsewhere.

    Walls are taken larger by the margin, and a leg counts as free if it is so when rotated by some degrees.
    """
    found = mirror_reflections(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows],
                               settings.max_range, settings.margin, progress)
    place, direction = signals.place[rows], signals.direction[rows]
    possible = _possibly_free(obstacles, place[found.ray], found.arriving, found.length - 0.05 - settings.margin,
                              settings, progress)
    found = found.select(np.flatnonzero(possible))
    off = found.place.copy()
    off[:, :2] += (0.05 + settings.margin) * obstacles.walls.normal[found.piece]
    possible = _possibly_free(obstacles, off, direction[found.ray], np.inf, settings, progress)
    found = found.select(np.flatnonzero(possible))
    pairs = np.unique(np.column_stack([found.ray, walls.wall[found.piece]]), axis=0)
    return np.bincount(pairs[:, 0], minlength=len(rows))


def _possibly_free(obstacles: WallObstacles, start: np.ndarray, direction: np.ndarray, length, settings: TraceSettings,
                   progress: Progress) -> np.ndarray:
    """(n,) whether rays are free, as they are or rotated by some degrees."""
    free = np.zeros(len(start), bool)
    length = np.broadcast_to(length, len(start))
    size = settings.edge_angle
    for azimuth, elevation in ((0.0, 0.0), (0.0, size), (size, 0.0), (-size, 0.0)):
        rows = np.flatnonzero(~free)
        free[rows] = obstacles.free(start[rows], rotated_directions(direction[rows], azimuth, elevation), length[rows],
                                    progress)
    return free
