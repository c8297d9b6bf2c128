"""A city model as 3D Tiles 1.1: a tree of tiles, plain blocks far away, details and textures near.

Source: OGC 22-025r4, 3D Tiles 1.1.
"""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError, OutputError
from ...geometry.earth import METRES_A_DEGREE, earth_fixed
from ...io.files.atomic import written_beside
from ...progress import SILENT, Progress
from ...wording import say
from ..gltf.looks import is_image, look_of, surface_triangles
from ..model import MULTI_SURFACE, SOLID, CityModel, CityObject, CityReference, CityShape
from ..objects import unique_objects, with_area_surfaces
from ..plain_values import plain_attributes
from ..unknown_values import known_attributes
from .tile_content import TileBuilding, write_tile
from .tile_scratch import append_building, stored_buildings

GENERATOR = "UrbanMap"
CELL = 250.0
"""Side of a tile of content, m."""

# Geometric errors, m: of blocks in place of details, and of nothing in place of a cell's blocks.
BLOCK_ERROR = 4.0
CELL_ERROR = 60.0

GeoidHeights = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Function from longitudes and latitudes (n,), degrees, to heights of the geoid above the ellipsoid, m."""


@dataclass
class TileCell:
    """Buildings of one cell: how many, and the region that they fill."""

    count: int = 0
    low: np.ndarray = field(default_factory=lambda: np.full(3, np.inf))
    high: np.ndarray = field(default_factory=lambda: np.full(3, -np.inf))

    def region(self) -> list[float]:
        """West, south, east, north (radians), lowest and highest height, m."""
        return [*np.radians([self.low[0], self.low[1], self.high[0], self.high[1]]).tolist(), float(self.low[2]),
                float(self.high[2])]


def write_tiles(folder: str | os.PathLike, model: CityModel, geoid: GeoidHeights | None = None,
                progress: Progress = SILENT) -> int:
    """Write a city model into a folder as tileset.json and .glb files; return the number of buildings in it.

    Buildings are sorted into cells on disk, so that memory holds one cell at a time.

    Parameters
    ----------
    geoid : heights of the geoid, added to all heights; None where heights are ellipsoidal or nothing is known.

    Raises
    ------
    InputError : the reference system is not known, or an image was not given.
    OutputError : a file cannot be written.
    """
    target = Path(folder)
    trouble = tiles_folder_trouble(target)
    if trouble:
        raise OutputError(trouble)
    try:
        (target / "tiles").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(say("The folder {target} cannot be made ({strerror}): choose another output.", target=target,
                              strerror=error.strerror)) from error
    to_degrees = _to_degrees(model.reference)
    cells: dict[tuple[int, int], TileCell] = {}
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as scratch:
        for building in unique_objects(model.buildings):
            progress.check()
            _sort_in(with_area_surfaces(building), to_degrees, geoid, cells, Path(scratch))
        for (column, row), cell in cells.items():
            progress.check()
            origin = (cell.low + cell.high) / 2.0
            centre, axes = earth_centred(origin[None])[0], local_axes(*origin[:2])
            for level in ("blocks", "details"):
                buildings = list(stored_buildings(Path(scratch) / f"{column}_{row}.{level}"))
                with written_beside(target / "tiles" / _file(column, row, level)) as temporary:
                    write_tile(temporary, buildings, centre, axes, model.images)
    document = tileset(cells, _statement(model, geoid))
    with written_beside(target / "tileset.json") as temporary:
        temporary.write_text(json.dumps(document, ensure_ascii=False, separators=(",", ":")), encoding="utf-8")
    return sum(cell.count for cell in cells.values())


def tiles_folder_trouble(folder: str | os.PathLike) -> str:
    """Why a tileset cannot be put into a folder: it holds one of another program. Empty if it can."""
    path = Path(folder) / "tileset.json"
    if not path.exists():
        return ""
    try:
        ours = json.loads(path.read_text(encoding="utf-8"))["asset"]["generator"] == GENERATOR
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        ours = False
    return "" if ours else say("The folder {folder} holds a tileset of another program: choose another folder.",
                               folder=folder)


def tileset(cells: Mapping[tuple[int, int], TileCell], asset: Mapping[str, Any]) -> dict[str, Any]:
    """The tileset of cells, by column and row: a tree in which four neighbours make one tile of the next level."""
    level: dict[tuple[int, int], tuple[dict, np.ndarray, np.ndarray]] = {}
    for (column, row), cell in sorted(cells.items()):
        level[column, row] = _cell_tile(column, row, cell), cell.low, cell.high
    error = CELL_ERROR
    while len(level) > 1:
        error *= 2.0
        above: dict[tuple[int, int], list] = {}
        for (column, row), node in level.items():
            above.setdefault((column // 2, row // 2), []).append(node)
        level = {place: _joined(nodes, error) for place, nodes in above.items()}
    if not level:
        empty = {"boundingVolume": {"sphere": [0, 0, 0, 1]}, "geometricError": 0, "refine": "REPLACE"}
        return {"asset": {"version": "1.1", **asset}, "geometricError": 0, "root": empty}
    (root, _, _), = level.values()
    return {"asset": {"version": "1.1", **asset}, "geometricError": 2.0 * error,
            "root": {**root, "geometricError": max(root["geometricError"], error)}}


def earth_centred(places: np.ndarray) -> np.ndarray:
    """Earth-centred coordinates (n, 3), m, of longitude, latitude (degrees) and ellipsoidal height (n, 3), WGS 84."""
    return earth_fixed(np.radians(places[:, 1]), np.radians(places[:, 0]), places[:, 2])


def local_axes(longitude: float, latitude: float) -> np.ndarray:
    """East, north and up (3, 3), a row each, at a place (degrees)."""
    lon, lat = math.radians(longitude), math.radians(latitude)
    return np.array([[-math.sin(lon), math.cos(lon), 0.0],
                     [-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)],
                     [math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)]])


def _to_degrees(reference: CityReference) -> Callable[[np.ndarray], np.ndarray]:
    """Function from corners (n, 3) of the model to longitude, latitude and height."""
    if reference.geographic:
        return lambda corners: corners
    if not reference.wkt and reference.epsg is None:
        raise InputError(say("3D Tiles need a place on the earth: the models' coordinate reference system is not "
                             "known."))
    from pyproj import Transformer

    transformer = Transformer.from_crs(reference.epsg or reference.wkt, 4326, always_xy=True)

    def to_degrees(corners: np.ndarray) -> np.ndarray:
        return np.column_stack([*transformer.transform(corners[:, 0], corners[:, 1]), corners[:, 2]])

    return to_degrees


def _sort_in(building: CityObject, to_degrees, geoid: GeoidHeights | None, cells: dict, scratch: Path) -> None:
    """Append a building's triangles, plain and detailed, to the files of its cell."""
    attributes = {"id": building.id, **known_attributes(plain_attributes(building.attributes))}
    plain, detailed = _levels(building)
    if not detailed:
        return
    built, bounds = [], []
    for shapes, textured in ((plain, False), (detailed, True)):
        tile, corners = _triangles(shapes, textured, attributes, to_degrees, geoid)
        built.append(tile)
        bounds.append(corners)
    corners = np.vstack(bounds)
    if not len(corners):
        return
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle = (low + high) / 2.0
    step = CELL / METRES_A_DEGREE
    # Columns are as wide as rows are high, by bands of a degree so that they meet.
    column = math.floor(middle[0] * math.cos(math.radians(math.floor(middle[1]))) / step)
    place = column, math.floor(middle[1] / step)
    cell = cells.setdefault(place, TileCell())
    cell.count += 1
    cell.low, cell.high = np.minimum(cell.low, low), np.maximum(cell.high, high)
    for tile, level in zip(built, ("blocks", "details")):
        append_building(scratch / f"{place[0]}_{place[1]}.{level}", tile)


