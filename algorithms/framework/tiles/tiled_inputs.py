"""The inputs of a run over tiles: what is cut, what is the same for all, and what each tile's results depend on."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from qgis.core import QgsWkbTypes

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.progress import SILENT, Progress
from ....urbanmap_qgis.sources import sources_mark
from ....urbanmap_qgis.tiling.journal import fingerprint
from ....urbanmap_qgis.tiling.point_pieces import LARGE, FileIndex, PointFile, point_file, sorted_into_pieces
from ....urbanmap_qgis.tiling.tile_grid import GridTile, TileGrid
from ..declaring.parameters import tr, with_words
from ..layers import layers
from ..layers.crs import crs_from, wkt_of
from ..layers.outlines import BUILDING_ID, building_names
from ..version import plugin_version
from .tile_layers import LAYER_SUFFIX, layer_file
from .tile_work import POINTS_SUFFIX, TileJob
from .tiled_algorithms import CUTTABLE

CUT, PIECES = "inputs", "pieces"
_SUFFIXES = {"sink": LAYER_SUFFIX, "rasterDestination": ".tif"}
_FILES = (POINTS_SUFFIX, ".html")
WHERE = ("WORKERS", "SCHEDULER")
"""Where pieces are worked on: the run's own, and no matter for the results."""
LONGEST_SHIFT = "MAX_DISPLACEMENT"
"""Parameter of stages that move outlines together: how far at most, m."""
_NO = ("", "no", "false", "0")


def settings_of_lines(text: str, stage) -> dict[str, object]:
    """Parameters given as lines NAME=VALUE; empty lines and those that begin with # are left out.

    Raises
    ------
    InputError : a line is none, or the algorithm has no such parameter.
    """
    settings: dict[str, object] = {}
    for line in filter(None, map(str.strip, (text or "").splitlines())):
        name, sign, value = (part.strip() for part in line.partition("="))
        if line.startswith("#"):
            continue
        if not sign or stage.parameterDefinition(name) is None:
            known = ", ".join(item.name() for item in stage.parameterDefinitions())
            raise InputError(tr("Settings: “{0}” is no line NAME=VALUE with a parameter of {1}; it has {2}.").format(
                line, stage.displayName(), known))
        if name in WHERE:
            raise InputError(tr("Settings: {0} is a parameter of the run itself; give it there.").format(name))
        settings[name] = value
    return settings


def own_settings(parameters: Mapping, stage, algorithm) -> dict[str, object]:
    """The stage's parameters among those that a run was given; outputs that the run itself has are not the stage's."""
    outputs = {item.name() for item in algorithm.destinationParameterDefinitions()}
    return {name: value for name, value in parameters.items()
            if value is not None and name not in outputs and name not in WHERE
            and stage.parameterDefinition(name) is not None}


@dataclass(frozen=True)
class TiledInputs:
    """What a run over tiles works on.

    Attributes
    ----------
    stage : the algorithm that is run.
    grid, tiles : where.
    crs : of the tiles.
    settings : what is the same for all tiles; `shown` for the report.
    points : files by parameter as given.
    pieces : as they are read, large ones sorted into pieces.
    rasters, layers : by parameter; layers are copies in the folder of the run.
    outputs : file names of the results by parameter.
    state : what all tiles' results depend on beside their own files.
    """

    stage: object
    run_folder: Path
    grid: TileGrid
    tiles: list[GridTile]
    crs: object
    settings: dict[str, object]
    shown: dict[str, str]
    points: dict[str, FileIndex]
    pieces: dict[str, FileIndex]
    rasters: dict[str, Path]
    layers: dict[str, Path]
    outputs: dict[str, str]
    state: list[object]

    @classmethod
    def read(cls, algorithm, stage, given: Mapping[str, object], make_grid: Callable[[str], TileGrid],
             run_folder: Path, context, progress: Progress = SILENT) -> TiledInputs:
        """Look at all inputs, copy layers and sort large point clouds into the folder of the run.

        `make_grid` gives the tiles by the CRS of the data, as WKT.
        """
        from ....urbanmap_qgis.io.points.pointcloud import open_cloud

        points, rasters, tables, rest = {}, {}, {}, {}
        for definition in stage.parameterDefinitions():
            name = definition.name()
            if given.get(name) in (None, "") or definition.isDestination() or name in WHERE:
                continue
            if name in stage.points_names():
                points[name] = [point_file(path) for path in stage.point_files(_listed(given, name), name, context)]
            elif definition.type() == "raster":
                rasters[name] = stage.raster_path(given, name, context)
            elif definition.type() == "source":
                tables[name] = stage.read_vector(given, name, context, progress)
            else:
                rest[name] = _listed(given, name)[name] if definition.type() == "multilayer" else given[name]
        cut = CUTTABLE[stage.name()]
        _refuse_without(cut.needed, stage, rest)
        owner = cut.owner
        if owner and owner not in tables:
            raise InputError(tr("{0} are needed to run {1} over tiles; give them.").format(
                stage.label_of(owner), stage.displayName()))
        bounds, crs = _extent(points, rasters.get(cut.extent), tables.get(owner))
        copies, state = _copied(tables, owner, run_folder, progress)
        if crs is None:
            crs = crs_from(open_cloud([file.path for file in next(iter(points.values()))]).crs_wkt or "")
        if hasattr(stage, "shared_settings"):  # what each tile would find otherwise
            rest = {**stage.shared_settings(with_words(given, stage.parameterDefinitions()), context, progress), **rest}
        grid = make_grid(wkt_of(crs))
        if cut.along:
            grid = _stretches(grid, stage, rest, cut.along, crs, context)
        outputs = _outputs(stage, given)
        shown = {stage.label_of(name): str(value) for name, value in rest.items()}
        tiles = _occupied(grid, bounds, points, tables.get(owner))
        _tell_of_cut_sets(stage, rest, tables.get(owner), grid, tiles, shown, progress)
        pieces = _pieces(points, grid, run_folder, progress)
        # An update must not put tiles of two versions side by side in one layer.
        state = [plugin_version(), sources_mark(), stage.name(), state_of(rest), outputs, grid.key, grid.buffer, state]
        indexed = {name: FileIndex(files) for name, files in points.items()}
        return cls(stage, run_folder, grid, tiles, crs, rest, shown, indexed, pieces, rasters, copies, outputs, state)

    def job(self, tile: GridTile) -> TileJob:
        """What one tile needs."""
        files = [file.path for given in self.points.values() for file in given.meeting(tile.outer)]
        state = fingerprint({"tile": tile.name, "state": self.state}, [*files, *self.rasters.values()])
        near = {name: tuple(pieces.meeting(tile.outer)) for name, pieces in self.pieces.items()}
        return TileJob(tile, self.run_folder, state, self.stage.name(), self.settings, near, self.rasters, self.layers,
                       CUTTABLE[self.stage.name()].owner, self.outputs)


