"""Where results go, for all algorithms: temporary places, places of inputs, places of each other, all or nothing."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

SQUARE = "POLYGON((0 0, 10 0, 10 10, 0 10, 0 0))"
FILES = ("fileDestination", "rasterDestination", "folderDestination")


def algorithms():
    from qgis.core import QgsApplication

    return [item for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
            if hasattr(item, "compute")]


def new_context():
    from qgis.core import QgsProcessingContext, QgsProject

    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    return context


@pytest.fixture
def modules(plugin):
    return plugin("algorithms.framework.declaring.destinations"), plugin("urbanmap_qgis.io.files.staging")


@pytest.fixture
def errors(plugin):
    return plugin("urbanmap_qgis.errors")


@pytest.fixture
def cloud(make_cloud, tmp_path):
    """Two boxes of points on level ground."""
    import numpy as np

    axis = np.arange(0.0, 60.0, 0.5)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    z = np.where((abs(x - 15) < 8) & (abs(y - 15) < 8), 12.0, 0.0)
    return make_cloud(tmp_path / "cloud.laz", x, y, z, classification=np.where(z > 0, 6, 2))


def outlines_of(polygon_layer):
    return polygon_layer(["POLYGON((7 7, 23 7, 23 23, 7 23, 7 7))"])


def test_temporary_destinations_keep_their_names_in_all_algorithms(qgis_app, modules):
    destinations, staging = modules
    asked = 0
    for algorithm in algorithms():
        wanted = {item.name(): "TEMPORARY_OUTPUT" for item in algorithm.destinationParameterDefinitions()}
        with staging.Staging() as places:
            context = new_context()
            run = destinations.staged(algorithm, wanted, context, places)
            for item in algorithm.destinationParameterDefinitions():
                if item.type() in FILES:
                    first, second = (algorithm.output_path(run, item.name(), context) for _ in range(2))
                    assert first == second and Path(places.outside(str(first))).parent.is_dir(), algorithm.name()
                    asked += 1
    assert asked > 30


def test_points_in_temporary_files_are_there(run, cloud, polygon_layer):
    made = run("urbanmap:segmentbuildings", {"POINTS": [str(cloud)], "FOOTPRINTS": outlines_of(polygon_layer),
                                             "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"})
    assert Path(made["OUTPUT"]).is_file()
    roofs = run("urbanmap:segmentroofs", {"POINTS": [made["OUTPUT"]], "FOOTPRINTS": made["OUTPUT_BUILDINGS"],
                                          "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_ROOFS": "TEMPORARY_OUTPUT"})
    assert Path(roofs["OUTPUT"]).is_file() and roofs["ROOFS"] == 1


def test_model_exported_as_python_runs(run, qgis_app, cloud, polygon_layer):
    """What QGIS's modeller writes for a model is an algorithm that works like it."""
    from qgis.core import QgsApplication, QgsProcessing, QgsProcessingAlgorithm

    model = QgsApplication.processingRegistry().algorithmById("urbanmap:buildingsfromals_model")
    code = "\n".join(model.asPythonCode(QgsProcessing.PythonOutputType.PythonQgsProcessingAlgorithmSubclass, 4))
    scope: dict = {}
    exec(compile(code, "exported", "exec"), scope)
    exported = next(item for item in scope.values() if isinstance(item, type)
                    and issubclass(item, QgsProcessingAlgorithm) and item is not QgsProcessingAlgorithm)()
    exported.initAlgorithm()
    given = {item.name(): "TEMPORARY_OUTPUT" if item.isDestination() else item.defaultValue()
             for item in exported.parameterDefinitions()}
    for item in exported.parameterDefinitions():
        if item.type() == "multilayer":
            given[item.name()] = [str(cloud)]
        elif item.type() in ("vector", "source"):
            given[item.name()] = outlines_of(polygon_layer)
    made = run(exported, given)
    files = [value for value in made.values() if isinstance(value, str) and value.startswith("/")]
    assert files and all(Path(file).is_file() for file in files)


