"""Edges of building models and lines in space, in short pieces that can be projected into images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InputError
from ...wording import say

STEP = 0.25
"""Length of the pieces, m."""

_FLAT = np.cos(np.radians(5.0))
"""Faces that meet flatter than this have no edge that anybody sees."""

_GRAIN = 0.002
"""Coordinates nearer than this are one corner, m."""


@dataclass(frozen=True, eq=False)
class EdgeSamples:
    """Places along edges: `place` (n, 3), m; `edge` (n,) the number of the edge, rising; neighbours in a row."""

    place: np.ndarray
    edge: np.ndarray

    def __len__(self) -> int:
        return len(self.edge)


def edge_segments(geometries: Sequence[shapely.Geometry | None]) -> np.ndarray:
    """Straight edges (n, 2, 3), m, of lines with heights, and of the faces of models where they meet at an angle.

    An edge that two faces of nearly one plane share is left out; one that belongs to one face only stays.

    Raises
    ------
    InputError : none of the geometries has heights.
    """
    parts = shapely.get_parts([item for item in geometries if item is not None and not shapely.is_empty(item)])
    if len(parts) and not shapely.has_z(parts).any():
        raise InputError(say("The models or lines have no heights, without which they have no place in an image: "
                             "give models or lines with heights (for lines: QGIS's “Drape”)."))
    kinds = shapely.get_type_id(parts)
    lines = [_pieces(part) for part in parts[(kinds == 1) | (kinds == 2)]]
    return np.concatenate([*lines, _face_edges(parts[kinds == 3])]) if len(parts) else np.empty((0, 2, 3))


def _pieces(line: shapely.Geometry) -> np.ndarray:
    """Straight pieces (n, 2, 3) of a line."""
    corners = shapely.get_coordinates(line, include_z=True)
    return np.stack([corners[:-1], corners[1:]], axis=1)


def _face_edges(faces: np.ndarray) -> np.ndarray:
    """Edges (n, 2, 3) of polygons in space."""
    segments, normals = [np.empty((0, 2, 3))], [np.empty((0, 3))]
    for face in faces:
        normal = _normal(shapely.get_coordinates(face.exterior, include_z=True))
        for ring in (face.exterior, *face.interiors):
            segments.append(_pieces(ring))
            normals.append(np.broadcast_to(normal, (len(segments[-1]), 3)))
    segment, normal = np.concatenate(segments), np.concatenate(normals)
    ends = np.rint(segment / _GRAIN).astype(np.int64)
    swapped = [tuple(a) > tuple(b) for a, b in ends.tolist()]
    ends[swapped] = ends[swapped][:, ::-1]
    _, first, member = np.unique(ends.reshape(-1, 6), axis=0, return_index=True, return_inverse=True)
    member = member.ravel()
    lowest = np.ones(len(first))
    np.minimum.at(lowest, member, np.einsum("ni,ni->n", normal, normal[first[member]]))
    alone = np.bincount(member, minlength=len(first)) == 1
    return segment[first[alone | (lowest < _FLAT)]]


def _normal(ring: np.ndarray) -> np.ndarray:
    """Unit normal of a ring (n, 3) by Newell's sums; zeros where it has no area."""
    corner, next_corner = ring[:-1], ring[1:]
    total = np.cross(corner - ring[0], next_corner - ring[0]).sum(axis=0)
    length = np.linalg.norm(total)
    return total / length if length > 0 else total


def edge_samples(segments: np.ndarray, step: float = STEP) -> EdgeSamples:
    """Places at most `step` m apart along segments (n, 2, 3), their ends among them."""
    length = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    pieces = np.maximum(np.ceil(length / step).astype(int), 1)
    edge = np.repeat(np.arange(len(segments)), pieces + 1)
    first = np.concatenate([[0], np.cumsum(pieces + 1)])[:-1]
    share = (np.arange(len(edge)) - first[edge]) / pieces[edge]
    return EdgeSamples(segments[edge, 0] + share[:, None] * (segments[edge, 1] - segments[edge, 0]), edge)
