"""The results of tiles as one layer, one raster, one table of tiles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from qgis.core import QgsVectorLayer

from ...urbanmap_qgis.progress import SILENT, Progress
from ...urbanmap_qgis.tiling.journal import DONE, TileRecord, tile_folder
from ...urbanmap_qgis.tiling.tile_grid import Tile
from .layers import without_times
from .parameters import tr
from .tile_work import layer_file

MERGED = "merged"


def merge_results(run_folder: Path, tiles: Sequence[Tile], records: Mapping[str, TileRecord], outputs: Mapping[str, str],
                  progress: Progress = SILENT) -> dict[str, Path]:
    """Put the tiles' layers and rasters together in the folder `merged`; files by the parameter they came from.

    Point clouds stay by tile. The order is that of the tiles.
    """
    from ...urbanmap_qgis.tiling.mosaic_tiles import mosaic_tiles

    folder = run_folder / MERGED
    folder.mkdir(exist_ok=True)
    made: dict[str, Path] = {}
    for number, (name, file) in enumerate(outputs.items()):
        step = progress.part(number / len(outputs), (number + 1) / len(outputs))
        parts = [(tile_folder(run_folder, tile) / file, tile.core) for tile in tiles
                 if tile.name in records and records[tile.name].status == DONE
                 and file in records[tile.name].outputs]
        if not parts:
            continue
        if file.endswith(".gpkg"):
            merge_layers([part for part, _ in parts], folder / file, step)
            made[name] = folder / file
        elif file.endswith(".tif"):
            mosaic_tiles(parts, folder / file, step)
            made[name] = folder / file
    return made


def merge_layers(parts: Sequence[Path], target: Path, progress: Progress = SILENT) -> None:
    """Append the only layer of each GeoPackage to one, with the first one's style."""
    from ...urbanmap_qgis.io.atomic import written_beside

    first = QgsVectorLayer(str(parts[0]), parts[0].stem, "ogr")
    with written_beside(target) as temporary:
        with layer_file(temporary, first.fields(), first.wkbType(), first.crs(), target.stem) as add:
            for done, part in enumerate(parts):
                add(list(QgsVectorLayer(str(part), part.stem, "ogr").getFeatures()))
                progress.step((done + 1) / len(parts))
        _take_style(first, temporary, target.stem)
        without_times(temporary)


def _take_style(layer: QgsVectorLayer, target: Path, name: str) -> None:
    """Give a merged layer the style that a tile's layer has, where it has one."""
    count, _, names, _, _ = layer.listStylesInDatabase()
    if count < 1 or not names:
        return
    layer.loadDefaultStyle()
    style = target.with_suffix(".qml")
    try:
        layer.saveNamedStyle(str(style))
        merged = QgsVectorLayer(str(target), name, "ogr")
        merged.loadNamedStyle(str(style))
        merged.saveStyleToDatabase(names[0], tr("UrbanMap"), True, "")
    finally:
        style.unlink(missing_ok=True)
