"""A cast of colour that varies over an image."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings.colour_cast import colour_cast_of
from urbanmap_qgis.aerial.markings.marking_files import levels_of_orthophoto, markings_from_orthophoto
from urbanmap_qgis.aerial.markings.road_markings import LevelAdjustment


def ground(warmth, random, soil=0.0):
    """Rows of a field of warmth(x, y) with so much of another colour."""
    x, y = random.uniform(0, 300, (2, 20_000))
    colour = warmth(x, y) + random.normal(0, 0.02, len(x))
    colour[random.random(len(x)) < soil] += 0.25
    return np.column_stack([np.full(len(x), 2.0), colour, random.normal(0, 0.01, len(x)), x, y])


def test_a_turning_cast_is_found_in_spite_of_soil():
    random = np.random.default_rng(1)
    cast = colour_cast_of(ground(lambda x, y: 0.001 * (x - 150), random, soil=0.25), 3.0)
    warmth, green = cast.evaluated(np.array([0.0, 150.0, 300.0]), np.array([150.0, 150.0, 150.0]))
    assert np.ptp(warmth) == pytest.approx(0.3, abs=0.02) and warmth[2] > warmth[0]
    assert np.abs(green).max() == 0


def test_one_colour_and_patches_are_no_cast():
    random = np.random.default_rng(2)
    assert colour_cast_of(ground(lambda x, y: np.full_like(x, -0.1), random, soil=0.3), 3.0) is None
    assert colour_cast_of(ground(lambda x, y: 0.15 * ((x // 60 + y // 60) % 2), random), 3.0) is None
    assert colour_cast_of(ground(lambda x, y: 0.001 * x, random)[:100], 3.0) is None


@pytest.fixture
def image(tmp_path):
    """Grey ground with lines, warm in the east and cold in the west."""
    random = np.random.default_rng(3)
    grey = np.full((900, 1500), 90.0)
    grey[200:203, 20:1480] = grey[600:603, 20:1480] = 220
    grey += random.normal(0, 2, grey.shape)
    warm = np.linspace(-0.15, 0.15, 1500)
    bands = np.clip(np.stack([grey * (1 + warm), grey, grey * (1 - warm)]), 1, 255)
    path = tmp_path / "cast.tif"
    with rasterio.open(path, "w", driver="GTiff", width=1500, height=900, count=3, dtype="uint8", crs="EPSG:6677",
                       transform=Affine(0.1, 0, 500, 0, -0.1, 900), photometric="RGB") as target:
        target.write(np.rint(bands).astype(np.uint8))
    return path


@pytest.mark.slow
def test_lines_are_found_at_both_ends(image, tmp_path):
    levels = levels_of_orthophoto(image)
    assert levels.cast is not None
    assert LevelAdjustment.of_text(levels.text) == levels
    for tile in (2560, 512):
        markings_from_orthophoto(image, tmp_path / f"{tile}.tif", tile=tile)
    with rasterio.open(tmp_path / "2560.tif") as one, rasterio.open(tmp_path / "512.tif") as other:
        mask = one.read(1) > 0
        assert (mask == (other.read(1) > 0)).all()
    assert mask[200:203, 20:1480].mean() > 0.95 and mask[600:603, 20:1480].mean() > 0.95


def test_bands_come_back_to_one_colour(image):
    levels = levels_of_orthophoto(image)
    with rasterio.open(image) as source:
        bands = source.read()
    x, y = 500 + 0.1 * (np.arange(1500)[None] + 0.5), 900 - 0.1 * (np.arange(900)[:, None] + 0.5)
    made = levels.cast.removed(bands, x, y)
    assert made.dtype == bands.dtype
    red, _green, blue = np.median(made[:, 300:500], axis=1)
    assert np.ptp(red - blue) < 6 and np.ptp(bands[0, 400] - 1.0 * bands[2, 400]) > 20
