"""The things that the sample city is made of. Metres, degrees and projected coordinates throughout."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
import shapely

AERIAL = "aerial"
GROUND = "ground"
EPOCHS = (AERIAL, GROUND)
"""When something is there: at the flights (frames and ALS), or at the drives (mobile survey, GNSS)."""


class Material(IntEnum):
    """What a surface is made of."""

    ASPHALT = 1
    PAINT_WHITE = 2
    PAINT_YELLOW = 3
    PAVEMENT = 4
    PLOT = 5
    FACADE = 6
    GLASS = 7
    ROOF = 8
    PARAPET = 9
    STRUCTURE = 10
    VEHICLE = 11
    FOLIAGE = 12
    WOOD = 13
    METAL = 14
    BRIDGE = 15


REFLECTANCE = np.array([0, 0.12, 0.62, 0.45, 0.24, 0.28, 0.40, 0.06, 0.25, 0.60, 0.35, 0.35, 0.45, 0.25, 0.30, 0.33])
"""Diffuse reflectance of each `Material` in the near infrared (0 to 1), indexed by its number."""

COLOUR = np.array([[0, 0, 0], [84, 85, 88], [222, 222, 216], [205, 170, 60], [142, 138, 132], [126, 124, 116],
                   [165, 158, 148], [70, 84, 96], [128, 130, 128], [206, 206, 202], [150, 152, 154], [150, 20, 24],
                   [62, 92, 48], [92, 74, 56], [120, 122, 124], [150, 148, 144]], dtype=np.uint8)
"""Base colour (red, green, blue) of each `Material` in full light, indexed by its number."""


class FaceKind(IntEnum):
    """What part of a thing a face is."""

    WALL = 1
    ROOF = 2
    PARAPET_TOP = 3
    PARAPET_INSIDE = 4
    STRUCTURE = 5
    FURNITURE = 6
    VEHICLE = 7
    BRIDGE = 8
    FRONT = 9


@dataclass(frozen=True)
class Faces:
    """Flat convex faces with three or four corners, seen from both sides.

    Attributes
    ----------
    corners : (n, 4, 3) in order around the face, anticlockwise seen from outside; a triangle has its last corner twice.
    normal : (n, 3) unit vectors that point outwards.
    offset : (n,) with normal . point = offset on the face.
    material : (n,) `Material`.
    kind : (n,) `FaceKind`.
    colour : (n, 3) uint8, base colour in full light.
    building : (n,) id of the building, -1 for other things.
    part : (n,) number of the part within the building (`Building.parts`), -1 for other things.
    """

    corners: np.ndarray
    normal: np.ndarray
    offset: np.ndarray
    material: np.ndarray
    kind: np.ndarray
    colour: np.ndarray
    building: np.ndarray
    part: np.ndarray

    def __len__(self) -> int:
        return len(self.corners)


@dataclass(frozen=True)
class Structure:
    """A box on a roof: penthouse, lift tower, machine."""

    plan: shapely.Polygon
    height: float


@dataclass(frozen=True)
class RoofPart:
    """A part of a building with one roof; the parts of a building touch and do not overlap.

    Attributes
    ----------
    plan : outline of its walls.
    z_roof : height of the flat roof within its parapet; of the eaves for a gable.
    parapet_width, parapet_height : 0 without a parapet.
    z_ridge : height of the ridge for a gable (a rectangle whose ridge runs along its longer side), else None.
    structures : boxes on the roof.
    """

    plan: shapely.Polygon
    z_roof: float
    parapet_width: float = 0.0
    parapet_height: float = 0.0
    z_ridge: float | None = None
    structures: tuple[Structure, ...] = ()

    @property
    def z_top(self) -> float:
        """Height of the parapet's top, or of the roof (eaves) without one."""
        return self.z_roof + self.parapet_height


@dataclass(frozen=True)
class Building:
    """A building. `id` counts from 1; `shape` is rectangle, L, T, U, podium, curved, gable; `z_base` its foot."""

    id: int
    shape: str
    z_base: float
    parts: tuple[RoofPart, ...]
    wall_colour: tuple[int, int, int]
    roof_colour: tuple[int, int, int]

    @property
    def outline(self) -> shapely.Polygon:
        """Plan of its walls."""
        hair = 1e-3
        grown = shapely.union_all([part.plan.buffer(hair, join_style="mitre") for part in self.parts])
        return grown.buffer(-hair, join_style="mitre").simplify(2 * hair)


