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
from .mosaic import Source, View, reaching, tiles

PATCH = 64
"""Pixels, side of the patches compared."""

_TILES = 8
_NARROW = 11  # pixels: wider things are no markings
_CONTRAST = 0.12  # of the brightest: what a marking stands out by at least
_FEWEST_BRIGHT = 0.01
_CLEAR_PEAK = 0.3
_FEWEST_PATCHES = 5


@dataclass(frozen=True)
class FrameShift:
    """The second frame's ground relative to the first's.

    Attributes
    ----------
    first, second : names.  east, north : m, median over the patches.  patches : how many spoke.
    """

    first: str
    second: str
    east: float
    north: float
    patches: int

    @property
    def length(self) -> float:
        """m."""
        return float(np.hypot(self.east, self.north))


def frame_shifts(sources: Sequence[Source], grid: Grid, progress: Progress = SILENT) -> list[FrameShift]:
    """Shifts between all pairs of sources that share at least five patches with markings, in the sources' order.

    Looks at a few pieces of the grid, spread evenly.
    """
    pieces = list(tiles(grid))
    pieces = [pieces[k] for k in np.unique(np.linspace(0, len(pieces) - 1, min(_TILES, len(pieces))).astype(int))]
    found = defaultdict(list)
    for done, (_, _, tile) in enumerate(pieces):
        progress.step(done / len(pieces))
        views = [(number, source.view(tile)) for number, source in reaching(sources, tile)]
        marked = [(number, view, _markings(view)) for number, view in views if view is not None]
        for k, (first, view, markings) in enumerate(marked):
            for second, other, its_markings in marked[k + 1:]:
                found[first, second] += _patch_shifts(markings, its_markings, view.seen & other.seen)
    result = []
    for (first, second), shifts in sorted(found.items()):
        if len(shifts) >= _FEWEST_PATCHES:
            east, south = np.median(shifts, axis=0) * grid.cell
            result.append(FrameShift(sources[first].name, sources[second].name, float(east), float(-south),
                                     len(shifts)))
    return result


def _markings(view: View) -> np.ndarray:
    """What is brighter than its surroundings and narrow, as a share of the brightest, float32."""
    grey = view.values.mean(axis=-1)
    return cv2.morphologyEx(grey, cv2.MORPH_TOPHAT, np.ones((_NARROW, _NARROW), np.uint8)) / max(grey.max(), 1.0)


def _patch_shifts(first: np.ndarray, second: np.ndarray, both: np.ndarray) -> list[tuple[float, float]]:
    """Shifts (columns, rows) of all patches with markings that both see."""
    window = cv2.createHanningWindow((PATCH, PATCH), cv2.CV_32F)
    shifts = []
    for top in range(0, first.shape[0] - PATCH + 1, PATCH // 2):
        for left in range(0, first.shape[1] - PATCH + 1, PATCH // 2):
            part = slice(top, top + PATCH), slice(left, left + PATCH)
            if not both[part].all():
                continue
            a, b = first[part].copy(), second[part].copy()  # phaseCorrelate lays the window on what it is given
            if min((a > _CONTRAST).mean(), (b > _CONTRAST).mean()) < _FEWEST_BRIGHT:
                continue
            shift, peak = cv2.phaseCorrelate(a, b, window)
            if peak > _CLEAR_PEAK:
                shifts.append(shift)
    return shifts
