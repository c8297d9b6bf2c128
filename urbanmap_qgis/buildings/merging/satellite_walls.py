"""Walls by satellites as weak observations of edges that no survey saw from the street (J 5.6 and 5.7).

A wall of a GNSS adjustment has a sigma of decimetres. It is weighed against how well the model's own walls are known,
and moves an edge by its share only; an edge that was measured from the street stays there, and is told where the
satellites contradict it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...errors import InputError
from ...settings.buildings import MergeSettings
from ...wording import say
from .plan_edges import Line, OuterEdge
from .wall_match import KEPT, MIN_PIECE, MOVED, NOT_SEEN, SAME, STEP_REACH, TOO_FAR, EdgeMatch, MeasuredWall

# Sigma of a wall's place, m, that a GNSS adjustment takes before it has seen anything (its expected offset): the
# sigma that it gives holds this already.
EXPECTED = 1.0
STREET = 0.05  # What a survey on the map may be off by, m, where its walls are compared with others.
CONTRADICTION = 3.0  # Sigmas from which on a wall from the street and one by satellites contradict.


@dataclass(frozen=True, eq=False)
class SatelliteWall:
    """A wall by satellites.

    Attributes
    ----------
    ends : (2, 2) m in plan, the building at the left from the first to the second.
    sigma : of its place across, m.
    status : adjusted or likely.
    """

    ends: np.ndarray
    sigma: float
    status: str

    def __post_init__(self) -> None:
        if not (math.isfinite(self.sigma) and self.sigma > 0):
            raise InputError(say("A wall by satellites needs a sigma greater than 0."))

    @property
    def line(self) -> Line:
        """Its trace, the building at the left."""
        along = self.ends[1] - self.ends[0]
        return Line(self.ends[0], along / np.hypot(*along))


def satellite_walls(lines: Sequence[shapely.LineString | None], sigma: np.ndarray,
                    status: Sequence[str | None]) -> list[SatelliteWall]:
    """Those of a layer of walls (lines, sigma in m (n,), status) that satellites moved: adjusted and likely ones."""
    return [SatelliteWall(shapely.get_coordinates(line)[[0, -1]], float(size), word)
            for line, size, word in zip(lines, sigma, status)
            if line is not None and word in ("adjusted", "likely") and size > 0 and line.length > 0]


class SatelliteIndex:
    """Walls by satellites by place."""

    def __init__(self, walls: Sequence[SatelliteWall] = ()):
        self.walls = list(walls)
        self.tree = shapely.STRtree([shapely.LineString(wall.ends) for wall in self.walls])

    def along(self, edge: OuterEdge, settings: MergeSettings) -> tuple[SatelliteWall, float] | None:
        """The wall that runs along an edge, most of it first and then the surest, and its offset outwards, m."""
        found = []
        near = self.tree.query(shapely.LineString(edge.ends), predicate="dwithin",
                               distance=settings.max_offset + STEP_REACH)
        for number in sorted(near):
            wall, line = self.walls[number], edge.line
            turn = math.degrees(math.acos(min(float(wall.line.along @ line.along), 1.0)))
            extent = np.clip(np.sort((wall.ends - edge.ends[0]) @ line.along), 0.0, edge.length)
            common = float(extent[1] - extent[0])
            if turn > settings.max_rotation or common < max(settings.min_share * edge.length, MIN_PIECE):
                continue
            middle = edge.ends[0] + extent.mean() * line.along
            found.append((-round(common, 2), wall.sigma, number, float((wall.line.foot(middle) - middle)
                                                                       @ line.outward)))
        if not found:
            return None
        *_, number, offset = min(found)
        return self.walls[number], offset


def weighed(offset: float, sigma: float, model_sigma: float) -> tuple[float, float]:
    """Offset (m) of a wall and its sigma (m) by satellites and by the model together.

    Parameters
    ----------
    offset, sigma : by satellites, m, from the model, with `EXPECTED` as what was known before.
    model_sigma : how well the model's walls are known, m.
    """
    told = max(sigma**-2 - EXPECTED**-2, 0.0)
    weight = told + model_sigma**-2
    return (offset * sigma**-2 / weight if told else 0.0), weight**-0.5


def with_satellites(edge: OuterEdge, match: EdgeMatch, walls: SatelliteIndex, settings: MergeSettings) -> EdgeMatch:
    """What is known of an edge with walls by satellites: where nothing was measured from the street they move it."""
    found = walls.along(edge, settings) if walls.walls else None
    if found is None:
        return match
    wall, offset = found
    if match.status in (MOVED, KEPT):
        return _compared(match, wall, offset)
    return _moved(edge, match, wall, offset, settings) if match.status == NOT_SEEN else match


def _compared(match: EdgeMatch, wall: SatelliteWall, offset: float) -> EdgeMatch:
    """A match with what satellites say against it."""
    away = offset - match.offset
    if abs(away) <= CONTRADICTION * math.hypot(wall.sigma, STREET):
        return match
    note = _far_note(away, wall.sigma)
    return replace(match, note=f"{match.note}; {note}" if match.note else note)


def _far_note(away: float, sigma: float) -> str:
    """Where satellites put a wall, m outwards from where it is taken."""
    return say("satellites put it {away:.1f} m {value} of there (sigma {sigma:.2f} m)", away=abs(away), sigma=sigma,
               value=say("outside") if away > 0 else say("inside"))


def _moved(edge: OuterEdge, match: EdgeMatch, wall: SatelliteWall, offset: float,
           settings: MergeSettings) -> EdgeMatch:
    """An edge moved by satellites, each side weighed by its sigma."""
    if abs(offset) > settings.max_offset:
        return replace(match, status=TOO_FAR, note=_far_note(offset, wall.sigma))
    shift, sigma = weighed(offset, wall.sigma, settings.model_sigma)
    note = say("by satellites ({status}): {offset:+.2f} m, sigma {sigma:.2f} m", status=say(wall.status), offset=offset,
               sigma=wall.sigma)
    line = edge.line
    seen = MeasuredWall(-1, edge.ends[0] + shift * line.outward, line.outward, 0.0, edge.length, math.nan, math.nan,
                        0.0, math.nan, sigma, 0.0)
    if abs(shift) < SAME:
        return EdgeMatch(KEPT, note, seen, None, shift, 0.0)
    return EdgeMatch(MOVED, note, seen, Line(seen.point, line.along), shift, 0.0)
