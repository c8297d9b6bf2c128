"""A QGIS application with Processing and the UrbanMap provider, for tests inside one process."""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[2]
PLUGIN = "urbanmap_plugin"

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QGIS_NO_OVERRIDE_IMPORT", "1")


def load_plugin():
    """The checkout as a package of its own name, as QGIS loads a plugin folder."""
    if PLUGIN not in sys.modules:
        spec = importlib.util.spec_from_file_location(
            PLUGIN, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)])
        module = importlib.util.module_from_spec(spec)
        sys.modules[PLUGIN] = module
        spec.loader.exec_module(module)
    return sys.modules[PLUGIN]


def pytest_collection_modifyitems(config, items):
    """Skip with the reason where there is no QGIS."""
    if importlib.util.find_spec("qgis") is None:
        for item in items:
            if Path(str(item.fspath)).parent == Path(__file__).parent:
                item.add_marker(pytest.mark.skip(reason="QGIS's Python modules are not importable"))


def start_qgis(profile):
    """A running QGIS application with Processing, and the plugin in it."""
    os.environ["QGIS_CUSTOM_CONFIG_PATH"] = str(profile)
    from qgis.core import QgsApplication

    application = QgsApplication([], True, str(profile))
    application.initQgis()
    plugins = Path(QgsApplication.pkgDataPath()) / "python" / "plugins"
    sys.path.append(str(plugins))
    from processing.core.Processing import Processing

    Processing.initialize()
    plugin = load_plugin().classFactory(None)
    plugin.initProcessing()
    return application, plugin


@pytest.fixture(scope="session")
def qgis_app(tmp_path_factory):
    """A running QGIS application with Processing and the plugin's provider."""
    application, plugin = start_qgis(tmp_path_factory.mktemp("profile"))
    yield application
    plugin.unload()


@pytest.fixture(scope="session")
def plugin(qgis_app):
    """The modules of the plugin: `plugin("algorithms.framework.base")`."""
    return lambda name: importlib.import_module(f"{PLUGIN}.{name}")


def make_feedback():
    """A feedback object that keeps what it is told; `cancel_at` cancels at that progress."""
    from qgis.core import QgsProcessingFeedback

    class Feedback(QgsProcessingFeedback):
        def __init__(self):
            super().__init__(False)
            self.infos, self.warnings, self.errors, self.steps = [], [], [], []
            self.cancel_at = None
            self.progressChanged.connect(self._moved)

        def _moved(self, value):
            self.steps.append(value)
            if self.cancel_at is not None and value >= self.cancel_at:
                self.cancel()

        def pushInfo(self, info):
            self.infos.append(info)

        def pushWarning(self, warning):
            self.warnings.append(warning)

        def reportError(self, error, fatalError=False):
            self.errors.append(error)

    return Feedback()


@pytest.fixture
def feedback(qgis_app):
    """A feedback object that collects messages."""
    return make_feedback()


@pytest.fixture
def run(qgis_app, feedback):
    """`run(algorithm_id_or_object, parameters)`: results by name; `run.feedback` has the messages."""

    def run_algorithm(algorithm, parameters, context=None):
        import processing

        if not isinstance(algorithm, str):
            algorithm = algorithm.create()
        return processing.run(algorithm, parameters, feedback=feedback, context=context)

    run_algorithm.feedback = feedback
    return run_algorithm


@pytest.fixture
def polygon_layer(qgis_app):
    """`polygon_layer(wkts, crs, fields)`: a memory layer; `fields` maps a name to its values."""

    def make(wkts, crs="EPSG:6677", fields=None, kind="Polygon", name="outlines"):
        from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer

        columns = fields or {}
        kinds = {int: "integer", float: "double", str: "string"}
        text = "".join(f"&field={key}:{kinds[type(values[0])]}" for key, values in columns.items())
        layer = QgsVectorLayer(f"{kind}?crs={crs}{text}", name, "memory")
        for row, wkt in enumerate(wkts):
            feature = QgsFeature(layer.fields())
            feature.setAttributes([values[row] for values in columns.values()])
            if wkt:
                feature.setGeometry(QgsGeometry.fromWkt(wkt))
            layer.dataProvider().addFeature(feature)
        layer.updateExtents()
        return layer

    return make


@pytest.fixture
def read_layer(qgis_app):
    """`read_layer(result)`: features of an output as objects with `attributes` (dict) and `wkt`."""

    def read(result):
        from qgis.core import QgsVectorLayer

        layer = result if isinstance(result, QgsVectorLayer) else QgsVectorLayer(str(result), "result", "ogr")
        assert layer.isValid(), result
        names = [field.name() for field in layer.fields()]
        return [SimpleNamespace(attributes=dict(zip(names, item.attributes())), wkt=item.geometry().asWkt(),
                                geometry=item.geometry()) for item in layer.getFeatures()]

    return read


@pytest.fixture(scope="session")
def save_outlines(qgis_app):
    """`save_outlines(path, geometries, fields, epsg)`: shapely polygons in a GeoPackage; gives its path."""

    def save(path, geometries, fields=None, epsg=6677, kind="MultiPolygon"):
        from qgis.core import (
            QgsCoordinateReferenceSystem,
            QgsCoordinateTransformContext,
            QgsFeature,
            QgsGeometry,
            QgsVectorFileWriter,
            QgsVectorLayer,
        )

        columns = fields or {}
        kinds = {int: "integer", float: "double", str: "string"}
        text = "".join(f"&field={key}:{kinds[type(values[0])]}" for key, values in columns.items())
        layer = QgsVectorLayer(f"{kind}?crs=EPSG:{epsg}{text}" if epsg else f"{kind}?{text[1:]}", "outlines", "memory")
        for row, geometry in enumerate(geometries):
            feature = QgsFeature(layer.fields())
            feature.setAttributes([values[row] for values in columns.values()])
            if geometry is not None:
                feature.setGeometry(QgsGeometry.fromWkt(geometry.wkt))
            layer.dataProvider().addFeature(feature)
        if not epsg:
            layer.setCrs(QgsCoordinateReferenceSystem())
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.layerName = "outlines"
        code = QgsVectorFileWriter.writeAsVectorFormatV3(layer, str(path), QgsCoordinateTransformContext(), options)
        assert code[0] == 0, code
        return path

    return save
