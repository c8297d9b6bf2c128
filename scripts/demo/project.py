"""Write the demo's QGIS project: data, results and truth in their styles, with an oblique 3D view of the models.

    python3 scripts/demo/project.py demo

Needs a Python that sees QGIS.
"""

from __future__ import annotations

import csv
import json
import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import numpy as np
from qgis import _3d as engine
from qgis.core import (
    QgsApplication,
    QgsCategorizedSymbolRenderer,
    QgsFeature,
    QgsField,
    QgsFillSymbol,
    QgsGeometry,
    QgsLineSymbol,
    QgsMapLayer,
    QgsMapSettings,
    QgsPointXY,
    QgsProject,
    QgsRasterLayer,
    QgsReadWriteContext,
    QgsRendererCategory,
    QgsSingleSymbolRenderer,
    QgsVector3D,
    QgsVectorFileWriter,
    QgsVectorLayer,
)
from qgis.PyQt.QtCore import QVariant
from qgis.PyQt.QtGui import QColor
from qgis.PyQt.QtXml import QDomDocument

from scripts.styles.symbols import surface_3d
from urbanmap_qgis.samplecity.aerial.camera import Camera, Exposure
from urbanmap_qgis.samplecity.aerial.flight import footprint

STYLES = Path(__file__).resolve().parents[2] / "resources" / "styles"
CRS = "EPSG:6677"

SCENE = """<qgis3d>
  <origin x="{x}" y="{y}" z="0"/>
  <color background="228,237,245,255" selection="255,255,0,255"/>
  <terrain terrain-rendering-enabled="0" elevation-offset="0" exaggeration="1" texture-size="512"
           max-terrain-error="3" max-ground-error="1" shading-enabled="0" show-labels="0" map-theme="">
    <generator type="flat"><extent xmin="{xmin}" ymin="{ymin}" xmax="{xmax}" ymax="{ymax}"/></generator>
  </terrain>
</qgis3d>"""
"""What of a 3D view cannot be set from Python in QGIS 3.22."""

WINDOW = {"name": "3D Map 1", "isOpen": 1, "floating": 1, "area": 2, "x": 80, "y": 60, "width": 900, "height": 600}


def open_layer(path: Path, title: str, kind: type[QgsMapLayer] = QgsVectorLayer, part: str = "") -> QgsMapLayer:
    """A vector or raster layer of a file; `part` names one of several layers."""
    place = f"{path}|layername={part}" if part else str(path)
    layer = kind(place, title, "ogr" if kind is QgsVectorLayer else "gdal")
    if not layer.isValid():
        sys.exit(f"{path}: the layer cannot be opened.")
    return layer


def styled(layer: QgsMapLayer, style: str) -> QgsMapLayer:
    """The layer with one of the plugin's styles, in 2D and 3D."""
    document = QDomDocument()
    document.setContent((STYLES / f"{style}.qml").read_text(encoding="utf-8"))
    read, message = layer.importNamedStyle(document)
    if not read:
        sys.exit(f"{layer.name()}: the style {style} cannot be used. {message}")
    return layer


def outlined(layer: QgsVectorLayer, colour: str, style: str = "solid", width: float = 0.4) -> QgsVectorLayer:
    """The polygon layer as lines; width in mm."""
    layer.setRenderer(QgsSingleSymbolRenderer(QgsFillSymbol.createSimple(
        {"style": "no", "outline_color": colour, "outline_width": str(width), "outline_style": style})))
    return layer


def categorised(layer: QgsVectorLayer, field: str, symbols: dict) -> QgsVectorLayer:
    """The layer with a symbol for each value of a field."""
    layer.setRenderer(QgsCategorizedSymbolRenderer(
        field, [QgsRendererCategory(value, symbol, value) for value, symbol in symbols.items()]))
    return layer


def plates(layer: QgsVectorLayer, height: float) -> QgsVectorLayer:
    """The polygon layer as plates at a height (m) in 3D."""
    material = engine.QgsPhongMaterialSettings()
    material.setDiffuse(QColor("#7f93ad"))
    material.setAmbient(QColor("#4f5f75"))
    symbol = surface_3d(material)
    symbol.setHeight(height)
    layer.setRenderer3D(engine.QgsVectorLayer3DRenderer(symbol))
    return layer


