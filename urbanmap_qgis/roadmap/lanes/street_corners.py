"""Borders of roads that turn round the corner into another street, cut there: each part is of a road of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ..map_records import MapLine


@dataclass(frozen=True)
class StreetCornerLimits:
    """What a street corner goes by."""

    step: float = 0.5  # m between the places looked at
    reach: float = 6.0  # m to either side, between which a corner turns
    chord: float = 2.0  # m over which a direction is taken
    turn: float = 50.0  # degrees; a bend of a road that turns so much has a radius under 14 m


LIMITS = StreetCornerLimits()


def cut_at_corners(lines: Sequence[MapLine]) -> list[MapLine]:
    """The lines, those of road borders in parts where they turn round a corner."""
    return [part for line in lines for part in (_parts(line) if line.kind == "road border" else [line])]


def _parts(line: MapLine) -> list[MapLine]:
    """A line cut at the middle of each of its corners."""
    steps = np.hypot(*np.diff(line.points[:, :2], axis=0).T)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    cuts = _corners(shapely.linestrings(line.points[:, :2]))
    marks = [0.0, *cuts, at[-1]]
    if len(marks) == 2:
        return [line]
    parts = []
    for begin, end in zip(marks[:-1], marks[1:]):
        inside = (at > begin) & (at < end)
        where = np.concatenate([[begin], at[inside], [end]])
        points = np.column_stack([np.interp(where, at, column) for column in line.points.T])
        sigmas = tuple(np.interp(where, at, line.sigmas).tolist()) if line.sigmas else ()
        parts.append(replace(line, points=points, sigmas=sigmas))
    return parts


def _corners(plan: shapely.LineString) -> list[float]:
    """Chainages of the sharpest places of a line's corners, m."""
    at = np.arange(LIMITS.reach, plan.length - LIMITS.reach, LIMITS.step)
    if not len(at):
        return []
    headings = [_heading(plan, at + side * (LIMITS.reach - LIMITS.chord / 2.0)) for side in (-1.0, 1.0)]
    turn = np.degrees(np.abs((headings[1] - headings[0] + np.pi) % (2.0 * np.pi) - np.pi))
    turning = np.flatnonzero(turn > LIMITS.turn)
    if not len(turning):
        return []
    runs = np.split(turning, np.flatnonzero(np.diff(turning) > 1) + 1)
    return [float(at[run][turn[run] > turn[run].max() - 1.0].mean()) for run in runs]


def _heading(plan: shapely.LineString, at: np.ndarray) -> np.ndarray:
    """Directions (n,) at chainages, rad."""
    ends = [shapely.get_coordinates(shapely.line_interpolate_point(plan, np.clip(
        at + side * LIMITS.chord / 2.0, 0.0, plan.length))) for side in (-1.0, 1.0)]
    return np.arctan2(*(ends[1] - ends[0]).T[::-1])
