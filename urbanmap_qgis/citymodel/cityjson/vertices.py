"""Pieces that all writers of CityJSON share: whole-number vertices, JSON text, the end of a file."""

from __future__ import annotations

import json
from array import array
from typing import IO, Any

import numpy as np

from ...geometry.tolerances import UNITS

_REMEMBERED = 250_000
"""Vertices kept at hand to be shared; files of fewer vertices share all of theirs."""


class VertexList:
    """The file's vertices: whole numbers, shared between faces and between neighbouring buildings.

    Memory for sharing is bounded: only the latest vertices are remembered.
    """

    def __init__(self) -> None:
        self.coordinates = array("q")
        self._recent: dict[tuple[int, int, int], int] = {}
        self._older: dict[tuple[int, int, int], int] = {}

    def numbers(self, points: np.ndarray) -> list[int]:
        """Numbers of points (n, 3) in the file."""
        return [self._number(tuple(point)) for point in np.rint(points * UNITS).astype(np.int64).tolist()]

    def _number(self, point: tuple[int, int, int]) -> int:
        number = self._recent.get(point)
        if number is None:
            number = self._older.get(point)
            if number is None:
                number = len(self.coordinates) // 3
                self.coordinates.extend(point)
            if len(self._recent) >= _REMEMBERED:
                self._older, self._recent = self._recent, {}
            self._recent[point] = number
        return number


def write_end(file: IO[str], vertices: VertexList, epsg: int | None, title: str, date: str = "") -> None:
    """Write transform, metadata (code of the reference system, title, date of the data) and vertices."""
    points = np.frombuffer(vertices.coordinates, dtype=np.int64).reshape(-1, 3)
    low = points.min(axis=0) if len(points) else np.zeros(3, dtype=np.int64)
    metadata: dict[str, Any] = {}
    if len(points):
        metadata["geographicalExtent"] = [value / UNITS for value in (*low.tolist(), *points.max(axis=0).tolist())]
    if epsg is not None:
        metadata["referenceSystem"] = f"https://www.opengis.net/def/crs/EPSG/0/{int(epsg)}"
    if title:
        metadata["title"] = title
    if date:
        metadata["referenceDate"] = date
    transform = {"scale": [1 / UNITS] * 3, "translate": [value / UNITS for value in low.tolist()]}
    file.write(f',"transform":{json_text(transform)},"metadata":{json_text(metadata)},"vertices":[')
    for start in range(0, len(points), 10_000):
        block = json_text((points[start:start + 10_000] - low).tolist())
        file.write((",\n" if start else "\n") + block[1:-1])
    file.write("\n]}\n")


def json_text(value: Any) -> str:
    """JSON of a value, without blanks, letters of all scripts as they are."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
