"""The report on road markings: figures, doubts and pictures."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import from_origin

from urbanmap_qgis.aerial.markings.marking_files import MarkingResult
from urbanmap_qgis.aerial.markings.marking_polygons import MarkingPolygons
from urbanmap_qgis.aerial.markings.marking_report import (
    OrthophotoQuality,
    PairShift,
    frame_count_shares,
    quality_warnings,
    standing_notes,
    write_marking_report,
)

SURE = OrthophotoQuality([PairShift("a.tif", "b.tif", 0.01, 0.0, 0.004, 50, "agree")], [0.2, 0.05, 0.25, 0.5], True,
                         17.0)


@pytest.fixture
def found():
    boxes = np.array([shapely.box(10 * k, 5, 10 * k + 3, 5.2) for k in range(4)], object)
    colours = np.array(["white", "white", "white", "yellow"], object)
    polygons = MarkingPolygons(boxes, np.full(4, 0.6), np.full(4, 3.0), np.full(4, 0.2), np.full(4, 80.0), colours,
                               np.full(4, 0.9))
    return MarkingResult(polygons, 0.12, 500.0, 2.4)


@pytest.fixture
def orthophoto(tmp_path):
    path = tmp_path / "正射.tif"
    image = np.full((3, 400, 500), 90, np.uint8)
    with rasterio.open(path, "w", driver="GTiff", width=500, height=400, count=3, dtype="uint8", crs="EPSG:6677",
                       transform=from_origin(-5, 30, 0.12, 0.12)) as target:
        target.write(image)
    return path


def test_nothing_to_doubt(found):
    assert quality_warnings(found, SURE) == []


@pytest.mark.parametrize(("change", "words"), [
    ({"pairs": [PairShift("a.tif", "b.tif", 0.3, -0.4, 0.01, 9, "apart")]}, "a.tif and b.tif lie 0.50 m apart"),
    ({"pairs": []}, "a wrong orientation would not show"),
    ({"views": [0.5, 0.25, 0.15, 0.1]}, "50% of the ground in the image is seen by one frame only"),
])
def test_each_doubt_is_told(found, change, words):
    [doubt] = quality_warnings(found, replace(SURE, **change))
    assert words in doubt


@pytest.mark.parametrize(("change", "words"), [
    ({"roads": False}, "No roads were given"),
    ({"contrast": 70.0}, "100% of the markings hardly stand out"),
])
def test_what_holds_of_any_image_is_a_note(found, change, words):
    assert standing_notes(found, SURE) == []
    [note] = standing_notes(found, replace(SURE, **change))
    assert words in note


def test_coarse_pixels_are_told(found):
    assert any("0.30 m" in doubt for doubt in quality_warnings(replace(found, pixel=0.3), SURE))


def test_an_empty_result_is_told(found, orthophoto, tmp_path):
    empty = np.zeros(0)
    none = MarkingPolygons(np.zeros(0, object), empty, empty, empty, empty, np.zeros(0, object), empty)
    nothing = replace(found, polygons=none, marked_area=0.0)
    write_marking_report(tmp_path / "r.html", orthophoto, nothing, replace(SURE, pairs=None, views=None))
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "No marking was found" in page and page.count("data:image/png") == 1


def test_the_page_holds_figures_and_pictures(found, orthophoto, tmp_path):
    write_marking_report(tmp_path / "r.html", orthophoto, found, SURE, "A note & more.")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert re.search(r"<th>Markings</th><td[^>]*>4</td>", page)
    assert re.search(r"of these yellow</th><td[^>]*>1</td>", page)
    assert "A note &amp; more." in page and "contrast" in page
    assert page.count("data:image/png") == 2 and "frame_01" not in page
    assert re.search(r"a\.tif</td><td>b\.tif</td>", page)


def test_shares_of_views(tmp_path):
    counts = np.array([[0, 0, 1, 2], [3, 4, 7, 1]], np.uint8)
    with rasterio.open(tmp_path / "n.tif", "w", driver="GTiff", width=4, height=2, count=1, dtype="uint8",
                       transform=from_origin(0, 0, 1, 1)) as target:
        target.write(counts, 1)
    assert frame_count_shares(tmp_path / "n.tif") == [0.25, 0.25, 0.125, 0.375]
