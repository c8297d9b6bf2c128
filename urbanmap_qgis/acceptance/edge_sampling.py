"""Edges of building models that are drawn for a survey, and the table in which it fills in what it measured.

Source: PLATEAU specification 5.0, tables P05 to P08: of each unit of inspection, a quarter regional mesh, 21 edges or
more of clear features with two points each.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from ..errors import InputError
from ..geometry.mesh_code import COLUMNS as COLUMNS_A_DEGREE
from ..geometry.mesh_code import ROWS, WEST, regional_mesh_code, third_mesh_code
from ..geometry.tolerances import LEAST_DIVISOR, LEAST_FACE
from ..io.files.excel_table import write_excel_table
from ..io.reference.system_parts import plan_part
from ..wording import say

EDGES_OF_UNIT, POINTS_OF_EDGE = 21, 2
"""Edges that a unit needs, and points of each: its ends."""

MIN_LENGTH = 2.0  # m; ends of shorter edges cannot be told apart in the field
_STRAIGHT = 0.05  # m that a corner must stand off the line between its neighbours
_QUARTERS = 4  # quarter meshes along the side of a third mesh
_SAME = 0.05  # m in plan within which vertices of faces are one corner

COLUMNS = ("id", "edge", "building", "unit", "x_product", "y_product", "z_product", "x", "y", "z")
"""Columns of the table; x, y and z are what the survey fills in."""


@dataclass(frozen=True)
class SampledEdges:
    """n edges drawn for a survey.

    Attributes
    ----------
    building, unit : (n,) names.
    ends : (n, 2, 3) corners of the plan with the height of the model there, m.
    available : edges that each unit has, by its name.
    """

    building: tuple[str, ...]
    unit: tuple[str, ...]
    ends: np.ndarray
    available: dict[str, int]

    def __len__(self) -> int:
        return len(self.unit)


def draw_edges(models: Sequence[shapely.Geometry | None], names: Sequence[str], units: Sequence[str], seed: int = 1,
               count: int = EDGES_OF_UNIT) -> SampledEdges:
    """Draw `count` edges of each unit at random, first one of every building; all of a unit that has fewer.

    Parameters
    ----------
    models : (n,) MultiPolygonZ, all faces of each building.
    names, units : (n,) of the buildings.
    seed : the same seed and models give the same edges.

    Raises
    ------
    InputError : no model has heights, or none has an edge of `MIN_LENGTH`.
    """
    edges = [outer_edges(model) for model in models]
    generator, rows = np.random.default_rng(seed), []
    available: dict[str, int] = {}
    for unit in dict.fromkeys(units):
        unit_rows = [row for row, name in enumerate(units) if name == unit and len(edges[row])]
        # One of each building in a random order, then a second of each, ...
        drawn = [(place, generator.random(), row, int(edge)) for row in unit_rows
                 for place, edge in enumerate(generator.permutation(len(edges[row])))]
        available[unit] = len(drawn)
        rows += [(row, edge) for _, _, row, edge in sorted(drawn)[:count]]
    if not rows:
        raise InputError(say("No building has an edge of {length:g} m with heights: give models, not outlines.",
                             length=MIN_LENGTH))
    return SampledEdges(tuple(str(names[row]) for row, _ in rows), tuple(units[row] for row, _ in rows),
                      np.array([edges[row][edge] for row, edge in rows]), available)


def quarter_meshes(models: Sequence[shapely.Geometry | None], crs_wkt: str) -> list[str]:
    """Codes of the quarter regional meshes (4分の1地域メッシュ) in which the models lie; "" for all where one is not in
    Japan."""
    from pyproj import CRS, Transformer

    plan = plan_part(CRS.from_user_input(crs_wkt))
    middles = [shapely.Point(0, 0) if model is None or model.is_empty else shapely.centroid(shapely.envelope(model))
               for model in models]
    longitude, latitude = Transformer.from_crs(plan, plan.geodetic_crs, always_xy=True).transform(
        [point.x for point in middles], [point.y for point in middles])
    try:
        for east, north in zip(longitude, latitude):
            third_mesh_code(east, north)
    except InputError:
        return [""] * len(middles)
    return [regional_mesh_code(int(north * ROWS * _QUARTERS), int((east - WEST) * COLUMNS_A_DEGREE * _QUARTERS),
                               _QUARTERS) for east, north in zip(longitude, latitude)]


def outer_edges(model: shapely.Geometry | None) -> np.ndarray:
    """(n, 2, 3) edges of the outer contour of a model's plan, m, with the highest height of the model at their ends.

    The building is to the left of each."""
    if model is None or model.is_empty or not model.has_z:
        return np.zeros((0, 2, 3))
    faces = shapely.get_parts(shapely.force_2d(model))
    plan = shapely.union_all(shapely.make_valid(faces[shapely.area(faces) > LEAST_FACE]))
    vertices = shapely.get_coordinates(model, include_z=True)
    found = []
    for part in shapely.get_parts(plan):
        if part.geom_type != "Polygon":
            continue
        corners = _corners(shapely.get_coordinates(orient(part).exterior)[:-1])
        away = np.hypot(*(corners[:, None, :] - vertices[None, :, :2]).transpose(2, 0, 1))
        height = np.where(away <= _SAME, vertices[None, :, 2], -np.inf).max(axis=1)
        ends = np.column_stack([corners, height])
        edges = np.stack([ends, np.roll(ends, -1, axis=0)], axis=1)
        length = np.hypot(*(edges[:, 1, :2] - edges[:, 0, :2]).T)
        found.append(edges[(length >= MIN_LENGTH) & np.isfinite(edges[:, :, 2]).all(axis=1)])
    return np.concatenate(found) if found else np.zeros((0, 2, 3))


def _corners(ring: np.ndarray) -> np.ndarray:
    """The vertices (n, 2) of a ring at which it bends."""
    before, after = np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0)
    along = after - before
    size = np.maximum(np.hypot(*along.T), LEAST_DIVISOR)
    off = np.abs(along[:, 0] * (ring - before)[:, 1] - along[:, 1] * (ring - before)[:, 0]) / size
    return ring[off > _STRAIGHT]


def write_edges_csv(path: str | os.PathLike, drawn: SampledEdges) -> None:
    """Write the table for the field: every point with its place in the product, its true place left blank.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    edges = enumerate(zip(drawn.building, drawn.unit, drawn.ends), 1)
    write_excel_table(path, (COLUMNS, *(
        (f"{number}{letter}", number, building, unit, *(f"{value:.3f}" for value in point), "", "", "")
        for number, (building, unit, ends) in edges for letter, point in zip("ab", ends))))


def measured_edges(edge: Sequence[str], unit: Sequence[str]) -> dict[str, int]:
    """Number of edges with both points measured, by unit; of points' edges and units."""
    points: dict[tuple[str, str], int] = {}
    for key in zip(unit, edge):
        points[key] = points.get(key, 0) + 1
    return {name: sum(count >= POINTS_OF_EDGE for (of, _), count in points.items() if of == name)
            for name in dict.fromkeys(unit)}