def _levels(building: CityObject) -> tuple[list[CityShape], list[CityShape]]:
    """The plainest and the most detailed shapes of a building and its parts."""
    plain, detailed = [], []
    for item in building.objects():
        shapes = [shape for shape in item.shapes if shape.kind in (SOLID, MULTI_SURFACE) and shape.lod[:1] != "0"]
        if shapes:
            least, most = min(shape.lod for shape in shapes), max(shape.lod for shape in shapes)
            plain += [shape for shape in shapes if shape.lod == least]
            detailed += [shape for shape in shapes if shape.lod == most]
    return plain, detailed


def _triangles(shapes: list[CityShape], textured: bool, attributes: Mapping[str, Any], to_degrees,
               geoid: GeoidHeights | None) -> tuple[TileBuilding, np.ndarray]:
    """A building for a tile, and its corners (n, 3) in degrees and m."""
    corners: dict[str, list[np.ndarray]] = {}
    places: dict[str, list[np.ndarray]] = {}
    crossing = 0
    for shape in shapes:
        for surface in shape.surfaces:
            try:
                found, numbers = surface_triangles(surface)
            except ValueError:  # it crosses itself and cannot be drawn; the attribute says so
                crossing += 1
                continue
            look = look_of(surface, textured)
            corners.setdefault(look, []).append(found)
            if is_image(look):
                places.setdefault(look, []).append(np.vstack(surface.texture.uv)[numbers])
    if crossing:
        attributes = {**attributes, "faces_left_out": crossing}
    looks = {look: np.concatenate(found) for look, found in corners.items()}
    if not looks:
        return TileBuilding(attributes, {}, {}), np.empty((0, 3))
    degrees = to_degrees(np.concatenate(list(looks.values())).reshape(-1, 3))
    if geoid is not None:
        degrees[:, 2] = degrees[:, 2] + geoid(degrees[:, 0], degrees[:, 1])
    ends = np.cumsum([3 * len(found) for found in looks.values()])[:-1]
    fixed = np.split(earth_centred(degrees), ends)
    return TileBuilding(attributes, {look: piece.reshape(-1, 3, 3) for look, piece in zip(looks, fixed)},
                        {look: np.concatenate(found) for look, found in places.items()}), degrees


