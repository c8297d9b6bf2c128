"""Windows of a simulated street registered to its reference: accuracy, honesty, the trap of repeating dashes."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace

import numpy as np
import pytest
import shapely
from pyproj import CRS
from scipy.optimize import minimize
from scipy.spatial import cKDTree
from shapely import affinity

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import write_raster
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.correction.patch_status import DISTRUSTED, plan_sigma
from urbanmap_qgis.mobile.registration.matching import sections
from urbanmap_qgis.mobile.registration.records import (
    AMBIGUOUS,
    NO_MARKINGS,
    REGISTERED,
    RegistrationSettings,
    WindowResults,
)
from urbanmap_qgis.mobile.registration.register import register_windows
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.patches import divide_path
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, move_points, rotations
from urbanmap_qgis.progress import Progress

ORIGIN = np.array([-7000.0, -34000.0])
HEADING = 37.0
SPEED = 8.0


def along_street(along, across):
    """Map coordinates of places in the street's own: along its axis and to the right of it, m."""
    h = np.radians(HEADING)
    forward, right = np.array([np.sin(h), np.cos(h)]), np.array([np.cos(h), -np.sin(h)])
    return ORIGIN + np.multiply.outer(along, forward) + np.multiply.outer(across, right)


def bar(along, across, length, width):
    """A painted rectangle in the map."""
    corners = [(along - length / 2, across - width / 2), (along + length / 2, across - width / 2),
               (along + length / 2, across + width / 2), (along - length / 2, across + width / 2)]
    return shapely.Polygon([along_street(a, c) for a, c in corners])


def lines(length):
    """Two solid edge lines."""
    return [bar(length / 2, across, length + 200, 0.15) for across in (-7.0, 7.0)]


def dashes(length, period=10.0):
    """Two rows of dashes, in step."""
    return [bar(along, across, period / 2, 0.15) for along in np.arange(-100, length + 100, period)
            for across in (-3.5, 3.5)]


def crossings(length, every=60.0):
    """A stop line and a zebra crossing every so often."""
    stop = [bar(along, 3.5, 0.45, 6.5) for along in np.arange(15.0, length + 30, every)]
    zebra = [bar(along + 4, across, 3.0, 0.45) for along in np.arange(15.0, length + 30, every)
             for across in np.arange(-6, 6.5, 0.9)]
    return stop + zebra


def true_trajectory(length, wait_at=None, wait=10.0):
    """Along the axis at 8 m/s, 2 m above a level road of height 12; a wait if wanted."""
    time = np.arange(0, length / SPEED + (wait if wait_at is not None else 0), 0.02)
    along = SPEED * time
    if wait_at is not None:
        along = np.where(along > wait_at, np.maximum(wait_at, along - SPEED * wait), along)
    angles = np.column_stack([np.zeros_like(time), np.zeros_like(time), np.full_like(time, HEADING)])
    return Trajectory(361000.0 + time, np.column_stack([along_street(along, np.zeros_like(along)),
                                                        np.full_like(time, 14.0)]), angles)


def reported_trajectory(true, error):
    """The true one with an error (n, 6) taken off: corrections of the registration should equal `error`."""
    return Trajectory(true.time, true.place - error[:, :3], true.angles - error[:, 3:])


