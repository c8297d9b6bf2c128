"""The ground of the sample city: a gentle slope, cambered streets, kerbs, pavements and plots.

Height is one closed formula of the place, so that every sensor can be checked against it exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
import shapely

KERB_HEIGHT = 0.15
KERB_RADIUS = 4.0
PAVEMENT_FALL = 0.02
PAVEMENT_REACH = 2.5
"""The pavement rises by `PAVEMENT_FALL` over its first metres from the kerb; all beyond lies as high as there."""

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
    along : "u" or "v".  at : place of its centre line on the other axis, m.
    half_width : from the centre line to the kerb.  pavement : width of each pavement.
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
class Ground:
    """Ground of the city. Public functions take projected x, y; u, v are the axes of the streets.

    Attributes
    ----------
    origin : x, y of the main crossing.  angle : direction of the u axis, degrees anticlockwise from east.
    z0 : height of the general plane at the origin.  slope : its rise per metre of u and v.
    wave : half height of the gentle undulation along u, m.
    streets : at least one along u and one along v.
    parking : polygons of parking lots (projected coordinates).
    """

    origin: tuple[float, float]
    angle: float
    z0: float
    slope: tuple[float, float]
    wave: float
    streets: tuple[Street, ...]
    parking: tuple[shapely.Polygon, ...] = ()

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
        across_u, across_v, kerb, _ = self._profile(u, v)
        shape_u, shape_v = np.minimum(across_u**2, 1.0), np.minimum(across_v**2, 1.0)
        rise_u, rise_v, rise_both = self._rises(u, v)
        camber = (rise_u * (1 - shape_u) * shape_v + rise_v * (1 - shape_v) * shape_u
                  + rise_both * (1 - shape_u) * (1 - shape_v))
        step = np.where(kerb > 0, KERB_HEIGHT + PAVEMENT_FALL * np.minimum(kerb, PAVEMENT_REACH), 0.0)
        return self._general(u, v) + camber + step

    def bounds_of_relief(self) -> tuple[float, float]:
        """Least and greatest difference of the height from the general plane z0 + slope . (u, v), m."""
        return (-self.wave, self.wave + max(
            max(street.rise for street in self.streets),
            KERB_HEIGHT + PAVEMENT_FALL * PAVEMENT_REACH))

    def plane(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the general plane, without undulation, camber and kerbs."""
        u, v = self.to_local(x, y)
        return self.z0 + self.slope[0] * u + self.slope[1] * v

    def kind(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """`Surface` at the places, uint8."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        _, _, kerb, pavement = self._profile(*self.to_local(x, y))
        kind = np.where(kerb <= 0, Surface.CARRIAGEWAY,
                        np.where(kerb <= pavement, Surface.PAVEMENT, Surface.PLOT)).astype(np.uint8)
        for lot in self.parking:
            shapely.prepare(lot)
            kind[shapely.contains_xy(lot, x, y) & (kind == Surface.PLOT)] = Surface.PARKING
        return kind

    def kerb_distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Distance from the nearest kerb into pavement or plot, m; 0 or less on the carriageway."""
        return self._profile(*self.to_local(x, y))[2]

    def _general(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return (self.z0 + self.slope[0] * u + self.slope[1] * v
                + self.wave * np.sin(2 * np.pi * (u + 0.4 * v) / WAVE_LENGTH))

    def _nearest(self, along: str, across: np.ndarray) -> tuple[np.ndarray, list[Street]]:
        """For each place the number of the nearest street of that direction, by its kerb."""
        streets = [street for street in self.streets if street.along == along]
        if len(streets) == 1:
            return np.zeros(np.shape(across), np.intp), streets
        reach = np.stack([np.abs(across - street.at) - street.half_width for street in streets])
        return reach.argmin(axis=0), streets

    def _profile(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
        """Place across the street along u and along v (1 at the kerb), kerb distance, pavement width."""
        near_u, streets_u = self._nearest("u", v)
        near_v, streets_v = self._nearest("v", u)
        at_u, half_u, walk_u = (_table(streets_u, name)[near_u] for name in ("at", "half_width", "pavement"))
        at_v, half_v, walk_v = (_table(streets_v, name)[near_v] for name in ("at", "half_width", "pavement"))
        beyond_u, beyond_v = np.abs(v - at_u) - half_u, np.abs(u - at_v) - half_v
        corner = (beyond_u > 0) & (beyond_v > 0) & (beyond_u < KERB_RADIUS) & (beyond_v < KERB_RADIUS)
        kerb = np.where(corner, KERB_RADIUS - np.hypot(KERB_RADIUS - beyond_u, KERB_RADIUS - beyond_v),
                        np.minimum(beyond_u, beyond_v))
        return (v - at_u) / half_u, (u - at_v) / half_v, kerb, np.where(beyond_u < beyond_v, walk_u, walk_v)

    def _rises(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        near_u, streets_u = self._nearest("u", v)
        near_v, streets_v = self._nearest("v", u)
        rise_u, rise_v = _table(streets_u, "rise")[near_u], _table(streets_v, "rise")[near_v]
        return rise_u, rise_v, np.maximum(rise_u, rise_v)


def _table(streets: list[Street], name: str) -> np.ndarray:
    return np.array([getattr(street, name) for street in streets])
