"""Results of windows with a known truth: a drive with drifting errors, waits, gaps, gross and ambiguous stretches."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import gaussian_filter1d

from urbanmap_qgis.mobile.registration.records import MODES, NO_MARKINGS, REGISTERED, WindowResults
from urbanmap_qgis.mobile.trajectory import Trajectory

PATCH = 0.5
WINDOW = 30


@dataclass(frozen=True)
class Drive:
    """True and reported trajectory, and the windows' results between them."""

    true: Trajectory
    reported: Trajectory
    windows: WindowResults
    error: np.ndarray
    """(n, 6) correction that is right at each patch."""


def drift(count: int, spacing: float, length: float, size: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(count, 6) smooth random curves with standard deviations `size`, correlated over `length`."""
    noise = gaussian_filter1d(rng.standard_normal((count + 4000, 6)), length / spacing, axis=0)[2000:2000 + count]
    return noise * size / (1.0 / np.sqrt(2 * np.sqrt(np.pi) * length / spacing))


def trajectory(length: float, waits: dict[float, float], turn: float | None) -> tuple[Trajectory, np.ndarray]:
    """A drive at 8 m/s at 50 Hz with waits (way: seconds) and a right turn; and the way driven."""
    time, chainage = [0.0], [0.0]
    stops = sorted(waits.items())
    step = 0.02
    while chainage[-1] < length:
        if stops and chainage[-1] >= stops[0][0]:
            still = round(stops.pop(0)[1] / step)
            time += list(time[-1] + step * np.arange(1, still + 1))
            chainage += [chainage[-1]] * still
        time.append(time[-1] + step)
        chainage.append(chainage[-1] + 8.0 * step)
    time, chainage = np.array(time), np.array(chainage)
    heading = 90.0 + (90.0 * np.clip((chainage - turn) / 20.0, 0, 1) if turn else 0.0 * chainage)
    ds = np.diff(chainage, prepend=0.0)
    place = np.column_stack([np.cumsum(ds * np.sin(np.radians(heading))), np.cumsum(ds * np.cos(np.radians(heading))),
                             np.full(len(chainage), 12.0)])
    return Trajectory(time, place, np.column_stack([0 * chainage, 0 * chainage, heading])), chainage


def simulate(seed: int = 0, length: float = 500.0, waits: dict[float, float] | None = None, turn: float | None = 250.0,
             gaps: tuple[tuple[float, float], ...] = (), three_d: bool = False, drift_length: float = 150.0,
             drift_size: float = 0.5, noise: float = 1.0, crossings: float = 60.0) -> Drive:
    """A drive whose patches see lane lines (across the way) and, every `crossings` m, markings across."""
    rng = np.random.default_rng(seed)
    true, chainage = trajectory(length, waits or {}, turn)
    path_parameter = chainage + 0.3 * true.time
    curve = drift(int(path_parameter[-1] / 0.5) + 2, 0.5, drift_length,
                  np.array([drift_size, drift_size, drift_size, 0.05, 0.05, 0.05]), rng)
    curve += rng.normal(0.0, [0.7, 0.7, 0.7, 0.03, 0.03, 0.03])
    error = np.column_stack([np.interp(path_parameter, 0.5 * np.arange(len(curve)), column) for column in curve.T])
    if not three_d:
        error[:, 2:5] = 0.0
    reported = Trajectory(true.time, true.place - error[:, :3], true.angles - error[:, 3:])
    count = int(length / PATCH)
    middle = (np.arange(count) + 0.5) * PATCH
    moving = np.concatenate([[True], np.diff(chainage) > 0])
    time = np.interp(middle, chainage[moving], true.time[moving])
    at = np.column_stack([np.interp(time, true.time, column) for column in error.T])
    pose = [np.column_stack([np.interp(time, true.time, column) for column in values.T])
            for values in (reported.place, reported.angles)]
    information = _information(middle, pose[1][:, 2], gaps, three_d, crossings, rng) / noise**2
    gradient, linearised, correction = _noisy(information, at, three_d, rng)
    made = _windows(time, middle, pose, information, gradient, linearised, correction, three_d)
    return Drive(true, reported, made, at)


def _information(chainage, heading, gaps, three_d, crossings, rng):
    """(n, 6, 6): of lines along the way 3.5 m left and right, and of markings across it here and there."""
    n = len(chainage)
    sin, cos = np.sin(np.radians(heading)), np.cos(np.radians(heading))
    information = np.zeros((n, 6, 6))
    across, along = np.stack([cos, -sin], 1), np.stack([sin, cos], 1)
    seen = np.ones(n)
    for start, end in gaps:
        seen[(chainage >= start) & (chainage < end)] = 0.0
    dash = seen * (np.mod(chainage, 11.0) < 5.0) * rng.uniform(0.5, 1.5, n)
    zebra = seen * (np.mod(chainage, crossings) < 4.0)
    for direction, amount, lever_arm in ((across, 60.0 * dash + 200.0 * zebra, 8.0),
                                   (along, 0.5 * dash + 200.0 * zebra, 3.0)):
        row = np.zeros((n, 6))
        row[:, :2] = direction
        for sign in (-1, 1):  # markings ahead and behind, left and right: they fix the heading
            row[:, 5] = sign * np.radians(1.0) * lever_arm
            information += 0.5 * amount[:, None, None] * row[:, :, None] * row[:, None, :]
    if three_d:
        for roll, pitch in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            row = np.zeros((n, 6))
            row[:, 2], row[:, 3], row[:, 4] = 1.0, roll * np.radians(1.0) * 4.0, pitch * np.radians(1.0) * 6.0
            information += 0.25 * 200.0 * dash[:, None, None] * row[:, :, None] * row[:, None, :]
    else:
        information[:, 2:5], information[:, :, 2:5] = 0.0, 0.0
    return information


def _noisy(information, truth, three_d, rng):
    """Pulls with the noise that the information promises, at places off the truth, and windows' own corrections."""
    values, vectors = np.linalg.eigh(information)
    root = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
    noise = np.einsum("nij,nj->ni", root, rng.standard_normal(truth.shape))
    linearised = truth + rng.normal(0.0, [0.03, 0.03, 0.03, 0.01, 0.01, 0.01], truth.shape)
    if not three_d:
        linearised[:, 2:5] = np.nan
    gradient = np.einsum("nij,nj->ni", information, np.nan_to_num(truth - linearised)) + noise
    return gradient, linearised, None


def _windows(time, chainage, pose, information, gradient, linearised, correction, three_d):
    n = len(time)
    first = np.maximum(np.arange(n) - WINDOW, 0)
    last = np.minimum(np.arange(n) + WINDOW - 1, n - 1)
    sums = [np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)]) for values in (
        information, gradient + np.einsum("nij,nj->ni", information, np.nan_to_num(linearised)))]
    whole, lean = (values[last + 1] - values[first] for values in sums)
    pick = list(range(6)) if three_d else [0, 1, 5]
    correction, covariance = np.full((n, 6), np.nan), np.full((n, 6, 6), np.nan)
    block = whole[:, pick][:, :, pick]
    good = np.linalg.eigvalsh(block)[:, 0] > 1e-6
    inverse = np.linalg.inv(block[good])
    covariance[np.ix_(np.flatnonzero(good), pick, pick)] = inverse
    correction[np.ix_(np.flatnonzero(good), pick)] = np.einsum("nij,nj->ni", inverse, lean[good][:, pick])
    modes, scores = np.full((n, MODES, 2), np.nan), np.full((n, MODES), np.nan)
    modes[:, 0], scores[:, 0] = correction[:, :2], 100.0
    status = np.where(good, REGISTERED, NO_MARKINGS).astype(np.int8)
    full = np.full(n, 1.0)
    return WindowResults(time, chainage, pose[0], pose[1], correction, covariance, full * 0.7, full * 0.7, first, last,
                         (last - first + 1) * PATCH, full * 400, full * 900, full * 0.2, full * 50.0, status, modes,
                         scores, linearised, information, gradient, three_d)


def shifted(drive: Drive, start: float, end: float, shift: tuple[float, float], **changes: object) -> Drive:
    """The drive with the evidence of a stretch (m of way) moved in plan: repainted markings, a slip by a dash."""
    windows = drive.windows
    there = (windows.chainage >= start) & (windows.chainage < end)
    move = np.zeros(6)
    move[:2] = shift
    changed = {"linearised": windows.linearised + there[:, None] * move,
               "correction": windows.correction + there[:, None] * move}
    modes = windows.modes.copy()
    modes[there, 0] += shift
    if changes.pop("with_truth", False):  # the place that is right stays among the modes
        modes[there, 1] = windows.modes[there, 0]
    changed["modes"] = modes
    for name, value in changes.items():
        column = getattr(windows, name).copy()
        column[there] = value
        changed[name] = column
    return replace(drive, windows=replace(windows, **changed))
