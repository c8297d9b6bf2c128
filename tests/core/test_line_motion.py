"""Relative motion of a drive, what it is tied to on the ground, and its heights."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.mobile.lines.course_heights import course_heights
from urbanmap_qgis.mobile.lines.ground_truths import misfit, rotated_vectors, set_drift, two_pair_drift
from urbanmap_qgis.mobile.lines.relative_motion import adjust_relative_motion
from urbanmap_qgis.mobile.lines.tie_points import ends_of, pairs_within, read_tie_points, tie_points_from_columns
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress


def course(count=60):
    time = np.arange(count) * 0.5
    heading = 20 + 60 * np.sin(np.arange(count) / 15)
    step = 3.0 * np.column_stack([np.sin(np.radians(heading)), np.cos(np.radians(heading)), 0 * heading])
    return Trajectory(time, np.array([5000.0, -3000.0, 7.0]) + np.cumsum(step, axis=0),
                      np.column_stack([0 * time, 0 * time + 1.0, heading]))


def matrices(trajectory):
    kappa = np.radians(90 - trajectory.angles[:, 2])
    made = np.zeros((len(kappa), 3, 3))
    x, y = trajectory.place[:, :2].T
    made[:, 0] = np.column_stack([np.cos(kappa), -np.sin(kappa), x])
    made[:, 1] = np.column_stack([np.sin(kappa), np.cos(kappa), y])
    made[:, 2, 2] = 1
    return made


def pose(x, y, kappa):
    return np.array([[np.cos(kappa), -np.sin(kappa), x], [np.sin(kappa), np.cos(kappa), y], [0, 0, 1.0]])


def paper(t, s, e, true_e, rounds=30):
    """Eq. 8 to 10 with matrices: each step takes 1 / (e - s) of the numbers of the loop closed through the steps."""
    steps = [np.linalg.inv(t[i]) @ t[i + 1] for i in range(s, e)]
    for _ in range(rounds):
        chain = [t[s]]
        for step in steps:
            chain.append(chain[-1] @ step)
        new = []
        for i, step in enumerate(steps):
            # t_(i+1,i+2) ... t_(e-1,e) T_e'^-1 T_s t_(s,s+1) ... t_(i-1,i), inverted, and t_(i,i+1)^-1.
            after = np.eye(3)
            for later in steps[i + 1:]:
                after = after @ later
            loop = np.linalg.inv(after @ np.linalg.inv(true_e) @ chain[i]) @ np.linalg.inv(step)
            part = np.array([loop[0, 2], loop[1, 2], np.arctan2(loop[1, 0], loop[0, 0])]) / (e - s)
            new.append(pose(*part) @ step)
        steps = new
    chain = [t[s]]
    for step in steps:
        chain.append(chain[-1] @ step)
    return np.array(chain)


@pytest.mark.paper("Z 3.1, eq. 8, 9")
def test_iteration_is_the_paper_s():
    trajectory = course(25)
    end = trajectory.place[24, :2] + [1.2, -0.8]
    kappa = np.radians(90 - trajectory.angles[24, 2] + 2.0)
    drift = np.array([[0, 0, 0], [1.2, -0.8, np.radians(2.0)]])
    iterated = matrices(adjust_relative_motion(trajectory, [0, 24], drift))
    np.testing.assert_allclose(iterated, paper(matrices(trajectory), 0, 24, pose(*end, kappa)), atol=2e-5)


def test_ground_truths_are_met_and_the_ends_are_rigid():
    trajectory, epochs = course(), np.array([10, 30, 45])
    drift = np.array([[1.0, 2.0, 0.01], [-0.5, 1.0, -0.02], [0.3, 0.1, 0.015]])
    made = adjust_relative_motion(trajectory, epochs, drift)
    np.testing.assert_allclose(made.place[epochs, :2], trajectory.place[epochs, :2] + drift[:, :2], atol=2e-5)
    heading = trajectory.angles[epochs, 2] - np.degrees(drift[:, 2])
    np.testing.assert_allclose(made.angles[epochs, 2], heading, atol=1e-5)
    old, new = matrices(trajectory), matrices(made)
    for part in (slice(0, 11), slice(45, 60)):
        a, b = ([np.linalg.inv(t[k]) @ t[k + 1] for k in range(len(t) - 1)] for t in (old[part], new[part]))
        np.testing.assert_allclose(a, b, atol=1e-6)
    np.testing.assert_array_equal(made.place[:, 2], trajectory.place[:, 2])
    np.testing.assert_array_equal(made.angles[:, :2], trajectory.angles[:, :2])
    np.testing.assert_array_equal(made.time, trajectory.time)


def test_pure_shift_is_shared_by_epoch():
    trajectory = course()
    made = adjust_relative_motion(trajectory, [0, 59], np.array([[0, 0, 0], [2.0, 1.0, 0.0]]))
    share = np.linspace(0.0, 1.0, len(trajectory))
    np.testing.assert_allclose((made.place - trajectory.place)[:, :2], np.outer(share, [2.0, 1.0]), atol=1e-9)


def test_epochs_must_increase():
    with pytest.raises(InputError, match="different epochs"):
        adjust_relative_motion(course(), [5, 5], np.zeros((2, 3)))
    one = adjust_relative_motion(course(), [5], np.array([[1.0, 0, 0]]))
    np.testing.assert_allclose(one.place - course().place, np.tile([1.0, 0, 0], (60, 1)), atol=1e-9)


PLACE = np.array([[100.0, 200.0], [103.0, 206.0]])
SEEN = np.array([[-8.0, 1.0], [9.0, 5.0]])


def pairs(shift, turn, place=PLACE, seen=SEEN):
    """Reported positions, places in the survey and in the reference, when position and heading are off by so much."""
    return place, place + seen, place + np.array(shift) + rotated_vectors(seen, turn)


@pytest.mark.paper("Z 3.2, eq. 11 to 17")
@pytest.mark.parametrize("turn", [0.01, -0.01, 0.3, -2.0])
def test_two_pairs_give_shift_and_turn_with_its_sign(turn):
    """Eq. 15's arc cosine would give the same for both signs."""
    shift, found = two_pair_drift(*pairs([1.5, -0.7], turn))
    np.testing.assert_allclose([*shift, found], [1.5, -0.7, turn], atol=1e-10)
    drift = set_drift(*pairs([1.5, -0.7], turn), sigma=0.1)
    np.testing.assert_allclose([*drift.shift, drift.rotation], [1.5, -0.7, turn], atol=1e-10)