def stand_ins(folder: Path, definition) -> list[tuple[object, Path]]:
    """Values for a file or layer input, each with the file that it is."""
    from qgis.core import QgsProcessing

    kind = definition.type()
    if kind == "file" and definition.behavior() == definition.Behavior.Folder:
        return []
    if kind == "file" or (kind == "multilayer" and definition.layerType() == QgsProcessing.SourceType.TypeFile):
        path = folder / "input.bin"
        path.write_bytes(b"x")
        (folder / "link.bin").unlink(missing_ok=True)
        (folder / "link.bin").symlink_to(path)
        return [(str(folder / ".." / folder.name / "input.bin"), path), (str(folder / "link.bin"), path)]
    if kind in ("source", "vector", "layer"):
        path = folder / "layer.geojson"
        path.write_text('{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":'
                        '{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}}]}')
        return [(str(path), path), (f"{path}|layername=layer", path)]
    if kind == "raster":
        import numpy as np
        import rasterio

        path = folder / "raster.tif"
        with rasterio.open(path, "w", driver="GTiff", width=2, height=2, count=1, dtype="uint8",
                           transform=rasterio.transform.Affine(1, 0, 0, 0, -1, 2), crs="EPSG:6677") as file:
            file.write(np.ones((1, 2, 2), np.uint8))
        return [(str(path), path)]
    return []


def test_no_output_takes_the_place_of_an_input(qgis_app, modules, errors, tmp_path):
    """Every destination of every algorithm, with every file or layer that it reads, in several spellings."""
    tried = 0
    for algorithm in algorithms():
        for definition in algorithm.parameterDefinitions():
            for value, path in [] if definition.isDestination() else stand_ins(tmp_path, definition):
                for output in algorithm.destinationParameterDefinitions():
                    given = {definition.name(): [value] if definition.type() == "multilayer" else value,
                             output.name(): str(path)}
                    with pytest.raises(errors.InputError, match="would take the place of"):
                        modules[0].check_destinations(algorithm, given, new_context())
                        pytest.fail(f"{algorithm.name()}: {given}")
                    tried += 1
    assert tried > 300


def test_outlines_open_for_editing_are_not_replaced(run, polygon_layer, cloud, tmp_path, save_outlines):
    """By the project's layer id, which says nothing of the file."""
    import shapely
    from qgis.core import QgsProcessingException, QgsProject, QgsVectorLayer

    path = save_outlines(tmp_path / "outlines.gpkg", [shapely.box(7, 7, 23, 23)])
    before = path.read_bytes()
    layer = QgsVectorLayer(f"{path}|layername=outlines", "mine", "ogr")
    QgsProject.instance().addMapLayer(layer)
    layer.startEditing()
    try:
        for output in (str(path), f"ogr:dbname='{path}' table=\"outlines\" (geom)"):
            with pytest.raises(QgsProcessingException, match="would take the place of Building outlines"):
                run("urbanmap:segmentbuildings", {"POINTS": [str(cloud)], "FOOTPRINTS": layer.id(),
                                                  "OUTPUT": str(tmp_path / "out.laz"), "OUTPUT_BUILDINGS": output})
    finally:
        layer.rollBack()
        QgsProject.instance().removeMapLayer(layer.id())
    assert not (tmp_path / "out.laz").exists()
    assert path.read_bytes()[100:] == before[100:]  # the header counts who opened it


def test_two_outputs_of_one_name_are_refused(qgis_app, modules, errors, tmp_path):
    for algorithm in algorithms():
        outputs = algorithm.destinationParameterDefinitions()
        for first, second in zip(outputs, outputs[1:]):
            given = {first.name(): str(tmp_path / "one.gpkg"), second.name(): str(tmp_path / "." / "one.gpkg")}
            with pytest.raises(errors.InputError, match="have the same name"):
                modules[0].check_destinations(algorithm, given, new_context())


def test_tables_of_one_geopackage_are_two_places(qgis_app, modules, tmp_path):
    algorithm = next(item for item in algorithms() if item.name() == "buildingmodels")
    given = {name: f"ogr:dbname='{tmp_path / 'a.gpkg'}' table=\"{name}\" (geom)"
             for name in ("OUTPUT", "OUTPUT_SURFACES")}
    modules[0].check_destinations(algorithm, given, new_context())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux tells who has a file open")
def test_geopackage_that_another_program_holds_is_refused(qgis_app, modules, errors, tmp_path):
    path = tmp_path / "held.gpkg"
    with sqlite3.connect(path) as made:
        made.execute("CREATE TABLE t (a)")
    made.close()
    algorithm = next(item for item in algorithms() if item.name() == "roofpolygons")
    modules[0].check_destinations(algorithm, {"OUTPUT": str(path)}, new_context())
    hold = "import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); c.execute('SELECT * FROM t').fetchall();" \
           "print('open', flush=True); sys.stdin.read()"
    with subprocess.Popen([sys.executable, "-c", hold, str(path)], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as other:
        other.stdout.readline()
        with pytest.raises(errors.OutputError, match="is open in another program"):
            modules[0].check_destinations(algorithm, {"OUTPUT": str(path)}, new_context())
        other.stdin.close()


@pytest.mark.parametrize("name", ["n" * 300 + ".laz", "a\0b.laz"])
def test_name_that_no_file_can_have_is_refused(run, cloud, polygon_layer, tmp_path, name):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="cannot be the name of a file"):
        run("urbanmap:segmentbuildings", {"POINTS": [str(cloud)], "FOOTPRINTS": outlines_of(polygon_layer),
                                          "OUTPUT": str(tmp_path / name), "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"})


