"""Trees, street furniture, the elevated road, parked and moving vehicles."""

from __future__ import annotations

import numpy as np
import shapely
from shapely import affinity

from .ground import Ground, Street
from .model import AERIAL, EPOCHS, FaceKind, Furniture, Lane, Material, Tree, Vehicle

CROSSING_CLEAR = 16.0
"""No trees or parked cars closer than this to the kerb line of a crossing street, m."""

_PAINTS = ((232, 232, 230), (235, 235, 235), (28, 28, 30), (52, 54, 58), (150, 152, 156), (168, 24, 28), (36, 62, 120),
           (120, 124, 110))


def make_trees(ground: Ground, size: float, rng: np.random.Generator) -> tuple[Tree, ...]:
    """Trees along the avenue's pavements, some along the street, in uneven rows."""
    trees = []
    for name, spacing in (("A", 8.0), ("B", 11.0)):
        street = next(s for s in ground.streets if s.name == name)
        for side in (1, -1):
            for u in np.arange(-size / 2 + 4.0, size / 2 - 4.0, spacing):
                along = u + rng.uniform(-1.5, 1.5)
                across = street.at + side * (street.half_width + 0.8)
                radius, radius_z = rng.uniform(1.4, 2.4), rng.uniform(1.6, 2.8)
                height, keep = rng.uniform(2.4, 3.4), rng.random() < 0.8
                if not keep or not is_clear(ground, street, along, 12.0):
                    continue
                x, y = world_place(ground, street, along, across)
                z = float(ground.height(x, y))
                trees.append(Tree(x, y, z + height + radius_z, float(radius), float(radius_z), z, 0.25))
    return tuple(trees)


def make_furniture(ground: Ground, size: float, scene: str, trees: tuple[Tree, ...], rng: np.random.Generator,
                   posts: bool = True) -> tuple[Furniture, ...]:
    """Trunks, guard rails, cabinets, the elevated road; with `posts` lamp posts and signals at the main crossing."""
    things = [Furniture(_square(t.x, t.y, t.trunk), t.z_ground - 0.1, t.z - 0.3 * t.radius_z, Material.WOOD)
              for t in trees]
    for name in ("A", "B"):
        street = next(s for s in ground.streets if s.name == name)
        for side in (1, -1):
            for along in np.arange(-size / 2 + 10.0, size / 2 - 8.0, 27.0):
                if posts and is_clear(ground, street, along, 8.0):
                    things.append(_post(ground, street, along, side, 8.5))
            for start in np.arange(-size / 2 + 6.0, size / 2 - 10.0, 15.0):
                if is_clear(ground, street, start, 12.0) and is_clear(ground, street, start + 6.0, 12.0):
                    things.append(_rail(ground, street, start, start + 6.0, side))
            along = float(rng.uniform(20.0, size / 2))
            if is_clear(ground, street, along):
                things.append(_cabinet(ground, street, along, side))
    if posts:
        things += _signals(ground)
    if scene == "elevated road":
        things += _elevated_road(ground, size)
    return tuple(things)


def make_parked(ground: Ground, size: float, rng: np.random.Generator) -> tuple[Vehicle, ...]:
    """Vehicles parked along the kerbs, others at the flights than at the drives; and on the parking lots."""
    vehicles = []
    for epoch in EPOCHS:
        for street in ground.streets:
            if street.half_width < 4.0:
                continue
            for side in (1, -1):
                for along in np.arange(-size / 2 + 3.0, size / 2 - 3.0, 7.0):
                    chance, jitter = rng.random(), rng.uniform(-0.5, 0.5)
                    if chance > 0.22 or not is_clear(ground, street, along):
                        continue
                    across = street.at + side * (street.half_width - 1.1)
                    turned = side < 0 if street.along == "u" else side > 0
                    vehicles.append(_parked(ground, street, along + jitter, across, turned, (epoch,), rng))
    for lot in ground.parking:
        u, v = ground.to_local(*shapely.get_coordinates(lot).T)
        for along in np.arange(u.min() + 1.85, u.max() - 1.5, 2.5):
            if rng.random() < 0.55:
                lane = Street("lot", "v", float(along), 1.0, 0.0, 1)
                vehicles.append(_parked(ground, lane, float(v.min()) + 3.2, float(along), True, EPOCHS, rng))
    return tuple(vehicles)


