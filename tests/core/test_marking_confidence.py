"""Confidence of markings: asphalt, grass, roofs and wide paint drawn with known places."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import MarkingSettings
from urbanmap_qgis.aerial.markings.road_model import clear_of_paint, texture

PIXEL = 0.1


def scene(seed=2):
    """(rows, columns, 3): asphalt on the left, earth and grass on the right, all with lines of the same brightness."""
    rng = np.random.default_rng(seed)
    image = np.full((400, 600, 3), 95.0)
    image[:200, 300:] = (120, 112, 92)
    image[200:, 300:] = (95, 100, 80)
    image[200:, 300:] += cv2.GaussianBlur(rng.normal(0, 60, (200, 300)), (0, 0), 1.2)[..., None]
    for left in (60, 360):
        for top in (60, 260):
            image[top:top + 40, left:left + 2] = 215
    image = cv2.GaussianBlur(image, (0, 0), 0.6) + rng.normal(0, 1.5, image.shape)
    return np.clip(image, 0, 255).astype(np.uint8)


def found_in(tmp_path, image, area=None, **rules):
    path = tmp_path / "o.tif"
    with rasterio.open(path, "w", driver="GTiff", width=image.shape[1], height=image.shape[0], count=3, dtype="uint8",
                       crs="EPSG:6677", transform=Affine(PIXEL, 0, 0, 0, -PIXEL, 0)) as out:
        out.write(np.moveaxis(image, -1, 0))
    settings = MarkingSettings(cleaning=CleanSettings(**rules))
    made = markings_from_orthophoto(path, tmp_path / "m.tif", area, settings)
    with rasterio.open(tmp_path / "m.tif") as source:
        return made, source.read(1) > 0


def test_paint_on_asphalt_stays_and_stripes_on_grass_and_earth_go(tmp_path):
    image = scene()
    _, every = found_in(tmp_path, image, min_confidence=0.0)
    made, mask = found_in(tmp_path, image)
    assert every[60:100, 360:362].mean() > 0.8 and every[:, 310:].sum() > 500
    assert mask[60:100, 60:62].mean() > 0.9 and mask[260:300, 60:62].mean() > 0.9
    assert mask[:, 310:].sum() < 0.05 * every[:, 310:].sum()
    assert len(made.polygons) and (made.polygons.confidence > 0.4).all() and (made.polygons.confidence <= 1).all()


def hard(image, seed=4):
    """A scene with ground as rough as in hard light."""
    rough = image + np.random.default_rng(seed).normal(0, 6, image.shape[:2])[..., None]
    return np.clip(rough, 0, 255).astype(np.uint8)


def test_ground_as_rough_as_in_hard_light_is_searched_too(tmp_path):
    _, mask = found_in(tmp_path, hard(scene()))
    assert mask[60:100, 60:62].mean() > 0.8 and mask[260:300, 60:62].mean() > 0.8


def test_what_is_doubtful_alone(tmp_path):
    """What is below a confidence and what is not are all that is above the lower one."""
    (_, all_found), (_, sure), (made, doubtful) = (found_in(tmp_path, hard(scene()), **rules) for rules in (
        {"min_confidence": 0.05}, {"min_confidence": 0.5}, {"min_confidence": 0.05, "below": 0.5}))
    assert doubtful.any() and sure.any() and (made.polygons.confidence < 0.5).all()
    assert (sure | doubtful)[all_found].mean() > 0.97


def test_roads_are_searched_in_hard_light(tmp_path):
    made, _ = found_in(tmp_path, hard(scene()), SearchArea(roads=[shapely.box(0, -40, 30, 0)]))
    assert len(made.polygons) and (made.polygons.confidence > 0.4).all()


def test_known_roads_need_no_proof(tmp_path):
    _, mask = found_in(tmp_path, scene(), SearchArea(roads=[shapely.box(30.5, -20.0, 60.0, 0.0)]))
    assert mask[60:100, 360:362].mean() > 0.8


def test_texture_is_the_noise_of_plain_ground():
    rng = np.random.default_rng(0)
    image = rng.normal(100, 3, (200, 200)).astype(np.float32)
    clear = clear_of_paint(np.zeros(image.shape, bool), np.ones(image.shape, bool), PIXEL)
    assert np.median(texture(image, clear.astype(np.float32), PIXEL)) == pytest.approx(3.0, rel=0.05)
    assert np.isinf(texture(image, np.zeros_like(image), PIXEL)).all()