def test_long_names_are_written(run, cloud, polygon_layer, tmp_path):
    path = tmp_path / ("n" * 251 + ".laz")
    run("urbanmap:segmentbuildings", {"POINTS": [str(cloud)], "FOOTPRINTS": outlines_of(polygon_layer),
                                      "OUTPUT": str(path), "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"})
    assert sorted(tmp_path.iterdir()) == sorted([cloud, path])


@pytest.fixture
def two_outputs(plugin):
    """An algorithm that writes a text, then fails on demand before it writes another."""
    base, errors = plugin("algorithms.framework.base"), plugin("urbanmap_qgis.errors")

    class Two(base.UrbanMapAlgorithm):
        ID = NAME = "two"
        HELP = "Writes two files."
        FAILURE: BaseException | None = None

        def declare(self):
            self.add_file_output("FIRST", "First", "A text.", "Text (*.txt)")
            self.add_file_output("SECOND", "Second", "A text.", "Text (*.txt)")

        def compute(self, parameters, context, feedback):
            paths = [self.output_path(parameters, name, context) for name in ("FIRST", "SECOND")]
            paths[0].write_text("new")
            feedback.pushInfo(str(paths[0]))
            self.progress(feedback).message(f"{paths[0]} is written")
            if Two.FAILURE is not None:
                raise Two.FAILURE
            paths[1].write_text("new")
            return {"FIRST": str(paths[0]), "SECOND": str(paths[1])}

    Two.errors = errors
    return Two


def test_outputs_take_their_places_together(two_outputs, run, tmp_path):
    from qgis.core import QgsProcessingException

    files = [tmp_path / "a.txt", tmp_path / "b.txt"]
    for file in files:
        file.write_text("old")
    given = {"FIRST": str(files[0]), "SECOND": str(files[1])}
    two_outputs.FAILURE = two_outputs.errors.InputError("No.")
    with pytest.raises(QgsProcessingException, match="No."):
        run(two_outputs(), given)
    assert [file.read_text() for file in files] == ["old", "old"] and sorted(tmp_path.iterdir()) == files
    two_outputs.FAILURE = None
    assert run(two_outputs(), given) == given
    assert [file.read_text() for file in files] == ["new", "new"] and sorted(tmp_path.iterdir()) == files
    assert f"{files[0]} is written" in run.feedback.infos


@pytest.mark.parametrize("failure, words", [
    (OSError(28, "No space left on device"), "The disk is full"),
    (sqlite3.OperationalError("database or disk is full"), "The disk is full"),
    (MemoryError(), "The memory is not enough")])
def test_a_system_without_room_is_one_sentence(two_outputs, run, tmp_path, failure, words):
    from qgis.core import QgsProcessingException

    two_outputs.FAILURE = failure
    with pytest.raises(QgsProcessingException, match=words):
        run(two_outputs(), {"FIRST": str(tmp_path / "a.txt"), "SECOND": str(tmp_path / "b.txt")})
    assert list(tmp_path.iterdir()) == []


def test_one_file_that_cannot_be_replaced_leaves_all_as_they_were(plugin, errors, tmp_path, monkeypatch):
    staging = plugin("urbanmap_qgis.io.files.staging")
    for name in "abc":
        (tmp_path / name).write_text("old")
    replace = os.replace

    def refuse_c(source, target):
        if Path(target) == tmp_path / "c":
            raise PermissionError(13, "Permission denied")
        replace(source, target)

    monkeypatch.setattr(staging.os, "replace", refuse_c)
    with staging.Staging() as places, pytest.raises(errors.OutputError, match="c cannot be replaced"):
        for name in "abcn":
            places.scratch_path(tmp_path / name).write_text("new")
        places.publish()
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == dict.fromkeys("abc", "old")


