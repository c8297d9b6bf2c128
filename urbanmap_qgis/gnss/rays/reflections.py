"""Which way each observed signal takes among the building models (J 5.6).

A signal is in line of sight, or blocked by a wall; a blocked one that is received all the same has been reflected,
and where exactly one wall can have done it the additional way is known: 2 D cos(elevation) cos(difference of
azimuth), D the distance to the wall. What the model says near an edge is not certain, as its walls may stand a metre
off: `Ways.sure` tells signals whose class survives turning the ray by some degrees.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...progress import SILENT, Progress
from ..signals.tables import Signals
from .tracing import Bounces, Obstacles, bounces, turned, unhindered
from .wall_faces import Walls

LOS, NLOS, REFLECTED = "LOS", "NLOS", "reflected"
"""In line of sight; blocked, with no single wall to reflect it; blocked and reflected by one wall."""


@dataclass(frozen=True)
class TraceSettings:
    """How signals are traced.

    Parameters
    ----------
    farthest : walls farther from the antenna than this in plan reflect nothing that is received, m.
    margin : walls may stand this far from where the model has them, m.
    near_edge : degrees by which rays are turned to try how sure their class is.
    bend : a signal less than this above its obstacle's edge may be bent over it: blocked for sure is only what is
        also blocked this many degrees higher and to the sides.
    """

    farthest: float = 150.0
    margin: float = 1.5
    near_edge: float = 3.0
    bend: float = 6.0

    def __post_init__(self) -> None:
        if not self.farthest > 0 or self.margin < 0 or self.near_edge < 0 or self.bend < 0:
            raise InputError("The farthest reflection must be greater than 0, margins and angles not less than 0.")


@dataclass(frozen=True)
class Ways:
    """The way of each signal; arrays of n rows.

    Attributes
    ----------
    kind : (n,) LOS, NLOS or REFLECTED.
    sure : (n,) whether the ray's class holds near by too (see `TraceSettings`); False where it was not tried.
    stop : (n,) m to the wall that blocks it, NaN in line of sight.
    blocker : (n,) number of the piece of wall that blocks it, -1 in line of sight.
    reflections : (n,) number of walls that can reflect it.
    bounce : (n,) row in `bounces` of the only reflection, -1 without.
    bounces : free reflections of blocked signals, `ray` being rows of the signals.
    indoors : (e,) epochs whose antenna lies within a building: their signals have no way (NLOS, not sure).
    """

    kind: np.ndarray
    sure: np.ndarray
    stop: np.ndarray
    blocker: np.ndarray
    reflections: np.ndarray
    bounce: np.ndarray
    bounces: Bounces
    indoors: np.ndarray

    def excess(self) -> np.ndarray:
        """(n,) additional way of the signals with one reflection, m; 0 in line of sight, NaN where not known."""
        excess = np.where(self.kind == LOS, 0.0, np.nan)
        one = self.bounce >= 0
        excess[one] = self.bounces.excess[self.bounce[one]]
        return excess


def trace(walls: Walls, signals: Signals, settings: TraceSettings, progress: Progress = SILENT,
          obstacles: Obstacles | None = None) -> Ways:
    """The way of each signal among walls.

    Raises
    ------
    InsufficientDataError : there is no signal, or all antennas lie within buildings.
    """
    if not len(signals):
        raise InsufficientDataError("There is no observation to trace: check that observations, ephemerides and "
                                    "trajectory belong to the same time and place.")
    obstacles = obstacles or Obstacles.of(walls)
    indoors = obstacles.inside(signals.epochs.place)
    if indoors.all():
        raise InsufficientDataError("All places of the antenna lie within buildings: check the coordinate systems and "
                                    "heights of the trajectory and of the buildings.")
    if indoors.any():
        progress.warn(f"At {indoors.sum()} of {len(indoors)} epochs the antenna lies within a building: their "
                      "signals are left out.")
    progress.step(0.05)
    blocker, stop = obstacles.first_hit(signals.place, signals.direction, progress=progress)
    outdoors = ~indoors[signals.epoch]
    blocked = (blocker >= 0) & outdoors
    progress.step(0.2)
    sure = _sure(obstacles, signals, blocked, settings, progress) & outdoors
    progress.step(0.4)
    found = _reflected(walls, obstacles, signals, np.flatnonzero(blocked), settings, progress.part(0.4, 1.0))
    count, bounce = _only(walls, found, len(signals))
    kind = np.where(blocked | ~outdoors, np.where(bounce >= 0, REFLECTED, NLOS), LOS)
    return Ways(kind, sure, np.where(blocker >= 0, stop, np.nan), blocker, count, bounce, found, indoors)


def _sure(obstacles: Obstacles, signals: Signals, blocked: np.ndarray, settings: TraceSettings,
          progress: Progress) -> np.ndarray:
    """(n,) whether rays turned to the sides, and lower (in line of sight) or higher (blocked), fare alike."""
    sure = np.ones(len(signals), bool)
    for is_blocked, size, rise in ((False, settings.near_edge, -1.0), (True, settings.bend, 1.0)):
        rows = np.flatnonzero(blocked == is_blocked)
        for azimuth, elevation in ((0.0, rise * size), (size, 0.0), (-size, 0.0)):
            rows = rows[sure[rows]]
            free = obstacles.free(signals.place[rows], turned(signals.direction[rows], azimuth, elevation),
                                  progress=progress)
            sure[rows] = free != is_blocked
    return sure


def _reflected(walls: Walls, obstacles: Obstacles, signals: Signals, rows: np.ndarray, settings: TraceSettings,
               progress: Progress) -> Bounces:
    """Free reflections of the signals of some rows, `ray` being rows of the signals."""
    found = bounces(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows], settings.farthest,
                    progress=progress)
    found = replace(found, ray=rows[found.ray])
    return found.take(np.flatnonzero(unhindered(obstacles, signals.place, signals.direction, found,
                                                progress)))


def _only(walls: Walls, found: Bounces, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(n,) number of different walls that reflect each signal, and (n,) row of the only reflection, or -1."""
    pairs, first = np.unique(np.column_stack([found.ray, walls.wall[found.piece]]), axis=0, return_index=True)
    number = np.bincount(pairs[:, 0], minlength=count)
    bounce = np.full(count, -1)
    bounce[pairs[:, 0]] = first
    bounce[number != 1] = -1
    return number, bounce


