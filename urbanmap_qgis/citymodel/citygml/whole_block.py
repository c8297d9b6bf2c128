"""The block of a building in parts: PLATEAU's parts have no level 1, the building has one solid for all of them.

Source: the standard product specification of 3D city models (Project PLATEAU) 5.0, table 4-27 (a bldg:BuildingPart has
no lod1Solid), 4.2.2 (bldg:lod1Solid: the outline raised to one height, the median in principle) and B.3.10 (a solid is
a gml:Solid, no gml:CompositeSolid).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from ...geometry.tolerances import MILLIMETRE
from ..model import GROUND_SURFACE, ROOF_SURFACE, SOLID, WALL_SURFACE, CityObject, CityShape, CitySurface

_OWN = ("1.2", "1.3")
"""Levels that this program makes; a part's level "1" was read so from a file and stays as it was."""


def with_whole_block(building: CityObject) -> tuple[CityObject, bool]:
    """A building with the blocks of its parts as one of its own, and whether it lost them: parts that lie apart
    cannot be one solid. Parts that have nothing else keep theirs, since the building would have no geometry."""
    of_level = {level: [shape for part in building.parts for shape in part.shapes if shape.lod == level]
                for level in _OWN}
    blocks = of_level[_OWN[0]] or of_level[_OWN[1]]
    if not blocks:
        return building, False
    parts = tuple(replace(part, shapes=tuple(shape for shape in part.shapes if shape.lod not in _OWN))
                  for part in building.parts)
    if any(shape.lod[:1] == "1" for shape in building.shapes):
        return replace(building, parts=parts), False
    block = _block(blocks)
    if block is None and not building.shapes and not any(part.shapes for part in parts):
        return building, False
    shapes = building.shapes if block is None else (*building.shapes, block)
    return replace(building, shapes=shapes, parts=parts), block is None


def _block(blocks: list[CityShape]) -> CityShape | None:
    """One prism over the plans of several, as high as half of their area; None where they do not hang together."""
    grounds = [(_plan(surface), surface) for block in blocks for surface in block.shells[0]
               if surface.kind == GROUND_SURFACE]
    roofs = [(_plan(surface).area, float(surface.rings[0][:, 2].mean())) for block in blocks
             for surface in block.shells[0] if surface.kind == ROOF_SURFACE]
    if not grounds or not roofs:
        return None
    whole = shapely.union_all([plan for plan, _ in grounds], grid_size=MILLIMETRE)
    if whole.geom_type != "Polygon" or whole.is_empty:
        return None
    foot = min(float(surface.rings[0][:, 2].min()) for _, surface in grounds)
    areas, heights = np.array(sorted(roofs, key=lambda roof: roof[1])).T
    top = float(heights[np.searchsorted(np.cumsum(areas), areas.sum() / 2)])
    return CityShape(_OWN[0], SOLID, (_prism(orient(whole), foot, top),))


def _plan(surface: CitySurface) -> shapely.Polygon:
    return shapely.Polygon(surface.rings[0][:, :2], [ring[:, :2] for ring in surface.rings[1:]])


def _prism(plan: shapely.Polygon, foot: float, top: float) -> tuple[CitySurface, ...]:
    """Faces of a plan raised from its foot to its top, m, seen from outside."""
    rings = [shapely.get_coordinates(ring)[:-1] for ring in (plan.exterior, *plan.interiors)]

    def level(ring: np.ndarray, height: float) -> np.ndarray:
        return np.column_stack([ring, np.full(len(ring), height)])

    walls = [CitySurface((np.array([(*a, foot), (*b, foot), (*b, top), (*a, top)]),), WALL_SURFACE)
             for ring in rings for a, b in zip(ring, np.roll(ring, -1, axis=0))]
    return (CitySurface(tuple(level(ring, top) for ring in rings), ROOF_SURFACE),
            CitySurface(tuple(level(ring[::-1], foot) for ring in rings), GROUND_SURFACE), *walls)
