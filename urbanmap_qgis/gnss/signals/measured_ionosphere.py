"""Delay in the ionosphere from codes on two bands, where a receiver measures both.

The difference of two codes of one satellite holds the ionosphere, the receiver's delay between the bands and noise, and
nothing else: clocks, orbits, troposphere and the detour of a reflection are the same on both. So it is measured for
reflected signals too. The broadcast model is the start; what the differences add to it is a layer over the place
(vertical delay, its change with time, its slopes northwards and eastwards), a bias for each system and a lasting
deviation for each satellite, which also holds the error of its broadcast group delay. Where that is not broadcast (L5
without CNAV) it is an unknown of the satellite, apart from the ionosphere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import SIGMA_OF_MAD
from ..rinex.observation_file import MEGAHERTZ

EARTH = 6371.0  # radius, km
LAYER = 350.0  # height of the layer, km (single-layer model)
# Beside other reflections a code errs alike for about so long, s, and as long as the antenna has not moved by so
# many m: that is one piece of evidence, however many epochs it has.
BLOCK = 30.0
MOVED = 10.0
FEWEST = 4  # satellites with two bands, of which two more than systems
# Before anything is measured: the broadcast model is off by so much of the vertical delay (IS-GPS-200: half of the
# delay is left), and by at least so many m; without a model the delay is within so many m of none.
MODEL_ERROR = 0.5
LEAST_ERROR = 0.5
WITHOUT_MODEL = 10.0
SLOPE = 0.1  # rad over which the layer may change by as much as it is off
HOUR = 3600.0  # s in which it may do so
BIAS = 1e3  # standard deviation of a system's bias before it is measured, m
USUAL_DEVIATION = 0.5  # of a satellite, m, as if so many satellites had told it
USUAL_COUNT = 4.0
LEAST_DEVIATION = 0.1  # m
# Standard deviation, m, of a satellite's delay between the bands where it is not broadcast (some 5 ns among
# satellites).
UNKNOWN_DELAY = 2.0
CODE_NOISE = 0.5  # m, of a code on the second band
USUAL_NOISE = 10.0  # pieces of evidence that the expected noise of codes counts as
ROUNDS = 12
FORGET = 3.5  # sigmas at which a block counts a quarter


@dataclass(frozen=True)
class MeasuredIonosphere:
    """Of n signals.

    Attributes
    ----------
    delay : (n,) on the signal's own (first) band, m.
    sigma : (n,) its standard deviation, m, apart from what the signals of a system have in common (the receiver's
        clock takes that).
    vertical, vertical_sigma : delay at the zenith in the middle of the time, m at GPS's L1.
    modelled : the same by the broadcast model, m.
    satellites : that were measured on two bands.
    calibrated : of these, whose delay between the bands is broadcast.
    """

    delay: np.ndarray
    sigma: np.ndarray
    vertical: float
    vertical_sigma: float
    modelled: float
    satellites: int
    calibrated: int

    @property
    def is_calibrated(self) -> bool:
        """Whether enough satellites have known delays for the vertical delay to be measured, not only its slopes."""
        return self.calibrated >= FEWEST


@dataclass(frozen=True)
class TwoBands:
    """Signals (n,) of one receiver and what their second band tells.

    Attributes
    ----------
    time : GPS time, s, not decreasing.
    place : (n, 3) of the antenna, m.
    satellite : names as in RINEX.
    elevation, azimuth : rad, azimuth from true north.
    modelled : delay by the broadcast model on the first band, m; zeros without one.
    has_model : whether there is a model.
    difference : code on the second band less that on the first, without the satellite's delay between them, m; NaN
        where there is no second band.
    noise : standard deviation of a code on the first band, m.
    bands, second_bands : of the systems.
    known : whether the satellite's delay between the bands is known; None where all are.
    """

    time: np.ndarray
    place: np.ndarray
    satellite: np.ndarray
    elevation: np.ndarray
    azimuth: np.ndarray
    modelled: np.ndarray
    has_model: bool
    difference: np.ndarray
    noise: np.ndarray
    bands: dict[str, str]
    second_bands: dict[str, str]
    known: np.ndarray | None = None


def layer_mapping(elevation: np.ndarray) -> np.ndarray:
    """Slant by vertical delay of a thin layer, by elevation in rad (e.g. Schaer 1999, 2.3)."""
    ratio = EARTH / (EARTH + LAYER)
    return 1.0 / np.sqrt(1.0 - (ratio * np.cos(elevation)) ** 2)


def measure_ionosphere(signals: TwoBands) -> MeasuredIonosphere | None:
    """Delays of all signals, of those on one band too by the layer; None where too few are on two bands."""
    measured = np.isfinite(signals.difference)
    satellites, number = np.unique(signals.satellite, return_inverse=True)
    seen = satellites[np.unique(number[measured])]
    if len(seen) < max(FEWEST, len(np.unique(seen.astype("U1"))) + 2):
        return None
    scale, spread = _band_factors(signals)
    # Everything is reckoned at GPS's L1; `scale` brings it to the signal's own band.
    design = _layer(signals) * layer_mapping(signals.elevation)[:, None]
    per_satellite = np.zeros((len(number), len(satellites)))
    per_satellite[np.arange(len(number)), number.ravel()] = 1.0
    design = np.column_stack([design, per_satellite])
    observed = (signals.difference / spread - signals.modelled) / scale
    noise = np.hypot(signals.noise, CODE_NOISE) / spread / scale
    vertical = np.median((signals.modelled / scale) / layer_mapping(signals.elevation))
    start = _start_error(float(vertical), signals.has_model)
    known = measured if signals.known is None else measured & signals.known
    delays = per_satellite * (UNKNOWN_DELAY / spread / scale * ~known)[:, None]
    latent, covariance = _estimate(design, delays, observed, noise, _blocks(signals, number), satellites, start)
    shared = _system_means(design, number, satellites)
    contrast = design - shared
    sigma = np.sqrt(((contrast @ covariance) * contrast).sum(axis=1))
    return MeasuredIonosphere(signals.modelled + scale * (design @ latent), scale * sigma, float(vertical + latent[0]),
                              float(np.sqrt(covariance[0, 0])), float(vertical), len(seen),
                              len(np.unique(number[known])))


def _band_factors(signals: TwoBands) -> tuple[np.ndarray, np.ndarray]:
    """(n,) delay on the first band by that at GPS's L1, and difference of the two bands by delay on the first."""
    system = signals.satellite.astype("U1")
    scale, spread = np.ones(len(system)), np.ones(len(system))
    for name, band in signals.bands.items():
        frequency = MEGAHERTZ[name][band]
        scale[system == name] = (MEGAHERTZ["G"]["1"] / frequency) ** 2
        if name in signals.second_bands:
            spread[system == name] = (frequency / MEGAHERTZ[name][signals.second_bands[name]]) ** 2 - 1.0
    return scale, spread