def _listed(given: Mapping[str, object], name: str) -> dict[str, object]:
    """The files of a parameter as a list, also where a line gave them as one text with semicolons."""
    value = given[name]
    return {**given, name: [text.strip() for text in value.split(";")] if isinstance(value, str) else value}


def _outputs(stage, given: Mapping[str, object]) -> dict[str, str]:
    """File names of the outputs that are asked for, and that can be made tile by tile."""
    outputs = {}
    for definition in stage.destinationParameterDefinitions():
        name, kind = definition.name(), definition.type()
        suffix = _SUFFIXES.get(kind, f".{definition.defaultFileExtension()}")
        suffix = suffix if kind in _SUFFIXES or suffix in _FILES else ""
        asked = given.get(name)
        wanted = definition.createByDefault() if asked is None else str(asked).strip().lower() not in _NO
        if wanted and suffix:
            outputs[name] = f"{name.lower()}{suffix}"
        elif asked is not None and wanted:
            raise InputError(tr("{0} cannot be made tile by tile; make it of the merged layers.").format(
                definition.description()))
    return outputs


def _stretches(plain: TileGrid, stage, rest: Mapping[str, object], name: str, crs, context) -> TileGrid:
    """Stretches of the drive of a trajectory, as long as the tiles would be wide."""
    from ....urbanmap_qgis.tiling.stretches import StretchGrid

    if type(plain) is not TileGrid:
        raise InputError(tr("{0} is cut into stretches of the drive, not into meshes or sheets: leave out the grid, "
                            "and give the length of a stretch as the side of a tile.").format(stage.displayName()))
    drive = stage.read_trajectory(rest, name, context, wkt_of(crs)) if rest.get(name) else None
    if drive is None:
        raise InputError(tr("{0} are needed to run {1} over tiles; give them.").format(
            stage.label_of(name), stage.displayName()))
    return StretchGrid.along(drive.trajectory.time, drive.trajectory.place, plain.size, plain.buffer)


def _refuse_without(names: Sequence[str], stage, rest: Mapping[str, object]) -> None:
    for name in names:
        if str(rest.get(name, "")).strip() in ("", "0", "0.0"):
            raise InputError(tr("{0} ({1}) must be given over tiles, because each tile would choose for itself.")
                             .format(stage.label_of(name), name))


def state_of(rest: Mapping[str, object]) -> list[object]:
    """Settings, and size and time of the files that they name: a later run sees that one of them changed."""
    values = [item for value in rest.values() for item in (value if isinstance(value, (list, tuple)) else [value])]
    return [dict(rest), fingerprint({}, list(filter(_is_file, values)))]


def _is_file(value: object) -> bool:
    try:
        return isinstance(value, (str, Path)) and Path(value).is_file()
    except (OSError, ValueError):  # a long text is no path
        return False


