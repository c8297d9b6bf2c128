"""Rectification of simulated drives of 15 km and of the sample city, and what is wrong with tie points."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.lines.rectification import (
    BETWEEN,
    BLUNDER,
    CONTRADICTING,
    EXTRAPOLATED,
    ONE_PAIR,
    POSITION_ONLY,
    SUSPECT,
    USED,
    rectify,
)
from urbanmap_qgis.mobile.lines.rectification_report import course_map, write_report
from urbanmap_qgis.mobile.lines.tie_points import TiePoints, read_tie_points, tie_points_from_columns
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.lines import METHODS, RectifySettings

HEIGHT = 1.9


def ground(x, y):
    return 30 + 10 * np.sin((x + 7000) / 400) + 8 * np.cos((y + 34000) / 500)


def drive(epochs=46_000, length=15_700.0, seconds=2_830.0, seed=0):
    """Streets of 200 to 500 m with turns of 90 degrees and waits, as the paper's: 46,000 epochs over 15.7 km."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0, seconds, epochs)
    speed = np.ones(epochs)
    for wait in rng.uniform(60, seconds - 60, 25):
        speed[(time > wait) & (time < wait + rng.uniform(5, 25))] = 0
    speed = gaussian_filter1d(speed, 1.5 * epochs / seconds)
    way = np.concatenate([[0], np.cumsum(speed[1:] * np.diff(time))])
    way *= length / way[-1]
    corner, sense = np.cumsum(rng.uniform(200, 500, 60)), rng.choice([-90, 90], 60)
    fine = np.linspace(0, length, 100_000)
    heading = sum(s / (1 + np.exp(-np.clip((fine - c) / 3, -50, 50))) for c, s in zip(corner, sense))
    step = np.diff(fine, prepend=0)
    x, y = (np.interp(way, fine, np.cumsum(f(np.radians(heading)) * step)) for f in (np.sin, np.cos))
    place = np.column_stack([x - 7000, y - 34000, ground(x - 7000, y - 34000) + HEIGHT])
    angles = np.column_stack([0.5 * np.sin(time / 3), 0.5 * np.sin(time / 4.1), np.interp(way, fine, heading)])
    return Trajectory(time + 1000.0, place, angles)


def wandering(true, seed, position_walk=0.04):
    """Position and heading wander apart from each other, as GNSS does between buildings: 4 cm per root second."""
    rng = np.random.default_rng(seed)
    step = np.diff(true.time)[0]
    walk = np.cumsum(rng.normal(0, np.sqrt(step), (len(true), 4)) * [position_walk, position_walk, 0.02, 0.01], axis=0)
    walk = gaussian_filter1d(walk, 5.0 / step, axis=0) + rng.normal(0, [0.8, 0.8, 0.5, 0.1])
    return Trajectory(true.time, true.place + walk[:, :3], true.angles + np.outer(walk[:, 3], [0, 0, 1.0]))


def dead_reckoning(true, seed):
    """Gyro of 0.06 degrees per root hour and an odometer off by 50 ppm, without GNSS from the start on."""
    rng = np.random.default_rng(seed)
    step = np.diff(true.time)
    off = 0.1 * rng.normal() + np.concatenate([[0], np.cumsum(rng.normal(0, 0.001 * np.sqrt(step)))])
    turn = -np.radians(off[:-1])
    way = np.diff(true.place[:, :2], axis=0) * (1 + 5e-5)
    way = np.column_stack([np.cos(turn) * way[:, 0] - np.sin(turn) * way[:, 1],
                           np.sin(turn) * way[:, 0] + np.cos(turn) * way[:, 1]])
    place = true.place.copy()
    place[1:, :2] = place[0, :2] + np.cumsum(way, axis=0)
    return Trajectory(true.time, place + np.array([1.0, 0.5, 0.4]), true.angles + np.outer(off, [0, 0, 1.0]))


