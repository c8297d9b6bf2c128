#!/usr/bin/env python3
"""Render a road model with what stands beside it to a picture with QGIS's own 3D engine.

    python3 scripts/render_street.py road_areas.gpkg road_steps.gpkg furniture.gpkg street.png --reach 40 --heading 30

AREAS and STEPS are layers of `roadmodel`, FURNITURE the objects that `loadcitymodel` reads from the CityGML of
`streetobjects`. Needs what `render_models.py` needs.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from scripts import render_models as models

COLOURS = {"carriageway": "#9a9a9a", "junction": "#e8b27c", "lane": "#8fb9c9", "sidewalk": "#c9d3bd",
           "island": "#8fae86", "step": "#6f6f6f", "furniture": "#b5482f", "tree": "#5d8f4c"}


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    for name in ("areas", "steps", "furniture"):
        parser.add_argument(name, type=Path)
    parser.add_argument("output", type=Path, help="picture to write (.png)")
    parser.add_argument("--size", type=int, nargs=2, default=(1440, 760), help="pixels")
    parser.add_argument("--centre", type=float, nargs=2, help="x and y, m; the middle of the areas by default")
    parser.add_argument("--reach", type=float, default=1000.0, help="metres about the centre that are shown")
    parser.add_argument("--pitch", type=float, default=62.0, help="0 looks straight down, 90 to the horizon")
    parser.add_argument("--heading", type=float, default=30.0, help="view direction, clockwise from north")
    parser.add_argument("--zoom", type=float, default=1.0, help="above 1: closer than showing everything")
    return parser.parse_args()


def features_of(path: Path, name: str | None = None) -> list:
    """Features of the first layer of a file, or of the named one."""
    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(f"{path}|layername={name}" if name else str(path), path.stem, "ogr")
    if not layer.isValid():
        sys.exit(f"{path} cannot be opened.")
    return list(layer.getFeatures())


def step_face(line):
    """The upright face below the upper edge of a step."""
    from qgis.core import QgsGeometry

    points = [(point.x(), point.y(), point.z()) for point in line.geometry().vertices()]
    low = [(x, y, z - line["height"]) for x, y, z in points]
    ring = [*points, *reversed(low), points[0]]
    return QgsGeometry.fromWkt(f"PolygonZ (({', '.join(' '.join(map(str, corner)) for corner in ring)}))")


def street_layer(options: argparse.Namespace):
    """All surfaces within reach as one layer with their kind."""
    from qgis.core import QgsFeature, QgsGeometry, QgsPointXY, QgsVectorLayer

    areas = features_of(options.areas)
    shown = [(feature["kind"], feature.geometry()) for feature in areas]
    shown += [("step", step_face(feature)) for feature in features_of(options.steps)]
    shown += [(feature["kind"], feature.geometry()) for feature in features_of(options.furniture)]
    extent = QgsGeometry.unaryUnion([feature.geometry() for feature in areas]).boundingBox()
    centre = QgsPointXY(*options.centre) if options.centre else extent.center()
    # What is shown is not cut: an area that reaches beyond would lose its heights.
    near = QgsGeometry.fromPointXY(centre).buffer(options.reach, 16)
    layer = QgsVectorLayer("MultiPolygonZ?field=surface_type:string", "street", "memory")
    made = []
    for kind, shape in shown:
        if kind in COLOURS and not shape.isNull() and near.intersects(shape):
            feature = QgsFeature(layer.fields())
            shape.convertToMultiType()
            feature.setGeometry(shape)
            feature["surface_type"] = kind
            made.append(feature)
    layer.dataProvider().addFeatures(made)
    layer.updateExtents()
    return layer


def main() -> None:
    options = parse_arguments()
    models.ensure_screen(Path(__file__))
    models.SURFACE_COLOURS.update(COLOURS)
    from qgis import _3d as engine
    from qgis.core import QgsApplication, QgsCoordinateReferenceSystem, QgsVectorLayer

    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    layer = street_layer(options)
    crs = QgsVectorLayer(str(options.areas), "areas", "ogr").crs()
    layer.setCrs(crs if crs.isValid() else QgsCoordinateReferenceSystem("EPSG:6677"))
    vertices, _ = models.read_vertices(layer)
    models.draw(layer, vertices, float(np.nanmin(vertices[:, 2])) - 0.5, options)
    application.exitQgis()


if __name__ == "__main__":
    main()
