"""CityJSON files of solids for tests: written from a list of buildings, read as vertices and faces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from urbanmap_qgis.citymodel.cityjson.reader import read_cityjson
from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
from urbanmap_qgis.citymodel.model import CityModel, CityReference
from urbanmap_qgis.citymodel.solids import indexed_shell, solid_rows
from urbanmap_qgis.progress import SILENT


@dataclass(frozen=True, eq=False)
class ReadSolid:
    """Outer shell of a solid: vertices (V, 3), m, faces as rings of vertex numbers, kind of each face."""

    vertices: np.ndarray
    faces: tuple
    surface_type: tuple


@dataclass(frozen=True)
class ReadBuilding:
    id: str
    type: str
    attributes: Mapping
    solids: tuple[ReadSolid, ...]


def write_solids(path, buildings, epsg=None, title="", progress=SILENT):
    """Write buildings (`solid_object`) to a CityJSON file; how many."""
    return write_model_cityjson(path, CityModel(CityReference(epsg=epsg), buildings, title=title), progress)


def read_solids(path):
    """Buildings of a CityJSON file with their most detailed solids."""
    return tuple(ReadBuilding(item.id, item.type, item.attributes, tuple(_solid(shape.shells[0]) for shape in solids))
                 for item, solids in solid_rows(read_cityjson(path).buildings))


def _solid(shell):
    vertices, faces = indexed_shell(shell)
    return ReadSolid(vertices, tuple(faces), tuple(surface.kind or None for surface in shell))
