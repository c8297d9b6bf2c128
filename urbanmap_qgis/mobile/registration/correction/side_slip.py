"""How far a reported trajectory slips sideways: a vehicle goes where it heads, a slip is the trajectory's error.

A re-fix that moves the reported place aside shows as a slip; a step of the reference does not. That tells the two
apart where no markings show how the correction changes. Along the way nothing is told.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....geometry.tolerances import SIGMA_OF_MAD
from ...trajectory import Trajectory, path_chainage


@dataclass(frozen=True)
class SideSlipLimits:
    """Limits of side slip, each with its unit."""

    piece: float = 20.0  # m of path at least, over which slips are compared
    every: float = 5.0  # m of path between the pieces that show the usual slip
    pieces: int = 20  # from which the usual slip can be told
    floor: float = 0.02  # m, of a slip's standard deviation at least
    rounds: int = 5
    soft: float = 2.5  # standard deviations from which a piece loses weight
    straight: float = 0.35  # radians that the path may turn by in a piece: 20 degrees
    other: float = 0.05  # share of slips with reasons of their own, which are a metre or so


LIMITS = SideSlipLimits()


@dataclass(frozen=True)
class SideSlip:
    """The slip of a trajectory, summed along it.

    Attributes
    ----------
    path_parameter, chainage : (e,) m, at the epochs.
    heading : (e,) radians, without jumps of a full turn.
    slip : (e,) m to the right since the first epoch, that the heading denies.
    """

    path_parameter: np.ndarray
    chainage: np.ndarray
    heading: np.ndarray
    slip: np.ndarray

    @classmethod
    def of(cls, trajectory: Trajectory, path_parameter: np.ndarray) -> SideSlip:
        """Of a trajectory with path parameters (e,) m at its epochs; what it does while it stands does not count."""
        chainage = path_chainage(trajectory)
        heading = np.unwrap(np.radians(trajectory.angles[:, 2]))
        middle, step = 0.5 * (heading[1:] + heading[:-1]), np.diff(trajectory.place[:, :2], axis=0)
        right = (step[:, 0] * np.cos(middle) - step[:, 1] * np.sin(middle)) * (np.diff(chainage) > 0)
        return cls(path_parameter, chainage, heading, np.concatenate([[0.0], np.cumsum(right)]))

    def between(self, begin: float, end: float) -> tuple[np.ndarray, float, float] | None:
        """Unit vector (2,) to the right, and the unusual slip along it with its standard deviation, m.

        None where the drive is too short to tell what is usual, or the path bends: there it has no one direction.

        Parameters
        ----------
        begin, end : m, path parameters.
        """
        middle, length = 0.5 * (begin + end), end - begin
        first, last = np.interp([begin, end], self.path_parameter, self.chainage)
        length = max(last - first, LIMITS.piece)
        first = 0.5 * (first + last - length)
        starts = np.arange(self.chainage[0], self.chainage[-1] - length, LIMITS.every)
        if len(starts) < LIMITS.pieces:
            return None
        slip, turned = self._pieces(np.append(starts, first), length)
        if abs(turned[-1]) > LIMITS.straight:
            return None
        design = np.column_stack([np.ones(len(slip)), turned])
        usual, sigma = _robust_line(design[:-1], slip[:-1])
        heading = float(np.interp(middle, self.path_parameter, self.heading))
        return (np.array([np.cos(heading), -np.sin(heading)]), float(slip[-1] - design[-1] @ usual),
                max(sigma, LIMITS.floor))

    def _pieces(self, first: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray]:
        """Slip (n,) m and rotation (n,) radians of pieces of path from chainages (n,) on."""
        rising = np.concatenate([[True], np.diff(self.chainage) > 0])
        ends = [np.clip(at, self.chainage[0], self.chainage[-1]) for at in (first, first + length)]
        slip, heading = ([np.interp(at, self.chainage[rising], values[rising]) for at in ends]
                         for values in (self.slip, self.heading))
        return slip[1] - slip[0], heading[1] - heading[0]

    def share_of_reference(self, prior: float, begin: float, end: float, change: np.ndarray,
                           covariance: np.ndarray) -> float:
        """Probability that a change of the correction between path parameters is the reference's, with the slip there.

        A drive's own change shows as a slip that the correction undoes; a few slips have other reasons.

        Parameters
        ----------
        prior : of it by the markings alone.
        change, covariance : (2,) m, (2, 2) m2.
        """
        found = self.between(begin, end)
        if found is None or not 0.0 < prior < 1.0:
            return prior
        right, slip, sigma = found
        across, spread = float(right @ change), float(right @ covariance @ right)
        drive, reference = (LIMITS.other * normal(slip, 1.0) + (1.0 - LIMITS.other) * normal(off, width) for off, width
                            in ((slip + across, np.hypot(sigma, np.sqrt(spread))), (slip, sigma)))
        return prior * reference / (prior * reference + (1.0 - prior) * drive)


def normal(off: float, sigma: float) -> float:
    """Density of a normal distribution."""
    return float(np.exp(-0.5 * (off / sigma) ** 2) / (np.sqrt(2.0 * np.pi) * sigma))


def _robust_line(design: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, float]:
    """Coefficients that fit values (n,) best, robustly, and the standard deviation of what is left."""
    weight = np.ones(len(values))
    for _ in range(LIMITS.rounds):
        root = np.sqrt(weight)
        usual = np.linalg.lstsq(design * root[:, None], values * root, rcond=None)[0]
        off = values - design @ usual
        sigma = SIGMA_OF_MAD * float(np.median(np.abs(off)))
        weight = 1.0 / (1.0 + (off / max(LIMITS.soft * sigma, 1e-6)) ** 2)
    return usual, sigma