def _extent(points, raster_path, owner) -> tuple[tuple[float, float, float, float], object]:
    """Box around what says where the tiles are, and its CRS (None: that of the points)."""
    import numpy as np
    import shapely

    if owner is not None:
        return tuple(shapely.total_bounds(owner.geometries)), owner.crs
    boxes = np.array([file.bounds for files in points.values() for file in files if file.points])
    if len(boxes):
        return (*boxes[:, :2].min(axis=0), *boxes[:, 2:].max(axis=0)), None
    if raster_path is None:
        raise InputError(tr("Nothing was given that says where the tiles are; give point clouds or a raster."))
    from ....urbanmap_qgis.io.raster import RasterSampler

    with RasterSampler(raster_path) as raster:
        x_min, y_min, x_max, y_max = raster.grid.bounds
        inside = 1e-6 * raster.grid.cell  # the right and upper edges belong to no pixel
        return (x_min, y_min + inside, x_max - inside, y_max), crs_from(raster.crs_wkt)


def _occupied(grid: TileGrid, bounds, points, owner) -> list[GridTile]:
    """Tiles with something in them by the files' boxes and the outlines: an area need not be a rectangle."""
    import shapely

    tiles = grid.covering(bounds)
    if owner is not None:
        boxes = shapely.bounds(owner.geometries)
        column, row = grid.numbers((boxes[:, 0] + boxes[:, 2]) / 2, (boxes[:, 1] + boxes[:, 3]) / 2)
        occupied = set(zip(column.tolist(), row.tolist()))
        return [tile for tile in tiles if (tile.column, tile.row) in occupied]
    if points:
        files = FileIndex([file for given in points.values() for file in given])
        return [tile for tile in tiles if files.meeting(tile.core)]
    return tiles


def _tell_of_cut_sets(stage, rest: Mapping[str, object], owner, grid: TileGrid, tiles: list[GridTile],
                      shown: dict[str, str], progress: Progress) -> None:
    """Warn where outlines that are moved together reach beyond the buffer, and say it in the report."""
    import numpy as np

    from ....urbanmap_qgis.tiling.outline_sets import buffers_needed

    definition = stage.parameterDefinition(LONGEST_SHIFT)
    shift = float(rest.get(LONGEST_SHIFT, definition.defaultValue())) if definition is not None else 0.0
    if owner is None or not shift:
        return
    needed = buffers_needed(owner.geometries, grid, tiles, 2 * shift)
    cut = np.flatnonzero(needed > grid.buffer)
    if len(cut):
        progress.warn(tr("{0} of {1} outlines stand in rows or blocks that reach beyond the buffer: outlines nearer "
                         "than {2} m are moved together, so that these can be moved otherwise than in one run; a "
                         "buffer of {3} m would hold them all.").format(len(cut), len(needed), f"{2 * shift:g}",
                                                              int(np.ceil(np.nanmax(needed)))))
        shown[tr("Outlines moved without all of their neighbours")] = f"{len(cut)} / {len(needed)}"


def _copied(tables, owner: str, run_folder: Path, progress: Progress) -> tuple[dict[str, Path], list[str]]:
    """Copies of the layers from which tiles are cut, and a text for each that changes with what it holds."""
    folder = run_folder / CUT
    folder.mkdir(exist_ok=True)
    copies, state = {}, []
    for name, table in tables.items():
        columns, fields = dict(table.columns), table.fields
        if name == owner:
            names = building_names(table)
            columns = names.columns({**columns, BUILDING_ID: names.numbers})
            fields = names.fields(layers.make_fields((BUILDING_ID, "int"), base=fields))
        copies[name] = folder / f"{name}{LAYER_SUFFIX}"
        state.append(_write_copy(copies[name], table, fields, columns, progress))
    return copies, state


def _write_copy(path: Path, table, fields, columns, progress: Progress) -> str:
    import shapely

    from ....urbanmap_qgis.io.files.atomic import written_beside

    wkb = shapely.to_wkb(table.geometries)
    content = hashlib.sha256(repr([columns, table.crs_wkt]).encode())
    content.update(b"".join(item or b"-" for item in wkb))
    with (written_beside(path) as temporary,
          layer_file(temporary, fields, QgsWkbTypes.Type.Unknown, table.crs, path.stem) as add):
        for batch in layers.features_of(fields, columns, table.geometries, progress):
            add(batch)
    return content.hexdigest()


def _pieces(points, grid: TileGrid, run_folder: Path, progress: Progress) -> dict[str, FileIndex]:
    """The files as tiles read them; the pieces of a large one are made once and kept for later runs."""
    result: dict[str, list[PointFile]] = {}
    for name, files in points.items():
        result[name] = []
        for file in files:
            if len(grid.covering(file.bounds)) <= LARGE or not file.points:
                result[name].append(file)
                continue
            mark = fingerprint({"size": grid.key}, [file.path])
            folder = run_folder / PIECES / f"{file.path.stem[:40]}-{mark}"
            whole = folder / "whole"
            if not whole.is_file():
                progress.message(tr("{0} is sorted into tiles.").format(file.path.name))
                folder.mkdir(parents=True, exist_ok=True)
                sorted_into_pieces(file, grid, folder, progress)
                whole.touch()
            result[name] += [point_file(path) for path in sorted(folder.glob(f"*{POINTS_SUFFIX}"))]
    return {name: FileIndex(files) for name, files in result.items()}
