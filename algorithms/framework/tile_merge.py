"""The results of tiles as one layer, one raster, one table of tiles."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path

from qgis.core import QgsVectorLayer

from ...urbanmap_qgis.progress import SILENT, Progress
from ...urbanmap_qgis.tiling.journal import DONE, TileRecord, tile_folder
from ...urbanmap_qgis.tiling.tile_grid import GridTile
from .layers import save_style, without_times
from .tile_work import layer_file

MERGED = "merged"


def merge_results(run_folder: Path, tiles: Sequence[GridTile], records: Mapping[str, TileRecord],
                  outputs: Mapping[str, str], progress: Progress = SILENT) -> dict[str, Path]:
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
        style = _style_of(parts[0])
        if style:
            save_style(temporary, style, progress)
        without_times(temporary)


def _style_of(path: Path) -> str:
    """Name of the style that a layer was written with; empty where it has none."""
    with closing(sqlite3.connect(path)) as database:
        if not database.execute("SELECT 1 FROM sqlite_master WHERE name = 'layer_styles'").fetchone():
            return ""
        found = database.execute("SELECT styleName FROM layer_styles").fetchone()
    return found[0] if found else ""
