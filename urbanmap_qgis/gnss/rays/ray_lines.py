"""The paths of signals as 3D lines with their attributes, and figures of how well they are predicted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..signals.tables import Signals
from .reflections import LOS, NLOS, REFLECTED, SignalPaths
from .wall_faces import WallPieces, wall_table


@dataclass(frozen=True)
class RayStatistics:
    """How well signals are predicted.

    Attributes
    ----------
    count : signals by kind.
    los_median, los_iqr : median and quartile range of the residuals in line of sight, m.
    reflected : reflected signals with a known clock.
    within_5, within_10 : share of them whose residual is within 5 and 10 m of the prediction.
    difference : their median difference from the prediction, m.
    """

    count: dict[str, int]
    los_median: float
    los_iqr: float
    reflected: int
    within_5: float
    within_10: float
    difference: float


def ray_statistics(signals: Signals, paths: SignalPaths, corrected: np.ndarray) -> RayStatistics:
    """Figures of all signals; `corrected` (n,) as of `residuals.corrected_residuals`."""
    known = np.isfinite(corrected)
    sight = corrected[known & (paths.kind == LOS)]
    reflected = known & (paths.kind == REFLECTED)
    off = (corrected - paths.excess())[reflected]
    low, middle, high = np.quantile(sight, [0.25, 0.5, 0.75]) if len(sight) else [np.nan] * 3
    share = [float(np.mean(np.abs(off) <= limit)) if len(off) else np.nan for limit in (5.0, 10.0)]
    return RayStatistics({kind: int(np.count_nonzero(paths.kind == kind)) for kind in (LOS, NLOS, REFLECTED)},
                         float(middle), float(high - low), len(off), *share,
                         float(np.median(off)) if len(off) else np.nan)


def ray_lines(signals: Signals, paths: SignalPaths, rows: np.ndarray, length: float = 100.0) -> np.ndarray:
    """Lines (r,) with z of the paths of some signals: from the antenna to the satellite, by the wall that reflects.

    Parameters
    ----------
    rows : (r,) signals.
    length : of the part towards the satellite, m. What is blocked ends at the wall.
    """
    lines = np.empty(len(rows), dtype=object)
    place, direction = signals.place[rows], signals.direction[rows]
    end = np.where(paths.kind[rows] == NLOS,
                   np.minimum(np.nan_to_num(paths.obstacle_distance[rows], nan=length), length), length)
    straight = np.stack([place, place + end[:, None] * direction], axis=1)
    lines[:] = shapely.linestrings(straight)
    reflected = np.flatnonzero(paths.reflection[rows] >= 0)
    at = paths.reflections.place[paths.reflection[rows[reflected]]]
    lines[reflected] = shapely.linestrings(np.stack([place[reflected], at, at + length * direction[reflected]], axis=1))
    return lines


def ray_columns(walls: WallPieces, names: np.ndarray, signals: Signals, paths: SignalPaths, corrected: np.ndarray,
                rows: np.ndarray) -> dict[str, np.ndarray]:
    """Attributes (r,) of the rays of some signals; `names` (buildings,) of the buildings by row.

    The wall named is the one that reflects, else the one that blocks.
    """
    table = wall_table(walls)
    excess = paths.excess()[rows]
    reflection = paths.reflection[rows]
    piece = np.where(reflection >= 0, paths.reflections.piece[reflection] if len(paths.reflections.piece) else -1,
                     paths.blocking_piece[rows])
    wall = np.where(piece >= 0, walls.wall[piece], -1)
    building = np.array([str(names[table.building[number]]) if number >= 0 else None for number in wall], object)
    edge = np.array([int(table.edge[number]) if number >= 0 else None for number in wall], object)
    return {"time": signals.time[rows], "pass": signals.epochs.source[signals.epoch[rows]] + 1,
            "satellite": signals.satellite[rows].astype(object), "system": signals.system[rows].astype(object),
            "kind": paths.kind[rows].astype(object), "sure": paths.sure[rows], "elevation": signals.elevation[rows],
            "azimuth": signals.azimuth[rows], "cn0": signals.cn0[rows], "excess": excess,
            "residual": corrected[rows], "difference": corrected[rows] - excess,
            "reflections": paths.reflecting_walls[rows], "building": building, "edge": edge}


def thinned(signals: Signals, every: float) -> np.ndarray:
    """Rows of the signals of epochs at least `every` seconds apart within their observation file."""
    chosen = np.zeros(len(signals.epochs), bool)
    for source in np.unique(signals.epochs.source):
        last = -np.inf
        for epoch in np.flatnonzero(signals.epochs.source == source):
            if signals.epochs.time[epoch] - last >= every - 1e-3:
                chosen[epoch], last = True, signals.epochs.time[epoch]
    return np.flatnonzero(chosen[signals.epoch])
