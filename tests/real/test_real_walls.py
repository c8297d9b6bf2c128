"""Walls from a real vehicle's sweeps: two sweeps of one place must agree on them."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import find_walls
from urbanmap_qgis.io.points.pointcloud import open_cloud


@pytest.fixture(scope="module")
def sweeps(real_data):
    """Walls of each of two sweeps; as outlines are not known, everything in one box may be wall."""
    paths = sorted((real_data / "mobile" / "av2").glob("**/sweep_*.laz"))
    if len(paths) < 2:
        pytest.skip("the sweeps are not there")
    found = []
    for path in paths[:2]:
        cloud = open_cloud([path])
        plans = building_plans([shapely.box(*cloud.minimum[:2], *cloud.maximum[:2])], [1])
        found.append([wall for wall in find_walls(cloud, plans)[0] if wall.status != "few points"])
    return found


def test_two_sweeps_find_the_same_walls_in_the_same_place(sweeps):
    first, second = sweeps
    large = [wall for wall in first if wall.plane.points > 500]
    assert len(large) >= 6
    offsets, matched = [], 0
    for wall in large:
        best = np.inf
        for other in second:
            if wall.plane.normal @ other.plane.normal < 0.9995:
                continue
            if shapely.distance(wall.contour, other.contour) > 0.5:
                continue
            place = (wall.plane.point + other.plane.point) / 2
            gap = abs(wall.plane.distance(place[None])[0] - other.plane.distance(place[None])[0])
            best = min(best, gap)
        if best < 0.3:
            matched += 1
            offsets.append(best)
    assert matched >= 0.6 * len(large)
    assert np.median(offsets) < 0.03


def test_real_walls_are_upright_and_say_how_rough_they_are(sweeps):
    walls = sweeps[0] + sweeps[1]
    assert np.mean([abs(wall.plane.tilt) < 3 for wall in walls]) > 0.9
    assert 0.01 < np.median([wall.plane.rmse for wall in walls]) < 0.06
    assert all(0 < wall.plane.sigma < 0.05 for wall in walls if wall.plane.points > 500)
