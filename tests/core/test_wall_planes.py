"""Walls of made-up buildings: found, parted, turned outwards, whatever the outline says."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InputError
from urbanmap_qgis.facades.building_plans import outline_edges
from urbanmap_qgis.facades.wall_planes import wall_segments
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.facades import WallSettings

ORIGIN = np.array([-7000.0, -34000.0])


def facade(rng, start, end, low, high, density=40.0, noise=0.01):
    """Points on an upright wall between two places in plan."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.hypot(*(end - start))
    n = int(length * (high - low) * density)
    along = (end - start) / length
    normal = np.array([along[1], -along[0]])
    xy = start + rng.uniform(0, length, (n, 1)) * along + rng.normal(0, noise, (n, 1)) * normal
    return np.column_stack([xy + ORIGIN, rng.uniform(low, high, n)])


def segments_of(points, plan, **settings):
    ends, outward = outline_edges(shapely.transform(plan, lambda c: c + ORIGIN))
    return wall_segments(points, np.full(len(points), np.nan), ends, outward, WallSettings(**settings))


def azimuths(segments):
    return [round(np.degrees(np.arctan2(*segment.plane.normal[:2])) % 360.0) for segment in segments]


@pytest.mark.paper("J 5.7, segments")
def test_walls_of_a_recess_are_parted():
    """A front with a bay 0.8 m deep: planes 0.8 m apart, and of its narrow cheeks at least one."""
    rng = np.random.default_rng(1)
    walls = [((0, 0), (6, 0)), ((6, 0), (6, 0.8)), ((6, 0.8), (12, 0.8)), ((12, 0.8), (12, 0)), ((12, 0), (20, 0))]
    points = np.concatenate([facade(rng, *wall, 1, 15) for wall in walls])
    found = segments_of(points, shapely.box(0, 0, 20, 12))
    depth = sorted(round(float(s.plane.distance(np.array([*ORIGIN, 8.0])[None])[0]), 2)
                   for s in found if azimuths([s]) == [180])
    assert depth == pytest.approx([0.0, 0.0, 0.8], abs=0.01) or depth == pytest.approx([0.0, 0.8], abs=0.01)
    cheeks = [azimuth for azimuth in azimuths(found) if azimuth != 180]
    assert cheeks and all(min(abs(azimuth - 90), abs(azimuth - 270)) <= 2 for azimuth in cheeks)


def test_an_outline_that_is_off_and_turned_does_not_bind():
    rng = np.random.default_rng(2)
    points = np.concatenate([facade(rng, (0, 0), (20, 0), 0, 15), facade(rng, (20, 0), (20, 10), 0, 15)])
    outline = shapely.affinity.translate(shapely.affinity.rotate(shapely.box(0, 0, 20, 10), 4.0), 0.9, -0.7)
    found = segments_of(points, outline)
    assert azimuths(found) == [180, 90]
    for segment, axis, value in zip(found, (1, 0), (0.0, 20.0)):
        assert segment.plane.point[axis] - ORIGIN[axis] == pytest.approx(value, abs=0.003)
        assert segment.plane.rmse == pytest.approx(0.01, rel=0.1)


def test_walls_without_any_edge_of_the_outline_are_found():
    rng = np.random.default_rng(3)
    diagonal = facade(rng, (2, 2), (8, 8), 0, 12)
    found = segments_of(diagonal, shapely.box(0, 0, 20, 20))
    assert len(found) == 1 and azimuths(found)[0] in (135, 315)


def test_a_round_tower_gives_facets_all_round():
    rng = np.random.default_rng(4)
    turn = np.linspace(0, 2 * np.pi, 25)
    corners = 9.0 * np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([facade(rng, a, b, 0, 15) for a, b in zip(corners[:-1], corners[1:])])
    found = segments_of(points, shapely.Polygon(corners))
    covered = np.concatenate([segment.points for segment in found])
    assert len(np.unique(covered)) / len(points) > 0.9
    for segment in found:
        radial = segment.plane.point[:2] - ORIGIN
        assert radial @ segment.plane.normal[:2] > 0, "outwards"


def test_ground_foliage_and_a_car_make_no_walls():
    rng = np.random.default_rng(5)
    ground = np.column_stack([rng.uniform(0, 20, 8000), rng.uniform(-2, 0, 8000), rng.normal(0, 0.01, 8000)])
    leaves = rng.uniform([5, -2, 3], [9, -0.2, 6], (3000, 3))
    points = np.concatenate([ground, leaves])
    points[:, :2] += ORIGIN
    assert segments_of(points, shapely.box(0, 0, 20, 10)) == []


def test_walls_on_one_plane_far_apart_are_two():
    rng = np.random.default_rng(6)
    points = np.concatenate([facade(rng, (0, 0), (6, 0), 0, 10), facade(rng, (11, 0), (20, 0), 0, 10)])
    assert len(segments_of(points, shapely.box(0, 0, 20, 10))) == 2
    assert len(segments_of(points, shapely.box(0, 0, 20, 10), max_gap=8.0)) == 1


def test_edges_of_a_building_of_two_parts_are_those_of_both():
    apart = shapely.multipolygons([shapely.box(0, 0, 5, 5), shapely.box(8, 0, 12, 5)])
    ends, outward = outline_edges(apart)
    assert len(ends) == 8 and sorted(set(ends[:, :, 0].ravel())) == [0, 5, 8, 12]
    middle = ends.mean(axis=1)
    assert not shapely.contains_xy(apart, *(middle + 0.1 * outward).T).any()
    assert shapely.contains_xy(apart, *(middle - 0.1 * outward).T).all()


def test_nothing_from_nothing():
    ends, outward = outline_edges(shapely.box(0, 0, 5, 5))
    assert wall_segments(np.zeros((0, 3)), np.zeros(0), ends, outward) == []
    assert wall_segments(np.random.default_rng(1).random((12, 3)), np.zeros(12), ends, outward) == []


def test_cancelling_and_bad_settings():
    rng = np.random.default_rng(7)
    points = facade(rng, (0, 0), (20, 0), 0, 15)
    ends, outward = outline_edges(shapely.transform(shapely.box(0, 0, 20, 10), lambda c: c + ORIGIN))
    with pytest.raises(Cancelled):
        wall_segments(points, np.zeros(len(points)), ends, outward, progress=Progress(cancelled=lambda: True))
    with pytest.raises(InputError):
        WallSettings(tolerance=0)
