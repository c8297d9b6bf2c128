"""Airborne laser scanning of the sample city: two opposite strips of parallel scan lines."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import pyproj
import shapely

from ...progress import SILENT, Progress
from ..faults import GROUND_LENGTH, GROUND_MEAN, GROUND_WAVE
from ..scene.model import AERIAL, REFLECTANCE, FaceKind, Material
from ..scene.paint import value_noise
from ..scene.world import ALS_TIME, CRS, SURVEYED, Scene
from .raycast import Hit, Hits, RayCaster
from .surfaces import hit_material

FLYING_HEIGHT = 650.0
SPEED = 62.0
SIDE = 60.0  # Distance of each flight line from the middle of the city, m.
# Standard deviations, m: of each point, and of the shift of a whole strip.
STRIP_PLAN = 0.05
STRIP_HEIGHT = 0.015
OUTLIERS = 1e-4  # Share of points that a bird or an echo of an echo puts far too high or too low.
MAX_RETURNS = 3
LEAF_GAP = 1.0  # A further return comes from at least so many mean free paths deeper in the leaves.

DENSITY = 7.0
"""Pulses per m2 of both strips together."""

MARGIN = 10.0
"""Points are kept up to here beyond the city's square, m."""

PLAN_JITTER, HEIGHT_JITTER = 0.10, 0.025


@dataclass(frozen=True)
class AlsPoints:
    """Points of one strip or of all, in the order of time.

    Attributes
    ----------
    xyz : (n, 3) as measured.
    true : (n, 3) where the pulse ended. time, intensity, classification, return_number, returns, scan_angle (degrees).
    strip : (n,).
    """

    xyz: np.ndarray
    true: np.ndarray
    time: np.ndarray
    intensity: np.ndarray
    classification: np.ndarray
    return_number: np.ndarray
    returns: np.ndarray
    scan_angle: np.ndarray
    strip: np.ndarray

    def __len__(self) -> int:
        return len(self.xyz)

    def select(self, rows: np.ndarray) -> AlsPoints:
        """Some of the points."""
        return AlsPoints(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))


@dataclass(frozen=True)
class Pulses:
    """Pulses of a strip: origin (n, 3), unit direction (n, 3), time (n,), scan angle (n,) in degrees."""

    origin: np.ndarray
    direction: np.ndarray
    time: np.ndarray
    scan_angle: np.ndarray


def write_als(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress = SILENT,
              executor: Executor | None = None) -> dict:
    """Write als/als.laz (all of class 1) and als/als_classified.laz below `folder`.

    Classes: 2 ground, 6 building, 5 vegetation, 17 elevated road, 7 outlier, 1 vehicles and furniture.
    Returns a summary: points, density (all returns per m2), strip shifts (E, N, H, m).
    """
    points, shifts = simulate_strips(scene, seed, progress.part(0.0, 0.6), executor)
    (folder / "als").mkdir(parents=True, exist_ok=True)
    write_las(folder / "als" / "als_classified.laz", points, points.classification)
    progress.step(0.8)
    write_las(folder / "als" / "als.laz", points, np.ones(len(points), np.uint8))
    progress.step(1.0)
    area = scene.extent.buffer(MARGIN).area
    return {"points": len(points), "density": len(points) / area, "strip_shifts": shifts.tolist()}


def simulate_strips(scene: Scene, seed: np.random.SeedSequence, progress: Progress = SILENT,
                    executor: Executor | None = None) -> tuple[AlsPoints, np.ndarray]:
    """All points, and the shift (2, 3) of each strip in m."""
    caster = RayCaster(scene, AERIAL)
    randoms = [np.random.default_rng(np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, use)))
               for use in range(3)]
    shifts = randoms[2].normal(size=(2, 3)) * (STRIP_PLAN, STRIP_PLAN, STRIP_HEIGHT)
    strips = []
    for number in (0, 1):
        pulses = strip_pulses(scene, number)
        strips.append(_measure(scene, caster, pulses, number, shifts[number], randoms[number], executor))
        progress.step((number + 1) / 2)
    return AlsPoints(*(np.concatenate([getattr(strip, name) for strip in strips])
                       for name in AlsPoints.__dataclass_fields__)), shifts


def strip_pulses(scene: Scene, number: int) -> Pulses:
    """Pulses of strip 0 (flown along +u) or 1 (along -u, on the other side of the city)."""
    forward = 1.0 if number == 0 else -1.0
    half = scene.size / 2 + MARGIN + 30.0
    spacing = np.sqrt(2.0 / DENSITY)
    height = scene.ground.z0 + FLYING_HEIGHT
    v_flight = -forward * SIDE
    angle_low, angle_high = (np.arctan2(edge - v_flight, FLYING_HEIGHT) for edge in (-half, half))
    angles = np.arange(angle_low, angle_high, spacing / FLYING_HEIGHT)
    lines = np.arange(-half, half, spacing)
    line, pulse = (grid.ravel() for grid in np.meshgrid(np.arange(len(lines)), np.arange(len(angles)), indexing="ij"))
    # A line takes 60 % of the time until the next one: the mirror then turns its next side in.
    time = (line + 0.6 * pulse / len(angles)) * spacing / SPEED
    u, v = forward * (lines[0] + time * SPEED), np.full(len(time), v_flight)
    start = ALS_TIME + number * 240.0
    roll, pitch = 0.4 * np.sin(2 * np.pi * time / 3.1 + number), 0.3 * np.sin(2 * np.pi * time / 2.3)
    across = angles[pulse] + np.radians(roll)
    along = np.radians(pitch) * forward
    local = np.column_stack([np.sin(along), np.cos(along) * np.sin(across), -np.cos(along) * np.cos(across)])
    x, y = scene.ground.to_world(u, v)
    east, north = scene.ground.to_world(local[:, 0], local[:, 1])
    direction = np.column_stack([east - scene.ground.origin[0], north - scene.ground.origin[1], local[:, 2]])
    return Pulses(np.column_stack([x, y, np.full(len(x), height)]), direction, start + time, np.degrees(across))


