"""A vehicle's line scanners: when and whither their beams go, how bright the returns are, and what gets lost."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..faults import surface_factor
from ..laser.raycast import Hit, Hits, RayCaster
from ..laser.surfaces import hit_material
from ..scene.model import GROUND, REFLECTANCE, Material
from ..scene.paint import value_noise
from ..scene.world import Scene
from .trajectory import SimulatedTrajectory, mounting

# Ground is brighter and darker by this share (half to half) in spots of this size, m.
GRAIN = 0.2
GRAIN_SIZE = 0.35
# A beam lights a spot of this width (m) at the scanner, and wider by this for each metre of range.
APERTURE = 0.014
DIVERGENCE = 0.005
LOST = 0.004  # Share of beams whose return is lost for no reason seen.
GLASS_LOST = 0.5  # Share of the beams on glass that pass through it.

SPECKLE, NOISE = 0.09, 20.0
"""Of the intensity: share of the signal, and counts of the receiver (standard deviations)."""


@dataclass(frozen=True)
class Response:
    """How a scanner's receiver answers: intensity = gain reflectance cos(incidence)^tilt range^-fall + floor.

    The floor is why asphalt gets no darker beyond some range (J eq. 4, R1). Signals (without the floor) around
    `threshold` get lost.
    """

    gain: float
    fall: float
    tilt: float
    floor: float
    threshold: float

    def signal(self, reflectance: np.ndarray, distance: np.ndarray, cos_incidence: np.ndarray) -> np.ndarray:
        """Mean intensity above the floor, counts."""
        return self.gain * reflectance * cos_incidence**self.tilt * distance**-self.fall


@dataclass(frozen=True)
class SimulatedScanner:
    """A scanner that turns its beam in one plane.

    Attributes
    ----------
    id : also the points' source number.
    lever_arm : forward, right, down from the body's origin, m.
    roll, pitch, heading : of the scanner's axes in the body, degrees.
    angles : (k,) of the beams of one scan, degrees from the scanner's x axis towards its y axis.
    scan_hz : scans per second.
    sweep : share of the scan's period in which its beams are sent.
    max_range, min_range, range_noise : m.
    """

    id: int
    name: str
    lever_arm: tuple[float, float, float]
    roll: float
    pitch: float
    heading: float
    response: Response
    angles: np.ndarray
    scan_hz: float = 75.0
    sweep: float = 0.5
    max_range: float = 65.0
    min_range: float = 0.7
    range_noise: float = 0.01

    def scan_times(self, start: float, end: float) -> np.ndarray:
        """Times at which scans begin, whole within `start` to `end`."""
        count = int((end - start) * self.scan_hz - self.sweep) + 1
        return start + np.arange(max(count, 0)) / self.scan_hz

    def beam_times(self, scans: np.ndarray) -> np.ndarray:
        """Time of each beam (scans, k) of scans that begin at the given times."""
        return scans[:, None] + np.linspace(0.0, self.sweep / self.scan_hz, len(self.angles))

    def directions(self) -> np.ndarray:
        """Unit vectors (k, 3) of the beams in the body's axes."""
        angle = np.radians(self.angles)
        beams = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))])
        return beams @ mounting(self.roll, self.pitch, self.heading).T

    def rays(self, trajectory: SimulatedTrajectory, time: np.ndarray, beam: np.ndarray
             ) -> tuple[np.ndarray, np.ndarray]:
        """Where beams start and whither they go (n, 3), east, north, up, for times (n,) and numbers of beams (n,)."""
        place, rotation = trajectory.interpolate(time)
        origin = place + rotation @ np.array(self.lever_arm)
        return origin, np.einsum("nij,nj->ni", rotation, self.directions()[beam])

    def placed(self, trajectory: SimulatedTrajectory, time: np.ndarray, beam: np.ndarray,
               distance: np.ndarray) -> np.ndarray:
        """Points (n, 3) of ranges (n,) measured at the times by the beams, on the given trajectory."""
        origin, direction = self.rays(trajectory, time, beam)
        return origin + distance[:, None] * direction

    def received(self, reflectance: np.ndarray, glass: np.ndarray, distance: np.ndarray, cos_incidence: np.ndarray,
                 rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """Intensity (uint16) of the returns and whether each is measured at all (bool), both (n,).

        `reflectance`, `distance` (m) and `cos_incidence` (n,) are the true ones; `glass` (n,) whether it is a window.
        """
        signal = self.response.signal(reflectance, distance, np.maximum(cos_incidence, 0.01))
        weak = np.exp(np.clip(4.0 * (1.0 - signal / self.response.threshold), -30.0, 30.0))
        chance = (1.0 - LOST) * np.where(glass, 1.0 - GLASS_LOST, 1.0) / (1.0 + weak)
        measured = (rng.random(len(distance)) < chance) & (distance >= self.min_range)
        shine = 1.0 + SPECKLE * rng.standard_normal(len(distance))
        counts = signal * np.maximum(shine, 0.1) + self.response.floor + NOISE * rng.standard_normal(len(distance))
        return np.clip(np.round(counts), 0, 65535).astype(np.uint16), measured & (distance <= self.max_range)

    def measured_range(self, distance: np.ndarray, rng: np.random.Generator) -> np.ndarray:
        """Ranges with their noise, m."""
        return distance + self.range_noise * rng.standard_normal(len(distance))

    def calibration(self) -> dict:
        """Its entry in calibration.json."""
        return {"id": self.id, "name": self.name, "lever_arm_m": list(self.lever_arm), "roll": self.roll,
                "pitch": self.pitch, "heading": self.heading, "point_source_id": self.id,
                "max_range": self.max_range, "beams": len(self.angles), "scan_hz": self.scan_hz}


@dataclass(frozen=True)
class Returns:
    """What a scanner measured, in arrays (n,).

    `time` in GPS seconds, `beam` counts within the scan, `distance` as measured (m), `intensity` uint16; the truth:
    `material` (`Material`) and `ground` (bool).
    """

    time: np.ndarray
    beam: np.ndarray
    distance: np.ndarray
    intensity: np.ndarray
    material: np.ndarray
    ground: np.ndarray


def simulate_scans(scene: Scene, caster: RayCaster, scanner: SimulatedScanner, scans: np.ndarray,
                   true: SimulatedTrajectory, rng: np.random.Generator) -> Returns:
    """What the scanner measures at the drives in scans that begin at the given times (s)."""
    time = scanner.beam_times(scans).ravel()
    beam = np.tile(np.arange(len(scanner.angles)), len(scans))
    origin, direction = scanner.rays(true, time, beam)
    hits = caster.cast(origin, direction, time, scanner.max_range, rng.exponential(size=len(time)))
    met = np.flatnonzero(hits.source != Hit.NOTHING)
    hits = Hits(*(getattr(hits, item.name)[met] for item in fields(Hits)))
    point = origin[met] + hits.distance[:, None] * direction[met]
    material, ground = hit_material(scene, GROUND, point, hits), hits.source == Hit.GROUND
    reflectance = REFLECTANCE[material]
    spot = (point[ground], direction[met][ground], hits.distance[ground], hits.cosine[ground])
    reflectance[ground] = spot_reflectance(scene, material[ground], *spot)
    intensity, received = scanner.received(reflectance, material == Material.GLASS, hits.distance, hits.cosine, rng)
    columns = (time[met], beam[met], scanner.measured_range(hits.distance, rng), intensity, material, ground)
    return Returns(*(column[received] for column in columns))


def spot_reflectance(scene: Scene, material: np.ndarray, point: np.ndarray, direction: np.ndarray,
                     distance: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Mean reflectance (n,) of the spots that beams light on the ground, where they may lie half on paint.

    A spot is a long ellipse, drawn out along the beam by 1 / cos(incidence); three places along it stand for it.
    """
    paint = scene.paint(GROUND)
    base = material.copy()
    painted = (base == Material.PAINT_WHITE) | (base == Material.PAINT_YELLOW)
    street = scene.ground.kerb_distance(point[painted, 0], point[painted, 1]) <= 0
    base[painted] = np.where(street, Material.ASPHALT, Material.PAVEMENT)
    along = direction[:, :2] / np.hypot(direction[:, 0], direction[:, 1])[:, None]
    half_length = 0.5 * (APERTURE + DIVERGENCE * distance) / np.maximum(cosine, 0.05)
    total = REFLECTANCE[material].copy()
    for share in (0.7, -0.7):
        x, y = (point[:, :2] + (share * half_length)[:, None] * along).T
        marking = paint.material_at(x, y)
        total += REFLECTANCE[np.where(marking > 0, marking, base)]
    if "surface" in scene.faults:
        road = scene.ground.kerb_distance(point[:, 0], point[:, 1]) <= 0
        total[road] *= surface_factor(*scene.ground.to_local(point[road, 0], point[road, 1]))
    spots = value_noise(point[:, 0], point[:, 1], GRAIN_SIZE) - 0.5
    return total / 3 * (1.0 + GRAIN * spots)
