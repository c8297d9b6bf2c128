"""How drives are adjusted, and what the adjustment of several drives gives: a result each, and all together."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ...settings.mobile import ControlSettings
from ..registration.run import RegistrationRun
from ..registration.trajectory_stops import path_parameters_of
from ..trajectory import Trajectory
from .network import KINDS, WALL, Network, NetworkObservations, plan_information, plan_residuals

PLACED, BRIDGED, RELATIVE, NOT_TIED = range(4)
STATUS_NAMES = ("placed", "bridged", "relative only", "not tied")
"""Of a node: near observations of a network with control or reference; farther from them; in a network whose place is
only what the drives report in the mean; of a drive without any observation, which stays as reported."""


COUNTED = 0.3
"""Weight from which an observation counts."""


@dataclass(frozen=True)
class AdjustmentRun(ControlSettings):
    """How drives are adjusted.

    Attributes
    ----------
    registration : of ties and reference.
    """

    registration: RegistrationRun = field(default_factory=RegistrationRun)

    def path_parameters(self, trajectory: Trajectory) -> np.ndarray:
        """(k,) parameter of the drift along a trajectory's epochs, m."""
        return path_parameters_of(trajectory, self.registration.correction.time_weight)


@dataclass(frozen=True)
class AdjustedDrive:
    """One drive's result.

    Attributes
    ----------
    name : of the drive.
    reported, corrected : trajectories of the same epochs.
    time, chainage : (k,) s, m, of the nodes.
    place : (k, 3) m, corrected.
    correction : (k, 4) m, degrees of heading.
    covariance : (k, 4, 4).
    status : (k,) PLACED and its fellows.
    """

    name: str
    reported: Trajectory
    corrected: Trajectory
    time: np.ndarray
    chainage: np.ndarray
    place: np.ndarray
    correction: np.ndarray
    covariance: np.ndarray
    status: np.ndarray

    def plan_sigma(self) -> np.ndarray:
        """(k,) standard deviation in the worst direction in plan, m."""
        return np.sqrt(np.linalg.eigvalsh(self.covariance[:, :2, :2])[:, -1])


@dataclass(frozen=True)
class AdjustedSurvey:
    """All drives, and the observations with what is left of them.

    Attributes
    ----------
    drives : in the given order.
    observations, network : of the adjustment.
    place : (n, 3) m, where each observation lies after it.
    relative : whether no drive is tied to control or reference.
    """

    drives: tuple[AdjustedDrive, ...]
    observations: NetworkObservations
    network: Network
    place: np.ndarray
    relative: bool

    def median_sigma(self) -> float:
        """Median standard deviation in plan over all drives, m."""
        return float(np.median(np.concatenate([drive.plan_sigma() for drive in self.drives])))

    def witness_shares(self, number: int) -> tuple[float, ...]:
        """Share, 0 to 1, that each of `KINDS` has in what is observed of a drive in plan; 0 where nothing is."""
        seen = self.observations
        known = plan_information(seen) * self.network.weight
        # A wall tells of its place once, however often it was seen: no better than what walls differ.
        wall = seen.kind == WALL
        if wall.any():
            _, same = np.unique(seen.owner[wall, 1], return_inverse=True)
            of_wall = np.bincount(same.ravel(), known[wall])
            known[wall] /= 1.0 + of_wall[same.ravel()] * float(np.square(self.network.differ).sum())
        known = np.where((seen.drive == number) | (seen.other == number), known, 0.0)
        of_kind = np.bincount(seen.kind, known, len(KINDS))
        return tuple((of_kind / max(of_kind.sum(), LEAST_DIVISOR)).tolist())

    def residual_rows(self) -> list[tuple[str, int, int, float, float, float, float]]:
        """By kind: name, number, number that lost its weight, RMS and largest residual in plan and in height, m."""
        rows, sizes = [], plan_residuals(self.observations, self.network.residual)
        for kind, name in enumerate(KINDS):
            of_kind = self.observations.kind == kind
            if of_kind.any():
                plan = sizes[of_kind]
                up = np.abs(self.network.residual[of_kind, 2])
                known = up[np.isfinite(up)]
                rows.append((name, int(of_kind.sum()), int((self.network.weight[of_kind] < COUNTED).sum()),
                             float(np.sqrt(np.mean(plan**2))), float(plan.max()),
                             float(np.sqrt(np.mean(known**2))) if len(known) else np.nan,
                             float(known.max()) if len(known) else np.nan))
        return rows