@pytest.mark.paper("Z 3.2, eq. 11 to 17")
def test_equations_15_to_17_as_printed_where_the_turn_is_positive():
    """Eq. 16 and 17 with the places in the vehicle's axes, kappa_1 = 0.4."""
    place, measured, reference = pairs([1.5, -0.7], 0.02)
    v, v_true, v_o = measured[1] - measured[0], reference[1] - reference[0], place[1] - place[0]
    unit = [(w - v_o) / np.hypot(*(w - v_o)) for w in (v_true, v)]
    dkappa = np.arccos(unit[0] @ unit[1])
    kappa = 0.4
    px, py = rotated_vectors(measured[0] - place[0], -kappa)
    dx = reference[0, 0] - place[0, 0] - px * np.cos(kappa + dkappa) + py * np.sin(kappa + dkappa)
    dy = reference[0, 1] - place[0, 1] - px * np.sin(kappa + dkappa) - py * np.cos(kappa + dkappa)
    shift, turn = two_pair_drift(place, measured, reference)
    np.testing.assert_allclose([dx, dy, dkappa], [*shift, turn], atol=1e-9)


def test_more_pairs_are_least_squares():
    """Against a general minimiser, with noise."""
    from scipy.optimize import least_squares

    rng = np.random.default_rng(1)
    place, seen = rng.normal(0, 5, (6, 2)) + 1000, rng.normal(0, 10, (6, 2))
    place, measured, reference = pairs([0.4, 0.9], 0.03, place, seen)
    reference = reference + rng.normal(0, 0.1, reference.shape)

    def left(p):
        return (reference - place - p[:2] - rotated_vectors(seen, p[2])).ravel()

    best = least_squares(left, [0, 0, 0.0], xtol=1e-14, ftol=1e-14, gtol=1e-14)
    drift = set_drift(place, measured, reference, 0.1)
    np.testing.assert_allclose([*drift.shift, drift.rotation], best.x, atol=1e-6)
    np.testing.assert_allclose(drift.covariance, 0.01 * np.linalg.inv(best.jac.T @ best.jac), rtol=1e-2, atol=1e-8)


def test_covariance_is_what_repetition_shows():
    rng = np.random.default_rng(2)
    place, measured, reference = pairs([0.4, 0.9], 0.03)
    found = []
    for _ in range(4000):
        drift = set_drift(place, measured, reference + rng.normal(0, 0.05, (2, 2)), 0.05)
        found.append([*drift.shift, drift.rotation])
    np.testing.assert_allclose(np.cov(np.array(found).T), drift.covariance, rtol=0.12, atol=2e-5)


