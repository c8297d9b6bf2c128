"""A tileset opens in CesiumJS, in a headless browser: every building with its attributes, at its height."""

import struct
import zlib

import pytest

from tests.city_models import town
from tests.gui.cesium import cesium_folder, chromium, shown
from urbanmap_qgis.citymodel.tiles.tiles_writer import write_tiles

pytestmark = pytest.mark.once


def red_image():
    """A PNG of 4 by 4 red pixels."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = (b"\0" + b"\xe0\x20\x20" * 4) * 4
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def test_tiles_open_in_cesium(tmp_path):
    if chromium() is None:
        pytest.skip("there is no Chromium here")
    cesium = cesium_folder()
    if cesium is None:
        pytest.skip("CesiumJS is not here: set CESIUM to the unpacked npm package, or install npm")
    picture = tmp_path / "wall.png"
    picture.write_bytes(red_image())
    write_tiles(tmp_path / "out", town(images={"textures/wall.png": picture}))
    seen = shown(tmp_path / "out", cesium, view=0.7)
    assert "error" not in seen and not seen["failed"]
    detailed = {values["id"]: values for name, values in seen["features"].items() if "details" in name}
    assert set(detailed) == {"家 1", "b2", "b4"}
    assert detailed["家 1"]["roof_max"] == 7.0 and detailed["家 1"]["points"] == 7
    assert detailed["家 1"]["note"] == 'a < b & "c"' and detailed["b2"].get("rmse") is None
    assert seen["height"] == pytest.approx(23.5, abs=0.5)
    assert len(seen["picture"]) > 3000

