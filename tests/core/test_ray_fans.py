"""Fans of rays meet the walls that rays followed one by one meet; a scan's rows are the layers that end together."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.gnss.rays.ray_fans import FanObstacles, RayFan
from urbanmap_qgis.gnss.rays.tracing import WallObstacles
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.localisation_settings import VehicleScanner
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas
from urbanmap_qgis.localisation.walls.wall_scan import AZIMUTHS, LAYERS, scan_walls

LENGTH = 60.0


def town(seed: int):
    """Turned houses of all heights, some of them over others, a few without a foot, and a sloping parapet."""
    rng = np.random.default_rng(seed)
    shapes, top, low = [], [], []
    for x in range(-80, 80, 14):
        for y in range(-80, 80, 14):
            box = shapely.box(x, y, x + rng.uniform(4, 10), y + rng.uniform(4, 10))
            shapes.append(shapely.affinity.rotate(box, rng.uniform(0, 90)))
            top.append(rng.uniform(1, 15))
            low.append(rng.choice([0.0, np.nan, 6.0]))
    outlines = building_walls(np.array(shapes, object), None, np.array(top) + np.nan_to_num(low), np.array(low))
    raised = outlines.top + np.column_stack([np.zeros(len(outlines)), rng.uniform(0, 3, len(outlines))])
    return outlines.__class__(**{**outlines.__dict__, "top": raised})


def marched(walls, place: np.ndarray, fan: RayFan):
    """What `FanObstacles.first_hits` returns, by rays followed one by one."""
    angle = np.arange(fan.azimuths) * 2 * np.pi / fan.azimuths
    round_, up = np.meshgrid(angle, fan.elevation, indexing="ij")
    direction = np.stack([np.cos(up) * np.sin(round_), np.cos(up) * np.cos(round_), np.sin(up)], axis=2).reshape(-1, 3)
    piece, distance = WallObstacles.of(walls).first_hit(
        np.repeat(place, len(direction), axis=0), np.tile(direction, (len(place), 1)), fan.length)
    shape = (len(place), fan.azimuths, len(fan.elevation))
    return piece.reshape(shape), distance.reshape(shape) * np.cos(fan.elevation)


@pytest.mark.parametrize("seed", [1, 2])
def test_fans_meet_what_single_rays_meet(seed):
    walls = town(seed)
    rng = np.random.default_rng(seed)
    # In courts and streets, inside of houses, above the roofs, and far outside.
    place = np.column_stack([rng.uniform(-90, 90, (300, 2)), rng.uniform(0, 20, 300)])
    place = np.concatenate([place, [[500.0, 0.0, 2.0], [-110.0, 3.0, 2.0]]])
    fan = RayFan(97, np.radians([-15.0, -3.0, 0.0, 7.0, 30.0]), LENGTH)
    piece, distance = FanObstacles.of(walls).first_hits(place, fan)
    expected_piece, expected = marched(walls, place, fan)
    assert np.array_equal(piece, expected_piece)
    assert (piece >= 0).mean() > 0.3 and (piece[300] == -1).all()
    assert distance[piece >= 0] == pytest.approx(expected[piece >= 0], rel=1e-9)
    assert np.isinf(distance[piece < 0]).all()


def test_blocks_of_places_change_nothing(monkeypatch):
    walls, place = town(3), np.random.default_rng(3).uniform(0, 10, (40, 3))
    fan = RayFan(60, np.zeros(1), LENGTH)
    at_once = FanObstacles.of(walls).first_hits(place, fan)
    monkeypatch.setattr("urbanmap_qgis.gnss.rays.ray_fans._TESTED", 1)
    one_by_one = FanObstacles.of(walls).first_hits(place, fan)
    assert all(np.array_equal(one, other) for one, other in zip(at_once, one_by_one))


def test_a_row_of_a_scan_holds_the_layers_that_end_on_one_piece():
    pieces = town(4)
    walls, scanner = WallMap.of(pieces, wall_sigmas(pieces, 0.2)), VehicleScanner("multi-layer")
    sensor = np.random.default_rng(4).uniform(-60, 60, (20, 3)) * [1, 1, 0] + [0, 0, 2.0]
    scan = scan_walls(walls, sensor, scanner)
    piece, distance = marched(pieces, sensor, RayFan(AZIMUTHS, scanner.elevations(LAYERS), scanner.max_range))
    row, layer = np.nonzero(scan.layers)
    assert len(row) == (piece >= 0).sum() > len(scan.of) > 1000
    assert np.array_equal(piece[scan.of[row], scan.ray[row], layer], scan.piece[row])
    assert np.hypot(*scan.offset[row].T) == pytest.approx(distance[scan.of[row], scan.ray[row], layer], rel=1e-9)
    assert scan.distance[row, layer] == pytest.approx(
        np.hypot(*scan.offset[row].T) / np.cos(scanner.elevations(LAYERS))[layer], rel=1e-12)
    # 16 layers of 720 rays, of which 5 of 240 are followed.
    assert scan.weight == pytest.approx(scan.layers.sum(axis=1) * 16 * 720 / (5 * 240))
    assert (np.diff(scan.of) >= 0).all()
