"""What stands beside the lanes of a map: posts, signals, signs, trees and rails, and the stop lines of the signals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..io.files.named_table import numbers_of
from ..wording import say
from .map_records import Finding, VectorMap

POLE, LAMP, SIGNAL, SIGN, TREE, BOLLARD = "pole", "lamp post", "signal", "sign", "tree", "bollard"
KINDS = (POLE, LAMP, SIGNAL, SIGN, TREE, BOLLARD)
_NUMBERS = ("height", "diameter", "azimuth", "arm", "arm_height", "head_height", "board_width", "board_height",
            "board_z")

# What tells that a signal is for those who wait at a stop line.
AHEAD = (-2.0, 45.0)  # m from the stop line: a signal at it or behind the junction
BESIDE = 1.0  # m to either side of the lanes that end there
SKEW = 30.0  # degrees of an arm from the lanes' cross direction
COURSE = 5.0  # m of a lane, over which its direction is taken


@dataclass(frozen=True)
class RoadsideObject:
    """An object of a survey.

    Attributes
    ----------
    kind : one of `KINDS`.
    foot : (3,) m.
    height, diameter : m, NaN where unknown.
    azimuth : degrees from north, clockwise, of a board's face or an arm; NaN without one.
    arm : length and height over the foot of an arm, m; NaN without one.
    head_height : of what is at the arm's end, m; NaN where unknown.
    board : width, height and height of the middle (in the heights of the foot) of a board, m; NaN without one.
    sure : it is not doubtful.
    """

    kind: str
    foot: np.ndarray
    height: float = np.nan
    diameter: float = np.nan
    azimuth: float = np.nan
    arm: tuple[float, float] = (np.nan, np.nan)
    board: tuple[float, float, float] = (np.nan, np.nan, np.nan)
    sure: bool = True
    head_height: float = np.nan

    @property
    def facing(self) -> np.ndarray:
        """Unit vector (2,) of its azimuth."""
        return np.array([np.sin(np.radians(self.azimuth)), np.cos(np.radians(self.azimuth))])

    @property
    def head(self) -> np.ndarray | None:
        """Where its arm ends (3,), m; None without one."""
        if not np.isfinite([*self.arm, self.azimuth]).all():
            return None
        return self.foot + np.array([*(self.arm[0] * self.facing), self.arm[1]])


def objects_of(geometries: Sequence[shapely.Geometry | None], columns: Mapping[str, Sequence],
               name: str = "The street objects") -> list[RoadsideObject]:
    """Objects of a table of street objects, with a field kind; other kinds are left out, missing fields unknown.

    Raises
    ------
    InputError : a value is no number; it names its row in the table `name`.
    """
    numbers = {field: numbers_of(columns[field], field, name, first=1, may_lack=True) for field in _NUMBERS
               if field in columns}

    def value(field: str, row: int) -> float:
        return float(numbers[field][row]) if field in numbers else np.nan

    found = []
    for row, shape in enumerate(geometries):
        kind = str(columns["kind"][row])
        if shape is None or shape.is_empty or shape.geom_type != "Point" or kind not in KINDS:
            continue
        doubtful = "status" in columns and columns["status"][row] == "doubtful"
        found.append(RoadsideObject(
            kind, shapely.get_coordinates(shape, include_z=True)[0], value("height", row), value("diameter", row),
            value("azimuth", row), (value("arm", row), value("arm_height", row)),
            (value("board_width", row), value("board_height", row), value("board_z", row)), not doubtful,
            value("head_height", row)))
    return found


def rails_of(geometries: Sequence[shapely.Geometry | None], columns: Mapping[str, Sequence],
             name: str = "The guard rails") -> list[np.ndarray]:
    """Lines (n, 4) along rails: their foot and their height over it, m; NaN where unknown.

    Raises
    ------
    InputError : a height is no number; it names its row in the table `name`.
    """
    heights = (numbers_of(columns["height"], "height", name, first=1, may_lack=True) if "height" in columns
               else np.full(len(geometries), np.nan))
    found = []
    for height, shape in zip(heights, geometries):
        for part in shapely.get_parts(shape) if shape is not None else ():
            foot = shapely.get_coordinates(part, include_z=True)
            if part.geom_type == "LineString" and part.length > 0:
                found.append(np.column_stack([foot, np.full(len(foot), height)]))
    return found


def signals_of_stop_lines(built: VectorMap) -> tuple[dict[int, list[int]], list[Finding]]:
    """Numbers of the signals by the stop line that they govern, and a finding for each of which that is not clear.

    A signal governs a stop line where its arm ends above the lanes that end there, or above where they lead to, and
    runs across them: over the other half of the road it is for those who come towards it.
    """
    approaches = [one for one in (_approach(built, stop) for stop in range(len(built.stop_lines))) if one is not None]
    governed: dict[int, list[int]] = {}
    findings = []
    for number, thing in enumerate(built.objects):
        if thing.kind != SIGNAL:
            continue
        fits = [] if thing.head is None or not thing.sure else sorted(
            ((along, one) for one in approaches if (along := one.along(thing)) is not None), key=lambda fit: fit[0])
        first = fits[0][1] if fits else None
        if first is not None and all(one.course @ first.course > np.cos(np.radians(SKEW)) for _, one in fits):
            governed.setdefault(first.stop, []).append(number)
            continue
        findings.append(Finding("signal without stop line", _why(thing, len(fits)), *thing.foot[:2].tolist()))
    return governed, findings


def _why(thing: RoadsideObject, fits: int) -> str:
    """Why nothing tells what a signal governs."""
    if not thing.sure:
        return say("This signal is doubtful: it is written as a pole alone.")
    if thing.head is None:
        return say("No arm tells where the head of this signal hangs: it is written as a pole alone.")
    if fits:
        return say("This signal hangs above lanes to {fits} stop lines of different directions: it is written as a "
                   "pole alone.", fits=fits)
    return say("This signal hangs above no lane that leads away from a stop line: it is written as a pole alone.")


@dataclass(frozen=True)
class _Approach:
    """Lanes that end at a stop line: its number, middle, their direction, and how far they reach to the left of it."""

    stop: int
    place: np.ndarray
    course: np.ndarray
    across: tuple[float, float]

    def along(self, thing: RoadsideObject) -> float | None:
        """How far ahead of the stop line a signal's head hangs above these lanes, m; None where it does not."""
        away = thing.head[:2] - self.place
        along, left = float(away @ self.course), float(away @ np.array([-self.course[1], self.course[0]]))
        inside = self.across[0] - BESIDE <= left <= self.across[1] + BESIDE
        squared = abs(float(thing.facing @ self.course)) < np.sin(np.radians(SKEW))
        return along if AHEAD[0] <= along <= AHEAD[1] and inside and squared else None


def _approach(built: VectorMap, stop: int) -> _Approach | None:
    """The lanes that end at a stop line; None without one."""
    lanes = [number for number, lane in enumerate(built.lanes) if stop in lane.stop_lines and lane.kind == "lane"]
    if not lanes:
        return None
    courses = []
    for number in lanes:
        centre = built.lanes[number].centre[:, :2]
        before = centre[np.hypot(*(centre - centre[-1]).T) >= COURSE]
        courses.append(centre[-1] - (before[-1] if len(before) else centre[0]))
    course = np.sum([one / np.hypot(*one) for one in courses], axis=0)
    course /= np.hypot(*course)
    place = built.stop_lines[stop][:, :2].mean(axis=0)
    left = [(built.coordinates(number, side)[-1, :2] - place) @ np.array([-course[1], course[0]])
            for number in lanes for side in ("left", "right")]
    return _Approach(stop, place, course, (float(min(left)), float(max(left))))
