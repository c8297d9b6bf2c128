#!/usr/bin/env python3
"""Render 3D building models to a picture with QGIS's own 3D engine.

    python3 scripts/render_models.py models.gpkg models.png --layer surfaces --heading 30

Takes any layer of (Multi)PolygonZ surfaces. Surfaces are coloured by the field `surface_type` (roof, outer
wall, inner wall, ground) where the layer has it. Needs a Python that sees QGIS (3.22 or later); without a
screen also `xvfb` and Mesa's software renderer (Debian: apt install xvfb libgl1-mesa-dri).
"""

from __future__ import annotations

import argparse
import math
import os
import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

SURFACE_COLOURS = {"roof": "#c4573f", "outer wall": "#efe6d8", "inner wall": "#d9c7a8", "ground": "#8d9486"}
OTHER_COLOUR = "#efe6d8"
GROUND_COLOUR = "#c3cdb9"
SKY_COLOUR = "#e4edf5"
FIELD_OF_VIEW = 30.0
"""Vertical opening of the camera in degrees: calmer than the 45 of the 3D window."""
MARGIN = 1.06
"""Distance of the camera over the least distance that shows everything."""
SHADOW_REACH = 4
"""Shadows reach this many times further than the middle of the models."""
SUPERSAMPLING = 2
"""The 3D engine draws without anti-aliasing: draw this many times larger, then scale down."""
PIXELS_PER_MM = 10


@dataclass(frozen=True)
class View:
    """What the camera looks at and from where; lengths in map units."""

    centre: np.ndarray
    distance: float
    pitch: float
    azimuth: float


