"""A vehicle with two line scanners drives past a front; what it measures, with occlusion, glass and noise."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np

from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.samplecity.laser.surfaces import is_window

from .fronts import Front
from .parts import GLASS, WINDOWS, Face, grid_of, level

ORIGIN = np.array([-7000.0, -34000.0, 20.0])
SPEED, SCAN_HZ, BEAMS, RANGE, NOISE = 9.0, 90.0, 480, 60.0, 0.006
PASSES, THROUGH, LOST = 0.6, 0.55, 0.2
"""Shares of the beams on a front's glass that go through it; of those on a window; of both that do not come back."""


@dataclass(frozen=True, eq=False)
class Survey:
    """Points (n, 3) of a survey, local m, time (n,) GPS seconds, and where the vehicle was."""

    points: np.ndarray
    time: np.ndarray
    path: np.ndarray
    path_time: np.ndarray


def beams(front: Front, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Origins (n, 3), unit directions (n, 3), times (n,); places (k, 3) and times (k,) of the vehicle."""
    lane = front.nearest - rng.uniform(3.0, 7.0)
    reach = front.width / 2 + 20.0
    path_time = 1000.0 + np.arange(0.0, 2 * reach / SPEED, 0.05)
    path = np.column_stack([front.width / 2 - reach + (path_time - 1000.0) * SPEED, np.full(len(path_time), lane),
                            np.full(len(path_time), 2.2)])
    lines = np.arange(1000.0, path_time[-1], 1 / SCAN_HZ)
    # Half a turn, from straight down over the side of the front to the zenith and a little on.
    angle = np.radians(np.linspace(-80.0, 95.0, BEAMS))
    origins, directions, times = [], [], []
    for turn in (45.0, -45.0):
        out = np.array([np.sin(np.radians(turn)), np.cos(np.radians(turn)), 0.0])
        fan = np.cos(angle)[:, None] * out + np.sin(angle)[:, None] * np.array([0.0, 0.0, 1.0])
        moment = lines[:, None] + np.linspace(0, 0.5 / SCAN_HZ, BEAMS)
        place = np.column_stack([np.interp(moment.ravel(), path_time, axis) for axis in path.T])
        origins.append(place)
        directions.append(np.tile(fan, (len(lines), 1)))
        times.append(moment.ravel())
    return (*(np.concatenate(parts) for parts in (origins, directions, times)), path, path_time)


def scan(front: Front, seed: int) -> Survey:
    """What the vehicle measures of a front."""
    rng = np.random.default_rng([seed, 77])
    origin, direction, time, path, path_time = beams(front, rng)
    ground = level(-40.0, front.width + 40.0, front.nearest - 15.0, 40.0, 0.0)
    found, distance = _met([*front.faces, ground], origin, direction)
    kind = np.array([face.kind for face in front.faces] + [0])[found]
    chance = rng.random(len(found))
    place = origin + distance[:, None] * direction
    window = (kind == WINDOWS) & is_window(place[:, 0], place[:, 2])
    clear = (window & (chance < THROUGH)) | ((kind == GLASS) & (chance < PASSES))
    lost = (found < 0) | ((window | (kind == GLASS)) & (chance > 1 - LOST))
    inner = np.flatnonzero(clear & (found >= 0))
    behind, further = _met(front.rooms or [ground], place[inner] + 1e-3 * direction[inner], direction[inner])
    distance[inner] += further + 1e-3
    lost[inner[behind < 0]] = True
    recessed = window & ~clear
    distance[recessed] += 0.08 / np.maximum(np.abs(direction[recessed, 1]), 0.1)
    lost |= distance > RANGE
    distance = distance + rng.normal(0.0, NOISE, len(distance))
    keep = np.flatnonzero(~lost)
    keep = keep[np.argsort(time[keep], kind="stable")]
    return Survey(origin[keep] + distance[keep, None] * direction[keep], time[keep], path, path_time)


def hidden_share(front: Front, survey: Survey, wall: np.ndarray, cell: float = 0.25) -> float:
    """Share of a wall that neither scanner saw because something stood before it, by a ray from each to each cell.

    `wall`: (n, 3) local places on it; its rectangle goes from the ground to the front's top at their mean y.
    """
    left, right, y = wall[:, 0].min(), wall[:, 0].max(), wall[:, 1].mean()
    x, z = np.meshgrid(np.arange(left + cell / 2, right, cell),
                       np.arange(min(0.0, wall[:, 2].min()) + cell / 2, max(front.height, wall[:, 2].max()), cell))
    cells = np.column_stack([x.ravel(), np.full(x.size, y), z.ravel()])
    free, blocked = np.zeros(len(cells), bool), np.zeros(len(cells), bool)
    lane, above = survey.path[0, 1:]
    for side in (1.0, -1.0):  # the scanners look 45 degrees to the front and to the back
        origin = np.column_stack([cells[:, 0] - side * (y - lane), np.full((len(cells), 2), (lane, above))])
        away = cells - origin
        distance = np.linalg.norm(away, axis=1)
        _, first = _met(front.faces, origin, away / distance[:, None])
        passed = (origin[:, 0] >= survey.path[0, 0]) & (origin[:, 0] <= survey.path[-1, 0])
        blocked |= passed & (first < distance - 0.35)
        free |= passed & (first >= distance - 0.35)
    return float((blocked & ~free).mean())


def _met(faces: list[Face], origin: np.ndarray, direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number (n,) of the face that each beam meets, -1 for none, and its distance (n,)."""
    best = np.full(len(direction), RANGE + 10.0)
    found = np.full(len(direction), -1, np.int32)
    grid = grid_of(faces)
    for start in range(0, len(direction), 32_768):
        part = slice(start, start + 32_768)
        found[part] = grid.walk(origin[part], direction[part], best[part])
    return found, best


def turned(xyz: np.ndarray, seed: int) -> np.ndarray:
    """Local places (n, 2 or 3) on the map: turned by an angle that the seed gives."""
    angle = np.random.default_rng([seed, 78]).uniform(0, 2 * np.pi)
    size = xyz.shape[1]
    result = xyz + 0.0
    result[:, :2] = xyz[:, :2] @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return result + ORIGIN[:size]


def local(xyz: np.ndarray, seed: int) -> np.ndarray:
    """The way back from `turned`."""
    angle = np.random.default_rng([seed, 78]).uniform(0, 2 * np.pi)
    result = xyz - ORIGIN[:xyz.shape[1]]
    result[:, :2] = result[:, :2] @ np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return result


def write_survey(path: Path, survey: Survey, seed: int) -> Path:
    """A LAZ file of the survey on the map."""
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = np.full(3, 0.001), ORIGIN
    las = laspy.LasData(header)
    las.x, las.y, las.z = turned(survey.points, seed).T
    las.gps_time = survey.time
    las.write(str(path))
    return path


def trajectory(survey: Survey, seed: int) -> Trajectory:
    """The vehicle's way on the map."""
    xyz = turned(survey.path, seed)
    level_way = np.diff(xyz[[0, -1], :2], axis=0)[0]
    heading = float(np.degrees(np.arctan2(*level_way)))
    return Trajectory(survey.path_time, xyz, np.column_stack([np.zeros((len(xyz), 2)), np.full(len(xyz), heading)]))