def seen(polygons, true, reported, density=100.0, reach=12.0, noise=0.01, seed=1, share=1.0, stray=0.0):
    """Points on paint as the reported trajectory places them, each measured about 5 m before the vehicle is there.

    `share` of them is kept, and `stray` times as many lie anywhere on the road.
    """
    rng = np.random.default_rng(seed)
    local = []
    for polygon in polygons:
        upright = affinity.rotate(polygon, HEADING, origin=tuple(ORIGIN))
        x0, y0, x1, y1 = upright.bounds
        number = rng.poisson(density * (x1 - x0) * (y1 - y0))
        at = np.column_stack([rng.uniform(x0, x1, number), rng.uniform(y0, y1, number)])
        local.append(at[shapely.contains_xy(upright, at[:, 0], at[:, 1])] - ORIGIN)
    local = np.concatenate(local)
    count = int(stray * len(local))
    more = np.column_stack([rng.uniform(-8, 8, count), rng.uniform(local[:, 1].min(), local[:, 1].max(), count)])
    across, along = np.concatenate([local, more]).T
    h = np.radians(HEADING)
    places = (ORIGIN + np.multiply.outer(along, [np.sin(h), np.cos(h)])
              + np.multiply.outer(across, [np.cos(h), -np.sin(h)]))
    vehicle = (true.place[:, :2] - ORIGIN) @ [np.sin(h), np.cos(h)]
    passed = along - 5 - rng.uniform(0, 1.5, len(along))
    moving = np.r_[True, np.diff(vehicle) > 0]
    time = np.interp(passed, vehicle[moving], true.time[moving])
    keep = ((passed > vehicle[0]) & (passed < vehicle[-1]) & (np.abs(across) < reach)
            & (rng.uniform(size=len(along)) < share))
    points = np.column_stack([places + rng.normal(0, noise, places.shape), np.full(len(places), 12.0)])[keep]
    points[:, 2] += rng.normal(0, noise, len(points))
    time = time[keep]
    moved = move_points(points, time, true, reported)
    order = np.argsort(time, kind="stable")
    moved, time = moved[order], time[order]
    return MarkingPoints(moved[:, 0], moved[:, 1], moved[:, 2], time, np.ones(len(time)), np.ones(len(time), int))


def slow_error(true, east=1.1, north=-0.7, up=0.0, heading=0.1):
    """An error that drifts by a few decimetres in a hundred metres."""
    t = true.time - true.time[0]
    wave = np.sin(2 * np.pi * t / 40.0)
    return np.column_stack([east + 0.25 * wave, north + 0.2 * np.cos(2 * np.pi * t / 50.0), up + 0.1 * wave,
                            np.zeros_like(t), np.zeros_like(t), heading + 0.03 * wave])


def errors(result, true):
    """(n, 6) of the rows' corrections, and (n, 2) in plan along the street and across it."""
    pose = interpolate(true, result.time)
    off = result.correction - np.column_stack([pose.place - result.place, pose.angles - result.angles])
    h = np.radians(HEADING)
    return off, off[:, :2] @ np.array([[np.sin(h), np.cos(h)], [np.cos(h), -np.sin(h)]])


def along_sigma(result):
    h = np.radians(HEADING)
    forward = np.array([np.sin(h), np.cos(h)])
    return np.sqrt(forward @ result.covariance[:, :2, :2] @ forward)


@pytest.fixture(scope="module")
def street():
    """True and reported trajectory, paint, and what was seen of it with some stray points."""
    true = true_trajectory(120.0, wait_at=50.0)
    reported = reported_trajectory(true, slow_error(true))
    paint = lines(120) + dashes(120, 5.0) + crossings(120)
    return true, reported, paint, seen(paint, true, reported, stray=0.05)


@pytest.fixture(scope="module")
def registered(street):
    _, reported, paint, markings = street
    return register_windows(markings, reported, Reference.from_polygons(paint))


def test_corrections_are_the_errors_and_sigmas_cover_them(street, registered):
    off, plan = errors(registered, street[0])
    assert (registered.status == REGISTERED).all()
    assert np.hypot(*plan.T).mean() < 0.035 and np.abs(plan).max() < 0.1
    assert np.abs(off[:, 5]).mean() < 0.05
    chi = np.einsum("ni,nij,nj->n", off[:, :2], np.linalg.inv(registered.covariance[:, :2, :2]), off[:, :2])
    assert (chi < 6.0).mean() > 0.95
    assert np.median(registered.sigma()[:, :2]) < 0.05
    assert np.isnan(registered.correction[:, 2:5]).all()