def write_shapes(path: Path, shapes: list[tuple[QgsGeometry, dict[str, str]]], kind: str) -> Path:
    """Write shapes with text fields as GeoPackage; `kind` such as "Polygon"."""
    layer = QgsVectorLayer(f"{kind}?crs={CRS}", path.stem, "memory")
    layer.dataProvider().addAttributes([QgsField(name, QVariant.String) for name in shapes[0][1]])
    layer.updateFields()
    for geometry, values in shapes:
        feature = QgsFeature(layer.fields())
        feature.setGeometry(geometry)
        feature.setAttributes(list(values.values()))
        layer.dataProvider().addFeature(feature)
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = "GPKG"
    error, message, *_ = QgsVectorFileWriter.writeAsVectorFormatV3(
        layer, str(path), QgsProject.instance().transformContext(), options)
    if error != QgsVectorFileWriter.NoError:
        sys.exit(f"{path} cannot be written: {message}")
    return path


def trajectories(city: Path) -> list[tuple[QgsGeometry, dict[str, str]]]:
    """The ways of the mobile surveys as lines, reported and true."""
    shapes = []
    for name, folder in (("reported", "mms"), ("true", "truth")):
        for survey in ("survey_01", "survey_02"):
            rows = np.loadtxt(city / folder / f"{survey}_trajectory.csv", delimiter=",", skiprows=1)
            line = QgsGeometry.fromPolylineXY([QgsPointXY(x, y) for x, y in rows[::10, 1:3]])
            shapes.append((line, {"trajectory": name, "survey": survey}))
    return shapes


