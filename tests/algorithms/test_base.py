"""The base class: declaring, help, checks, errors, cancelling, layers in and out."""

from __future__ import annotations

import gzip
import signal
from pathlib import Path

import pytest

SQUARE = "POLYGON((0 0, 10 0, 10 10, 0 10, 0 0))"
BOW_TIE = "POLYGON((0 0, 10 10, 10 0, 0 10, 0 0))"


@pytest.fixture
def example(plugin):
    """An algorithm that copies polygons and does on demand what can go wrong."""
    base = plugin("algorithms.framework.base")
    layers = plugin("algorithms.framework.layers.layers")

    class Example(base.UrbanMapAlgorithm):
        ID = "example"
        NAME = "Example"
        HELP = "Copies outlines.\nSecond paragraph, a < b."
        SOURCE = "Somebody 2018, 5.3"
        KEYWORDS = ("outline",)

        def declare(self):
            self.add_points("POINTS", optional=True)
            self.add_polygons("FOOTPRINTS", "Building outlines", "Polygons in metres.")
            self.add_distance("STEP", "Step", "How far to go.", default=0.5, minimum=0.01, advanced=True)
            modes = ["copy", "user error", "bug", "late error", "signal"]
            self.add_choice("MODE", "Mode", "What to do.", modes, "copy")
            self.add_layer_output("OUTPUT", "Copies", "The outlines.")
            self.add_file_output("OUTPUT_TEXT", "Text", "Anything.", "Text (*.txt)", optional=True, by_default=True)
            self.add_number_output("COUNT", "Number of outlines", "How many were copied.")

        def compute(self, parameters, context, feedback):
            errors = plugin("urbanmap_qgis.errors")
            progress = self.progress(feedback)
            progress.step(0.5)
            mode = self.parameterAsString(parameters, "MODE", context)
            if mode == "user error":
                raise errors.InputError("The tile is empty: choose another.")
            if mode == "signal":
                signal.raise_signal(signal.SIGINT)
                progress.check()
            if mode == "bug":
                raise ZeroDivisionError("a bug")
            table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
            columns = dict(table.columns, problem=[table.problems.get(row) for row in range(len(table))])
            if mode == "late error":
                columns["area"] = iter(())
            else:
                columns["area"] = [10.0 if item is None else item.area for item in table.geometries]
            result = self.write_layer(
                parameters, "OUTPUT", context, layers.make_fields(("area", "real"), ("problem", "text"),
                                                                  base=table.fields),
                columns, table.crs_wkt, table.geometries, "Polygon", progress=progress)
            progress.step(1.0)
            text = self.output_path(parameters, "OUTPUT_TEXT", context)
            return {**result, "COUNT": len(table), "OUTPUT_TEXT": text and str(text)}

    return Example


def run_example(example, feedback, parameters, **more):
    """Run as Processing does, but keep the error."""
    from qgis.core import QgsProcessingContext, QgsProject

    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    algorithm = example().create()
    accepted, message = algorithm.checkParameterValues(parameters, context)
    assert accepted, message
    results, succeeded = algorithm.run(parameters, context, feedback, {}, False)
    assert succeeded
    return results


def test_copies_and_counts(example, feedback, polygon_layer, read_layer, tmp_path):
    path = tmp_path / "日本 語.gpkg"
    layer = polygon_layer([SQUARE], fields={"name": ["駅"]})
    results = run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    assert results["COUNT"] == 1
    assert results["OUTPUT_TEXT"] is None
    assert Path(results["OUTPUT"]) == path
    (feature,) = read_layer(path)
    assert feature.attributes["area"] == 100.0
    assert feature.attributes["name"] == "駅"
    assert [item.name for item in tmp_path.iterdir()] == [path.name]


def test_layer_keeps_its_crs(example, feedback, polygon_layer, tmp_path):
    from qgis.core import QgsVectorLayer

    path = tmp_path / "out.gpkg"
    run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": str(path)})
    assert QgsVectorLayer(str(path), "x", "ogr").crs().authid() == "EPSG:6677"


def test_shapefile_is_moved_whole(example, feedback, polygon_layer, read_layer, tmp_path):
    path = tmp_path / "out.shp"
    run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": str(path)})
    assert {item.suffix for item in tmp_path.iterdir()} >= {".shp", ".dbf", ".shx", ".prj"}
    assert len(read_layer(path)) == 1


def test_temporary_output_is_a_memory_layer(example, run, polygon_layer, read_layer):
    results = run(example(), {"FOOTPRINTS": polygon_layer([SQUARE, SQUARE]), "OUTPUT": "TEMPORARY_OUTPUT"})
    assert len(read_layer(results["OUTPUT"])) == 2