def test_rows_follow_the_driven_way_not_time(street, registered):
    assert np.allclose(np.diff(registered.chainage)[:-1], 0.5)
    assert (np.diff(registered.time) > 0).all() and np.diff(registered.time).max() > 9.0  # the wait
    patch = np.arange(len(registered))
    assert (registered.window_first <= patch).all() and (registered.window_last >= patch).all()
    assert (registered.window_length <= 100.0).all()
    assert (registered.overlap > 0.8).all() and (registered.score > 0.5).all()


def test_own_place_comes_first_among_the_modes(registered):
    assert np.allclose(registered.modes[:, 0], registered.correction[:, :2])
    others = np.nan_to_num(registered.mode_scores[:, 1:], nan=-np.inf)
    assert (others < registered.mode_scores[:, :1]).all()


@pytest.mark.parametrize("direction", [0.3, 2.4, 4.4])
def test_three_metres_of_error_are_found(street, direction):
    true, _, paint, _ = street
    error = slow_error(true, 0.0, 0.0)
    error[:, :2] += 3.0 * np.array([np.cos(direction), np.sin(direction)]) - error[:, :2].mean(axis=0)
    reported = reported_trajectory(true, error)
    result = register_windows(seen(paint, true, reported), reported, Reference.from_polygons(paint))
    assert np.abs(errors(result, true)[1]).max() < 0.08


@pytest.mark.parametrize(("far", "found"), [(6.0, True), (12.0, False)])
def test_farther_off_than_the_search_is_looked_for_farther_or_told(street, far, found):
    """With a search of 4 m: 6 m of error are found in the wider one, 12 m lie beyond it and are never right."""
    true, _, _, _ = street
    h, error = np.radians(HEADING), slow_error(true, 0.0, 0.0)
    error[:, :2] += far * np.array([np.sin(h), np.cos(h)]) - error[:, :2].mean(axis=0)
    reported = reported_trajectory(true, error)
    paint = [*lines(120), *dashes(120, 5.0), bar(40.0, 3.5, 0.45, 6.5), bar(72.0, 3.5, 2.0, 2.0)]
    result = register_windows(seen(paint, true, reported), reported, Reference.from_polygons(paint))
    if found:
        assert result.search == 8.0 and not result.beyond
        assert np.abs(errors(result, true)[1]).max() < 0.15
    else:
        assert result.beyond or (result.status != REGISTERED).all()


def test_lane_lines_alone_tell_nothing_along_the_road(street):
    true, reported, _, _ = street
    paint = lines(120)
    result = register_windows(seen(paint, true, reported), reported, Reference.from_polygons(paint))
    _, plan = errors(result, true)
    assert (result.status == AMBIGUOUS).all() and (along_sigma(result) > 1.0).all()
    assert np.abs(plan[:, 1]).max() < 0.05  # across they do


def test_a_slip_by_one_dash_is_never_taken_for_certain(street):
    """Endless dashes of 2.5 m in a period of 5 m, the error 2.4 m along the road: both places fit alike."""
    true, _, _, _ = street
    h = np.radians(HEADING)
    error = slow_error(true, 0.0, 0.0)
    error[:, :2] += 2.4 * np.array([np.sin(h), np.cos(h)]) - error[:, :2].mean(axis=0)
    reported = reported_trajectory(true, error)
    inside = [bar(along, across, 2.5, 0.15) for along in np.arange(-100, 220, 5.0) for across in (-3.5, 3.5)]
    markings = seen(inside, true, reported)
    result = register_windows(markings, reported, Reference.from_polygons(inside))
    truth = interpolate(true, result.time).place - result.place
    nearest = np.nanmin(np.hypot(*np.moveaxis(result.modes - truth[:, None, :2], 2, 0)), axis=1)
    slipped = np.abs(errors(result, true)[1][:, 0]) > 1.0
    assert (result.status[slipped] == AMBIGUOUS).all()
    assert (along_sigma(result) > 1.0).all()
    assert np.median(nearest) < 0.3  # the truth is among the modes