def test_what_is_expected_of_the_heading_holds_pairs_that_lie_together():
    place, measured, reference = pairs([1.0, 0.0], 0.0, seen=np.array([[-8.0, 1.0], [-8.0, 1.2]]))
    reference[1, 0] += 0.1
    free, held = (set_drift(place, measured, reference, 0.05, sigma).rotation for sigma in (np.inf, np.radians(1.0)))
    assert abs(free) > 0.4 and abs(held) < np.radians(1.0)
    single = set_drift(place[:1], measured[:1], reference[:1], 0.05, np.radians(1.0))
    assert single.rotation == 0 and single.covariance[2, 2] == pytest.approx(np.radians(1.0) ** 2)
    np.testing.assert_allclose(single.shift, [1.0, 0.0])


def test_misfit_is_the_difference_of_lengths_or_the_distance_from_the_others():
    place, measured, reference = pairs([1.0, 2.0], 0.1)
    np.testing.assert_allclose(misfit(place, measured, reference), 0, atol=1e-9)
    along = rotated_vectors(SEEN[1] - SEEN[0], 0.1)
    reference[1] += 0.7 * along / np.hypot(*along)
    np.testing.assert_allclose(misfit(place, measured, reference), 0.7, atol=1e-9)
    rng = np.random.default_rng(3)
    place, measured, reference = pairs([1.0, 2.0], 0.1, np.zeros((5, 2)), rng.normal(0, 10, (5, 2)))
    reference[3] += [3.0, 4.0]
    away = misfit(place, measured, reference)
    assert away.argmax() == 3 and away[3] == pytest.approx(5.0)
    assert misfit(place[:1], measured[:1], reference[:1]).tolist() == [0]


ROWS = "set,time,x_mms,y_mms,x_ref,y_ref\nb,12,1,2,3,4\nb,11,5,6,7,8\n角,3,9,10,11,12\n"
DRIVE = Trajectory(np.array([0.0, 1, 2, 3, 4, 10, 11, 12]), np.zeros((8, 3)), np.zeros((8, 3)))


def test_tables_are_read_in_the_order_of_time(tmp_path):
    for name, text in (("t.csv", ROWS), ("t.txt", ROWS.replace(",", ";")), ("b.csv", "﻿" + ROWS.upper())):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        ties = read_tie_points(path)
        assert ties.time.tolist() == [3, 11, 12] and ties.measured[0].tolist() == [9, 10]
        names, number = ties.numbers()
        assert [item.lower() for item in names] == ["角", "b"] and number.tolist() == [0, 1, 1]


def test_lines_run_from_survey_to_reference():
    ends = ends_of([shapely.LineString([(1, 2), (0, 0), (3, 4)]), shapely.from_wkt("MULTILINESTRING((5 6,7 8))"), None])
    np.testing.assert_array_equal(ends["x_mms"], [1, 5, np.nan])
    np.testing.assert_array_equal(ends["y_ref"], [4, 8, np.nan])