@pytest.mark.parametrize("mode", ["user error", "bug", "late error"])
def test_failed_run_keeps_the_earlier_result(example, feedback, polygon_layer, read_layer, tmp_path, mode):
    path = tmp_path / "out.gpkg"
    layer = polygon_layer([SQUARE])
    run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    before = path.read_bytes()
    with pytest.raises(Exception):  # noqa: B017  the kind of error is tested elsewhere
        run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path), "MODE": mode})
    assert path.read_bytes() == before
    assert [item.name for item in tmp_path.iterdir()] == ["out.gpkg"]


def test_cancelled_run_keeps_the_earlier_result(example, feedback, polygon_layer, tmp_path):
    path = tmp_path / "out.gpkg"
    layer = polygon_layer([SQUARE])
    run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    before = path.read_bytes()
    feedback.cancel_at = 50
    assert run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)}) == {}
    assert path.read_bytes() == before
    assert [item.name for item in tmp_path.iterdir()] == ["out.gpkg"]


def test_interrupt_from_the_keyboard_is_an_error_in_words(example, feedback, polygon_layer):
    """Under `qgis_process` a cancelled run must not look like a good one."""
    from qgis.core import QgsProcessingException

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(QgsProcessingException, match=r"^The run was cancelled\.$"):
        run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:", "MODE": "signal"})
    assert signal.getsignal(signal.SIGINT) is before


def test_failure_in_the_middle_of_writing_keeps_the_earlier_result(
        example, feedback, polygon_layer, tmp_path, plugin, monkeypatch):
    path = tmp_path / "out.gpkg"
    layer = polygon_layer([SQUARE] * 5)
    run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    before = path.read_bytes()
    layers = plugin("algorithms.framework.layers.layers")
    monkeypatch.setattr(layers, "BATCH", 2)
    whole = layers.features_of

    def torn(*arguments):
        for number, batch in enumerate(whole(*arguments)):
            if number == 1:
                raise plugin("urbanmap_qgis.errors").OutputError("The disk is full.")
            yield batch

    monkeypatch.setattr(layers, "features_of", torn)
    with pytest.raises(Exception, match="The disk is full"):
        run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    assert path.read_bytes() == before
    assert [item.name for item in tmp_path.iterdir()] == ["out.gpkg"]


def test_style_is_saved_in_the_geopackage_and_given_to_the_loaded_layer(
        qgis_app, plugin, polygon_layer, feedback, tmp_path, monkeypatch):
    from qgis.core import (
        QgsFillSymbol,
        QgsProcessingContext,
        QgsProcessingOutputLayerDefinition,
        QgsProject,
        QgsSingleSymbolRenderer,
        QgsVectorLayer,
    )

    base = plugin("algorithms.framework.base")
    monkeypatch.setattr(plugin("algorithms.framework.layers.styles"), "STYLES", tmp_path)
    styled = polygon_layer([SQUARE])
    styled.setRenderer(QgsSingleSymbolRenderer(QgsFillSymbol.createSimple({"color": "#123456"})))
    styled.saveNamedStyle(str(tmp_path / "blue.qml"))

    class Styled(base.UrbanMapAlgorithm):
        ID = "styled"
        NAME = "Styled"
        HELP = "Writes a styled layer."

        def declare(self):
            self.add_polygons("FOOTPRINTS", "Outlines", "Polygons.")
            self.add_layer_output("OUTPUT", "Styled", "The same.")

        def compute(self, parameters, context, feedback):
            table = self.read_polygons(parameters, "FOOTPRINTS", context)
            return self.write_layer(parameters, "OUTPUT", context, table.fields, table.columns, table.crs,
                                    table.geometries, "Polygon", style="blue")

    path = tmp_path / "styled.gpkg"
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    target = QgsProcessingOutputLayerDefinition(str(path), QgsProject.instance())
    results, _ = Styled().create().run(
        {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": target}, context, feedback, {}, False)

    opened = QgsVectorLayer(results["OUTPUT"], "opened", "ogr")
    assert opened.renderer().symbol().color().name() == "#123456"
    assert context.willLoadLayerOnCompletion(results["OUTPUT"])
    details = context.layerToLoadOnCompletionDetails(results["OUTPUT"])
    assert details.name == "Styled"
    plain = QgsVectorLayer("Polygon?crs=EPSG:6677", "plain", "memory")
    details.postProcessor().postProcessLayer(plain, context, feedback)
    assert plain.renderer().symbol().color().name() == "#123456"


def test_user_error_is_one_sentence(example, feedback, polygon_layer):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException) as caught:
        run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:",
                                        "MODE": "user error"})
    assert str(caught.value) == "The tile is empty: choose another."


def test_bug_keeps_its_name(example, feedback, polygon_layer):
    with pytest.raises(Exception, match="a bug"):
        run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:", "MODE": "bug"})


