"""Several drives laid on walls of buildings: known streets, known errors of the drives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.estimation.gauss_markov import GaussMarkovDrift, PathLinks
from urbanmap_qgis.mobile.adjustment.drive_drift import DriveNodes
from urbanmap_qgis.mobile.adjustment.network import (
    CONTROL,
    KINDS,
    NONE,
    REFERENCE,
    WALL,
    NetworkObservations,
    NetworkSettings,
    adjust_network,
)
from urbanmap_qgis.mobile.adjustment.records import AdjustmentRun
from urbanmap_qgis.mobile.adjustment.ties import Drive
from urbanmap_qgis.mobile.adjustment.wall_observations import BuildingWalls, DriveWalls
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


MODEL = GaussMarkovDrift(np.full(6, 2e-3), 40.0, np.full(6, 1.5e-3), np.full(6, 3.0), 1.0, 0.1)


def wall_rows(drive, wall, value, sigma=0.03):
    """Walls that face north, seen by drives (n,) at the path's begin: they must move by `value` (n,) m."""
    n, nothing = len(drive), np.zeros((len(drive), 2))
    seen = np.column_stack([np.zeros(n), value, np.full((n, 2), np.nan)])
    return NetworkObservations(np.array(drive), np.zeros(n), nothing, np.full(n, NONE), np.zeros(n), nothing, seen,
                               np.tile(np.diag([100.0, sigma**2, 1.0, 1.0]), (n, 1, 1)), np.full(n, WALL),
                               np.tile([0.0, 1.0], (n, 1)), np.column_stack([wall, wall]))


def short_drives(count):
    return [DriveNodes(np.array([0.0, 4.0]), PathLinks.none(1))] * count


@pytest.mark.parametrize("times", [1, 9])
def test_a_wall_counts_once_however_often_it_is_passed(times):
    settings = NetworkSettings(MODEL, gross=1e6, differ=(0.2, 0.1))
    made = adjust_network(short_drives(1), wall_rows([0] * times, [0] * times, np.zeros(times)), settings)
    of_wall = 0.3**2 + 0.2**2 + 0.1**2 + 0.03**2 / times
    assert made.covariance[0][0, 1, 1] == pytest.approx(1.0 / (3.0**-2 + 1.0 / of_wall), rel=1e-4)


def test_walls_that_two_drives_saw_tie_them_however_far_off_they_are():
    """The second drive lies 0.4 m north of the first one against the same wall, whose place is known to 0.37 m."""
    settings = NetworkSettings(MODEL, gross=1e6, differ=(0.2, 0.1))
    made = adjust_network(short_drives(2), wall_rows([0, 1], [0, 0], [0.7, 0.3]), settings)
    apart = made.state[0][0, 1, 0] - made.state[1][0, 1, 0]
    assert apart == pytest.approx(0.4, abs=0.001)
    alone = adjust_network(short_drives(2), wall_rows([0, 1], [0, 1], [0.7, 0.3]), settings)
    assert alone.state[0][0, 1, 0] - alone.state[1][0, 1, 0] == pytest.approx(
        0.4 / (1.0 + (0.2**2 + 0.1**2 + 0.03**2) / 3.0**2), abs=0.001)


def test_a_wall_whose_own_place_is_unsure_says_as_much_less():
    settings = NetworkSettings(MODEL, gross=1e6, differ=(0.2, 0.1))
    unsure = replace(wall_rows([0], [0], [0.0]), own_sigma=np.array([0.5]))
    made = adjust_network(short_drives(1), unsure, settings)
    of_wall = 0.3**2 + 0.2**2 + 0.1**2 + 0.5**2 + 0.03**2
    assert made.covariance[0][0, 1, 1] == pytest.approx(1.0 / (3.0**-2 + 1.0 / of_wall), rel=1e-4)
    assert made.differ[1] == pytest.approx(0.1, rel=0.01)  # next to nothing is seen of what walls differ by


