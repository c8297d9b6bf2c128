"""Write the demo's QGIS project: models, surfaces and outlines in their styles, with an oblique 3D view.

    python3 scripts/demo_project.py demo

Needs a Python that sees QGIS.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from demo_data import OUTLINES
from qgis import _3d as engine
from qgis.core import (
    Qgis,
    QgsApplication,
    QgsFillSymbol,
    QgsMapSettings,
    QgsProject,
    QgsReadWriteContext,
    QgsSingleSymbolRenderer,
    QgsVector3D,
    QgsVectorLayer,
)
from qgis.PyQt.QtGui import QColor
from qgis.PyQt.QtXml import QDomDocument

STYLES = Path(__file__).resolve().parent.parent / "resources" / "styles"

SCENE = """<qgis3d>
  <origin x="{x}" y="{y}" z="0"/>
  <color background="228,237,245,255" selection="255,255,0,255"/>
  <terrain terrain-rendering-enabled="0" elevation-offset="0" exaggeration="1" texture-size="512"
           max-terrain-error="3" max-ground-error="1" shading-enabled="0" show-labels="0" map-theme="">
    <generator type="flat"><extent xmin="{xmin}" ymin="{ymin}" xmax="{xmax}" ymax="{ymax}"/></generator>
  </terrain>
</qgis3d>"""
"""What of a 3D view cannot be set from Python in QGIS 3.22."""

WINDOW = {"name": "3D Map 1", "isOpen": 1, "floating": 1, "area": 2, "x": 80, "y": 60, "width": 1100, "height": 700}


def styled_layer(path: Path, title: str, style: str) -> QgsVectorLayer:
    """A layer with one of the plugin's styles, in 2D and 3D."""
    layer = QgsVectorLayer(str(path), title, "ogr")
    document = QDomDocument()
    document.setContent((STYLES / f"{style}.qml").read_text(encoding="utf-8"))
    read, message = layer.importNamedStyle(document)
    if not layer.isValid() or not read:
        sys.exit(f"{path}: the layer cannot be opened in its style. {message}")
    return layer


def outline_layer(path: Path, foot: float) -> QgsVectorLayer:
    """The outlines as given: dashed lines in the map, plates at the height `foot` (m) in 3D."""
    layer = QgsVectorLayer(str(path), "Outlines as given", "ogr")
    layer.setRenderer(QgsSingleSymbolRenderer(QgsFillSymbol.createSimple(
        {"style": "no", "outline_color": "#1f4e8c", "outline_width": "0.4", "outline_style": "dash"})))
    material = engine.QgsPhongMaterialSettings()
    material.setDiffuse(QColor("#7f93ad"))
    material.setAmbient(QColor("#4f5f75"))
    symbol = engine.QgsPolygon3DSymbol()
    if hasattr(symbol, "setMaterialSettings"):  # QGIS 3.30 and later
        symbol.setMaterialSettings(material)
        symbol.setAltitudeClamping(Qgis.AltitudeClamping.Absolute)
    else:
        symbol.setMaterial(material)
        symbol.setAltitudeClamping(engine.Qgs3DTypes.AltClampAbsolute)
    symbol.setHeight(foot)
    layer.setRenderer3D(engine.QgsVectorLayer3DRenderer(symbol))
    return layer


def add_views(document: QDomDocument, shown: list, foot: float) -> None:
    """Put the extent of the map and the 3D view into a project's file: both are kept by QGIS's windows."""
    layer = shown[-1]
    extent = layer.extent()
    extent.scale(1.15)
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
    distance = 1.25 * max(extent.width(), extent.height())
    for name, value in (("x", 0), ("y", 0), ("elev", foot), ("dist", distance), ("pitch", 50), ("yaw", 30)):
        camera.setAttribute(name, str(value))
    view.appendChild(camera)
    return view


def main() -> None:
    """Write buildings.qgz into the demo's folder."""
    folder = Path(sys.argv[1]).resolve()
    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    project = QgsProject.instance()
    models = styled_layer(folder / "building_models.gpkg", "Building models", "building_models")
    surfaces = styled_layer(folder / "building_surfaces.gpkg", "Surfaces", "building_surfaces")
    foot = min(feature["base"] for feature in models.getFeatures() if feature.hasGeometry()) - 0.2
    outlines = outline_layer(folder / "input" / OUTLINES, foot)
    for layer in (outlines, surfaces, models):
        project.addMapLayer(layer, False)
        node = project.layerTreeRoot().addLayer(layer)
        node.setExpanded(layer is not outlines)
    # Both layers have the same faces: shown together in 3D they would flicker.
    project.layerTreeRoot().findLayer(models.id()).setItemVisibilityChecked(False)
    project.setCrs(models.crs())
    project.setTitle("UrbanMap demo")
    project.writeProject.connect(lambda document: add_views(document, [outlines, surfaces], foot))
    path = folder / "buildings.qgz"
    if not project.write(str(path)):
        sys.exit(f"{path} cannot be written: {project.error()}")
    project.clear()
    application.exitQgis()


if __name__ == "__main__":
    main()
