"""Areas in which reference and survey disagree: where, how long and how wide."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.correction.disagreements import CHANGED, DISAGREEMENT, HIDDEN, CorrectionStep
from urbanmap_qgis.mobile.registration.disagreement_areas import area_table
from urbanmap_qgis.mobile.trajectory import Trajectory

SIDE = 6.0


def survey(*steps):
    """A drive northwards at 10 m/s over 400 m, corrected by a metre east, markings 6 m to either side."""
    time = np.arange(0.0, 40.0, 0.1)
    place, angles = np.outer(time, [0.0, 10.0, 0.0]), np.zeros((len(time), 3))
    seen = np.arange(0.0, 39.0, 0.01)
    side = np.where(np.arange(len(seen)) % 2, SIDE, -SIDE)
    none = np.zeros(len(seen))
    markings = MarkingPoints(side, 10.0 * seen, none, seen, none, none)
    return SimpleNamespace(reported=Trajectory(time, place, angles),
                           trajectory=Trajectory(time, place + np.array([1.0, 0.0, 0.0]), angles), markings=markings,
                           correction=SimpleNamespace(chainage=np.arange(0.25, 399.0, 0.5), steps=steps))


def step(place, kind, span=None):
    return CorrectionStep(place, place / 10.0, 0.3, 0.4, 0.02, kind, span)


def test_changed_markings_are_one_area_from_edge_to_edge():
    columns, areas = area_table(survey(step(100.0, CHANGED, (100.0, 180.0)), step(180.0, CHANGED)))
    assert columns["kind"] == [CHANGED] and columns["size"] == [pytest.approx(0.5)]
    assert columns["direction"] == [pytest.approx(np.degrees(np.arctan2(0.3, 0.4)))]
    assert areas[0].bounds == pytest.approx((1.0 - SIDE, 100.0, 1.0 + SIDE, 180.0), abs=0.1)
    assert areas[0].area == pytest.approx(80.0 * 2 * SIDE, rel=0.01)


def test_a_single_step_is_the_road_about_it_and_a_hidden_one_its_stretch():
    columns, areas = area_table(survey(step(10.0, DISAGREEMENT), step(300.0, HIDDEN, (280.0, 320.0))))
    assert list(zip(columns["begin"], columns["end"])) == [(0.0, 30.0), (280.0, 320.0)]
    assert [shapely.get_coordinates(area)[:, 1].max() for area in areas] == pytest.approx([30.0, 320.0], abs=0.1)


def test_an_area_is_as_wide_as_the_markings_of_its_whole_length():
    drive = survey(step(100.0, CHANGED, (100.0, 180.0)))
    drive.markings.x[drive.markings.y > 140.0] *= 2.0
    _, (area,) = area_table(drive)
    assert area.bounds == pytest.approx((1.0 - 2 * SIDE, 100.0, 1.0 + 2 * SIDE, 180.0), abs=0.1)


def test_where_nothing_disagrees_there_is_no_area():
    columns, areas = area_table(survey())
    assert len(areas) == 0 and all(len(column) == 0 for column in columns.values())