@dataclass(frozen=True)
class Marking:
    """A painted marking.

    Attributes
    ----------
    plan : its polygon.
    kind : "lane", "centre", "edge", "zebra", "stop", "arrow", "diamond", "chevron", "text", "tactile", "bay".
    colour : "white" or "yellow".
    wear : share of the paint that is gone, 0 to 1.
    aerial, ground : whether it is there at the flights and at the drives.
    private : on a private lot.
    """

    plan: shapely.Polygon
    kind: str
    colour: str = "white"
    wear: float = 0.0
    aerial: bool = True
    ground: bool = True
    private: bool = False


@dataclass(frozen=True)
class Tree:
    """A tree: a crown that is an ellipsoid (`z` its centre) and a square trunk of `trunk` m.

    A beam that passes through the crown meets leaves at a mean free path of `free_path` m.
    """

    x: float
    y: float
    z: float
    radius: float
    radius_z: float
    z_ground: float
    trunk: float
    free_path: float = 1.6


@dataclass(frozen=True)
class Lane:
    """A lane: straight from `start` to `end` (x, y), in the direction of its traffic (on the left).

    `survey` lanes are free of moving vehicles at the drives.
    """

    street: str
    start: tuple[float, float]
    end: tuple[float, float]
    width: float
    survey: bool = False

    @property
    def length(self) -> float:
        """Length, m."""
        return float(np.hypot(self.end[0] - self.start[0], self.end[1] - self.start[1]))

    @property
    def heading(self) -> float:
        """Direction, degrees clockwise from grid north."""
        return float(np.degrees(np.arctan2(self.end[0] - self.start[0], self.end[1] - self.start[1])) % 360.0)


@dataclass(frozen=True)
class Vehicle:
    """A vehicle of two boxes: the body from 0.2 m above the ground up, and the cabin on it.

    It runs along `lane` for ever: at time t it is (place + speed t) modulo the lane's length from the start.
    A parked vehicle has the speed 0 and a lane of its own.

    Attributes
    ----------
    length, width : of the body.
    height : of the body's top.
    cabin : (from, to, height): reach along the vehicle (m from its middle, forward positive) and its top.
    epochs : when it is there.
    """

    lane: Lane
    place: float
    speed: float
    length: float
    width: float
    height: float
    cabin: tuple[float, float, float]
    colour: tuple[int, int, int]
    epochs: tuple[str, ...] = EPOCHS

    def position(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """x and y of its middle at the times (s), each shaped as `time`."""
        share = (self.place + self.speed * np.asarray(time, float)) % self.lane.length / self.lane.length
        (x0, y0), (x1, y1) = self.lane.start, self.lane.end
        return x0 + (x1 - x0) * share, y0 + (y1 - y0) * share

    def boxes(self) -> np.ndarray:
        """(2, 2, 3): for body and cabin the least and greatest (forward, left, up from the ground)."""
        half, side = self.length / 2, self.width / 2
        back, front, top = self.cabin
        return np.array([[[-half, -side, 0.2], [half, side, self.height]],
                         [[back, -side + 0.08, self.height], [front, side - 0.08, top]]])


@dataclass(frozen=True)
class Crowns:
    """Crowns of trees as arrays: centre (n, 3), radii (n, 3), mean free path of a beam (n,)."""

    centre: np.ndarray
    radii: np.ndarray
    free_path: np.ndarray


@dataclass(frozen=True)
class Furniture:
    """Things of the street as boxes, each given by a plan rectangle and its heights."""

    plan: shapely.Polygon
    z_low: float
    z_high: float
    material: Material = Material.METAL
    kind: FaceKind = FaceKind.FURNITURE
    slope: tuple[float, float] = field(default=(0.0, 0.0))
    """Rise of its top and bottom per metre of x and y, from the plan's centroid (the deck of a bridge)."""
    standing: str = ""
    """Of a post: the kind of street object that it carries, where that is known."""


@dataclass(frozen=True)
class StandingBefore:
    """What stands before a building's front, and is no wall of it but for the storeys over pilotis.

    Attributes
    ----------
    building : id of the building.
    kind : "canopy", "sign band", "garden wall", "hoarding", "balcony", "awning" or "pilotis".
    line : its outer face from above, at the height of its foot.
    before : how far that lies before the wall, m.
    z_low, z_high : heights of the face.
    boxes : what it is made of.
    """

    building: int
    kind: str
    line: shapely.MultiLineString
    before: float
    z_low: float
    z_high: float
    boxes: tuple[Furniture, ...]
