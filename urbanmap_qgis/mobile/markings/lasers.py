"""Intensities of a scanner of many lasers, freed of what its lasers differ by.

The lasers of a spinning scanner answer the same asphalt with intensities that differ several times over; laid on the
ground they draw rings that look like paint. Each laser's gain is found where several lasers measured the same ground:

    I_p = g_laser(p) s_cell(p)

with the brightness s of small cells of the ground, by alternating ratios of sums. A laser is told by an attribute that
numbers it, or by the vertical angle of its beam. One whose intensities scatter too much on ground that others see to
be even tells nothing about paint and is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from ..calibration import Mount
from ..trajectory import Trajectory, interpolate, rotations
from .ranges import Track

ATTRIBUTE, SOURCE, ANGLE = "attribute", "point source id", "vertical angle"
"""What lasers are told by."""

RESTLESS = 0.3
"""Scatter of a scanner's asphalt from which its lasers are told apart."""

MAX_SILENT = 0.1  # Share of a laser's points without a signal from which it is left out.
MAX_SCATTER = 0.54  # Scatter of a laser on even ground, of the natural logarithm, from which it is left out.
BIN = 0.1  # degrees; neighbouring lasers of a scanner lie 0.2 degrees or more apart
CELL = 0.4  # m
FEWEST = 200  # points by which a laser is judged
PASSES = 40
AS_GOOD = 1.1
BETTER = 0.9
BRIGHT = 2.0  # of the cell's brightness: what is brighter is paint or glare
# lasers, and extent of the logarithm of range, from which a parabola over range can be told
PARABOLA = 8, 0.5

_ANGLES = int(180 / BIN)


@dataclass(frozen=True)
class LaserGains:
    """Gains of the lasers of one scanner.

    Attributes
    ----------
    told_by : ATTRIBUTE, SOURCE or ANGLE.
    gain : (k,) by number of the laser, NaN for those left out.
    judged : (k,) bool, lasers with points enough.
    before, after : scatter of the logarithms on even ground without and with the gains.
    """

    told_by: str
    gain: np.ndarray
    judged: np.ndarray
    before: float
    after: float

    @property
    def used(self) -> int:
        """Lasers, or bins of the vertical angle, with a gain."""
        return int(np.isfinite(self.gain).sum())

    @property
    def left_out(self) -> int:
        """Those that were judged and left out."""
        return int((self.judged & np.isnan(self.gain)).sum())


@dataclass(frozen=True)
class Lasers:
    """The lasers of one scanner: how a point's is told, and their gains.

    Attributes
    ----------
    track, mount : of the scanner; mount is None without a calibration.
    trajectory : of the body.
    gains : by laser.
    """

    track: Track
    mount: Mount | None
    trajectory: Trajectory
    gains: LaserGains

    def freed(self, records: np.ndarray) -> np.ndarray:
        """Intensity (n,) of records freed of their lasers' gains; NaN where a laser is left out."""
        number = laser_numbers(records, self.gains.told_by, self.track, self.trajectory, self.mount)
        known = number < len(self.gains.gain)
        return np.where(known, records["intensity"] / self.gains.gain[np.where(known, number, 0)], np.nan)


def told_apart(records: np.ndarray, brightness: np.ndarray, silent: np.ndarray, track: Track, mount: Mount | None,
               trajectory: Trajectory) -> Lasers | None:
    """Lasers of a scanner by what tells them apart best; None where nothing does.

    Parameters
    ----------
    records : (n,) `survey_points.RECORD`, ground.
    brightness, silent : as of `find_gains`.
    """
    found = []
    for told_by in (ATTRIBUTE, SOURCE, ANGLE):
        number = laser_numbers(records, told_by, track, trajectory, mount)
        gains = find_gains(records["x"], records["y"], records["range"], brightness, silent, number, told_by)
        if gains is not None:
            found.append(gains)
    least = min((gains.after for gains in found), default=0.0)
    # A number is surer than an angle, which neighbouring lasers may share.
    best = next((gains for gains in found if gains.after <= AS_GOOD * least), None)
    return None if best is None else Lasers(track, mount, trajectory, best)


def laser_numbers(records: np.ndarray, told_by: str, track: Track, trajectory: Trajectory,
                  mount: Mount | None) -> np.ndarray:
    """Number (n,) of the laser of each record (`survey_points.RECORD`)."""
    if told_by == ATTRIBUTE:
        return records["laser"].astype(np.int64)
    if told_by == SOURCE:
        return records["source"].astype(np.int64)
    angle = vertical_angles(records, track, trajectory, mount)
    return np.clip((angle + 90.0) / BIN, 0, _ANGLES - 1).astype(np.int64)


def vertical_angles(records: np.ndarray, track: Track, trajectory: Trajectory, mount: Mount | None) -> np.ndarray:
    """Angle (n,), degrees, of each beam above the plane in which the scanner turns (without a mount: the body's)."""
    beam = np.column_stack([records[name] - at for name, at in zip("xyz", track.interpolate(records["time"]))])
    down = interpolate(trajectory, records["time"], "hold").angles
    # The scanner's axis of rotation in the body's axes, then in the map.
    axis = np.array([0.0, 0.0, 1.0]) if mount is None else _body_axis(mount.angles)
    mapped = np.einsum("nij,j->ni", rotations(down), axis)
    length = np.linalg.norm(beam, axis=1)
    return -np.degrees(np.arcsin(np.clip((beam * mapped).sum(axis=1) / np.maximum(length, 1e-6), -1.0, 1.0)))