def _measure(scene: Scene, caster: RayCaster, pulses: Pulses, number: int, shift: np.ndarray,
             rng: np.random.Generator, executor: Executor | None) -> AlsPoints:
    """Points of one strip, with noise; up to three returns of a pulse that meets leaves."""
    n = len(pulses.time)
    alive, order, depth = np.arange(n), np.zeros(n, np.uint8), rng.exponential(size=n)
    pulse, true, source, material, cosine = [], [], [], [], []
    for echo in range(MAX_RETURNS):
        hits = caster.cast(pulses.origin[alive], pulses.direction[alive], pulses.time[alive], 2 * FLYING_HEIGHT,
                           depth[alive], executor)
        met = hits.source != Hit.NOTHING
        point = pulses.origin[alive[met]] + hits.distance[met, None] * pulses.direction[alive[met]]
        hits = Hits(*(getattr(hits, name)[met] for name in hits.__dataclass_fields__))
        pulse.append(alive[met])
        true.append(point)
        material.append(hit_material(scene, AERIAL, point, hits))
        source.append(classes(scene, material[-1], hits))
        cosine.append(hits.cosine)
        order[alive[met]] = echo + 1
        alive = alive[met][(hits.source == Hit.CROWN) & (rng.random(len(point)) < 0.7)]
        depth[alive] += LEAF_GAP + rng.exponential(size=len(alive))
    pulse, true, classification, material, cosine = (
        np.concatenate(column) for column in (pulse, true, source, material, cosine))
    echo = np.concatenate([np.full(len(column), k + 1, np.uint8) for k, column in enumerate(source)]) if n else pulse
    xyz = true + shift + rng.normal(size=true.shape) * (PLAN_JITTER, PLAN_JITTER, HEIGHT_JITTER)
    if "ground" in scene.faults:
        wave = 2.0 * value_noise(true[:, 0], true[:, 1], GROUND_LENGTH) - 1.0
        xyz[:, 2] += GROUND_MEAN + GROUND_WAVE * wave
    wild = rng.random(len(xyz)) < OUTLIERS
    high, low = rng.uniform(25.0, 150.0, len(xyz)), rng.uniform(-9.0, -3.0, len(xyz))
    xyz[wild, 2] += np.where(rng.random(len(xyz)) < 0.6, high, low)[wild]
    intensity = 26000 * REFLECTANCE[material] * (0.3 + 0.7 * cosine) * rng.normal(1.0, 0.06, len(xyz))
    points = AlsPoints(
        xyz, true, pulses.time[pulse], np.clip(intensity, 1, 65535).astype(np.uint16),
        np.where(wild, 7, classification).astype(np.uint8), echo, order[pulse], pulses.scan_angle[pulse],
        np.full(len(xyz), number + 1, np.uint16))
    rows = np.lexsort((points.return_number, points.time))
    inside = shapely.contains_xy(scene.extent.buffer(MARGIN, join_style="mitre"), *points.xyz[rows, :2].T)
    return points.select(rows[inside])


def classes(scene: Scene, material: np.ndarray, hits: Hits) -> np.ndarray:
    """ASPRS class (n,) of what beams met: 2 ground, 5 vegetation, 6 building, 17 bridge, 1 anything else."""
    faces = scene.static_faces(AERIAL)
    result = np.ones(len(material), np.uint8)
    result[hits.source == Hit.GROUND] = 2
    result[material == Material.FOLIAGE] = 5
    face = np.flatnonzero(hits.source == Hit.FACE)
    kind = faces.kind[hits.index[face]]
    result[face[kind <= FaceKind.STRUCTURE]] = 6
    result[face[kind == FaceKind.BRIDGE]] = 17
    result[face[material[face] == Material.WOOD]] = 5
    return result


def write_las(path: Path, points: AlsPoints, classification: np.ndarray) -> None:
    """Write the points as LAZ 1.4, format 6, with millimetres and the CRS."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    # A fixed date, so that the same seed gives the same bytes on any day.
    header.creation_date = SURVEYED
    header.scales = np.full(3, 0.001)
    header.offsets = np.floor(points.xyz.mean(axis=0)) if len(points) else np.zeros(3)
    header.add_crs(pyproj.CRS(CRS))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.xyz.T
    las.gps_time, las.intensity, las.classification = points.time, points.intensity, classification
    las.return_number, las.number_of_returns = points.return_number, points.returns
    las.scan_angle = np.round(points.scan_angle / 0.006).astype(np.int16)
    las.point_source_id = points.strip
    las.write(str(path))
