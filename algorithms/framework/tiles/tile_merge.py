"""The results of tiles as one layer, one raster, one table of tiles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from qgis.core import QgsVectorLayer

from ....urbanmap_qgis.progress import SILENT, Progress
from ....urbanmap_qgis.tiling.journal import DONE, TileRecord, tile_folder
from ....urbanmap_qgis.tiling.tile_grid import GridTile
from ..layers.layers import features_of, without_times
from ..layers.styles import save_style_text, saved_style
from .tile_joins import EdgePieces, joined_fields, read_layer
from .tile_layers import layer_file

MERGED = "merged"


def merge_results(run_folder: Path, tiles: Sequence[GridTile], records: Mapping[str, TileRecord],
                  outputs: Mapping[str, str], joined: Sequence[str] = (), progress: Progress = SILENT
                  ) -> dict[str, Path]:
    """Put the tiles' layers and rasters together in the folder `merged`; files by the parameter they came from.

    Point clouds stay by tile. The order is that of the tiles. Pieces of polygons of the outputs `joined` are joined
    across the tiles' edges.
    """
    from ....urbanmap_qgis.tiling.mosaic_tiles import mosaic_tiles

    folder = run_folder / MERGED
    folder.mkdir(exist_ok=True)
    made: dict[str, Path] = {}
    for number, (name, file) in enumerate(outputs.items()):
        step = progress.part(number / len(outputs), (number + 1) / len(outputs))
        parts = [(tile_folder(run_folder, tile) / file, tile) for tile in tiles
                 if tile.name in records and records[tile.name].status == DONE
                 and file in records[tile.name].outputs]
        if not parts:
            continue
        if file.endswith(".gpkg"):
            merge_layers([part for part, _ in parts], folder / file, name in joined, step)
            made[name] = folder / file
        elif file.endswith(".tif"):
            mosaic_tiles(parts, folder / file, step)
            made[name] = folder / file
    return made


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
                    add(list(QgsVectorLayer(str(part), part.stem, "ogr").getFeatures()))
                    progress.step((done + 1) / len(parts))
        style = saved_style(parts[0])
        if style is not None:
            save_style_text(temporary, *style)
        without_times(temporary)


def _join(parts: Sequence[Path], add: Callable[[list], None], progress: Progress) -> None:
    """Append what lies within tiles, and in the end what was put together of pieces at their edges."""
    edges = EdgePieces()
    for done, part in enumerate(parts):
        table = read_layer(part)
        fields = joined_fields(table.fields)
        _append(add, fields, *edges.take(table))
        progress.step((done + 1) / len(parts))
    _append(add, fields, *edges.joined())


def _append(add: Callable[[list], None], fields, columns: Mapping[str, list], polygons: Sequence) -> None:
    if len(polygons):
        for batch in features_of(fields, columns, polygons):
            add(batch)
