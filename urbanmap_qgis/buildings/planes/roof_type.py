"""What a roof is, in one word, from its planes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..quality import RoofCell

FLAT, SHED, GABLE, HIP, MIXED, COMPLEX = "flat", "shed", "gable", "hip", "flat and sloped", "complex"

LEVEL = np.tan(np.radians(5.0))
FEW, MOST = 0.1, 0.9
"""Shares of the plan that do not count, and that decide."""

SAME_WAY = 20.0
"""Degrees between directions that are one."""


def roof_type(cells: Sequence[RoofCell]) -> str:
    """Flat, shed, gable, hip, flat and sloped, or complex: by the plan area under each direction of fall."""
    area = np.array([cell.polygon.area for cell in cells])
    gradient = np.array([cell.gradient for cell in cells]).reshape(-1, 2)
    sloped = np.hypot(gradient[:, 0], gradient[:, 1]) > LEVEL
    share = area[sloped].sum() / area.sum()
    if share < FEW:
        return FLAT
    ways = _ways(np.degrees(np.arctan2(-gradient[sloped, 0], -gradient[sloped, 1])), area[sloped])
    if share < MOST:
        return MIXED
    way, weight = ways[:, 0], ways[:, 1] / ways[:, 1].sum()
    if weight[0] > MOST:
        return SHED
    if len(way) > 1 and weight[:2].sum() > MOST and _angle_between(way[0], way[1]) > 180 - SAME_WAY:
        return GABLE
    if len(way) >= 3 and weight[:4].sum() > MOST and all(
            min(_angle_between(one, way[0]) % 90, 90 - _angle_between(one, way[0]) % 90) < SAME_WAY
            for one in way[1:4]):
        return HIP
    return COMPLEX


def _ways(azimuth: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Directions of fall (degrees) with the area of each, the largest first."""
    found: list[list[float]] = []
    for row in np.argsort(-area, kind="stable"):
        near = next((one for one in found if _angle_between(one[0], azimuth[row]) < SAME_WAY), None)
        if near is None:
            found.append([float(azimuth[row]), float(area[row])])
        else:
            near[1] += float(area[row])
    return np.array(sorted(found, key=lambda one: -one[1]))


def _angle_between(one: float, two: float) -> float:
    """Angle between two directions, 0 to 180 degrees."""
    return abs((one - two + 180.0) % 360.0 - 180.0)