def test_unknown_parameter_is_named(example, feedback, polygon_layer):
    run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:", "STEPP": 1})
    assert feedback.warnings == ["Unknown parameter STEPP is ignored; did you mean STEP?"]


def test_invalid_and_empty_polygons_are_told(example, feedback, polygon_layer, read_layer, tmp_path):
    layer = polygon_layer([SQUARE, BOW_TIE, None], kind="MultiPolygon")
    path = tmp_path / "out.gpkg"
    results = run_example(example, feedback, {"FOOTPRINTS": layer, "OUTPUT": str(path)})
    assert results["COUNT"] == 3
    assert feedback.warnings == [
        "Building outlines: 2 of 3 polygons are empty, or invalid and were repaired (feature ids 2, 3)."]
    first, second, third = read_layer(path)
    assert first.attributes["area"] == 100.0
    assert second.attributes["area"] == 50.0
    assert "Self-intersection" in second.attributes["problem"]
    assert third.attributes["problem"] == "The feature has no polygon."


@pytest.mark.parametrize(("crs", "part"), [
    ("EPSG:4326", "coordinates are degrees"), ("EPSG:2263", "units of 0.3048 m"), ("", "is missing")])
def test_crs_that_cannot_work_is_refused(example, feedback, polygon_layer, crs, part):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=part) as caught:
        run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE], crs), "OUTPUT": "memory:"})
    assert str(caught.value).startswith("Building outlines: ")


