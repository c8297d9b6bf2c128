"""How much of a drive has no kerb beside it."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.edges.bare_sides import bare_sides
from urbanmap_qgis.roadmap.edges.edge_records import BORDER, KERB, LOWERED, MEASURED, RoadEdge

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
