"""Boards of signs: the flat faces of what hangs on posts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from .hanging_parts import LIMITS as AROUND
from .hanging_parts import off_stem
from .object_records import Board, HangingThing, StemAxis


@dataclass(frozen=True)
class BoardLimits:
    """Limits of boards, each with its unit."""

    thick: float = 0.03  # m, of a board (standard deviation) with what its frame adds
    upright: float = 0.35  # vertical part of a board's unit normal, at most
    few: int = 12  # points of a board
    side: tuple[float, float] = (0.25, 4.0)  # m, of a board
    beside_post: float = 0.08  # m between an edge of a board and the face of its post, where the post may hide the rest
    off_post: float = 0.06  # m to either side of a post's face, where points may be its own
    emptier: float = 0.15  # points on one side of the post, of those on the other, of a board that shows by one half
    shade: float = 0.12  # m from its face, that a post reaches behind a board


LIMITS = BoardLimits()


def board_of(thing: HangingThing, place: np.ndarray, axis: StemAxis, seen_from: np.ndarray) -> Board | None:
    """The flat upright face of a thing; None without one.

    Parameters
    ----------
    place : (n, 3) m, of the points that the thing's rows are of.
    axis : of its post, which may hide a part of it where it hangs no farther off than a wall would.
    seen_from : (2,) where the survey passed, m.
    """
    near = place[thing.rows]
    post = axis if thing.away < AROUND.wall else None
    if post is not None:
        # Between a board and its post points may lie too far apart to hang together.
        off = np.hypot(*(place[:, :2] - axis.plan_at(place[:, 2])).T)
        low, high = near[:, 2].min(), near[:, 2].max()
        near = place[(off > off_stem(axis)) & (off < thing.away + thing.sides[0] / 2.0 + LIMITS.off_post)
                     & (place[:, 2] > low - LIMITS.off_post) & (place[:, 2] < high + LIMITS.off_post)]
    for _ in range(4):
        if len(near) < LIMITS.few:
            return None
        centred = near - near.mean(axis=0)
        spread, axes = np.linalg.eigh(centred.T @ centred / len(near))
        distance = np.abs(centred @ axes[:, 0])
        keep = distance < max(2.5 * float(np.median(distance)), LIMITS.thick)
        if keep.all():
            break
        near = near[keep]
    if np.sqrt(max(spread[0], 0.0)) > LIMITS.thick or abs(axes[2, 0]) > LIMITS.upright:
        return None
    return outlined_board(near, axes[:, 0], post, seen_from)


def outlined_board(place: np.ndarray, normal: np.ndarray, axis: StemAxis | None, seen_from: np.ndarray) -> Board | None:
    """The board in which points of a plane lie; None where they make none. `axis` of its post, None without one."""
    level = np.array([normal[0], normal[1]]) / np.hypot(*normal[:2])
    middle = place.mean(axis=0)
    if level @ (seen_from - middle[:2]) < 0:
        level = -level
    across = (place[:, :2] - middle[:2]) @ np.array([-level[1], level[0]])
    up = place[:, 2] - middle[2]
    side = np.array([-level[1], level[0]])
    post = None if axis is None else axis.plan_at(middle[2])
    at_post = 0.0 if post is None else (post - middle[:2]) @ side
    # The post's own points go on under a board, and tell none of its edges.
    aside = up if axis is None else up[np.abs(across - at_post) > axis.diameter / 2.0 + LIMITS.off_post]
    low, high = np.percentile(aside if len(aside) >= LIMITS.few else up, [1, 99])
    # What ends at its post on one side and reaches far out on the other is often hidden by the post from behind.
    for rows in [np.arange(len(across))] if axis is None else _by_halves(across - at_post, axis.diameter / 2.0):
        left, right = np.percentile(across[rows], [1, 99])
        if axis is not None:
            left, right = min(left, at_post), max(right, at_post)
        one_sided = axis is not None and (
            min(abs(left - at_post), abs(right - at_post)) < axis.diameter / 2.0 + LIMITS.beside_post)
        shaded = one_sided and _shaded(left - at_post, right - at_post, side, level, seen_from - post)
        if shaded:
            break
    hull = shapely.convex_hull(shapely.multipoints(np.column_stack([across, up])[rows]))
    if hull.area < 0.5 * (right - left) * (high - low):
        return None
    if shaded:
        reach = max(abs(left - at_post), abs(right - at_post))
        left, right = at_post - reach, at_post + reach
    width, tall = right - left, high - low
    if not all(LIMITS.side[0] <= size <= LIMITS.side[1] for size in (width, tall)):
        return None
    centre = middle + np.array([*(side * (left + right) / 2.0), (low + high) / 2.0])
    return Board(centre, float(np.degrees(np.arctan2(level[0], level[1])) % 360.0), float(width), float(tall),
                 not one_sided)


def _by_halves(across: np.ndarray, radius: float) -> list[np.ndarray]:
    """Rows of the points of a board: first without the side of its post on which few are beside many on the other, as
    where the post hid that half from one drive; then all. `across` (n,) from the axis, `radius` of the post, m."""
    post = radius + LIMITS.off_post
    left, right = across < -post, across > post
    few, many = sorted([left, right], key=np.count_nonzero)
    every = np.arange(len(across))
    return [np.flatnonzero(~few), every] if np.count_nonzero(few) < LIMITS.emptier * np.count_nonzero(many) else [every]


def _shaded(left: float, right: float, side: np.ndarray, level: np.ndarray, view: np.ndarray) -> bool:
    """Whether the post hides the other half of a board that shows from `left` to `right` of it, m: the survey looked
    along the face (`side`, `level` (2,): along and across it) from the half that shows; `view` (2,) to the survey."""
    reach = right if abs(right) > abs(left) else left
    along, off = float(view @ side), float(abs(view @ level))
    return along * reach > 0.0 and off * abs(reach) < LIMITS.shade * abs(along)
