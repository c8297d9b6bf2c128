"""Sign posts with boards, and bollards, along the main streets."""

from __future__ import annotations

import numpy as np
import shapely
from shapely import affinity

from .furniture import is_clear, world_place
from .ground import Ground, Street
from .model import Furniture

# Measures of signs and bollards, m.
SPACING = 13.0  # between signs of one side
BEHIND = 0.6  # the kerb line, to a post
POST = 0.08  # side
THICK = 0.02  # of a board
BOARD = (0.6, 0.9)  # sides
FOOT = (1.9, 2.3)  # of a board above the ground
TURNED = 15.0  # degrees, standard deviation of no more than this about the street's cross direction
CLEAR = 3.0  # of the kerb line of a crossing street
BOLLARD = (0.12, 0.85)  # side and height
BOLLARDS = 1.5  # between the three of a group


def signs_and_bollards(ground: Ground, size: float, rng: np.random.Generator) -> tuple[Furniture, ...]:
    """Posts with one board that faces the traffic of their side, and groups of three bollards between them."""
    things: list[Furniture] = []
    for street in (s for s in ground.streets if s.name in ("A", "B")):
        for side in (1, -1):
            for start in np.arange(-size / 2 + 4.0, size / 2 - 4.0, SPACING):
                along = float(start + rng.uniform(-1.0, 1.0))
                if not is_clear(ground, street, along, CLEAR):
                    continue
                things += _sign(ground, street, along, side, rng)
                things += [_box(ground, street, along + 4.0 + step * BOLLARDS, side, BOLLARD) for step in range(3)
                           if is_clear(ground, street, along + 4.0 + step * BOLLARDS, CLEAR)]
    return tuple(things)


def _place(ground: Ground, street: Street, along: float, side: int) -> tuple[float, float]:
    return world_place(ground, street, along, street.at + side * (street.half_width + BEHIND))


def _box(ground: Ground, street: Street, along: float, side: int, measures: tuple[float, float]) -> Furniture:
    x, y = _place(ground, street, along, side)
    half, z = measures[0] / 2.0, float(ground.height(x, y))
    plan = affinity.rotate(shapely.box(x - half, y - half, x + half, y + half), ground.angle, origin=(x, y))
    return Furniture(plan, z - 0.2, z + measures[1])


def _sign(ground: Ground, street: Street, along: float, side: int, rng: np.random.Generator) -> list[Furniture]:
    width, height = rng.uniform(*BOARD, 2)
    foot = rng.uniform(*FOOT)
    post = _box(ground, street, along, side, (POST, float(foot + height)))
    # Traffic keeps to its left: on the side of +v in the direction of u, on that of +u against the direction of v.
    sense = side if street.along == "u" else -side
    course = np.array([1.0, 0.0]) if street.along == "u" else np.array([0.0, 1.0])
    turn = np.radians(ground.angle + rng.uniform(-1.0, 1.0) * TURNED)
    forward = sense * np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ course
    across = np.array([-forward[1], forward[0]])
    middle = np.array(_place(ground, street, along, side)) - forward * (POST + THICK) / 2.0
    corners = [middle + a * across * width / 2.0 + b * forward * THICK / 2.0
               for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    low = float(ground.height(*_place(ground, street, along, side))) + float(foot)
    return [post, Furniture(shapely.Polygon(corners), low, low + float(height))]
