"""Small steps with known answers: where ground is counted beside a path, what a mirror shows, where a turn runs."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.gnss.rays.tracing import _between
from urbanmap_qgis.roadmap.edges.edge_courses import _densities
from urbanmap_qgis.roadmap.lanes.junctions import about_curve


@pytest.mark.parametrize("aside", [-3.5, 0.0, 3.5])
def test_ground_is_counted_on_the_path_and_on_either_side(aside):
    """Twenty points a square metre on one strip alone: below the car, or 3.5 m to its left or right."""
    path = np.column_stack([np.arange(0.0, 40.0), np.zeros(40)])
    rng = np.random.default_rng(4)
    points = {"x": rng.uniform(-5.0, 45.0, 1000), "y": aside + rng.uniform(-0.5, 0.5, 1000)}
    tile = SimpleNamespace(points=points, owns=lambda places: np.ones(len(places), bool))
    found = _densities(tile, np.ones(1000, bool), SimpleNamespace(path=path))
    assert len(found) == 10 and np.mean(found) == pytest.approx(20.0, abs=6.0)


def test_a_wall_shows_the_rays_of_its_length_and_margin():
    """A wall of 4 m seen from 5 m before its middle; its mirror image sees 2 m and the margin to either side."""
    walls = SimpleNamespace(normal=np.array([[0.0, 1.0]]), offset=np.array([0.0]), start=np.array([[-2.0, 0.0]]),
                            end=np.array([[2.0, 0.0]]))
    at = np.array([-2.7, -2.3, -1.0, 0.0, 1.0, 2.3, 2.7])  # where rays of the image cross the wall's line
    azimuth = np.concatenate([np.arctan2(at, 5.0) % (2 * np.pi) + turn for turn in (0.0, 2 * np.pi)])  # a turn on, too
    order = np.argsort(azimuth)
    rays, pieces = _between(walls, np.array([[0.0, 5.0]]), np.array([0]), np.array([0]), np.array([[1.0, 0.0]]), 0.5,
                            azimuth[order], order % len(at))
    assert sorted(rays.tolist()) == [1, 2, 3, 4, 5] and (pieces == 0).all()


def test_a_turn_leaves_and_enters_in_the_lanes_directions():
    """Lanes that were bent before, but end and begin along one line: the way between them is that line."""
    before = np.array([[-20.0, 9.0, 1], [-12.0, 4.0, 1], [-6.0, 1.0, 1], [-3.0, 0.0, 1], [0.0, 0.0, 1.0]])
    after = np.array([[20.0, 0.0, 1], [23.0, 0.0, 1], [30.0, 6.0, 1.0]])
    sides = {"left": 1.5, "right": -1.5}
    built = SimpleNamespace(
        lanes=[SimpleNamespace(centre=before), SimpleNamespace(centre=after)],
        coordinates=lambda lane, side: (before, after)[lane] + np.array([0.0, sides[side], 0.0]))
    for points, aside in zip(about_curve(built, 0, 1), (1.5, -1.5)):
        assert points[:, 1] == pytest.approx(aside) and (np.diff(points[:, 0]) > 0).all()
        assert 0.0 < points[0, 0] < points[-1, 0] < 20.0
