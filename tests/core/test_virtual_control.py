"""Virtual control points from corners of markings that two sources show (J 3.3.5)."""

import numpy as np
import pytest
import shapely

from scripts.judges.virtual_control import (
    bar_corners,
    reference_corners,
    survey_corners,
    virtual_control,
)
from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.control import residuals
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.trajectory import Trajectory

ORIGIN = np.array([-7000.0, -34000.0, 12.0])
ERROR = np.array([1.2, -0.7, 0.3])


def bars():
    """Dashes along the road, a disc and a long line: polygons with heights, relative to the origin."""
    dashes = [shapely.box(along, across, along + 3, across + 0.2) for along in range(0, 60, 8) for across in (-2, 2)]
    return [*dashes, shapely.Point(30, 5).buffer(0.5), shapely.box(0, -5, 60, -4.85)]


def polygons():
    """The same in the map, with the road's height."""
    return np.array([shapely.force_3d(shapely.transform(bar, lambda at: at + ORIGIN[:2]), ORIGIN[2]) for bar in bars()])


@pytest.fixture(scope="module")
def survey():
    """A trajectory that is off, and marking points as it places them."""
    rng, places = np.random.default_rng(4), []
    for bar in bars():
        x0, y0, x1, y1 = bar.bounds
        at = rng.uniform((x0, y0), (x1, y1), (int(900 * (x1 - x0) * (y1 - y0)), 2))
        places.append(at[shapely.contains_xy(bar, *at.T)])
    at = np.concatenate(places)
    time = 100.0 + at[:, 0] / 8.0
    off = np.column_stack([at, np.zeros(len(at))]) + ORIGIN + ERROR + rng.normal(0, 0.003, (len(at), 3))
    epochs = np.arange(99.0, 109.0, 0.1)
    true = np.column_stack([(epochs - 100) * 8, 0 * epochs, 0 * epochs + 2]) + ORIGIN
    level = np.tile([0.0, 0.0, 90.0], (len(epochs), 1))
    one = np.ones(len(at))
    return (MarkingPoints(*off.T, time, one, one.astype(int)), Trajectory(epochs, true + ERROR, level),
            Trajectory(epochs, true, level))


@pytest.mark.paper("J 3.3.5, virtual control points")
def test_errors_at_virtual_points_are_those_of_the_survey(survey):
    markings, reported, true = survey
    reference = Reference.from_polygons(polygons())
    corners = reference_corners(reference, polygons())
    assert len(corners) == 4 * 16 and np.allclose(corners[:, 2], ORIGIN[2])
    moved = correction_between(reported, true)
    control = virtual_control(survey_corners(markings), corners, moved)
    assert len(control) == len(set(control.id)) == 64
    found = residuals(control) - ERROR
    assert np.abs(found).max() < 0.06 and np.abs(found.mean(axis=0)).max() < 0.01
    assert np.abs(residuals(control, moved)).max() < 0.06
    assert np.abs(control.time - (100.0 + (control.surveyed[:, 0] - ORIGIN[0] - ERROR[0]) / 8)).max() < 0.05


def test_only_filled_rectangles_are_bars():
    rng = np.random.default_rng(1)
    full = rng.uniform((0, 0), (3, 0.2), (500, 2))
    assert len(bar_corners(full)) == 4
    assert not len(bar_corners(full[full[:, 1] > 0.1 * full[:, 0]]))  # a triangle
    assert not len(bar_corners(0.05 * full)) and not len(bar_corners(full[:5]))


def test_points_that_find_no_other_are_refused(survey):
    markings, reported, _ = survey
    corners = reference_corners(Reference.from_polygons(polygons()), polygons())
    with pytest.raises(InsufficientDataError, match="near one"):
        virtual_control(survey_corners(markings), corners, correction_between(reported, reported))
    with pytest.raises(InsufficientDataError, match="no bar"):
        virtual_control(survey_corners(markings), corners[:0], correction_between(reported, reported))
