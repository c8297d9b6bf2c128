"""What the road model is made of: pieces of road surface, their middle lines, what was found wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

ROAD, JUNCTION, BRIDGE, TUNNEL = "road", "junction", "bridge", "tunnel"
KINDS = (ROAD, JUNCTION, BRIDGE, TUNNEL)

SECTION_TYPES = {ROAD: "1", BRIDGE: "3", JUNCTION: "4", TUNNEL: "6"}
"""Codes of `RoadStructureAttribute_sectionType`."""


@dataclass(frozen=True, eq=False)
class RoadPiece:
    """One tran:Road of LOD1.

    Attributes
    ----------
    polygon : its surface, outer ring counterclockwise, m.
    kind : one of `KINDS`.
    width : mean width, m; NaN where it has no middle line.
    arms : roads that meet, of a junction; else 0.
    source : "official", as all that is made of given edges.
    status : "made" or "to look at".
    finding : why it is to be looked at; empty.
    function : code of `Road_function` that the surface it is cut from says; empty.
    """

    polygon: shapely.Polygon
    kind: str
    width: float
    arms: int = 0
    source: str = "official"
    status: str = "made"
    finding: str = ""
    function: str = ""


@dataclass(frozen=True, eq=False)
class AxisPiece:
    """A part of a road's middle line: points (n, 2), m, and the number of the piece that it lies in."""

    points: np.ndarray
    piece: int


@dataclass(frozen=True)
class RoadFinding:
    """What a person should look at: kind, sentence, place (m)."""

    kind: str
    text: str
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class RoadSurfaceModel:
    """All pieces with their middle lines and the findings."""

    pieces: tuple[RoadPiece, ...]
    axes: tuple[AxisPiece, ...]
    findings: tuple[RoadFinding, ...]

    def count(self, kind: str) -> int:
        """Number of pieces of a kind."""
        return sum(piece.kind == kind for piece in self.pieces)