def _layer(signals: TwoBands) -> np.ndarray:
    """(n, 4) vertical delay, and its change with time and towards north and east, each by what may be expected."""
    reach = np.pi / 2 - signals.elevation - np.arcsin(
        EARTH / (EARTH + LAYER) * np.cos(signals.elevation))
    late = (signals.time - (signals.time.min() + signals.time.max()) / 2) / HOUR
    return np.column_stack([np.ones(len(reach)), late, reach * np.cos(signals.azimuth) / SLOPE,
                            reach * np.sin(signals.azimuth) / SLOPE])


def _start_error(vertical: float, has_model: bool) -> float:
    """Standard deviation of the layer before anything is measured, m."""
    return max(MODEL_ERROR * vertical, LEAST_ERROR) if has_model else WITHOUT_MODEL


def _blocks(signals: TwoBands, number: np.ndarray) -> np.ndarray:
    """(n,) number of the piece of evidence, of one satellite, to which each signal belongs."""
    times, first, epoch = np.unique(signals.time, return_index=True, return_inverse=True)
    place = signals.place[first, :2]
    block, start = np.zeros(len(times), np.int64), 0
    for k in range(1, len(times)):
        away = times[k] - times[start] >= BLOCK and np.hypot(*(place[k] - place[start])) >= MOVED
        start = k if away else start
        block[k] = block[k - 1] + away
    return np.unique(number.ravel() * (block[-1] + 1) + block[epoch.ravel()], return_inverse=True)[1].ravel()


