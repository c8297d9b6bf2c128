"""Figures of building models that users of city models ask for: heights, volumes, areas, storeys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np
import shapely

from ..geometry.kept_answers import Kept
from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, ROOF, Solid, surfaces, volume
from ..geometry.solid_faces import area_vector
from .levels_of_detail import block_height, height_quantiles, roof_steps, roof_triangles

STOREY_HEIGHT = 3.0
"""Height (m) of a storey for the estimate of their number."""

FLAT_SLOPE = 5.0
"""Degrees up to which a roof is flat."""

_FLAT_COSINE = float(np.cos(np.radians(FLAT_SLOPE)))


@dataclass(frozen=True)
class ModelFigures:
    """Figures of a building's most detailed solids; NaN where there is no model.

    Attributes
    ----------
    ground_height : height of the ground face, m.
    roof_min, roof_50, roof_70, roof_max : height of the roofs above the ground, m: lowest, below which 50 and 70 % of
        their plan area lie, highest.
    volume_lod12, volume_lod13, volume_lod22 : volume at each level of detail, m3; the first two are those of the plan
        under the median height of all roofs, and of the roofs between steps.
    area_ground : plan area of the ground, m2.
    area_roof_flat, area_roof_sloped : area of the roofs up to 5 degrees and steeper, m2, measured on the slope.
    area_outer_walls : area of all walls that see the open air, steps between roofs too, without party walls, m2.
    area_party_walls : area of walls that stand against another building's (within 15 cm), m2.
    storeys_estimated : storeys above ground, estimated: `roof_70` through 3 m, at least one; not counted.
    """

    ground_height: float = np.nan
    roof_min: float = np.nan
    roof_50: float = np.nan
    roof_70: float = np.nan
    roof_max: float = np.nan
    volume_lod12: float = np.nan
    volume_lod13: float = np.nan
    volume_lod22: float = np.nan
    area_ground: float = np.nan
    area_roof_flat: float = np.nan
    area_roof_sloped: float = np.nan
    area_outer_walls: float = np.nan
    area_party_walls: float = np.nan
    storeys_estimated: int | None = None


FIGURES = tuple(ModelFigures.__dataclass_fields__)
"""Names of the figures, in order."""

OWN_FIGURES = tuple(name for name in FIGURES if name.startswith(("roof", "volume", "area_roof", "storeys")))
"""Those that a building has by itself, whatever stands beside it, and that its model's columns do not have."""


def model_figures(solids: Sequence[Solid], sloped: bool = True, party_area: float = np.nan) -> ModelFigures:
    """Figures of one building.

    Parameters
    ----------
    solids : its most detailed solids.
    sloped : whether they are of level of detail 2.2.
    party_area : area of its walls that stand against other buildings, m2 (`party_wall_areas`); NaN where they were not
        looked for, so that nothing is said of walls.
    """
    triangles = roof_triangles(solids)
    if not len(triangles):
        return ModelFigures()
    base = min(float(solid.vertices[:, 2].min()) for solid in solids)
    low, middle, upper, high = (height_quantiles(triangles, (0.0, 0.5, 0.7, 1.0)) - base).tolist()
    areas = _areas(solids)
    blocks = sum(_ground_area(solid) * (block_height(solid) - _base(solid)) for solid in solids)
    steps = sum(plan.area * (height - _base(solid)) for solid in solids for plan, height in roof_steps(solid))
    return ModelFigures(
        base, low, middle, upper, high, blocks, steps, sum(map(volume, solids)) if sloped else np.nan,
        areas[GROUND], areas["flat"], areas["sloped"],
        float(np.maximum(areas[OUTER_WALL] + areas[INNER_WALL] - party_area, 0.0)), party_area,
        max(1, round(upper / STOREY_HEIGHT)))


def figure_columns(figures: Sequence[ModelFigures], names: Sequence[str] = FIGURES) -> dict[str, list]:
    """Columns of `FIGURES`, or of some of them, one entry a building."""
    rows = [asdict(one) for one in figures]
    return {name: [row[name] for row in rows] for name in names}


def _base(solid: Solid) -> float:
    return float(solid.vertices[:, 2].min())


def _ground_area(solid: Solid) -> float:
    return sum(float(np.linalg.norm(vector)) for vector, kind in zip(_area_vectors(solid), solid.surface_type)
               if kind == GROUND)


@Kept
def _area_vectors(solid: Solid) -> list[np.ndarray]:
    """`area_vector` of each face."""
    return [area_vector(solid.vertices, face) for face in solid.faces]


def _areas(solids: Sequence[Solid]) -> dict[str, float]:
    """Area of the faces of each type in space, m2; roofs also as "flat" and "sloped"."""
    areas = dict.fromkeys((GROUND, ROOF, OUTER_WALL, INNER_WALL, OVERHANG, "flat", "sloped"), 0.0)
    for solid in solids:
        for vector, kind in zip(_area_vectors(solid), solid.surface_type):
            area = float(np.linalg.norm(vector))
            areas[kind] += area
            if kind == ROOF:
                areas["flat" if vector[2] >= area * _FLAT_COSINE else "sloped"] += area
    return areas


def roof_outline(solids: Sequence[Solid]) -> shapely.Geometry:
    """Outline of all roofs of solids in plan."""
    plans = [plan for solid in solids for plan, kind in zip(shapely.force_2d(surfaces(solid)), solid.surface_type)
             if kind == ROOF]
    return shapely.union_all(plans)
