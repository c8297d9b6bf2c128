"""Posts, lamps, signals, signs and trees of known places for tests: points on the sides that a drive sees."""

from __future__ import annotations

import numpy as np

DENSITY = 400.0
"""Points for each m2 of a surface."""


def post(rng, along, across, top, diameter=0.12, low=0.0, lean=(0.0, 0.0)):
    """The seen half of a round post; `lean` m along and across for each metre up."""
    number = int(DENSITY * np.pi / 2 * diameter * (top - low))
    z = rng.uniform(low, top, number)
    angle = rng.uniform(-np.pi / 2, np.pi / 2, number)
    return np.column_stack([along + lean[0] * z + diameter / 2 * np.sin(angle),
                            across + lean[1] * z - np.sign(across) * diameter / 2 * np.cos(angle), z])


def bar(rng, along, across, z, length, thick=0.08):
    """A horizontal bar from a place towards the path, seen from the side."""
    number = max(int(DENSITY * length * thick), 30)
    return np.column_stack([along + rng.uniform(-thick, thick, number) / 2,
                            across - np.sign(across) * rng.uniform(0.0, length, number),
                            z + rng.uniform(-thick, thick, number) / 2])


def box(rng, along, across, z, sides):
    """The outside of a box of some sides (along, across, up), m."""
    number = int(DENSITY * 2.0 * sum(sides[i] * sides[j] for i, j in ((0, 1), (1, 2), (0, 2))))
    where = rng.uniform(-0.5, 0.5, (number, 3))
    face = rng.integers(0, 3, number)
    where[np.arange(number), face] = np.sign(where[np.arange(number), face]) * 0.5
    return np.array([along, across, z]) + where * sides


def board(rng, along, across, z, width, height, turned):
    """A flat board that faces against the drive, turned by some degrees towards the path."""
    number = int(DENSITY * width * height)
    u, v = rng.uniform(-0.5, 0.5, (2, number)) * [[width], [height]]
    angle = np.radians(turned)
    return np.column_stack([along + u * np.sin(angle), across + u * np.cos(angle), z + v])


def crown(rng, along, across, z, radius):
    """Leaves in a ball."""
    number = int(60.0 * radius**3 * 4.19)
    where = rng.normal(size=(number, 3))
    where *= (radius * rng.uniform(0.0, 1.0, number)**(1 / 3) / np.linalg.norm(where, axis=1))[:, None]
    return np.array([along, across, z]) + where


def lamp(rng, along, across):
    """A lamp post with an arm of 1.5 m."""
    return np.concatenate([post(rng, along, across, 8.0, 0.16), bar(rng, along, across, 7.9, 1.5)])


def signal(rng, along, across):
    """A post with an arm of 3 m and a head at its end."""
    return np.concatenate([post(rng, along, across, 6.0, 0.2), bar(rng, along, across, 5.4, 3.0),
                           box(rng, along, across - np.sign(across) * 3.2, 5.3, (0.3, 0.9, 0.4))])


def sign(rng, along, across, width=0.8, height=0.6, turned=0.0):
    """A sign post with a board."""
    return np.concatenate([post(rng, along, across, 2.7, 0.08),
                           board(rng, along - 0.05, across, 2.4, width, height, turned)])


def gantry(rng, along, across, foot=5.4, tall=1.4):
    """A post, a beam towards the path and a board of 1.8 m before that, `foot` m above the ground and `tall` high."""
    inner = across - np.sign(across) * 3.0
    return np.concatenate([post(rng, along, across, 7.0, 0.25), bar(rng, along, across, 6.9, 5.0, 0.25),
                           board(rng, along - 0.15, inner, foot + tall / 2.0, 1.8, tall, 0.0)])


def tree(rng, along, across, trunk=2.2, radius=1.6):
    """A trunk and its crown."""
    return np.concatenate([post(rng, along, across, trunk + 0.6, 0.25),
                           crown(rng, along, across, trunk + radius, radius)])


def wall(rng, along, across, length, height=4.0):
    """A wall along the street."""
    number = int(DENSITY * length * height)
    return np.column_stack([along + rng.uniform(0.0, length, number), np.full(number, across),
                            rng.uniform(0.0, height, number)])


def leaves(rng, along, across, z, radius, density):
    """Leaves in clusters of twelve in a ball, `density` for each m3."""
    middle = rng.normal(size=(max(int(density * 4.19 * radius**3) // 12, 1), 3))
    middle *= (radius * rng.uniform(0.0, 1.0, len(middle))**(1 / 3) / np.linalg.norm(middle, axis=1))[:, None]
    return np.array([along, across, z]) + np.repeat(middle, 12, axis=0) + 0.08 * rng.normal(size=(12 * len(middle), 3))


def leafy(rng, along, across, density, trunk=1.8, radius=1.9):
    """A trunk and a crown of clusters of leaves."""
    return np.concatenate([post(rng, along, across, trunk + 0.6, 0.25),
                           leaves(rng, along, across, trunk + radius, radius, density)])
