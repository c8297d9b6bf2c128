"""How far overlapping frames disagree on the ground: shows a bad orientation before the mosaic is trusted.

Patches with road markings (bright and narrow) that two frames see are compared by phase correlation.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from ..geometry.grid import Grid
from ..progress import SILENT, Progress
from .mosaic import GroundView, ViewSource, reaching, tiles

PATCH = 64
"""Pixels, side of the patches compared."""

_TILES = 8
_NARROW = 11  # pixels: wider things are no markings
_CONTRAST = 0.12  # of the brightest: what a marking stands out by at least
_MIN_BRIGHT_SHARE = 0.01
_CLEAR_PEAK = 0.3
_MIN_PATCHES = 5


_MAX_WARNINGS = 5
_OVERLAP = 4  # patches overlap by half in both directions: so many of them speak of the same ground


@dataclass(frozen=True)
class FrameShift:
    """The second frame's ground relative to the first's.

    Attributes
    ----------
    first, second : names.
    places : (n, 2) x and y of the middles of the patches that spoke, in the grid's system.
    vectors : (n, 2) east and north shift of each, m.
    """

    first: str
    second: str
    places: np.ndarray
    vectors: np.ndarray

    @property
    def patches(self) -> int:
        """How many patches spoke."""
        return len(self.vectors)

    @property
    def east(self) -> float:
        """m, median over the patches."""
        return float(np.median(self.vectors[:, 0]))

    @property
    def north(self) -> float:
        """m, median over the patches."""
        return float(np.median(self.vectors[:, 1]))

    @property
    def length(self) -> float:
        """m, of the median shift."""
        return float(np.hypot(self.east, self.north))

    @property
    def spread(self) -> float:
        """Standard deviation of one patch in east and in north, m, from the median absolute deviation."""
        return float(1.4826 * np.median(np.abs(self.vectors - np.median(self.vectors, axis=0))))

    @property
    def sigma(self) -> float:
        """Standard deviation of the median shift in east and in north, m; of overlapping patches a fourth counts."""
        return float(np.sqrt(np.pi / 2) * self.spread / np.sqrt(max(self.patches / _OVERLAP, 1)))


def shift_columns(shifts: Sequence[FrameShift], pixel: float) -> dict[str, np.ndarray]:
    """One row a patch for a layer, with the patch's own shift and that of its pair of frames.

    Parameters
    ----------
    pixel : of the mosaic, m. Pairs that lie farther apart than that, and than three times their sigma, are `apart`.

    Returns
    -------
    x, y; first, second; east, north, length, sigma : of the patch, m; pair_east, pair_north, pair_length, pair_sigma,
    patches : of the pair; status : "agree" or "apart".
    """
    count = [shift.patches for shift in shifts]
    columns = {"x": np.concatenate([shift.places[:, 0] for shift in shifts] or [np.zeros(0)]),
               "y": np.concatenate([shift.places[:, 1] for shift in shifts] or [np.zeros(0)])}
    for name in ("first", "second"):
        columns[name] = np.repeat(np.array([getattr(shift, name) for shift in shifts], object), count)
    vectors = np.concatenate([shift.vectors for shift in shifts] or [np.zeros((0, 2))])
    columns.update(east=vectors[:, 0], north=vectors[:, 1], length=np.hypot(*vectors.T))
    for name, value in (("sigma", "spread"), ("pair_east", "east"), ("pair_north", "north"),
                        ("pair_length", "length"), ("pair_sigma", "sigma")):
        columns[name] = np.repeat(np.array([getattr(shift, value) for shift in shifts], float), count)
    columns["patches"] = np.repeat(np.array(count, np.int64), count)
    columns["status"] = np.repeat(np.array(["apart" if apart(shift, pixel) else "agree" for shift in shifts], object),
                                  count)
    return columns


def apart(shift: FrameShift, pixel: float) -> bool:
    """Whether two frames lie more than a pixel apart on the markings, and surely so (three sigma)."""
    return shift.length > max(pixel, 3 * shift.sigma)


def warn_of_shifts(shifts: Sequence[FrameShift], pixel: float, progress: Progress) -> None:
    """Warn of the pairs that are apart, the worst first."""
    bad = sorted((shift for shift in shifts if apart(shift, pixel)), key=lambda shift: -shift.length)
    for shift in bad[:_MAX_WARNINGS]:
        progress.warn(f"{shift.first} and {shift.second} lie {shift.length:.2f} m apart on the road markings (east "
                      f"{shift.east:.2f}, north {shift.north:.2f}, sigma {shift.sigma:.2f}; {shift.patches} places): "
                      "check their orientation and the ground.")
    if len(bad) > _MAX_WARNINGS:
        progress.warn(f"{len(bad) - _MAX_WARNINGS} more pairs of images lie more than a pixel apart.")


def frame_shifts(sources: Sequence[ViewSource], grid: Grid, progress: Progress = SILENT,
                 metres: float = 1.0) -> list[FrameShift]:
    """Shifts between all pairs of sources that share at least five patches with markings, in the sources' order.

    Looks at a few pieces of the grid, spread evenly. `metres` : in a unit of the grid.
    """
    pieces = list(tiles(grid))
    pieces = [pieces[k] for k in np.unique(np.linspace(0, len(pieces) - 1, min(_TILES, len(pieces))).astype(int))]
    found: dict[tuple[int, int], list[np.ndarray]] = defaultdict(list)
    for done, (_, _, tile) in enumerate(pieces):
        progress.step(done / len(pieces))
        views = [(number, source.view(tile)) for number, source in reaching(sources, tile)]
        marked = [(number, view, _markings(view)) for number, view in views if view is not None]
        for k, (first, view, markings) in enumerate(marked):
            for second, other, its_markings in marked[k + 1:]:
                patches = _patch_shifts(markings, its_markings, view.seen & other.seen)
                # From columns and rows of the tile to the ground.
                found[first, second].append(patches * (tile.cell, -tile.cell, tile.cell * metres, -tile.cell * metres)
                                            + (tile.x_min, tile.y_max, 0.0, 0.0))
    result = []
    for (first, second), parts in sorted(found.items()):
        patches = np.concatenate(parts)
        if len(patches) >= _MIN_PATCHES:
            result.append(FrameShift(sources[first].name, sources[second].name, patches[:, :2], patches[:, 2:]))
    return result


def _markings(view: GroundView) -> np.ndarray:
    """What is brighter than its surroundings and narrow, as a share of the brightest, float32."""
    grey = view.values.mean(axis=-1)
    return cv2.morphologyEx(grey, cv2.MORPH_TOPHAT, np.ones((_NARROW, _NARROW), np.uint8)) / max(grey.max(), 1.0)


def _patch_shifts(first: np.ndarray, second: np.ndarray, both: np.ndarray) -> np.ndarray:
    """Middle (column, row; corners at whole numbers) and shift (columns, rows) of all patches with markings that both
    see, (n, 4)."""
    window = cv2.createHanningWindow((PATCH, PATCH), cv2.CV_32F)
    shifts = []
    for top in range(0, first.shape[0] - PATCH + 1, PATCH // 2):
        for left in range(0, first.shape[1] - PATCH + 1, PATCH // 2):
            part = slice(top, top + PATCH), slice(left, left + PATCH)
            if not both[part].all():
                continue
            a, b = first[part].copy(), second[part].copy()  # phaseCorrelate lays the window on what it is given
            if min((a > _CONTRAST).mean(), (b > _CONTRAST).mean()) < _MIN_BRIGHT_SHARE:
                continue
            shift, peak = cv2.phaseCorrelate(a, b, window)
            if peak > _CLEAR_PEAK:
                shifts.append((left + PATCH / 2, top + PATCH / 2, *shift))
    return np.array(shifts, float).reshape(-1, 4)
