"""One tile of a run over many: its inputs cut out, the algorithm run, its own results kept."""

from __future__ import annotations

import shutil
import sqlite3
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from qgis.core import (
    QgsFeatureRequest,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsRectangle,
)

from ....urbanmap_qgis.errors import SYSTEM_TROUBLES, Cancelled, OutputError, UrbanMapError, system_sentence
from ....urbanmap_qgis.tiling.journal import (
    DONE,
    EMPTY,
    FAILED,
    TileRecord,
    checksum,
    new_tile_folder,
    publish,
    require_room,
)
from ....urbanmap_qgis.tiling.tile_grid import GridTile
from ..declaring.parameters import tr
from ..layers.layers import make_fields, own_fields, without_times
from ..layers.outlines import BUILDING_ID, NUMBER
from ..running.cluster import require_cluster
from .tile_joins import cut_features
from .tile_layers import LAYER_SUFFIX, TILE_FIELD, is_own, layer_file, layers_closed, open_layer
from .tiled_algorithms import CUTTABLE

if TYPE_CHECKING:
    from ....urbanmap_qgis.tiling.point_pieces import PointFile

INPUTS, FAULT = "inputs", "fault.txt"
POINTS_SUFFIX = ".laz"


class EmptyTile(Exception):
    """There is nothing in a tile to work on; its text says what is missing."""


@dataclass(frozen=True)
class TileJob:
    """All that one tile needs; it can be sent to another process.

    Attributes
    ----------
    tile, run_folder, fingerprint : see `tiling.journal`.
    algorithm : id without the provider's.
    settings : parameters that are the same for all tiles.
    points, rasters, layers : inputs to cut, by parameter. A layer is a GeoPackage with one table.
    owner : the parameter whose features in the core are the tile's own; empty where results go by their place.
    outputs : file names of the results by parameter.
    """

    tile: GridTile
    run_folder: Path
    fingerprint: str
    algorithm: str
    settings: Mapping[str, object]
    points: Mapping[str, tuple[PointFile, ...]]
    rasters: Mapping[str, Path]
    layers: Mapping[str, Path]
    owner: str
    outputs: Mapping[str, str]


class TileFeedback(QgsProcessingFeedback):
    """Keeps a tile's messages to itself, and asks the whole run whether to stop."""

    def __init__(self, cancelled: Callable[[], bool]):
        super().__init__(False)
        self._cancelled = cancelled

    def isCanceled(self):
        return self._cancelled()


def work_on_tile(job: TileJob, cancelled: Callable[[], bool] = lambda: False) -> TileRecord:
    """Make a tile's results in its folder and write its record; what goes wrong in the tile is said in the record."""
    start, start_cpu = time.perf_counter(), time.process_time()
    with new_tile_folder(job.run_folder, job.tile) as folder:
        record = TileRecord(job.tile.name, DONE, fingerprint=job.fingerprint)
        try:
            figures = _make(job, folder, cancelled)
            result = [folder / name for name in job.outputs.values() if (folder / name).is_file()]
            record = replace(record, outputs={file.name: file.stat().st_size for file in result},
                             checksums={file.name: checksum(file) for file in result}, figures=figures)
        except EmptyTile as nothing:
            record = replace(record, status=EMPTY, reason=str(nothing))
        except (UrbanMapError, QgsProcessingException, *SYSTEM_TROUBLES) as error:
            _end_where_hopeless(job, error, cancelled)
            record = replace(record, status=FAILED, reason=str(error).strip() or type(error).__name__)
        except Exception as error:  # a fault of ours in one tile must not end the night
            _end_where_hopeless(job, error, cancelled)
            (folder / FAULT).write_text(traceback.format_exc(), encoding="utf-8")
            record = replace(record, status=FAILED, reason=tr("A fault in the program: {0} in the tile's folder tells "
                                                              "where; please report it.").format(FAULT))
        shutil.rmtree(folder / INPUTS, ignore_errors=True)
        record = replace(record, seconds=round(time.perf_counter() - start, 2),
                         cpu=round(time.process_time() - start_cpu, 2), memory=round(_peak_memory(), 1))
        publish(job.run_folder, job.tile, record, folder)
    return record


def _end_where_hopeless(job: TileJob, error: Exception, cancelled: Callable[[], bool]) -> None:
    """End the run where the next tile would fail too: it was cancelled, its disk is full, or its cluster is lost."""
    if cancelled():
        raise Cancelled() from None
    require_cluster()
    if isinstance(error, OSError) and system_sentence(error):
        raise OutputError(tr("{0} Tiles that are whole are kept.").format(system_sentence(error))) from error
    require_room(job.run_folder)


