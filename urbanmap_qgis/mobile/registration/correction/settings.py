"""Parameters of the adjustment of one smooth correction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....estimation.error_model import AttitudeError, PoseErrorModel
from ....estimation.gauss_markov import GaussMarkovDrift
from ....settings.mobile import TrustSettings


@dataclass(frozen=True)
class CorrectionSettings(TrustSettings):
    """Parameters of the adjustment.

    Attributes
    ----------
    node_length : m of path parameter between the nodes of the correction.
    rate_sigma, rate_correlation_length, random_walk, initial_sigma, time_weight, stop_walk : see `GaussMarkovDrift`;
        the survey itself scales the rate and the random walk.
    attitude_sigma : degrees, standard deviations of the reported roll, pitch and heading, where the trajectory does not
        state its own.
    attitude_length : m of path parameter in which their errors forget themselves.
    block_length : m of path whose observations are tested, and lose their weight, as one.
    single : how many times as large as usual a single piece's misfit may be (its root).
    region : how many times as large as usual the mean misfit of the pieces around may be.
    gross : standard deviations from which a block's contradiction is gross.
    min_margin : log-likelihood by which a position must beat all others.
    search : m, largest error east or north that the windows looked for: a correction as large is no find.
    support_length : m of path to either side whose markings must fix the position of a registered patch.
    registered_sigma : m in plan, a registered patch has at most, also by the markings around alone.
    blurs : m, by which the reference is softened in the rounds on the points.
    reference_sigma, reference_sigma_z : m, what the reference itself is off by, added to every sigma.
    reference_steps : whether the reference may step; markings of another drive do not, its error is a drive's.
    rounding_variance : m2, of rounded coordinates of the points, by axis, added to every variance of a place.
    """

    node_length: float = 2.0
    rate_sigma: tuple[float, ...] = (2e-3, 2e-3, 1.5e-3, 1.2e-3, 1.2e-3, 1.2e-3)
    rate_correlation_length: float = 40.0
    random_walk: tuple[float, ...] = (1.5e-3, 1.5e-3, 1.0e-3, 1e-3, 1e-3, 1e-3)
    initial_sigma: tuple[float, ...] = (3.0, 3.0, 5.0, 0.15, 0.15, 0.2)
    attitude_sigma: tuple[float, float, float] = (0.05, 0.05, 0.1)
    attitude_length: float = 200.0
    time_weight: float = 1.0
    stop_walk: float = 0.1
    block_length: float = 10.0
    single: float = 4.0
    region: float = 3.0
    gross: float = 5.0
    min_margin: float = 3.0
    search: float = np.inf
    support_length: float = 30.0
    registered_sigma: float = 0.10
    blurs: tuple[float, ...] = (0.15, 0.05, 0.0, 0.0, 0.0)
    reference_sigma_z: float = 0.015
    rounding_variance: tuple[float, ...] = (0.0, 0.0, 0.0)
    reference_steps: bool = True

    def model(self) -> GaussMarkovDrift:
        """The drift as these settings expect it."""
        return GaussMarkovDrift(np.array(self.rate_sigma), self.rate_correlation_length, np.array(self.random_walk),
                                np.array(self.initial_sigma), self.time_weight, self.stop_walk)

    def error_model(self, angle_sigma: np.ndarray) -> PoseErrorModel:
        """The error of places and angles, the latter with standard deviations (k, 3), degrees, at the nodes."""
        return PoseErrorModel(self.model(), AttitudeError(angle_sigma, np.full(3, self.attitude_length)))
