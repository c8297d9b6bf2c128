"""Walls as a second witness: straight by themselves, and where outlines want them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from tests.core.simulated_windows import shifted, simulate
from urbanmap_qgis.estimation.chain import NodeChain, nodes_along
from urbanmap_qgis.estimation.gauss_markov import PathLinks
from urbanmap_qgis.estimation.held_observations import HeldObservations, OwnOffsets
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.correction.adjustment import adjust_correction
from urbanmap_qgis.mobile.registration.correction.moved_markings import moved_markings, with_moved
from urbanmap_qgis.mobile.registration.correction.patch_status import REGISTERED
from urbanmap_qgis.mobile.registration.correction.point_observations import PointObservations
from urbanmap_qgis.mobile.registration.correction.second_witness import AGAINST_WALLS
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.correction.window_factors import normal_equations_of
from urbanmap_qgis.mobile.registration.matching.results import angle_rates
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.trajectory_stops import path_parameters_of
from urbanmap_qgis.mobile.registration.walls.facade_planes import FacadePlanes
from urbanmap_qgis.mobile.registration.walls.outline_walls import WallEdges
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness
from urbanmap_qgis.mobile.trajectory import interpolate, path_chainage

WIDE = 9.0
"""m from the middle of the street to its facades."""


def street(drive, eaves=0.4, differ=0.1, seed=1, shared=False):
    """Facades on both sides of a straight drive to the east, every fourth building with a side wall; and outlines.

    `shared` : the side wall has the eaves of its building.
    """
    rng = np.random.default_rng(seed)
    true, length = drive.true, path_chainage(drive.true)[-1]
    origin = true.place[0, :2]
    ends, outward, place, normal, building = [], [], [], [], []
    for side in (1.0, -1.0):
        for number, begin in enumerate(np.arange(-20.0, length + 20.0, 20.0)):
            inside = eaves + rng.normal(0.0, differ)
            ends.append(np.array([[begin, side * WIDE], [begin + 18.0, side * WIDE]]) + origin)
            outward.append([0.0, -side])
            building.append(number + 1000 * (side > 0))
            x = np.arange(begin + 0.4, begin + 18.0, 0.8)
            place.append(np.column_stack([origin[0] + x, np.full(len(x), origin[1] + side * (WIDE + inside))]))
            normal.append(np.tile([0.0, -side], (len(x), 1)))
            if number % 4 == 0:
                ends.append(np.array([[begin, side * WIDE], [begin, side * (WIDE + 10.0)]]) + origin)
                outward.append([-1.0, 0.0])
                building.append(building[-1])
                y = np.arange(1.0, 8.0, 0.8)
                at = origin[0] + begin + (inside if shared else eaves + rng.normal(0.0, differ))
                place.append(np.column_stack([np.full(len(y), at), origin[1] + side * (WIDE + y)]))
                normal.append(np.tile([-1.0, 0.0], (len(y), 1)))
    place, normal = np.concatenate(place), np.concatenate(normal)
    chainage = np.clip(place[:, 0] - origin[0] - 4.0, 0.0, length - 0.1)
    order = np.argsort(chainage, kind="stable")
    edges = WallEdges.of(np.array(ends), np.array(outward), np.array(building) if shared else None)
    return seen(drive, place[order], normal[order], chainage[order]), edges


def seen(drive, place, normal, chainage):
    """The planes as the drive reports them."""
    moving = np.concatenate([[True], np.diff(path_chainage(drive.true)) > 0])
    time = np.interp(chainage, path_chainage(drive.true)[moving], drive.true.time[moving])
    body = interpolate(drive.reported, time)
    error = interpolate(drive.true, time).place[:, :2] - body.place[:, :2]
    flat = np.column_stack([place - error, body.place[:, 2]])
    along = np.interp(time, drive.reported.time, path_parameters_of(drive.reported, CorrectionSettings().time_weight))
    return FacadePlanes(along, chainage, flat, flat - body.place, normal, np.linalg.inv(angle_rates(body.angles)))


def as_points(drive):
    """The windows' own evidence in place of that of the points."""
    along = path_parameters_of(drive.reported, CorrectionSettings().time_weight)
    normals = normal_equations_of(drive.windows, np.interp(drive.windows.time, drive.reported.time, along))
    return lambda _curve, _blur: normals