def test_leftovers_of_a_killed_run_go_and_those_of_others_stay(plugin, tmp_path):
    staging = plugin("urbanmap_qgis.io.files.staging")
    start = ("import sys, time; from pathlib import Path; from urbanmap_qgis.io.files.staging import Staging\n"
             "with Staging() as s:\n s.scratch_path(Path(sys.argv[1]) / 'x').write_text('half')\n"
             " print('there', flush=True); sys.stdin.read()")
    root = Path(__file__).resolve().parents[2]
    runs = [subprocess.Popen([sys.executable, "-c", start, str(tmp_path)], stdin=subprocess.PIPE,
                             stdout=subprocess.PIPE, cwd=root) for _ in range(2)]
    for process in runs:
        process.stdout.readline()
    assert len(list(tmp_path.glob(".urbanmap-*"))) == 2
    runs[0].kill()
    runs[0].communicate()
    with staging.Staging() as places:
        places.scratch_path(tmp_path / "y")
        assert len(list(tmp_path.glob(".urbanmap-*"))) == 2  # the other run's and this one's
    runs[1].communicate(b"")
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_is_starting_is_no_leftover(plugin, tmp_path):
    """Between its folder and its lock another run may look at it: the folder stays, and the lock is waited for."""
    staging = plugin("urbanmap_qgis.io.files.staging")
    scratch = tmp_path / ".urbanmap-01234567"
    scratch.mkdir()
    with (scratch / "lock").open("w") as lock:
        staging.clear_leftovers(tmp_path)
        assert scratch.is_dir()
        with (scratch / "lock").open("r+") as looked:
            staging.take_lock(looked)
            threading.Timer(0.3, looked.close).start()
            staging._take_own_lock(lock)
        (scratch / "new").mkdir()
        staging.clear_leftovers(tmp_path)
        assert scratch.is_dir()
    staging.clear_leftovers(tmp_path)
    assert not scratch.exists()


def test_a_killed_start_goes_after_a_while(plugin, tmp_path):
    staging = plugin("urbanmap_qgis.io.files.staging")
    scratch = tmp_path / ".urbanmap-01234567"
    scratch.mkdir()
    (scratch / "lock").touch()
    os.utime(scratch, (0.0, 0.0))
    staging.clear_leftovers(tmp_path)
    assert not scratch.exists()


@pytest.mark.parametrize("count", [1, 2])
def test_the_same_input_gives_the_same_bytes(run, cloud, polygon_layer, tmp_path, plugin, monkeypatch, count):
    """Layers with their styles, clouds and files; a second later, and on any number of workers."""
    import time

    workers = plugin("algorithms.framework.running.workers")
    monkeypatch.setattr(workers, "_processes", workers._in_window)
    made = []
    for folder, number in ((tmp_path / "a", 1), (tmp_path / "b", count)):
        folder.mkdir()
        first = run("urbanmap:segmentbuildings", {
            "POINTS": [str(cloud)], "FOOTPRINTS": outlines_of(polygon_layer), "WORKERS": number,
            "OUTPUT": str(folder / "points.laz"), "OUTPUT_BUILDINGS": str(folder / "buildings.gpkg")})
        roofs = run("urbanmap:segmentroofs", {
            "POINTS": [first["OUTPUT"]], "FOOTPRINTS": first["OUTPUT_BUILDINGS"], "WORKERS": number,
            "OUTPUT": str(folder / "roofs.laz"), "OUTPUT_ROOFS": str(folder / "roofs.gpkg")})
        polygons = run("urbanmap:roofpolygons", {
            "POINTS": [roofs["OUTPUT"]], "FOOTPRINTS": first["OUTPUT_BUILDINGS"], "WORKERS": number,
            "OUTPUT": str(folder / "polygons.gpkg")})
        run("urbanmap:buildingmodels", {
            "ROOFS": polygons["OUTPUT"], "FOOTPRINTS": first["OUTPUT_BUILDINGS"], "WORKERS": number,
            "OUTPUT": str(folder / "models.gpkg"), "OUTPUT_CITYJSON": str(folder / "models.city.json"),
            "OUTPUT_MESH": str(folder / "models.obj")})
        made.append({path.name: path.read_bytes() for path in folder.iterdir()})
        time.sleep(1.1)
    assert made[0].keys() == made[1].keys()
    assert [name for name in made[0] if made[0][name] != made[1][name]] == []


def test_points_by_a_layer_of_the_project(run, cloud, polygon_layer, tmp_path, modules):
    """A layer by its id or name stands for its file. Without QGIS's provider of point clouds the layer opens nothing,
    but knows its file all the same."""
    from qgis.core import QgsPointCloudLayer, QgsProject

    layer = QgsPointCloudLayer(str(cloud), "survey", "pdal")
    if not modules[0]._layer_file(layer)[0]:
        pytest.skip("this build knows no point cloud layers of LAZ files")
    QgsProject.instance().addMapLayer(layer)
    try:
        for given in (layer.id(), "survey"):
            made = run("urbanmap:segmentbuildings", {"POINTS": [given], "FOOTPRINTS": outlines_of(polygon_layer),
                                                     "OUTPUT": str(tmp_path / "o.laz"), "OUTPUT_BUILDINGS": "memory:"})
            assert made["POINT_COUNT"] > 0
    finally:
        QgsProject.instance().removeMapLayer(layer.id())