@pytest.mark.slow
@pytest.mark.parametrize("own", [0.0, 0.3])
def test_how_much_walls_differ_beside_their_own_accuracy_is_found(own):
    """A place known to a millimetre, 400 walls about it that differ by 0.2 m and by what they are unsure of."""
    offsets = np.random.default_rng(4).normal(0.0, np.hypot(0.2, own), 400)
    fixed = replace(wall_rows([0], [NONE], [0.0], 0.001), kind=np.array([CONTROL]), outward=np.zeros((1, 2)))
    walls = replace(wall_rows([0] * 400, np.arange(400), offsets), own_sigma=np.full(400, own))
    walls.owner[:, 0] = 0  # of one building
    seen, differ = NetworkObservations.joined([fixed, walls]), (0.03, 0.1)
    for _ in range(60):
        made = adjust_network(short_drives(1), seen, NetworkSettings(MODEL, gross=1e6, differ=differ))
        differ = (0.03, made.differ[1])
    assert differ[1] == pytest.approx(0.2, rel=0.15)


@pytest.mark.slow
def test_how_much_buildings_differ_is_found():
    """A place known to a millimetre, 400 walls about it that differ by 0.2 m: their own size is what is found."""
    offsets = np.random.default_rng(4).normal(0.0, 0.2, 400)
    fixed = replace(wall_rows([0], [NONE], [0.0], 0.001), kind=np.array([CONTROL]), outward=np.zeros((1, 2)))
    seen = NetworkObservations.joined([fixed, wall_rows([0] * 400, np.arange(400), offsets)])
    differ = (0.3, 0.1)
    for _ in range(60):
        made = adjust_network(short_drives(1), seen, NetworkSettings(MODEL, gross=1e6, differ=differ))
        differ = made.differ
    assert np.hypot(*differ) == pytest.approx(0.2, rel=0.05)


def test_what_a_trajectory_wanders_while_the_vehicle_stands_is_its_error():
    """Right before a stop in which the trajectory wanders by 0.5 m to the east: after it the correction takes it back.
    """
    stop = replace(PathLinks.none(1), stopped=np.array([60.0]))
    still = replace(stop, moved=np.array([[0.5, 0.0, 0.0]]), stop_variance=np.array([1e-6]))
    known = replace(wall_rows([0], [NONE], [0.0], 0.001), kind=np.array([CONTROL]), outward=np.zeros((1, 2)),
                    value=np.array([[0.0, 0.0, 0.0, np.nan]]), covariance=np.eye(4)[None] * 1e-6)
    for standing, east in ((still, -0.5), (stop, 0.0)):
        drive = DriveNodes(np.array([0.0, 1.0]), standing)
        made = adjust_network([drive], known, NetworkSettings(MODEL))
        assert made.state[0][1, 0, 0] == pytest.approx(east, abs=0.002)
    assert made.covariance[0][1, 0, 0] > 0.1**2 * 60.0 * 0.99  # nothing known: it wanders by its own model


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
    outward, n, nothing = np.array([[0.0, 1.0], [0.0, -1.0]]), 2, np.zeros((2, 2))
    value = np.column_stack([0.2 * outward, np.full((2, 2), np.nan)])
    seen = NetworkObservations(np.zeros(n, int), np.full(n, 2.0), nothing, np.full(n, NONE), np.zeros(n), nothing,
                               value, np.tile(np.diag([100.0, 0.04**2, 1.0, 1.0]), (n, 1, 1)), np.full(n, WALL),
                               outward)
    parameter = np.array([0.0, 4.0])
    alike = NetworkSettings(MODEL, differ=(1e-6, 1e-6))
    made = adjust_network([DriveNodes(parameter, PathLinks.none(1))], seen, alike)
    assert np.abs(made.state[0][:, :2, 0]).max() < 1e-9
    weight = 2.0 * made.weight[0] / made.noise_factor / 0.04**2
    assert made.offset == pytest.approx(0.2 * weight / (weight + 0.3**-2), rel=1e-3)