def adjusted(drive, walls=None):
    return adjust_correction(drive.windows, drive.reported, points=as_points(drive), walls=walls)


def off(drive, made):
    return np.hypot(*(made.value - drive.error)[:, :2].T)


def far_off(drive, made):
    return int(((made.status == REGISTERED) & (off(drive, made) > 0.1)).sum())


def test_planes_belong_to_the_edge_that_they_stand_behind():
    edges = WallEdges.of(np.array([[[0.0, 0.0], [10.0, 0.0]], [[0.0, 0.0], [0.0, 8.0]]]),
                         np.array([[0.0, -1.0], [-1.0, 0.0]]))
    place = np.array([[5.0, 0.4], [5.0, -0.3], [0.5, 4.0], [5.0, 4.0], [20.0, 0.3], [5.0, 0.2]])
    normal = np.array([[0.0, -1.0], [0.0, -1.0], [-1.0, 0.0], [0.0, -1.0], [0.0, -1.0], [0.7, -0.7]])
    edge, outside = edges.matched(place, normal, 0.3)
    assert edge.tolist() == [0, 0, 1, -1, -1, -1]
    assert outside[:3] == pytest.approx([-0.4, 0.3, -0.5])


def test_held_observations_and_their_offsets_equal_the_dense_solution():
    """By the slope of the sum of squares over each offset, of which the states are solved again and again."""
    drive = simulate(2, length=60.0, turn=None)
    along = path_parameters_of(drive.reported, 1.0)
    normals = normal_equations_of(drive.windows, np.interp(drive.windows.time, drive.reported.time, along))
    nodes = nodes_along(along, 2.0)
    chain = NodeChain(normals, nodes, PathLinks.none(len(nodes) - 1))
    rng = np.random.default_rng(0)
    column = np.column_stack([rng.integers(0, 3, 40), 3 + rng.integers(0, 5, 40)])
    own = OwnOffsets(column, rng.uniform(4.0, 30.0, 8), np.repeat([0, 1], [3, 5]), rng.uniform(5.0, 30.0, 40))
    held = HeldObservations(np.sort(rng.uniform(0, along[-1], 40)), rng.normal(size=(40, 3)), rng.normal(size=40),
                            rng.uniform(1, 9, 40), 0.2, (0.3, 0.5), own)
    model = CorrectionSettings().error_model(np.tile([0.05, 0.05, 0.1], (len(chain.nodes), 1)))
    weight = np.ones(len(normals.present))

    def slope(offsets):
        """Of the common offset and the eight, and the states."""
        moved = (offsets[0] - held.offset) + offsets[1:][column].sum(axis=1)
        other = replace(held, target=held.target - moved, weight=own.weight, own=None)
        state, covariance, _ = chain.with_held(other).solve(model, weight)
        node, ahead = chain._next_node(held.path_parameter)
        off = other.weight * other.residual(state[node, :, 0] + ahead[:, None] * state[node, :, 1])
        of_own = np.bincount(column.ravel(), np.repeat(off, 2), 8) + own.precision * offsets[1:]
        return np.append(off.sum() + (offsets[0] - 0.3) / 0.5**2, of_own), state, covariance

    made = chain.with_held(held).settled(model, weight)
    best = np.append(made.offset, made.own)
    at_best, state, spread = slope(best)
    assert at_best == pytest.approx(0.0, abs=1e-6)
    assert made.state == pytest.approx(state, abs=1e-7)
    beside = [slope(best + 0.01 * unit) for unit in np.eye(9)]
    inverse = np.linalg.inv(np.array([item[0] for item in beside]) / 0.01)
    follow = np.array([(item[1] - state).reshape(len(state), -1) for item in beside]) / 0.01
    assert made.own_variance == pytest.approx(np.diag(inverse)[1:], rel=1e-4)
    assert made.covariance == pytest.approx(spread + np.einsum("aki,ab,bkj->kij", follow, inverse, follow), rel=1e-4,
                                            abs=1e-9)