def seen_from(trajectory, time, body):
    """Places in plan of body vectors, by rotations written anew."""
    angles = [np.interp(time, trajectory.time, trajectory.angles[:, k]) for k in (2, 1, 0)]
    turned = Rotation.from_euler("ZYX", np.column_stack(angles), degrees=True).apply(body)
    place = [np.interp(time, trajectory.time, axis) for axis in trajectory.place[:, :2].T]
    return np.column_stack([place[0] + turned[:, 1], place[1] + turned[:, 0]])


def tie_sets(true, reported, count=18, noise=0.02, seed=0):
    """Two corners a set, one left and one right ahead, within some seconds."""
    rng = np.random.default_rng(seed)
    start = np.linspace(true.time[0] + 5, true.time[-1] - 5, count)
    time = np.column_stack([start, start + rng.uniform(0.5, 2.5, count)]).ravel()
    aside = np.tile([-9.0, 10.0], count) + rng.uniform(-3, 3, 2 * count)
    body = np.column_stack([rng.uniform(-2, 8, 2 * count), aside, np.full(2 * count, -1.0)])
    measured, reference = (seen_from(trajectory, time, body) for trajectory in (reported, true))
    reference += rng.normal(0, noise, reference.shape)
    return TiePoints(np.repeat(np.arange(1, count + 1), 2).astype(str), time, measured, reference)


def errors(made, true):
    """Plan errors (n,) and height errors (n,), m."""
    off = made.trajectory.place - true.place
    return np.hypot(*off[:, :2].T), off[:, 2]


@pytest.fixture(scope="module")
def true():
    return drive()


@pytest.mark.paper("Z 4.1")
@pytest.mark.parametrize(("kind", "seed", "limit"), [
    (wandering, 0, 0.3), (wandering, 1, 0.3), (wandering, 2, 0.3), (dead_reckoning, 0, 0.05),
    (dead_reckoning, 1, 0.05)])
def test_fifteen_kilometres_with_eighteen_sets(true, kind, seed, limit):
    """Z 4.1: 18 sets over 46,000 epochs. Under 0.3 m in the mean between the sets, 5 cm at them, 10 cm in height."""
    reported = kind(true, seed)
    made = rectify(reported, tie_sets(true, reported, seed=seed), ground, RectifySettings(sensor_height=HEIGHT))
    plan, height = errors(made, true)
    before = np.hypot(*(reported.place - true.place)[:, :2].T)
    between = made.status == BETWEEN
    assert plan[between].mean() < limit and plan[between].mean() < 0.5 * before.mean()
    at_sets = np.searchsorted(true.time, [item.time for item in made.sets])
    assert plan[at_sets].mean() < 0.05 and np.mean([item.after for item in made.sets]) < 0.03
    assert np.abs(height).max() < 0.1
    assert made.drift.walk.coupled == (kind is dead_reckoning)
    ratio = np.sqrt(np.mean(((made.trajectory.place - true.place)[between, :2] / made.plan_sigma[between, None]) ** 2))
    assert 0.5 < ratio < 1.7
    assert all(item.status == USED for item in made.sets)


@pytest.mark.parametrize("method", METHODS)
def test_all_methods_meet_the_sets_and_keep_what_they_must(true, method):
    reported = dead_reckoning(true, 3)
    made = rectify(reported, tie_sets(true, reported), None, RectifySettings(method=method))
    plan, _ = errors(made, true)
    assert max(item.after for item in made.sets) < 0.06 and plan[made.status == BETWEEN].mean() < 0.35
    np.testing.assert_array_equal(made.trajectory.time, reported.time)
    np.testing.assert_array_equal(made.trajectory.place[:, 2], reported.place[:, 2])
    np.testing.assert_array_equal(made.trajectory.angles[:, :2], reported.angles[:, :2])
    assert made.heights is None


