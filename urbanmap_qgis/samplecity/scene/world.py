"""The true world of the sample city, and the questions that sensors ask of it.

Everything is in projected coordinates of EPSG:6677 (x east, y north, m) with orthometric heights (m). Times are
GPS seconds. An epoch is `AERIAL` (flights: frames and ALS) or `GROUND` (drives: mobile survey, GNSS).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from datetime import date
from functools import cached_property

import numpy as np
import shapely

from ...errors import InputError
from ...wording import say
from ..faults import checked_faults, fault_rng
from .buildings import make_buildings
from .faces import Boxes, building_faces, furniture_faces, join, vehicle_boxes
from .fronts import standing_before
from .furniture import make_furniture, make_parked, make_traffic, make_trees, rails_and_decks
from .gantries import gantries
from .ground import Ground, Surface
from .markings import beside_islands, make_markings, worn_and_patched
from .model import (
    AERIAL,
    GROUND,
    Building,
    Crowns,
    Faces,
    Furniture,
    Lane,
    Marking,
    Material,
    StandingBefore,
    Tree,
    Vehicle,
)
from .paint import Paint
from .signs import signs_and_bollards
from .standard_furniture import DESIGNS, standard_furniture
from .streets import lowered_kerbs, make_ground, make_lanes, median_islands

CRS = "EPSG:6677"
SURVEYED = date(2024, 4, 1)
ORIGIN = (-6950.0, -34100.0)
SCENES = ("canyon", "few markings", "repainted", "elevated road")
MIN_SIZE, MAX_SIZE = 60.0, 600.0

# GPS seconds at which the sensors start: flights on one day, drives on another.
AERIAL_TIME, ALS_TIME, SURVEY_TIMES = 181200.0, 184800.0, (361400.0, 366800.0)


@dataclass(frozen=True)
class Scene:
    """The city as it truly is.

    Attributes
    ----------
    name : one of `SCENES`.
    size : side of the square of the city, m (the square is rotated by `ground.angle`).
    ground : `Ground` (height, kerbs, axes u and v of the streets: `to_local`, `to_world`, `streets`).
    buildings, markings, trees, furniture, lanes, vehicles : the things in it.
    faults : of `faults.FAULTS`, that its surveys have.
    before_fronts : what stands before the fronts; its boxes are furniture too.
    """

    name: str
    size: float
    ground: Ground
    buildings: tuple[Building, ...]
    markings: tuple[Marking, ...]
    trees: tuple[Tree, ...]
    furniture: tuple[Furniture, ...]
    lanes: tuple[Lane, ...]
    vehicles: tuple[Vehicle, ...]
    faults: tuple[str, ...] = ()
    before_fronts: tuple[StandingBefore, ...] = ()

    @cached_property
    def extent(self) -> shapely.Polygon:
        """The square of the city. Buildings stand within; ground and streets go on beyond."""
        half = self.size / 2
        return self.ground.plan_to_world(shapely.box(-half, -half, half, half))

    def ground_height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the bare ground (m) at the places; arrays of any one shape."""
        return self.ground.height(x, y)

    def surface_kind(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """`Surface` of the ground (uint8) at the places."""
        return self.ground.kind(x, y)

    def ground_material(self, x: np.ndarray, y: np.ndarray, epoch: str) -> np.ndarray:
        """`Material` of the ground (uint8) at the places, with the paint that is left on it."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        material = _SURFACE_MATERIAL[self.ground.kind(x, y)]
        painted = self.paint(epoch).material_at(x, y)
        return np.where(painted > 0, painted, material).astype(np.uint8)

    def paint(self, epoch: str) -> Paint:
        """Paint of an epoch: `.material_at(x, y)` gives `Material` or 0, `.marking_at(x, y)` a marking's number."""
        return self._paints[epoch]

    def markings_at(self, epoch: str) -> list[Marking]:
        """Markings that are there at the epoch."""
        return [marking for marking in self.markings if getattr(marking, epoch)]

    def static_faces(self, epoch: str) -> Faces:
        """Faces of all that does not move in that epoch: buildings, furniture, trunks, bridge, parked vehicles."""
        return self._static[epoch]

    def faces_at(self, time: float, epoch: str) -> Faces:
        """Static faces and those of the moving vehicles where they are at the time."""
        return join([self._static[epoch], self.vehicles_at(time, epoch, parked=False).faces()])

    def moving(self, epoch: str) -> list[Vehicle]:
        """Vehicles that move in that epoch."""
        return [vehicle for vehicle in self.vehicles if vehicle.speed and epoch in vehicle.epochs]

    def vehicles_at(self, time: float, epoch: str, *, parked: bool = True) -> Boxes:
        """Boxes of the vehicles (two each: body and cabin) where they are at the time."""
        vehicles = [vehicle for vehicle in self.vehicles
                    if epoch in vehicle.epochs and (parked or vehicle.speed)]
        return vehicle_boxes(vehicles, time, self.ground)

    @cached_property
    def crowns(self) -> Crowns:
        """Crowns of the trees as ellipsoids."""
        trees = self.trees
        return Crowns(np.array([[t.x, t.y, t.z] for t in trees]).reshape(-1, 3),
                      np.array([[t.radius, t.radius, t.radius_z] for t in trees]).reshape(-1, 3),
                      np.array([t.free_path for t in trees]))

    @cached_property
    def _paints(self) -> dict[str, Paint]:
        return {epoch: Paint(self.markings_at(epoch)) for epoch in (AERIAL, GROUND)}

    @cached_property
    def _static(self) -> dict[str, Faces]:
        fixed = [building_faces(self.buildings), furniture_faces(self.furniture)]
        return {epoch: join([*fixed, vehicle_boxes(
            [v for v in self.vehicles if not v.speed and epoch in v.epochs], 0.0, self.ground).faces()])
            for epoch in (AERIAL, GROUND)}


_SURFACE_MATERIAL = np.zeros(max(Surface) + 1, np.uint8)
_SURFACE_MATERIAL[[Surface.CARRIAGEWAY, Surface.PAVEMENT, Surface.PLOT, Surface.PARKING]] = [
    Material.ASPHALT, Material.PAVEMENT, Material.PLOT, Material.ASPHALT]


def make_scene(size: float = 200.0, scene: str = "canyon", seed: int | np.random.SeedSequence = 1,
               faults: Iterable[str] = ()) -> Scene:
    """Make the true world of a sample city.

    Parameters
    ----------
    size : side of the city's square, m (60 to 600).
    scene : one of `SCENES`: high-rise street canyon, a street with few markings, markings repainted between the
        flights and the drives, or an elevated road above the avenue.
    seed : the same seed gives the same city.
    faults : see `faults.FAULTS`.

    Raises
    ------
    InputError : the size, the scene or a fault is not one of those.
    """
    check_size(size)
    if scene not in SCENES:
        raise InputError(say("There is no scene {scene!r}: choose one of {scenes}.", scene=scene,
                             scenes=", ".join(SCENES)))
    sequence = seed if isinstance(seed, np.random.SeedSequence) else np.random.SeedSequence(seed)
    layout, built, painted, planted, furnished, parked, driven = (
        np.random.default_rng(child) for child in sequence.spawn(7))
    ground = make_ground(size, ORIGIN, layout)
    buildings, parking = make_buildings(ground, size, scene, built)
    ground = replace(ground, parking=parking)
    faults = checked_faults(faults)
    if "driveways" in faults:
        ground = replace(ground, lowered=lowered_kerbs(ground, size))
    if "islands" in faults:
        ground = replace(ground, islands=median_islands(ground, size))
    lanes = make_lanes(ground, size)
    trees = make_trees(ground, size, planted)
    markings = make_markings(ground, size, scene, painted)
    if "islands" in faults:
        markings = beside_islands(markings, ground)
    countries = [name for name in faults if name in DESIGNS]
    furniture = make_furniture(ground, size, scene, trees, furnished, not countries)
    for country in countries[:1]:
        furniture += standard_furniture(ground, size, country, trees, fault_rng(country, sequence))
    if "paint" in faults:
        markings = worn_and_patched(markings, fault_rng("paint", sequence))
    if "rails" in faults:
        furniture = (*furniture, *rails_and_decks(ground, size))
    if "signs" in faults:
        furniture = (*furniture, *signs_and_bollards(ground, size, fault_rng("signs", sequence)))
    if "gantries" in faults:
        furniture = (*furniture, *gantries(ground))
    before_fronts = standing_before(ground, buildings, fault_rng("fronts", sequence)) if "fronts" in faults else ()
    furniture = (*furniture, *(box for thing in before_fronts for box in thing.boxes))
    return Scene(scene, float(size), ground, buildings, markings, trees, furniture, lanes,
                 (*make_parked(ground, size, parked), *make_traffic(lanes, driven)), faults, before_fronts)


def check_size(size: float) -> None:
    """Raise `InputError` unless a city of that size (m) can be made."""
    if not MIN_SIZE <= size <= MAX_SIZE:
        raise InputError(say("The size of the city must be {min_size:g} to {max_size:g} m, not {size:g}.",
                             min_size=MIN_SIZE, max_size=MAX_SIZE, size=size))
