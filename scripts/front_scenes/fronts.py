"""Fronts of each kind: the facade, what stands before it, the outline that a map gives, and the truth.

A front is `width` long along x from 0; its main wall lies at y = 0 unless its truth says otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import shapely

from .parts import GLASS, WINDOWS, Face, box, level, side, upright

STOREY, DEPTH = 3.0, 9.0


@dataclass(eq=False)
class Front:
    """A front.

    Attributes
    ----------
    kind : see `KINDS`.
    width, height, depth : of the building, m.
    faces : all that a beam may meet, but for the street.
    rooms : faces met by beams that went through glass.
    wall : pieces (x0, x1, y) of the main wall; what the model's wall has to follow.
    outer : pieces of the outermost front of the building's own: balconies, storeys over columns, bays.
    before : (kind, y) of the upright faces that stand before the main wall.
    off : distance (m) by which the outline stands before (below 0) or behind the main wall.
    """

    kind: str
    width: float
    height: float
    faces: list[Face] = field(default_factory=list)
    rooms: list[Face] = field(default_factory=list)
    wall: list[tuple[float, float, float]] = field(default_factory=list)
    outer: list[tuple[float, float, float]] = field(default_factory=list)
    before: list[tuple[str, float]] = field(default_factory=list)
    off: float = 0.0
    depth: float = DEPTH

    @property
    def outline(self) -> shapely.Polygon:
        """The building's outline on the map."""
        y = min(piece[2] for piece in self.outer) if self.kind == "pilotis" else 0.0
        return shapely.box(0.0, y + self.off, self.width, self.depth)

    @property
    def nearest(self) -> float:
        """Least y of anything, m."""
        return min([0.0, *(float(face.corners[:, 1].min()) for face in self.faces)])


def plain(front: Front, rng: np.random.Generator, y: float = 0.0, low: float = 0.0, kind: int = WINDOWS) -> None:
    """A wall with windows from `low` to the top, with its body and rooms behind it."""
    front.faces += box(0.0, front.width, y, front.depth, low, front.height, kind)
    back = rng.uniform(2.5, 4.5)
    front.rooms.append(upright(0.0, front.width, y + back, low, front.height))
    storeys = np.arange(low, front.height + 0.1, STOREY)
    front.rooms += [level(0.0, front.width, y + 0.1, y + back, float(z)) for z in storeys]
    front.wall = [(0.0, front.width, y)]
    front.outer = list(front.wall)


def canopy(front: Front, rng: np.random.Generator) -> None:
    """A flat roof over the entrance floor with a fascia."""
    plain(front, rng)
    before, low = rng.uniform(0.8, 3.0), rng.uniform(2.6, 3.6)
    left, right = sorted((rng.uniform(0, 0.2) * front.width, rng.uniform(0.75, 1.0) * front.width))
    front.faces += box(left, right, -before, -0.02, low, low + rng.uniform(0.35, 1.0))
    front.before.append(("canopy", -before))


def sign_band(front: Front, rng: np.random.Generator) -> None:
    """A sign along the front over the entrance floor."""
    plain(front, rng)
    before, low = rng.uniform(0.35, 1.5), rng.uniform(2.7, 3.4)
    left, right = rng.uniform(0, 1), front.width - rng.uniform(0, 1)
    front.faces += box(left, right, -before, -0.02, low, low + rng.uniform(0.7, 1.8))
    front.before.append(("sign", -before))


def garden_wall(front: Front, rng: np.random.Generator) -> None:
    """A block wall on the border of the plot, with a gate."""
    plain(front, rng)
    before, high = rng.uniform(0.8, 3.0), rng.uniform(1.2, 1.8)
    gate = rng.uniform(0.1, 0.8) * front.width
    front.faces += box(-2.0, gate, -before - 0.12, -before, 0.0, high)
    front.faces += box(gate + 1.5, front.width + 2.0, -before - 0.12, -before, 0.0, high)
    front.before.append(("garden wall", -before - 0.12))


