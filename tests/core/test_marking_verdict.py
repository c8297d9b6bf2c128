"""The verdict on road markings, from what was taken and rejected and from the result itself."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings.marking_evidence import SearchTally, evidence_of_light
from urbanmap_qgis.aerial.markings.marking_files import MarkingResult, markings_from_orthophoto
from urbanmap_qgis.aerial.markings.marking_polygons import MarkingPolygons
from urbanmap_qgis.aerial.markings.marking_verdict import marking_verdict
from urbanmap_qgis.aerial.markings.road_model import RoadModel
from urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report

USUAL = SearchTally(seen=10 ** 6, narrow=10 ** 5, painted=50_000, likely=60_000.0, sure=45_000.0, green=20_000)


def marks(count=8, width=0.2, confidence=0.9, contrast=80.0):
    boxes = np.array([shapely.box(10 * k, 5, 10 * k + 3, 5 + width) for k in range(count)], object)
    full = np.full(count, 1.0)
    return MarkingPolygons(boxes, full * 3 * width, full * 3, full * width, full * contrast,
                           np.full(count, "white", object), full * confidence)


@pytest.fixture
def found():
    return MarkingResult(marks(), 0.12, 1e4, 5.0, RoadModel(2.0, 0.0, 0.0, 90.0), USUAL)


def test_a_usual_result_is_good(found):
    assert marking_verdict(found).grade == GOOD
    assert marking_verdict(found).reasons == ()


@pytest.mark.parametrize(("change", "grade", "words"), [
    ({"likely": 450_000.0}, BAD, "only 10% of the paint was found"),
    ({"sure": 30_000.0, "likely": 50_000.0}, LOOK, "60% of the found area is paint"),
    ({"likely": 150_000.0}, LOOK, "30% of the paint was found"),
    ({"full": 500_000}, BAD, "50% of it are over-exposed"),
    ({"full": 200_000}, LOOK, "20% of the image are over-exposed"),
    ({"empty": 100_000}, LOOK, "10% of the image are black"),
    ({"colourless": 10 ** 6}, LOOK, "has no colours"),
    ({"green": 99}, LOOK, "Nothing in the image is green"),
    ({"pale": 300_000}, LOOK, "30% of the image are nearly white"),
])
def test_each_sign_of_the_image(found, change, grade, words):
    made = marking_verdict(replace(found, evidence=replace(USUAL, **change)))
    assert made.grade == grade
    assert len(made.reasons) == 1 and words in made.reasons[0]


def test_lines_out_of_focus_show(found):
    made = marking_verdict(replace(found, polygons=marks(width=0.45)))
    assert made.grade == LOOK
    assert len(made.reasons) == 1 and "Lines are 0.45 m wide" in made.reasons[0]


@pytest.mark.parametrize(("spacing", "grade"), [(1.6, LOOK), (3.2, GOOD), (6.4, LOOK)])
def test_lanes_are_as_wide_as_lanes(found, spacing, grade):
    boxes = np.array([shapely.box(0, spacing * k, 40, spacing * k + 0.15) for k in range(3)], object)
    full = np.ones(3)
    lines = MarkingPolygons(boxes, 6 * full, 40 * full, 0.15 * full, 80 * full, np.full(3, "white", object), 0.9 * full)
    made = marking_verdict(replace(found, polygons=lines))
    assert made.grade == grade
    assert grade == GOOD or f"Neighbouring lines lie {spacing} m apart" in made.reasons[0]


@pytest.mark.parametrize("level, grade", [(None, GOOD), (1.2, GOOD), (1.3, LOOK)])
def test_ground_may_be_too_light_for_paint(found, level, grade):
    made = marking_verdict(replace(found, paint_level=level))
    assert made.grade == grade
    assert grade == GOOD or "so light" in made.reasons[0]


def test_no_marking_is_no_result(found):
    made = marking_verdict(replace(found, polygons=marks(0)))
    assert made.grade == BAD and "No marking was found" in made.reasons[0]


def test_light_is_counted_where_ground_is_seen():
    bands = np.full((3, 4, 5), 90, np.uint8)
    bands[:, 0] = 0
    bands[0, 1] = 255
    bands[:, 2, 3:] = 195
    bands[1, 3, 1:3] = 96, 95
    bands[1, 0, 0] = 200
    seen = np.ones((4, 5), bool)
    seen[:, 0] = False
    made = evidence_of_light(bands, seen, 255)
    assert (made.seen, made.empty, made.full, made.colourless, made.pale, made.green) == (16, 4, 4, 10, 2, 1)


def test_a_dark_image_is_told(tmp_path):
    """The same street with a crossing by day and in a noisy night."""
    random = np.random.default_rng(2)
    day = np.full((3, 400, 600), 90.0)
    day[:, 20:40, 20:40] = np.reshape((60, 90, 50), (3, 1, 1))
    for row in range(100, 190, 9):
        day[:, row:row + 3, 300:340] = 220
    night = np.clip(day * 0.08 + random.normal(0, 4, day.shape), 0, 255)
    day += random.normal(0, 1, day.shape)
    grades = {}
    for name, image in (("day", day), ("night", night)):
        with rasterio.open(tmp_path / f"{name}.tif", "w", driver="GTiff", width=600, height=400, count=3, dtype="uint8",
                           crs="EPSG:6677", transform=Affine(0.1, 0, 0, 0, -0.1, 0), photometric="RGB") as target:
            target.write(np.rint(image).astype(np.uint8))
        result = markings_from_orthophoto(tmp_path / f"{name}.tif", tmp_path / "mask.tif")
        grades[name] = marking_verdict(result).grade
    assert grades == {"day": GOOD, "night": BAD}


def test_a_report_may_do_nothing_but_show_itself(tmp_path):
    report = Report("<script>alert(1)</script>")
    report.verdict(GOOD, '<img src="https://example.org/x">')
    report.table(("a",), [("<script>1</script>",)])
    report.write(tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text).group(1)
    assert text.index("Content-Security-Policy") < text.index("<title>")
    assert policy.split("; ") == ["default-src 'none'", "style-src 'unsafe-inline'", "img-src data:"]
    body = text.split("</style>", 1)[1]
    assert not re.search(r"<script|\son\w+=|javascript:|src=\"(?!data:)", body)
