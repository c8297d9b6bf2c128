"""What segmentation finds of each building: its outline, its points and what they say of the outline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.grid import Grid
from ...geometry.tolerances import LEAST_DIVISOR
from ..base_height import outline_ground
from ..point_assignment import Assignment
from .footprint import Footprints

TREES = "trees"
"""Status of an outline whose points are crowns and no roof."""

MIN_ROOF_POINTS = 3
"""Points from which a building can have a roof."""


@dataclass(frozen=True)
class SegmentedBuildings:
    """One row a footprint.

    Attributes
    ----------
    outlines : (n,) outlines at their found places.
    points : (n,) points given to the building.
    density : (n,) points inside the outline a m2.
    ground : (n,) lowest ground height along the outline, m; NaN where it is not known.
    open_share : (n,) share of the outline that was cut out as open ground (courtyards).
    cloud_density : (n,) pulses a m2 of the cloud round the outline; NaN where it was not looked for.
    beyond : (n,) share of the outline beyond the cloud's edge.
    shift_x, shift_y, shift_sigma : (n,) displacement that was applied and its standard deviation, m.
    status : (n,) words: "ok", or what is missing.
    """

    outlines: np.ndarray
    points: np.ndarray
    density: np.ndarray
    ground: np.ndarray
    shift_x: np.ndarray
    shift_y: np.ndarray
    shift_sigma: np.ndarray
    shift_status: np.ndarray
    status: np.ndarray
    open_share: np.ndarray
    cloud_density: np.ndarray
    beyond: np.ndarray

    @classmethod
    def empty(cls, footprints: Footprints) -> SegmentedBuildings:
        """Rows for buildings of which nothing is known yet."""
        count = len(footprints)
        return cls(footprints.polygons.copy(), np.zeros(count, np.int64), np.zeros(count),
                   np.full(count, np.nan), np.zeros(count), np.zeros(count), np.full(count, np.nan),
                   np.full(count, "not observable", object), np.full(count, "no points", object),
                   np.zeros(count), np.full(count, np.nan), np.full(count, np.nan))

    def put(self, rows: np.ndarray, part: SegmentedBuildings) -> None:
        """Fill in the rows that a tile has worked out."""
        for name in self.__dataclass_fields__:
            getattr(self, name)[rows] = getattr(part, name)

    def select(self, rows: np.ndarray) -> SegmentedBuildings:
        """Some rows (mask or numbers)."""
        return SegmentedBuildings(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))

    def count_points(self, assignment: Assignment, outlines: np.ndarray,
                     ground: tuple[Grid, np.ndarray] | None) -> None:
        """Fill in points, density, ground height and status; `outlines` (n,) are where they were found."""
        count = len(outlines)
        self.points[:] = np.bincount(assignment.owner[assignment.owner >= 0], minlength=count)
        inside = np.bincount(assignment.owner[assignment.primary], minlength=count)
        self.density[:] = inside / np.maximum(shapely.area(outlines), LEAST_DIVISOR)
        if ground is not None:
            self.ground[:] = outline_ground(outlines, *ground)
        self.status[:] = np.where(self.points >= MIN_ROOF_POINTS, "ok",
                                  np.where(self.points > 0, "too few points", "no points"))

    def count_open(self, given: np.ndarray, outlines: np.ndarray) -> None:
        """Fill in the share of each given outline that was cut out as open ground."""
        before, after = shapely.area(given), shapely.area(outlines)
        self.open_share[:] = np.where(before > 0, np.clip(1.0 - after / np.maximum(before, LEAST_DIVISOR), 0.0, 1.0),
                                      0.0)

    def takers(self) -> np.ndarray:
        """Row (n,) of the building that has the points where an outline without any stands: the one that covers more
        than half of it; -1 where there is none."""
        takers = np.full(len(self.points), -1, np.int64)
        usable = ~shapely.is_missing(self.outlines)
        bare, full = np.flatnonzero(usable & (self.points == 0)), np.flatnonzero(usable & (self.points > 0))
        pair, other = shapely.STRtree(self.outlines[full]).query(self.outlines[bare], predicate="intersects")
        bare, full = bare[pair], full[other]
        common = shapely.area(shapely.intersection(shapely.make_valid(self.outlines[bare]),
                                                   shapely.make_valid(self.outlines[full])))
        covers = common > 0.5 * shapely.area(self.outlines[bare])
        takers[bare[covers]] = full[covers]
        return takers
