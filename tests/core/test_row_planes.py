"""Roofs that go on across shared walls have one plane; a plane whose points disagree stays as it was."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings import polygon_stage
from urbanmap_qgis.buildings.planes.plane_moments import moments, shifted
from urbanmap_qgis.buildings.planes.plane_partition import PlanePoints, partition_planes
from urbanmap_qgis.buildings.roof_polygons.building_polygons import roof_polygons_or_block
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import RoofedBuilding
from urbanmap_qgis.buildings.roof_polygons.row_planes import HousePlanes, row_planes, touching_pairs
from urbanmap_qgis.settings.buildings import PLANES, PolygonParameters

PLACE = np.array([84_000.0, 447_000.0])
"""South-west corner of the row, m: as far from the origin as map coordinates are."""


def house(number, step, rng, apart=0.0):
    """Outline, points and planes of a gable house of a row of houses 6 m wide, `step` m higher than the row."""
    west = PLACE[0] + number * (6.0 + apart)
    xy = rng.uniform((west, PLACE[1]), (west + 6.0, PLACE[1] + 10.0), (400, 2))
    across = xy[:, 1] - PLACE[1] - 5.0
    z = 9.0 - 0.8 * np.abs(across) + step + rng.normal(0, 0.02, len(xy))
    outline = shapely.box(west, PLACE[1], west + 6.0, PLACE[1] + 10.0)
    return outline, np.column_stack([xy, z]), np.where(across < 0, 1, 2)


def heights_at_walls(steps, apart=0.0):
    """Heights (walls, 2 sides, 3) of each row's roofs at eaves, ridge and eaves of the walls between its houses."""
    rng = np.random.default_rng(4)
    row = [house(number, step, rng, apart) for number, step in enumerate(steps)]
    outlines = np.array([outline for outline, _, _ in row], object)
    given = row_planes([HousePlanes.of(*one) for one in row], outlines, touching_pairs(outlines))
    ends = []
    for (outline, points, roof), planes in zip(row, given):
        made = partition_planes(outline, points, roof, planes)
        corners = np.concatenate([shapely.get_coordinates(polygon, include_z=True) for polygon in made.polygons])
        west, south, east, _ = outline.bounds
        ends.append([[corners[np.hypot(*(corners[:, :2] - (x, south + y)).T) < 0.3, 2].mean() for y in (0, 5, 10)]
                     for x in (west, east)])
    ends = np.array(ends)
    return np.stack([ends[:-1, 1], ends[1:, 0]], axis=1)


def steps_at_walls(*row, **options):
    """Largest step (walls,) at eaves and ridge of the walls between houses, m."""
    sides = heights_at_walls(*row, **options)
    return np.abs(sides[:, 1] - sides[:, 0]).max(axis=1)


def test_houses_of_one_height_have_equal_eaves_and_ridges():
    assert steps_at_walls([0.0, 0.0, 0.0, 0.0]).max() < 1e-4
    assert steps_at_walls([0.0, 0.0, 0.0, 0.0], apart=1.0).min() > 1e-3  # no wall is shared: each is its own


def test_a_house_that_stands_higher_than_noise_keeps_its_step():
    low, high = steps_at_walls([0.0, 0.0, 0.25])
    assert low < 1e-4
    assert high == pytest.approx(0.25, abs=0.02)


def test_planes_that_a_row_moves_off_their_points_stay():
    """Of rising steps of 3 cm each, no house is moved by more than the laser's noise."""
    steps = np.arange(6) * 0.03
    ridges = heights_at_walls(steps.tolist())[:, :, 1]
    assert np.abs(ridges[:, 0] - 9.0 - steps[:-1]).max() < 0.03


def test_a_house_without_planes_stands_in_no_row():
    rng = np.random.default_rng(1)
    (one, points, roof), (two, _, _) = house(0, 0.0, rng), house(1, 0.0, rng)
    outlines = np.array([one, two], object)
    assert HousePlanes.of(two, points, np.zeros(len(points), int)) is None
    assert row_planes([HousePlanes.of(one, points, roof), None], outlines, touching_pairs(outlines)) == [None, None]


def test_a_house_that_fails_says_so_and_its_neighbours_stand_in_their_row(monkeypatch):
    rng = np.random.default_rng(1)
    row = [house(number, 0.0, rng) for number in range(3)]
    outlines = np.array([outline for outline, _, _ in row], object)
    records = [np.rec.fromarrays([*points.T, roof], names="x, y, z, roof_id") for _, points, roof in row]
    monkeypatch.setattr(polygon_stage, "coordinates", lambda _, some: (some["x"], some["y"], some["z"]))
    made = PlanePoints.of

    def of(outline, points, roof):
        if outline is outlines[2]:
            raise ValueError("no plane can be told")
        return made(outline, points, roof)

    monkeypatch.setattr(PlanePoints, "of", of)
    _, houses = polygon_stage._block_houses(polygon_stage.HouseBlock(None, np.arange(3), records, outlines))
    one, two, failed = row_planes(houses, outlines, touching_pairs(outlines))
    assert len(one) == len(two) == 2 and failed is None
    lone = RoofedBuilding(3, outlines[2], *row[2][1:])
    drawn = roof_polygons_or_block(lone, PolygonParameters(roofs=PLANES))
    assert drawn.status and all("no plane can be told" in status for status in drawn.status)


def test_moments_move_with_their_points():
    points = np.random.default_rng(2).uniform(0, 10, (50, 3))
    off = np.array([3.0, -7.0])
    moved = moments(np.add(points, [*off, 0.0]), np.zeros(50, int), 1)
    assert shifted(moments(points, np.zeros(50, int), 1), off) == pytest.approx(moved)
