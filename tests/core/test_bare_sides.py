"""How much of a drive has no kerb beside it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from urbanmap_qgis.roadmap.edges.bare_sides import bare_sides
from urbanmap_qgis.roadmap.edges.edge_points import EdgeTile
from urbanmap_qgis.roadmap.edges.edge_records import BORDER, KERB, LOWERED, MEASURED, RoadEdge
from urbanmap_qgis.roadmap.edges.uprights import upright_candidates

PATH = np.column_stack([np.linspace(0.0, 100.0, 201), np.zeros(201), np.zeros(201)])


def edge(kind: str, start: float, end: float, north: float) -> RoadEdge:
    foot = np.array([[start, north, 0.0], [end, north, 0.0]])
    return RoadEdge(kind, foot, foot + np.array([0.0, 0.0, 0.15]), 0.15, 0.01, 0.01, 100, 1, 1.0, 0, 0.0, MEASURED, "")


def test_kerbs_on_either_side_are_counted_on_it():
    edges = [edge(KERB, 0.0, 60.0, 4.0), edge(LOWERED, 60.0, 70.0, 4.0), edge(KERB, 0.0, 20.0, -5.0)]
    assert bare_sides(edges, PATH, 10.0) == pytest.approx((30.0, 80.0), abs=1.0)
    assert bare_sides(edges, PATH[::-1], 10.0) == pytest.approx((80.0, 30.0), abs=1.0)


def test_borders_and_kerbs_out_of_reach_are_none():
    edges = [edge(BORDER, 0.0, 100.0, 4.0), edge(KERB, 0.0, 100.0, -15.0)]
    assert bare_sides(edges, PATH, 10.0) == pytest.approx((100.0, 100.0))
    assert bare_sides([], PATH, 10.0) == pytest.approx((100.0, 100.0))
    assert bare_sides([], PATH[:1].repeat(2, axis=0), 10.0) == (0.0, 0.0)


@pytest.mark.parametrize(("points", "cells"), [(3, 14), (2, 0)])
def test_a_cell_with_few_points_is_no_upright(points, cells):
    """A rail along y at x = 5.05, so many points in each cell from 0.3 to 0.9 m; its ends tell no direction."""
    along, up = np.meshgrid(2.05 + 0.1 * np.arange(16), np.linspace(0.3, 0.9, points), indexing="ij")
    record = np.zeros(along.size, [("x", "<f8"), ("y", "<f8"), ("z", "<f8")])
    record["x"], record["y"] = 5.05, along.ravel()
    found = upright_candidates(EdgeTile(np.zeros(2), record), up.ravel(), cKDTree([[0.0, 3.0]]))
    assert len(found.place) == cells and (found.normal[:, 0] > 0.99).all()