def hoarding(front: Front, rng: np.random.Generator) -> None:
    """A closed fence of a building site."""
    plain(front, rng)
    before, high = rng.uniform(0.8, 2.5), rng.uniform(2.0, 3.0)
    front.faces += box(-2.0, front.width + 2.0, -before - 0.05, -before, 0.0, high)
    front.before.append(("hoarding", -before - 0.05))


def balconies(front: Front, rng: np.random.Generator, whole: bool | None = None) -> None:
    """A parapet on a slab before every upper storey, along the whole front or part of it."""
    front.height = max(front.height, 3 * STOREY + 0.5)
    plain(front, rng)
    before, high = rng.uniform(1.0, 1.8), rng.uniform(1.0, 1.3)
    whole = rng.random() < 0.6 if whole is None else whole
    right = front.width if whole else rng.uniform(0.5, 0.8) * front.width
    for z in np.arange(STOREY, front.height - 1.5, STOREY).tolist():
        front.faces += [upright(0.0, right, -before, z - 0.2, z + high), level(0.0, right, -before, 0.0, z - 0.2),
                        level(0.0, right, -before, 0.0, z), side(0.0, -before, 0.0, z - 0.2, z + high),
                        side(right, -before, 0.0, z - 0.2, z + high), upright(0.0, right, -before + 0.15, z, z + high)]
    front.before.append(("balcony", -before))
    front.outer = [(0.0, right, -before)] + ([] if whole else [(right, front.width, 0.0)])


def pilotis(front: Front, rng: np.random.Generator) -> None:
    """Upper storeys on columns; the wall of the ground floor stands back."""
    front.height = max(front.height, 3 * STOREY)
    back, low = rng.uniform(2.0, 4.0), rng.uniform(2.8, 3.4)
    plain(front, rng, low=low)
    front.faces += box(0.5, front.width - 0.5, back, front.depth, 0.0, low)
    for x in np.linspace(0.0, front.width - 0.5, int(front.width / 4) + 1).tolist():
        front.faces += box(x, x + 0.5, 0.05, 0.55, 0.0, low)


def awning(front: Front, rng: np.random.Generator) -> None:
    """A cloth that slopes away from the front, with an edge that hangs down."""
    plain(front, rng)
    before, low = rng.uniform(0.9, 1.8), rng.uniform(2.2, 2.6)
    left, right = rng.uniform(0, 0.3) * front.width, rng.uniform(0.7, 1.0) * front.width
    front.faces += [level(left, right, -before, -0.02, low + 0.3, low + 0.3 + before * 0.4),
                    upright(left, right, -before, low, low + 0.3)]


def bay(front: Front, rng: np.random.Generator) -> None:
    """A part of the front that stands out, from the ground to the top."""
    out = rng.uniform(0.5, 1.0)
    left = rng.uniform(0.25, 0.4) * front.width
    right = left + rng.uniform(0.25, 0.35) * front.width
    plain(front, rng)
    front.faces += box(left, right, -out, 0.0, 0.0, front.height, WINDOWS)
    front.rooms.append(upright(left, right, 2.0, 0.0, front.height))
    front.wall = [(0.0, left, 0.0), (left, right, -out), (right, front.width, 0.0)]
    front.outer = list(front.wall)


def _step(front: Front, rng: np.random.Generator, back: float) -> None:
    """An L in plan: part of the front stands back from the ground to the top."""
    at = rng.uniform(0.35, 0.65) * front.width
    front.faces += box(0.0, at, 0.0, front.depth, 0.0, front.height, WINDOWS)
    front.faces += box(at, front.width, back, front.depth, 0.0, front.height, WINDOWS)
    front.rooms.append(upright(0.0, front.width, back + rng.uniform(2.5, 3.5), 0.0, front.height))
    front.wall = [(0.0, at, 0.0), (at, front.width, back)]
    front.outer = list(front.wall)


def step_small(front: Front, rng: np.random.Generator) -> None:
    """A step of 1.5 m in plan."""
    _step(front, rng, 1.5)


def step_large(front: Front, rng: np.random.Generator) -> None:
    """A step of 3 m in plan."""
    _step(front, rng, 3.0)


