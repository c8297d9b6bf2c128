"""Places and times of a survey's points in half the bytes: as its files hold them, and to the second.

Sorting points into tiles moves each of them several times through memory, and through the disk once they are many.
"""

from __future__ import annotations

from collections.abc import Sequence

import laspy
import numpy as np

from .passes import BLOCK, SurveyPasses

_FARTHEST = 2**31 - 1


class PackedPoints:
    """Packs points of files with these headers, and gives back just the coordinates that laspy gives.

    Parameters
    ----------
    headers : of all files; those with the same scales and offsets are of one kind.
    """

    def __init__(self, headers: Sequence[laspy.LasHeader]):
        self._kinds = list(dict.fromkeys(_kind(header.scales, header.offsets) for header in headers))
        self._number = {kind: number for number, kind in enumerate(self._kinds)}
        fields = [("X", "<i4"), ("Y", "<i4"), ("Z", "<i4"), ("block", "<i4")]
        self.dtype = np.dtype(fields if len(self._kinds) == 1 else [*fields, ("kind", "<u4")])
        self._first: int | None = None

    def packed(self, chunk: laspy.ScaleAwarePointRecord, time: np.ndarray) -> np.ndarray:
        """Records (n,) of `dtype` for the points of a chunk with their times (n,), s."""
        records = np.empty(len(chunk), self.dtype)
        for name in "XYZ":
            records[name] = chunk.array[name]
        block = np.floor(time / BLOCK)
        if self._first is None and len(block):
            self._first = int(np.nan_to_num(block[0]))
        records["block"] = self._since_first(block)
        if len(self._kinds) > 1:
            records["kind"] = self._number[_kind(chunk.scales, chunk.offsets)]
        return records

    def column(self, records: np.ndarray, name: str, rows: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Coordinates "x", "y" or "z" of records, or of some rows of them, m."""
        axis, whole = "xyz".index(name), records[name.upper()][rows]
        if len(self._kinds) == 1:
            scale, offset = (corner[axis] for corner in self._kinds[0])
        else:
            kind = records["kind"][rows]
            scale, offset = (np.array([one[part][axis] for one in self._kinds])[kind] for part in (0, 1))
        place = whole * scale
        place += offset
        return place

    def extent(self, records: np.ndarray, name: str, rows: np.ndarray | slice = slice(None)) -> tuple[float, float]:
        """Least and largest coordinate of records, or of some rows of them, m: of files of one kind without all."""
        if len(self._kinds) > 1:
            place = self.column(records, name, rows)
        else:
            whole = records[name.upper()][rows]
            scale, offset = (corner["xyz".index(name)] for corner in self._kinds[0])
            place = np.array([whole.min(), whole.max()]) * scale + offset
        return place.min(), place.max()

    def passes(self, records: np.ndarray, passes: SurveyPasses) -> np.ndarray:
        """Number of the pass of each record, (n,): passes begin at whole blocks."""
        starts = self._since_first(np.floor(passes.starts / BLOCK))
        return SurveyPasses(starts).of(records["block"])

    def _since_first(self, block: np.ndarray) -> np.ndarray:
        """Blocks since that of the first point, whole numbers of 32 bits; what is no number comes last."""
        since = np.nan_to_num(block - (self._first or 0), nan=_FARTHEST)
        return np.clip(since, -_FARTHEST, _FARTHEST).astype(np.int32)


def _kind(scales: np.ndarray, offsets: np.ndarray) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Scales and offsets as a name."""
    return tuple(np.asarray(scales, float).tolist()), tuple(np.asarray(offsets, float).tolist())