def make_traffic(lanes: tuple[Lane, ...], rng: np.random.Generator) -> tuple[Vehicle, ...]:
    """Moving vehicles: in each lane all at one speed, so that they never meet; none in survey lanes at the drives."""
    vehicles = []
    for lane in lanes:
        side_street = lane.width < 3.0
        speed, place = float(rng.uniform(6.0, 12.0)), float(rng.uniform(0.0, 25.0))
        while place < lane.length - 14.0:
            vehicle = _vehicle(lane, place, speed, (AERIAL,) if lane.survey else EPOCHS, rng, cars_only=side_street)
            vehicles.append(vehicle)
            place += vehicle.length + float(rng.uniform(9.0, 60.0 if not side_street else 120.0))
    return tuple(vehicles)


def _vehicle(lane: Lane, place: float, speed: float, epochs: tuple[str, ...], rng: np.random.Generator,
             cars_only: bool = False) -> Vehicle:
    colour = _PAINTS[int(rng.integers(len(_PAINTS)))]
    kind = rng.random()
    if kind < 0.75 or cars_only:
        length = float(rng.uniform(3.9, 4.8))
        cabin = (-length / 2 + 0.3, length / 2 - 1.2, 1.5)
        return Vehicle(lane, place, speed, length, 1.75, 0.95, cabin, colour, epochs)
    if kind < 0.92:
        return Vehicle(lane, place, speed, 7.2, 2.2, 1.0, (-3.6, 1.6, 3.1), colour, epochs)
    return Vehicle(lane, place, speed, 10.5, 2.5, 1.1, (-5.25, 5.25, 3.0), colour, epochs)


def _parked(ground: Ground, street: Street, along: float, across: float, turned: bool, epochs: tuple[str, ...],
            rng: np.random.Generator) -> Vehicle:
    """A vehicle that stands along the street, facing back along it if `turned`."""
    ends = [world_place(ground, street, along + step, across) for step in (-0.5, 0.5)]
    start, end = reversed(ends) if turned else ends
    return _vehicle(Lane(street.name, start, end, 2.0), 0.5, 0.0, epochs, rng, cars_only=True)


def world_place(ground: Ground, street: Street, along: float, across: float) -> tuple[float, float]:
    """x, y of a place given along and across (v, or u for a street along v) a street."""
    u, v = (along, across) if street.along == "u" else (across, along)
    x, y = ground.to_world(u, v)
    return float(x), float(y)


def is_clear(ground: Ground, street: Street, along: float, distance: float = CROSSING_CLEAR) -> bool:
    """Whether no crossing street is near the place along the street."""
    return all(abs(along - other.at) > other.half_width + distance
               for other in ground.streets if other.along != street.along)


def _square(x: float, y: float, side: float, angle: float = 0.0) -> shapely.Polygon:
    plan = shapely.box(x - side / 2, y - side / 2, x + side / 2, y + side / 2)
    return affinity.rotate(plan, angle, origin=(x, y)) if angle else plan


def _plan(ground: Ground, street: Street, along: tuple[float, float], across: tuple[float, float]) -> shapely.Polygon:
    box = shapely.box(along[0], across[0], along[1], across[1])
    if street.along == "v":
        box = shapely.box(across[0], along[0], across[1], along[1])
    return ground.plan_to_world(box)


def _standing(ground: Ground, plan: shapely.Polygon, height: float, material: Material = Material.METAL) -> Furniture:
    z = float(ground.height(plan.centroid.x, plan.centroid.y))
    return Furniture(plan, z - 0.2, z + height, material)


def _post(ground: Ground, street: Street, along: float, side: int, height: float) -> Furniture:
    across = street.at + side * (street.half_width + 0.45)
    plan = _plan(ground, street, (along - 0.09, along + 0.09), (across - 0.09, across + 0.09))
    return _standing(ground, plan, height)