def possible_walls(walls: Walls, obstacles: Obstacles, signals: Signals, rows: np.ndarray,
                   settings: TraceSettings, progress: Progress = SILENT) -> np.ndarray:
    """(r,) number of walls that might reflect the signals of some rows if walls stood up to the margin elsewhere.

    Walls are taken larger by the margin, and a leg counts as free if it is so when turned by some degrees.
    """
    found = bounces(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows], settings.farthest,
                    settings.margin, progress)
    place, direction = signals.place[rows], signals.direction[rows]
    maybe = _maybe_free(obstacles, place[found.ray], found.arriving, found.length - 0.05 - settings.margin, settings,
                        progress)
    found = found.take(np.flatnonzero(maybe))
    off = found.place.copy()
    off[:, :2] += (0.05 + settings.margin) * obstacles.walls.normal[found.piece]
    maybe = _maybe_free(obstacles, off, direction[found.ray], np.inf, settings, progress)
    found = found.take(np.flatnonzero(maybe))
    pairs = np.unique(np.column_stack([found.ray, walls.wall[found.piece]]), axis=0)
    return np.bincount(pairs[:, 0], minlength=len(rows))


def _maybe_free(obstacles: Obstacles, start: np.ndarray, direction: np.ndarray, reach, settings: TraceSettings,
                progress: Progress) -> np.ndarray:
    """(n,) whether rays are free, as they are or turned by some degrees."""
    free = np.zeros(len(start), bool)
    reach = np.broadcast_to(reach, len(start))
    size = settings.near_edge
    for azimuth, elevation in ((0.0, 0.0), (0.0, size), (size, 0.0), (-size, 0.0)):
        rows = np.flatnonzero(~free)
        free[rows] = obstacles.free(start[rows], turned(direction[rows], azimuth, elevation), reach[rows], progress)
    return free
