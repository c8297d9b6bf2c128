"""One plane for roofs that go on across shared walls: eaves and ridges of a row are equal where the points agree.

What the planes of one building are made (level, parallel, mirrored, of one height), those of a row of houses are made
together; each plane that this would move off its points stays as it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.linked_groups import linked_groups
from ..party_walls import REACH
from ..planes.plane_moments import shifted, solve
from ..planes.plane_partition import PlanePoints, building_axes
from ..planes.plane_regularisation import like_planes, mean_square, regular_planes
from ..polygons.partition_lines import edge_rows


@dataclass(frozen=True)
class RowPlanesLimits:
    """Limits of row planes, each with its unit."""

    least_wall: float = 1.0  # Walls shared over less than this (m) make no row.
    # A plane goes with the row where that adds no more error than this to it (root mean square, m): a laser's noise.
    most_added: float = 0.02


LIMITS = RowPlanesLimits()


@dataclass(frozen=True, eq=False)
class HousePlanes:
    """What a row needs of one house: place of its origin (2,), m, moments (k, 10) of its planes' points and edges
    (n, 4) of its outline there."""

    origin: np.ndarray
    moments: np.ndarray
    edges: np.ndarray

    @classmethod
    def of(cls, outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray) -> HousePlanes | None:
        """Those of points (n, 3) of planes (n,); None where there is no plane."""
        if not roof.any():
            return None
        found = PlanePoints.of(outline, points, roof)
        local = shapely.transform(shapely.force_2d(outline), lambda c: c - found.origin)
        return cls(found.origin, found.moments, edge_rows(local))

    def seen_from(self, origin: np.ndarray) -> HousePlanes:
        """The same on another origin."""
        off = self.origin - origin
        return HousePlanes(origin, shifted(self.moments, off), self.edges)

    def regular(self) -> np.ndarray:
        """Planes (k, 3) as the house alone has them."""
        return regular_planes(self.moments, building_axes(self.edges[:, 2:]))


def touching_pairs(outlines: np.ndarray) -> np.ndarray:
    """Pairs (m, 2) of outlines, ascending, that may share a wall."""
    one, two = shapely.STRtree(outlines).query(outlines, predicate="dwithin", distance=REACH)
    pairs = np.column_stack([one, two])[one < two]
    return pairs[np.lexsort(pairs.T[::-1])]


def row_planes(houses: Sequence[HousePlanes | None], outlines: np.ndarray,
               pairs: np.ndarray) -> list[np.ndarray | None]:
    """Planes (k, 3) of each house that stands in a row, on its own origin; None for the others.

    Parameters
    ----------
    outlines : (n,) of the houses.
    pairs : (m, 2) houses that touch.
    """
    links = np.array([pair for pair in pairs.tolist() if _go_on(houses, outlines, *pair)]).reshape(-1, 2)
    planes: list[np.ndarray | None] = [None] * len(houses)
    _, row = linked_groups(*links.T.astype(int), len(houses))
    order = np.argsort(row, kind="stable")
    for members in np.split(order, np.flatnonzero(np.diff(row[order])) + 1):
        if len(members) > 1:
            for house, found in zip(members.tolist(), _together([houses[member] for member in members])):
                planes[house] = found
    return planes


def _go_on(houses: Sequence[HousePlanes | None], outlines: np.ndarray, one: int, two: int) -> bool:
    """Whether a plane of one house may go on in another, across a wall that both share."""
    here, there = houses[one], houses[two]
    if here is None or there is None:
        return False
    table = np.concatenate([here.moments, there.seen_from(here.origin).moments])
    alike = like_planes(table, solve(table)[0])[:len(here.moments), len(here.moments):]
    if not alike.any():
        return False
    beside = shapely.intersection(shapely.boundary(outlines[one]), shapely.buffer(outlines[two], REACH))
    return bool(shapely.length(beside) >= LIMITS.least_wall + 2 * REACH)


def _together(row: Sequence[HousePlanes]) -> list[np.ndarray]:
    """Planes of each house of a row, on its own origin."""
    origin = np.min([house.origin for house in row], axis=0)
    placed = [house.seen_from(origin) for house in row]
    edges = np.concatenate([house.edges[:, 2:] for house in placed])
    common = regular_planes(np.concatenate([house.moments for house in placed]), building_axes(edges))
    ends = np.cumsum([len(house.moments) for house in row])[:-1]
    return [_of_house(house, found) for house, found in zip(row, _on_own_origins(row, np.split(common, ends), origin))]


def _on_own_origins(row: Sequence[HousePlanes], planes: Sequence[np.ndarray], origin: np.ndarray) -> list[np.ndarray]:
    """Planes of each house of a row on the row's origin, put on its own."""
    return [np.column_stack([found[:, :2], found[:, 2] + found[:, :2] @ (house.origin - origin)])
            for house, found in zip(row, planes)]


def _of_house(house: HousePlanes, common: np.ndarray) -> np.ndarray:
    """The planes (k, 3) of a row at a house, its own where its points disagree."""
    own = house.regular()
    added = [mean_square(table, found) - mean_square(table, alone)
             for table, found, alone in zip(house.moments, common, own)]
    return np.where((np.array(added) < LIMITS.most_added**2)[:, None], common, own)
