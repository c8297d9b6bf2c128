"""urbanmap:tiledrun."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsApplication, QgsProcessingParameterString

from ...urbanmap_qgis.errors import InsufficientDataError, UrbanMapError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.shown_results import show_layer, shown_after
from ..framework.running.cluster import check_cluster
from ..framework.tiles.tiled_algorithms import CUTTABLE, WHOLE

SQUARES, MESHES, SHEETS = "squares", ("mesh1km", "mesh500m", "mesh250m"), ("sheet5000", "sheet2500", "sheet1000",
                                                                         "sheet500")

RASTER_STYLES = {("surfacefromals", "OUTPUT"): "dsm", ("surfacefromals", "OUTPUT_GROUND"): "ground",
                 ("aerialmarkings", "OUTPUT_GROUND"): "ground", ("aerialmarkings", "OUTPUT"): "marking_mask",
                 ("roadmarkingsfromorthophoto", "OUTPUT"): "marking_mask"}
"""Of merged rasters; layers bring theirs in their files."""


class TiledRun(UrbanMapAlgorithm):
    ID = "tiledrun"
    NAME = "Run over tiles"
    SOURCE = "own"
    KEYWORDS = ("tile", "batch", "grid", "large area", "resume", "overnight", "workflow", "scale")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    KEPT_FOLDERS = LASTING_FOLDERS = ("OUTPUT_FOLDER",)
    HELP = (
        "Runs another algorithm over an area of any size, tile by tile: each tile reads its part of the inputs with "
        "a buffer around it, and keeps what is its own of the results, so that a building on an edge is there once.\n"
        "Each tile is whole or not there. Run again with the same folder, settings and inputs, it goes on where it was "
        "ended; tiles that failed, or whose inputs changed, are done again. One failed tile does not end the run: all "
        "others are done and put together, and then the run ends with an error (on the command line with exit code "
        "1).\n"
        "The algorithm's parameters are given as lines NAME=VALUE, on the command line also by themselves. "
        "Point clouds, rasters and layers among them are cut; everything else is the same for all tiles. Layers and "
        "rasters are put together in the folder “merged”, point clouds stay by tile."
    )

    def declare(self):
        self.add_choice("ALGORITHM", "Algorithm", "What is run on each tile.", tuple(CUTTABLE), next(iter(CUTTABLE)))
        self.add_points(help="LAS, LAZ or COPC files of the whole area, in any pieces.", optional=True)
        self.add_polygons("FOOTPRINTS", "Building outlines", "Outlines of the whole area.", optional=True)
        self.add_raster("INPUT", "Orthophoto", "For road markings: the orthophoto of the whole area.", optional=True)
        self.declare_parameter(_lines("SETTINGS", tr("Settings of the algorithm")), "Lines NAME=VALUE, with the "
                               "algorithm's own names, such as GROUND=ground.tif or MIN_ROOF_AREA=20. An output is "
                               "made where it is by default, or where a line such as OUTPUT_GROUND=yes asks for it.")
        self.add_distance("TILE", "Tile", "Side of a tile, whole metres; corners lie on its multiples.", 500.0, 10.0,
                          100000.0)
        self.add_choice("GRID", "Grid", "Squares of the side above; or Japan's standard regional meshes (JIS X 0410) "
                        "of about 1 km, 500 m or 250 m; or the sheets of public survey maps of level 5000 (4 by 3 km), "
                        "2500 (2 by 1.5 km), 1000 (800 by 600 m) or 500 (400 by 300 m), in a plane rectangular "
                        "system. Tiles are then named by their codes.", (SQUARES, *MESHES, *SHEETS), SQUARES)
        self.add_distance("BUFFER", "Buffer", "Width of the surroundings that a tile reads: more than the largest "
                          "building, and than the reach of ground under buildings.", 60.0, 0.0, 10000.0)
        self.add_number("ESTIMATE", "Tiles to try", "Only this many tiles, spread over the area, to say what all will "
                        "take in time, memory and disk; 0 does all.", 0, 0, integer=True)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Tiles", "One square a tile with status, reason, time, memory.")
        self.add_folder_output("OUTPUT_FOLDER", "Folder of the run", "Results by tile, merged results, and what a "
                               "later run needs to go on.")
        self.add_report("HTML report: how many buildings or walls are ok, doubtful and failed, which tiles failed and "
                        "why, time, memory, disk, a map.")
        for name, label in (("TILES", "Tiles"), ("DONE", "Tiles done"), ("EMPTY", "Empty tiles"),
                            ("FAILED", "Failed tiles"), ("KEPT", "Tiles kept from an earlier run")):
            self.add_number_output(name, label, "Number of them.")

    def checkParameterValues(self, parameters, context):
        asked = str(parameters.get("ALGORITHM", "")).removeprefix("urbanmap:")
        if asked in WHOLE:
            return False, tr("{0} cannot be run over tiles: {1}.").format(asked, tr(WHOLE[asked]))
        return super().checkParameterValues(parameters, context)

    def known_names(self, parameters):
        """The parameters of the algorithm that is run are known too."""
        stage = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{parameters.get('ALGORITHM', '')}")
        return [*super().known_names(parameters), *(item.name() for item in stage.parameterDefinitions())] if stage \
            else super().known_names(parameters)

    def check(self, parameters, context):
        self._settings(parameters, context)

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.tiling.journal import only_run
        from ..framework.tiles.tiled_inputs import TiledInputs

        check_cluster()
        progress = self.progress(feedback)
        folder = Path(self.parameterAsString(parameters, "OUTPUT_FOLDER", context))
        with only_run(folder):
            inputs = TiledInputs.read(self, self._stage(parameters, context), self._settings(parameters, context),
                                      self._grid(parameters, context), folder, context, progress.part(0.0, 0.05))
            results, merged = self._run(parameters, context, inputs, folder, progress)
        if shown_after(feedback):
            for name, path in merged.items():
                show_layer(context, path, inputs.stage.parameterDefinition(name).description(),
                           RASTER_STYLES.get((inputs.stage.name(), name), ""))
        return results

    def _run(self, parameters, context, inputs, folder, progress):
        from ...urbanmap_qgis.tiling.journal import DONE, EMPTY, FAILED, kept_record
        from ..framework.tiles.tile_merge import add_missing, counts_of, merge_results, whole_records
        from ..framework.tiles.tile_pool import run_tiles

        tiles = self._chosen(inputs.tiles, self.parameterAsInt(parameters, "ESTIMATE", context))
        jobs = {tile.name: inputs.job(tile) for tile in tiles}
        records = {name: record for name, job in jobs.items()
                   if (record := kept_record(folder, job.tile, job.fingerprint))}
        kept_tiles = len(records)
        todo = [job for name, job in jobs.items() if name not in records]
        progress.message(tr("{0} tiles, {1} kept from an earlier run, {2} to do.").format(
            len(tiles), kept_tiles, len(todo)))
        working = progress.part(0.05, 0.9)
        for record in run_tiles(todo, self.parameterAsInt(parameters, "WORKERS", context), progress.cancelled):
            records[record.name] = record
            if record.status == FAILED:
                progress.warn(tr("Tile {0} failed: {1}").format(record.name, record.reason))
            working.step((len(records) - kept_tiles) / len(todo))
        records = whole_records(folder, tiles, records)
        count = {status: sum(record.status == status for record in records.values())
                 for status in (DONE, EMPTY, FAILED)}
        if not count[DONE] and not count[FAILED]:
            raise InsufficientDataError(tr("All {0} tiles are empty; check that the inputs lie in one place.").format(
                len(tiles)))
        joined = CUTTABLE[inputs.stage.name()].joined
        merged = merge_results(folder, tiles, records, inputs.outputs, joined, progress.part(0.9, 0.97))
        cut = CUTTABLE[inputs.stage.name()]
        if len(tiles) == len(inputs.tiles) and cut.things == "buildings" and "OUTPUT" in merged:
            added = add_missing(merged["OUTPUT"], inputs.layers[cut.owner], tiles, records, cut.missing[0])
            if added:
                progress.warn(tr("{0} outlines lie where no tile has a result; the merged layer has a row for each, "
                                 "with the reason.").format(added))
        for name, path in merged.items():
            progress.message(tr("{0}: {1}").format(name, path))
        counts = counts_of(merged.get("OUTPUT"), CUTTABLE[inputs.stage.name()])
        if counts:
            progress.message(counts.sentence())
        report = self._report(parameters, context, inputs, [records[tile.name] for tile in tiles], kept_tiles, counts)
        layer = self._write(parameters, context, inputs, tiles, records, progress.part(0.97, 1.0))
        return {**layer, "OUTPUT_FOLDER": str(folder), "OUTPUT_REPORT": report, "TILES": len(tiles),
                "DONE": count[DONE], "EMPTY": count[EMPTY], "FAILED": count[FAILED], "KEPT": kept_tiles}, merged

    def judge(self, results, feedback):
        """A run with failed tiles is none that went well: scripts and schedulers see it by the exit code."""
        from qgis.utils import iface

        if not results.get("FAILED"):
            return
        sentence = tr("{0} of {1} tiles failed; all others are in {2}. Put right what the warnings and the layer of "
                      "tiles say, and run again with the same folder: only these tiles are then done.").format(
            results["FAILED"], results["TILES"], results["OUTPUT_FOLDER"])
        if iface is None:
            raise UrbanMapError(sentence)
        feedback.reportError(sentence, False)  # an error would keep the window from loading the layers

    def _stage(self, parameters, context):
        name = self.parameterAsString(parameters, "ALGORITHM", context)
        return QgsApplication.processingRegistry().algorithmById(f"urbanmap:{name}")

    def _settings(self, parameters, context) -> dict:
        """What the stage is given, by its own names: lines of SETTINGS, then parameters of their own."""
        from ..framework.tiles.tiled_inputs import own_settings, settings_of_lines

        stage = self._stage(parameters, context)
        lines = settings_of_lines(self.parameterAsString(parameters, "SETTINGS", context), stage)
        return {**lines, **own_settings(parameters, stage, self)}

    def _grid(self, parameters, context):
        """What makes the grid when the CRS of the data is known."""
        from ...urbanmap_qgis.tiling.map_sheets import SheetGrid
        from ...urbanmap_qgis.tiling.regional_meshes import MeshGrid
        from ...urbanmap_qgis.tiling.tile_grid import TileGrid

        kind = self.parameterAsString(parameters, "GRID", context)
        buffer = self.parameterAsDouble(parameters, "BUFFER", context)
        if kind in SHEETS:
            return lambda crs_wkt: SheetGrid.of(int(kind.removeprefix("sheet")), crs_wkt, buffer)
        if kind in MESHES:
            return lambda crs_wkt: MeshGrid.of(kind, crs_wkt, buffer)
        size = self.parameterAsDouble(parameters, "TILE", context)
        return lambda crs_wkt: TileGrid(size, buffer)

    @staticmethod
    def _chosen(tiles, wanted):
        """All tiles, or so many of them at equal distances."""
        if not wanted or wanted >= len(tiles):
            return tiles
        return [tiles[(2 * number + 1) * len(tiles) // (2 * wanted)] for number in range(wanted)]

    def _report(self, parameters, context, inputs, records, kept, counts):
        from ...urbanmap_qgis.tiling.report import extrapolated, write_tiles_report

        path = self.output_path(parameters, "OUTPUT_REPORT", context)
        if path is None:
            return None
        estimate = {}
        if len(records) < len(inputs.tiles):
            estimate = extrapolated(records, len(inputs.tiles), self.parameterAsInt(parameters, "WORKERS", context))
        write_tiles_report(path, tr("{0}, tile by tile").format(inputs.stage.displayName()), inputs.shown, inputs.grid,
                           inputs.tiles, records, kept, estimate, counts)
        return str(path)

    def _write(self, parameters, context, inputs, tiles, records, progress):
        rows = [records[tile.name] for tile in tiles]
        columns = {"tile": [row.name for row in rows], "status": [row.status for row in rows],
                   "reason": [row.reason for row in rows], "seconds": [row.seconds for row in rows],
                   "memory": [row.memory or None for row in rows]}
        return self.write_layer(parameters, "OUTPUT", context, None, columns, inputs.crs,
                                [tile.square for tile in tiles], "Polygon", "tiles", progress)


def _lines(name: str, label: str) -> QgsProcessingParameterString:
    return QgsProcessingParameterString(name, label, None, True, True)
