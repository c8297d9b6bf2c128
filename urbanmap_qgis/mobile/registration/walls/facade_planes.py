"""Facades as a survey saw them: small upright planes, each seen from a few metres of path."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ....geometry.tolerances import LEAST_DIVISOR, LEAST_SQUARE
from ....io.points.pointcloud import PointCloud, iter_chunks, open_cloud, valid_points
from ....progress import SILENT, Progress
from ...boresight.plane_patches import PatchSearch, PlanePatches
from ...gps_time import time_shift
from ...markings.extraction import WEIGHT
from ...trajectory import Trajectory, interpolate, path_chainage
from ..matching.results import angle_rates


@dataclass(frozen=True)
class FacadePlanesLimits:
    """Limits of facade planes, each with its unit."""

    reach: float = 25.0  # m from the vehicle in plan: what is farther turns with its heading
    nearest: float = 2.5  # m: what is nearer is the traffic
    below: float = 0.5  # m under the vehicle's body: lower points are road, kerbs and cars
    above: float = 12.0  # m over it: higher ones turn with its roll
    upright: float = 0.12  # of the normal, at most upwards: 7 degrees
    piece: float = 4.0  # m of path parameter whose points are fitted together
    groups: int = 1 << 16  # numbers of pieces, after which they begin anew
    chunk: int = 500_000  # points
    # Planes of one wall follow each other within so many m, are parallel, and lie on one line to so many m.
    neighbour: float = 2.0
    parallel: float = 0.97
    on_line: float = 0.45


LIMITS = FacadePlanesLimits()


@dataclass(frozen=True)
class FacadePlanes:
    """Planes of facades, in the order driven.

    Attributes
    ----------
    path_parameter : (n,) m, when seen, as the correction counts it.
    chainage : (n,) m driven then.
    place : (n, 3) m, as the reported trajectory places them.
    lever_arm : (n, 3) m, from the body to them.
    normal : (n, 2) unit vectors in plan, towards the vehicle.
    back : (n, 6, 6) of a correction (m, degrees) to shift and rotation vector (radians) of the body.
    tilt : (n,) of the normal upwards for one in plan: radians by which the plane leans back; None of what does not
        stand upright.
    sweep : (n,) m of path parameter that pass while the scan rises by a metre; None with it.
    """

    path_parameter: np.ndarray
    chainage: np.ndarray
    place: np.ndarray
    lever_arm: np.ndarray
    normal: np.ndarray
    back: np.ndarray
    tilt: np.ndarray | None = None
    sweep: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.path_parameter)

    def select(self, which: np.ndarray) -> FacadePlanes:
        """Some of them, by mask or index."""
        columns = (getattr(self, field.name) for field in fields(self))
        return FacadePlanes(*(None if column is None else column[which] for column in columns))

    def translated(self, curve: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """(n, 2) m in plan, where a curve of corrections (m, 6) at path parameters (m,) puts them."""
        correction = curve(self.path_parameter)
        rotation = np.einsum("nij,nj->ni", self.back[:, 3:, 3:], correction[:, 3:])
        return (self.place + correction[:, :3] + np.cross(rotation, self.lever_arm))[:, :2]

    def rates(self, normal: np.ndarray) -> np.ndarray:
        """(n, 6) how each parameter of a correction moves the planes along normals (n, 2) in plan."""
        flat = np.column_stack([normal, np.zeros(len(normal))])
        return np.einsum("ni,nij->nj", np.column_stack([flat, np.cross(self.lever_arm, flat)]), self.back)


def facade_planes(paths: Sequence[str | os.PathLike] | PointCloud, trajectory: Trajectory,
                  path_parameter: np.ndarray, progress: Progress = SILENT) -> FacadePlanes:
    """The upright planes that a survey shows near the vehicle; none of a cloud that holds markings alone.

    Parameters
    ----------
    path_parameter : (e,) m, at the trajectory's epochs.
    """
    cloud = paths if isinstance(paths, PointCloud) else open_cloud(paths)
    search = PatchSearch(trajectory.place[0])
    if not cloud.has_dimension(WEIGHT):
        shift = time_shift(cloud, trajectory)
        for chunk in iter_chunks(cloud, progress, LIMITS.chunk):
            points, time = _near_facades(chunk, shift, trajectory)
            along = np.interp(time, trajectory.time, path_parameter)
            z = points[:, 2] - trajectory.place[0, 2]
            search.add(points, time, (along / LIMITS.piece).astype(np.int64) % LIMITS.groups,
                       np.column_stack([along, z * z, z * along]))
    found = search.patches()
    found = found.select(np.abs(found.normal[:, 2]) <= LIMITS.upright)
    found = found.select(np.argsort(found.time, kind="stable"))
    time = np.clip(found.time, trajectory.time[0], trajectory.time[-1])  # means of times may be rounded beyond
    body = interpolate(trajectory, time)
    lever_arm = found.centroid - body.place
    normal = found.normal * -np.sign((found.normal * lever_arm * [1.0, 1.0, 0.0]).sum(axis=1))[:, None]
    normal = normal / np.maximum(np.hypot(*normal[:, :2].T), LEAST_DIVISOR)[:, None]
    back = np.linalg.inv(angle_rates(body.angles)) if len(time) else np.zeros((0, 6, 6))
    along, chainage = (np.interp(time, trajectory.time, way) for way in (path_parameter, path_chainage(trajectory)))
    return FacadePlanes(along, chainage, found.centroid, lever_arm, normal[:, :2], back, normal[:, 2],
                        _sweep(found, found.centroid[:, 2] - trajectory.place[0, 2]))


def _sweep(found: PlanePatches, z: np.ndarray) -> np.ndarray:
    """(n,) m of path a metre of height, by mean heights (n,) and the means (n, 3) of path, z squared and z times path.
    """
    if not len(found):
        return np.zeros(0)
    along, square, product = found.means.T
    return (product - z * along) / np.maximum(square - z**2, LEAST_SQUARE)


def _near_facades(chunk, shift: float, trajectory: Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Points (m, 3) of a chunk that may lie on facades near the vehicle, and their times (m,)."""
    time = np.asarray(chunk["gps_time"]) + shift
    keep = np.flatnonzero(valid_points(chunk) & trajectory.within(time))
    time = time[keep]
    place = np.column_stack([np.interp(time, trajectory.time, axis) for axis in trajectory.place.T])
    z = np.asarray(chunk.z)[keep] - place[:, 2]
    high = np.flatnonzero((z >= -LIMITS.below) & (z <= LIMITS.above))
    keep, time, place, z = keep[high], time[high], place[high], z[high]
    x, y = np.asarray(chunk.x)[keep], np.asarray(chunk.y)[keep]
    away = np.hypot(x - place[:, 0], y - place[:, 1])
    near = np.flatnonzero((away >= LIMITS.nearest) & (away <= LIMITS.reach))
    return np.column_stack([x[near], y[near], z[near] + place[near, 2]]), time[near]


def own_walls(place: np.ndarray, normal: np.ndarray, height: np.ndarray) -> np.ndarray:
    """(n,) number of the wall that each plane belongs to, by planes alone: those that go on in one line are one wall.

    Parameters
    ----------
    place, normal : (n, 2) m in plan, unit vectors.
    height : (n,) m.
    """
    if not len(place):
        return np.zeros(0, int)
    one, other = cKDTree(np.column_stack([place, 0.5 * height])).query_pairs(LIMITS.neighbour, output_type="ndarray").T
    mean = normal[one] + normal[other]
    off = np.abs(((place[one] - place[other]) * mean).sum(axis=1)) / 2.0
    same = ((normal[one] * normal[other]).sum(axis=1) >= LIMITS.parallel) & (off <= LIMITS.on_line)
    ones = np.ones(np.count_nonzero(same))
    graph = coo_matrix((ones, (one[same], other[same])), shape=(len(place), len(place)))
    return connected_components(graph, directed=False)[1]