def frames(city: Path, level: float) -> list[tuple[QgsGeometry, dict[str, str]]]:
    """What the aerial frames show of the ground at a height (m)."""
    facts = json.loads((city / "aerial/camera.json").read_text(encoding="utf-8"))
    camera = Camera(facts["focal_length_mm"], facts["pixel_pitch_mm"], facts["image_width"], facts["image_height"],
                    tuple(facts["principal_point_mm"]))
    shapes = []
    with open(city / "aerial/exterior.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            image = row.pop("image")
            exposure = Exposure(image, **{name: float(value) for name, value in row.items()}, time=0.0)
            ring = [QgsPointXY(x, y) for x, y in footprint(camera, exposure, level)]
            shapes.append((QgsGeometry.fromPolygonXY([[*ring, ring[0]]]), {"image": image}))
    return shapes


def line(colour: str, style: str = "solid") -> QgsLineSymbol:
    return QgsLineSymbol.createSimple({"line_color": colour, "line_width": "0.5", "line_style": style})


def fill(colour: str) -> QgsFillSymbol:
    return QgsFillSymbol.createSimple({"color": colour, "outline_color": "#333333", "outline_width": "0.1"})


def add_views(document: QDomDocument, shown: list, foot: float) -> None:
    """Put the extent of the map and the 3D view into a project's file: both are kept by QGIS's windows."""
    layer = shown[-1]
    extent = layer.extent()
    extent.scale(1.1)
    canvas = document.createElement("mapcanvas")
    canvas.setAttribute("name", "theMapCanvas")
    settings = QgsMapSettings()
    settings.setDestinationCrs(layer.crs())
    settings.setExtent(extent)
    settings.writeXml(canvas, document)
    document.documentElement().appendChild(canvas)
    views = document.createElement("mapViewDocks3D")
    views.appendChild(view_3d(document, shown, foot))
    old = document.documentElement().firstChildElement("mapViewDocks3D")
    document.documentElement().removeChild(old)
    document.documentElement().appendChild(views)


def view_3d(document: QDomDocument, shown: list, foot: float):
    """A 3D view from the south-west; the camera turns about a point at the height `foot` (m)."""
    layer = shown[-1]
    extent = layer.extent()
    scene = QDomDocument()
    scene.setContent(SCENE.format(x=extent.center().x(), y=extent.center().y(), xmin=extent.xMinimum(),
                                  ymin=extent.yMinimum(), xmax=extent.xMaximum(), ymax=extent.yMaximum()))
    settings = engine.Qgs3DMapSettings()
    settings.readXml(scene.documentElement(), QgsReadWriteContext())
    settings.setCrs(layer.crs())
    settings.setLayers(shown)
    sun = engine.QgsDirectionalLightSettings()
    sun.setDirection(QgsVector3D(0.5, -0.7, -0.6))
    if hasattr(settings, "setLightSources"):  # QGIS 3.26 and later
        settings.setLightSources([sun])
    else:
        settings.setPointLights([])
        settings.setDirectionalLights([sun])
    view = document.createElement("view")
    for name, value in WINDOW.items():
        view.setAttribute(name, str(value))
    view.appendChild(settings.writeXml(document, QgsReadWriteContext()))
    camera = document.createElement("camera")
    distance = 1.5 * max(extent.width(), extent.height())
    for name, value in (("x", 0), ("y", 0), ("elev", foot), ("dist", distance), ("pitch", 50), ("yaw", 30)):
        camera.setAttribute(name, str(value))
    view.appendChild(camera)
    return view


def make_layers(folder: Path) -> dict[str, list[tuple[QgsMapLayer, bool]]]:
    """All layers by group, from top to bottom, each with whether it is shown."""
    city = folder / "city"
    models = styled(open_layer(folder / "models.gpkg", "Building models, by quality"), "building_models")
    foot = foot_of(models)
    ways = open_layer(write_shapes(folder / "trajectories.gpkg", trajectories(city), "LineString"), "Trajectories")
    frame = open_layer(write_shapes(folder / "frames.gpkg", frames(city, foot), "Polygon"), "Frames on the ground")
    markings = open_layer(city / "truth/markings.gpkg", "Road markings", part="mms")
    return {
        "Mobile surveys": [
            (categorised(ways, "trajectory", {"reported": line("#e8590c"), "true": line("#22d3ee")}), True),
            (result(folder, "survey_01_patches", "Patches of the registered survey", "mms_patches"), True),
            (result(folder, "walls", "Measured walls", "facade_walls"), False),
            (result(folder, "adjusted_walls", "Walls moved by GNSS reflections", "gnss_walls"), False)],
        "Truth": [(outlined(open_layer(city / "truth/footprints.gpkg", "True outlines"), "#22d3ee"), True),
                  (categorised(markings, "color", {"white": fill("#ffffff"), "yellow": fill("#ffd43b")}), True)],
        "Buildings": [
            (outlined(open_layer(folder / "models.gpkg", "Outlines of the models"), "#d6336c"), True),
            (plates(outlined(open_layer(folder / "outlines.gpkg", "Outlines as given"), "#1f4e8c", "dash"),
                    foot - 0.2), True),
            (styled(open_layer(folder / "models_surfaces.gpkg", "Surfaces of the models (3D)"), "building_surfaces"),
             False),
            (result(folder, "merged", "Models with measured walls (3D)", "merged_models"), False),
            (models, False)],
        "Aerial": [
            (outlined(frame, "#fab005", "dot"), False),
            (result(folder, "markings", "Road markings found in the frames", "road_markings"), False),
            (open_layer(city / "aerial/ortho.tif", "Conventional orthophoto", QgsRasterLayer), True),
            (styled(open_layer(folder / "dsm.tif", "Surface (DSM)", QgsRasterLayer), "dsm"), False),
            (styled(open_layer(folder / "ground.tif", "Ground", QgsRasterLayer), "ground"), False)],
    }


def result(folder: Path, name: str, title: str, style: str) -> QgsVectorLayer:
    """A layer that a stage wrote, in its style."""
    return styled(open_layer(folder / f"{name}.gpkg", title), style)


def foot_of(models: QgsVectorLayer) -> float:
    """Height of the lowest foot of a model, m."""
    return min(feature["base"] for feature in models.getFeatures() if feature.hasGeometry())


def main() -> None:
    """Write urbanmap.qgz into the demo's folder."""
    folder = Path(sys.argv[1]).resolve()
    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    project = QgsProject.instance()
    groups = make_layers(folder)
    for title, layers in groups.items():
        group = project.layerTreeRoot().addGroup(title)
        for layer, shown in layers:
            project.addMapLayer(layer, False)
            node = group.addLayer(layer)
            node.setExpanded(False)
            node.setItemVisibilityChecked(shown)
    (outlines, _), (surfaces, _), _, (models, _) = groups["Buildings"][1:]
    project.setCrs(models.crs())
    project.setTitle("UrbanMap demo")
    project.setTopologicalEditing(True)  # what shares nodes goes on sharing them when it is edited by hand
    project.writeProject.connect(lambda document: add_views(document, [outlines, surfaces], foot_of(models)))
    path = folder / "urbanmap.qgz"
    if not project.write(str(path)):
        sys.exit(f"{path} cannot be written: {project.error()}")
    project.clear()
    application.exitQgis()


if __name__ == "__main__":
    main()