def test_one_stop_line_decides_between_dashes(street):
    true, _, _, _ = street
    h = np.radians(HEADING)
    error = slow_error(true, 0.0, 0.0)
    error[:, :2] += 2.9 * np.array([np.sin(h), np.cos(h)]) - error[:, :2].mean(axis=0)
    reported = reported_trajectory(true, error)
    paint = [*dashes(120, 5.0), bar(70.0, 3.5, 0.45, 6.5), bar(72.0, 3.5, 2.0, 2.0)]
    result = register_windows(seen(paint, true, reported), reported, Reference.from_polygons(paint))
    assert np.abs(errors(result, true)[1]).max() < 0.15
    assert (result.margin > 3).all()


def test_paint_that_was_moved_draws_little_and_widens_sigma(street):
    true, reported, paint, _ = street
    rng = np.random.default_rng(4)
    moved = [affinity.translate(p, 0.25, 0.15) if rng.uniform() < 0.35 else p for p in paint]
    result = register_windows(seen(moved, true, reported), reported, Reference.from_polygons(paint))
    _, plan = errors(result, true)
    assert np.hypot(*plan.T).mean() < 0.05
    off = errors(result, true)[0]
    chi = np.einsum("ni,nij,nj->n", off[:, :2], np.linalg.inv(result.covariance[:, :2, :2]), off[:, :2])
    assert (chi < 6.0).mean() > 0.9


def test_stretch_without_reference_is_said(street):
    _, reported, paint, markings = street
    near = [p for p in paint if (np.array(p.centroid.coords[0]) - ORIGIN) @ [np.sin(np.radians(HEADING)),
                                                                          np.cos(np.radians(HEADING))] < 10]
    near = [p for p in near if shapely.length(p) < 60]
    result = register_windows(markings, reported, Reference.from_polygons(near))
    far = result.chainage > 100
    assert not (result.status[far] == REGISTERED).any()
    lost = result.status == NO_MARKINGS
    assert np.isnan(result.correction[lost]).all() and np.isnan(result.covariance[lost]).all()


def in_space(street, tmp_path, up):
    true, _, paint, _ = street
    error = slow_error(true, up=up)
    error[:, 3:5] = [0.06, -0.05]
    reported = reported_trajectory(true, error)
    return true, reported, seen(paint, true, reported), Reference.from_polygons(paint, level_ground(tmp_path))


def level_ground(folder):
    """Raster of the road's height."""
    grid = Grid(ORIGIN[0] - 60, ORIGIN[1] + 200, 1.0, 300, 200)
    write_raster(folder / "ground.tif", np.full(grid.shape, 12.0, np.float32), grid, CRS.from_epsg(6677).to_wkt())
    return folder / "ground.tif"


@pytest.mark.paper("J 4.1")
def test_in_space(street, tmp_path):
    true, reported, markings, reference = in_space(street, tmp_path, 0.9)
    result = register_windows(markings, reported, reference, RegistrationSettings(three_d=True))
    off, plan = errors(result, true)
    assert result.three_d and np.isfinite(result.correction).all()
    assert np.abs(plan).max() < 0.08 and np.abs(off[:, 2]).max() < 0.05
    assert np.abs(off[:, 3]).mean() < 0.05
    sigma = result.sigma()
    assert (np.abs(off[:, 2]) < 2 * sigma[:, 2]).mean() > 0.95


def test_heights_of_another_datum_are_refused(street, tmp_path):
    _, reported, markings, reference = in_space(street, tmp_path, -37.0)
    with pytest.raises(InputError, match="37.0 m above"):
        register_windows(markings, reported, reference, RegistrationSettings(three_d=True))