def _system_means(design: np.ndarray, number: np.ndarray, satellites: np.ndarray) -> np.ndarray:
    """(n, k) mean of the design over the signals of each signal's system."""
    system = np.unique(satellites.astype("U1"), return_inverse=True)[1].ravel()[number.ravel()]
    means = np.stack([design[system == k].mean(axis=0) for k in range(system.max() + 1)])
    return means[system]


def _estimate(design: np.ndarray, delays: np.ndarray, observed: np.ndarray, noise: np.ndarray, block: np.ndarray,
              satellites: np.ndarray, start: float) -> tuple[np.ndarray, np.ndarray]:
    """Latent parameters of the design's columns and their covariance, with the systems' biases and the satellites'
    delays between the bands (columns by their expected size) estimated along."""
    unknown = (delays > 0).any(axis=0)
    rows, values, sigma = _block_means(np.column_stack([design, delays[:, unknown]]), observed, noise, block)
    rows, delays = rows[:, :design.shape[1]], rows[:, design.shape[1]:]
    layer = design.shape[1] - len(satellites)
    letters, system = np.unique(satellites.astype("U1"), return_inverse=True)
    biases = rows[:, layer:] @ np.eye(len(letters))[system.ravel()]
    whole = np.column_stack([rows, biases, delays])
    heard = (rows[:, layer:] > 0).any(axis=0)
    deviation, unit, weight = USUAL_DEVIATION, 1.0, np.ones(len(values))
    for _ in range(ROUNDS):
        prior = np.r_[np.full(layer, start), np.full(len(satellites), deviation), np.full(len(letters), BIAS),
                      np.ones(delays.shape[1])]
        scaled = weight / (unit * sigma) ** 2
        covariance = np.linalg.inv((whole * scaled[:, None]).T @ whole + np.diag(prior**-2.0))
        latent = covariance @ ((whole * scaled[:, None]).T @ values)
        left = (values - whole @ latent) / sigma
        free = max(len(values) - float(np.trace((whole * scaled[:, None]).T @ whole @ covariance)), 0.0)
        scatter = SIGMA_OF_MAD * float(np.median(np.abs(left))) * np.sqrt(len(values) / max(free, 1.0))
        unit = np.sqrt((free * scatter**2 + USUAL_NOISE) / (free + USUAL_NOISE))
        weight = (1.0 + (left / unit / FORGET) ** 2) ** -2.0
        bias_columns = slice(layer, layer + len(satellites))
        square = latent[bias_columns][heard] ** 2 + np.diag(covariance)[bias_columns][heard]
        deviation = max(np.sqrt((square.sum() + USUAL_COUNT * USUAL_DEVIATION**2)
                                / (len(square) + USUAL_COUNT)), LEAST_DEVIATION)
    unknowns = design.shape[1]
    return latent[:unknowns], covariance[:unknowns, :unknowns]


def _block_means(design: np.ndarray, observed: np.ndarray, noise: np.ndarray,
                 block: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean design, median difference and standard deviation of each block with two bands."""
    measured = np.flatnonzero(np.isfinite(observed))
    order = measured[np.argsort(block[measured], kind="stable")]
    starts = np.flatnonzero(np.diff(block[order], prepend=-1))
    count = np.diff(np.append(starts, len(order)))
    rows = np.add.reduceat(design[order], starts, axis=0) / count[:, None]
    values = np.array([np.median(part) for part in np.split(observed[order], starts[1:])])
    # Noise of a code within a block is for the most part its reflections: the mean is no better than one of them.
    return rows, values, np.add.reduceat(noise[order], starts) / count
