"""How far a new cloud lies from an old model as a whole: what all roofs show alike is no change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import MILLIMETRE, SIGMA_OF_MAD

ROUNDS = 10
FEWEST = 30
"""Roof points, of all buildings together, from which an offset is estimated."""
SLOPES = 0.02
"""Least mean square slope of roofs (m2/m2) along each axis from which they tell an offset in plan: a town in which one
roof in ten is pitched by 25 degrees."""


@dataclass(frozen=True)
class EpochOffset:
    """New cloud minus old model (m): east, north, up, and the standard deviation of each; `noise` of one cell's height.

    The offset in plan is 0 where level roofs do not tell it; its sigma is NaN then.
    """

    shift: tuple[float, float, float]
    sigma: tuple[float, float, float]
    noise: float


def epoch_offset(difference: np.ndarray, slope: np.ndarray) -> EpochOffset:
    """Offset of a cloud from a model by robust least squares (weights of Cauchy) on the roofs.

    Parameters
    ----------
    difference : (n,) height of a cell of the new cloud over the old roof, m; changed ones may be among them.
    slope : (n, 2) rise of the old roof to the east and to the north, m a m.
    """
    good = np.isfinite(difference)
    difference, slope = difference[good], slope[good]
    if len(difference) < FEWEST:
        return EpochOffset((0.0, 0.0, 0.0), (np.nan, np.nan, np.nan), np.nan)
    plan = (slope ** 2).mean(axis=0).min() > SLOPES
    design = np.column_stack([-slope, np.ones(len(slope))]) if plan else np.ones((len(slope), 1))
    solution = np.zeros(design.shape[1])
    solution[-1] = np.median(difference)
    for _ in range(ROUNDS):
        rest = difference - design @ solution
        noise = max(SIGMA_OF_MAD * float(np.median(np.abs(rest))), MILLIMETRE)
        weight = 1.0 / (1.0 + (rest / (2.0 * noise)) ** 2)
        normal = design.T @ (design * weight[:, None])
        solution = np.linalg.solve(normal, design.T @ (weight * difference))
    sigma = noise * np.sqrt(np.diag(np.linalg.inv(normal)))
    if not plan:
        return EpochOffset((0.0, 0.0, float(solution[0])), (np.nan, np.nan, float(sigma[0])), noise)
    east, north, up = solution.tolist()
    return EpochOffset((east, north, up), (float(sigma[0]), float(sigma[1]), float(sigma[2])), noise)
