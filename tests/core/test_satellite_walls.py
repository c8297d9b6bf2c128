"""Edges that no survey saw from the street, moved by walls that satellites tell, each weighed by its sigma."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.merge_stage import edge_columns, merge_models, merged_columns
from urbanmap_qgis.buildings.merging.satellite_walls import SatelliteWall, satellite_walls, weighed
from urbanmap_qgis.buildings.merging.wall_match import measured_wall
from urbanmap_qgis.buildings.solids.plan_partition import Cell
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.solid import multipolygon
from urbanmap_qgis.settings.buildings import MergeSettings

BASE = 10.0


def block(x=0.0, width=20.0):
    return multipolygon(building_solids([Cell(shapely.box(x, 0.0, x + width, 12.0), 0, BASE + 15.0)], BASE))


def street(y=0.5, left=0.0, right=20.0):
    """The south front as measured from the street."""
    ring = [(left, y, 10.5), (right, y, 10.5), (right, y, 24.0), (left, y, 24.0)]
    return measured_wall(0, shapely.Polygon(ring), 0.01, 0.002)


def by_satellites(ends, sigma=0.3, status="adjusted"):
    return SatelliteWall(np.array(ends, float), sigma, status)


def merged(satellites, models=None, **settings):
    """Rows of the edges (dicts) and the buildings; the south front is always measured from the street."""
    models = models or [block()]
    found = merge_models(range(1, len(models) + 1), models, [street()], MergeSettings(**settings),
                         satellites=satellites)
    assert all(building.valid for building in found)
    columns = edge_columns(found)
    return [dict(zip(columns, row)) for row in zip(*columns.values())], found


NORTH = [(20.0, 12.6), (0.0, 12.6)]  # the building at the left: 0.6 m outside the north front


def of(rows, words):
    return next(row for row in rows if words in row["note"])


@pytest.mark.parametrize("sigma, model_sigma", [(0.3, 1.0), (0.3, 0.2), (0.5, 0.05), (0.2, 3.0)])
def test_a_weighed_wall_is_the_product_of_what_both_know(sigma, model_sigma):
    """Densities on a grid: what satellites say less the expected offset that it holds, times what the model says."""
    grid = np.linspace(-8.0, 8.0, 160_001)
    log = -0.5 * ((grid - 0.6) / sigma) ** 2 + 0.5 * grid**2 - 0.5 * (grid / model_sigma) ** 2
    density = np.exp(log - log.max())
    density /= density.sum()
    mean = float(density @ grid)
    offset, found = weighed(0.6, sigma, model_sigma)
    assert offset == pytest.approx(mean, abs=1e-6)
    assert found == pytest.approx(np.sqrt(density @ (grid - mean) ** 2), rel=1e-5)


def test_satellites_that_know_no_more_than_was_expected_move_nothing():
    assert weighed(0.6, 1.2, 0.5) == (0.0, pytest.approx(0.5))


@pytest.mark.parametrize("status", ["adjusted", "likely"])
def test_an_edge_that_nothing_was_measured_along_moves_and_says_by_what(status):
    rows, (building,) = merged([by_satellites(NORTH, 0.3, status)])
    row = of(rows, f"by satellites ({status}): +0.60 m, sigma 0.30 m")
    assert row["status"] == "moved" and row["offset"] == pytest.approx(0.6, abs=1e-9)
    assert row["sigma"] == pytest.approx(0.3, abs=1e-9) and row["wall"] is None and row["seen"] == 0.0
    front = next(row for row in rows if row["wall"] == 1)
    assert front["status"] == "moved" and front["note"] == ""
    assert sorted(row["status"] for row in rows) == ["moved", "moved", "not seen", "not seen"]
    bounds = shapely.total_bounds([edge.wall for edge in building.edges])
    assert bounds.tolist() == pytest.approx([0.0, 0.5, 20.0, 12.6], abs=0.011)
    columns = merged_columns([building])
    assert columns["measured"][0] == pytest.approx(20.0 / 64.0)


def test_a_wall_that_is_better_known_hardly_moves():
    rows, _ = merged([by_satellites(NORTH)], model_sigma=0.05)
    row = of(rows, "by satellites")
    assert row["offset"] == pytest.approx(0.6 * 0.3**-2 / (0.3**-2 - 1 + 0.05**-2)) and row["offset"] < 0.02
    assert row["sigma"] < 0.05


def test_what_was_measured_from_the_street_stays_and_a_contradiction_is_told():
    near, _ = merged([by_satellites([(0.0, 0.0), (20.0, 0.0)])])
    far, _ = merged([by_satellites([(0.0, -0.9), (20.0, -0.9)])])
    for rows in (near, far):
        assert next(row for row in rows if row["wall"] == 1)["offset"] == pytest.approx(-0.5, abs=1e-6)
    assert next(row for row in near if row["wall"] == 1)["note"] == ""
    assert "satellites put it 1.4 m outside of there" in next(row for row in far if row["wall"] == 1)["note"]


@pytest.mark.parametrize("ends", [
    [(0.0, 12.6), (20.0, 12.6)],  # faces the other way
    [(20.0, 12.6), (16.0, 12.6)],  # a fifth of the front
    [(20.0, 18.0), (0.0, 18.0)],  # of another building
    [(20.0, 12.2), (0.0, 14.9)],  # turned
])
def test_walls_that_are_not_of_the_edge_are_left(ends):
    rows, _ = merged([by_satellites(ends)])
    assert not any("satellites" in row["note"] for row in rows)


def test_a_wall_beyond_the_limit_or_in_the_neighbour_stays():
    rows, _ = merged([by_satellites([(20.0, 14.6), (0.0, 14.6)])])
    assert of(rows, "satellites put it 2.6 m outside")["status"] == "too far"
    east = [(20.6, 0.0), (20.6, 12.0)]
    rows, _ = merged([by_satellites(east)], [block(), block(20.2)])
    assert "neighbour" in {row["status"] for row in rows}


def test_only_walls_that_satellites_moved_are_read():
    line = shapely.LineString(NORTH)
    found = satellite_walls([line, line, line, None, line], np.array([0.2, 0.4, 0.3, 0.2, np.nan]),
                            ["adjusted", "likely", "not observable", "adjusted", "adjusted"])
    assert [(wall.sigma, wall.status) for wall in found] == [(0.2, "adjusted"), (0.4, "likely")]
    with pytest.raises(InputError, match="sigma greater than 0"):
        SatelliteWall(np.array(NORTH), float("nan"), "likely")
    with pytest.raises(InputError, match="Sigma of the models"):
        MergeSettings(model_sigma=0.0)
