"""Rectification with real GNSS errors of a drive through Nagoya, and on the surveys of another program's city."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.lines.rectification import BETWEEN, rectify
from urbanmap_qgis.mobile.lines.tie_points import TiePoints
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.lines import RectifySettings


def seen_from(trajectory, time, body):
    angles = [np.interp(time, trajectory.time, trajectory.angles[:, k]) for k in (2, 1, 0)]
    north, east, _ = Rotation.from_euler("ZYX", np.column_stack(angles), degrees=True).apply(body).T
    x, y = (np.interp(time, trajectory.time, axis) for axis in trajectory.place[:, :2].T)
    return np.column_stack([x + east, y + north])


@pytest.fixture(scope="module")
def nagoya(real_data):
    """The reference trajectory, and the same with the real errors, cut at 3 m and smoothed over 20 s."""
    folder = real_data / "mobile" / "error_profiles"
    true = read_trajectory(folder / "nagoya_reference_trajectory.csv").trajectory
    table = np.genfromtxt(folder / "nagoya_single_point_1hz.csv", delimiter=",", names=True)
    error = np.clip(np.column_stack([table[name] for name in ("east_error", "north_error", "up_error")]), -3, 3)
    error = gaussian_filter1d(error, 20.0, axis=0, mode="nearest")
    off = np.column_stack([np.interp(true.time, table["time"], axis) for axis in error.T])
    turn = np.outer(0.1 * np.sin(true.time / 60), [0, 0, 1])
    return true, Trajectory(true.time, true.place + off, true.angles + turn)


@pytest.mark.parametrize(("count", "limit"), [(18, 0.35), (72, 0.06)])
def test_real_drift(nagoya, count, limit):
    true, reported = nagoya
    rng = np.random.default_rng(0)
    start = np.linspace(true.time[0] + 5, true.time[-1] - 5, count)
    time = np.column_stack([start, start + rng.uniform(0.5, 2.5, count)]).ravel()
    body = np.column_stack([rng.uniform(-2, 8, 2 * count), np.tile([-9.0, 10.0], count), np.full(2 * count, -1.0)])
    measured, reference = (seen_from(trajectory, time, body) for trajectory in (reported, true))
    reference += rng.normal(0, 0.02, reference.shape)
    made = rectify(reported, TiePoints(np.repeat(np.arange(count), 2).astype(str), time, measured, reference))
    error = np.hypot(*(made.trajectory.place - true.place)[:, :2].T)[made.status == BETWEEN]
    before = np.hypot(*(reported.place - true.place)[:, :2].T)
    assert before.mean() > 1.3 and error.mean() < limit
    # What the report foretells is not less than what came.
    assert made.figures()["PREDICTED"] > error.mean()
    between = made.status == BETWEEN
    off = (made.trajectory.place - true.place)[between, :2] / made.plan_sigma[between, None]
    assert np.sqrt(np.mean(off**2)) < 2.0


@pytest.mark.parametrize("survey", ["01", "02"])
def test_surveys_of_the_simulated_city(real_data, survey):
    """Eight or so sets of its control points, 10 s apart."""
    city = real_data / "city"
    true = read_trajectory(city / "truth" / f"survey_{survey}_trajectory.csv").trajectory
    reported = read_trajectory(city / "mms" / f"survey_{survey}_trajectory.csv").trajectory
    table = np.genfromtxt(city / "truth" / f"control_survey_{survey}.csv", delimiter=",", names=True, dtype=None,
                          encoding="utf-8")
    table = table[np.argsort(table["time"])]
    rows, last = [], -np.inf
    for k in range(len(table) - 1):
        near = np.flatnonzero((table["time"] - table["time"][k] < 4.0) & (np.arange(len(table)) > k)
                              & (np.hypot(table["x"] - table["x"][k], table["y"] - table["y"][k]) > 4.0))
        if table["time"][k] - last > 10.0 and len(near):
            rows += [k, near[0]]
            last = table["time"][k]
    order = np.argsort(table["time"][rows], kind="stable")
    sets = np.repeat(np.arange(len(rows) // 2), 2).astype(str)[order]
    some = table[rows][order]
    ties = TiePoints(sets, some["time"], np.column_stack([some["x_mms"], some["y_mms"]]),
                     np.column_stack([some["x"], some["y"]]))
    with RasterSampler(city / "truth" / "ground.tif") as ground:
        height = float(np.median(true.place[:, 2] - ground.sample(*true.place[:, :2].T)))
        made = rectify(reported, ties, ground.sample, RectifySettings(sensor_height=height))
    error = made.trajectory.place - true.place
    plan = np.hypot(*error[:, :2].T)[made.status == BETWEEN]
    assert 6 <= len(made.sets) <= 10 and np.hypot(*(reported.place - true.place)[:, :2].T).mean() > 1.3
    assert plan.mean() < 0.04 and plan.max() < 0.15 and np.sqrt(np.mean(error[:, 2] ** 2)) < 0.02
