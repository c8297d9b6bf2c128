"""Corners of buildings in made surface rasters, against the corners that were drawn."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from urbanmap_qgis.mobile.lines.surface_corners import raster_corners


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
