"""Bollards and boxes as street objects: where they stand, how well that is known, and what is doubtful about them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...wording import say
from ..edges.edge_points import EdgePoints
from .axis_fit import fit_axis
from .low_things import UprightBox, bollards, boxes
from .object_records import BOLLARD, DOUBTFUL, MEASURED, OTHER, Stem, StemAxis, StreetObject
from .sweep_index import SweepIndex


@dataclass(frozen=True)
class LowObjectLimits:
    """Limits of bollards and boxes as objects, each with its unit."""

    free: float = 0.8  # m about a bollard, in which nothing else stands, or
    crowd: float = 0.1  # points there, of its own
    row: float = 3.0  # m to the next of a row of bollards,
    alike: float = 0.1  # m of height, by which those differ at most
    under: float = 0.3  # m in plan and of height, within which a stem that ends under a crown is a bollard
    about_box: float = 0.4  # m about a box, in which a part of a vehicle has other parts
    box_crowd: float = 0.3  # points there, of its own
    box_sigma: float = 0.03  # m, of the middle of a box, of which two sides and the top are seen


LIMITS = LowObjectLimits()


def low_objects(points: np.ndarray, place: np.ndarray, height: np.ndarray, index: SweepIndex, survey: EdgePoints,
                where: np.ndarray, survey_sigma: float) -> list[StreetObject]:
    """Bollards and boxes among a tile's points, their feet relative to the survey's corner.

    Parameters
    ----------
    points : (n,) `OBJECT_POINT`.
    place : (n, 3) of them, m, as in the index.
    height : (n,) above the ground, m.
    where : (n,) mask of points that are looked at.
    survey_sigma : how well the survey is placed as a whole, m.
    """
    def ground(rows: np.ndarray) -> float:
        return float(np.median(place[rows, 2] - height[rows]))

    def passes(rows: np.ndarray) -> int:
        return len(np.unique(points["drive"][rows]))

    found, crowded = [], []
    for stem in bollards(place, height, index, where):
        axis = fit_axis(place[stem.rows], survey.body(points["time"][stem.rows]))
        near = index.near(axis.middle[:2], LIMITS.free)
        beside = (height[near] > stem.low) & (height[near] < stem.high)
        crowded.append(np.count_nonzero(beside) > (1.0 + LIMITS.crowd) * len(stem.rows))
        found.append(_bollard(stem, axis, ground(stem.rows), passes(stem.rows), survey_sigma))
    rows = [_doubted(thing) if close and not _in_row(thing, found) else thing for thing, close in zip(found, crowded)]
    return rows + [_other(box, place, height, index, passes(box.rows), survey_sigma)
                   for box in boxes(place, height, where)]


def _in_row(thing: StreetObject, others: list[StreetObject]) -> bool:
    """Whether another bollard, as high, stands as far as the next of a row does."""
    return any(LIMITS.free < np.hypot(*(other.foot - thing.foot)[:2]) < LIMITS.row
               and abs(other.height - thing.height) < LIMITS.alike for other in others)


def _doubted(thing: StreetObject) -> StreetObject:
    return replace(thing, confidence=0.5 * thing.confidence, status=DOUBTFUL,
                   reason=say("other things stand close beside it"))


def ends_as(thing: StreetObject, stem: Stem, foot: np.ndarray) -> bool:
    """Whether a stem with its `foot` (2,) under a crown ends where a bollard does: that is no trunk."""
    return bool(thing.kind == BOLLARD and np.hypot(*(foot - thing.foot[:2])) < LIMITS.under
                and stem.high < thing.height + LIMITS.under)


def _bollard(stem: Stem, axis: StemAxis, ground: float, passes: int, survey_sigma: float) -> StreetObject:
    lean = float(np.degrees(np.arctan(np.hypot(*axis.lean))))
    return StreetObject(BOLLARD, 0.8, np.array([*axis.plan_at(ground), ground]), stem.high, axis.diameter, lean, None,
                        None, None, None, float(np.hypot(np.sqrt(np.mean(axis.sigma**2)), survey_sigma)),
                        len(stem.rows), passes, MEASURED, "")


def _other(box: UprightBox, place: np.ndarray, height: np.ndarray, index: SweepIndex, passes: int,
           survey_sigma: float) -> StreetObject:
    ground = float(np.median(place[box.rows, 2] - height[box.rows]))
    near = height[index.near(box.centre, box.width / 2.0 + LIMITS.about_box)]
    beside = np.count_nonzero((near > height[box.rows].min()) & (near < box.high))
    sigma = float(np.hypot(LIMITS.box_sigma, survey_sigma))
    foot = np.array([*box.centre, ground])
    thing = StreetObject(OTHER, 0.6, foot, box.high, box.width, None, box.azimuth, None, None,
                         None, sigma, len(box.rows), passes, MEASURED, "")
    return _doubted(thing) if beside > (1.0 + LIMITS.box_crowd) * len(box.rows) else thing