def test_missing_point_file_is_refused_before_the_run(example, qgis_app, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingContext

    parameters = {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:", "POINTS": [str(tmp_path / "no.laz")]}
    accepted, message = example().create().checkParameterValues(parameters, QgsProcessingContext())
    assert not accepted
    assert message == f"Point clouds: the file {tmp_path / 'no.laz'} does not exist; check its name."


def test_output_folder_is_checked_before_the_run(example, qgis_app, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingContext

    parameters = {"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:",
                  "OUTPUT_TEXT": str(tmp_path / "none" / "a.txt")}
    accepted, message = example().create().checkParameterValues(parameters, QgsProcessingContext())
    assert not accepted
    assert "does not exist; create it" in message


def test_missing_package_is_named_with_the_command(example, qgis_app, polygon_layer, feedback, plugin, monkeypatch):
    from qgis.core import QgsProcessingContext, QgsProcessingException

    dependencies = plugin("urbanmap_qgis.dependencies")
    absent = dependencies.Package("urbanmap_absent", "urbanmap-absent", (2, 1))
    monkeypatch.setitem(dependencies.PACKAGES, "urbanmap_absent", absent)
    monkeypatch.setattr(example, "REQUIRES", ("numpy", "urbanmap_absent"))
    possible, message = example().create().canExecute()
    assert not possible
    assert message.startswith("Python packages missing: urbanmap-absent.")
    assert "-m pip install" in message
    with pytest.raises(QgsProcessingException, match="urbanmap-absent"):
        example().create().run({"FOOTPRINTS": polygon_layer([SQUARE]), "OUTPUT": "memory:"},
                               QgsProcessingContext(), feedback, {}, False)


def test_help_has_every_parameter_and_output(example, qgis_app):
    algorithm = example().create()
    text = algorithm.shortHelpString()
    for definition in [*algorithm.parameterDefinitions(), *algorithm.outputDefinitions()]:
        assert f"<b>{definition.description()}</b>: " in text
    assert "a &lt; b." in text
    assert "How many were copied." in text
    assert "How far to go. Default: 0.5." in text
    assert "Somebody 2018, 5.3" in text
    assert algorithm.shortDescription() == "Copies outlines."


def test_advanced_and_unit(example, qgis_app):
    from qgis.core import QgsProcessingParameterDefinition

    algorithm = example().create()
    definition = algorithm.parameterDefinition("STEP")
    assert definition.flags() & QgsProcessingParameterDefinition.Flag.FlagAdvanced
    assert definition.description() == "Step (m)"
    assert definition.minimum() == 0.01


def test_optional_output_can_be_offered_in_the_toolbox(example, qgis_app):
    algorithm = example().create()
    definition = algorithm.parameterDefinition("OUTPUT_TEXT")
    assert definition.createByDefault()
    assert definition.flags() & definition.Flag.FlagOptional


def test_same_crs_compares_plane_and_stated_heights(plugin, qgis_app):
    from qgis.core import QgsCoordinateReferenceSystem

    crs = plugin("algorithms.framework.layers.crs")
    errors = plugin("urbanmap_qgis.errors")
    plane, compound, other = (QgsCoordinateReferenceSystem(code) for code in ("EPSG:28992", "EPSG:7415", "EPSG:31370"))
    crs.same_crs("Points", crs.wkt_of(compound), "Outlines", plane)
    crs.same_crs("Points", plane.toWkt(QgsCoordinateReferenceSystem.WktVariant.WKT1_ESRI), "Outlines", plane)
    with pytest.raises(errors.InputError, match=r"^Points is in EPSG:31370 .* but Outlines is in EPSG:28992"):
        crs.same_crs("Points", other, "Outlines", plane)
    with pytest.raises(errors.InputError, match=r"^Points: the coordinate reference system is missing"):
        crs.same_crs("Points", "", "Outlines", plane)
    assert crs.metres_per_unit(QgsCoordinateReferenceSystem("EPSG:2263")) == pytest.approx(
        0.3048006096, abs=1e-9)


def test_a_system_is_known_by_its_names_before_and_after_it_was_renamed(plugin, qgis_app):
    """As QGIS with a newer database writes EPSG:6677, and as one with an older does."""
    from qgis.core import QgsCoordinateReferenceSystem

    crs = plugin("algorithms.framework.layers.crs")
    plane = QgsCoordinateReferenceSystem("EPSG:6677")
    old = crs.wkt_of(plane)
    assert "JGD2024" not in old
    for wkt in (old, old.replace("JGD2011", "JGD2024").replace("Datum 2011", "Datum 2024")):
        assert crs.crs_from(wkt).authid() == "EPSG:6677"
        crs.same_crs("Points", wkt, "Outlines", plane)
        custom = QgsCoordinateReferenceSystem.fromWkt(wkt)
        crs.same_crs("Points", custom, "Outlines", plane)


def test_old_and_new_names_of_one_system_are_equal_and_other_heights_are_not(plugin, qgis_app):
    from qgis.core import QgsCoordinateReferenceSystem

    crs, errors = plugin("algorithms.framework.layers.crs"), plugin("urbanmap_qgis.errors")
    heights = plugin("urbanmap_qgis.io.reference.height_systems")
    plane = crs.wkt_of(QgsCoordinateReferenceSystem("EPSG:6677"))
    renamed = plane.replace("JGD2011", "JGD2024").replace("Datum 2011", "Datum 2024")
    assert renamed != plane
    crs.same_crs("Points", plane, "Outlines", renamed)
    crs.same_crs("Points", plane, "Outlines", renamed.replace(',ID["EPSG",6677]', ""))
    old, new = (heights.stating_heights(plane, heights.japanese(kind)) for kind in ("JGD2011", "JGD2024"))
    crs.same_crs("Points", old, "Outlines", renamed)
    with pytest.raises(errors.InputError, match="^Points has heights in JGD2011 .* but Ground in JGD2024 .* convert"):
        crs.same_crs("Points", old, "Ground", new)


def test_two_datums_of_one_zone_differ(plugin, qgis_app):
    """JGD2000 and JGD2011 have the same projection and lie metres apart in the north-east of Japan."""
    from qgis.core import QgsCoordinateReferenceSystem

    crs = plugin("algorithms.framework.layers.crs")
    errors = plugin("urbanmap_qgis.errors")
    with pytest.raises(errors.InputError):
        crs.same_crs("A", QgsCoordinateReferenceSystem("EPSG:2451"), "B", QgsCoordinateReferenceSystem("EPSG:6677"))


@pytest.mark.parametrize("given", ["user error", "1", 1, " 1 "])
def test_choice_by_word_and_by_number(example, feedback, polygon_layer, given):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="The tile is empty"):
        run_example(example, feedback, {"FOOTPRINTS": polygon_layer([SQUARE]), "MODE": given, "OUTPUT": "memory:"})


@pytest.mark.parametrize("given", ["7", "-1", "1.5", "nonsense", True])
def test_choice_that_is_none_is_refused(example, qgis_app, polygon_layer, given):
    from qgis.core import QgsProcessingContext

    accepted, message = example().create().checkParameterValues(
        {"FOOTPRINTS": polygon_layer([SQUARE]), "MODE": given, "OUTPUT": "memory:"}, QgsProcessingContext())
    assert not accepted and "is none of copy, user error" in message


def test_a_table_is_told_by_its_content_where_its_suffix_is_of_no_layer(plugin, tmp_path):
    known = plugin("algorithms.framework.declaring.parameters").text_table
    for name, content, wanted in (("a.ori", b"x,y\n1,2\n", True), ("a.csv.gz", gzip.compress(b"x,y\n1,2\n"), True),
                                  ("a.dxf", b"  0\nSECTION\n", False), ("a.ori", b"\x00\x01", False),
                                  ("a.geo", b"{}", False), ("a.dat", b"<gpx/>", False)):
        (tmp_path / name).write_bytes(content)
        assert bool(known({"T": str(tmp_path / name)}, "T")) == wanted, name
