#!/usr/bin/env python3
"""Write the styles of layers, resources/styles/*.qml, with QGIS's own classes.

    python3 scripts/make_styles.py

Written by the oldest QGIS that the plugin supports (3.22), they are read by all later ones. Needs a Python that
sees QGIS.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from qgis import _3d as engine
from qgis.core import QgsApplication, QgsMapLayer, QgsRasterLayer, QgsVectorLayer

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.styles import buildings, positions, roads, surveys  # noqa: E402

STYLES = ROOT / "resources" / "styles"
FIELDS = positions.FIELDS | buildings.FIELDS | surveys.FIELDS | roads.FIELDS
RASTERS = (*roads.RASTERS, *positions.RASTERS)


def write(style) -> Path:
    """Write the style that a function gives to a layer; the file has its name."""
    geometry, fields = FIELDS[style]
    text = "&".join(f"field={field}" for field in fields.split())
    layer = QgsVectorLayer(f"{geometry}?crs=EPSG:6677&{text}", style.__name__, "memory")
    style(layer)
    return save(layer, style)


def write_raster_style(style) -> Path:
    """The same for a raster of one band."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pixel.asc"
        file.write_text("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n255\n", encoding="ascii")
        layer = QgsRasterLayer(str(file), style.__name__)
        style(layer)
        return save(layer, style)


def save(layer, style) -> Path:
    """Save the style of a layer under the name of the function that gave it."""
    path = STYLES / f"{style.__name__}.qml"
    categories = QgsMapLayer.StyleCategory
    message, written = layer.saveNamedStyle(
        str(path), categories.Symbology | categories.Symbology3D | categories.MapTips)
    if not written:
        sys.exit(f"{path}: {message}")
    return path


def main() -> None:
    """Write all styles."""
    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    for style in FIELDS:
        print(write(style).relative_to(STYLES.parent.parent))
    for style in RASTERS:
        print(write_raster_style(style).relative_to(STYLES.parent.parent))
    application.exitQgis()


if __name__ == "__main__":
    main()