def pose(trajectory, k):
    """Homogeneous matrix (3, 3) of an epoch in plan."""
    kappa = np.radians(90.0 - trajectory.angles[k, 2])
    x, y = trajectory.place[k, :2]
    return np.array([[np.cos(kappa), -np.sin(kappa), x], [np.sin(kappa), np.cos(kappa), y], [0, 0, 1.0]])


def part_of(motion, share):
    angle = share * np.arctan2(motion[1, 0], motion[0, 0])
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, -sin, share * motion[0, 2]], [sin, cos, share * motion[1, 2]], [0, 0, 1.0]])


def by_the_papers_box(trajectory, ties):
    """Z 3.1 and 3.2 with matrices: eq. 15 to 17 at the first pair of each set, dT T_i, eq. 8 and 9 until closed."""
    course = [pose(trajectory, k) for k in range(len(trajectory))]
    truths = {}
    for name in dict.fromkeys(ties.sets):
        (one, two) = np.flatnonzero(ties.sets == name)[:2]
        o = [np.array([np.interp(ties.time[k], trajectory.time, axis) for axis in trajectory.place[:, :2].T])
             for k in (one, two)]
        v, w = ((points[two] - points[one]) - (o[1] - o[0]) for points in (ties.measured, ties.reference))
        turn = np.arccos(min(v @ w / np.linalg.norm(v) / np.linalg.norm(w), 1.0))  # eq. 15, its sign lost
        turn *= np.sign(v[0] * w[1] - v[1] * w[0])
        g = int(np.abs(trajectory.time - ties.time[one]).argmin())
        heading = np.radians(90.0 - np.interp(ties.time[one], trajectory.time, trajectory.angles[:, 2]))
        seen = ties.measured[one] - o[0]
        body = np.array([np.cos(heading) * seen[0] + np.sin(heading) * seen[1],
                         -np.sin(heading) * seen[0] + np.cos(heading) * seen[1]])
        dx = ties.reference[one, 0] - o[0][0] - body[0] * np.cos(heading + turn) + body[1] * np.sin(heading + turn)
        dy = ties.reference[one, 1] - o[0][1] - body[0] * np.sin(heading + turn) - body[1] * np.cos(heading + turn)
        true = course[g].copy()
        true[:2, :2] = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ true[:2, :2]
        true[:2, 2] += dx, dy
        truths[g] = true
    last = None
    for g, true in truths.items():
        if last is None:
            course = [true @ np.linalg.inv(course[g]) @ t for t in course]
        else:
            steps = [np.linalg.inv(course[i]) @ course[i + 1] for i in range(last, g)]
            path = course[last:g + 1]
            for _ in range(40):
                loop = true @ np.linalg.inv(path[-1])
                if np.abs(loop - np.eye(3)).max() < 1e-13:
                    break
                steps = [part_of(np.linalg.inv(t) @ loop @ t, 1 / (g - last)) @ step for t, step in zip(path, steps)]
                path = [course[last]]
                for step in steps:
                    path.append(path[-1] @ step)
            rest = true @ np.linalg.inv(course[g])
            course[last:g + 1] = path
            course[g + 1:] = [rest @ t for t in course[g + 1:]]
        last = g
    return np.array([t[:2, 2] for t in course]), np.array([np.degrees(np.arctan2(t[1, 0], t[0, 0])) for t in course])


@pytest.mark.paper("Z 3.1, algorithm", "Z 3.2, eq. 11 to 17")
def test_paper_is_the_algorithm_box_to_the_letter():
    true = drive(1200, 400.0, 120.0)
    origin = np.array([-7000.0, -34000.0, 0.0])
    true = Trajectory(true.time, true.place - origin, true.angles)
    reported = wandering(true, 4, position_walk=0.1)
    ties = tie_sets(true, reported, count=4, noise=0.03)
    made = rectify(reported, ties, None, RectifySettings(method="paper"))
    place, kappa = by_the_papers_box(reported, ties)
    np.testing.assert_allclose(made.trajectory.place[:, :2], place, atol=2e-4)
    np.testing.assert_allclose((90.0 - made.trajectory.angles[:, 2] - kappa + 180) % 360 - 180, 0, atol=1e-4)


