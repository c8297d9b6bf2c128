"""Correlation of shifts, and the best way through them."""

import itertools
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import shapely
from shapely import affinity

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.mobile.lines.surface_corners import raster_corners
from urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold, plain_marking_points
from urbanmap_qgis.mobile.registration.start.correlation_start import (
    CELL,
    ScoreImage,
    alternative_spread,
    best_path,
    centred,
    peaks,
    score_image,
    shift_scores,
)
from urbanmap_qgis.mobile.registration.start.reference import Coverage


def test_scores_of_shifts_are_the_sums_of_what_points_fall_on():
    rng = np.random.default_rng(4)
    image = ScoreImage(-20, -30, rng.uniform(0, 1, (60, 50)).astype(np.float32))
    reach = 5
    for count in (4, 400):  # few far apart, and many
        x, y = rng.uniform(-4.5, 6.5, count), rng.uniform(-6.5, 6.5, count)
        weight = rng.uniform(0.2, 1, count)
        scores = shift_scores(x, y, weight, image, reach)
        for north, east in ((0, 0), (-5, 3), (4, -2), (5, 5)):
            column = np.floor(x / CELL).astype(int) + east + 20
            row = np.floor(-y / CELL).astype(int) - north + 30
            inside = (column >= 0) & (column < 50) & (row >= 0) & (row < 60)
            plain = (image.score[row[inside], column[inside]] * weight[inside]).sum()
            assert np.isclose(scores[north + reach, east + reach], plain, rtol=1e-4, atol=1e-4)


def test_points_far_from_the_reference_score_nothing():
    image = ScoreImage(0, 0, np.ones((10, 10), np.float32))
    assert not shift_scores(np.array([500.0]), np.array([500.0]), np.ones(1), image, 3).any()


def test_score_image_lies_where_the_coverage_is():
    share = np.zeros((100, 120), dtype=np.float32)
    share[40, 70] = 1.0
    grid = Grid(1000.03, 2000.07, 0.1, 100, 120)
    image = score_image(Coverage(grid, share), 0.05)
    row, column = np.unravel_index(image.score.argmax(), image.score.shape)
    assert abs((image.left + column + 0.5) * CELL - (1000.03 + 7.05)) <= CELL / 2
    assert abs(-(image.top + row + 0.5) * CELL - (2000.07 - 4.05)) <= CELL / 2


def test_best_way_is_the_best_of_all_ways():
    rng = np.random.default_rng(8)
    scores = rng.uniform(0, 3, (4, 3, 3)).astype(np.float32)
    wander = np.array([0.02, 0.03, 0.02])  # two cells from block to block at most
    chainage = best_path(scores, wander, 2.5)
    offsets = np.array(list(itertools.product((-1, 0, 1), (-1, 0, 1))))  # north, east

    def value(states):
        total = sum(scores[k, offsets[s, 0] + 1, offsets[s, 1] + 1] for k, s in enumerate(states))
        total -= ((offsets[states[0]] * CELL) ** 2).sum() / (2 * 2.5 ** 2)
        for k in range(3):
            steps = offsets[states[k + 1]] - offsets[states[k]]
            total -= (steps ** 2).sum() * CELL ** 2 / (2 * wander[k])
        return total

    ways = list(itertools.product(range(9), repeat=4))
    values = np.array([value(states) for states in ways])
    best = ways[int(values.argmax())]
    assert [tuple(offsets[s]) for s in best] == [tuple(shift[::-1]) for shift in chainage.shift]
    for block in range(4):
        for state in range(9):
            through = max(v for v, states in zip(values, ways) if states[block] == state)
            deficit = chainage.deficit[block, offsets[state, 0] + 1, offsets[state, 1] + 1]
            assert np.isclose(deficit, values.max() - through, atol=1e-3)


