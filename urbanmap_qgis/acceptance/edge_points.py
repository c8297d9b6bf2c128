"""Laser points around edges of building models, and the models' heights there, both along and across each edge."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..geometry.tolerances import LEAST_FACE
from ..io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ..progress import SILENT, Progress


@dataclass(frozen=True)
class EdgeFrame:
    """An edge of a building's plan, seen from inside the building.

    Attributes
    ----------
    origin : (2,) its first end, m.
    along, outward : (2,) unit vectors.
    length : m.
    """

    origin: np.ndarray
    along: np.ndarray
    outward: np.ndarray
    length: float

    @classmethod
    def of(cls, ends: np.ndarray) -> EdgeFrame:
        """Of an edge (2, 2 or more), m, with the building to its left."""
        step = ends[1, :2] - ends[0, :2]
        length = float(np.hypot(*step))
        along = step / length
        return cls(ends[0, :2].copy(), along, np.array([along[1], -along[0]]), length)

    def local(self, plan: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places along the edge and outward of it, (n,) m each, of points (n, 2)."""
        away = plan - self.origin
        return away @ self.along, away @ self.outward

    def world(self, along: np.ndarray, outward: np.ndarray) -> np.ndarray:
        """Points (n, 2), m, of places along and outward."""
        return self.origin + np.multiply.outer(along, self.along) + np.multiply.outer(outward, self.outward)

    def window(self, inward: float, outward: float) -> shapely.Polygon:
        """The rectangle from `inward` m inside the edge to `outward` m outside."""
        return shapely.Polygon(self.world(np.array([0.0, self.length, self.length, 0.0]),
                                          np.array([-inward, -inward, outward, outward])))


def points_of_windows(cloud: PointCloud, windows: Sequence[shapely.Polygon],
                      progress: Progress = SILENT) -> list[np.ndarray]:
    """(n, 3) points in each window, m; what is marked as noise or withheld is left out.

    Raises
    ------
    InputError : a file is damaged.
    """
    found: list[list[np.ndarray]] = [[np.zeros((0, 3))] for _ in windows]
    boxes = shapely.bounds(np.array(windows, object)).reshape(-1, 4)
    for chunk in iter_chunks(cloud, progress, shape_only=True):
        keep = valid_points(chunk)
        points = np.column_stack([np.asarray(axis, float)[keep] for axis in (chunk.x, chunk.y, chunk.z)])
        order = np.argsort(points[:, 0], kind="stable")
        points = points[order]
        for number, inside in _inside(points, windows, boxes):
            found[number].append(inside)
    return [np.concatenate(parts) for parts in found]


def _inside(points: np.ndarray, windows: Sequence[shapely.Polygon],
            boxes: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
    """Numbers of windows with the points in them; points are sorted by x."""
    first = np.searchsorted(points[:, 0], boxes[:, 0], "left")
    last = np.searchsorted(points[:, 0], boxes[:, 2], "right")
    for number in np.flatnonzero(last > first):
        some = points[first[number]:last[number]]
        some = some[(some[:, 1] >= boxes[number, 1]) & (some[:, 1] <= boxes[number, 3])]
        some = some[shapely.contains_xy(windows[number], some[:, 0], some[:, 1])]
        if len(some):
            yield number, some


class ModelSurface:
    """Upper surface of building models.

    Parameters
    ----------
    models : (n,) MultiPolygonZ, all faces of each building.
    """

    def __init__(self, models: Sequence[shapely.Geometry | None]):
        self._models = np.array([None if model is None or model.is_empty else model for model in models], object)
        self._tree = shapely.STRtree(self._models)
        self._faces: dict[int, tuple[np.ndarray, np.ndarray]] = {}

    def heights(self, plan: np.ndarray) -> np.ndarray:
        """Height (n,) m of the highest face at points (n, 2); NaN where no model stands."""
        found = np.full(len(plan), np.nan)
        if not len(plan):
            return found
        for row in self._tree.query(shapely.box(*plan.min(axis=0), *plan.max(axis=0))):
            faces, planes = self._faces_of(int(row))
            for face, (a, b, c, x, y) in zip(faces, planes):
                inside = shapely.intersects_xy(face, plan[:, 0], plan[:, 1])
                found[inside] = np.fmax(found[inside], a * (plan[inside, 0] - x) + b * (plan[inside, 1] - y) + c)
        return found

    def _faces_of(self, row: int) -> tuple[np.ndarray, np.ndarray]:
        """Faces of a building that have a plan, and their planes (n, 5): slopes, height and the place of that."""
        if row not in self._faces:
            faces = shapely.get_parts(self._models[row])
            faces = faces[shapely.area(faces) > LEAST_FACE]  # others are walls
            planes = np.array([_plane(face) for face in faces]).reshape(-1, 5)
            shapely.prepare(faces)
            self._faces[row] = faces, planes
        return self._faces[row]


def _plane(face: shapely.Polygon) -> tuple[float, float, float, float, float]:
    """Slopes in east and north, and the height at the middle of a face's vertices."""
    vertices = shapely.get_coordinates(face.exterior, include_z=True)[:-1]
    middle = vertices.mean(axis=0)
    following = np.roll(vertices, -1, axis=0)
    normal = np.cross(vertices - middle, following - middle).sum(axis=0)
    return -normal[0] / normal[2], -normal[1] / normal[2], middle[2], middle[0], middle[1]