def parse_arguments(arguments: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("input", type=Path, help="GeoPackage (or other vector file) with the models")
    parser.add_argument("output", type=Path, help="picture to write (.png)")
    parser.add_argument("--layer", help="name of the layer in the file (default: the first with 3D polygons)")
    parser.add_argument("--size", default="1600x1000", help="width x height in pixels (default: %(default)s)")
    parser.add_argument("--pitch", type=float, default=55, help="0 looks straight down, 90 to the horizon")
    parser.add_argument("--heading", type=float, default=330, help="view direction, clockwise from north")
    parser.add_argument("--zoom", type=float, default=1, help="above 1: closer than showing everything")
    parser.add_argument("--no-ground", action="store_true", help="leave out the ground plane")
    options = parser.parse_args(arguments)
    try:
        options.size = tuple(int(part) for part in options.size.split("x"))
        width, height = options.size
    except ValueError:
        parser.error("--size is WIDTHxHEIGHT in pixels, for example 1600x1000")
    if min(width, height) < 16 or max(width, height) > 4096:
        parser.error("--size must lie between 16 and 4096 pixels")
    if not 0 <= options.pitch < 90 or options.zoom <= 0:
        parser.error("--pitch must lie between 0 and 90 degrees, --zoom above 0")
    return options


def ensure_screen(script: Path = Path(__file__)) -> None:
    """Start a script again on a virtual screen when there is none: the 3D engine needs OpenGL."""
    if os.environ.get("DISPLAY"):
        os.environ.pop("QT_QPA_PLATFORM", None)
        return
    xvfb = shutil.which("xvfb-run")
    if xvfb is None:
        sys.exit("No screen, and no virtual one: install it with 'apt install xvfb libgl1-mesa-dri'.")
    os.environ.pop("QT_QPA_PLATFORM", None)
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
    command = [sys.executable, str(script.resolve()), *sys.argv[1:]]
    os.execv(xvfb, [xvfb, "-a", "-s", "-screen 0 1280x1024x24", *command])


def open_layer(path: Path, name: str | None):
    """Open the named layer, or the first one with 3D polygons."""
    from qgis.core import QgsProviderRegistry, QgsVectorLayer, QgsWkbTypes

    if not path.is_file():
        sys.exit(f"{path} does not exist.")
    details = QgsProviderRegistry.instance().querySublayers(str(path))
    names = [detail.name() for detail in details]
    for detail in details:
        if name not in (None, detail.name()):
            continue
        layer = QgsVectorLayer(detail.uri(), detail.name(), "ogr")
        is_3d = QgsWkbTypes.hasZ(layer.wkbType()) and layer.geometryType() == QgsWkbTypes.PolygonGeometry
        if layer.isValid() and is_3d:
            return layer
    wanted = f"no layer '{name}' of 3D polygons" if name else "no layer of 3D polygons"
    sys.exit(f"{path} has {wanted}; its layers: {', '.join(names) or 'none'}.")


def read_vertices(layer) -> tuple[np.ndarray, float]:
    """All vertices (n, 3), and the height of the ground: the median of the buildings' lowest points."""
    vertices, feet = [], {}
    has_id = layer.fields().indexOf("building_id") >= 0
    for feature in layer.getFeatures():
        points = [(point.x(), point.y(), point.z()) for point in feature.geometry().vertices()]
        if not points:
            continue
        vertices.extend(points)
        key = feature["building_id"] if has_id else feature.id()
        feet[key] = min(feet.get(key, math.inf), min(z for _, _, z in points))
    if not vertices:
        sys.exit(f"Layer '{layer.name()}' is empty: there is nothing to render.")
    return np.asarray(vertices), float(np.median(list(feet.values())))


def view_direction(pitch: float, azimuth: float) -> np.ndarray:
    """Unit vector (east, north, up) for a pitch from straight down and an azimuth from north, in degrees."""
    pitch, azimuth = math.radians(pitch), math.radians(azimuth)
    return np.array(
        [math.sin(pitch) * math.sin(azimuth), math.sin(pitch) * math.cos(azimuth), -math.cos(pitch)]
    )


def fit_view(vertices: np.ndarray, options: argparse.Namespace) -> View:
    """The closest view with the given direction that shows all vertices.

    With right r, up u and depth d of a vertex seen from `middle`, it is visible when
    |r - r0| <= (distance + d) t, t the tangent of half the opening, and likewise for u: the two extreme
    vertices of each axis give the least distance. The tighter axis decides; then the picture is centred along
    both.
    """
    azimuth = math.radians(options.heading)
    right = np.array([math.cos(azimuth), -math.sin(azimuth), 0.0])
    ahead = view_direction(options.pitch, options.heading)
    above = np.cross(right, ahead)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    depth = (vertices - middle) @ ahead
    width, height = options.size
    half_up = math.tan(math.radians(FIELD_OF_VIEW / 2))
    axes = ((right, half_up * width / height), (above, half_up))
    distance = 0.0
    for axis, half in axes:
        across = (vertices - middle) @ axis
        high, low = np.max(across - depth * half), np.max(-across - depth * half)
        distance = max(distance, (high + low) / (2 * half))
    distance *= MARGIN
    centre = middle
    for axis, _ in axes:
        across, shift = (vertices - middle) @ axis, 0.0
        for _ in range(20):  # a contraction: the extremes change little with the shift
            seen = (across - shift) / (distance + depth)
            shift += distance * (seen.max() + seen.min()) / 2
        centre = centre + axis * shift
    return View(centre, distance / options.zoom, options.pitch, options.heading)


def surface_symbol(colour: str, *, edges: bool = True):
    from qgis import _3d as engine
    from qgis.PyQt.QtGui import QColor

    from scripts.styles.symbols import edged, surface_3d

    material = engine.QgsPhongMaterialSettings()
    material.setDiffuse(QColor(colour))
    material.setAmbient(QColor(colour).darker(190))
    material.setSpecular(QColor("black"))
    symbol = surface_3d(material)
    return edged(symbol) if edges else symbol


def style_models(layer) -> None:
    from qgis import _3d as engine

    rule = engine.QgsRuleBased3DRenderer.Rule
    root = rule(None)
    if layer.fields().indexOf("surface_type") >= 0:
        for kind, colour in SURFACE_COLOURS.items():
            root.appendChild(rule(surface_symbol(colour), f"\"surface_type\" = '{kind}'", kind))
        known = ", ".join(f"'{kind}'" for kind in SURFACE_COLOURS)
        other = f'"surface_type" IS NULL OR "surface_type" NOT IN ({known})'
        root.appendChild(rule(surface_symbol(OTHER_COLOUR), other, "other"))
    else:
        root.appendChild(rule(surface_symbol(OTHER_COLOUR), "", "all"))
    renderer = engine.QgsRuleBased3DRenderer(root)
    renderer.setLayer(layer)
    layer.setRenderer3D(renderer)


def ground_plane(layer, z: float):
    """A plate below the models, a little larger than they are, to take their shadows."""
    from qgis import _3d as engine
    from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer

    box = layer.extent()
    box.grow(0.05 * max(box.width(), box.height()))
    x0, y0, x1, y1 = box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()
    ring = ", ".join(f"{x} {y} {z}" for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)))
    plane = QgsVectorLayer("PolygonZ", "ground", "memory")
    plane.setCrs(layer.crs())
    feature = QgsFeature()
    feature.setGeometry(QgsGeometry.fromWkt(f"PolygonZ (({ring}))"))
    plane.dataProvider().addFeatures([feature])
    plane.updateExtents()
    renderer = engine.QgsVectorLayer3DRenderer(surface_symbol(GROUND_COLOUR, edges=False))
    renderer.setLayer(plane)
    plane.setRenderer3D(renderer)
    return plane