def test_a_long_wait_lets_the_error_jump():
    scores = np.zeros((2, 21, 21), dtype=np.float32)
    scores[0, 10, 10] = scores[1, 10, 16] = 30.0  # 1.2 m further east after the wait
    stiff, free = best_path(scores, np.array([0.005]), 10.0), best_path(scores, np.array([0.4]), 10.0)
    assert tuple(free.shift[1]) == (6, 0) and tuple(free.shift[0]) == (0, 0)
    assert abs(stiff.shift[1, 0] - stiff.shift[0, 0]) <= 1


def test_equal_places_widen_the_spread_and_one_place_does_not():
    one = np.zeros((1, 41, 41), dtype=np.float32)
    one[0, 20, 20] = 40.0
    two = one.copy()
    two[0, 20, 30] = 40.0
    alone, both = (alternative_spread(best_path(s, np.zeros(0), 10.0), 0.5)[0] for s in (one, two))
    assert alone.max() < 1e-6
    assert np.isclose(both[0, 0], 0.5 * 2.0 ** 2, rtol=0.05) and both[1, 1] < 1e-3


def test_centred_and_peaks():
    scores = np.zeros((1, 11, 11), dtype=np.float32)
    scores[0, 7, 3] = 5.0  # two north, two west
    scores[0, 7, 8] = 4.0
    about = centred(scores, np.array([[-2, 2]]))
    assert about[0, 5, 5] == 5.0
    places, heights = peaks(about[0], 3, 2)
    assert tuple(places[0]) == (5, 0) and heights[0] == 4.0


@pytest.mark.parametrize("y_max", [40.0, -400.0])
def test_the_image_of_scores_covers_the_reference(y_max):
    grid = Grid(30.0, y_max, 0.1, 200, 100)
    share = np.zeros(grid.shape, np.float32)
    share[50:60, 20:30] = 1.0
    image = score_image(SimpleNamespace(grid=grid, share=share), 0.1)
    assert image.score.shape == (round(20.0 / CELL), round(10.0 / CELL))
    row, column = np.unravel_index(image.score.argmax(), image.score.shape)
    assert -(image.top + row + 0.5) * CELL == pytest.approx(y_max - 5.5, abs=0.4)
    assert (image.left + column + 0.5) * CELL == pytest.approx(32.5, abs=0.4)


# The paper's threshold of the survey's intensities, held against OpenCV's own on an image made plainly


@pytest.fixture(scope="module")
def road():
    """Points (n, 2) on a road, their brightness (asphalt: 1) and which lie on paint."""
    rng = np.random.default_rng(5)
    at = rng.uniform([-7000.0, -34000.0], [-6980.0, -33988.0], (40_000, 2))
    paint = (np.abs(at[:, 1] + 33994.0) < 0.1) | ((np.abs(at[:, 0] + 6990.0) < 0.25) & (at[:, 1] < -33995))
    return at, np.where(paint, 3.5, 1.0) * rng.lognormal(0, 0.1, len(at)), paint


@pytest.mark.paper("J 3.2.3.3")
def test_the_threshold_is_opencvs_of_21_pixels_and_c_17(road):
    at, brightness, paint = road
    answer = plain_marking_points(*at.T, brightness, 4.0)
    column, row = (np.floor(at / 0.12).astype(int) - np.floor(at.min(axis=0) / 0.12).astype(int) + 30).T
    size = row.max() + 31, column.max() + 31
    image = np.full(size, round(255 / 4.0), np.uint8)
    for r, c in set(zip(row, column)):
        here = (row == r) & (column == c)
        image[r, c] = round(min(brightness[here].mean() * 255 / 4.0, 255))
    plain = cv2.adaptiveThreshold(image, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, 21, -17)
    assert np.mean(answer.paint == (plain[row, column] > 0)) > 0.9999
    assert answer.paint[paint].mean() > 0.8 and answer.paint[~paint].mean() < 0.05
    assert (answer.weight == answer.paint).all() and np.isfinite(answer.contrast[answer.paint]).all()


def test_a_cut_of_the_road_changes_nothing_inside(road):
    at, brightness, _ = road
    settings = PlainThreshold()
    whole = plain_marking_points(*at.T, brightness, 4.0, settings).paint
    near = at[:, 0] < -6990 + settings.reach
    assert (plain_marking_points(*at[near].T, brightness[near], 4.0, settings).paint[at[near, 0] < -6990]
            == whole[at[:, 0] < -6990]).all()


