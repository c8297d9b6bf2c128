"""Gantries over the main streets: two posts, a beam across, and boards before it."""

from __future__ import annotations

import shapely

from .furniture import world_place
from .ground import Ground, Street
from .model import Furniture

# Measures of gantries, m.
ALONG = 24.0  # from the crossing of the main streets
BEHIND = 0.6  # the kerb line, to the axis of a post
POST = (0.25, 7.0)  # side and height
BEAM = 0.25  # side; it lies under the top of the posts
BOARD = (2.0, 1.5)  # width and height
BOARD_FOOT = 5.5  # above the ground at the street's axis
THICK = 0.05  # of a board
ASIDE = 2.5  # from the street's axis to the middle of each board


def gantries(ground: Ground) -> tuple[Furniture, ...]:
    """One gantry over each main street, with a board for each direction, which faces those who come."""
    return tuple(box for street in ground.streets if street.name in ("A", "B") for box in _gantry(ground, street))


def _gantry(ground: Ground, street: Street) -> list[Furniture]:
    across = street.half_width + BEHIND
    side, height = POST
    half, top = side / 2.0, _height(ground, street, ALONG, 0.0) + height
    posts = [_box(ground, street, (ALONG - half, ALONG + half),
                  (end * across - half, end * across + half),
                  _height(ground, street, ALONG, end * across) - 0.2, top) for end in (1, -1)]
    beam = _box(ground, street, (ALONG - BEAM / 2.0, ALONG + BEAM / 2.0),
                (half - across, across - half), top - BEAM, top)
    return [*posts, beam, *(_board(ground, street, end) for end in (1, -1))]


def _board(ground: Ground, street: Street, side: int) -> Furniture:
    """A board before the beam, on the side from which the traffic under it comes: that keeps to its left."""
    sense = side if street.along == "u" else -side
    near = ALONG - sense * BEAM / 2.0
    width, height = BOARD
    low = _height(ground, street, ALONG, 0.0) + BOARD_FOOT
    middle = side * ASIDE
    return _box(ground, street, tuple(sorted((near, near - sense * THICK))),
                (middle - width / 2.0, middle + width / 2.0), low, low + height)


def _height(ground: Ground, street: Street, along: float, across: float) -> float:
    return float(ground.height(*world_place(ground, street, along, street.at + across)))


def _box(ground: Ground, street: Street, along: tuple[float, float], across: tuple[float, float], low: float,
         high: float) -> Furniture:
    """A box between places along a street and across its axis, m, and two heights."""
    side = (street.at + across[0], street.at + across[1])
    (u0, u1), (v0, v1) = (along, side) if street.along == "u" else (side, along)
    return Furniture(ground.plan_to_world(shapely.box(u0, v0, u1, v1)), low, high)
