"""Edges of roads and worn lines in an orthophoto, on streets drawn here."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from urbanmap_qgis.roadmap.map_records import DrivenPath, MapLine
from urbanmap_qgis.roadmap.photo.photo_lines import lines_with_photo
from urbanmap_qgis.roadmap.photo.straight_photo import ColourImage
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings

PIXEL, LENGTH, NORTH = 0.1, 60.0, 40.0
RIGHT = MapSettings(traffic="right")


def line(y, kind="solid"):
    x = np.arange(0.0, LENGTH + 0.1, 1.0)
    return MapLine(np.column_stack([x, np.full(len(x), y), np.full(len(x), 5.0)]), kind, "white", sigma=0.02)


@pytest.fixture
def street(tmp_path):
    """Function that draws a street from y = -10 to `kerb` with paint, and opens its image."""
    images = []

    def draw(kerb=8.7, dashes=(), contrast=12.0, vehicles=(), bands=3):
        rng = np.random.default_rng(20261127)
        y = NORTH - PIXEL * (np.arange(int(2 * NORTH / PIXEL)) + 0.5)
        x = PIXEL * (np.arange(int(LENGTH / PIXEL)) + 0.5)
        grey = np.array([100.0, 102.0, 105.0])
        image = np.where(((y < kerb) & (y > -10.0))[:, None, None], grey, [175.0, 165.0, 150.0])
        image = np.broadcast_to(image, (len(y), len(x), 3)).copy()
        for place in dashes:
            image[np.ix_(np.abs(y - place) < 0.08, x % 6.0 < 2.0)] += contrast
        for first, last in vehicles:
            image[np.ix_((y > kerb - 2.0) & (y < kerb - 0.2), (x > first) & (x < last))] = 235.0
        image += rng.normal(0.0, 3.0, image.shape)
        path = tmp_path / f"street{len(images)}.tif"
        with rasterio.open(path, "w", driver="GTiff", width=len(x), height=len(y), count=bands, dtype="uint8",
                           transform=Affine(PIXEL, 0, 0, 0, -PIXEL, NORTH), crs="EPSG:6677") as target:
            target.write(np.moveaxis(np.clip(image, 0, 255).astype(np.uint8), 2, 0)[:bands])
        images.append(ColourImage(path))
        return images[-1]

    yield draw
    for image in images:
        image.__exit__()


def added(lines, image):
    """Lines that the image adds, those that it takes away, and the findings on both."""
    found, findings = lines_with_photo(lines, (), image, RIGHT)
    kept, given = {id(one) for one in found}, {id(one) for one in lines}
    return ([one for one in found if id(one) not in given], [one for one in lines if id(one) not in kept], findings)


@pytest.mark.parametrize("bands", [3, 1])
def test_kerb_is_found_where_the_surface_ends_also_behind_parked_vehicles(street, bands):
    lines = [line(0.0), line(3.3), line(-9.7)]
    (edge,), _, findings = added(lines, street(vehicles=[(10, 14.5), (16, 20.5), (40, 44.5)], bands=bands))
    assert edge.kind == "road border" and edge.sigma == pytest.approx(0.1)
    assert np.abs(edge.points[:, 1] - 8.7).max() < 0.2 and np.ptp(edge.points[:, 0]) > 50.0
    assert (edge.points[:, 2] == 5.0).all()
    assert [one.kind for one in findings] == ["edge from the image"]


def test_edge_bounds_the_outer_lane_and_says_so(street):
    """5.4 m between line and kerb: wider than lanes between lines may be."""
    lines, drive = [line(3.3), line(0.0), line(-9.7)], DrivenPath(np.array([[x, 6.0, 5.0] for x in range(60, 0, -1)]))
    with_edge, _ = lines_with_photo(lines, (), street(), RIGHT)
    assert not any(lane.kind == "lane" for lane in build_vector_map(lines, (), [drive], RIGHT).lanes)
    built = build_vector_map(with_edge, (), [drive], RIGHT)
    assert [round(lane.width, 1) for lane in built.lanes if lane.kind == "lane"] == [pytest.approx(5.4, abs=0.11)]
    assert "5.4 m wide" in next(one.text for one in built.findings if one.kind == "wide lane")


def test_no_edge_without_another_surface_and_none_where_a_line_lies(street):
    assert not added([line(0.0), line(3.3), line(-9.7)], street(kerb=39.0))[0]
    assert not added([line(0.0), line(3.3), line(8.6), line(-9.7)], street())[0]


def test_worn_dashes_are_found_where_the_width_of_the_lanes_asks_for_them(street):
    lines = [line(6.6), line(0.0), line(-3.3), line(-9.7), line(8.6)]
    (worn,), _, findings = added(lines, street(dashes=[3.3]))
    assert worn.kind == "dashed" and worn.confidence < 0.6
    assert np.abs(worn.points[:, 1] - 3.3).max() < 0.15
    assert [one.kind for one in findings] == ["faint line"]
    assert not added(lines, street())[0]
    assert not added(lines, street(dashes=[1.7]))[0]  # too near to a line for a lane


def test_lines_beyond_the_edge_of_the_road_are_left_out(street):
    paving = line(9.7)
    _, gone, _ = added([line(0.0), line(4.3), paving, line(-9.7)], street())
    assert len(gone) == 1 and gone[0] is paving


def test_short_sections_and_places_without_image_stay_as_they_are(street):
    far = [MapLine(one.points + np.array([5000.0, 0.0, 0.0]), one.kind, "white") for one in (line(0.0), line(3.3))]
    assert added(far, street()) == ([], [], [])
    short = [MapLine(one.points[:11], one.kind, "white") for one in (line(0.0), line(3.3))]
    assert added(short, street()) == ([], [], [])
