"""Where an NDT settles that sees walls where the map has them: cells with two surfaces pull it aside (J 6.2)."""

from __future__ import annotations

import numpy as np

from ...mobile.registration.matching.ndt_match import Mixture, ndt_terms
from ..walls.wall_cells import PlanWallCells
from ..walls.wall_scan import WallScan

ITERATIONS = 4


def settled_places(scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, mixture: Mixture, prior: np.ndarray
                   ) -> np.ndarray:
    """East, north, m, and turn, rad, (n, 3) from the true places (n, 3) to where Newton's method leads from there.

    `prior` (3, 3) is the information of what is known before.
    """
    found = np.zeros((len(sensor), 3))
    for _ in range(ITERATIONS):
        gradient, hessian = _derivatives(found, scan, sensor, cells, mixture)
        found += np.linalg.solve(prior - hessian, gradient[..., None])[..., 0]
    return found


def _derivatives(at: np.ndarray, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, mixture: Mixture
                 ) -> tuple[np.ndarray, np.ndarray]:
    """Gradient (n, 3) and bounded Hessian (n, 3, 3) of the scores of all places, moved by `at` (n, 3)."""
    of, weight, count = scan.of, scan.weight[:, None], len(sensor)
    cosine, sine = np.cos(at[of, 2]), np.sin(at[of, 2])
    east, north = scan.offset[:, 0], scan.offset[:, 1]
    arm = np.column_stack([cosine * east - sine * north, sine * east + cosine * north])
    terms = ndt_terms(cells.ndt, sensor[of, :2] + arm + at[of, :2], mixture, "neighbours", bound=True)
    turn = np.column_stack([-arm[:, 1], arm[:, 0]])
    moved = np.zeros((len(of), 2, 3))
    moved[:, 0, 0] = moved[:, 1, 1] = 1.0
    moved[:, :, 2] = turn
    gradient = weight * np.einsum("mi,mij->mj", terms.gradient, moved)
    hessian = weight[..., None] * np.einsum("mia,mij,mjb->mab", moved, terms.hessian, moved)
    sums = np.column_stack([np.bincount(of, column, count) for column in (*gradient.T, *hessian.reshape(-1, 9).T)])
    return sums[:, :3], sums[:, 3:].reshape(count, 3, 3)