@pytest.mark.paper("J 3.3.3, Table 3-2")
def test_the_block_is_21_pixels_and_nonsense_is_refused():
    assert PlainThreshold().block_pixels == 21 and PlainThreshold(1.2).block_pixels % 2 == 1
    for bad in ({"block_size": 0.1}, {"c": 0.0}):
        with pytest.raises(InputError):
            PlainThreshold(**bad)
    assert not len(plain_marking_points(*np.zeros((3, 0)), 4.0).paint)


# Corners of buildings in made surface rasters, against the corners that were drawn


def surface(plan, cell, height=6.0, noise=0.1, slope=0.03, seed=1, size=60.0):
    """Heights of a plan raised by `height` on a slope: a cell is raised where most of it lies in the plan."""
    count, fine = int(size / cell), 4
    place = (np.arange(count * fine) + 0.5) * cell / fine
    inside = shapely.contains_xy(plan, *np.meshgrid(place, place)).reshape(count, fine, count, fine).mean(axis=(1, 3))
    ground = 10 + slope * np.arange(count)[:, None] * cell
    return ground + (inside > 0.5) * height + np.random.default_rng(seed).normal(0, noise, (count, count))


def nearest(found, plan):
    """Distance (n,) of corners found to the nearest true one."""
    true = shapely.get_coordinates(plan.exterior)[:-1]
    return np.hypot(*(found[:, None] - true).transpose(2, 0, 1)).min(axis=1)


@pytest.mark.parametrize(("cell", "mean", "most"), [(0.25, 0.06, 0.2), (0.5, 0.15, 0.5), (1.0, 0.5, 1.4)])
def test_corners_of_turned_boxes(cell, mean, most):
    rng, distances = np.random.default_rng(8), []
    for seed in range(8):
        plan = affinity.rotate(shapely.box(30, 30, 30 + rng.uniform(9, 22), 30 + rng.uniform(9, 18)),
                               rng.uniform(0, 90), origin="centroid")
        plan = affinity.translate(plan, *(30 - np.array(plan.centroid.coords[0])))
        corners = raster_corners(surface(plan, cell, seed=seed), cell)
        distances += nearest(corners.place * cell, plan).tolist()
        # Edges run from the corner along the walls.
        for place, edges in zip(corners.place * cell, corners.edge):
            for edge in edges:
                assert plan.exterior.distance(shapely.Point(place + 3 * edge)) < most
    assert len(distances) >= 28 and np.mean(distances) < mean and np.max(distances) < most


def test_a_wide_hall_and_its_court():
    plan = shapely.box(5, 5, 55, 55).difference(shapely.box(20, 20, 40, 40))
    corners = raster_corners(surface(plan, 0.5), 0.5)
    true = np.vstack([shapely.get_coordinates(ring)[:-1] for ring in (plan.exterior, *plan.interiors)])
    away = np.hypot(*(corners.place[:, None] * 0.5 - true).transpose(2, 0, 1))
    assert len(corners.place) == 8 and (away.min(axis=0) < 0.3).all()


def test_low_things_rough_ground_and_nothing_have_none():
    assert not len(raster_corners(surface(shapely.box(20, 20, 35, 35), 0.5, height=1.5), 0.5).place)
    assert not len(raster_corners(surface(shapely.box(70, 70, 71, 71), 0.5, slope=0.2), 0.5).place)
    assert not len(raster_corners(np.full((50, 50), np.nan), 0.5).place)


def test_a_gap_in_the_surface_is_no_edge():
    heights = surface(shapely.box(15, 15, 45, 45), 0.5)
    heights[:, 50:70] = np.nan  # through the middle of the building
    corners = raster_corners(heights, 0.5)
    assert len(corners.place) == 4 and nearest(corners.place * 0.5, shapely.box(15, 15, 45, 45)).max() < 0.3
