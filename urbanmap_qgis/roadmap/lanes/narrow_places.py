"""Places where a drive runs between two lines that leave less than a lane."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...settings.roadmap import MapSettings
from ...wording import say
from ..map_records import DrivenPath, Finding
from .road_sections import STEP, RoadSection

LEAST_WIDTH = 1.2
"""Lines nearer to each other have no vehicle between them, m."""

LEAST_LENGTH = 5.0
"""Shorter places are left, m."""

NARROW = "too narrow"
"""Kind of these findings."""


def narrow_places(section: RoadSection, drives: Sequence[DrivenPath], settings: MapSettings) -> list[Finding]:
    """A finding for each stretch between neighbouring bounds that is driven but narrower than a lane."""
    tracks = section.tracks
    if len(tracks) < 2 or not drives:
        return []
    at = np.arange(min(track.start for track in tracks), max(track.end for track in tracks), STEP)
    offset = np.array([track.interpolate(at) for track in tracks])
    local = [section.axis.local(drive.places[:, :2]) for drive in drives]
    findings = []
    for right in range(len(tracks)):
        for left in range(len(tracks)):
            wide = offset[left] - offset[right]
            narrow = (wide >= LEAST_WIDTH) & (wide < settings.min_width)
            edges = np.flatnonzero(np.diff(np.concatenate([[0], narrow.astype(np.int8), [0]]))).reshape(-1, 2)
            for first, last in edges[(edges[:, 1] - edges[:, 0]) * STEP >= LEAST_LENGTH]:
                span = at[first], at[last - 1]
                if any(_drives_between(tracks[right], tracks[left], *one, span) for one in local):
                    foot, along = section.axis.frame(np.array([np.mean(span)]))
                    across = float(np.mean([offset[k][(first + last) // 2] for k in (right, left)]))
                    x, y = foot[0] + across * np.array([-along[0, 1], along[0, 0]])
                    findings.append(Finding(NARROW, say("A drive runs between lines that leave less than a lane: "
                                                        "{min:.1f} m, for {span:.0f} m; no lane was made.",
                                                        min=wide[first:last].min(),
                                                        span=span[1] - span[0]), float(x), float(y)))
    return findings


def _drives_between(right, left, chainage: np.ndarray, offset: np.ndarray, span: tuple[float, float]) -> bool:
    """Whether a drive (chainages and offsets) runs between two tracks for half of a stretch."""
    inside = (chainage >= span[0]) & (chainage <= span[1])
    inside &= (offset > right.interpolate(chainage)) & (offset < left.interpolate(chainage))
    return bool(inside.any() and np.ptp(chainage[inside]) >= (span[1] - span[0]) / 2.0)


def passes_narrow_place(findings: Sequence[Finding], path: np.ndarray) -> bool:
    """Whether a path (n, 2 or 3) runs through such a place."""
    places = [shapely.Point(one.x, one.y) for one in findings if one.kind == NARROW]
    line = shapely.LineString(path[:, :2]) if len(path) > 1 else shapely.Point(path[0, :2])
    return any(line.distance(place) < LEAST_WIDTH for place in places)