def test_in_space_needs_heights(street):
    _, reported, paint, markings = street
    with pytest.raises(InputError, match="heights"):
        register_windows(markings, reported, Reference.from_polygons(paint), RegistrationSettings(three_d=True))


def test_no_reference_near_and_times_apart(street):
    _, reported, paint, markings = street
    away = Reference.from_polygons([affinity.translate(paint[0], 5000, 0)])
    with pytest.raises(InsufficientDataError, match="reference"):
        register_windows(markings, reported, away)
    later = replace(markings, time=markings.time + 1e5)
    with pytest.raises(InsufficientDataError, match="time"):
        register_windows(later, reported, Reference.from_polygons(paint))


def test_an_executor_changes_nothing(street, registered, monkeypatch):
    _, reported, paint, markings = street
    reference = Reference.from_polygons(paint)
    with ThreadPoolExecutor(2) as executor:
        other = register_windows(markings, reported, reference, executor=executor)
    for field in fields(WindowResults):
        assert np.allclose(getattr(registered, field.name), getattr(other, field.name), rtol=1e-6, equal_nan=True)
    monkeypatch.setattr(sections, "_SECTION_PATCHES", 90)  # another cut
    cut = register_windows(markings, reported, reference)
    assert np.abs(cut.correction[:, :2] - registered.correction[:, :2]).max() < 0.02


def test_cancel_and_progress(street):
    _, reported, paint, markings = street
    told = []
    register_windows(markings, reported, Reference.from_polygons(paint), progress=Progress(report=told.append))
    assert told == sorted(told) and told[-1] == 1.0
    with pytest.raises(Cancelled):
        register_windows(markings, reported, Reference.from_polygons(paint),
                         progress=Progress(cancelled=lambda: True))


@pytest.fixture(scope="module")
def short_street():
    """60 m of street with an error of two decimetres: true and reported trajectory, paint, marking points."""
    true = true_trajectory(60.0)
    reported = reported_trajectory(true, slow_error(true, 0.2, -0.15, heading=0.1))
    paint = lines(60) + dashes(60, 5.0) + crossings(60, 30.0)
    return true, reported, paint, seen(paint, true, reported)


def test_to_the_letter_windows_are_rigid_and_on_their_own(short_street):
    true, reported, paint, markings = short_street
    paper = register_windows(markings, reported, Reference.from_polygons(paint), RegistrationSettings.paper())
    ours = register_windows(markings, reported, Reference.from_polygons(paint))
    letter, better = (np.hypot(*errors(r, true)[1].T).mean() for r in (paper, ours))
    assert letter < 0.25 and better < letter
    assert not paper.information.any()


def plain_cost(points, reference, centre, settings):
    """J eq. 5 to 7 and 10 to 12 written plainly: the cost of a shift and an angle by the closest Gaussian, and d1."""
    cells = {}
    for point in reference:
        cells.setdefault(tuple(np.floor(point).astype(int)), []).append(point)
    cells = [np.array(cell) for cell in cells.values() if len(cell) >= 3]
    mean = np.array([cell.mean(axis=0) for cell in cells])
    spread = np.array([np.cov(cell.T) for cell in cells])
    values, vectors = np.linalg.eigh(spread)
    values = np.maximum(values, 1e-3 * values[:, 1:])
    inverse = np.einsum("nij,nj,nkj->nik", vectors, 1 / values, vectors)
    c1, c2 = 10 * (1 - settings.outlier_share), settings.outlier_share
    d3 = -np.log(c2)
    d1 = -np.log(c1 + c2) - d3
    d2 = -2 * np.log((-np.log(c1 * np.exp(-0.5) + c2) - d3) / d1)
    tree = cKDTree(mean)

    def cost(motion):
        c, s = np.cos(motion[2]), np.sin(motion[2])
        moved = (points - centre) @ np.array([[c, s], [-s, c]]) + centre + motion[:2]
        nearest = tree.query(moved)[1]
        off = moved - mean[nearest]
        return (d1 * np.exp(-d2 / 2 * np.einsum("ni,nij,nj->n", off, inverse[nearest], off))).sum()

    return cost, d1


