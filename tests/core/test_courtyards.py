"""Courtyards that an outline leaves out."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines.courtyards import with_courtyards
from urbanmap_qgis.buildings.outlines.decks import ground_without_decks

BLOCK = shapely.box(0, 0, 24, 24)
COURT = shapely.box(8, 6, 17, 16)


def points(density=8.0, court=COURT, seed=1):
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-5, 29, (2, int(34 * 34 * density)))
    low = ~shapely.contains_xy(BLOCK, x, y) | shapely.contains_xy(court, x, y)
    return x, y, low


def cut(x, y, low, density=8.0):
    return with_courtyards(np.array([BLOCK, None], dtype=object), x, y, low, density)


@pytest.mark.parametrize("density", [2.0, 8.0, 20.0])
def test_a_courtyard_is_cut_out_at_its_walls(density):
    made = cut(*points(density), density)
    assert made[1] is None and len(made[0].interiors) == 1
    hole = shapely.Polygon(made[0].interiors[0])
    assert hole.intersection(COURT).area / hole.union(COURT).area > (0.75 if density < 5 else 0.9)


def test_trees_in_a_courtyard_do_not_close_it():
    x, y, low = points()
    crown = np.hypot(x - 12, y - 11) < 2.5
    low &= ~(crown & (np.random.default_rng(2).random(len(x)) < 0.5))
    hole = shapely.Polygon(cut(x, y, low)[0].interiors[0])
    assert hole.intersection(COURT).area / hole.union(COURT).area > 0.85


@pytest.mark.parametrize("court", [shapely.Polygon(), shapely.box(10, 10, 13, 13), shapely.box(4, 12, 20, 13.2),
                                   shapely.box(0, 0, 24, 1.4)], ids=["none", "small", "narrow", "at the outline"])
def test_roofs_skylights_gaps_and_inexact_outlines_make_no_courtyard(court):
    assert cut(*points(court=court))[0].equals(BLOCK)


def test_turning_the_scene_turns_the_courtyard():
    x, y, low = points()
    turned = shapely.affinity.rotate(shapely.MultiPoint(np.column_stack([x, y])), 30, origin=(0, 0))
    places = shapely.get_coordinates(turned)
    block = np.array([shapely.affinity.rotate(BLOCK, 30, origin=(0, 0))], dtype=object)
    made = with_courtyards(block, places[:, 0], places[:, 1], low, 8.0)[0]
    assert made.area == pytest.approx(cut(x, y, low)[0].area, rel=0.03)


def test_a_deck_taken_for_ground_is_put_back_to_the_street():
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-10, 34, (2, 15000))
    deck = shapely.contains_xy(shapely.box(0, 0, 24, 12), x, y)
    tower = shapely.contains_xy(shapely.box(0, 12, 24, 24), x, y)
    z = np.where(deck, 5.0, np.where(tower, 40.0, 0.0))
    ground = np.where(deck | tower, 5.0, 0.0)  # the filter ran over the deck
    made = ground_without_decks(np.array([BLOCK, None], object), x, y, z, ground, 7.7)
    assert (made[deck | tower] == 0).all() and (made[~(deck | tower)] == 0).all()


def test_ground_of_a_slope_and_of_a_courtyard_stay():
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-10, 34, (2, 15000))
    slope = 0.3 * x
    court = shapely.contains_xy(COURT, x, y)
    z = np.where(shapely.contains_xy(BLOCK, x, y) & ~court, 30.0, slope)
    assert (ground_without_decks(np.array([BLOCK], object), x, y, z, slope, 7.7) == slope).all()