@pytest.mark.paper("Z 3.2, heights")
def test_paper_takes_sets_of_two_as_they_are(true):
    reported = wandering(true, 0)
    ties = tie_sets(true, reported)
    reference = ties.reference.copy()
    reference[6] += [0.0, 3.0]
    keep = np.arange(len(ties)) != 1
    ties = TiePoints(ties.sets[keep], ties.time[keep], ties.measured[keep], reference[keep])
    told = []
    made = rectify(reported, ties, ground, RectifySettings(method="paper", sensor_height=HEIGHT),
                   Progress(warn=told.append))
    assert made.sets[0].status == ONE_PAIR and not made.sets[0].is_used and "one pair" in told[0]
    assert made.sets[3].status == SUSPECT and made.sets[3].is_used and any("all the same" in text for text in told)
    sampled = np.abs(made.trajectory.place[:, 2] - ground(*made.trajectory.place[:, :2].T) - HEIGHT)
    assert sampled.max() < 0.02
    with pytest.raises(InputError, match="height of the trajectory's origin"):
        rectify(reported, ties, ground, RectifySettings(method="paper"))
    with pytest.raises(InsufficientDataError, match="No set has two pairs"):
        rectify(reported, ties.of(np.isin(ties.sets, ["1"])), None, RectifySettings(method="paper"))


@pytest.mark.slow
@pytest.mark.parametrize("method", ["drift", "paper"])
@pytest.mark.parametrize(("count", "seconds"), [(2, 20.0), (8, 60.0)])
def test_sets_in_one_place_do_not_vouch_for_the_whole_drive(true, method, count, seconds):
    """What was not observed is in the sigma: nine of ten coordinates within two of it, all over the drive."""
    within = []
    for kind in (wandering, dead_reckoning):
        for seed in (10, 11, 12):
            reported = kind(true, seed)
            middle = 0.5 * (true.time[0] + true.time[-1])
            some = (true.time > middle) & (true.time < middle + seconds)
            part = [Trajectory(t.time[some], t.place[some], t.angles[some]) for t in (true, reported)]
            ties = tie_sets(*part, count=count, seed=seed)
            made = rectify(reported, ties, None, RectifySettings(method=method))
            off = np.abs(made.trajectory.place - true.place)[:, :2] / made.plan_sigma[:, None]
            within.append((off < 2.0).mean())
    assert np.mean(within) > 0.9 and min(within) > 0.75


def test_best_estimate_is_better_than_the_paper_s_motions_where_positions_wander(true):
    reported = wandering(true, 4)
    ties = tie_sets(true, reported)
    drift, paper = (errors(rectify(reported, ties, None, RectifySettings(method=method)), true)[0].mean()
                       for method in ("drift", "paper"))
    assert drift < 0.6 * paper


def test_sample_city(small_city):
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    reported = read_trajectory(small_city / "lines" / "trajectory.csv").trajectory
    ties = read_tie_points(small_city / "lines" / "tie_points.csv")
    with RasterSampler(small_city / "truth" / "ground.tif") as raster:
        made = rectify(reported, ties, raster.sample, RectifySettings(sensor_height=1.95))
    plan, height = errors(made, true)
    before = np.hypot(*(reported.place - true.place)[:, :2].T)
    assert before.mean() > 1.0 and plan[made.status == BETWEEN].mean() < 0.06
    assert np.sqrt(np.mean(height**2)) < 0.02
    turn = made.trajectory.angles[:, 2] - true.angles[:, 2]
    assert np.sqrt(np.mean(turn**2)) < 0.12
    assert made.figures()["AFTER"] < 0.05 < 1.0 < made.figures()["BEFORE"]


def short(seed=0, count=8):
    true = drive(6000, 2000.0, 400.0, seed)
    reported = wandering(true, seed, position_walk=0.02)
    return true, reported, tie_sets(true, reported, count)


