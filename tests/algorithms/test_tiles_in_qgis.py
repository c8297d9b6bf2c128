"""A tileset opens in QGIS 3.34 and later, in its place, and is drawn."""

from __future__ import annotations

import pytest

from tests.city_models import PLACE, town
from urbanmap_qgis.citymodel.tiles.tiles_writer import write_tiles


def test_tiles_open_in_qgis(qgis_app, tmp_path):
    from qgis.core import (
        Qgis,
        QgsCoordinateReferenceSystem,
        QgsCoordinateTransform,
        QgsMapRendererSequentialJob,
        QgsMapSettings,
        QgsProject,
        QgsRectangle,
    )
    from qgis.PyQt.QtCore import QSize
    from qgis.PyQt.QtGui import QColor

    if Qgis.QGIS_VERSION_INT < 33400:
        pytest.skip("this QGIS has no tiled scenes")
    from qgis.core import QgsTiledSceneLayer

    write_tiles(tmp_path / "tiles", town())
    layer = QgsTiledSceneLayer(f"url={(tmp_path / 'tiles' / 'tileset.json').as_uri()}", "tiles", "cesiumtiles")
    assert layer.isValid(), layer.error().message()
    plane = QgsCoordinateReferenceSystem("EPSG:6677")
    there = QgsCoordinateTransform(layer.crs(), plane, QgsProject.instance()).transformBoundingBox(layer.extent())
    # The extent is that of the boxes round the tiles, which may be wider than the buildings.
    assert there.contains(QgsRectangle(PLACE[0] + 1, PLACE[1] + 1, PLACE[0] + 47, PLACE[1] + 41))
    assert there.width() < 200 and there.height() < 200
    settings = QgsMapSettings()
    settings.setLayers([layer])
    settings.setDestinationCrs(plane)
    settings.setTransformContext(QgsProject.instance().transformContext())
    settings.setBackgroundColor(QColor("white"))
    settings.setOutputSize(QSize(240, 240))
    settings.setExtent(QgsRectangle(PLACE[0] - 6, PLACE[1] - 9, PLACE[0] + 54, PLACE[1] + 51))
    job = QgsMapRendererSequentialJob(settings)
    job.start()
    job.waitForFinished()
    image = job.renderedImage()

    def drawn(x, y):
        """Whether a place of the town (m) is not white."""
        return image.pixelColor(int((x + 6) * 4), int((51 - y) * 4)) != QColor("white")

    assert drawn(4, 5) and drawn(24, 5) and drawn(44, 5) and drawn(2, 36)
    assert not drawn(14, 5) and not drawn(6, 36) and not drawn(30, 30)  # between them, and in the court
