"""Where laser points themselves show an edge of a building: the end of its roof, or the face of its wall.

The model says only where to look and what the roof is shaped like; the place across the edge comes from the points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.tolerances import SIGMA_OF_MAD
from ..wording import mark

ROOFS, WALLS = "roof edges", "walls"

SHOWN, FEW, OPEN, ABSENT, VAGUE = "", "few points", "open side", "no edge", "vague"
REASONS = {
    FEW: mark("too few points there"),
    OPEN: mark("nothing lower beside it: another building, a tree, or no points"),
    ABSENT: mark("points, but no edge within the window"),
    VAGUE: mark("not shown sharply enough for this limit"),
}
"""Why an edge is left out; only `ABSENT` speaks against the model."""

ROOF_DEPTH = 2.0  # m of roof inside an edge that is looked at beyond the window.
LEAST_POINTS = 8  # of a roof or a wall.
LEAST_LOWER = 3  # points below the roof beside the edge that show it ends there.
LEAST_DROP = 1.5  # m that the roof stands above what is beside it.
ROOF_TOLERANCE = 0.4  # m off the roof's surface within which points are of the roof, at least.
PARAPET = 1.5  # m above the roof's surface that its edge may stand.
BACKGROUND = 0.02  # share of the roof's density that other things have beside it.
BLURS = (0.03, 0.06, 0.12, 0.25)  # m, standard deviations of the edge's sharpness that are tried.
STEP = 0.02  # m of the places that are tried.
FLOOR = 0.02  # m, least sigma of a place or height, which bends of the edge itself have.
SECTION = 4.0  # m of an edge, at least, of which each is measured for itself, and how many.
MOST_SECTIONS = 6
COVERED = 0.5  # share of the pieces of an edge that must have points.
PIECE = 0.5  # m of an edge, within which points are taken to be one measurement of a wall.
WALL_WIDTH = 0.15  # m about a wall's line.
WALL_FOOT = 1.0  # m above the ground and below the roof between which points are of walls.
WALL_TOP = 0.3
SEPARATION = 0.3  # m between two surfaces, of which one cannot say which the edge is.


@dataclass(frozen=True)
class MeasuredEdge:
    """What the points say of one edge.

    Attributes
    ----------
    outward : m that the points' edge lies outward of the model's; NaN where it is not shown.
    sigma : of it, m.
    higher : m that the points' roof is higher than the model's at its edge; NaN where that is not shown.
    sigma_height : of it, m.
    points : number that it was found from.
    reason : SHOWN, or why not.
    """

    outward: float = np.nan
    sigma: float = np.nan
    higher: float = np.nan
    sigma_height: float = np.nan
    points: int = 0
    reason: str = SHOWN


@dataclass(frozen=True)
class PointsAboutEdge:
    """Points about an edge, (n,) each, m.

    Attributes
    ----------
    along, outward, height : of the points.
    above : points less the model's surface at its nearest place inside the edge.
    reach : m on either side of the edge within which it is looked for.
    length : of the edge's part that is looked at.
    roof : height of the model at its edge.
    """

    along: np.ndarray
    outward: np.ndarray
    height: np.ndarray
    above: np.ndarray
    reach: float
    length: float
    roof: float

    @property
    def ground(self) -> float:
        """What lies beside the building, m; NaN where there are no points."""
        beside = self.height[self.outward > 0.0]
        return float(np.percentile(beside, 10)) if len(beside) else np.nan


def roof_edge(points: PointsAboutEdge) -> MeasuredEdge:
    """The place where the roof's points end.

    Along the outward axis the points of a roof have one density up to its edge and none beyond, blurred by the beam and
    by the edge's own bends: the places are weighed by the likelihood of the points' places, over all blurs. That needs
    neither the density nor points beside the edge near it, which walls often hide.
    """
    if np.count_nonzero(points.outward <= points.reach) < LEAST_POINTS or not np.isfinite(points.ground):
        return MeasuredEdge(reason=FEW)
    if points.roof - points.ground < LEAST_DROP:
        return MeasuredEdge(reason=OPEN)
    on_roof, below = _roof_points(points)
    near = np.abs(points.outward) <= points.reach
    upper = points.outward[on_roof & near]
    places = points.along[on_roof & near]
    count = len(upper)
    if count < LEAST_POINTS:
        many = np.count_nonzero(below & near) >= LEAST_POINTS
        return MeasuredEdge(points=count, reason=ABSENT if many else FEW)
    inside = points.outward[on_roof & (points.outward <= 0.5 * points.reach)]
    place, sigma = _end_by_sections(places, upper, points, _independence(inside))
    beside = np.count_nonzero(below & (points.outward > place))
    # An end so near to the window's that the points cannot tell it from one beyond is none that was found.
    if place > points.reach - max(0.1 * points.reach, 2.0 * sigma):
        return MeasuredEdge(points=count, reason=OPEN if beside < LEAST_LOWER else ABSENT)
    if beside < LEAST_LOWER:
        return MeasuredEdge(points=count, reason=OPEN)
    at_end = points.along[on_roof & (points.outward > place - 1.5)]
    if _covered(at_end, points.length, 2 * PIECE) < COVERED:
        return MeasuredEdge(points=count, reason=FEW)
    return MeasuredEdge(place, float(np.hypot(sigma, FLOOR)), points=count)


def _roof_points(points: PointsAboutEdge) -> tuple[np.ndarray, np.ndarray]:
    """Masks of points of the roof at the edge, and of what lies well below it.

    The roof's surface is the model's, raised and tilted as the points inside the edge ask.
    """
    raised = points.height > 0.5 * (points.roof + points.ground)
    use = raised & (points.outward < 0.0)
    if np.count_nonzero(use) < LEAST_POINTS:
        use = raised
    off = points.above.copy()
    columns = np.column_stack([np.ones_like(off), points.along - points.length / 2, points.outward])
    spread = ROOF_TOLERANCE
    for _ in range(4):
        if np.count_nonzero(use) < LEAST_POINTS:
            break
        fitted, *_ = np.linalg.lstsq(columns[use], points.above[use], rcond=None)
        off = points.above - columns @ fitted
        spread = max(ROOF_TOLERANCE, 3.0 * SIGMA_OF_MAD * float(np.median(np.abs(off[use]))))
        use = raised & (np.abs(off) <= spread) & (points.outward < 0.5 * points.reach)
    on_roof = raised & (off >= -spread) & (off <= max(spread, PARAPET))
    return on_roof, off < -max(spread, 0.3 * (points.roof - points.ground))


def _independence(outward: np.ndarray) -> float:
    """How much a point says of the end, 0 to 1: less where points lie in scan lines along the edge.

    From the last point to the end of a roof it is E[g^2] / (2 E[g]) on average, with g the gaps between points: E[g]
    for points at random, half the distance of the lines for lines along the edge.
    """
    gaps = np.diff(np.sort(outward))
    square = float(np.mean(gaps ** 2)) if len(gaps) else 0.0
    return min(1.0, 2.0 * float(gaps.mean()) ** 2 / square) if square > 0.0 else 1.0


def _end_by_sections(along: np.ndarray, outward: np.ndarray, points: PointsAboutEdge,
                     share: float) -> tuple[float, float]:
    """Place of the roof's end at the middle of the edge, m, and its sigma.

    The end is found section by section, as the points' edge may be turned against the model's; how far the sections lie
    off a straight line counts in the sigma.
    """
    number = min(int(points.length / SECTION), MOST_SECTIONS)
    of = np.clip((along / points.length * number).astype(int), 0, max(number - 1, 0))
    if number < 2 or min(np.bincount(of, minlength=number)) < LEAST_POINTS:
        return _end_of(outward, points.reach, share)
    ends = np.array([_end_of(outward[of == section], points.reach, share) for section in range(number)])
    formal = float(np.sqrt((ends[:, 1] ** 2).sum())) / number
    if number < 3:
        return float(ends[:, 0].mean()), formal
    middles = np.arange(number) - (number - 1) / 2
    rest = ends[:, 0] - ends[:, 0].mean() - middles * (middles @ ends[:, 0]) / (middles @ middles)
    return float(ends[:, 0].mean()), max(formal, float(np.sqrt(rest @ rest / (number - 2) / number)))


def _end_of(outward: np.ndarray, reach: float, share: float) -> tuple[float, float]:
    """Mean and sigma, m, of the place where points (n,) of one density over -`reach` to `reach` end; each counts by
    `share`."""
    from scipy.special import ndtr

    places = np.arange(-reach, reach + STEP / 2, STEP)
    grid = np.linspace(-reach, reach, 401)
    weights = []
    for blur in BLURS:
        density = ndtr((places[:, None] - outward) / blur) + BACKGROUND
        whole = (ndtr((places[:, None] - grid) / blur) + BACKGROUND).mean(axis=1)
        weights.append(np.log(density).sum(axis=1) - len(outward) * np.log(whole))
    weight = np.exp(share * (np.array(weights) - np.max(weights))).sum(axis=0)
    weight /= weight.sum()
    place = float(weight @ places)
    return place, float(np.sqrt(weight @ (places - place) ** 2 + STEP ** 2 / 12))


def _covered(along: np.ndarray, length: float, piece: float) -> float:
    """Share of the pieces of an edge in which points lie."""
    pieces = max(int(length / piece), 1)
    taken = np.clip((along / length * pieces).astype(int), 0, pieces - 1)
    return len(np.unique(taken)) / pieces


def wall_edge(points: PointsAboutEdge) -> MeasuredEdge:
    """The place of the wall's face: the straight line across the edge's window that most of its pieces lie on."""
    if not np.isfinite(points.ground):
        return MeasuredEdge(reason=FEW)
    wall = ((np.abs(points.outward) <= points.reach) & (points.height > points.ground + WALL_FOOT)
            & (points.height < points.roof - WALL_TOP))
    along, outward = points.along[wall], points.outward[wall]
    if len(along) < LEAST_POINTS:
        many = np.count_nonzero((points.outward > 0.0) & (points.outward <= points.reach)) >= LEAST_POINTS
        return MeasuredEdge(points=len(along), reason=OPEN if many else FEW)
    places = np.arange(-points.reach, points.reach + STEP / 2, STEP)
    share = np.array([_covered(along[np.abs(outward - place) <= WALL_WIDTH / 2], points.length, PIECE)
                      for place in places])
    number = np.array([np.count_nonzero(np.abs(outward - place) <= WALL_WIDTH / 2) for place in places])
    best = int(np.lexsort((number, share))[-1])
    if share[best] < COVERED:
        return MeasuredEdge(points=len(along), reason=ABSENT)
    if (share[np.abs(places - places[best]) > SEPARATION] >= COVERED).any():
        return MeasuredEdge(points=len(along), reason=OPEN)
    on_line = np.abs(outward - places[best]) <= 2 * WALL_WIDTH
    place, sigma = _line(along[on_line], outward[on_line], points.length)
    return MeasuredEdge(place, sigma, points=int(np.count_nonzero(on_line)))


def _line(along: np.ndarray, outward: np.ndarray, length: float) -> tuple[float, float]:
    """Place at the middle of the edge, m, and its sigma; points of one piece count as one measurement."""
    pieces = np.floor(along / PIECE).astype(int)
    middles = np.array([(along[pieces == one].mean(), np.median(outward[pieces == one])) for one in np.unique(pieces)])
    place = float(np.median(middles[:, 1]))
    off = np.abs(middles[:, 1] - place)
    inliers = middles[off <= max(3 * SIGMA_OF_MAD * float(np.median(off)), WALL_WIDTH)]
    if len(inliers) < 3:
        return float(inliers[:, 1].mean()), float(np.hypot(WALL_WIDTH / np.sqrt(len(inliers)), FLOOR))
    columns = np.column_stack([np.ones(len(inliers)), inliers[:, 0] - length / 2])
    fitted, *_ = np.linalg.lstsq(columns, inliers[:, 1], rcond=None)
    rest = inliers[:, 1] - columns @ fitted
    inverse = np.linalg.inv(columns.T @ columns)
    sigma = np.sqrt(inverse[0, 0] * (rest @ rest) / (len(inliers) - 2)) if len(inliers) > 2 else WALL_WIDTH
    return float(fitted[0]), float(np.hypot(sigma, FLOOR))


def height_at_edge(above: np.ndarray) -> tuple[float, float]:
    """Height, m, of points above the model's surface as far from the edge, and its sigma; NaN for too few."""
    known = above[np.isfinite(above)]
    if len(known) < LEAST_POINTS:
        return np.nan, np.nan
    middle = float(np.median(known))
    spread = SIGMA_OF_MAD * float(np.median(np.abs(known - middle)))
    return middle, float(np.hypot(1.2533 * spread / np.sqrt(len(known)), FLOOR))
