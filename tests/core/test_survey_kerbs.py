"""Kerbs of a survey on lines of a map: a made-up street reported off comes back, wrong lines say so."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.road_scene import KERB_AT, Street, to_local, to_map, write_drive
from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.registration.walls.outline_walls import KERBS, WallEdges
from urbanmap_qgis.mobile.trajectory import path_chainage
from urbanmap_qgis.roadmap.edges.kerb_witness import kerbs_of
from urbanmap_qgis.roadmap.edges.survey_kerbs import survey_kerbs

ANGLE = 25.0


def line(across=KERB_AT, begin=-5.0, end=70.0):
    """A line of a map along the street."""
    return np.array([shapely.LineString(to_map(np.array([[begin, across, 0.0], [end, across, 0.0]]), ANGLE))])


def shifted(by):
    """A correction of `by` m to the right of the drive, everywhere."""
    right = to_map(np.array([[0.0, 1.0, 0.0]]), ANGLE) - to_map(np.zeros((1, 3)), ANGLE)
    return lambda path_parameter: np.tile(np.append(by * right[0], np.zeros(3)), (len(path_parameter), 1))


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("kerbs")
    return [folder / "drive.las"], write_drive(folder / "drive.las", Street(), ANGLE)


@pytest.fixture(scope="module")
def witness(drive):
    return kerbs_of(*drive, 0.0, line())


def test_faces_lie_on_the_kerb_and_look_at_the_road(drive):
    found = survey_kerbs(*drive, path_chainage(drive[1]))
    along, across, height = to_local(found.place, ANGLE).T
    assert len(found) > 80 and np.ptp(along) > 45.0
    assert np.abs(across - KERB_AT).max() < 0.02 and np.abs(height + 0.04).max() < 0.02
    towards = to_local(found.place + np.column_stack([found.normal, np.zeros(len(found))]), ANGLE)[:, 1]
    assert (towards - across).max() < -0.95
    assert (np.diff(found.path_parameter) >= 0).all()
    assert np.abs(found.path_parameter - 4.0 - along).max() < 1.0  # the drive begins 4 m before the street


def test_passes_through_one_place_are_told_apart(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", Street(length=30.0), ANGLE, passes=2)
    found = survey_kerbs([tmp_path / "drive.las"], trajectory, path_chainage(trajectory))
    along = to_local(found.place, ANGLE)[:, 0]
    first = found.path_parameter < 0.5 * path_chainage(trajectory)[-1]
    assert np.count_nonzero(first) > 30 and np.count_nonzero(~first) > 30
    assert min(np.ptp(along[first]), np.ptp(along[~first])) > 20.0


@pytest.mark.parametrize("off", [-0.6, 0.0, 0.4])
def test_kerbs_tell_how_far_off_the_drive_is_across_it(witness, off):
    held = witness.about(shifted(off), (0, 1))
    side = to_local(to_map(np.zeros((1, 3)), ANGLE) + np.array([[*held.rate[0], 0.0]]), ANGLE)[0, 1]
    assert len(held) >= 4 and abs(side) == pytest.approx(1.0, abs=0.01)
    assert held.residual(shifted(off)(held.path_parameter)[:, :2]) * np.sign(side) == pytest.approx(off, abs=0.03)
    assert held.offset_prior == KERBS.inside


def test_lines_of_a_map_have_either_side_outside_and_pieces():
    edges = WallEdges.of_kerbs(np.concatenate([line(begin=0.0, end=40.0), line(begin=40.0, end=70.0)]))
    length = np.hypot(*(edges.ends[:, 1] - edges.ends[:, 0]).T)
    assert length.max() <= KERBS.piece and length.sum() == pytest.approx(2 * 70.0, abs=1e-6)
    half = len(edges) // 2
    assert edges.outward[:half] == pytest.approx(-edges.outward[half:])
    assert len(set(edges.building.tolist())) == 2


@pytest.mark.parametrize("lines", [line(across=30.0), np.array([shapely.LineString()]), np.array([None]),
                                   np.array([shapely.LineString([[np.nan, 0.0], [1.0, 1.0]])])])
def test_lines_of_another_place_are_refused(drive, lines):
    with pytest.raises(InsufficientDataError, match="No line of the road edges"):
        kerbs_of(*drive, 0.0, lines)


def test_a_street_without_kerbs_is_refused(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", Street(kerb=0.0, length=30.0), ANGLE)
    with pytest.raises(InsufficientDataError, match="shows no kerb"):
        kerbs_of([tmp_path / "drive.las"], trajectory, 0.0, line())


def test_far_lines_cost_nothing(drive):
    """A line of a thousand kilometres is cut to the survey before it is cut in pieces."""
    found = kerbs_of(*drive, 0.0, line(begin=-5e5, end=5e5))
    assert len(found.edges) < 20
