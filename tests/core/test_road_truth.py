"""True areas of the sample city's roads, against areas reckoned from its streets."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.samplecity.truth.road_surfaces import REACH, true_carriageway, true_junctions


def test_carriageways_and_junctions_are_those_of_the_streets():
    scene = make_scene(120.0, "canyon", 3)
    streets, long = scene.ground.streets, scene.size + 2.0 * REACH
    crossings = [(one, other) for one in streets if one.along == "u" for other in streets if other.along == "v"]
    plain = sum(2.0 * street.half_width * long for street in streets)
    plain -= sum(4.0 * one.half_width * other.half_width for one, other in crossings)
    plain -= shapely.union_all(list(scene.ground.islands)).area
    road = true_carriageway(scene)
    rounded = road.area - plain  # corners of kerbs that are rounded off
    assert 0.0 <= rounded < 0.05 * plain
    junctions = true_junctions(scene)
    assert len(junctions) == len(crossings) > 0
    for shape, (one, other) in zip(junctions, crossings):
        centre = scene.ground.plan_to_world(shapely.Point(other.at, one.at))
        assert shape.within(road.buffer(1e-6)) and shape.area > 4.0 * one.half_width * other.half_width * 0.9
        assert np.hypot(*np.subtract(shape.centroid.coords[0], centre.coords[0])) == pytest.approx(0.0, abs=1.0)