def scene_settings(layers: list, view: View):
    """Scene without terrain; shadows and the terrain type can be set only as XML from Python."""
    from qgis import _3d as engine
    from qgis.core import QgsProject, QgsReadWriteContext, QgsVector3D
    from qgis.PyQt.QtXml import QDomDocument

    x, y = view.centre[:2]
    extent = layers[0].extent()
    document = QDomDocument()
    document.setContent(
        f"""<qgis3d><origin x="{x}" y="{y}" z="0"/>
        <terrain terrain-rendering-enabled="0" exaggeration="1" texture-size="512" max-terrain-error="3"
                 max-ground-error="1" shading-enabled="0" elevation-offset="0"><generator type="flat">
          <extent xMin="{extent.xMinimum()}" xMax="{extent.xMaximum()}"
                  yMin="{extent.yMinimum()}" yMax="{extent.yMaximum()}"/></generator></terrain>
        <shadow-rendering shadow-rendering-enabled="1" selected-directional-light="0"
                 max-shadow-rendering-distance="{10 * view.distance}" shadow-bias="0.0001"
                 shadow-map-resolution="8192"/></qgis3d>"""
    )
    settings = engine.Qgs3DMapSettings()
    settings.readXml(document.documentElement(), QgsReadWriteContext())
    project = QgsProject.instance()
    settings.setCrs(layers[0].crs())
    settings.setTransformContext(project.transformContext())
    settings.setPathResolver(project.pathResolver())
    settings.setMapThemeCollection(project.mapThemeCollection())
    settings.setFieldOfView(FIELD_OF_VIEW)
    settings.setTerrainRenderingEnabled(False)
    if hasattr(settings, "setExtent"):  # QGIS 3.30 and later
        settings.setExtent(extent)
    settings.setLayers(layers)
    origin = settings.mapToWorldCoordinates(QgsVector3D(x, y, 0))
    turn = math.radians(view.azimuth)
    lights = []
    # The sun from behind the camera's left shoulder, and a weak light from the right without shadow.
    for across, ahead, down, intensity in ((0.7, 0.4, -1.0, 0.75), (-0.8, 0.5, -0.25, 0.22)):
        east = across * math.cos(turn) + ahead * math.sin(turn)
        north = ahead * math.cos(turn) - across * math.sin(turn)
        towards = settings.mapToWorldCoordinates(QgsVector3D(x + east, y + north, down))
        light = engine.QgsDirectionalLightSettings()
        light.setDirection(towards - origin)
        light.setIntensity(intensity)
        lights.append(light)
    if hasattr(settings, "setLightSources"):  # QGIS 3.26 and later
        settings.setLightSources(lights)
    else:
        settings.setPointLights([])
        settings.setDirectionalLights(lights)
    return settings


