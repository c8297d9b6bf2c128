"""From building models and images to textured models."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import partial

import cv2
import numpy as np
import shapely

from ...citymodel.model import CityObject
from ...citymodel.solids import solid_object
from ...errors import InputError, InsufficientDataError
from ...execution import in_order
from ...geometry.solid import ROOF, FaceTexture, Solid
from ...geometry.solid_faces import solids_of
from ...progress import SILENT, Progress
from ...settings.lines import TextureSettings
from ...wording import say
from ..views.obstacles import NO_POINTS, OccupiedVoxels, ViewObstacles, obstacles_within
from ..views.views import FrameSource, Source
from .atlas import coarsest_step, draw_atlas, pack_textures
from .facade_texture import NOT_FACED, FacadeTexture, texture_facade
from .facades import Facade, TexelGrid, facades_of, texel_grid

JPEG_QUALITY = 90
WHOLE = 0.95
FRAME_RANGE = 60.0
ABOVE = 2.0

TEXTURED, PARTLY, NOT_SEEN = "textured", "partly seen", "not seen"


@dataclass(frozen=True, eq=False)
class BuildingSolids:
    """A building to texture: its id, attributes and solids."""

    id: int | str
    solids: Sequence[Solid]
    attributes: dict = field(default_factory=dict)


@dataclass(frozen=True)
class FacadeRecord:
    """What became of one facade.

    Attributes
    ----------
    building : its id.
    facade : number in the building, from 0.
    polygon : PolygonZ.
    area : m2.
    azimuth : of the outward normal, degrees from grid north.
    seen : share seen, 0 to 1.
    detail : median size of image pixels on the facade, m.
    images : names of those used.
    status : "textured", "partly seen" or "not seen".
    reason : why it is not seen.
    """

    building: int | str
    facade: int
    polygon: shapely.Polygon
    area: float
    azimuth: float
    seen: float
    detail: float
    images: str
    status: str
    reason: str


@dataclass(frozen=True, eq=False)
class Textured:
    """A textured building: what the writers of files take, its image files' contents by name, its facades."""

    city: CityObject
    images: dict[str, bytes]
    records: tuple[FacadeRecord, ...]


def buildings_of(ids: Sequence, geometries: Sequence[shapely.Geometry | None],
                 attributes: Sequence[dict] = ()) -> list[BuildingSolids]:
    """Buildings from the faces of a layer (MultiPolygonZ).

    Raises
    ------
    InputError : the geometries have no heights.
    InsufficientDataError : no building has a face.
    """
    found = []
    for row, (number, geometry) in enumerate(zip(ids, geometries)):
        if geometry is None or shapely.is_empty(geometry):
            continue
        if not shapely.has_z(geometry):
            raise InputError(say("Building {number} has no heights: give building models (MultiPolygonZ), such as "
                                 "those of “Building models”.", number=number))
        found.append(BuildingSolids(number, solids_of(geometry), attributes[row] if attributes else {}))
    if not found:
        raise InsufficientDataError(say("There is no building model to texture: check the layer."))
    return found


def texture_buildings(buildings: Sequence[BuildingSolids], sources: Sequence[Source],
                      settings: TextureSettings | None = None, voxels: OccupiedVoxels = NO_POINTS,
                      executor: Executor | None = None, progress: Progress = SILENT) -> Iterator[Textured]:
    """Texture buildings one after another; buildings that no image sees come without textures, and say so.

    Parameters
    ----------
    sources : images, numbered from 0 in their order.
    voxels : cells with laser points that may hide facades.
    """
    settings = settings or TextureSettings()
    plans = _Roofs.of(buildings)
    pieces = (_piece(building, sources, plans, voxels, settings) for building in buildings)
    work = partial(_texture_building, sources=tuple(sources), settings=settings)
    for number, done in enumerate(in_order(work, pieces, executor, progress.check)):
        yield done
        progress.step((number + 1) / len(buildings))


