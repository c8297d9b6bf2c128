"""The ground of the sample city: a gentle slope, cambered streets, kerbs, pavements and plots.

Height is one closed formula of the place, so that every sensor can be checked against it exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property

import numpy as np
import shapely

KERB_HEIGHT = 0.15
KERB_RADIUS = 4.0

PAVEMENT_FALL = 0.02
# The pavement rises by `pavement_fall` over its first metres from the kerb; all beyond lies as high as there.
PAVEMENT_REACH = 2.5
LOWERED_HEIGHT = 0.02  # Height of a lowered kerb, m.
# m along the kerb in which it comes down, and behind it in which the pavement reaches its height again.
LOWERED_SLOPE = 0.6
LOWERED_DEPTH = 1.2

WAVE_LENGTH = 170.0
"""Of the undulation, m."""


class Surface(IntEnum):
    """What the ground is used for."""

    CARRIAGEWAY = 1
    PAVEMENT = 2
    PLOT = 3
    PARKING = 4


@dataclass(frozen=True)
class Street:
    """A straight street of the local frame.

    Attributes
    ----------
    name : "A", "A1" ... along u; "B", "B1" ... along v.
    along : "u" or "v".
    at : place of its centre line on the other axis, m.
    half_width : from the centre line to the kerb.
    pavement : width of each pavement.
    lanes : lanes in each direction, beside a shoulder of the remaining width.
    """

    name: str
    along: str
    at: float
    half_width: float
    pavement: float
    lanes: int
    lane_width: float = 3.25

    @property
    def rise(self) -> float:
        """Height of the camber's top above the gutter, m (2 % of the half width on average)."""
        return 0.015 * self.half_width


@dataclass(frozen=True)
class LoweredKerb:
    """A place where a kerb is lowered: name of the street, side (1, -1) of it, begin and end along it, m."""

    street: str
    side: int
    start: float
    end: float


