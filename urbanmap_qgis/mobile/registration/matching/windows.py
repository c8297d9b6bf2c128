"""Dynamic sliding windows: as short as the features in them allow (J 3.2.4.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import RegistrationSettings


@dataclass(frozen=True)
class Windows:
    """Patches that each patch is registered with.

    Attributes
    ----------
    first, last : (n,) numbers of the first and the last patch, both included.
    features : (n,) occupied cells in the window.
    """

    first: np.ndarray
    last: np.ndarray
    features: np.ndarray


class _Occupied:
    """Number of cells with enough points in a range of patches that grows and shrinks."""

    def __init__(self, patch: np.ndarray, cell: np.ndarray, patches: int, enough: int):
        code, count = np.unique(patch * (cell.max(initial=0) + 1) + cell, return_counts=True)
        self._cell, self._count = code % (cell.max(initial=0) + 1), count
        self._start = np.searchsorted(code // (cell.max(initial=0) + 1), np.arange(patches + 1))
        self._points = np.zeros(cell.max(initial=-1) + 1, dtype=np.int64)
        self._enough = enough
        self.first, self.last, self.features = 0, -1, 0

    def _change(self, patch: int, sign: int) -> None:
        part = slice(self._start[patch], self._start[patch + 1])
        cells = self._cell[part]  # each cell once: plain indexing adds rightly
        before = self._points[cells]
        after = before + sign * self._count[part]
        self._points[cells] = after
        self.features += int((after >= self._enough).sum()) - int((before >= self._enough).sum())

    def move(self, first: int, last: int) -> None:
        """Make the range that of the patches `first` to `last`."""
        while self.last < last:
            self.last += 1
            self._change(self.last, 1)
        while self.first > first:
            self.first -= 1
            self._change(self.first, 1)
        while self.last > last:
            self._change(self.last, -1)
            self.last -= 1
        while self.first < first:
            self._change(self.first, -1)
            self.first += 1


class _Counted:
    """Number of points in a range of patches."""

    def __init__(self, patch: np.ndarray, patches: int):
        self._before = np.concatenate([[0], np.cumsum(np.bincount(patch, minlength=patches))])
        self.first, self.last, self.features = 0, -1, 0

    def move(self, first: int, last: int) -> None:
        """Make the range that of the patches `first` to `last`."""
        self.first, self.last = first, last
        self.features = int(self._before[last + 1] - self._before[first])


def choose_windows(x: np.ndarray, y: np.ndarray, patch: np.ndarray, patches: int,
                   settings: RegistrationSettings) -> Windows:
    """The window of each patch.

    Parameters
    ----------
    x, y : (m,) marking points, m.
    patch : (m,) their patches.

    A window starts with `window_patches` round its patch and grows until `feature_count` cells of `feature_grid` hold
    `feature_points` points or more (or, with `window_points`, until it has so many points), or it is
    `max_window_patches` long. It grows at its end with `extend_at_end` (J 3.2.4.2), otherwise at both ends in turn, so
    that the patch stays in its middle.
    """
    occupied = _counter(x, y, patch, patches, settings)
    enough = settings.feature_count if settings.window_points is None else settings.window_points
    longest = settings.max_window_patches or 2 * (patches + settings.window_patches)
    first, last = np.empty(patches, dtype=np.int64), np.empty(patches, dtype=np.int64)
    features = np.empty(patches, dtype=np.int64)
    more = 0
    for number in range(patches):
        more = max(more - 2, 0)  # the next window holds this one less two patches, so it cannot be shorter
        while True:
            size = min(settings.window_patches + more, longest)
            before = settings.window_patches // 2 + (0 if settings.extend_at_end else more // 2)
            start = number - min(before, size - 1)
            occupied.move(max(start, 0), min(start + size, patches) - 1)
            whole = occupied.last == patches - 1 and (occupied.first == 0 or settings.extend_at_end)
            if occupied.features >= enough or size == longest or whole:
                break
            more += 1
        first[number], last[number], features[number] = occupied.first, occupied.last, occupied.features
    return Windows(first, last, features)


def _counter(x: np.ndarray, y: np.ndarray, patch: np.ndarray, patches: int,
             settings: RegistrationSettings) -> _Occupied | _Counted:
    """What counts the features of a window."""
    if settings.window_points is not None:
        return _Counted(patch, patches)
    column = np.floor((x - (x.min() if len(x) else 0.0)) / settings.feature_grid).astype(np.int64)
    row = np.floor((y - (y.min() if len(y) else 0.0)) / settings.feature_grid).astype(np.int64)
    _, cell = np.unique(row * (column.max(initial=0) + 1) + column, return_inverse=True)
    return _Occupied(patch, cell.reshape(-1), patches, settings.feature_points)
