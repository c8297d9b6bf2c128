"""The results of tiles as one layer, one raster, one table of tiles."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from qgis.core import QgsFeature, QgsVectorLayer

from ....urbanmap_qgis.errors import OutputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ....urbanmap_qgis.tiling.journal import DONE, FAILED, TileRecord, damaged_output, require_room, tile_folder
from ....urbanmap_qgis.tiling.result_counts import ResultCounts
from ....urbanmap_qgis.tiling.tile_grid import GridTile
from ..declaring.parameters import tr
from ..layers.layers import features_of, without_times
from ..layers.outlines import BUILDING_ID
from ..layers.styles import save_style_text, saved_style
from .tile_joins import EdgePieces, joined_fields, read_layer
from .tile_layers import count_of, is_own, layer_file, open_layer
from .tiled_algorithms import Cut

MERGED = "merged"


def merge_results(run_folder: Path, tiles: Sequence[GridTile], records: Mapping[str, TileRecord],
                  outputs: Mapping[str, str], joined: Sequence[str] = (), progress: Progress = SILENT
                  ) -> dict[str, Path]:
    """Put the tiles' layers and rasters together in the folder `merged`; files by the parameter they came from.

    Point clouds stay by tile. The order is that of the tiles. Pieces of polygons of the outputs `joined` are joined
    across the tiles' edges.
    """
    from ....urbanmap_qgis.tiling.mosaic_tiles import mosaic_tiles

    require_room(run_folder)  # QGIS writes beside a layer that it reads
    folder = run_folder / MERGED
    folder.mkdir(exist_ok=True)
    result: dict[str, Path] = {}
    for number, (name, file) in enumerate(outputs.items()):
        step = progress.part(number / len(outputs), (number + 1) / len(outputs))
        parts = [(tile_folder(run_folder, tile) / file, tile) for tile in tiles
                 if tile.name in records and records[tile.name].status == DONE
                 and file in records[tile.name].outputs]
        if not parts:
            continue
        if file.endswith(".gpkg"):
            merge_layers([part for part, _ in parts], folder / file, name in joined, step)
            result[name] = folder / file
        elif file.endswith(".tif"):
            mosaic_tiles(parts, folder / file, step)
            result[name] = folder / file
    return result


def merge_layers(parts: Sequence[Path], target: Path, joined: bool = False, progress: Progress = SILENT) -> None:
    """Append the only layer of each GeoPackage to one, with the first one's style."""
    from ....urbanmap_qgis.io.files.atomic import written_beside

    first = QgsVectorLayer(str(parts[0]), parts[0].stem, "ogr")
    with written_beside(target) as temporary:
        fields = joined_fields(first.fields()) if joined else first.fields()
        with layer_file(temporary, fields, first.wkbType(), first.crs(), target.stem) as add:
            if joined:
                _join(parts, add, progress)
            else:
                for done, part in enumerate(parts):
                    add(features_in(part))
                    progress.step((done + 1) / len(parts))
        style = saved_style(parts[0])
        if style is not None:
            save_style_text(temporary, *style)
        without_times(temporary)


def add_missing(path: Path, owner: Path, tiles: Sequence[GridTile], records: Mapping[str, TileRecord],
                status: str) -> int:
    """Give every building of the `owner` layer its row in the merged layer: those of tiles without points, of failed
    ones and beyond all tiles have none yet. As many rows come out as outlines went in; returns how many were added."""
    with open_layer(owner) as source:
        given = {str(feature[BUILDING_ID]): feature for feature in source.getFeatures()}
        known = source.fields()
    with open_layer(path) as layer:
        fields = layer.fields()
        made = {str(feature[BUILDING_ID]) for feature in layer.getFeatures()}
        rows = []
        for name in (name for name in given if name not in made):
            row = QgsFeature(fields)
            for place, item in enumerate(fields):
                if known.lookupField(item.name()) >= 0 and item.name() != "fid":
                    row[place] = given[name][item.name()]
            row["status"], row["reason"] = status, _why_missing(given[name], tiles, records)
            rows.append(row)
        if not layer.dataProvider().addFeatures(rows)[0]:
            raise OutputError(tr("{0} cannot be written; check the disk.").format(path))
    without_times(path)
    return len(rows)


def _why_missing(feature: QgsFeature, tiles: Sequence[GridTile], records: Mapping[str, TileRecord]) -> str:
    for tile in tiles:
        if is_own(tile, feature):
            record = records.get(tile.name)
            return f"tile {tile.name}: {record.reason}" if record is not None and record.reason else f"tile {tile.name}"
    return "no point cloud reaches its outline"


def whole_records(run_folder: Path, tiles: Sequence[GridTile], records: Mapping[str, TileRecord]
                  ) -> dict[str, TileRecord]:
    """The records, those of tiles whose results are not as they were written now failed: a later run does them again.

    Hours lie between a tile and the end of a run, and what a disk loses meanwhile must not be missing without a word.
    """
    result = dict(records)
    for tile in tiles:
        record = result.get(tile.name)
        name = damaged_output(run_folder, tile, record) if record is not None and record.status == DONE else ""
        if name:
            reason = tr("{0} is not as it was written, by a fault of the disk or another program; run again.").format(
                name)
            result[tile.name] = replace(record, status=FAILED, reason=reason)
    return result


def counts_of(path: Path | None, cut: Cut) -> ResultCounts | None:
    """How many features of the merged main result are good, doubtful and missing; None where none is judged."""
    if path is None or not cut.things:
        return None
    statuses = Counter(str(feature["status"]) for feature in features_in(path))
    return ResultCounts.of(cut.things, statuses, cut.good, cut.missing)


def features_in(path: Path) -> list:
    """All features of the only layer of a GeoPackage.

    Raises
    ------
    OutputError : not all can be read; QGIS ends at the first that cannot, and says nothing.
    """
    features = list(QgsVectorLayer(str(path), path.stem, "ogr").getFeatures())
    if len(features) != count_of(path):
        raise OutputError(tr("{0} cannot be read whole; delete the folder that it is in, and run again.").format(path))
    return features


def _join(parts: Sequence[Path], add: Callable[[list], None], progress: Progress) -> None:
    """Append what lies within tiles, and in the end what was put together of pieces at their edges."""
    edges = EdgePieces()
    for done, part in enumerate(parts):
        table = read_layer(part)
        if len(table) != count_of(part):
            raise OutputError(tr("{0} cannot be read whole; delete the folder that it is in, and run again.").format(
                part))
        fields = joined_fields(table.fields)
        _append(add, fields, *edges.collect(table))
        progress.step((done + 1) / len(parts))
    _append(add, fields, *edges.joined())


def _append(add: Callable[[list], None], fields, columns: Mapping[str, list], polygons: Sequence) -> None:
    if len(polygons):
        for batch in features_of(fields, columns, polygons):
            add(batch)