def _rail(ground: Ground, street: Street, start: float, end: float, side: int) -> Furniture:
    across = street.at + side * (street.half_width + 0.3)
    return _standing(ground, _plan(ground, street, (start, end), (across - 0.04, across + 0.04)), 0.8)


def _cabinet(ground: Ground, street: Street, along: float, side: int) -> Furniture:
    across = street.at + side * (street.half_width + 1.0)
    return _standing(ground, _plan(ground, street, (along, along + 0.9), (across - 0.2, across + 0.2)), 1.3)


def _signals(ground: Ground) -> list[Furniture]:
    """Four signal posts at the crossing of the avenue and the street, each with an arm and lamps above the lanes."""
    avenue, street = ground.streets[:2]
    things = []
    for side in (1, -1):
        for end in (1, -1):
            u, v = end * (street.half_width + 2.2), side * (avenue.half_width + 2.2)
            plan = ground.plan_to_world(_square(u, v, 0.22))
            post = _standing(ground, plan, 6.4)
            arm = ground.plan_to_world(shapely.box(u - 0.06, min(v, v - side * 4.5), u + 0.06, max(v, v - side * 4.5)))
            lamps = ground.plan_to_world(_square(u, v - side * 4.5, 0.9))
            z = post.z_high - 1.0
            things += [post, Furniture(arm, z, z + 0.12), Furniture(lamps, z - 0.15, z + 0.35)]
    return things


def rails_and_decks(ground: Ground, size: float) -> tuple[Furniture, ...]:
    """Unbroken rails on the kerbs of the main streets, and decks for walkers above one of their pavements."""
    things = []
    for street in (s for s in ground.streets if s.name in ("A", "B")):
        for start in np.arange(-size / 2, size / 2 - 10.0, 10.0):
            if not (is_clear(ground, street, start, 10.0) and is_clear(ground, street, start + 10.0, 10.0)):
                continue
            things += [_rail(ground, street, start, start + 10.0, side) for side in (1, -1)]
            across = street.at + street.half_width
            plan = _plan(ground, street, (start, start + 10.0), (across + 0.2, across + 2.4))
            z = float(ground.height(plan.centroid.x, plan.centroid.y))
            things.append(Furniture(plan, z + 4.8, z + 5.2, Material.BRIDGE, FaceKind.BRIDGE))
    return tuple(things)


def _elevated_road(ground: Ground, size: float) -> list[Furniture]:
    """A motorway on piers above the avenue: a deck 13 m wide, its barriers, and a pier on the kerb every 24 m."""
    avenue = ground.streets[0]
    half_extent, half = size / 2 + 30.0, 6.5
    x, y = ground.to_world(np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    east = np.array([[x[1] - x[0], y[1] - y[0]], [x[2] - x[0], y[2] - y[0]]])
    slope = tuple(float(s) for s in np.linalg.solve(east, [ground.slope[0], 0.0]))
    z = ground.z0 + 8.5
    bridge = {"material": Material.BRIDGE, "kind": FaceKind.BRIDGE, "slope": slope}
    things = [Furniture(_plan(ground, avenue, (-half_extent, half_extent), (-half, half)), z, z + 1.6, **bridge)]
    things += [Furniture(_plan(ground, avenue, (-half_extent, half_extent), (side * half - 0.15, side * half + 0.15)),
                         z + 0.8, z + 2.6, **bridge) for side in (1, -1)]
    for along in np.arange(-size / 2 + 6.0, size / 2, 24.0):
        if is_clear(ground, avenue, along, 10.0):
            for side in (1, -1):
                across = side * (avenue.half_width + 0.6)
                plan = _plan(ground, avenue, (along - 0.6, along + 0.6), (across - 0.5, across + 0.5))
                things.append(_standing(ground, plan, 9.0 + ground.slope[0] * along, Material.BRIDGE))
            beam = _plan(ground, avenue, (along - 0.7, along + 0.7),
                         (-avenue.half_width - 1.1, avenue.half_width + 1.1))
            low = z - 1.3 + ground.slope[0] * along
            things.append(Furniture(beam, low, low + 1.4, Material.BRIDGE, FaceKind.BRIDGE))
    return things
