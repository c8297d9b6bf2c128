"""A city model as tables: one row a building with outline, heights and attributes, one row a surface.

So that models of others serve every step as outlines, as solids and as surfaces. Rows go to sinks piece by piece: of a
city no more than a piece is in memory.
"""

from __future__ import annotations

import itertools
import json
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely

from ...geometry.solid import GROUND, OUTER_WALL, ROOF
from ...geometry.tolerances import LEAST_FACE
from ...wording import say
from ..model import (
    FOOTPRINT,
    MULTI_SURFACE,
    ROOF_EDGE,
    SOLID,
    CityObject,
    CityShape,
    CitySurface,
)
from ..objects import Places, placed
from ..plain_values import plain_attributes
from ..solids import TYPES
from ..unknown_values import UNKNOWN_HEIGHT, known_value

_UPRIGHT = 0.05  # of the unit normal's height: within 3 degrees of upright
_LONGEST_NAME = 60
LONGEST_BUILDING = 10_000.0
"""No building is so long or high, m; the longest are about two kilometres."""



@dataclass(frozen=True, eq=False)
class BuildingRow:
    """One building.

    Attributes
    ----------
    values : building_id, lod, ground, top, height (m), parts, note; attributes (JSON of all), and each simple attribute
        under its own name.
    outline : polygon or multipolygon in plan; None where there is none.
    solid : multipolygon of the faces of its most detailed model; None where it has none.
    faces : polygons with z of that model.
    kinds : surface type of each.
    part : number of the roof surface, or None.
    """

    values: dict[str, Any]
    outline: shapely.Geometry | None
    solid: shapely.Geometry | None
    faces: np.ndarray
    kinds: list[str]
    roofs: list[int | None]


@dataclass
class TableNotes:
    """Counts that the rows do not show: buildings, those with problems; values that stand for "unknown"."""

    buildings: int = 0
    with_problems: int = 0
    lods: dict[str, int] = field(default_factory=dict)
    unknown: Counter = field(default_factory=Counter)


def building_rows(buildings: Iterator[CityObject], places: Places, notes: TableNotes) -> Iterator[BuildingRow]:
    """A row for each building, its parts taken together."""
    for building in buildings:
        notes.buildings += 1
        row = _row(placed(building, places), notes.unknown)
        notes.with_problems += bool(row.values["note"])
        notes.lods[row.values["lod"]] = notes.lods.get(row.values["lod"], 0) + 1
        yield row


def _row(building: CityObject, unknown: Counter) -> BuildingRow:
    problems = [problem for item in building.objects() for problem in item.problems]
    shapes = [shape for item in building.objects() for shape in item.shapes]
    model = best_model(building)
    surfaces = [surface for shape in model for surface in shape.surfaces]
    array = _polygons(surfaces)
    lying = _kinds_by_lie(surfaces)
    kinds = [TYPES.get(surface.kind) or kind for surface, kind in zip(surfaces, lying)]
    numbers = itertools.count(1)
    roofs = [next(numbers) if kind == ROOF else None for kind in kinds]
    outline = _outline(shapes, array)
    if outline is None:
        problems.append(say("it has no outline and no face from which one could be made"))
    z = np.concatenate([ring[:, 2] for surface in _heights_of(model, shapes) for ring in surface.rings] or
                       [np.empty(0)])
    z = z[z != UNKNOWN_HEIGHT]
    ground, top = (float(z.min()), float(z.max())) if len(z) else (None, None)
    attributes = plain_attributes(building.attributes)
    simple = {name: known_value(name, value, unknown) for name, value in simple_attributes(attributes).items()}
    height = simple.get("measuredHeight", attributes.get("measuredHeight"))
    problems += _impossible(height, [ring for shape in shapes for surface in shape.surfaces for ring in surface.rings])
    # Outlines that lie at height 0 say nothing of it.
    if not model and len(z) and not z.any():
        ground = top = None
    flat = top is None or top == ground
    values = {
        "building_id": building.id, "lod": ", ".join(sorted({shape.lod for shape in shapes})),
        "ground": ground, "top": None if flat else top,
        "height": float(height) if isinstance(height, (int, float)) else None if flat else top - ground,
        "parts": len(building.parts), "note": "; ".join(dict.fromkeys(problems)),
        "attributes": json.dumps(_with_parts(building, attributes), ensure_ascii=False, separators=(",", ":"),
                                 default=str),
    }
    # An attribute of the file called "note" or "lod" does not hide what is found here; the JSON holds it.
    values = {**values, **{name: value for name, value in simple.items() if name not in values}}
    solid = shapely.multipolygons(array) if len(array) else None
    return BuildingRow(values, outline, solid, array, kinds, roofs)


