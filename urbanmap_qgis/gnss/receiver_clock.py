"""The receiver's clock from signals in line of sight, and what their residuals tell about the antenna's height.

A residual is clock + noise for a signal in line of sight. The clock changes from epoch to epoch; between the systems
there is an offset that a receiver keeps for hours. Late signals that passed for line of sight would pull a mean:
the start is a median and later estimates weigh a residual down the farther off it lies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..errors import InsufficientDataError
from .signals import Clocks, ClockSettings, Signals

_ROUNDS = 12
_TUKEY = 4.7
_MAD = 1.4826
_BLOCK = 60.0
_LOW_LOSS = 7.0
_FADING = 4.0
_HIGH = 50.0
_AIR_HEIGHT = 0.7
_COARSE = np.array([40.0, 20.0, 10.0, 6.0, 4.0, 3.0, 3.0, 3.0, 3.0, 3.0])


def estimate_clocks(signals: Signals, line_of_sight: np.ndarray, settings: ClockSettings | None = None) -> Clocks:
    """Clock and its sigma for every signal, from those in line of sight.

    Parameters
    ----------
    line_of_sight : (n,) bool, signals whose direct way is free.

    Returns NaN where an epoch has too few signals in line of sight (`ClockSettings.least_satellites`).
    """
    settings = settings or ClockSettings()
    groups = _groups(signals, line_of_sight, settings)
    rows = np.flatnonzero(line_of_sight)
    size = len(signals)
    if not len(rows):
        nothing = np.full(size, np.nan)
        return Clocks(nothing, nothing.copy(), np.zeros(size, int), nothing.copy(), 1.0)
    group, part = groups.clock[rows], groups.offset[rows]
    value, sigma = signals.residual[rows], signals.sigma[rows]
    offset = groups.start.copy()
    clock = grouped_median(value - offset[part], group, groups.count)
    unit = 1.0
    for _ in range(_ROUNDS):
        left = value - offset[part] - clock[group]
        unit = _unit_weight(left, sigma, group, groups.count)
        weight = tukey(left / (sigma * unit)) / sigma ** 2
        clock, offset = _solve(value, weight, group, part, groups)
    left = value - offset[part] - clock[group]
    weight = tukey(left / (sigma * unit)) / sigma ** 2
    used = np.bincount(group, weight > 0, groups.count)
    total = np.bincount(group, weight, groups.count)
    with np.errstate(divide="ignore"):
        clock_sigma = unit / np.sqrt(total)
    # A group without enough signals, or one in which they contradict each other, gives no clock.
    bad = used < settings.least_satellites
    clock, clock_sigma = np.where(bad, np.nan, clock), np.where(bad, np.nan, clock_sigma)
    mine = clock[groups.clock] + offset[groups.offset]
    sigma_of_offset = _offset_sigma(signals.satellite[rows], left, weight, part, len(offset), unit)
    own_sigma = np.hypot(clock_sigma[groups.clock], np.where(groups.linked, sigma_of_offset, 0.0)[groups.offset])
    return Clocks(mine, own_sigma, used[groups.clock].astype(int), signals.residual - mine, unit)


@dataclass(frozen=True)
class _Groups:
    """Which clock (n,) and which offset (n,) a signal has; count of clocks; offsets at the start (k,), m; which of
    them are linked to others (k,)."""

    clock: np.ndarray
    offset: np.ndarray
    count: int
    start: np.ndarray
    linked: np.ndarray


def _groups(signals: Signals, line_of_sight: np.ndarray, settings: ClockSettings) -> _Groups:
    """Group signals by the clock they share: an epoch of linked systems, or of one system."""
    letters, system = np.unique(signals.system, return_inverse=True)
    system = system.ravel()
    kinds = max(len(letters), 1)
    file = signals.epochs.source[signals.epoch]
    part = file * kinds + system
    own = signals.epoch * kinds + system
    start = np.zeros((int(signals.epochs.source.max(initial=0)) + 1) * kinds)
    linked = np.zeros(len(start), bool)
    if settings.joined:
        linked, start = _links(signals, line_of_sight, own, kinds, start, settings.own_offset)
    # A clock of its own has a number beyond those of the epochs.
    joint = np.where(linked[part], signals.epoch * kinds, own + len(signals.epochs) * kinds)
    names, clock = np.unique(joint, return_inverse=True)
    return _Groups(clock.ravel(), part, len(names), start, linked)


def _links(signals: Signals, line_of_sight: np.ndarray, own: np.ndarray, kinds: int, start: np.ndarray,
           least: int) -> tuple[np.ndarray, np.ndarray]:
    """Which systems of which file are linked (k,), and their offsets (k,) against the file's fullest system, m."""
    rows = np.flatnonzero(line_of_sight)
    count = len(signals.epochs) * kinds
    median = grouped_median(signals.residual[rows], own[rows], count).reshape(-1, kinds)
    linked, start = np.zeros(len(start), bool), start.copy()
    for file in range(len(start) // kinds):
        table = median[signals.epochs.source == file]
        there = np.isfinite(table)
        if not there.any():
            continue
        main = int(np.argmax(np.bincount(own[rows][signals.epochs.source[signals.epoch[rows]] == file] % kinds,
                                         minlength=kinds)))
        linked[file * kinds + main] = True
        for other in range(kinds):
            both = there[:, main] & there[:, other]
            if other != main and both.sum() >= least:
                linked[file * kinds + other] = True
                start[file * kinds + other] = np.median(table[both, other] - table[both, main])
    return linked, start


def _solve(value: np.ndarray, weight: np.ndarray, group: np.ndarray, part: np.ndarray,
           groups: _Groups) -> tuple[np.ndarray, np.ndarray]:
    """Clocks and offsets by weighted least squares; the clocks are eliminated."""
    kinds = len(groups.start)
    total = np.bincount(group, weight, groups.count)
    used = np.unique(part)
    column = np.searchsorted(used, part)
    cells = np.bincount(group * len(used) + column, weight, groups.count * len(used)).reshape(-1, len(used))
    sums = np.bincount(group, weight * value, groups.count)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(total[:, None] > 0, cells / total[:, None], 0.0)
        mean = np.where(total > 0, sums / total, 0.0)
    normal = np.diag(np.bincount(column, weight, len(used))) - cells.T @ share
    right = np.bincount(column, weight * value, len(used)) - cells.T @ mean
    # One offset of each set of linked systems is free: the least change from the start settles it.
    change = np.linalg.lstsq(normal, right - normal @ groups.start[used], rcond=1e-9)[0]
    offset = np.zeros(kinds)
    offset[:] = groups.start
    offset[used] += change
    clock = mean - share @ offset[used]
    clock[total <= 0] = np.nan
    return clock, offset


def _offset_sigma(satellite: np.ndarray, left: np.ndarray, weight: np.ndarray, part: np.ndarray, count: int,
                  unit: float) -> np.ndarray:
    """(count,) sigma of the systems' offsets, m: a satellite's orbit errs the same way for the whole file, so that
    its mean residual is one observation however many epochs it has."""
    pair = np.unique(np.stack([part, np.unique(satellite, return_inverse=True)[1].ravel()]), axis=1,
                     return_inverse=True)[1].ravel()
    total = np.bincount(pair, weight)
    mean = np.bincount(pair, weight * np.nan_to_num(left)) / np.where(total > 0, total, 1.0)
    owner = np.zeros(len(total), np.int64)
    owner[pair] = part
    there = total > 0
    sums, squares = (np.bincount(owner, total ** power, count) for power in (1, 2))
    effective = np.divide(sums ** 2, squares, out=np.full(count, np.nan), where=squares > 0)
    freedom = there.sum() - len(np.unique(owner[there]))
    scatter = np.sqrt(np.sum(mean[there] ** 2) / freedom) if freedom >= 3 else unit
    return np.nan_to_num(scatter / np.sqrt(effective), nan=np.inf)


def _unit_weight(left: np.ndarray, sigma: np.ndarray, group: np.ndarray, count: int) -> float:
    """Scatter of residuals against what their sigma says, robust; residuals of small groups are widened."""
    weight = 1 / sigma ** 2
    share = weight / np.bincount(group, weight, count)[group]
    free = share < 0.6
    if free.sum() < 10:
        return 1.0
    return max(float(_MAD * np.nanmedian(np.abs(left[free]) / (sigma[free] * np.sqrt(1 - share[free])))), 0.1)


def tukey(scaled: np.ndarray) -> np.ndarray:
    """Tukey's weights: 1 at 0, 0 from 4.7 sigma on; 0 for NaN."""
    return np.where(np.abs(scaled) < _TUKEY, (1 - (scaled / _TUKEY) ** 2) ** 2, 0.0)


def grouped_median(value: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    """(count,) median of the values of each group; NaN for empty ones."""
    order = np.lexsort((value, group))
    value, group = value[order], group[order]
    size = np.bincount(group, minlength=count)
    first = np.concatenate([[0], np.cumsum(size)[:-1]])
    median = np.full(count, np.nan)
    full = size > 0
    low, high = first[full] + (size[full] - 1) // 2, first[full] + size[full] // 2
    median[full] = 0.5 * (value[low] + value[high])
    return median


def strong_signals(signals: Signals) -> np.ndarray:
    """(n,) bool: signals as strong as a free line of sight lets them be, judged without a map.

    The strongest tenth of a system's signals, each raised by what the elevation costs (about 7 dB from the zenith to
    the horizon), sets the measure; 4 dB below it, more than fading takes and less than a reflection costs, is the
    limit. Signals without a strength count from 50 degrees of elevation.
    """
    raised = signals.cn0 + _LOW_LOSS * (1.0 - signals.direction[:, 2])
    strong = np.zeros(len(signals), bool)
    for name in np.unique(signals.system):
        own = (signals.system == name) & np.isfinite(raised)
        if own.any():
            strong[own] = raised[own] >= np.percentile(raised[own], 90) - _FADING
    unknown = ~np.isfinite(signals.cn0)
    strong[unknown] = signals.elevation[unknown] >= _HIGH
    return strong


def strong_scatter(signals: Signals) -> float:
    """How far the strongest signals contradict each other at an epoch, m (robust standard deviation); offsets of the
    systems are taken off by medians. NaN with fewer than fifty to compare."""
    rows = np.flatnonzero(strong_signals(signals))
    epoch, epochs = _numbered(signals.epoch[rows])
    system = np.unique(signals.system[rows], return_inverse=True)[1].ravel()
    part, parts = _numbered(signals.epochs.source[signals.epoch[rows]] * 8 + system)
    left = signals.residual[rows]
    for _ in range(4):
        left = left - grouped_median(left, epoch, epochs)[epoch]
        left = left - grouped_median(left, part, parts)[part]
    left = left - grouped_median(left, epoch, epochs)[epoch]
    # One of three signals or more is the median itself.
    left = left[(np.bincount(epoch, minlength=epochs)[epoch] > 3) & (left != 0)]
    return float(_MAD * np.median(np.abs(left))) if len(left) >= 50 else float("nan")


def estimate_height(signals: Signals, line_of_sight: np.ndarray | None = None) -> tuple[float, float]:
    """By how much the satellites see the antenna higher than it was put, and sigma, m.

    A height too low by h makes every residual smaller by h times the sine of the elevation. Signals of an epoch share
    a clock, but for an offset of each system in a file. Without `line_of_sight` (n,) all signals are used, late
    ones weighed down; those that pass for line of sight make the height too large: they come from low satellites.
    Neighbouring epochs err alike: the sigma counts a satellite's minute as one observation, and holds 0.7 m for what
    the models of the atmosphere leave in a height.

    Raises
    ------
    InsufficientDataError : too few signals or too little difference of elevation.
    """
    rows = np.arange(len(signals)) if line_of_sight is None else np.flatnonzero(line_of_sight)
    group, count = _numbered(signals.epoch[rows])
    lift = signals.direction[rows, 2]
    spread = lift - _centre(lift, np.ones(len(rows)), group, count)[group]
    if len(rows) < 100 or np.sqrt(np.mean(spread ** 2)) < 0.05:
        raise InsufficientDataError("Too few satellites at different elevations tell the height of the antenna: "
                                    "give the geoid separation.")
    system = np.unique(signals.system[rows], return_inverse=True)[1].ravel()
    part, parts = _numbered(signals.epochs.source[signals.epoch[rows]] * 8 + system)
    unknowns = sparse.hstack([sparse.csr_matrix(lift[:, None]), _incidence(part, parts)], format="csr")
    value, sigma = signals.residual[rows], signals.sigma[rows]
    solution, weight = _height_steps(value, sigma, unknowns, part, group, count)
    left = value - unknowns @ solution
    left = left - _centre(left, weight, group, count)[group]
    inverse = np.linalg.pinv(_normal(unknowns, weight, group, count), rcond=1e-10, hermitian=True)
    slope = unknowns @ inverse[0]
    influence = weight * left * (slope - _centre(slope, weight, group, count)[group])
    block = np.floor(signals.time[rows] / _BLOCK).astype(np.int64)
    satellite, satellites = _numbered(signals.satellite[rows])
    score = np.bincount(_numbered(block * satellites + satellite)[0], influence)
    return -float(solution[0]), float(np.hypot(np.sqrt(np.sum(score ** 2)), _AIR_HEIGHT))


def _numbered(values: np.ndarray) -> tuple[np.ndarray, int]:
    """Values replaced by the number of each different one, and how many there are."""
    names, number = np.unique(values, return_inverse=True)
    return number.ravel(), len(names)


def _incidence(number: np.ndarray, count: int) -> sparse.csr_matrix:
    return sparse.csr_matrix((np.ones(len(number)), (np.arange(len(number)), number)), (len(number), count))


def _centre(value: np.ndarray, weight: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    total = np.bincount(group, weight, count)
    return np.bincount(group, weight * value, count) / np.where(total > 0, total, 1.0)


def _normal(unknowns: sparse.csr_matrix, weight: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    """Normal matrix of the unknowns, the clocks of the groups eliminated."""
    weighted = unknowns.multiply(weight[:, None]).tocsr()
    cells = _incidence(group, count).T @ weighted
    total = np.bincount(group, weight, count)
    cells_scaled = cells.multiply(np.where(total > 0, 1 / np.where(total > 0, total, 1.0), 0.0)[:, None])
    return (unknowns.T @ weighted - cells.T @ cells_scaled).toarray()


def _height_steps(value: np.ndarray, sigma: np.ndarray, unknowns: sparse.csr_matrix, part: np.ndarray,
                  group: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Minus height and offsets, and final weights; the robust scale falls from tens of metres: a mix-up is followed."""
    solution = np.zeros(unknowns.shape[1])
    # Offsets of the systems by medians, each against the median of its epochs.
    above = value - grouped_median(value, group, count)[group]
    solution[1:] = grouped_median(above, part, unknowns.shape[1] - 1)
    left = value - unknowns @ solution
    left = left - grouped_median(left, group, count)[group]
    for scale in _COARSE:
        for _ in range(4):
            weight = tukey(left / (np.maximum(sigma, 0.5) * scale)) / sigma ** 2
            centred = value - _centre(value, weight, group, count)[group]
            right = unknowns.T @ (weight * centred)
            before = solution[0]
            solution = np.linalg.lstsq(_normal(unknowns, weight, group, count), right, rcond=1e-10)[0]
            left = value - unknowns @ solution
            left = left - _centre(left, weight, group, count)[group]
            if abs(solution[0] - before) < 1e-2:
                break
    return solution, weight