def test_what_is_held_does_not_follow_a_shift_of_the_markings():
    """By the difference of two adjustments; without walls all of the path follows all of the shift."""
    drive = simulate(3, length=200.0, turn=None, gaps=((60.0, 140.0),))
    along = path_parameters_of(drive.reported, 1.0)
    at = np.interp(drive.windows.time, drive.reported.time, along)
    normals, nodes = normal_equations_of(drive.windows, at), nodes_along(along, 2.0)
    bare = NodeChain(normals, nodes, PathLinks.none(len(nodes) - 1))
    model, weight = CorrectionSettings().error_model(np.tile([0.05, 0.05, 0.1], (len(nodes), 1))), np.ones(len(at))
    held = HeldObservations(np.linspace(70.0, 130.0, 40), np.tile([[1.0, 0.3, 0.0], [-1.0, 0.5, 0.0]], (20, 1)),
                            np.zeros(40), np.full(40, 50.0), 0.2, (0.3, 0.5))
    chain = bare.with_held(held)

    def solved(shift):
        moved = chain.with_normals(replace(normals, place=normals.place + np.append(shift, 0.0)))
        state = moved.settled(model, weight).state
        return chain.interpolate(state, np.zeros((len(nodes), 6, 6)), at)[0][:, :2]

    expected = np.stack([(solved(np.eye(2)[axis]) - solved(np.zeros(2))) for axis in range(2)], axis=2)
    found = chain.shift_response(model, weight, at)
    assert found == pytest.approx(expected, abs=1e-6)
    middle = (drive.windows.chainage > 90.0) & (drive.windows.chainage < 110.0)
    assert found[middle, 0, 0].max() < 0.3 and found[0] == pytest.approx(np.eye(2), abs=0.05)
    assert (bare.shift_response(model, weight, at) == np.eye(2)).all()


@pytest.mark.parametrize("eaves", [0.0, 0.6])
def test_walls_hold_a_street_without_paint(eaves):
    drive = simulate(3, length=400.0, turn=None, crossings=25.0, gaps=((50.0, 350.0),), drift_length=60.0)
    planes, edges = street(drive, eaves)
    bare, held = adjusted(drive), adjusted(drive, WallWitness(planes, edges))
    inside = (drive.windows.chainage > 60) & (drive.windows.chainage < 340)
    assert off(drive, held)[inside].mean() < 0.1 < off(drive, bare)[inside].mean()
    ratio = np.abs(held.value - drive.error)[inside, :2] / held.sigma()[inside, :2]
    assert (ratio < 3).mean() > 0.95
    assert held.plan_sigma()[inside].max() < bare.plan_sigma()[inside].max()


def test_walls_of_a_building_share_its_eaves():
    """Along the street few walls say anything: what the fronts tell of their buildings' eaves holds for these, too."""
    drive = simulate(3, length=400.0, turn=None, gaps=((60.0, 340.0),))
    planes, edges = street(drive, differ=0.3, shared=True)
    apart = replace(edges, building=np.arange(len(edges)))
    inside = (drive.windows.chainage > 60) & (drive.windows.chainage < 340)
    made, alone = (adjusted(drive, WallWitness(planes, item)) for item in (edges, apart))
    along, of_alone = (np.abs(item.value - drive.error)[inside, 0] for item in (made, alone))
    assert along.mean() < 0.7 * of_alone.mean() and along.mean() < 0.05
    assert (along < 3 * made.sigma()[inside, 0]).mean() > 0.95
    assert (made.status == REGISTERED)[inside].mean() > 0.1  # without any paint