def test_points_by_the_name_of_a_layer_with_a_file(qgis_app, modules, cloud, monkeypatch):
    """The same with a stand-in for the provider."""
    from types import SimpleNamespace

    monkeypatch.setattr(modules[0], "_layer_file", lambda layer: (cloud, ""))
    layer = object()
    project = SimpleNamespace(mapLayer=lambda text: layer if text == "id_1" else None,
                              mapLayersByName=lambda text: [layer] if text == "survey" else [])
    context = SimpleNamespace(project=lambda: project)
    assert [modules[0].file_of(text, context) for text in ("id_1", "survey", "other.laz")] == [
        str(cloud), str(cloud), "other.laz"]


def test_points_that_state_no_crs_take_the_one_that_is_given(run, make_cloud, tmp_path):
    import laspy
    import numpy as np
    from qgis.core import QgsProcessingException

    axis = np.arange(0.0, 40.0, 0.4)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    bare = make_cloud(tmp_path / "bare.laz", x, y, 0.01 * x, epsg=None)
    given = {"POINTS": [str(bare)], "OUTPUT": str(tmp_path / "ground.laz")}
    with pytest.raises(QgsProcessingException, match="coordinate reference system is missing"):
        run("urbanmap:groundfrommms", given)
    with pytest.raises(QgsProcessingException, match="degrees"):
        run("urbanmap:groundfrommms", {**given, "POINTS_CRS": "EPSG:6668"})
    run("urbanmap:groundfrommms", {**given, "POINTS_CRS": "EPSG:6677"})
    with laspy.open(tmp_path / "ground.laz") as made:
        assert made.header.parse_crs().to_epsg() == 6677
    surface = run("urbanmap:surfacefromals", {"POINTS": [str(bare)], "POINTS_CRS": "EPSG:6677",
                                              "OUTPUT": str(tmp_path / "s.tif"),
                                              "OUTPUT_GROUND": str(tmp_path / "g.tif")})
    assert Path(surface["OUTPUT"]).is_file()


def test_rasters_that_steps_opened_are_closed_before_they_are_moved(modules, tmp_path, capfd):
    """QGIS writes statistics beside a raster when it closes it: where the raster was gone by then, GDAL complained."""
    from qgis.core import QgsRasterLayer

    from urbanmap_qgis.geometry.grid import Grid
    from urbanmap_qgis.io.raster import write_raster

    destinations, staging_module = modules
    context = new_context()
    store = context.temporaryLayerStore()
    with staging_module.Staging() as staging:
        made = staging.scratch_path(tmp_path / "o.tif")
        write_raster(made, np.arange(1e4, dtype=np.float32).reshape(100, 100), Grid(0, 100, 1, 100, 100),
                     'LOCAL_CS["a",UNIT["metre",1]]')
        layer = QgsRasterLayer(str(made), "o")
        layer.dataProvider().histogram(1)
        store.addMapLayer(layer)
        del layer
        destinations.close_layers(context, staging)
        assert not store.mapLayers()
        staging.publish()
    assert [path.name for path in tmp_path.iterdir()] == ["o.tif"]
    assert "auxiliary" not in capfd.readouterr().err


def test_models_go_into_no_format_that_loses_their_walls(qgis_app, modules, errors, tmp_path):
    """A Shapefile kept 0 of 23 solids whole: asked of every output of closed bodies, before the run."""
    destinations, _ = modules
    solids = {algorithm.name(): [item.name() for item in algorithm.destinationParameterDefinitions()
                                 if item.metadata().get("urbanmap_solids")] for algorithm in algorithms()}
    assert {"buildingmodels", "buildingsfromals", "mergebuildingmodels", "adjustwalls"} <= {
        name for name, outputs in solids.items() if outputs}
    for algorithm in algorithms():
        for name in solids[algorithm.name()]:
            with pytest.raises(errors.InputError, match="closed bodies"):
                destinations.check_destinations(algorithm, {name: str(tmp_path / "models.shp")}, new_context())
            destinations.check_destinations(algorithm, {name: str(tmp_path / "models.gpkg")}, new_context())