@pytest.mark.paper("J 3.2.4.3, subsampling", "J 3.2.4.1, eq. 5, 6", "J 3.2.4.3, eq. 7, 10, 11", "J 3.2.4.3, eq. 12")
@pytest.mark.slow
def test_the_first_window_of_the_letter_is_the_papers_formula(short_street):
    _, reported, paint, markings = short_street
    settings, reference = RegistrationSettings.paper(), Reference.from_polygons(paint)
    made = register_windows(markings, reported, reference, settings)
    patch = divide_path(reported, 0.5).number_at(markings.time)
    window = np.column_stack([markings.x, markings.y])[patch <= made.window_last[0]]
    cell = np.floor((window - window.min(axis=0)) / 0.3).astype(int)
    thin = np.array([window[(cell == one).all(axis=1)].mean(axis=0) for one in np.unique(cell, axis=0)])
    low, high = window.min(axis=0) - 7, window.max(axis=0) + 7
    pixels = reference.coverage(*low, *high).points()
    cost, d1 = plain_cost(thin, pixels, made.place[0, :2], settings)
    letter = np.r_[made.correction[0, :2], -np.radians(made.correction[0, 5])]
    assert made.points[0] == len(thin)
    assert made.score[0] == pytest.approx(cost(letter) / (d1 * len(thin)), rel=1e-6)
    near = minimize(cost, letter, method="Nelder-Mead", options={
        "xatol": 1e-6, "fatol": 1e-6, "initial_simplex": letter + np.vstack([[0, 0, 0], np.diag([0.05, 0.05, 5e-3])])})
    assert letter == pytest.approx(near.x, abs=3e-3)
    assert cost(letter) < 1.5 * cost(np.zeros(3)) < 0


@pytest.mark.paper("J 3.2.4.3, eq. 8, 9", "J 4.2")
@pytest.mark.slow
@pytest.mark.parametrize("three_d", [False, True])
def test_the_letter_moves_each_patch_by_one_matrix(short_street, tmp_path, three_d):
    _, reported, paint, markings = short_street
    reference = Reference.from_polygons(paint, level_ground(tmp_path) if three_d else None)
    run = RegistrationRun(RegistrationSettings.paper(three_d=three_d))
    made = register_markings(markings, reported, reference, run)
    windows, rng = made.windows, np.random.default_rng(3)
    patch = divide_path(reported, 0.5).number_at(reported.time)
    movement = correction_between(made.reported, made.trajectory)
    for number in (3, 40, 77):
        # Away from the patch's ends, where poses are interpolated over the step to the next one.
        time = reported.time[patch == number][1:-1]
        points = windows.place[number] + rng.uniform(-10, 10, (len(time), 3))
        change = np.nan_to_num(windows.correction[number])
        if three_d:
            before, after = rotations(np.stack([windows.angles[number], windows.angles[number] + change[3:]]))
            matrix = after @ before.T
        else:
            angle = -np.radians(change[5])
            matrix = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        expected = (points - windows.place[number]) @ matrix.T + windows.place[number] + change[:3]
        assert points + movement.translations(points, time) == pytest.approx(expected, abs=1e-4)
    assert np.isnan(made.correction.drift_factor) and set(made.correction.status) <= {REGISTERED, DISTRUSTED}
    assert made.windows.three_d == three_d
    if three_d:
        own = divide_path(reported, 0.5).number_at(markings.time)
        inside = (own >= windows.window_first[60]) & (own <= windows.window_last[60])
        assert windows.window_last[60] - windows.window_first[60] + 1 >= 30
        assert windows.features[60] == inside.sum() >= 2000
        assert np.abs(windows.correction[:, 3:5]).max() > 0