@pytest.mark.slow
def test_paint_that_lies_elsewhere_than_the_walls_want_it_is_not_registered():
    drive = shifted(simulate(4, crossings=25.0, turn=None), 0.0, 500.0, (0.0, 0.5))
    planes, edges = street(drive)
    believed, heard = adjusted(drive), adjusted(drive, WallWitness(planes, edges))
    assert far_off(drive, believed) > 800 and far_off(drive, heard) == 0
    assert {step.kind for step in heard.steps} == {AGAINST_WALLS}
    assert off(drive, heard).mean() < 3 * np.median(heard.plan_sigma())


@pytest.mark.slow
def test_walls_that_agree_leave_the_paint_registered():
    drive = simulate(5, crossings=25.0, turn=None)
    planes, edges = street(drive)
    alone, both = adjusted(drive), adjusted(drive, WallWitness(planes, edges))
    assert both.steps == () and far_off(drive, both) == 0
    assert (both.status == REGISTERED).mean() >= (alone.status == REGISTERED).mean() - 0.01
    assert np.abs(both.value - alone.value)[:, :2].max() < 0.05


@pytest.mark.parametrize("moved_share", [0.0, 0.4])
def test_markings_of_which_a_part_lies_elsewhere_by_one_shift(moved_share):
    drive = simulate(6, length=200.0, turn=None)
    rng, (x0, y0) = np.random.default_rng(2), drive.true.place[0, :2]
    corners = [(x0 + x, y0 + y) for x in np.arange(2.0, 198.0, 4.0) for y in rng.uniform(-5.0, 5.0, 3)]
    marks = [shapely.box(x, y, x + 0.5, y + 0.5) for x, y in corners]
    off = rng.random(len(corners)) < moved_share
    seen_at = np.concatenate([np.array(corner) + rng.uniform(0.05, 0.45, (60, 2)) - np.array([0.6, 0.5]) * there
                              for corner, there in zip(corners, off)])
    chainage = np.clip(seen_at[:, 0] - x0, 0.0, 199.0)
    time = np.interp(chainage, path_chainage(drive.true), drive.true.time)
    order = np.argsort(time, kind="stable")
    seen_at, time = seen_at[order], time[order]
    count = np.ones(len(time))
    points = PointObservations.of(MarkingPoints(*seen_at.T, 10.0 * count, time, count, 0 * count), drive.true,
                                  path_parameters_of(drive.true, 1.0), 2.0, Reference.from_polygons(marks),
                                  RegistrationSettings())
    found = moved_markings(points, lambda at: np.zeros((len(at), 6)), np.ones(len(points.path_parameter), bool))
    if not moved_share:
        assert found is None
        return
    assert found.shift == pytest.approx([0.6, 0.5], abs=0.11) and found.share == pytest.approx(0.4, abs=0.1)
    made = adjusted(drive)
    told = with_moved(made, found)
    assert (made.status == REGISTERED).any() and not (told.status == REGISTERED).any() and len(told.steps) == 1


@pytest.mark.slow
def test_walls_decide_against_markings_that_slipped_by_metres():
    drive = shifted(simulate(7, crossings=25.0, turn=None), 350.0, 501.0, (0.2, 3.0))
    planes, edges = street(drive)
    alone, heard = adjusted(drive), adjusted(drive, WallWitness(planes, edges))
    slipped = drive.windows.chainage > 360.0
    assert alone.steps and not (alone.status == REGISTERED).any()  # one side is wrong, and nobody knows which
    assert off(drive, alone)[slipped].mean() > 2.0
    assert heard.steps == () and off(drive, heard)[slipped].mean() < 0.2
    assert (heard.status == REGISTERED)[drive.windows.chainage < 320.0].mean() > 0.9
    ratio = np.abs(heard.value - drive.error)[:, :2] / heard.sigma()[:, :2]
    assert (ratio < 3)[slipped].mean() > 0.95 and (ratio < 3)[heard.status == REGISTERED].all()
