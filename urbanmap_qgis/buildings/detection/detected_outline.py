"""The outline of one building from its roof points, with its figures and what speaks against a building.

Its edges run through the outermost roof points. The roof ends about half a spacing further out, and the walls, which
official outlines show, stand about as far inside the roof's edge. (Delft, 8 points/m2: overlap with the official
outlines .88 so, .85 with edges where the roofs end.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...errors import InsufficientDataError
from ...settings.buildings import DetectionSettings
from ...wording import mark, say
from ..polygons.outline_from_points import outline_from_points

OK, LOW, MOVABLE, DECK, AFLOAT = "ok", mark("low"), mark("movable"), mark("deck"), mark("no ground")
"""States: a building; lower than a storey; of the size of a vehicle or container; a surface that goes on into the
ground, such as a bridge; nothing of the ground about it, such as a ship or a crane's arm."""

LEAST_STOREY = 2.5
"""Height (m) of the lowest storey that building rules of many countries take for a room (Japan 2.1, Germany 2.4)."""
WIDEST_VEHICLE, LONGEST_VEHICLE, HIGHEST_VEHICLE = 2.6, 18.75, 4.2
"""Sizes (m) that vehicles may have on roads (EU directive 96/53/EC; containers of ISO 668 are smaller)."""
MAX_STEP = 0.5
"""Step (m) at the edge of a surface below which it goes on into the ground."""
TOP = 0.9
"""Share of the roof points that lie below the height of a building, so that chimneys and aerials do not count."""
SPUR_SPACINGS = 3.0
"""Width, in spacings of the points, below which a part of an outline is a spur."""
DECK_SHARE, GROUND_SHARE = 0.08, 0.2
"""Shares of the edge: with more of it going on into the ground the surface is a deck; with less of it above any ground
it hangs or swims."""


@dataclass(frozen=True)
class DetectedBuilding:
    """Outline (Polygon or MultiPolygon) and figures of a building that was found in points.

    Attributes
    ----------
    height : m of nine tenths of the roof points over the ground, and `ground` its height.
    density : roof points/m2.
    sigma : m, of the place of its edges.
    confidence : mean probability that its points are a roof.
    status, reason : one of the states above, and why.
    """

    outline: shapely.Geometry
    height: float
    ground: float
    points: int
    density: float
    sigma: float
    confidence: float
    status: str
    reason: str

    @property
    def area(self) -> float:
        """Area of the outline, m2."""
        return float(self.outline.area)


def detected_building(roof: np.ndarray, density: float, settings: DetectionSettings) -> DetectedBuilding | None:
    """Building of some roof points; None where they make no area of the least size.

    Parameters
    ----------
    roof : (n,) points as records of `roof_points.ROOF`.
    density : roof points/m2.
    """
    roof = roof[np.lexsort((roof["z"], roof["y"], roof["x"]))]  # whatever order files and tiles had
    try:
        drawn = outline_from_points(roof["x"], roof["y"], density, regularity=settings.regularity,
                                    outward=False)
    except InsufficientDataError:
        return None
    outline = _without_spurs(drawn.outline, 1.0 / math.sqrt(density), settings.min_area)
    if outline is None:
        return None
    height = float(np.quantile(roof["height"], TOP))
    status, reason = _state(outline, roof, height)
    return DetectedBuilding(outline, height, float(np.median(roof["z"] - roof["height"])), len(roof),
                            len(roof) / outline.area, math.hypot(drawn.rms, 0.5 / math.sqrt(density)),
                            float(np.mean(1.0 / (1.0 + np.exp(-roof["odds"])))), status, reason)


def _without_spurs(outline: shapely.Geometry, spacing: float, min_area: float) -> shapely.Geometry | None:
    """Outline without what is narrower than a few points, such as branches over a roof's edge; None where nothing of
    the least area (m2) is left. `spacing` of the points, m."""
    width = SPUR_SPACINGS * spacing
    opened = shapely.buffer(shapely.buffer(outline, -width / 2.0, join_style="mitre"), width / 2.0, join_style="mitre")
    parts = [part for part in shapely.get_parts(opened) if part.area >= min_area]
    return None if not parts else parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)


def _state(outline: shapely.Geometry, roof: np.ndarray, height: float) -> tuple[str, str]:
    """State of what was found, and why."""
    if height < LEAST_STOREY:
        return LOW, say("It is {height:.1f} m high.", height=height)
    width, length = sorted(_sides(outline))
    if width <= WIDEST_VEHICLE and length <= LONGEST_VEHICLE and height <= HIGHEST_VEHICLE:
        return MOVABLE, say("{length:.1f} m by {width:.1f} m, {height:.1f} m high: it may be a vehicle or a container.",
                            length=length, width=width, height=height)
    step = _steps_at_edge(outline, roof)
    if (step < MAX_STEP).mean() > DECK_SHARE:
        return DECK, say("{share:.0%} of its edge goes on into the ground without a step.",
                         share=float((step < MAX_STEP).mean()))
    if np.isfinite(step).mean() < GROUND_SHARE:
        return AFLOAT, say("Ground was seen along {share:.0%} of its edge only.",
                           share=float(np.isfinite(step).mean()))
    return OK, ""


def _sides(outline: shapely.Geometry) -> tuple[float, float]:
    """Sides (m) of the smallest rectangle about an outline."""
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(outline))
    first, second = np.hypot(*(corners[1:3] - corners[:2]).T).tolist()
    return first, second


def _steps_at_edge(outline: shapely.Geometry, roof: np.ndarray) -> np.ndarray:
    """Steps (n,) down to the ground, m, at places along an outline's edge; NaN where no ground was seen."""
    places = shapely.get_coordinates(shapely.segmentize(shapely.get_rings(shapely.get_parts(outline)), 1.0))
    return roof["step"][cKDTree(np.column_stack([roof["x"], roof["y"]])).query(places)[1]]
