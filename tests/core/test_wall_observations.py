"""Several drives laid on walls of buildings: known streets, known errors of the drives."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.adjustment.network import (
    KINDS,
    NONE,
    REFERENCE,
    WALL,
    DriveNodes,
    NetworkObservations,
    NetworkSettings,
    adjust_network,
)
from urbanmap_qgis.mobile.adjustment.records import AdjustmentRun
from urbanmap_qgis.mobile.adjustment.ties import Drive
from urbanmap_qgis.mobile.adjustment.wall_observations import BuildingWalls, DriveWalls
from urbanmap_qgis.mobile.registration.correction.gauss_markov import GaussMarkovDrift
from urbanmap_qgis.mobile.registration.matching.results import angle_rates
from urbanmap_qgis.mobile.registration.walls.facade_planes import FacadePlanes
from urbanmap_qgis.mobile.registration.walls.outline_walls import WallEdges
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate
from urbanmap_qgis.progress import SILENT

LENGTH, WIDE, EAVES = 240.0, 9.0, 0.45
RUN = AdjustmentRun(planes=False)


def buildings():
    """Outlines of 16 m along both sides of a street to the east, with their ends; facades stand EAVES inside."""
    ends, outward = [], []
    for side in (1.0, -1.0):
        for begin in np.arange(0.0, LENGTH, 20.0):
            front, back = side * WIDE, side * (WIDE + 10.0)
            ends += [[[begin, front], [begin + 16.0, front]], [[begin, front], [begin, back]],
                     [[begin + 16.0, front], [begin + 16.0, back]]]
            outward += [[0.0, -side], [-1.0, 0.0], [1.0, 0.0]]
    return WallEdges.of(np.array(ends), np.array(outward))


def facades(edges):
    """Places (n, 2) and normals (n, 2) of planes on the facades, to 6 m from the street."""
    place, normal = [], []
    for (begin, end), outward in zip(edges.ends, edges.outward):
        step = np.arange(0.8, min(np.hypot(*(end - begin)), 16.0 if outward[0] == 0 else 6.0), 0.8)
        unit = (end - begin) / np.hypot(*(end - begin))
        place.append(begin + step[:, None] * unit - EAVES * outward)
        normal.append(np.tile(outward, (len(step), 1)))
    return np.concatenate(place), np.concatenate(normal)


def survey(name, start, error):
    """A drive reported `error` (metres at chainages) off the truth, the planes that it saw, and the true trajectory."""
    time = start + np.arange(0.0, LENGTH / 10, 0.05)
    x = (time - start) * 10.0
    true = np.column_stack([x, np.zeros(len(x)), np.full(len(x), 2.0)])
    angles = np.tile([0.0, 0.0, 90.0], (len(x), 1))
    reported = Trajectory(time, true + error(x), angles)
    place, normal = facades(buildings())
    at = np.clip(place[:, 0] - 3.0, 0.0, x[-1])
    order = np.argsort(at, kind="stable")
    place, normal, at = place[order], normal[order], at[order]
    seen = np.interp(at, x, time)
    flat = np.column_stack([place, np.full(len(at), 4.0)]) + error(at)
    body = interpolate(reported, seen)
    along = np.interp(seen, time, RUN.path_parameters(reported))
    planes = FacadePlanes(along, at, flat, flat - body.place, normal, np.linalg.inv(angle_rates(body.angles)))
    return Drive(name, reported, None), planes, true


def smooth(seed, size):
    """An error of some metres a drive: constant, and slow drift."""
    phase = np.random.default_rng(seed).uniform(0, 6, 2)
    return lambda x: np.column_stack([size * np.sin(x / 90 + phase[0]), size * np.cos(x / 110 + phase[1]), 0.0 * x])


def errors(survey_result, trues):
    return [drive.corrected.place - true for drive, true in zip(survey_result.drives, trues)]


def two_drives():
    return zip(*(survey(name, start, smooth(seed, 0.5)) for name, start, seed in (("a", 0.0, 1), ("b", 500.0, 2))))


def test_walls_alone_place_drives_and_tell_the_eaves():
    drives, planes, trues = two_drives()
    made = DriveWalls(BuildingWalls(buildings()), planes).adjusted(drives, NetworkObservations.none(), RUN, SILENT)
    for number, error in enumerate(errors(made, trues)):
        assert np.hypot(*error[:, :2].T).mean() < 0.03
        assert made.witness_shares(number) == pytest.approx([float(kind == WALL) for kind in range(len(KINDS))])
    assert made.network.offset == pytest.approx(EAVES - 0.3, abs=0.02)
    assert not made.relative and made.median_sigma() < 0.05


def test_a_wall_counts_once_however_often_it_is_passed():
    drives, planes, _ = two_drives()
    one, two = (DriveWalls(BuildingWalls(buildings()), planes[:n]).adjusted(drives[:n], NetworkObservations.none(), RUN,
                                                                            SILENT) for n in (1, 2))
    # Both drives hang on the same walls: a second one makes the first no surer than that it may drift less.
    assert two.drives[0].plan_sigma() == pytest.approx(one.drives[0].plan_sigma(), rel=0.5)
    total = [np.trace(np.linalg.inv(made.observations.covariance)[:, :2, :2], axis1=1, axis2=2).sum()
             for made in (one, two)]
    assert total[1] == pytest.approx(total[0], rel=0.02)


def test_the_reference_gives_the_start_only_where_walls_are_to_place_the_drive_alone():
    drive, planes, true = survey("a", 0.0, smooth(1, 0.5))
    at = np.arange(5.0, LENGTH - 10.0, 10.0)
    wanted = np.column_stack([-smooth(1, 0.5)(at) + [0.3, 0.4, 0.0], np.full(len(at), np.nan)])  # 0.5 m wrong
    parameter = np.interp(at, (drive.trajectory.time - drive.trajectory.time[0]) * 10.0,
                          RUN.path_parameters(drive.trajectory))
    n, nothing = len(at), np.zeros((len(at), 2))
    wrong = NetworkObservations(np.zeros(n, int), parameter, nothing, np.full(n, NONE), np.zeros(n), nothing, wanted,
                                np.tile(np.eye(4) * 0.01**2, (n, 1, 1)), np.full(n, REFERENCE))
    found = [DriveWalls(BuildingWalls(buildings(), alone), (planes,)).adjusted([drive], wrong, RUN, SILENT)
             for alone in (False, True)]
    off = [np.hypot(*errors(made, [true])[0][:, :2].T).mean() for made in found]
    assert off[0] > 0.3 and off[1] < 0.03


def test_drives_far_from_all_buildings_are_refused():
    drive, planes, _ = survey("a", 0.0, smooth(1, 0.5))
    away = WallEdges(buildings().ends + 500.0, buildings().outward)
    with pytest.raises(InsufficientDataError, match="No facade of the drives belongs to a building"):
        DriveWalls(BuildingWalls(away), (planes,)).adjusted([drive], NetworkObservations.none(), RUN, SILENT)


def test_a_common_offset_of_opposite_walls_moves_nothing():
    """Two walls face each other across a street, both 0.2 m farther inside than expected: by hand, of one node pair."""
    model = GaussMarkovDrift(np.full(6, 2e-3), 40.0, np.full(6, 1.5e-3), np.full(6, 3.0), 1.0, 0.1)
    outward, n, nothing = np.array([[0.0, 1.0], [0.0, -1.0]]), 2, np.zeros((2, 2))
    value = np.column_stack([0.2 * outward, np.full((2, 2), np.nan)])
    seen = NetworkObservations(np.zeros(n, int), np.full(n, 2.0), nothing, np.full(n, NONE), np.zeros(n), nothing,
                               value, np.tile(np.diag([100.0, 0.04**2, 1.0, 1.0]), (n, 1, 1)), np.full(n, WALL),
                               outward)
    parameter = np.array([0.0, 4.0])
    made = adjust_network([DriveNodes(parameter, np.zeros(1), np.zeros(1))], seen, NetworkSettings(model))
    assert np.abs(made.state[0][:, :2, 0]).max() < 1e-9
    weight = 2.0 * made.weight[0] / made.noise_factor / 0.04**2
    assert made.offset == pytest.approx(0.2 * weight / (weight + 0.3**-2), rel=1e-3)
