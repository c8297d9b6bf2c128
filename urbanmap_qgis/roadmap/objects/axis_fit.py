"""The axis and diameter of a stem from the side of it that was seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .object_records import StemAxis


@dataclass(frozen=True)
class AxisFitLimits:
    """Limits of axis fit, each with its unit."""

    rounds: int = 4
    plumb: float = 0.02  # standard deviation of leans, m for each metre up
    leaning: float = 0.017  # 1 degree: a smaller lean cannot be told from other sides seen at other heights
    thinner: float = 0.3  # of what a lean moves the top over the foot, by which a stem gets thinner without the lean
    share: float = 0.05  # of the points, that a view needs
    noise: float = 0.006  # m, least scatter of points
    edges: float = 4.0  # % of the points left out at either edge of what is seen
    # The seen half of a round post lies on average so far before its axis, in radii: pi / 4; that of a square one
    # that is turned anyhow between 0.71 and 1.
    before: float = 0.82
    unround: float = 0.12  # standard deviation of that, radii
    view: float = 25.0  # degrees: views from directions closer than this see the same side
    slab: float = 0.3  # m of height, in each of which a stem is as wide as in the others
    sure: int = 8  # points of a slab that tell how wide a stem is
    wider: float = 1.5  # times as wide as most slabs are those where something else stands against the stem
    most: float = 50.0  # % of the slabs that are no wider


LIMITS = AxisFitLimits()


def fit_axis(place: np.ndarray, from_where: np.ndarray) -> StemAxis:
    """Fit a stem's axis.

    The middle of what is seen across each line of sight, and the depth of the seen face before the axis, are
    observations of the axis' place; sides seen from several directions are adjusted together.

    Parameters
    ----------
    place : (n, 3) points of the stem, m.
    from_where : (n, 2) places from which they were measured, m.
    """
    bare = _bare(place)
    place, from_where = place[bare], from_where[bare]
    z = float(place[:, 2].mean())
    sight = place[:, :2].mean(axis=0) - from_where
    sight /= np.linalg.norm(sight, axis=1)[:, None]
    views = _views(sight)
    lean = _lean(place, views)
    plan = place[:, :2] - (place[:, 2:] - z) * lean
    seen = [_view(plan[views == view], sight[views == view])
            for view in np.unique(views) if np.count_nonzero(views == view) >= LIMITS.share * len(views)]
    diameter = float(np.average([view.width for view in seen], weights=[view.number for view in seen]))
    middle, sigma = _placed(seen, diameter)
    return StemAxis(np.array([*middle, z]), lean, diameter, sigma)


def _bare(place: np.ndarray) -> np.ndarray:
    """Mask (n,) of the points in slabs of height where nothing else stands against the stem: those are no wider than
    the others."""
    slab = np.floor((place[:, 2] - place[:, 2].min()) / LIMITS.slab).astype(np.int64)
    order = np.argsort(slab, kind="stable")
    starts = np.flatnonzero(np.diff(slab[order], prepend=-1))
    low, high = (extreme.reduceat(place[order, :2], starts) for extreme in (np.minimum, np.maximum))
    width = np.hypot(*(high - low).T)
    sure = np.diff(np.append(starts, len(order))) >= LIMITS.sure
    if not sure.any():
        return np.ones(len(place), bool)
    wide = width > LIMITS.wider * np.percentile(width[sure], LIMITS.most)
    return ~wide[np.searchsorted(slab[order][starts], slab)]


@dataclass(frozen=True)
class _View:
    """What one direction saw: unit vector `along` the sight, `middle` across it, `width` and `depth` of the face, m,
    and `number` of points."""

    along: np.ndarray
    middle: float
    width: float
    depth: float
    number: int


def _view(plan: np.ndarray, sight: np.ndarray) -> _View:
    along = sight.mean(axis=0) / np.linalg.norm(sight.mean(axis=0))
    low, high = np.percentile(plan @ _across(along), [LIMITS.edges, 100.0 - LIMITS.edges])
    width = (high - low) / (1.0 - 2.0 * LIMITS.edges / 100.0)
    return _View(along, float(low + high) / 2.0, float(width), float(np.median(plan @ along)), len(plan))


def _across(along: np.ndarray) -> np.ndarray:
    return np.array([-along[1], along[0]])


def _placed(seen: list[_View], diameter: float) -> tuple[np.ndarray, np.ndarray]:
    """The axis' place (2,), m, adjusted to all views, and its standard deviations (2,)."""
    rows, values, sigmas = [], [], []
    widest = max(view.width for view in seen)
    for view in seen:
        # The outermost of n points spread evenly over a width lie width / n from its edges; a view of a part of it
        # does not know which.
        sigma = np.linalg.norm([view.width / np.sqrt(view.number), (widest - view.width) / 2.0, LIMITS.noise])
        rows += [_across(view.along), view.along]
        values += [view.middle, view.depth + LIMITS.before * diameter / 2.0]
        sigmas += [sigma, np.linalg.norm([LIMITS.unround * diameter / 2.0, 0.25 * sigma, LIMITS.noise])]
    design = np.array(rows) / np.array(sigmas)[:, None]
    normal = np.linalg.inv(design.T @ design)
    return normal @ (design.T @ (np.array(values) / np.array(sigmas))), np.sqrt(np.diag(normal))


def _lean(place: np.ndarray, views: np.ndarray) -> np.ndarray:
    """m that a stem moves east and north for each metre up.

    Each view sees another side of it, and those of high and low scanners others at other heights: only what changes
    with height within a view tells of a lean.
    """
    view = np.unique(views, return_inverse=True)[1]
    number = np.bincount(view)
    means = np.column_stack([np.bincount(view, weights=axis) / number for axis in place.T])
    plan, up = place[:, :2] - means[view, :2], place[:, 2] - means[view, 2]
    weight, lean = np.ones(len(up)), np.zeros(2)
    for _ in range(LIMITS.rounds):
        away = np.linalg.norm(plan - up[:, None] * lean, axis=1)
        scatter = max(float(np.median(away)), LIMITS.noise)
        weight = 1.0 / (1.0 + (away / (2.0 * scatter))**2)
        lean = (weight * up) @ plan / ((weight * up) @ up + (scatter / LIMITS.plumb)**2)
    return lean if np.hypot(*lean) > LIMITS.leaning and _shows(lean, plan, up, view) else np.zeros(2)


def _shows(lean: np.ndarray, plan: np.ndarray, up: np.ndarray, view: np.ndarray) -> bool:
    """Whether a stem is thinner without its lean, in the lean's direction, as it is where that is none of sides seen
    one after the other at other heights. `plan` (n, 2) and `up` (n,) from the middle of each `view` (n,), m."""
    towards = lean / np.hypot(*lean)
    saved = moved = 0.0
    for number in range(view.max() + 1):
        own = view == number
        plumb, level = plan[own] @ towards, up[own] * np.hypot(*lean)
        (first, last), (left, right), (low, high) = (
            np.percentile(value, [LIMITS.edges, 100.0 - LIMITS.edges]) for value in (plumb, plumb - level, level))
        saved += np.count_nonzero(own) * ((last - first) - (right - left))
        moved += np.count_nonzero(own) * (high - low)
    return bool(saved > LIMITS.thinner * moved)


def _views(sight: np.ndarray) -> np.ndarray:
    """Number (n,) of the direction from which each point was seen, of directions some degrees apart."""
    return np.round(np.degrees(np.arctan2(sight[:, 1], sight[:, 0])) / LIMITS.view).astype(np.int64)