def _file(column: int, row: int, level: str) -> str:
    return f"{column}_{row}_{level}.glb"


def _cell_tile(column: int, row: int, cell: TileCell) -> dict[str, Any]:
    """A cell's blocks, and its details in their place from near."""
    origin = (cell.low + cell.high) / 2.0
    matrix = np.eye(4)
    matrix[:3, :3] = local_axes(*origin[:2]).T
    matrix[:3, 3] = earth_centred(origin[None])[0]
    volume = {"region": cell.region()}
    return {"boundingVolume": volume, "geometricError": BLOCK_ERROR, "refine": "REPLACE",
            "transform": matrix.T.ravel().tolist(), "content": {"uri": f"tiles/{_file(column, row, 'blocks')}"},
            "children": [{"boundingVolume": volume, "geometricError": 0.0,
                          "content": {"uri": f"tiles/{_file(column, row, 'details')}"}}]}


def _joined(nodes: list[tuple[dict, np.ndarray, np.ndarray]], error: float) -> tuple[dict, np.ndarray, np.ndarray]:
    """A tile without content over others; one alone stays as it is."""
    if len(nodes) == 1:
        return nodes[0]
    low = np.min([node[1] for node in nodes], axis=0)
    high = np.max([node[2] for node in nodes], axis=0)
    region = TileCell(0, low, high).region()
    return ({"boundingVolume": {"region": region}, "geometricError": error, "refine": "REPLACE",
             "children": [node[0] for node in nodes]}, low, high)


def _statement(model: CityModel, geoid: GeoidHeights | None) -> dict[str, Any]:
    """What the tileset says of itself."""
    heights = "ellipsoidal, by the geoid given" if geoid is not None else f"as given ({model.reference.heights})"
    return {"generator": GENERATOR, "extras": {"title": model.title, "date": model.date, "heights": heights}}
