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
from qgis.core import QgsApplication, QgsFillSymbol, QgsMapSettings, QgsProject, QgsSingleSymbolRenderer, QgsVectorLayer
from qgis.PyQt.QtXml import QDomDocument

STYLES = Path(__file__).resolve().parent.parent / "resources" / "styles"

VIEW_3D = """<view name="3D Map 1" isOpen="1" floating="1" area="2" x="80" y="60" width="1100" height="700">
<qgis3d>
  <origin x="{x}" y="{y}" z="0"/>
  <camera projection-type="1" camera-navigation-mode="terrain-based-navigation" camera-movement-speed="5"
          field-of-view="45"/>
  <color background="228,237,245,255" selection="255,255,0,255"/>
  <point-lights/>
  <directional-lights>
    <directional-light color="255,255,255,255" intensity="1" x="0.45" y="-0.8" z="-0.4"/>
  </directional-lights>
  <terrain terrain-rendering-enabled="1" elevation-offset="{foot}" exaggeration="1" texture-size="512"
           max-terrain-error="3" max-ground-error="1" shading-enabled="0" show-labels="0" map-theme="">
    <generator type="flat"><extent xmin="{xmin}" ymin="{ymin}" xmax="{xmax}" ymax="{ymax}"/></generator>
  </terrain>
</qgis3d>
<camera x="0" y="0" elev="{foot}" dist="{distance}" pitch="50" yaw="30"/>
</view>"""


def styled_layer(path: Path, title: str, style: str) -> QgsVectorLayer:
    """A layer with one of the plugin's styles, in 2D and 3D."""
    layer = QgsVectorLayer(str(path), title, "ogr")
    document = QDomDocument()
    document.setContent((STYLES / f"{style}.qml").read_text(encoding="utf-8"))
    read, message = layer.importNamedStyle(document)
    if not layer.isValid() or not read:
        sys.exit(f"{path}: the layer cannot be opened in its style. {message}")
    return layer


def outline_layer(path: Path) -> QgsVectorLayer:
    """The outlines as given, as dashed lines."""
    layer = QgsVectorLayer(str(path), "Outlines as given", "ogr")
    layer.setRenderer(QgsSingleSymbolRenderer(QgsFillSymbol.createSimple(
        {"style": "no", "outline_color": "#1f4e8c", "outline_width": "0.4", "outline_style": "dash"})))
    return layer


def add_views(document: QDomDocument, layer: QgsVectorLayer, foot: float) -> None:
    """Put the extent of the map and the 3D view into a project's file: both are kept by QGIS's windows."""
    extent = layer.extent()
    extent.scale(1.15)
    canvas = document.createElement("mapcanvas")
    canvas.setAttribute("name", "theMapCanvas")
    settings = QgsMapSettings()
    settings.setDestinationCrs(layer.crs())
    settings.setExtent(extent)
    settings.writeXml(canvas, document)
    document.documentElement().appendChild(canvas)
    view = QDomDocument()
    view.setContent(VIEW_3D.format(
        x=extent.center().x(), y=extent.center().y(), xmin=extent.xMinimum(), ymin=extent.yMinimum(),
        xmax=extent.xMaximum(), ymax=extent.yMaximum(), foot=foot, distance=1.1 * max(extent.width(), extent.height())))
    views = document.createElement("mapViewDocks3D")
    views.appendChild(document.importNode(view.documentElement(), True))
    old = document.documentElement().firstChildElement("mapViewDocks3D")
    document.documentElement().removeChild(old)
    document.documentElement().appendChild(views)


def main() -> None:
    """Write buildings.qgz into the demo's folder."""
    folder = Path(sys.argv[1]).resolve()
    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    project = QgsProject.instance()
    models = styled_layer(folder / "building_models.gpkg", "Building models", "building_models")
    surfaces = styled_layer(folder / "building_surfaces.gpkg", "Surfaces", "building_surfaces")
    outlines = outline_layer(folder / "input" / OUTLINES)
    for layer in (outlines, surfaces, models):
        project.addMapLayer(layer, False)
        node = project.layerTreeRoot().addLayer(layer)
        node.setExpanded(layer is not outlines)
    # Both layers have the same faces: shown together in 3D they would flicker.
    project.layerTreeRoot().findLayer(models.id()).setItemVisibilityChecked(False)
    project.setCrs(models.crs())
    project.setTitle("UrbanMap demo")
    foot = min(feature["base"] for feature in models.getFeatures() if feature.hasGeometry())
    project.writeProject.connect(lambda document: add_views(document, surfaces, foot - 0.2))
    path = folder / "buildings.qgz"
    if not project.write(str(path)):
        sys.exit(f"{path} cannot be written: {project.error()}")
    project.clear()
    application.exitQgis()


if __name__ == "__main__":
    main()
