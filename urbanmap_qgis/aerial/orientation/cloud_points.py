"""Control points of a laser point cloud: where they truly are, and where the cloud has them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InputError, InsufficientDataError
from ...geometry.tolerances import SIGMA_OF_MAD
from ...io.files.columns import EAST, NORTH, UP, Column, aliases_of, names_of, needed_of
from ...io.files.guard import read_text, reads
from ...io.files.named_table import known_columns, named_rows
from ...io.points.pointcloud import PointCloud, iter_chunks, of_classes, valid_points
from ...progress import SILENT, Progress
from ...wording import say
from .control_columns import check_rows, column_numbers

CLOUD_POINTS = (
    Column("id", "", ("point", "name", "点名", "点番号", "点"), needed=False), EAST, NORTH, UP,
    Column("x_als", "m", ("xcloud", "xlidar"), needed=False), Column("y_als", "m", ("ycloud", "ylidar"), needed=False),
    Column("z_als", "m", ("zcloud", "zlidar"), needed=False), Column("role", "", ("use", "役割", "区分"), needed=False))
"""True places, and for those that were found in the cloud their place there; the height is measured in it."""

COLUMNS, _NEEDED, _ALIASES = names_of(CLOUD_POINTS), needed_of(CLOUD_POINTS), aliases_of(CLOUD_POINTS)
_GROUND = (2, 8, 10, 11)

RADIUS = 1.5  # m around a point in which the ground is taken for a plane
FEWEST = 6  # points of it
ROUNDS = 6
FORGET = 3.0  # sigmas at which a point of the cloud counts a quarter
NOISE = 0.01  # m, of a cloud's height over some points at least: what they share


@dataclass(frozen=True)
class CloudPoints:
    """n points.

    Attributes
    ----------
    id : names.
    true : (n, 3) m.
    found : (n, 3) where they lie in the cloud, m; NaN where that was not measured.
    check : (n,) bool, points that are only compared.
    sigma : (n,) standard deviation of the cloud's height there, m; NaN where it was not measured here.
    """

    id: tuple[str, ...]
    true: np.ndarray
    found: np.ndarray
    check: np.ndarray
    sigma: np.ndarray

    def __len__(self) -> int:
        return len(self.id)

    @property
    def errors(self) -> np.ndarray:
        """(n, 3) cloud less truth, east, north, up, m; NaN where not measured."""
        return self.found - self.true


@reads("control points")
def read_cloud_points(path: str | os.PathLike) -> CloudPoints:
    """Control points of a CSV with the columns of `CLOUD_POINTS`, or what other programs call them.

    Raises
    ------
    InputError : a column is missing, a value is no number, a role is not known, or a name is there twice.
    """
    name = Path(path).name
    header, rows, _ = named_rows(read_text(path, "control points (CSV)"), _NEEDED, _ALIASES, name)
    columns = {key: [row[place].strip() if place < len(row) else "" for row in rows]
               for place, key in enumerate(header) if key}
    known = known_columns(columns, COLUMNS, _ALIASES, name)
    missing = [column for column in _NEEDED if column not in known]
    if missing or not rows:
        raise InputError(say("{name} has no control point with {columns}; x_als, y_als, z_als where the point was "
                             "found in the cloud.", name=name, columns=",".join(_NEEDED)))
    ids = tuple(columns[known["id"]] if "id" in known else (str(number + 1) for number in range(len(rows))))
    twice = next((one for number, one in enumerate(ids) if one in ids[:number]), None)
    if twice is not None:
        raise InputError(say("{name}: the point {point} is there twice; keep one row.", name=name, point=twice))
    true = np.column_stack([column_numbers(columns[known[key]], key, name, needed=True) for key in "xyz"])
    found = np.column_stack([column_numbers(columns[known[key]], key, name) if key in known
                             else np.full(len(rows), np.nan) for key in ("x_als", "y_als", "z_als")])
    half = np.isfinite(found[:, 0]) != np.isfinite(found[:, 1])
    if half.any():
        raise InputError(say("{name}: the point {point} has only one of x_als and y_als; give both or none.",
                             name=name, point=ids[int(half.argmax())]))
    return CloudPoints(ids, true, found, check_rows(columns, known, len(rows), name), np.full(len(rows), np.nan))


def measured_heights(points: CloudPoints, cloud: PointCloud, progress: Progress = SILENT) -> CloudPoints:
    """The points with the cloud's ground height at each: of a plane through its ground points around it.

    Where the cloud has no ground classes the lowest surface with enough points is taken. Heights that the table states
    stay.

    Raises
    ------
    InsufficientDataError : the cloud has ground around none of them, and none was found in it by hand.
    """
    place = np.where(np.isfinite(points.found[:, :2]), points.found[:, :2], points.true[:, :2])
    around = _ground_around(place, cloud, progress)
    found, sigma = points.found.copy(), points.sigma.copy()
    for number, near in enumerate(around):
        height, accuracy = _height_of_plane(near - [*place[number], 0.0]) if len(near) >= FEWEST else (
            np.nan, np.nan)
        if np.isnan(found[number, 2]):
            found[number, 2], sigma[number] = height, accuracy
    if not np.isfinite(found).any():
        raise InsufficientDataError(say("The cloud has no ground around any control point: check the coordinate "
                                        "systems, and that the points lie on open ground within the cloud."))
    return CloudPoints(points.id, points.true, found, points.check, sigma)


def _ground_around(place: np.ndarray, cloud: PointCloud, progress: Progress) -> list[np.ndarray]:
    """(m, 3) ground points of the cloud around each place (n, 2); all points where none has a ground class."""
    tree = cKDTree(place)
    parts: list[list[np.ndarray]] = [[] for _ in place]
    classes: list[list[np.ndarray]] = [[] for _ in place]
    low, high = place.min(axis=0) - RADIUS, place.max(axis=0) + RADIUS
    for chunk in iter_chunks(cloud, progress, shape_only=True):
        xyz = np.column_stack([np.asarray(chunk[name]) for name in "xyz"])
        near = np.flatnonzero(valid_points(chunk) & (xyz[:, :2] >= low).all(axis=1) & (xyz[:, :2] <= high).all(axis=1))
        ground = of_classes(chunk, _GROUND)
        for row, owners in zip(near, tree.query_ball_point(xyz[near, :2], RADIUS)):
            for owner in owners:
                parts[owner].append(xyz[row])
                classes[owner].append(ground[row])
    found = [np.array(part).reshape(-1, 3) for part in parts]
    marks = [np.array(mark, bool) for mark in classes]
    classified = any(mark.any() for mark in marks)
    return [part[mark] if classified else part for part, mark in zip(found, marks)]


def _height_of_plane(near: np.ndarray) -> tuple[float, float]:
    """Height of a plane through points (m, 3) at the origin, and its standard deviation, m.

    It starts from the lower half, since what stands on the ground is above it.
    """
    design = np.column_stack([near[:, :2], np.ones(len(near))])
    weight = (near[:, 2] <= np.median(near[:, 2])).astype(float)
    scatter = NOISE
    for _ in range(ROUNDS):
        root = np.sqrt(weight)
        plane = np.linalg.lstsq(design * root[:, None], near[:, 2] * root, rcond=None)[0]
        left = near[:, 2] - design @ plane
        scatter = max(SIGMA_OF_MAD * float(np.median(np.abs(left[weight > 0.25]))), NOISE)
        weight = (1.0 + (left / scatter / FORGET) ** 2) ** -2.0
    normal = np.linalg.pinv((design * weight[:, None]).T @ design)
    return float(plane[2]), float(np.hypot(scatter * np.sqrt(normal[2, 2]), NOISE))
