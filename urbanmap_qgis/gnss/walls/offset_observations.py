"""What each reflected signal says about the offset of its wall: one observation a satellite and block of time (J 5.6).

Signals of a satellite that follow each other are bent by the same facade and the same atmosphere: a minute of them
at one place is one piece of evidence, not sixty.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..rays.reflections import SignalPaths
from ..rays.wall_faces import WallPieces
from ..signals.tables import Signals
from .receiver_clock import PassClock


@dataclass(frozen=True)
class OffsetObservations:
    """One row an observation; `value` = -2 `cosine` offset + share of the pass's latent errors + its own error.

    Attributes
    ----------
    wall : (v,) number of the wall.
    source : (v,) observation file.
    satellite : (v,) name.
    block : (v,) of time.
    value : (v,) measured less predicted excess path, m (median over the block).
    cosine : (v,) cosine between signal and normal.
    distance : (v,) to the wall, m.
    variance : (v,) of `value` by noise that differs from epoch to epoch, m2.
    count : (v,) signals in it.
    share : for each observation file (v_p, k_p) share of its latent errors, in the order of the observations of that
        file.
    covariance : for each observation file (k_p, k_p) of its latent errors, m2.
    """

    wall: np.ndarray
    source: np.ndarray
    satellite: np.ndarray
    block: np.ndarray
    value: np.ndarray
    cosine: np.ndarray
    distance: np.ndarray
    variance: np.ndarray
    count: np.ndarray
    share: tuple[np.ndarray, ...]
    covariance: tuple[np.ndarray, ...]

    def __len__(self) -> int:
        return len(self.wall)


def gather_observations(walls: WallPieces, signals: Signals, paths: SignalPaths, usable: np.ndarray,
                        clocks: list[PassClock],
                        outwards: np.ndarray, block_length: float = 30.0, min_signals: int = 2) -> OffsetObservations:
    """Observations of all observation files.

    Parameters
    ----------
    usable : (n,) signals that may be used; each must have exactly one reflection in `paths`.
    outwards : (walls,) m by which the walls of `walls` stand outwards of the model: observations speak of the offset
        from the model, wherever the walls were when the rays were traced.
    block_length : seconds.
    min_signals : observations of fewer signals are left out.
    """
    parts, shares, covariances = [], [], []
    for number, clock in enumerate(clocks):
        part, share = _pass_observations(walls, signals, paths, usable, clock, outwards, block_length, min_signals)
        parts.append(np.column_stack([part, np.full(len(part), number)]))
        shares.append(share)
        covariances.append(clock.covariance)
    table = np.concatenate(parts)
    names = np.unique(signals.satellite)
    return OffsetObservations(table[:, 0].astype(np.int64), table[:, 8].astype(np.int64),
                              names[table[:, 1].astype(np.int64)],
                              table[:, 2].astype(np.int64), *table[:, 3:7].T, table[:, 7].astype(np.int64),
                              tuple(shares), tuple(covariances))


def _pass_observations(walls, signals, paths, usable, clock, outwards, block_length, min_signals
                       ) -> tuple[np.ndarray, np.ndarray]:
    """Observations (v, 8) of one file: wall, satellite, block, value, cosine, distance, variance, count; and their
    shares."""
    inside = np.flatnonzero(usable[clock.rows] & np.isfinite(clock.corrected))
    rows = clock.rows[inside]
    reflection = paths.reflections.select(paths.reflection[rows])
    wall = walls.wall[reflection.piece]
    satellite = np.unique(signals.satellite, return_inverse=True)[1].ravel()[rows]
    block = np.floor(signals.time[rows] / block_length).astype(np.int64)
    # Moving the wall back to the model lengthens the path: what is measured is then compared with the model.
    predicted = 2 * (reflection.distance + outwards[wall]) * reflection.cosine
    value = clock.corrected[inside] - predicted
    _, group, count = np.unique(np.column_stack([wall, satellite, block]), axis=0, return_inverse=True,
                                return_counts=True)
    order = np.argsort(group.ravel(), kind="stable")
    observations, shares = [], []
    for members in np.split(order, np.cumsum(count)[:-1]) if len(order) else []:
        if len(members) < min_signals:
            continue
        noise = np.median(signals.sigma[rows[members]]) ** 2 * clock.unit_weight**2
        variance = (1.57 * noise + clock.white[inside[members]].mean()) / len(members)
        one = members[0]
        observations.append([wall[one], satellite[one], block[one], np.median(value[members]),
                             reflection.cosine[members].mean(),
                             reflection.distance[members].mean(), variance, len(members)])
        shares.append(clock.share[inside[members]].mean(axis=0))
    return np.array(observations).reshape(-1, 8), np.array(shares).reshape(-1, clock.share.shape[1])