@pytest.mark.slow
def test_the_letter_takes_a_survey_over_a_metre_off_in_height(short_street, tmp_path):
    _, reported, paint, markings = short_street
    reference = Reference.from_polygons(paint, level_ground(tmp_path))
    run = RegistrationRun(RegistrationSettings.paper(three_d=True))
    right = register_markings(markings, reported, reference, run)
    low = replace(reported, place=reported.place - [0.0, 0.0, 1.25])
    found = register_markings(replace(markings, z=markings.z - 1.25), low, reference, run)
    assert found.trajectory.place[:, 2] == pytest.approx(right.trajectory.place[:, 2], abs=0.01)
    assert np.array_equal(found.windows.status, right.windows.status)


@pytest.mark.paper("J 3.2.4.3, eq. 8, 9")
def test_the_letter_carries_the_matrix_over_windows_without_markings(short_street):
    _, reported, paint, markings = short_street
    along = (np.column_stack([markings.x, markings.y]) - ORIGIN) @ (along_street(1.0, 0.0) - ORIGIN)
    few = markings.select(along < 25)
    run = RegistrationRun(RegistrationSettings.paper(window_patches=10, feature_count=5))
    made = register_markings(few, reported, Reference.from_polygons(paint), run)
    empty = np.flatnonzero(made.windows.status == NO_MARKINGS)
    assert len(empty) > 10 and (made.correction.status[empty] == DISTRUSTED).all()
    assert np.ptp(made.correction.value[empty][-5:, 5]) < 1e-9


def test_sigmas_of_the_letter_cover_what_rigid_windows_over_a_drift_are_off_by():
    true = true_trajectory(120.0)
    reported = reported_trajectory(true, slow_error(true, 0.2, -0.15, heading=0.1))
    paint = lines(120) + dashes(120, 5.0) + crossings(120, 30.0)
    markings = seen(paint, true, reported)
    run = RegistrationRun(RegistrationSettings.paper(window_patches=20, feature_count=40))
    made = register_markings(markings, reported, Reference.from_polygons(paint), run)
    off = np.hypot(*errors(made.windows, true)[1].T)
    of_fit, told = plan_sigma(made.windows.covariance), made.correction.plan_sigma()
    assert np.mean(off < 2 * of_fit) < 0.85 and np.mean(off < 2 * told) > 0.9
    assert np.median(told) < 2 * off.mean()


def test_the_letter_gives_what_it_has_with_nothing_to_be_trusted(street):
    """Two edge lines fit everywhere along the street: there is a trajectory, and it says that it is nothing worth."""
    _, reported, paint, markings = street
    told = []
    run = RegistrationRun(RegistrationSettings.paper(window_patches=20, feature_count=40))
    made = register_markings(markings, reported, Reference.from_polygons(paint[:2]), run, Progress(warn=told.append))
    assert (made.correction.status == DISTRUSTED).all() and all(made.correction.reason)
    assert any("100 % of the path is not to be trusted" in text for text in told)


def test_a_drive_as_short_as_its_windows_does_not_say_how_accurate_the_letter_is(short_street):
    _, reported, paint, markings = short_street
    run = RegistrationRun(RegistrationSettings.paper(window_patches=120))
    made = register_markings(markings, reported, Reference.from_polygons(paint), run)
    assert np.isnan(made.correction.plan_sigma()).all() and (made.correction.status == DISTRUSTED).all()


@pytest.mark.parametrize("bad", [{"patch_length": 0.0}, {"outlier_share": 1.0}, {"max_window_patches": 10},
                                 {"iterations": 0}, {"search": float("nan")}])
def test_settings_that_mean_nothing_are_refused(bad):
    with pytest.raises(InputError):
        RegistrationSettings(**bad)


def test_columns_must_be_of_one_length():
    one, two = np.zeros(1), np.zeros(2)
    with pytest.raises(InputError):
        MarkingPoints(one, one, one, two, one, one)
