"""Made-up town blocks with known roofs: laser points of buildings, ground and clutter, and their outlines.

All heights are metres. A place gets the height of the highest part that covers it, else the ground's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from shapely import affinity

GROUND = 3.0


@dataclass(frozen=True)
class Part:
    """A piece of roof: plan polygon and its height, a number or a function of x and y."""

    plan: shapely.Geometry
    height: object


@dataclass(frozen=True)
class Block:
    """A building with its outline as the official map has it; `parts` are drawn over one another in order."""

    outline: shapely.Geometry
    parts: Sequence[Part] = ()


@dataclass
class Scene:
    """Buildings on level ground, and the points that a survey would measure there.

    Attributes
    ----------
    spacing : metres between points; they lie on a jittered grid, so that no roof has holes.
    noise : standard deviation of heights, m.
    extra : points (n, 3) of things that are no buildings.
    """

    blocks: list[Block]
    spacing: float = 0.35
    noise: float = 0.0
    seed: int = 1
    margin: float = 15.0
    extra: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))

    @property
    def outlines(self) -> list[shapely.Geometry]:
        """Outlines of the buildings, in order."""
        return [block.outline for block in self.blocks]

    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 3) in a scattered order, and for each whether it lies on a building (n,)."""
        random = np.random.default_rng(self.seed)
        plans = [part.plan for block in self.blocks for part in block.parts] or self.outlines
        x_min, y_min, x_max, y_max = shapely.total_bounds(plans)
        x, y = (axis.ravel() for axis in np.meshgrid(
            np.arange(x_min - self.margin, x_max + self.margin, self.spacing),
            np.arange(y_min - self.margin, y_max + self.margin, self.spacing)))
        x = x + random.uniform(-0.4, 0.4, len(x)) * self.spacing
        y = y + random.uniform(-0.4, 0.4, len(y)) * self.spacing
        z, roof = np.full(len(x), GROUND), np.zeros(len(x), bool)
        for block in self.blocks:
            for part in block.parts:
                shapely.prepare(part.plan)
                inside = shapely.contains_xy(part.plan, x, y)
                z[inside] = part.height(x[inside], y[inside]) if callable(part.height) else part.height
                roof |= inside
        z = z + random.normal(0.0, self.noise, len(z)) if self.noise else z
        points = np.concatenate([np.column_stack([x, y, z]), self.extra])
        roof = np.concatenate([roof, np.zeros(len(self.extra), bool)])
        order = random.permutation(len(points))
        return points[order], roof[order]


def rectangle(x: float, y: float, width: float, depth: float) -> shapely.Polygon:
    """Rectangle with its south-west corner at (x, y)."""
    return shapely.box(x, y, x + width, y + depth)


def flat(plan: shapely.Geometry, height: float) -> Block:
    """A building with one level roof."""
    return Block(plan, (Part(plan, height),))


def gable(x: float, y: float, width: float, depth: float, eaves: float, ridge: float) -> Block:
    """A gable house whose ridge runs along y."""
    plan = rectangle(x, y, width, depth)

    def height(px: np.ndarray, _py: np.ndarray) -> np.ndarray:
        return ridge - (ridge - eaves) * np.abs(px - (x + width / 2)) / (width / 2)

    return Block(plan, (Part(plan, height),))


def tree(x: float, y: float, radius: float, low: float, high: float, count: int, seed: int) -> np.ndarray:
    """Points (count, 3) in the crown of a tree."""
    random = np.random.default_rng(seed)
    angle, distance = random.uniform(0, 2 * math.pi, count), radius * np.sqrt(random.uniform(0, 1, count))
    return np.column_stack([x + distance * np.cos(angle), y + distance * np.sin(angle),
                            random.uniform(low, high, count)])


def turned(points: np.ndarray, degrees: float, east: float, north: float) -> np.ndarray:
    """Points (n, 3) turned about the origin and moved."""
    angle = math.radians(degrees)
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return np.column_stack([points[:, :2] @ rotation.T + (east, north), points[:, 2]])


def turned_plan(plan: shapely.Geometry, degrees: float, east: float, north: float) -> shapely.Geometry:
    """A plan turned about the origin and moved."""
    return affinity.translate(affinity.rotate(plan, degrees, origin=(0, 0)), east, north)
