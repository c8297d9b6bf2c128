"""Control points of a survey: corners of markings, where they truly are and where the survey shows them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from ..scene.model import GROUND
from ..scene.world import Scene
from .scanner import SimulatedScanner
from .trajectory import SimulatedTrajectory, carried_over

KINDS = ("lane", "stop", "zebra", "arrow", "diamond", "edge", "centre")
"""Markings whose corners a surveyor would measure."""

MAX_RANGE = 16.0
"""Corners farther than this from the scanner are not taken, m."""

SPACING = 4.0
"""One corner is taken for each square of this side, m."""

WORN = 0.5
"""Corners of markings more worn than this cannot be measured."""


@dataclass(frozen=True)
class MarkingCorners:
    """Corners of markings: place (n, 3) on the true ground, kind (n,) of their markings, id (n,)."""

    place: np.ndarray
    kind: np.ndarray
    id: np.ndarray


@dataclass(frozen=True)
class Sightings:
    """Which corners a survey measured, and when: number (n,) in `MarkingCorners`, time (n,) GPS seconds."""

    number: np.ndarray
    time: np.ndarray


def marking_corners(scene: Scene) -> MarkingCorners:
    """Corners of markings that are there at the drives, thinned to one in each square of `SPACING`."""
    markings = [m for m in scene.markings_at(GROUND) if m.kind in KINDS and m.wear <= WORN and not m.private]
    plans = np.array([shapely.simplify(shapely.set_precision(m.plan, 1e-4), 0.001) for m in markings], object)
    xy, owner = shapely.get_coordinates(plans, return_index=True)
    inside = shapely.contains_xy(shapely.buffer(scene.extent, -1.0), xy) if len(xy) else np.zeros(0, bool)
    xy, owner = xy[inside], owner[inside]
    u, v = scene.ground.to_local(xy[:, 0], xy[:, 1])
    cell = np.column_stack([np.floor(u / SPACING), np.floor(v / SPACING)]).astype(int)
    worn = np.array([markings[number].wear for number in owner])
    order = np.lexsort((v, u, worn, cell[:, 1], cell[:, 0]))
    first = np.ones(len(order), bool)
    first[1:] = np.any(np.diff(cell[order], axis=0) != 0, axis=1)
    chosen = order[first]
    x, y = np.round(xy[chosen], 4).T
    kind = np.array([markings[number].kind for number in owner[chosen]])
    names = np.array([f"P{number + 1:03d}" for number in range(len(chosen))])
    return MarkingCorners(np.column_stack([x, y, scene.ground_height(x, y)]), kind, names)


def first_sweep(points: np.ndarray, true: SimulatedTrajectory, scanner: SimulatedScanner,
                max_range: float = MAX_RANGE) -> Sightings:
    """When the scanner's plane sweeps over the points (n, 3) in front of it at the shortest range within `max_range`.

    The place where the vehicle is at each epoch gives the point's height above the plane; a change of sign is the
    sweep, linear between epochs.
    """
    place, rotation = true.interpolate(true.time)
    origin = place + rotation @ np.array(scanner.lever_arm)
    beams = scanner.directions()
    normal = np.cross(beams[0], beams[len(beams) // 2])
    axes = rotation @ np.column_stack([beams[len(beams) // 2], normal / np.linalg.norm(normal)])
    number, time = [], []
    for index, point in enumerate(points):
        offset = point - origin
        near = np.einsum("ij,ij->i", offset, offset) < max_range**2
        forward, above = np.einsum("ij,ijk->ki", offset, axes)
        swept = np.flatnonzero(near[:-1] & (forward[:-1] > 0) & (above[:-1] * above[1:] <= 0)
                               & (above[:-1] != above[1:]))
        if len(swept):
            best = swept[np.argmin(np.linalg.norm(offset[swept], axis=1))]
            share = above[best] / (above[best] - above[best + 1])
            number.append(index)
            time.append(true.time[best] + share * (true.time[best + 1] - true.time[best]))
    return Sightings(np.array(number, int), np.array(time))


def write_control(path: Path, corners: MarkingCorners, sightings: Sightings, true: SimulatedTrajectory,
                  reported: SimulatedTrajectory) -> int:
    """Write CSV id,x,y,z,time,x_mms,y_mms,z_mms,kind: each corner where it is and where the survey shows it."""
    place, time = corners.place[sightings.number], np.round(sightings.time, 6)
    shown = carried_over(place, time, true, reported)
    lines = ["id,x,y,z,time,x_mms,y_mms,z_mms,kind\n"]
    for number, p, t, q in zip(sightings.number, place, time, shown):
        values = [f"{v:.4f}" for v in p] + [f"{t:.6f}"] + [f"{v:.4f}" for v in q]
        lines.append(",".join([corners.id[number], *values, corners.kind[number]]) + "\n")
    path.write_text("".join(lines))
    return len(sightings.number)


def visible_sightings(sightings: Sightings, visible: Sequence[bool]) -> Sightings:
    """Those of the sightings that are visible."""
    keep = np.asarray(visible, bool)
    return Sightings(sightings.number[keep], sightings.time[keep])