def warned():
    told = []
    return told, Progress(warn=told.append)


def changed(ties, rows, shift):
    reference = ties.reference.copy()
    reference[rows] += shift
    return TiePoints(ties.sets, ties.time, ties.measured, reference)


def test_a_set_whose_pairs_contradict_each_other_is_left_out():
    true, reported, ties = short()
    told, progress = warned()
    made = rectify(reported, changed(ties, [5], [0.0, 3.0]), None, None, progress)
    assert made.sets[2].status == CONTRADICTING and "Set 3 contradicts itself" in told[0]
    assert [item.status for item in made.sets].count(USED) == 7
    assert errors(made, true)[0].mean() < 0.3


def test_swapped_points_are_told_by_the_turn():
    _, reported, ties = short()
    reference = ties.reference.copy()
    reference[[4, 5]] = reference[[5, 4]]
    told, progress = warned()
    made = rectify(reported, TiePoints(ties.sets, ties.time, ties.measured, reference), None, None, progress)
    assert made.sets[2].status == CONTRADICTING
    assert "swapped" in told[0] or "do not fit" in told[0]


def test_a_pair_among_several_is_told_and_the_rest_used():
    true, reported, ties = short()
    more = tie_sets(true, reported, 8, seed=5)
    both = TiePoints(*(np.concatenate([a, b]) for a, b in ((ties.sets, more.sets), (ties.time, more.time),
                                                           (ties.measured, more.measured),
                                                           (ties.reference, more.reference))))
    order = np.argsort(both.time, kind="stable")
    both = both.of(order)
    bad = int(np.flatnonzero(both.sets == "4")[1])
    told, progress = warned()
    made = rectify(reported, changed(both, [bad], [2.5, 0.0]), None, None, progress)
    fourth = next(item for item in made.sets if item.name == "4")
    assert (fourth.pairs, fourth.given, fourth.status) == (3, 4, USED) and "1 of 4 pairs" in told[0]


def test_a_set_at_another_building_is_found_by_its_neighbours():
    true, reported, ties = short(count=12)
    told, progress = warned()
    made = rectify(reported, changed(ties, [10, 11], [6.0, 5.0]), None, None, progress)
    assert made.sets[5].status == BLUNDER and any("Set 6 lies" in text for text in told)
    assert made.sets[5].after > 5.0 and errors(made, true)[0].mean() < 0.3
    kept = rectify(reported, changed(ties, [10, 11], [6.0, 5.0]), None, RectifySettings(keep_blunders=True), progress)
    assert kept.sets[5].status == SUSPECT and kept.sets[5].after < 1.0


@pytest.mark.parametrize(("kind", "count", "wrong"), [(wandering, 5, 2), (wandering, 8, 4), (dead_reckoning, 5, 1)])
def test_a_whole_set_off_by_5_m_among_few_is_named(kind, count, wrong):
    """Few sets: a wrong one makes a drift look possible that would explain it; the others alone do not."""
    true = drive(6000, 2000.0, 400.0, 3)
    reported = kind(true, 3)
    told, progress = warned()
    ties = changed(tie_sets(true, reported, count), [2 * wrong, 2 * wrong + 1], [4.0, 3.0])
    made = rectify(reported, ties, None, None, progress)
    assert made.sets[wrong].status in (SUSPECT, BLUNDER) and any(f"Set {wrong + 1} lies" in text for text in told)
    assert all(item.status in (USED, POSITION_ONLY) for k, item in enumerate(made.sets) if k != wrong)
    told.clear()
    rectify(reported, tie_sets(true, reported, count), None, None, progress)
    assert not any("lies" in text for text in told)


