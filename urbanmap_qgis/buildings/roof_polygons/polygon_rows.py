"""Roof polygons as rows of a table, the building that they are of, and how they are asked for."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import shapely

from ..planes.plane_moments import azimuth_degrees, slope_degrees


@dataclass(frozen=True, eq=False)
class RoofedBuilding:
    """One building whose roofs are to be drawn.

    Attributes
    ----------
    number : its id.
    outline : its plan.
    xyz : (n, 3) places of its points, m.
    roof : (n,) number of each point's roof, 0 on none.
    neighbours : outlines beside it.
    status : words on the outline, empty for none.
    """

    number: int
    outline: shapely.Geometry
    xyz: np.ndarray
    roof: np.ndarray
    neighbours: tuple[shapely.Geometry, ...] = ()
    status: str = ""

    def stated(self, words: str) -> str:
        """Words on the roofs, with those on the outline behind them."""
        return f"{words}; {self.status}" if self.status else words

    @property
    def density(self) -> float:
        """Roof points a m2 of the outline."""
        return np.count_nonzero(self.roof) / self.outline.area


@dataclass(frozen=True, eq=False)
class DrawnRoof:
    """One polygon of a roof.

    Attributes
    ----------
    roof_id : its number, 0 for a plain block.
    polygon : in plan.
    height, top : robust height, and that of the highest point, m.
    z : heights of the roof's points over the polygon, m.
    status : words.
    coverage : see `RoofPolygons`.
    plane : slopes (m a m) east and north, and height of a sloped roof.
    off : distances of the points from that plane, m.
    """

    roof_id: int
    polygon: shapely.Polygon
    height: float
    top: float
    z: np.ndarray
    status: str
    coverage: float = math.nan
    plane: np.ndarray | None = None
    off: np.ndarray | None = None

    @property
    def rmse(self) -> float:
        """Root mean square distance of the points from the plane, or from the level at `height`, m."""
        off = self.z - self.height if self.off is None else self.off
        return float(np.sqrt(np.mean(off ** 2))) if len(self.z) else math.nan

    @property
    def slope(self) -> float:
        """Degrees."""
        return 0.0 if self.plane is None else slope_degrees(self.plane)

    @property
    def azimuth(self) -> float:
        """Degrees; NaN for a level roof."""
        return math.nan if self.plane is None else azimuth_degrees(self.plane)


@dataclass
class RoofPolygons:
    """One row a polygon; a roof in several parts has several rows. Heights and lengths in m.

    Attributes
    ----------
    polygon : plan polygons, with z where roofs are planes.
    building_id, roof_id : what they belong to; roof 0 is a plain block.
    height, height_max : robust height and that of the highest point.
    points, density : roof points over the polygon, and a m2 of it.
    rmse : root mean square height difference of these points to `height`.
    coverage : share of the polygon's area with roof points.
    slope, azimuth : degrees, of the roof plane to the level, and where it falls to, clockwise from north (NaN: level).
    status : words.
    """

    polygon: list = field(default_factory=list)
    building_id: list = field(default_factory=list)
    roof_id: list = field(default_factory=list)
    height: list = field(default_factory=list)
    height_max: list = field(default_factory=list)
    points: list = field(default_factory=list)
    density: list = field(default_factory=list)
    rmse: list = field(default_factory=list)
    coverage: list = field(default_factory=list)
    slope: list = field(default_factory=list)
    azimuth: list = field(default_factory=list)
    status: list = field(default_factory=list)

    def extend(self, other: RoofPolygons) -> None:
        """Append the rows of another table."""
        for name in self.__dataclass_fields__:
            getattr(self, name).extend(getattr(other, name))

    def add(self, number: int, roof: DrawnRoof) -> None:
        """Append a polygon of a building."""
        self.extend(RoofPolygons(
            [roof.polygon], [number], [roof.roof_id], [roof.height], [roof.top], [len(roof.z)],
            [len(roof.z) / roof.polygon.area], [roof.rmse], [roof.coverage], [roof.slope],
            [roof.azimuth], [roof.status]))