@dataclass(frozen=True)
class Ground:
    """Ground of the city. Public functions take projected x, y; u, v are the axes of the streets.

    Attributes
    ----------
    origin : x, y of the main crossing.
    angle : direction of the u axis, degrees anticlockwise from east.
    z0 : height of the general plane at the origin.
    slope : its rise per metre of u and v.
    wave : half height of the gentle undulation along u, m.
    streets : at least one along u and one along v.
    parking : polygons of parking lots (projected coordinates).
    lowered : places where kerbs are lowered.
    islands : raised parts of carriageways, polygons in u, v.
    """

    origin: tuple[float, float]
    angle: float
    z0: float
    slope: tuple[float, float]
    wave: float
    streets: tuple[Street, ...]
    parking: tuple[shapely.Polygon, ...] = ()
    lowered: tuple[LoweredKerb, ...] = ()
    islands: tuple[shapely.Polygon, ...] = ()

    def to_local(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """u, v of projected x, y."""
        cos, sin = np.cos(np.radians(self.angle)), np.sin(np.radians(self.angle))
        east, north = np.asarray(x, float) - self.origin[0], np.asarray(y, float) - self.origin[1]
        return cos * east + sin * north, cos * north - sin * east

    def to_world(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Projected x, y of u, v."""
        cos, sin = np.cos(np.radians(self.angle)), np.sin(np.radians(self.angle))
        u, v = np.asarray(u, float), np.asarray(v, float)
        return self.origin[0] + cos * u - sin * v, self.origin[1] + sin * u + cos * v

    def plan_to_world(self, plan: shapely.Geometry) -> shapely.Geometry:
        """A plan of the local frame in projected coordinates."""
        return shapely.transform(plan, lambda uv: np.column_stack(self.to_world(uv[:, 0], uv[:, 1])))

    def height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the ground (m), with kerbs as steps."""
        u, v = self.to_local(x, y)
        along_u, along_v = self._tables["u"], self._tables["v"]
        near_u, near_v = along_u.nearest(v), along_v.nearest(u)
        shape_u = np.minimum(((v - along_u.at[near_u]) / along_u.half_width[near_u])**2, 1.0)
        shape_v = np.minimum(((u - along_v.at[near_v]) / along_v.half_width[near_v])**2, 1.0)
        rise_u, rise_v = along_u.rise[near_u], along_v.rise[near_v]
        camber = (rise_u * (1 - shape_u) * shape_v + rise_v * (1 - shape_v) * shape_u
                  + np.maximum(rise_u, rise_v) * (1 - shape_u) * (1 - shape_v))
        kerb = _kerb_distance(*self._beyond(u, v, near_u, near_v))
        step = np.where(kerb > 0, KERB_HEIGHT + PAVEMENT_FALL * np.minimum(kerb, PAVEMENT_REACH), 0.0)
        if self.lowered:
            step = np.where(kerb > 0, step - self._lowering(u, v, kerb), 0.0)
        if self.islands:
            step = np.where(self._on_island(u, v), KERB_HEIGHT, step)
        return self._general(u, v) + camber + step

    def _on_island(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Whether places lie on an island."""
        shapely.prepare(self._island_plan)
        return shapely.contains_xy(self._island_plan, u, v)

    @cached_property
    def _island_plan(self) -> shapely.Geometry:
        return shapely.union_all(list(self.islands))

    def _lowering(self, u: np.ndarray, v: np.ndarray, kerb: np.ndarray) -> np.ndarray:
        """By how much the pavement lies lower than behind a full kerb (m), at places `kerb` m behind the kerb line."""
        share = np.zeros(np.shape(kerb))
        streets = {street.name: street for street in self.streets}
        for place in self.lowered:
            street = streets[place.street]
            along, across = (u, v) if street.along == "u" else (v, u)
            inside = np.minimum(along - place.start, place.end - along) / LOWERED_SLOPE
            beside = np.abs((across - street.at) * place.side - street.half_width - kerb) < 1e-6
            share = np.maximum(share, np.where(beside, np.clip(inside, 0.0, 1.0), 0.0))
        return share * np.clip(1.0 - kerb / LOWERED_DEPTH, 0.0, 1.0) * (KERB_HEIGHT - LOWERED_HEIGHT)

    def bounds_of_relief(self) -> tuple[float, float]:
        """Least and greatest difference of the height from the general plane z0 + slope . (u, v), m."""
        return (-self.wave, self.wave + max(
            max(street.rise for street in self.streets) + (KERB_HEIGHT if self.islands else 0.0),
            KERB_HEIGHT + PAVEMENT_FALL * PAVEMENT_REACH))

    def plane(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the general plane, without undulation, camber and kerbs."""
        u, v = self.to_local(x, y)
        return self.z0 + self.slope[0] * u + self.slope[1] * v

    def kind(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """`Surface` at the places, uint8."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        u, v = self.to_local(x, y)
        along_u, along_v = self._tables["u"], self._tables["v"]
        near_u, near_v = along_u.nearest(v), along_v.nearest(u)
        beyond_u, beyond_v = self._beyond(u, v, near_u, near_v)
        kerb = _kerb_distance(beyond_u, beyond_v)
        pavement = np.where(beyond_u < beyond_v, along_u.pavement[near_u], along_v.pavement[near_v])
        kind = np.where(kerb <= 0, Surface.CARRIAGEWAY,
                        np.where(kerb <= pavement, Surface.PAVEMENT, Surface.PLOT)).astype(np.uint8)
        if self.islands:
            kind[self._on_island(u, v)] = Surface.PAVEMENT
        for lot in self.parking:
            shapely.prepare(lot)
            kind[shapely.contains_xy(lot, x, y) & (kind == Surface.PLOT)] = Surface.PARKING
        return kind

    def kerb_distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Distance from the nearest kerb into pavement or plot, m; 0 or less on the carriageway."""
        u, v = self.to_local(x, y)
        return _kerb_distance(*self._beyond(u, v, self._tables["u"].nearest(v), self._tables["v"].nearest(u)))

    def _general(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return (self.z0 + self.slope[0] * u + self.slope[1] * v
                + self.wave * np.sin(2 * np.pi * (u + 0.4 * v) / WAVE_LENGTH))

    @cached_property
    def _tables(self) -> dict[str, _Streets]:
        return {along: _Streets(along, self.streets) for along in ("u", "v")}

    def _beyond(self, u, v, near_u, near_v) -> tuple[np.ndarray, np.ndarray]:
        """Distances beyond the kerb lines of the nearest streets along u and along v, negative between them."""
        along_u, along_v = self._tables["u"], self._tables["v"]
        return (np.abs(v - along_u.at[near_u]) - along_u.half_width[near_u],
                np.abs(u - along_v.at[near_v]) - along_v.half_width[near_v])


class _Streets:
    """The streets of one direction as arrays, in the order of their places."""

    def __init__(self, along: str, streets: tuple[Street, ...]):
        chosen = sorted((street for street in streets if street.along == along), key=lambda street: street.at)
        self.at, self.half_width, self.pavement, self.rise = (
            np.array([getattr(street, name) for street in chosen])
            for name in ("at", "half_width", "pavement", "rise"))
        kerbs_low, kerbs_high = self.at - self.half_width, self.at + self.half_width
        self._borders = (kerbs_high[:-1] + kerbs_low[1:]) / 2

    def nearest(self, across: np.ndarray) -> np.ndarray:
        """For each place across the streets the number of the street whose kerb is nearest."""
        return np.searchsorted(self._borders, across)


def _kerb_distance(beyond_u: np.ndarray, beyond_v: np.ndarray) -> np.ndarray:
    """Distance from the kerb, which is rounded at the corners; 0 or less on the carriageway."""
    kerb = np.minimum(beyond_u, beyond_v)
    corner = (kerb > 0) & (np.maximum(beyond_u, beyond_v) < KERB_RADIUS)
    return np.where(corner, KERB_RADIUS - np.hypot(KERB_RADIUS - beyond_u, KERB_RADIUS - beyond_v), kerb)