def upper_setback(front: Front, rng: np.random.Generator) -> None:
    """Storeys from the second on stand back by 1.5 m."""
    low = STOREY if front.height < 3 * STOREY else 2 * STOREY
    front.faces += box(0.0, front.width, 0.0, front.depth, 0.0, low, WINDOWS)
    front.faces += box(0.0, front.width, 1.5, front.depth, low, front.height, WINDOWS)
    front.rooms.append(upright(0.0, front.width, 4.5, 0.0, front.height))
    front.wall = [(0.0, front.width, 0.0)]
    front.outer = list(front.wall)


def glass(front: Front, rng: np.random.Generator) -> None:
    """A front of glass between slabs and posts, with rooms behind that send most beams back."""
    plain(front, rng, kind=GLASS)
    for z in np.arange(0.0, front.height + 0.1, STOREY).tolist():
        front.faces.append(upright(0.0, front.width, -0.03, max(z - 0.25, 0.0), z + 0.25))
    for x in np.linspace(0.0, front.width - 0.1, int(front.width / 1.5) + 1).tolist():
        front.faces.append(upright(x, x + 0.08, -0.03, 0.0, front.height))


def pilasters(front: Front, rng: np.random.Generator) -> None:
    """Posts before the wall."""
    plain(front, rng)
    out = rng.uniform(0.3, 0.6)
    for x in np.linspace(0.0, front.width - 0.6, int(front.width / 4) + 1).tolist():
        front.faces += box(x, x + 0.6, -out, 0.0, 0.0, front.height)
    front.before.append(("pilaster", -out))


def ribbons(front: Front, rng: np.random.Generator) -> None:
    """Bands of wall and of glass in turn, on columns before a ground floor that stands back."""
    front.height = 3 * STOREY + 0.4
    plain(front, rng, low=STOREY, kind=GLASS)
    back = rng.uniform(1.2, 2.5)
    front.faces += box(0.5, front.width - 0.5, back, front.depth, 0.0, STOREY)
    for z in np.arange(STOREY, front.height, STOREY).tolist():
        front.faces.append(upright(0.0, front.width, -0.06, z, min(z + 1.2, front.height)))
    front.wall = [(0.0, front.width, -0.06)]
    front.outer = list(front.wall)


def street(front: Front, rng: np.random.Generator) -> None:
    """A garden wall, balconies and a canopy before one front."""
    balconies(front, rng)
    high = rng.uniform(1.2, 1.8)
    before = -min(y for _, y in front.before) + rng.uniform(0.4, 1.2)
    front.faces += box(-2.0, front.width * 0.6, -before - 0.12, -before, 0.0, high)
    front.faces += box(0.7 * front.width, 0.95 * front.width, -1.2, -0.02, 2.3, 2.6)
    front.before.append(("garden wall", -before - 0.12))


KINDS: dict[str, Callable[[Front, np.random.Generator], None]] = {
    "plain": plain, "canopy": canopy, "sign band": sign_band, "garden wall": garden_wall, "hoarding": hoarding,
    "balconies": balconies, "pilotis": pilotis, "awning": awning, "bay": bay, "step 1.5 m": step_small,
    "step 3 m": step_large, "upper setback": upper_setback, "glass": glass, "pilasters": pilasters,
    "garden wall, balconies": street, "windows in ribbons": ribbons}
"""What makes a front of each kind."""


def make_front(kind: str, seed: int) -> Front:
    """A front: 8 to 20 m long, of two to five storeys, its outline up to 0.5 m off, with cars before some."""
    rng = np.random.default_rng([seed, sorted(KINDS).index(kind)])
    front = Front(kind, rng.uniform(8.0, 20.0), STOREY * int(rng.integers(2, 6)) + rng.uniform(0.3, 0.8))
    KINDS[kind](front, rng)
    front.off = float(rng.choice([-0.3, 0.3, rng.uniform(-0.5, 0.5)]))
    lane = front.nearest - rng.uniform(0.4, 1.0)
    for _ in range(int(rng.integers(0, 3))):
        x = rng.uniform(-4.0, front.width)
        front.faces += box(x, x + 4.4, lane - 1.7, lane, 0.3, 0.9)
        front.faces += box(x + 1.0, x + 3.6, lane - 1.6, lane - 0.1, 0.9, 1.5)
    return front