def render(settings, view: View, size: tuple[int, int]):
    """Draw through a print layout's 3D item, which waits until the whole scene is loaded."""
    from qgis import _3d as engine
    from qgis.core import (
        QgsLayoutExporter,
        QgsLayoutSize,
        QgsPrintLayout,
        QgsProject,
        QgsUnitTypes,
        QgsVector3D,
    )
    from qgis.PyQt.QtCore import QRectF, QSize, Qt
    from qgis.PyQt.QtGui import QColor

    pose = engine.QgsCameraPose()
    # QGIS casts shadows only between the camera and the point it turns about: put that point further away.
    far = view.centre + view_direction(view.pitch, view.azimuth) * view.distance * (SHADOW_REACH - 1)
    pose.setCenterPoint(settings.mapToWorldCoordinates(QgsVector3D(*far)))
    pose.setDistanceFromCenterPoint(view.distance * SHADOW_REACH)
    pose.setPitchAngle(view.pitch)
    pose.setHeadingAngle(-view.azimuth)
    width, height = (pixels * SUPERSAMPLING / PIXELS_PER_MM for pixels in size)
    layout = QgsPrintLayout(QgsProject.instance())
    layout.initializeDefaults()
    page = layout.pageCollection().page(0)
    page.setPageSize(QgsLayoutSize(width, height, QgsUnitTypes.LayoutMillimeters))
    item = engine.QgsLayoutItem3DMap(layout)
    layout.addLayoutItem(item)
    item.attemptSetSceneRect(QRectF(0, 0, width, height))
    item.setBackgroundColor(QColor(SKY_COLOUR))
    item.setMapSettings(settings)
    item.setCameraPose(pose)
    image = QgsLayoutExporter(layout).renderPageToImage(0, dpi=25.4 * PIXELS_PER_MM)
    return image.scaled(QSize(*size), Qt.IgnoreAspectRatio, Qt.SmoothTransformation)


def write_image(image, path: Path) -> None:
    """Write beside and move, so that a broken run leaves no half picture."""
    handle, name = tempfile.mkstemp(suffix=".png", dir=path.resolve().parent)
    os.close(handle)
    if image.isNull() or not image.save(name, "PNG"):
        os.unlink(name)
        sys.exit(f"The picture could not be written to {path}.")
    os.chmod(name, 0o644)
    os.replace(name, path)


def draw(layer, vertices: np.ndarray, foot: float | None, options: argparse.Namespace) -> None:
    """Render a layer to the picture of the options, over a plane at a height (m); without one where that is None."""
    from qgis.core import QgsProject

    view = fit_view(vertices, options)
    style_models(layer)
    layers = [layer] if foot is None else [layer, ground_plane(layer, foot)]
    QgsProject.instance().setCrs(layer.crs())
    QgsProject.instance().addMapLayers(layers)
    image = render(scene_settings(layers, view), view, tuple(options.size))
    write_image(image, options.output)
    print(f"{options.output}: {options.size[0]} x {options.size[1]} pixels, {layer.featureCount()} features")
    sys.stdout.flush()
    QgsProject.instance().clear()


def main() -> None:
    options = parse_arguments()
    ensure_screen()
    from qgis import _3d as engine
    from qgis.core import QgsApplication

    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    layer = open_layer(options.input, options.layer)
    vertices, ground = read_vertices(layer)
    draw(layer, vertices, None if options.no_ground else ground - 0.05, options)
    application.exitQgis()


if __name__ == "__main__":
    main()
