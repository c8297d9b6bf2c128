"""Sections of roads, made ready for lanes: bounds drawn on, and the stop lines that lie across each (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...settings.roadmap import MapSettings
from ..map_records import MapArea, MapLine
from .bound_continuation import continued
from .lane_strips import LIMITS as STRIP_LIMITS
from .road_sections import RoadSection, road_sections

STOP_REACH = 5.0
"""A stop line lies across a section no farther beyond its ends, m."""

PASSED = 12.0
"""A stop line has a crosswalk so near, or lines that end in half of that, m."""

BOUNDS = ("solid", "dashed", "road border")


def prepared_sections(lines: Sequence[MapLine], areas: Sequence[MapArea],
                      settings: MapSettings) -> list[tuple[RoadSection, list[np.ndarray]]]:
    """Road sections whose bounds are drawn on as far as anything shows them, each with the stop lines (n, 3) in it."""
    stops = [line.points for line in lines if line.kind == "stop line"]
    barriers = [area.polygon for area in areas if area.kind == "crosswalk"]
    prepared = []
    for section in road_sections([line for line in lines if line.kind in BOUNDS], barriers, settings):
        section.tracks = continued(section.tracks, section.axis, barriers, settings)
        near = [stop for stop in stops if _belongs(section, stop) and not _is_passed(section, stop, barriers)]
        prepared.append((section, near + _in_row(section, near, stops)))
    return prepared


def _in_row(section: RoadSection, near: Sequence[np.ndarray], stops: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Stop lines beside a section that are straight on from one of it: over what a vehicle hides both are one."""
    found = []
    for stop in stops:
        chainage, offset = section.axis.local(stop[:, :2])
        if any(stop is one for one in near) or np.ptp(chainage) > 0.7 * np.ptp(offset):
            continue
        for one in near:
            level, reach = section.axis.local(one[:, :2])
            gap = max(offset.min() - reach.max(), reach.min() - offset.max())
            if abs(level.mean() - chainage.mean()) < STRIP_LIMITS.straight and gap < STRIP_LIMITS.hidden:
                found.append(stop)
                break
    return found


def _is_passed(section: RoadSection, stop: np.ndarray, crosswalks: Sequence[shapely.Geometry]) -> bool:
    """Whether two lines or more run on beside a stop line, far from any crosswalk: there it is a part of a symbol."""
    line = shapely.LineString(stop[:, :2])
    if any(line.distance(area) < PASSED for area in crosswalks):
        return False
    at = float(section.axis.chainage(stop[:, :2]).mean())
    seen = [any(start < at - PASSED / 2.0 and end > at + PASSED / 2.0 for start, end, line in track.pieces if line)
            for track in section.tracks]
    return sum(seen) >= 2 and sum(seen) > 0.5 * sum(track.start < at < track.end for track in section.tracks)


def _belongs(section, stop: np.ndarray) -> bool:
    """Whether a stop line lies across a section, at or between its ends."""
    chainage, offset = section.axis.local(stop[:, :2])
    low = min(track.start for track in section.tracks) - STOP_REACH
    high = max(track.end for track in section.tracks) + STOP_REACH
    if not low <= chainage.mean() <= high or np.ptp(chainage) > 0.7 * np.ptp(offset):
        return False
    at = np.clip(chainage.mean(), low + STOP_REACH, high - STOP_REACH)
    beside = np.array([np.interp(at, track.chainage, track.offset) for track in section.tracks])
    return bool(offset.max() > beside.min() - 1.0 and offset.min() < beside.max() + 1.0)