def _impossible(height: Any, rings: list[np.ndarray]) -> list[str]:
    """What no building can have: a measured height that is no number, corners farther apart than one is long."""
    reasons = []
    if height is not None and not isinstance(height, (int, float)):
        reasons.append(say("its measured height “{text}” is no number", text=str(height)[:40]))
    corners = np.vstack(rings) if rings else np.zeros((1, 3))
    extent = np.ptp(corners, axis=0).max()
    if not extent <= LONGEST_BUILDING:
        reasons.append(say("its corners lie {extent} km apart, so that a coordinate is wrong",
                        extent=f"{extent / 1000.0:.0f}" if np.isfinite(extent) else "?"))
    return reasons


def best_model(building: CityObject) -> list[CityShape]:
    """Shapes of the most detailed solid model of each of a building's objects; loose surfaces where it has no solid.

    Levels above 2 (openings, interiors) are used where there is nothing else.
    """
    chosen = []
    for item in building.objects():
        found = [shape for shape in item.shapes if shape.kind == SOLID] or [
            shape for shape in item.shapes if shape.kind == MULTI_SURFACE and not shape.lod.startswith("0")]
        levels = sorted({shape.lod for shape in found}, key=lambda lod: (lod < "3", lod))
        chosen += [shape for shape in found if shape.lod == levels[-1]]
    return chosen


def _with_parts(building: CityObject, attributes: dict) -> dict:
    parts = {part.id: plain_attributes(part.attributes) for part in building.parts}
    return {**attributes, "parts": parts} if parts else attributes


def simple_attributes(attributes: dict[str, Any], start: str = "") -> dict[str, Any]:
    """Values that a field can hold, by name, those of groups behind the group's name; lists are left to the JSON."""
    simple: dict[str, Any] = {}
    for name, value in attributes.items():
        name = f"{start}{name.rpartition(':')[2]}"[:_LONGEST_NAME]
        if name.endswith(("_codeSpace", "_uom")) or "@" in name or (start and name == f"{start}type"):
            continue
        if isinstance(value, dict):
            simple.update(simple_attributes(value, f"{name}_"))
        elif isinstance(value, (str, int, float, bool)):
            simple[name] = value
    return simple


def _heights_of(model: list[CityShape], shapes: list[CityShape]) -> list[CitySurface]:
    return [surface for shape in (model or shapes) for surface in shape.surfaces]


def _outline(shapes: list[CityShape], faces: np.ndarray) -> shapely.Geometry | None:
    """Footprint, else roof edge, else the plan of the model's faces."""
    for kind in (FOOTPRINT, ROOF_EDGE):
        polygons = shapely.force_2d(_polygons(
            [surface for shape in shapes if shape.kind == kind for surface in shape.surfaces]))
        found = _plan(polygons) if len(polygons) else None
        if found is not None:
            return found
    return _plan(shapely.force_2d(faces)) if len(faces) else None


def _plan(polygons: np.ndarray) -> shapely.Geometry | None:
    """Polygons in plan as one; None where they have no area."""
    valid = shapely.make_valid(polygons[shapely.area(polygons) > LEAST_FACE])
    if not len(valid):
        return None
    # On a lattice of a millimetre no hair lines are left between faces.
    joined = shapely.union_all(valid, grid_size=0.001)
    parts = shapely.get_parts(shapely.get_parts(joined))
    parts = parts[(shapely.get_type_id(parts) == 3) & (shapely.area(parts) > LEAST_FACE)]
    return shapely.multipolygons(parts) if len(parts) else None


def _polygons(surfaces: Sequence[CitySurface]) -> np.ndarray:
    """Surfaces as an array of polygons with z."""
    rings = [ring for surface in surfaces for ring in surface.rings]
    if not rings:
        return np.empty(0, dtype=object)
    of_ring = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    of_surface = np.repeat(np.arange(len(surfaces)), [len(surface.rings) for surface in surfaces])
    return shapely.polygons(shapely.linearrings(np.concatenate(rings), indices=of_ring), indices=of_surface)


def _kinds_by_lie(surfaces: Sequence[CitySurface]) -> list[str]:
    """Types of faces by how they lie, for those whose source does not say: upright a wall, up a roof, down the ground.

    The normal is Newell's, of the outer ring.
    """
    if not surfaces:
        return []
    outer = [surface.rings[0] for surface in surfaces]
    starts = np.cumsum([0] + [len(ring) for ring in outer[:-1]])
    corners = np.concatenate([ring - ring[0] for ring in outer])
    after = np.arange(1, len(corners) + 1)
    after[np.append(starts[1:], len(corners)) - 1] = starts
    normals = np.add.reduceat(np.cross(corners, corners[after]), starts)
    lengths = np.linalg.norm(normals, axis=1)
    up = np.divide(normals[:, 2], lengths, out=np.zeros(len(normals)), where=lengths > 0)
    return np.where(np.abs(up) <= _UPRIGHT, OUTER_WALL, np.where(up > 0, ROOF, GROUND)).tolist()
