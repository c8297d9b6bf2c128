"""Residuals of traced signals with the receiver's clock taken off: what is left is excess path and noise."""

from __future__ import annotations

import numpy as np

from ...errors import InsufficientDataError
from ...progress import SILENT, Progress
from ...settings.gnss import TraceSettings
from ...wording import say
from ..rays.reflections import LOS, SignalPaths, trace
from ..rays.wall_faces import WallPieces
from ..signals.tables import Signals
from .receiver_clock import PassClock, pass_clocks
from .signal_strength import attenuation

WEAKENED = 7.0
"""Signals weaker than free ones by more than this are not in line of sight, whatever the model says, dB."""


def trace_residuals(walls: WallPieces, signals: Signals, settings: TraceSettings | None = None,
                    progress: Progress = SILENT) -> tuple[SignalPaths, np.ndarray]:
    """The path of each signal, and its residual (n,) less the receiver's clock, m; NaN where that is not known.

    Raises
    ------
    InsufficientDataError : no signals, all antennas within buildings, or no epoch with enough signals in sight.
    """
    paths = trace(walls, signals, settings or TraceSettings(), progress.part(0.0, 0.8))
    return paths, corrected_residuals(signals, line_of_sight_clocks(signals, paths, progress.part(0.8, 1.0)))


def line_of_sight_clocks(signals: Signals, paths: SignalPaths, progress: Progress = SILENT) -> list[PassClock]:
    """Clock of every pass from the signals that are in line of sight for sure and as strong as such signals are.

    Raises
    ------
    InsufficientDataError : no epoch has enough of them.
    """
    is_los = (paths.kind == LOS) & paths.sure
    with np.errstate(invalid="ignore"):
        is_los &= ~(attenuation(signals, is_los) > WEAKENED)
    clocks = pass_clocks(signals, is_los, progress=progress)
    if not any(np.isfinite(clock.corrected).any() for clock in clocks):
        raise InsufficientDataError(say("At no epoch are three satellites in line of sight, so that the receiver's "
                                        "clock is not known: give observations of more satellites, or check heights "
                                        "and coordinate systems."))
    return clocks


def corrected_residuals(signals: Signals, clocks: list[PassClock]) -> np.ndarray:
    """(n,) residuals less the receiver's clock, m; NaN where it is not known.

    The lasting errors of the satellites that the clock's estimate found stay in: they are part of what a user of the
    residual meets.
    """
    corrected = np.full(len(signals), np.nan)
    for clock in clocks:
        corrected[clock.rows] = clock.clock_corrected
    return corrected
