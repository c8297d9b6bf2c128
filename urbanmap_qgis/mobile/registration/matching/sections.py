"""The path in sections of a few hundred metres, and the correction's course on each, here or on an executor."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from functools import partial

import numpy as np

from ....execution import in_order
from ....progress import Progress
from ..records import RegistrationSettings
from ..start.fast_drift import fast_drift_rate
from ..start.initial_shifts import InitialShifts
from ..start.patch_points import PatchPoints
from ..start.patches import Patches
from ..start.reference import Reference
from .path_section import AdjustedSection, PathSection, adjust_section
from .windows import Windows

_SECTION_PATCHES = 400  # patches of a section's core
_AROUND = 10  # patches of a section more than its windows need


def adjusted_sections(points: PatchPoints, patches: Patches, windows: Windows, start: InitialShifts,
                      reference: Reference, settings: RegistrationSettings, progress: Progress,
                      executor: Executor | None) -> list[AdjustedSection]:
    """The result of every section, in the order of the path."""
    sections = list(_sections(points, patches, windows, start))
    work = partial(adjust_section, reference=reference, settings=settings)
    adjusted = []
    for result in in_order(work, sections, executor, progress.check):
        adjusted.append(result)
        progress.step(len(adjusted) / len(sections))
    return adjusted


def _sections(points: PatchPoints, patches: Patches, windows: Windows, start: InitialShifts) -> Iterator[PathSection]:
    """Pieces of the path with the points of all windows in them."""
    fast = fast_drift_rate(patches.chainage, start.shift_at(np.arange(len(patches))))
    for core_first in range(0, len(patches), _SECTION_PATCHES):
        core_last = min(core_first + _SECTION_PATCHES, len(patches)) - 1
        core = slice(core_first, core_last + 1)
        first = max(int(windows.first[core].min()) - _AROUND, 0)
        last = min(int(windows.last[core].max()) + _AROUND, len(patches) - 1)
        rows = np.arange(first, last + 1)
        yield PathSection(first, core_first - first, core_last - first, patches.chainage[rows], patches.stop_time[rows],
                      patches.place[rows],
                      start.shift_at(rows), fast[rows], windows.first[core] - first, windows.last[core] - first,
                      points.of_patches(first, last))
