"""Figures that tell how good a lane map is, from itself and the drives."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .map_records import DrivenPath, VectorMap

NEAR = 20.0
"""Drives count where they run so near to lanes of the map, m."""


@dataclass(frozen=True)
class MapFigures:
    """Figures of a lane map.

    Attributes
    ----------
    length : of lanes without virtual ones, m.
    by_evidence : their length by where the direction comes from, m.
    seen : share of the length of painted bounds along which a line was seen, 0 to 1; NaN without bounds.
    sigma : median of the bounds' standard deviations, m; NaN where unknown.
    driven, covered : length of the drives near the map, m, and the share of it inside lanes.
    breaks : places where a drive leaves the lanes, or a way along it could not be drawn.
    """

    length: float
    by_evidence: dict[str, float]
    seen: float
    sigma: float
    driven: float
    covered: float
    breaks: int


def map_figures(built: VectorMap, drives: Sequence[DrivenPath]) -> MapFigures:
    """Figures of a map and the drives that it was made with."""
    evidence: Counter = Counter()
    for lane in built.lanes:
        if lane.kind == "lane":
            evidence[lane.evidence] += shapely.LineString(lane.centre[:, :2]).length
    painted = [bound for bound in built.bounds if bound.kind != "virtual"]
    whole = sum(shapely.LineString(built.bound_points(bound)[:, :2]).length for bound in painted)
    sigmas = [bound.sigma for bound in painted if np.isfinite(bound.sigma)]
    driven, inside = _driven(built, drives)
    return MapFigures(built.driven_length(), dict(evidence),
                      1.0 - sum(bound.unseen for bound in painted) / whole if whole else np.nan,
                      float(np.median(sigmas)) if sigmas else np.nan, driven, inside / driven if driven else np.nan,
                      sum(finding.kind in ("driven without lane", "way not drawn") for finding in built.findings))


def _driven(built: VectorMap, drives: Sequence[DrivenPath]) -> tuple[float, float]:
    """Length of the drives near the map and inside its lanes, m."""
    areas = [shapely.make_valid(built.area(number)) for number in range(len(built.lanes))]
    if not areas:
        return 0.0, 0.0
    lanes = shapely.union_all(areas)
    near = lanes.buffer(NEAR)
    shapely.prepare(lanes)
    shapely.prepare(near)
    driven = inside = 0.0
    for drive in drives:
        steps = np.linalg.norm(np.diff(drive.places[:, :2], axis=0), axis=1)
        places = shapely.points((drive.places[:-1, :2] + drive.places[1:, :2]) / 2.0)
        driven += float(steps[shapely.contains(near, places)].sum())
        inside += float(steps[shapely.contains(lanes, places)].sum())
    return driven, inside
