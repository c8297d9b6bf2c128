"""The receiver's clock from signals in line of sight, with the errors that it leaves in all other signals.

Residuals of line-of-sight signals are clock (new at every epoch) + offset of the system + error of the satellite
(orbit, its clock, atmosphere: lasting for the pass) + noise. What is left in a reflected signal after taking the
clock off is not its own noise alone: the errors of offsets and satellites are common to all signals of a pass and
must not be averaged away. They are therefore handed on as latent parameters with their covariance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from ...progress import SILENT, Progress
from ..signals.tables import Signals

HUBER = 1.5
FORGET = 3.5
ROUNDS = 15
LEAST_SATELLITE_ERROR = 0.2  # Of orbit, satellite clock and atmosphere together, m: less is not believed.
# What is expected of it before anything is measured, m, as if so many satellites had told it.
USUAL_ERROR = 0.5
USUAL_COUNT = 4.0
OUTLIER = 15.0  # Satellites whose squared error is so many times the median's are not in sight.
OPEN = 1e3  # Standard deviation of a system's offset before it is measured, m.


@dataclass(frozen=True)
class PassClock:
    """Clock of one observation file. Its k latent parameters are offsets of systems and errors of satellites.

    Attributes
    ----------
    rows : (r,) rows of the signals of this file.
    corrected : (r,) residual less clock, offset and satellite error, m; NaN where the clock is not known.
    clock_corrected : (r,) residual less clock and offset only, m.
    share : (r, k) by how much the error of each latent parameter enters `corrected`.
    covariance : (k, k) of the latent parameters, m2.
    white : (r,) variance of the clock at the epoch by noise alone, m2.
    fit : (r,) bool, the rows the clock was estimated from.
    unit_weight : scatter of line-of-sight residuals over `Signals.sigma`.
    """

    rows: np.ndarray
    corrected: np.ndarray
    clock_corrected: np.ndarray
    share: np.ndarray
    covariance: np.ndarray
    white: np.ndarray
    fit: np.ndarray
    unit_weight: float


def pass_clocks(signals: Signals, is_los: np.ndarray, least: int = 3, progress: Progress = SILENT
                ) -> list[PassClock]:
    """Clock of every observation file.

    Parameters
    ----------
    is_los : (n,) signals in line of sight.
    least : epochs with fewer of them have no clock.
    """
    source = signals.epochs.source[signals.epoch]
    clocks = []
    for number in np.unique(source):
        rows = np.flatnonzero(source == number)
        clocks.append(_pass_clock(signals, rows, is_los[rows], least, progress))
    return clocks


def _pass_clock(signals: Signals, rows: np.ndarray, is_los: np.ndarray, least: int,
                progress: Progress) -> PassClock:
    _, epoch = np.unique(signals.epoch[rows], return_inverse=True)
    epoch = epoch.ravel()
    design, systems = _design(signals.system[rows], signals.satellite[rows], is_los)
    residual, sigma = signals.residual[rows], signals.sigma[rows]
    enough = np.bincount(epoch, weights=is_los)[epoch] >= least
    fit = is_los & enough
    satellite_error, unit = 1.0, 1.0
    weight = np.where(fit, sigma ** -2.0, 0.0)
    for number in range(ROUNDS):
        progress.check()
        prior = np.r_[np.full(systems, OPEN), np.full(design.shape[1] - systems, satellite_error)]
        latent, covariance, mean, total = _solved(design, residual, weight / unit**2, epoch, prior)
        left = residual - design @ latent
        clock = np.bincount(epoch, weights=weight * left) / np.where(total > 0, total * unit**2, np.nan)
        left = left - clock[epoch]
        inlier = weight > 0.1 * sigma ** -2.0
        unit = _scatter(left[inlier] / sigma[inlier], np.count_nonzero(inlier) - len(np.unique(epoch[inlier])))
        satellite_error = _lasting(latent[systems:], np.diag(covariance)[systems:],
                                   design[inlier, systems:].any(axis=0))
        # A signal that was not in sight after all errs as a whole: its satellite's lasting error counts with it.
        whole = left + design[:, systems:] @ latent[systems:]
        scaled = np.abs(whole) / np.sqrt((unit * sigma) ** 2 + satellite_error**2)
        weight = np.where(fit, _robust(scaled, redescending=number >= ROUNDS // 3) * sigma ** -2.0, 0.0)
    fit &= weight > 0.1 * sigma ** -2.0
    heard = design[fit, :systems].any(axis=0) if fit.any() else np.zeros(systems, bool)
    # A system without a signal in sight has no clock of its own.
    known = enough & ((design[:, :systems] == 0) | heard).all(axis=1) & fit.any()
    white = np.where(total > 0, 1.0 / np.where(total > 0, total, 1.0), np.nan)[epoch]
    return PassClock(rows, np.where(known, left, np.nan), np.where(known, whole, np.nan), design - mean[epoch],
                     covariance, np.where(known, white, np.nan), fit, unit)


def _design(system: np.ndarray, satellite: np.ndarray, is_los: np.ndarray) -> tuple[np.ndarray, int]:
    """Columns (r, k) of the latent parameters, and how many of them are offsets of systems.

    The system of which most signals are in sight has none: it is the reference.
    """
    names = np.unique(system)
    count = [np.count_nonzero(is_los & (system == name)) for name in names]
    others = [name for name in names if name != names[int(np.argmax(count))]]
    satellites = np.unique(satellite)
    columns = [system == name for name in others] + [satellite == name for name in satellites]
    return np.column_stack(columns).astype(float), len(others)


def _solved(design, residual, weight, epoch, prior):
    """Latent parameters, their covariance, weighted mean of the design at each epoch, total weight of each epoch.

    The clocks of the epochs are eliminated: what is left of the signals are differences to their epoch's mean.
    """
    total = np.bincount(epoch, weights=weight)
    safe = np.where(total > 0, total, 1.0)
    mean = np.column_stack([np.bincount(epoch, weights=weight * column) / safe for column in design.T])
    mean_residual = np.bincount(epoch, weights=weight * residual) / safe
    centred = design - mean[epoch]
    normal = (centred * weight[:, None]).T @ centred + np.diag(prior ** -2.0)
    covariance = np.linalg.inv(normal)
    latent = covariance @ ((centred * weight[:, None]).T @ (residual - mean_residual[epoch]))
    return latent, covariance, mean, total


def _robust(scaled: np.ndarray, redescending: bool) -> np.ndarray:
    """Weights by normalised residuals: Huber's to begin with, then Geman and McClure's, which forget outliers."""
    if redescending:
        return (1.0 + (scaled / FORGET) ** 2) ** -2.0
    return np.minimum(1.0, HUBER / np.maximum(scaled, LEAST_DIVISOR))


def _scatter(normalised: np.ndarray, freedom: int) -> float:
    """Robust standard deviation of residuals, for the parameters that were estimated with them."""
    if freedom < 5:
        return 1.0
    inflation = np.sqrt(len(normalised) / freedom)
    return float(max(SIGMA_OF_MAD * np.median(np.abs(normalised)) * inflation, 0.3))


def _lasting(error: np.ndarray, variance: np.ndarray, heard: np.ndarray) -> float:
    """Standard deviation of the satellites' lasting errors: of the estimates, robustly, and what they leave open."""
    square = error[heard] ** 2 + variance[heard]
    inlier = square <= OUTLIER * np.median(square) if len(square) else np.zeros(0, bool)
    total = square[inlier].sum() + USUAL_COUNT * USUAL_ERROR**2
    return float(max(np.sqrt(total / (np.count_nonzero(inlier) + USUAL_COUNT)), LEAST_SATELLITE_ERROR))