def outages(true, seed, growth=0.08):
    """Decimetres that wander, but for six outages of 30 to 90 s in which the position drifts; the accuracy stated is
    three times too small."""
    rng = np.random.default_rng(seed)
    time, step = true.time - true.time[0], float(np.diff(true.time)[0])
    places = gaussian_filter1d(rng.normal(size=(len(true), 2)), 30.0 / step, axis=0)
    places *= 0.1 / places.std()
    stated, missing = np.full(len(true), 0.03), np.zeros(len(true), bool)
    for start, length in zip(np.linspace(50, time[-1] - 160, 6), rng.uniform(30, 90, 6)):
        rows, after = (time > start) & (time < start + length), time >= start + length
        drift = np.cumsum(rng.normal(0, growth * np.sqrt(step), (rows.sum(), 2)), axis=0)
        fading = np.exp(-(time[after] - start - length) / 5.0)
        places[rows] += drift
        places[after] += drift[-1] * fading[:, None]
        stated[rows] += 0.3 * growth * np.sqrt(time[rows] - start)
        stated[after] += 0.3 * growth * np.sqrt(length) * fading
        missing |= rows
    place = true.place + np.column_stack([places, np.zeros(len(true))])
    return Trajectory(true.time, place, true.angles, place_sigma=np.column_stack([stated, stated])), missing


@pytest.mark.slow
def test_outages_carry_the_drift_where_the_navigation_tells_of_them():
    true = drive(6000, 5000.0, 1200.0)
    within = {True: [], False: []}
    for seed in (0, 1, 2):
        reported, missing = outages(true, seed)
        ties = tie_sets(true, reported, count=18, seed=seed)
        for stated in (True, False):
            given = reported if stated else Trajectory(reported.time, reported.place, reported.angles)
            made = rectify(given, ties)
            off = np.abs(made.trajectory.place - true.place)[missing, :2] / made.plan_sigma[missing, None]
            within[stated].append((off < 2.0).mean())
            assert made.drift.pace.is_stated == stated
    assert np.mean(within[True]) > 0.9 > np.mean(within[False])


def test_two_sets_that_contradict_each_other_are_told():
    true, reported, _ = short()
    time, body = np.array([1200.0, 1201, 1201.5, 1202.5]), [[0, -9, 0], [5, 9, 0]] * 2
    close = TiePoints(np.array(["1", "1", "2", "2"]), time, *(seen_from(t, time, body) for t in (reported, true)))
    told, progress = warned()
    made = rectify(reported, changed(close, [2, 3], [4.0, 0.0]), None, None, progress)
    assert any("contradict each other" in text for text in told) and made.sets[0].status == SUSPECT


def test_tie_points_in_one_place_only_carry_on_with_growing_sigma():
    _, reported, ties = short()
    told, progress = warned()
    made = rectify(reported, ties.of(ties.sets == "2"), None, None, progress)
    assert "only moved along" in told[0] and (made.status == EXTRAPOLATED).mean() > 0.95
    at = int(np.abs(made.trajectory.time - made.sets[0].time).argmin())
    # It grows, but for what a course that comes back takes from it.
    assert made.plan_sigma[-1] > 3 * made.plan_sigma[at + 100] > 3 * made.plan_sigma[at]
    assert made.plan_sigma[at + 100:].min() == made.plan_sigma[at + 100]
    assert np.isnan(made.sets[0].predicted) and "PREDICTED" not in made.figures()


def test_pairs_at_one_point_tell_a_position_but_no_heading():
    true, reported, _ = short()
    time = np.array([1100.0, 1100.0, 1250.0, 1250.0])
    body = [[0, -9.0, 0], [0.05, -9.0, 0], [0, 9.0, 0], [0, 9.05, 0]]
    ties = TiePoints(np.array(["1", "1", "2", "2"]), time, seen_from(reported, time, body), seen_from(true, time, body))
    made = rectify(reported, ties)
    assert [item.status for item in made.sets] == [POSITION_ONLY] * 2
    assert max(item.after for item in made.sets) < 0.05 and made.heading_sigma.min() > 0.1


