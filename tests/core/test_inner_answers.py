"""Steps inside stages, by known answers of their own: what later steps would make up for, or tolerances hide."""

from __future__ import annotations

from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.markings import marking_report
from urbanmap_qgis.aerial.markings.marking_confidence import GroundBeside
from urbanmap_qgis.aerial.markings.marking_pieces import MarkingPieces, PieceImage, piece_figures
from urbanmap_qgis.aerial.markings.road_model import RoadModel
from urbanmap_qgis.aerial.markings.surroundings import cells_of, figures_at
from urbanmap_qgis.gnss.walls.offset_posterior import _rival
from urbanmap_qgis.io.conversion.geoid import _whole_seconds
from urbanmap_qgis.io.points.point_buckets import PointBuckets
from urbanmap_qgis.roadmap.lanes.right_of_way import LANES, STOP_LINE, WIDTH, _minor, _Road
from urbanmap_qgis.roadmap.objects.object_records import POLE, TREE, Stem
from urbanmap_qgis.roadmap.objects.street_objects import _doubt

PIXEL = 0.12


def test_a_rival_is_what_lies_beyond_the_valleys_on_both_sides():
    density = np.array([[0.0, 0.4, 0.2, 0.05, 0.2, 0.15], [0.1, 0.2, 0.05, 0.1, 0.4, 0.15],
                        [0.1, 0.2, 0.4, 0.2, 0.1, 0.0]])
    assert _rival(density) == pytest.approx([0.35, 0.3, 0.0])


def stripe(turned=False):
    """A stripe 0.36 m wide in the middle of even ground, upright or (`turned`) lying: image, narrow pixels, ground."""
    image = np.full((420, 420), 90, np.float32)
    image[:, 209:212] = 200
    clear = np.ones(image.shape, np.uint8)
    clear[:, 207:214] = 0
    image, clear = (np.ascontiguousarray(part.T if turned else part) for part in (image, clear))
    return image, image == 200, GroundBeside(clear, clear, clear, np.where(clear, image, 100).astype(np.float32), None)


def around(image, narrow, ground):
    bands = np.repeat(image.astype(np.uint8)[None], 3, axis=0)
    cells = cells_of(bands, image, narrow, ground, PIXEL, 1.0)
    return {name: float(value[0]) for name, value in figures_at(
        np.array([70]), np.array([70]), cells, RoadModel(brightness=100.0), PIXEL, 10.0).items()}


def test_surroundings_do_not_hang_on_the_way_a_stroke_runs():
    upright, lying = around(*stripe()), around(*stripe(turned=True))
    assert upright["firm"] == pytest.approx(1.0, abs=0.01) and upright["inline"] > 0.95 > 0.1 > upright["beside_both"]
    assert lying == pytest.approx(upright, abs=1e-6)


def test_the_colour_of_a_piece_is_told_against_the_road():
    """Red 120, green 100, blue 80: a fifth of 100 warmer on each side, and no green."""
    image, narrow, ground = stripe()
    bands = np.stack([np.full(image.shape, value, np.uint8) for value in (120, 100, 80)])
    places = np.flatnonzero(narrow)
    none = np.zeros(len(places))
    pieces = MarkingPieces(places, none.astype(int), np.array([len(places)]), np.array([50.0]), np.array([True]))
    seen = PieceImage(bands, image, narrow, ground, RoadModel(brightness=100.0, warmth=0.1, green=0.02), 1.0, 10.0)
    values = piece_figures(seen, places, none + 3.0, none + 0.5, pieces, none.astype(int), PIXEL).values
    assert values["pwarm"] == pytest.approx(0.3, abs=1e-3) and values["pgreen"] == pytest.approx(-0.02, abs=1e-3)
    assert values["warmer"] == pytest.approx(0.0, abs=1e-3) and values["paint"] == pytest.approx(2.0)
    assert values["relief"] == pytest.approx(3.0) and values["rules"] == pytest.approx(0.5)


@pytest.mark.parametrize(("one", "other", "waits", "goes"), [
    (_Road(1, 3.0, 2, 0), _Road(2, 6.0, 2, 0), LANES, ""), (_Road(1, 3.0, 2, 0), _Road(1, 6.0, 2, 0), WIDTH, ""),
    (_Road(2, 6.0, 2, 2), _Road(1, 3.0, 2, 0), STOP_LINE, ""), (_Road(1, 3.0, 2, 0), _Road(1, 3.0, 2, 0), "", ""),
    (_Road(1, 3.0, 2, 1), _Road(1, 3.0, 2, 0), "", "")])
def test_the_minor_road_is_told_by_stop_lines_then_lanes_then_width(one, other, waits, goes):
    assert (_minor(one, other), _minor(other, one)) == (waits, goes)


@pytest.mark.parametrize(("kind", "filled", "crowd", "wall", "word"), [
    (POLE, 0.9, 0.0, 0, ""), (POLE, 0.5, 0.0, 0, "its stem is seen in parts"), (TREE, 0.5, 0.0, 0, ""),
    (TREE, 0.9, 0.0, 0, ""), (POLE, 0.9, 1.5, 0, "other things stand close beside it"), (TREE, 0.9, 1.5, 0, ""),
    (POLE, 0.9, 0.0, 40, "it may be a part of a wall")])
def test_why_a_stem_is_doubtful(kind, filled, crowd, wall, word):
    assert _doubt(Stem(np.arange(100), 0.3, 4.0, filled), kind, crowd, wall) == word


def test_a_part_of_an_image_is_drawn_smaller_by_the_factor(tmp_path):
    with rasterio.open(tmp_path / "a.tif", "w", driver="GTiff", width=200, height=120, count=3, dtype="uint8",
                       transform=Affine(0.1, 0, 0, 0, -0.1, 12)) as target:
        target.write(np.full((3, 120, 200), 100, np.uint8))
    found = SimpleNamespace(polygons=SimpleNamespace(polygons=np.array([shapely.box(5, 5, 7, 6)], object)))
    with rasterio.open(tmp_path / "a.tif") as source:
        picture = marking_report._drawn(source, tmp_path / "a.tif", (20, 0, 160, 80), 4.0, found)
    assert cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_COLOR).shape == (20, 40, 3)


@pytest.mark.parametrize(("step", "whole"), [(0.016667, 60.0), (0.0166, 59.76), (0.02500001, 90.0), (1e-7, 3.6e-4)])
def test_a_step_with_cut_decimals_is_the_whole_second_beside_it(step, whole):
    """A hundredth of a second away it is a step of its own, and a step is never 0."""
    assert _whole_seconds(step) * 3600 == pytest.approx(whole, rel=1e-6)


def test_records_that_come_in_order_are_not_copied():
    records = np.zeros(6, [("x", "<f8")])
    with PointBuckets(records.dtype) as buckets:
        assert buckets.add(np.array([1, 1, 4, 4, 4, 9]), records) == {1: 2, 4: 3, 9: 1}
        assert all(np.shares_memory(piece, records) for pieces in buckets._pieces.values() for piece in pieces)
        assert buckets.add(np.array([4, 1]), records[:2]) == {1: 1, 4: 1} and len(buckets.read(4)) == 4