@pytest.mark.parametrize(("text", "sentence"), [
    ("set,time,x_mms,y_mms,x_ref\n1,2,3,4,5\n", "no column y_ref"), (ROWS.replace("5", "x"), "no number"),
    (ROWS.replace("5", ""), "no number"), ("set,time,x_mms,y_mms,x_ref,y_ref\n", "no tie points"),
    (ROWS.replace("11,12", "11"), "as many values"), (ROWS.replace("11,12", "11,500"), "set 角 survey and reference"),
])
def test_bad_tables(tmp_path, text, sentence):
    (tmp_path / "t.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=sentence):
        read_tie_points(tmp_path / "t.csv")


def ties_at(*times):
    count = len(times)
    return tie_points_from_columns({"set": [str(k) for k in range(count)], "time": times, **dict.fromkeys(
        ("x_mms", "y_mms", "x_ref", "y_ref"), [0.0] * count)})


def test_pairs_outside_the_time_or_in_gaps_are_left_out_and_told():
    told = []
    left = pairs_within(ties_at(-1.0, 2.5, 7.0, 11.0, 99.0), DRIVE, Progress(warn=told.append))
    assert left.time.tolist() == [2.5, 11.0]
    assert "2 tie points lie outside" in told[0] and "(set 0, 4)" in told[0] and "gap" in told[1]


def test_no_pair_within_the_time_is_refused():
    with pytest.raises(InputError, match="one survey"):
        pairs_within(ties_at(50.0, 60.0), DRIVE)
    with pytest.raises(InputError, match="gaps"):
        pairs_within(ties_at(7.0), DRIVE)


def test_times_of_the_week_and_adjusted_times_are_brought_together():
    """Tie points in adjusted standard time, the trajectory in seconds of the week."""
    start = 2200 * 604800.0 - 1e9
    told = []
    left = pairs_within(ties_at(start + 1.0, start + 2.5), DRIVE, Progress(warn=told.append))
    assert f"{-start:.0f} s were added" in told[0]
    np.testing.assert_allclose(left.time, [1.0, 2.5])


HEIGHT = 1.9


def hills(x, y):
    return 20 + 5 * np.sin(np.asarray(x) / 150) + 0.01 * np.asarray(y)


def drive(error, seconds=300.0):
    """East at 8 m/s with a wait of a minute; heights off by `error(time)`."""
    time = np.arange(0.0, seconds, 0.1)
    way = 8.0 * np.interp(time, [0, 100, 160, seconds], [0, 100, 100, seconds - 60])
    place = np.column_stack([way, 0 * way, hills(way, 0) + HEIGHT + error(time)])
    return Trajectory(time, place, np.tile([0, 0, 90.0], (len(time), 1)))


def wander(time):
    return 0.8 + 0.3 * np.sin(time / 50)


def test_error_is_found_with_its_sigma():
    rng = np.random.default_rng(0)
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: hills(x, y) + rng.normal(0, 0.03, len(x)), HEIGHT)
    left = made.error + wander(trajectory.time)
    assert np.sqrt(np.mean(left**2)) < 0.03 and 0.5 < np.sqrt(np.mean((left / made.sigma) ** 2)) < 1.6
    assert made.sample_sigma == pytest.approx(0.03, rel=0.3) and made.after < 0.04 < 0.7 < made.before
    assert made.covered == 1.0 and not made.found and made.left_out < 0.03 * made.samples
    assert made.samples == pytest.approx(240 * 8 / 2 + 60 / 5, abs=3)


def test_vehicles_and_bridges_on_a_surface_model_are_left_out():
    """A third of the course under parked vehicles, and a bridge 2.5 m above it over 60 m."""
    rng = np.random.default_rng(1)

    def surface(x, y):
        standing = (np.asarray(x) % 30 < 10) * rng.uniform(1.3, 2.0, len(x))
        return hills(x, y) + rng.normal(0, 0.02, len(x)) + np.where((x > 500) & (x < 560), 2.5, standing)

    trajectory = drive(wander)
    made = course_heights(trajectory, surface, HEIGHT)
    left = made.error + wander(trajectory.time)
    assert np.sqrt(np.mean(left**2)) < 0.05 and np.abs(left).max() < 0.2
    assert 0.3 < made.left_out / made.samples < 0.45


def test_a_bridge_far_above_is_not_driven_on():
    """Over most of the course a deck 6 m above: only the part without it counts, and its sigma is larger under it."""
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: hills(x, y) + 6.0 * ((x > 300) & (x < 1700)), HEIGHT)
    left = made.error + wander(trajectory.time)
    outside = (trajectory.place[:, 0] < 290) | (trajectory.place[:, 0] > 1710)
    assert np.abs(left[outside]).max() < 0.02
    assert made.sigma[~outside].max() > 5 * made.sigma[outside].mean()
    assert np.abs(left[~outside]).max() < 4 * made.sigma[~outside].max()


def test_without_the_sensor_s_height_the_mean_stays():
    trajectory = drive(wander)
    made = course_heights(trajectory, hills, None)
    moved = np.diff(trajectory.place[:, 0], prepend=0.0) > 0
    assert made.found and abs(np.median(made.error[moved])) < 0.05
    np.testing.assert_allclose(np.diff(made.error), -np.diff(wander(trajectory.time)), atol=0.01)


def test_gaps_of_the_ground_are_bridged_with_a_larger_sigma():
    trajectory = drive(wander)
    made = course_heights(trajectory, lambda x, y: np.where((x > 400) & (x < 1200), np.nan, hills(x, y)), HEIGHT)
    inside = (trajectory.place[:, 0] > 450) & (trajectory.place[:, 0] < 1150)
    assert made.covered == pytest.approx(1 - 800 / 1920, abs=0.01)
    assert made.sigma[inside].min() > 2 * np.median(made.sigma[trajectory.place[:, 0] < 350])


def test_a_ground_elsewhere_or_at_another_level_is_refused():
    with pytest.raises(InsufficientDataError, match="does not reach"):
        course_heights(drive(wander), lambda x, y: np.full(len(x), np.nan), HEIGHT)
    with pytest.raises(InsufficientDataError, match="40.. m above the ground"):
        course_heights(drive(wander), lambda x, y: hills(x, y) - 38.0, HEIGHT)