def test_nothing_to_work_with():
    _, reported, ties = short()
    with pytest.raises(InputError, match="one survey"):
        rectify(reported, TiePoints(ties.sets, ties.time + 1e5, ties.measured, ties.reference))
    with pytest.raises(InsufficientDataError, match="All 8 sets"):
        rectify(reported, changed(ties, np.arange(0, 16, 2), [0.0, 4.0]), settings=RectifySettings(tie_sigma=0.05))
    with pytest.raises(InputError, match="other is none of drift, paper"):
        RectifySettings(method="other")
    with pytest.raises(InputError, match="must not be less than 0"):
        RectifySettings(tie_sigma=-1.0)
    with pytest.raises(Cancelled):
        rectify(reported, ties, progress=Progress(cancelled=lambda: True))


def test_names_may_be_any_text_and_one_epoch_may_bear_several_sets():
    true, reported, _ = short()
    time = np.array([1100.0, 1100.0, 1100.001, 1100.001, 1300.0, 1300.0])
    body = [[0, -9.0, 0], [6, 8.0, 0]] * 3
    columns = {"SET": ["北", "北", "b", "b", "c", "c"], "time": time}
    for key, trajectory in (("mms", reported), ("ref", true)):
        columns[f"x_{key}"], columns[f"y_{key}"] = seen_from(trajectory, time, body).T
    for method in METHODS:
        made = rectify(reported, tie_points_from_columns(columns), None, RectifySettings(method=method))
        assert [item.name for item in made.sets] == ["北", "b", "c"] and max(item.after for item in made.sets) < 0.01


def test_report_shows_sets_profiles_and_warnings(tmp_path):
    _, reported, ties = short()
    made = rectify(reported, changed(ties, [5], [0.0, 3.0]), ground)
    write_report(tmp_path / "r.html", reported, made, ["Set 3 <contradicts> itself."])
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 5 and "Set 3 &lt;contradicts&gt; itself" in page
    assert "left out: its pairs do not fit each other" in page and "mean height stays as reported" in page
    assert "nan" not in page.lower().replace("nano", "")


def test_few_sets_do_not_tell_how_good_they_are():
    _, reported, ties = short()
    some = ties.of(np.isin(ties.sets, ["1", "8"]))
    told, progress = warned()
    rectify(reported, some, None, None, progress)
    assert any("2 sets do not tell" in text for text in told)
    told, progress = warned()
    rough = rectify(reported, some, None, RectifySettings(tie_sigma=0.5), progress)
    assert not told and rough.plan_sigma.min() > 0.25


@pytest.mark.parametrize("extent", [(300.0, 20.0), (10.0, 200.0), (0.2, 0.1)])
def test_a_course_fills_its_plan_and_the_scale_bar_is_as_long_as_it_says(extent):
    count = 50
    drive = Trajectory(np.arange(count, dtype=float), np.column_stack([np.linspace(0.0, size, count) for size in (
        *extent, 1.0)]), np.zeros((count, 3)))
    svg = course_map(drive, SimpleNamespace(trajectory=drive, status=np.full(count, BETWEEN), sets=()))
    width, height = (int(value) for value in re.search(r'width="(\d+)" height="(\d+)"', svg).groups())
    places = np.array(re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", svg.partition("#333")[0]), float)[:2 * count]
    size = np.ptp(places, axis=0)
    assert (places >= 19.9).all() and (places <= [width - 19.9, height - 19.9]).all()
    begin, end, length = re.search(r'd="M([\d.]+) \d+H(\d+)".*>([\d.e-]+) m<', svg).groups()
    metres = (float(end) - float(begin)) / float(length)  # pixels a metre
    assert size == pytest.approx(np.array(extent) * metres, rel=0.02, abs=0.2)
    assert max(size[0] / (width - 40), 1.3 * size[1] / (width - 40)) == pytest.approx(
        1.0 if max(extent) > 1.0 else 0.2 / 1.3, rel=0.02)