def _body_axis(angles: np.ndarray) -> np.ndarray:
    """The scanner's z axis (3,) in the body's axes forward, right, down."""
    east, north, up = rotations(np.asarray(angles, float)[None])[0][:, 2]
    return np.array([north, east, -up])


def find_gains(x: np.ndarray, y: np.ndarray, ranges: np.ndarray, brightness: np.ndarray, silent: np.ndarray,
               laser: np.ndarray, told_by: str) -> LaserGains | None:
    """Gains of lasers from points (n,) on the ground; None where they do not make it clearly more even.

    On a level road a laser has about one range: what gains have in common over range belongs to the curve over range
    and is taken out of them.

    Parameters
    ----------
    x, y, ranges : m.
    brightness : freed of range, about 1 on asphalt.
    silent : points without a signal.
    laser : number of each point's laser.
    """
    count = int(laser.max(initial=0)) + 1
    points = np.bincount(laser, minlength=count)
    judged = points >= FEWEST
    heard = judged & (np.bincount(laser, weights=silent, minlength=count) <= MAX_SILENT * points)
    if np.count_nonzero(heard) < 3:
        return None
    before = _scatter(x, y, brightness, judged[laser] & ~silent)
    known = heard[laser] & ~silent
    laser, brightness = laser[known], brightness[known].astype(float)
    cell, cells = _cells(x[known], y[known])
    order = np.argsort(laser, kind="stable")
    laser, brightness, cell, ranges = laser[order], brightness[order], cell[order], ranges[known][order]
    gain = _alternating(cell, cells, brightness, laser, count)
    gain /= _common_over_range(gain, _medians(ranges, laser, count), np.bincount(laser, minlength=count))
    off = _off(cell, cells, brightness / gain[laser])
    scatter = _medians(np.abs(off), laser, count) * SIGMA_OF_MAD
    good = heard & (scatter <= MAX_SCATTER)
    after = float(SIGMA_OF_MAD * np.median(np.abs(off[good[laser]]))) if good.any() else np.inf
    if not after < BETTER * before:
        return None
    return LaserGains(told_by, np.where(good, gain, np.nan), judged, before, after)


def _scatter(x: np.ndarray, y: np.ndarray, brightness: np.ndarray, some: np.ndarray) -> float:
    """Scatter of the logarithms of some points about the means of their cells."""
    cell, cells = _cells(x[some], y[some])
    return float(SIGMA_OF_MAD * np.median(np.abs(_off(cell, cells, brightness[some].astype(float)))))


def _cells(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, int]:
    """Number (n,) of the ground's cell of each point, and how many there are."""
    column, row = (np.floor((values - values.min()) / CELL).astype(np.int64) for values in (x, y))
    _, cell = np.unique(row * (int(column.max()) + 1) + column, return_inverse=True)
    return cell, int(cell.max()) + 1


def _alternating(cell: np.ndarray, cells: int, brightness: np.ndarray, laser: np.ndarray, count: int) -> np.ndarray:
    """Gains (count,) of lasers and brightness of the ground, by turns; points are sorted by laser."""
    gain = np.ones(count)
    for _ in range(PASSES):
        change = _medians(_off(cell, cells, brightness / gain[laser]), laser, count)
        gain *= np.exp(change)
        # Only ratios are observed: the points' mean stays.
        gain /= np.exp(np.mean(np.log(gain[laser])))
    return gain


def _common_over_range(gain: np.ndarray, ranges: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The smooth course (count,) of gains over the lasers' ranges (count,), m: a parabola of the logarithms."""
    some = (points > 0) & (ranges > 0)
    way = np.log(np.where(some, ranges, 1.0))
    degree = 2 if np.count_nonzero(some) >= PARABOLA[0] and np.ptp(way[some]) > PARABOLA[1] else 0
    parabola = np.polyfit(way[some], np.log(gain[some]), degree, w=np.sqrt(points[some]))
    return np.exp(np.where(some, np.polyval(parabola, way), 0.0))


def _off(cell: np.ndarray, cells: int, values: np.ndarray) -> np.ndarray:
    """Logarithm (n,) of values (n,) over the mean of their cell, paint and glare aside."""
    mean = np.bincount(cell, weights=values, minlength=cells) / np.bincount(cell, minlength=cells)
    even = values < BRIGHT * mean[cell]
    some = np.maximum(np.bincount(cell[even], minlength=cells), 1)
    mean = np.bincount(cell[even], weights=values[even], minlength=cells) / some
    return np.log(values / np.maximum(mean, LEAST_DIVISOR)[cell])


def _medians(values: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    """Median (count,) of values (n,) of each group, 0 for empty ones; groups are sorted."""
    first = np.searchsorted(group, np.arange(count + 1))
    return np.array([np.median(values[a:b]) if b > a else 0.0 for a, b in zip(first[:-1], first[1:])])
