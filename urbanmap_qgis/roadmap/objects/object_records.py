"""Objects that stand beside a road and how they are looked for: settings, points, stems and results."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...wording import mark
from ..edges.edge_records import POINT

OBJECT_POINT = np.dtype([*POINT.descr, ("time", "<f8"), ("intensity", "<u2")])
"""A laser point: m, number of its pass, s in the trajectory's time, intensity as in the file."""

POLE, LAMP, SIGNAL, SIGN, TREE = mark("pole"), mark("lamp post"), mark("signal"), mark("sign"), mark("tree")
BOLLARD, OTHER = mark("bollard"), mark("other upright")
MEASURED, DOUBTFUL = mark("measured"), mark("doubtful")


@dataclass(frozen=True)
class Stem:
    """Points of one thin upright thing.

    Attributes
    ----------
    rows : (n,) of its tile's points.
    low, high : m above the ground between which it is thin.
    filled : share of the slabs between them in which it shows.
    """

    rows: np.ndarray
    low: float
    high: float
    filled: float


@dataclass(frozen=True)
class StemAxis:
    """Axis of a stem, fitted to what is seen of its surface.

    Attributes
    ----------
    middle : (3,) point of the axis, m.
    lean : (2,) m that it moves east and north for each metre up.
    diameter : m.
    sigma : (2,) standard deviations of `middle` east and north, m.
    """

    middle: np.ndarray
    lean: np.ndarray
    diameter: float
    sigma: np.ndarray

    def plan_at(self, height: np.ndarray | float) -> np.ndarray:
        """Places (..., 2) of the axis at heights z, m."""
        return self.middle[:2] + (np.asarray(height)[..., None] - self.middle[2]) * self.lean


@dataclass(frozen=True)
class HangingThing:
    """A box round something that hangs on a post.

    Attributes
    ----------
    rows : (n,) of the points asked about.
    middle : (3,) in plan from the post's axis, and above the ground, m.
    sides : longer and shorter side in plan, and height, m.
    aside : m from the axis to the upright plane through its middle along its longer side.
    """

    rows: np.ndarray
    middle: np.ndarray
    sides: tuple[float, float, float]
    aside: float

    @property
    def low(self) -> float:
        """Height of its lower edge above the ground, m."""
        return float(self.middle[2] - self.sides[2] / 2.0)

    @property
    def away(self) -> float:
        """m in plan from the axis to its middle."""
        return float(np.hypot(*self.middle[:2]))


@dataclass(frozen=True)
class Board:
    """A flat face on a post.

    Attributes
    ----------
    centre : (3,) m.
    azimuth : degrees from north, clockwise, of the side that the survey saw.
    width, height : m.
    whole : False where it ends at its post, which may hide its other half.
    """

    centre: np.ndarray
    azimuth: float
    width: float
    height: float
    whole: bool = True


@dataclass(frozen=True)
class StreetObject:
    """An object as it is delivered.

    Attributes
    ----------
    kind : `POLE`, `LAMP`, `SIGNAL`, `SIGN`, `TREE`, `BOLLARD` or `OTHER` (a box: a cabinet, a post box).
    confidence : 0 to 1, how clearly its points show that kind.
    foot : (3,) where its axis meets the ground, m.
    height : of its highest point over the foot, m.
    diameter : of its stem, or of the longer sides of a box, m; None where that is not seen.
    lean : degrees from the plumb line; None where its stem is not seen.
    azimuth : degrees, of a board's face, an arm or a longer side of a box; None without one.
    crown : diameter of a tree's crown, m; None without one.
    arm : length and height over the foot of an arm, m; None without one.
    board : on it; None without one.
    head_height : of what is at the end of its arm, m; None without one.
    sigma : standard deviation of the foot in plan, each axis, m.
    points, passes : laser points of the stem, and passes of the survey that saw it.
    status : `MEASURED` or `DOUBTFUL`.
    reason : why.
    second : kind that is next likely; "" without one.
    """

    kind: str
    confidence: float
    foot: np.ndarray
    height: float
    diameter: float | None
    lean: float | None
    azimuth: float | None
    crown: float | None
    arm: tuple[float, float] | None
    board: Board | None
    sigma: float
    points: int
    passes: int
    status: str
    reason: str
    head_height: float | None = None
    second: str = ""
