"""Closed solids: what building models are made of."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .kept_answers import Kept
from .ring_products import cross_with_next

ROOF, OUTER_WALL, INNER_WALL, GROUND = "roof", "outer wall", "inner wall", "ground"
OVERHANG = "overhang"
"""Underside of a part that stands out over what is below it; only models joined with measured walls have any."""

Face = tuple[tuple[int, ...], ...]
"""Rings of vertex indices, not closed, the outer one first; counterclockwise seen from outside."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A closed solid with level or sloped roofs, vertical walls and a horizontal ground.

    Attributes
    ----------
    vertices : (V, 3) coordinates, m.
    faces : for each face its rings of vertex indices, outer ring first.
    surface_type : of each face: "roof", "outer wall", "inner wall", "ground" or "overhang".
    roof_id : of each face: the roof, or for a wall the roof whose edge is its upper one; None for the ground.
    mended_nodes : plan nodes where a corner of about 1 cm was moved between cells to keep the solid valid.
    unrepaired_nodes : nodes whose corners were too sharp for that: the solid is not valid there.
    raised_roofs : roofs at or below the base, put at the least height above it.
    """

    vertices: np.ndarray
    faces: tuple[Face, ...]
    surface_type: tuple[str, ...]
    roof_id: tuple[Hashable, ...]
    mended_nodes: int = 0
    unrepaired_nodes: int = 0
    raised_roofs: int = 0


@dataclass(frozen=True, eq=False)
class FaceTexture:
    """The part of an image that covers a face.

    Attributes
    ----------
    image : name of the image file, relative to the model's file.
    uv : (n, 2) for each ring of the face: place of its vertices in the image, from the lower left corner, 0 to 1.
    """

    image: str
    uv: tuple[np.ndarray, ...]


def surfaces(solid: Solid, kind: str | None = None) -> np.ndarray:
    """Faces of a solid, all or those of one surface type, as an array of shapely polygons with z."""
    faces = [face for face, face_type in zip(solid.faces, solid.surface_type) if kind in (None, face_type)]
    rings = [ring for face in faces for ring in face]
    if not rings:
        return np.empty(0, dtype=object)
    closed = np.array([vertex for ring in rings for vertex in (*ring, ring[0])])
    lines = shapely.linearrings(solid.vertices[closed], indices=np.repeat(
        np.arange(len(rings)), [len(ring) + 1 for ring in rings]))
    return shapely.polygons(lines, indices=np.repeat(
        np.arange(len(faces)), [len(face) for face in faces]))


def multipolygon(solids: Sequence[Solid]) -> shapely.MultiPolygon:
    """All faces of a building's solids as one MultiPolygon with z."""
    return shapely.MultiPolygon([polygon for solid in solids for polygon in surfaces(solid)])


@Kept
def volume(solid: Solid) -> float:
    """Volume of a closed solid, m3, by the divergence theorem over its faces."""
    points = solid.vertices - solid.vertices.min(axis=0)
    total = 0.0
    for face in solid.faces:
        for ring in face:
            corners = points[list(ring)]
            total += float(cross_with_next(corners).sum(axis=0) @ corners[0])
    return total / 6.0