def _make(job: TileJob, folder: Path, cancelled: Callable[[], bool]) -> dict[str, float]:
    """Cut the inputs, run the algorithm, keep the tile's own results; the numbers that it gave."""
    import processing
    from processing.tools import dataobjects

    from ....urbanmap_qgis.tiling.mosaic_tiles import write_tile_raster

    inputs = folder / INPUTS
    inputs.mkdir()
    parameters = dict(job.settings)
    owned = _cut_layers(job, inputs, parameters)
    _cut_points(job, inputs, parameters)
    for name, path in job.rasters.items():
        parameters[name] = str(inputs / f"{name}.tif")
        if not write_tile_raster(path, job.tile.outer, parameters[name]):
            raise EmptyTile(tr("{0} does not reach this tile.").format(path.name))
    parameters.update({name: str(folder / file) for name, file in job.outputs.items()})
    feedback = TileFeedback(cancelled)
    with layers_closed(dataobjects.createContext(feedback)) as context:
        results = processing.run(f"urbanmap:{job.algorithm}", parameters, feedback=feedback, context=context,
                                 is_child_algorithm=True)
    if cancelled():
        raise Cancelled()
    for name, file in job.outputs.items():
        _keep_own(folder / file, job.tile, owned, name in CUTTABLE[job.algorithm].joined)
    return {name: value for name, value in results.items()
            if isinstance(value, (int, float)) and not isinstance(value, bool)}


def _cut_points(job: TileJob, inputs: Path, parameters: dict) -> None:
    from ....urbanmap_qgis.tiling.point_pieces import all_inside, write_tile_points

    for name, files in job.points.items():
        if all_inside(files, job.tile):  # files that are tiles already are read as they are
            parameters[name] = [str(file.path) for file in files]
            continue
        path = inputs / f"{name}{POINTS_SUFFIX}"
        if not write_tile_points(files, job.tile, path):
            raise EmptyTile(tr("There are no points in this tile."))
        parameters[name] = [str(path)]


def _cut_layers(job: TileJob, inputs: Path, parameters: dict) -> dict[str, int] | None:
    """Cut the layers; by their own ids the numbers of the tile's own features, None where none own anything."""
    owned = None
    for name, path in job.layers.items():
        cut = inputs / f"{name}{LAYER_SUFFIX}"
        found = cut_layer(path, job.tile, cut)
        if name == job.owner:
            owned = found
            if not found:
                raise EmptyTile(tr("There are no outlines in this tile."))
        if cut.is_file():
            parameters[name] = str(cut)
    return owned


def cut_layer(source: Path, tile: GridTile, target: Path) -> dict[str, int]:
    """Copy the features that meet a tile and its buffer; numbers of those that are the tile's own, by id.

    No file is written where no feature meets the tile.
    """
    with open_layer(source) as layer:
        names = layer.fields().names()
        found = layer.getFeatures(QgsFeatureRequest().setFilterRect(QgsRectangle(*tile.outer)))
        near = sorted(found, key=lambda feature: feature.id())  # they come as the spatial index was built
        if not near:
            return {}
        owned = {}
        if BUILDING_ID in names:
            number = NUMBER if NUMBER in names else BUILDING_ID
            owned = {str(feature[BUILDING_ID]): int(feature[number]) for feature in near if is_own(tile, feature)}
        with layer_file(target, layer.fields(), layer.wkbType(), layer.crs()) as add:
            add(near)
    return owned


def _keep_own(path: Path, tile: GridTile, own: Mapping[str, int] | None, joined: bool) -> None:
    """Take out of a result what belongs to other tiles. Rasters are cut when they are put together."""
    from ....urbanmap_qgis.tiling.point_pieces import keep_own_points

    if not path.is_file():
        return
    if path.suffix == POINTS_SUFFIX:
        keep_own_points(path, tile, None if own is None else list(own.values()))
    elif path.suffix == LAYER_SUFFIX and joined:
        cut_features(path, tile)
    elif path.suffix == LAYER_SUFFIX:
        keep_own_features(path, tile, own)


def keep_own_features(path: Path, tile: GridTile, own: Mapping[str, int] | None) -> None:
    """Delete the features that are another tile's and note in the rest which tile they are from.

    A feature with a `building_id` goes by it where the tile has own buildings, any other by the middle of its box.
    """
    with open_layer(path) as layer:
        by_id = own is not None and layer.fields().lookupField(BUILDING_ID) >= 0
        others, rest = [], []
        for feature in layer.getFeatures():
            if str(feature[BUILDING_ID]) in own if by_id else not feature.hasGeometry() or is_own(tile, feature):
                rest.append(feature.id())
            else:
                others.append(feature.id())
        data = layer.dataProvider()
        data.addAttributes([own_fields(make_fields((TILE_FIELD, "text")))[1][0]])
        data.deleteFeatures(others)
        layer.updateFields()
        place = layer.fields().lookupField(TILE_FIELD)
        data.changeAttributeValues({number: {place: tile.name} for number in rest})
    del data, layer
    with closing(sqlite3.connect(path, isolation_level=None)) as database:
        database.execute("PRAGMA synchronous = OFF")  # a published tile is on the disk
        database.execute("VACUUM")  # what was deleted goes, and the same features give the same bytes
    without_times(path)


def _peak_memory() -> float:
    """Greatest memory of this process so far, MB; 0 where the system does not tell."""
    try:
        import resource
    except ImportError:
        return 0.0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024 * 1024 if sys.platform == "darwin" else 1024)
