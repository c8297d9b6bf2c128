"""How strong a signal in line of sight usually is, to tell signals that the building models misjudge.

A bridge or a tree that no model shows weakens what should be in line of sight; a signal that the model calls blocked
and that is as strong as a free one is not a reflection.
"""

from __future__ import annotations

import numpy as np

from ..signals.tables import Signals

_BIN = 10.0
"""Width of the classes of elevation, degrees."""

_LEAST = 30
"""Signals in a class for a figure of its own."""


def expected_cn0(signals: Signals, is_los: np.ndarray) -> np.ndarray:
    """(n,) usual strength of a free signal of the same system and elevation, dB-Hz; NaN where none can be told.

    It is the upper quartile of the signals `is_los` (n,) in classes of elevation, so that a large share of wrongly
    classed ones does no harm; classes with few signals take the figure of the whole system.
    """
    usual = np.full(len(signals), np.nan)
    known = is_los & np.isfinite(signals.cn0)
    level = np.floor(signals.elevation / _BIN)
    for system in np.unique(signals.system):
        of_system = signals.system == system
        if np.count_nonzero(of_system & known) < _LEAST:
            continue
        usual[of_system] = np.quantile(signals.cn0[of_system & known], 0.75)
        for value in np.unique(level[of_system & known]):
            members = of_system & known & (level == value)
            if np.count_nonzero(members) >= _LEAST:
                usual[of_system & (level == value)] = np.quantile(signals.cn0[members], 0.75)
    return usual


def attenuation(signals: Signals, is_los: np.ndarray) -> np.ndarray:
    """(n,) dB by which signals are weaker than free ones usually are; NaN where that is not known."""
    return expected_cn0(signals, is_los) - signals.cn0
