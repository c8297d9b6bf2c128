"""A made-up street of known edges for tests: points of a drive along it, as a LAS file and its trajectory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np

from urbanmap_qgis.mobile.trajectory import Trajectory

EAST, NORTH = -7000.0, -34000.0
NOISE = 0.006
SPEED = 8.0


@dataclass(frozen=True)
class Street:
    """What stands on the right of the drive (to the left is level ground); distances across from the path, m.

    `kerb` height at 4 m; `lowered` begin and end along of a place 2 cm high; `hidden` of one that no point shows;
    `rail` at 4.4 m, `wall` at 7 m: heights, 0 for none. `rough` : scatter of the ground beyond `verge` m on the left.
    """

    length: float = 60.0
    kerb: float = 0.12
    lowered: tuple[float, float] | None = None
    hidden: tuple[float, float] | None = None
    rail: float = 0.0
    wall: float = 0.0
    rough: float = 0.0
    verge: float = 4.0
    spacing: float = 0.08


KERB_AT, RAIL_AT, WALL_AT = 4.0, 4.4, 7.0


def local_points(street: Street, rng: np.random.Generator) -> np.ndarray:
    """Points (n, 3) along, across (right) and up, m, without noise of place."""
    s = np.arange(0.0, street.length, street.spacing)
    far = WALL_AT if street.wall else RAIL_AT if street.rail else 9.0
    level = np.arange(-9.0, far, street.spacing)
    along, across = (axis.ravel() for axis in np.meshgrid(s, level))
    along = along + rng.uniform(-0.5, 0.5, len(along)) * street.spacing
    across = across + rng.uniform(-0.5, 0.5, len(across)) * street.spacing
    height = np.where(across > KERB_AT, kerb_height(street, along), 0.0) - 0.01 * np.abs(across)
    rough = across < -street.verge
    height[rough] += street.rough * rng.standard_normal(np.count_nonzero(rough))
    parts = [np.column_stack([along, across, height])]
    for at, base, top in ((KERB_AT, 0.0, None), (RAIL_AT, street.kerb, street.rail),
                          (WALL_AT, street.kerb, street.wall)):
        if top == 0.0:
            continue
        face_s = np.repeat(s, 12)
        highest = kerb_height(street, face_s) if top is None else base + top
        z = base + rng.uniform(0.0, 1.0, len(face_s)) * (highest - base)
        parts.append(np.column_stack([face_s, np.full(len(face_s), at), z - 0.01 * at]))
    points = np.concatenate(parts)
    if street.hidden:
        a, b = street.hidden
        points = points[~((points[:, 0] > a) & (points[:, 0] < b) & (points[:, 1] > KERB_AT - 1.0)
                          & (points[:, 1] < KERB_AT + 2.5))]
    return points


def kerb_height(street: Street, along: np.ndarray) -> np.ndarray:
    """Height of the kerb (n,) m."""
    low = np.zeros(len(along), bool)
    if street.lowered:
        low = (along > street.lowered[0]) & (along < street.lowered[1])
    return np.where(low, min(0.02, street.kerb), street.kerb)


def to_map(local: np.ndarray, angle: float) -> np.ndarray:
    """Points along, across, up of a street that runs at `angle` degrees from east, in the map."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    s, d, z = local.T
    return np.column_stack([EAST + cos * s + sin * d, NORTH + sin * s - cos * d, 10.0 + z])


def to_local(place: np.ndarray, angle: float) -> np.ndarray:
    """The other way round."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    x, y, z = (place - [EAST, NORTH, 10.0]).T
    return np.column_stack([cos * x + sin * y, sin * x - cos * y, z])


def write_drive(path: Path, street: Street, angle: float = 0.0, passes: int = 1, seed: int = 1,
                more: Callable[[np.random.Generator], np.ndarray] | None = None) -> Trajectory:
    """Write the points as LAS; the trajectory, which drives the street `passes` times the same way.

    `more` : gives more points (n, 3) along, across and up, m.
    """
    rng = np.random.default_rng(seed)
    duration, away = street.length / SPEED, 60.0
    places, times, epochs, bodies = [], [], [], []
    for number in range(passes):
        local = local_points(street, rng)
        if more is not None:
            local = np.concatenate([local, more(rng)])
        start = 1000.0 + number * (duration + away)
        places.append(to_map(local + NOISE * rng.standard_normal(local.shape), angle))
        times.append(start + np.clip(local[:, 0], 0.0, street.length) / SPEED)
        along = np.arange(-4.0, street.length + 4.0, 0.4)
        epochs.append(start + along / SPEED)
        bodies.append(to_map(np.column_stack([along, np.zeros_like(along), np.full(len(along), 2.0)]), angle))
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = np.full(3, 0.001), np.array([EAST, NORTH, 0.0])
    cloud = laspy.LasData(header)
    place, time = np.concatenate(places), np.concatenate(times)
    order = np.argsort(time, kind="stable")
    cloud.x, cloud.y, cloud.z = place[order].T
    cloud.gps_time = time[order]
    cloud.write(path)
    body = np.concatenate(bodies)
    angles = np.column_stack([np.zeros((len(body), 2)), np.full(len(body), 90.0 - angle)])
    return Trajectory(np.concatenate(epochs), body, angles)
