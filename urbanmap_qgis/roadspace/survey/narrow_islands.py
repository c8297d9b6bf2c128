"""Narrow islands whose ends were not seen: two parallel kerbs with a semicircle at each end.

A scanner sees the round ends of an island under some metres wide badly: its kerbs are drawn on past them, as lowered
ones, and the side that was seen from far is off. What was measured for certain of both long sides tells its width and
direction, and the shorter of the two where it ends.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...wording import say
from .area_records import EdgeLine

WIDTH = (0.3, 2.0)  # m
SLENDER = 4.0  # least length in widths
BESIDE = 1.0  # m from its border, within which its edges lie
SHARE = 0.6  # of an edge that lies there
SEEN = 0.95  # share of its border; one that was measured so far is left as it is
ON = 0.05  # m, border on a measured edge
NEAR = 0.1  # m from what was measured for certain, within which the fitted border is measured
OFF = 0.06  # m, by which nine tenths of the sure places may leave straight sides
SURE = 0.3  # share of each side's length measured for certain
STATION = 0.25  # m
OVERSHOOT = 3.0  # m, farthest that an end may be drawn in


def with_round_ends(edges: Sequence[EdgeLine],
                    surface_between: Callable[[Sequence[EdgeLine]], Sequence[shapely.Polygon]]) -> list[EdgeLine]:
    """Edges with those of narrow straight islands whose border was not measured all round drawn anew.

    surface_between : polygons (m) that edges enclose.
    """
    made = list(edges)
    for polygon in surface_between(edges):
        for ring in polygon.interiors:
            hole = shapely.Polygon(ring)
            if 2.0 * hole.area / hole.length < WIDTH[1]:
                made = _drawn_anew(made, hole)
    return made


def _drawn_anew(edges: list[EdgeLine], hole: shapely.Polygon) -> list[EdgeLine]:
    """Edges with those of one island in its fitted shape; as they are where it does not fit."""
    near = shapely.buffer(hole, BESIDE)
    plans = [shapely.linestrings(edge.plan) for edge in edges]
    own = [shapely.intersection(plan, near).length > SHARE * plan.length for plan in plans]
    around = [edge for edge, mine in zip(edges, own) if mine]
    least = 0.5 * max((edge.height for edge in around), default=0.0)
    raised = [edge for edge in around if edge.height > least]
    sure = shapely.union_all([shapely.linestrings(edge.plan) for edge in raised if not edge.doubt])
    if shapely.intersection(hole.exterior, shapely.buffer(sure, ON)).length > SEEN * hole.length:
        return edges
    spine = _spine(raised, hole)
    if spine is None:
        return edges
    return [edge for edge, mine in zip(edges, own) if not mine] + _outline(spine, raised)


def _spine(raised: Sequence[EdgeLine], hole: shapely.Polygon) -> tuple[np.ndarray, np.ndarray, float] | None:
    """Both ends (2,) of the middle line between the semicircles, and half the width, m; None where none fits."""
    box = shapely.get_coordinates(shapely.minimum_rotated_rectangle(hole))[:3]
    along = max(np.diff(box, axis=0), key=lambda side: float(np.hypot(*side)))
    along = along / np.hypot(*along)
    across, origin = np.array([-along[1], along[0]]), shapely.get_coordinates(shapely.centroid(hole))[0]
    places: dict[int, list[np.ndarray]] = {-1: [], 1: []}
    certain: dict[int, list[np.ndarray]] = {-1: [], 1: []}
    for edge in raised:
        points = shapely.get_coordinates(shapely.segmentize(shapely.linestrings(edge.plan), STATION)) - origin
        course = np.gradient(points, axis=0)
        straight = np.abs(course @ along) > 2.0 * np.abs(course @ across)
        points = np.column_stack([points @ along, points @ across])[straight]
        if len(points):
            side = 1 if np.median(points[:, 1]) > 0 else -1
            places[side].append(points)
            certain[side] += [] if edge.doubt else [points]
    if not all(certain.values()):
        return None
    sides = {side: np.vstack(found) for side, found in places.items()}
    tilt, left, right, off = _parallels(np.vstack(certain[1]), np.vstack(certain[-1]))
    start, end = (float(choose([bound(side[:, 0]) for side in sides.values()]))
                  for choose, bound in ((max, np.min), (min, np.max)))
    half = (left - right) / 2.0
    reach = (shapely.get_coordinates(hole) - origin) @ along
    drawn_in = max(start - half - reach.min(), reach.max() - end - half)
    seen = min(len(np.vstack(found)) for found in certain.values()) * STATION
    if (not WIDTH[0] < 2.0 * half < WIDTH[1] or end - start < 2.0 * SLENDER * half
            or off > OFF or drawn_in > OVERSHOOT or seen < SURE * (end - start)):
        return None
    one, other = (origin + along * place + across * (tilt * place + (left + right) / 2.0) for place in (start, end))
    return one, other, half


def _parallels(left: np.ndarray, right: np.ndarray) -> tuple[float, float, float, float]:
    """Common slope and offsets (m) of two lines through places along and across, and what nine tenths keep to, m."""
    rows = np.vstack([left, right])
    on_left = np.arange(len(rows)) < len(left)
    matrix = np.column_stack([rows[:, 0], on_left, ~on_left]).astype(float)
    weight = np.ones(len(rows))
    for _ in range(8):  # to the least sum of distances: an end that bends away pulls at squares
        found = np.linalg.lstsq(matrix * weight[:, None], rows[:, 1] * weight, rcond=None)[0]
        distance = np.abs(matrix @ found - rows[:, 1])
        weight = 1.0 / np.sqrt(np.maximum(distance, 0.01))
    return float(found[0]), float(found[1]), float(found[2]), float(np.quantile(distance, 0.9))


def _outline(spine: tuple[np.ndarray, np.ndarray, float], raised: Sequence[EdgeLine]) -> list[EdgeLine]:
    """The island's border in parts, with the heights of the nearest measured places; doubtful where none is near."""
    one, other, half = spine
    border = shapely.segmentize(shapely.buffer(shapely.linestrings([one, other]), half).exterior, 2 * STATION)
    plan = shapely.get_coordinates(border)
    feet, tops = (np.vstack([getattr(edge, part) for edge in raised]) for part in ("foot", "top"))
    nearest = cKDTree((feet[:, :2] + tops[:, :2]) / 2.0).query(plan)[1]
    foot, top = np.column_stack([plan, feet[nearest, 2]]), np.column_stack([plan, tops[nearest, 2]])
    certain = [edge for edge in raised if not edge.doubt]
    best = max(certain, key=lambda edge: len(edge.foot))
    sure = shapely.union_all([shapely.linestrings(edge.plan) for edge in certain])
    seen = shapely.distance(shapely.points((plan[:-1] + plan[1:]) / 2.0), sure) < NEAR
    doubt = say("drawn from what was seen of this island")
    bounds = [0, *(np.flatnonzero(np.diff(seen)) + 1), len(seen)]
    return [replace(best, foot=foot[begin:end + 1], top=top[begin:end + 1], gap=0.0,
                    doubt="" if seen[begin] else doubt) for begin, end in zip(bounds, bounds[1:])]
