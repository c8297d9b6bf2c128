"""Distance of neighbouring lane lines: lines in metres and in feet, crossings and single lines that tell nothing."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.markings.signs.lane_spacing import LaneSpacing, lane_spacing


def drawn(boxes, turn=0.0, unit=1.0):
    """Spacing of boxes (left, low, right, high) in m, turned by degrees, in a CRS of a unit in m."""
    made = np.array([shapely.box(*one) for one in boxes], object)
    sides = np.array([[right - left, high - low] for left, low, right, high in boxes]).reshape(-1, 2)
    moved = shapely.transform([shapely.affinity.rotate(one, turn, (0, 0)) for one in made], lambda p: p / unit + 5e5)
    return lane_spacing(moved, shapely.area(made), sides.max(axis=1), sides.min(axis=1))


def dashes(at, count=8, step=9.0, dash=4.0):
    return [(step * k, at - 0.075, step * k + dash, at + 0.075) for k in range(count)]


@pytest.mark.parametrize("turn", [0.0, 37.0, 90.0])
@pytest.mark.parametrize("unit", [1.0, 0.3048])
def test_neighbouring_lines(turn, unit):
    """Of four lines the nearest neighbours are 3.2, 3.2 and 3.4 m away, which share all 8 dashes of 4 m."""
    lines = [*dashes(0.0), *dashes(3.2), *dashes(6.4), *dashes(9.8)]
    made = drawn(lines, turn, unit)
    assert made.spacing == pytest.approx(3.2, abs=0.01)
    assert made.length == pytest.approx(6 * 8 * 4.0, rel=0.01)
    wider = drawn([*dashes(0.0), *dashes(3.4), *dashes(6.8)], turn, unit)
    assert wider.spacing == pytest.approx(3.4, abs=0.01)


def test_a_pixel_said_half_as_large_halves_it():
    lines = np.array([*dashes(0.0), *dashes(3.2)])
    assert drawn(lines / 2).spacing == pytest.approx(1.6, abs=0.01)


@pytest.mark.parametrize("boxes", [
    [], dashes(0.0), [(0.0, 0.9 * k, 3.0, 0.9 * k + 0.45) for k in range(10)],
    [(0.0, 2.5 * k, 5.0, 2.5 * k + 0.1) for k in range(10)]], ids=["none", "one line", "crossing", "one row of bays"])
def test_what_tells_nothing(boxes):
    assert drawn(boxes) == LaneSpacing(0.0, 0.0)