@dataclass(frozen=True, eq=False)
class _Roofs:
    """Plans (n,) and heights (n,) of all roofs, with an index."""

    plans: np.ndarray
    heights: np.ndarray
    tree: shapely.STRtree

    @classmethod
    def of(cls, buildings: Sequence[BuildingSolids]) -> _Roofs:
        plans, heights = [], []
        for building in buildings:
            for solid in building.solids:
                for face, kind in zip(solid.faces, solid.surface_type):
                    if kind == ROOF:
                        rings = [solid.vertices[list(ring)] for ring in face]
                        plans.append(shapely.Polygon(rings[0][:, :2], [ring[:, :2] for ring in rings[1:]]))
                        heights.append(rings[0][:, 2].max())
        plans = np.array(plans, object)
        return cls(plans, np.array(heights), shapely.STRtree(plans))

    def around(self, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        touched = np.sort(self.tree.query(shapely.box(*low[:2], *high[:2])))
        return self.plans[touched], self.heights[touched]


@dataclass(frozen=True, eq=False)
class _Piece:
    """A building with what may hide it."""

    building: BuildingSolids
    roofs: np.ndarray
    heights: np.ndarray
    voxels: OccupiedVoxels


def _piece(building: BuildingSolids, sources: Sequence[Source], roofs: _Roofs, voxels: OccupiedVoxels,
           settings: TextureSettings) -> _Piece:
    low = np.min([solid.vertices.min(axis=0) for solid in building.solids], axis=0)
    high = np.max([solid.vertices.max(axis=0) for solid in building.solids], axis=0)
    frames = any(isinstance(source, FrameSource) for source in sources)
    around = np.array([1.0, 1.0, 0.0]) * max(settings.max_range, FRAME_RANGE if frames else 0.0)
    return _Piece(building, *roofs.around(low - around, high + around),
                  OccupiedVoxels(voxels.within(low - around - ABOVE, high + around + ABOVE)))


def _texture_building(piece: _Piece, sources: Sequence[Source], settings: TextureSettings) -> Textured:
    """Texture all facades of one building."""
    building = piece.building
    facades = facades_of(building.solids)
    grids = [texel_grid(facade, coarsest_step(facade.width, facade.height, settings.resolution)) for facade in facades]
    facade_textures = [texture_facade(facade, grid, sources, partial(_obstacles, piece=piece, facade=facade), settings)
                       for facade, grid in zip(facades, grids)]
    placed, pages = _atlas(facade_textures)
    names = [f"textures/building_{building.id}_{number + 1}.jpg" for number in range(len(pages))]
    textures: list[list[FaceTexture | None]] = [[None] * len(solid.faces) for solid in building.solids]
    for facade, grid, place in zip(facades, grids, placed):
        if place is not None:
            textures[facade.solid][facade.face] = _face_texture(building, facade, grid, place, names[place.page],
                                                                pages[place.page].shape)
    images = {name: cv2.imencode(".jpg", page[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()
              for name, page in zip(names, pages)}
    records = tuple(_record(building, number, facade, texture, sources)
                    for number, (facade, texture) in enumerate(zip(facades, facade_textures)))
    area = sum(record.area for record in records)
    seen = sum(record.area * record.seen for record in records)
    attributes = {**building.attributes, "facade_area": area, "facade_seen": seen / area if area else 0.0}
    return Textured(solid_object(f"building-{building.id}", attributes, building.solids, textures), images, records)


def _obstacles(cameras: np.ndarray, piece: _Piece, facade: Facade) -> ViewObstacles:
    """What may stand between a facade and cameras (n, 3)."""
    corners = facade.places(np.array([0.0, facade.width]), np.array([0.0, facade.height]))
    everything = np.vstack([corners, cameras])
    low, high = everything.min(axis=0) - ABOVE, everything.max(axis=0) + ABOVE
    top = max(float(piece.heights.max(initial=corners[:, 2].max())), corners[:, 2].max()) + ABOVE
    # Above the highest roof nothing hides, so that rays to an aircraft end there.
    max_range = np.array([*np.full(2, max(FRAME_RANGE, np.ptp(corners, axis=0).max())), 0.0])
    low, high = (np.maximum(low, corners.min(axis=0) - max_range - ABOVE),
                 np.minimum(high, corners.max(axis=0) + max_range + ABOVE))
    high[2] = min(max(high[2], corners[:, 2].max()), top)
    return obstacles_within(low, high, piece.roofs, piece.heights, piece.voxels)


def _atlas(textures: Sequence[FacadeTexture]):
    """Places of the textures in images (None where there is none), and the images."""
    with_pixels = [number for number, texture in enumerate(textures) if texture.pixels is not None]
    placed = pack_textures([textures[number].pixels.shape[:2] for number in with_pixels])
    pages = draw_atlas([textures[number].pixels for number in with_pixels], placed)
    by_facade = dict(zip(with_pixels, placed))
    return [by_facade.get(number) for number in range(len(textures))], pages


def _face_texture(building: BuildingSolids, facade: Facade, grid: TexelGrid, place, name: str,
                  shape: tuple[int, ...]) -> FaceTexture:
    """Where the vertices of a facade lie in an image of `shape`."""
    solid = building.solids[facade.solid]
    uv = []
    for ring in solid.faces[facade.face]:
        way = solid.vertices[list(ring)] - facade.origin
        column = place.column + way @ facade.along / grid.step
        row = place.row + grid.rows - way @ facade.up / grid.step
        uv.append(np.column_stack([column / shape[1], 1.0 - row / shape[0]]))
    return FaceTexture(name, tuple(uv))


def _record(building: BuildingSolids, number: int, facade: Facade, texture: FacadeTexture,
            sources: Sequence[Source]) -> FacadeRecord:
    solid = building.solids[facade.solid]
    rings = [solid.vertices[list(ring)] for ring in solid.faces[facade.face]]
    status = NOT_SEEN if texture.reason else TEXTURED if texture.share >= WHOLE else PARTLY
    azimuth = float(np.degrees(np.arctan2(facade.normal[0], facade.normal[1])) % 360.0)
    return FacadeRecord(building.id, number, shapely.Polygon(rings[0], rings[1:]), float(facade.outline.area), azimuth,
                        texture.share, 1.0 / texture.detail if texture.detail > 0 else np.nan,
                        ", ".join(sources[image].name for image in texture.images), status, texture.reason)


def summary(records: Sequence[FacadeRecord]) -> dict[str, float]:
    """Numbers of facades and the share of their area that images show."""
    area = sum(record.area for record in records)
    return {"facades": len(records), "textured": sum(record.status != NOT_SEEN for record in records),
            "seen": sum(record.area * record.seen for record in records) / area if area else 0.0,
            "not_faced": sum(record.reason == NOT_FACED for record in records)}
